#include "geometry/queries/rays/line_net.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"
#include "geometry/queries/rays/bezier_sums.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Row sums of |E| up to which Newton's iteration is sure to converge: the derivative matrices of two places of the cell
// differ by at most 2 q / (1 - q) of either, which is 2/3 < 1 for q = 1/4.
constexpr double kContraction = 0.25;

// Row sums of |E| below 1 make F one-to-one on the cell: a root that Newton's iteration finds there is the only one.
// Where it finds none, nothing is known.
constexpr double kInjective = 0.9;

// Cells that one line may ask of one patch; only lines that run inside the surface (tangent along a curve) get there.
constexpr int kMaxCells = 20000;

// A cell is clipped rather than halved where that leaves less of one side than this.
constexpr double kWorthClipping = 0.7;

// Newton's iteration is trusted in cells in which rounding moves roots by less than this part, and cells are not made
// so small that it moves them more: a line along a parameter line is soon known across it, long before it is along it.
constexpr double kMaxRounding = 1e-3;

// Ratio of the weights of a patch from which on it is worth while to know what rounding does in the cell alone.
constexpr double kUneven = 8;

// A cell in which the bound of a patch's distance from its surface moves roots by more than this part is left to a
// better patch.
constexpr double kTooWide = 0.25;

// Two doubles side by side, (f, g) of a control point; and those of two control points, passed by reference as what may
// be in two registers is.
using Pair = double __attribute__((vector_size(16)));

Pair pair(double a) { return Pair{a, a}; }
template <class V>
void raise(V& most, const V& a) {
  most = a > most ? a : most;
}
template <class V>
void lower(V& least, const V& a) {
  least = a < least ? a : least;
}
Pair larger(Pair a, Pair b) { return a > b ? a : b; }
Pair magnitude(Pair a) {
  using Bits = int64_t __attribute__((vector_size(16)));
  constexpr int64_t kAllButSign = std::numeric_limits<int64_t>::max();
  return (Pair)((Bits)a & Bits{kAllButSign, kAllButSign});
}
double largest_of(Pair a) { return std::max(a[0], a[1]); }
Pair larger_half(const Lanes& a) { return larger(Pair{a[0], a[1]}, Pair{a[2], a[3]}); }
void twice(Pair a, Lanes& both) { both = Lanes{a[0], a[1], a[0], a[1]}; }

// Two of the control points c[0], c[stride], ..., c[last stride]: the k-th and the next; the k-th twice where it is the
// last.
void load(const Pair* c, int k, int last, int stride, Lanes& two) {
  if (stride == 1 && k < last) {
    std::memcpy(&two, c + k, sizeof two);
    return;
  }
  const Pair first = c[k * stride], second = c[(k < last ? k + 1 : k) * stride];
  two = Lanes{first[0], first[1], second[0], second[1]};
}
void store(const Lanes& two, Pair* c, int k, int last, int stride) {
  if (stride == 1 && k < last) {
    std::memcpy(c + k, &two, sizeof two);
    return;
  }
  c[k * stride] = Pair{two[0], two[1]};
  if (k < last) c[(k + 1) * stride] = Pair{two[2], two[3]};
}

// Bernstein functions of degree n at the middle of [-1, 1], and their derivatives by x.
struct Middle {
  double value[kMaxDegree + 1];
  double slope[kMaxDegree + 1];
};
const Middle& middle(int n) {
  static const std::vector<Middle> all = [] {
    std::vector<Middle> table(kMaxDegree + 1);
    for (int degree = 0; degree <= kMaxDegree; ++degree) {
      Middle& m = table[degree];
      double choose = std::ldexp(1.0, -degree);
      for (int i = 0; i <= degree; ++i) {
        m.value[i] = choose;
        choose = choose * (degree - i) / (i + 1);
      }
      // b'_(i,n) = n (b_(i-1,n-1) - b_(i,n-1)) = b_(i,n) (i - n s) / (s (1 - s)), s = 1/2, ds/dx = 1/2.
      for (int i = 0; i <= degree; ++i) m.slope[i] = m.value[i] * (2 * i - degree);
    }
    return table;
  }();
  return all[n];
}

// The derivative matrix of the two functions and its inverse, by columns: d(f, g) = x_column dx + y_column dy.
struct Jacobian {
  Pair x, y;
  double determinant() const { return x[0] * y[1] - x[1] * y[0]; }
};

// The degrees that most models have get loops of known length; kAnyDegree: as the patch says.
constexpr int kAnyDegree = -1;

template <int kP, int kQ>
class NetSearch {
 public:
  NetSearch(const PatchView& patch, const CellPlace& place, const Vec2& whole, NearSurface* near, const LineBasis& line,
            CellHits& hits)
      : patch_(patch),
        place_(place),
        whole_(whole),
        near_(near),
        line_(line),
        hits_(hits),
        room_(workspace(static_cast<size_t>(n()) * (kDeepest + 2))) {
    double min_weight = kInfinity, max_weight = 0;
    for (int k = 0; k < n(); ++k) {
      const Vec4& c = patch.points[k];
      const Vec3 r = Vec3(c) - c.w * line.line.origin;
      room_[k] = Pair{glm::dot(line.n1, r), glm::dot(line.n2, r)};
      const double size = std::abs(r.x) + std::abs(r.y) + std::abs(r.z);
      room_[n() + k] = pair(size);
      rounding_ = std::max(rounding_, size);
      min_weight = std::min(min_weight, c.w);
      max_weight = std::max(max_weight, c.w);
    }
    const auto clip = [&](Pair* c) {
      clip_x(c, place.x - place.hx, place.x + place.hx);
      clip_y(c, place.y - place.hy, place.y + place.hy);
    };
    clip(room_);
    // A coefficient is wrong by a few roundings of the terms that made it, and of the averages that clipping and
    // halving take; the same averages of the terms' sizes bound that. Where weights differ much they are far smaller
    // here than elsewhere in the patch.
    min_weight_ = min_weight;
    unevenness_ = max_weight / min_weight;
    if (unevenness_ > kUneven) {
      clip(room_ + n());
      rounding_ = 0;
      for (int k = 0; k < n(); ++k) rounding_ = std::max(rounding_, room_[n() + k][0]);
    }
    rounding_ *= 1e-15;
    if (near_) rounding_ += near_->rounding;
    allowance_ = rounding_;
    if (near_) allowance_ += near_->off;
    excludes_ = allowance_;
    if (near_) excludes_ += near_->slack;
  }

  void run() {
    if (runs_in_plane()) return;
    Cell cells[kDeepest + 1];
    cells[0] = {0, 0, 1, 1, 0, true};
    // What waits has its coefficients behind those of what waits longer.
    for (int waiting = 0; waiting >= 0;) {
      Pair* const c = room_ + waiting * n();
      Cell& cell = cells[waiting];
      switch (treat(c, cell)) {
        case Rest::nothing:
          --waiting;
          break;
        case Rest::smaller:
          break;
        case Rest::halves:
          cells[waiting + 1] = halve(c, cell);
          ++waiting;
          break;
      }
    }
  }

 private:
  int p() const { return kP == kAnyDegree ? patch_.degree_u : kP; }
  int q() const { return kQ == kAnyDegree ? patch_.degree_v : kQ; }
  int n() const { return (p() + 1) * (q() + 1); }

  // [x - hx, x + hx] times [y - hy, y + hy].
  struct Cell {
    double x, y, hx, hy;
    int depth;     // halvings
    bool along_x;  // across which way it is to be halved
  };
  enum class Rest { nothing, smaller, halves };

  // Two directions of kSmallestCell each, and then some for clips that leave more than half.
  static constexpr int kDeepest = 96;

  static Pair* workspace(size_t size) {
    // Kept by the thread, so that tracing does not allocate once it is warm.
    thread_local std::vector<Pair> room;
    if (room.size() < size) room.resize(size);
    return room.data();
  }

  // The patch lies in a plane in which the line runs: all pairs of coefficients are multiples of one another. No hit is
  // isolated, and no cell would ever be decided.
  bool runs_in_plane() const {
    if (near_) return false;
    Pair way = pair(0);
    for (int k = 0; k < n(); ++k)
      if (largest_of(magnitude(room_[k])) > largest_of(magnitude(way))) way = room_[k];
    const double e = excludes_ * (std::abs(way[0]) + std::abs(way[1]));
    for (int k = 0; k < n(); ++k)
      if (!(std::abs(way[0] * room_[k][1] - way[1] * room_[k][0]) <= e)) return false;
    return true;
  }

  // All coefficients of one function on one side of zero.
  bool excluded(const Pair* c) const {
    Lanes lo, hi, two;
    load(c, 0, n() - 1, 1, lo);
    hi = lo;
    for (int k = 2; k < n(); k += 2) {
      load(c, k, n() - 1, 1, two);
      lower(lo, two);
      raise(hi, two);
    }
    const double e = excludes_;
    return std::min(lo[0], lo[2]) > e || std::max(hi[0], hi[2]) < -e || std::min(lo[1], lo[3]) > e ||
           std::max(hi[1], hi[3]) < -e;
  }

  // All coefficients on one side of the line through zero along the longer column of the derivatives at the centre:
  // where the line passes beside an outline the functions hardly differ from zero but across that.
  bool excluded_across(const Pair* c, const Jacobian& j) const {
    const Pair x2 = j.x * j.x, y2 = j.y * j.y;
    const Pair way = x2[0] + x2[1] > y2[0] + y2[1] ? j.x : j.y;
    Lanes lo{}, hi{};
    for (int k = 0; k < n(); k += 4) {
      Lanes a, b;
      load(c, k, n() - 1, 1, a);
      load(c, std::min(k + 2, n() - 1), n() - 1, 1, b);
      const Lanes height =
          way[0] * __builtin_shufflevector(a, b, 1, 3, 5, 7) - way[1] * __builtin_shufflevector(a, b, 0, 2, 4, 6);
      if (k == 0) lo = hi = height;
      lower(lo, height);
      raise(hi, height);
    }
    const double e = excludes_ * (std::abs(way[0]) + std::abs(way[1]));
    return std::min(std::min(lo[0], lo[1]), std::min(lo[2], lo[3])) > e ||
           std::max(std::max(hi[0], hi[1]), std::max(hi[2], hi[3])) < -e;
  }

  // Functions and derivatives at the centre.
  Pair center(const Pair* c, Jacobian& j) const {
    const Middle &mx = middle(p()), &my = middle(q());
    Pair f = pair(0);
    j.x = j.y = pair(0);
    for (int k = 0; k <= q(); k += 2) {
      Lanes column{}, slope{}, two;
      for (int i = 0; i <= p(); ++i) {
        load(c + i * (q() + 1), k, q(), 1, two);
        column += mx.value[i] * two;
        slope += mx.slope[i] * two;
      }
      for (int half = 0; half <= (k < q() ? 1 : 0); ++half) {
        const Pair value = half == 0 ? Pair{column[0], column[1]} : Pair{column[2], column[3]};
        f += my.value[k + half] * value;
        j.y += my.slope[k + half] * value;
        j.x += my.value[k + half] * (half == 0 ? Pair{slope[0], slope[1]} : Pair{slope[2], slope[3]});
      }
    }
    return f;
  }

  // The same at any place, by de Casteljau's algorithm across the rows and along what is left.
  Pair at(const Pair* c, double x, double y, Jacobian& j) const {
    const double s = 0.5 * (x + 1), t = 0.5 * (y + 1);
    Pair row[kMaxDegree + 1], slopes[kMaxDegree + 1];
    Lanes work[kMaxDegree + 1], slope;
    for (int k = 0; k <= q(); k += 2) {
      for (int i = 0; i <= p(); ++i) load(c + i * (q() + 1), k, q(), 1, work[i]);
      reduce(work, p(), s, slope);
      store(work[0], row, k, q(), 1);
      store(slope, slopes, k, q(), 1);
    }
    Pair ignored;
    reduce(slopes, q(), t, ignored);
    j.x = slopes[0];
    reduce(row, q(), t, j.y);
    return row[0];
  }
  // The same of the surface itself.
  Pair at_near(const Cell& cell, double x, double y, Jacobian& j) const {
    const PatchPoint p = near_->at(cell.x + cell.hx * x, cell.y + cell.hy * y);
    const Vec3 r = p.point - line_.line.origin;
    j.x = cell.hx * Pair{glm::dot(line_.n1, p.ds), glm::dot(line_.n2, p.ds)};
    j.y = cell.hy * Pair{glm::dot(line_.n1, p.dt), glm::dot(line_.n2, p.dt)};
    return Pair{glm::dot(line_.n1, r), glm::dot(line_.n2, r)};
  }
  // Puts into c[0] the value at s of the polynomial with the given coefficients, which are overwritten; slope by x in
  // [-1, 1].
  template <class V>
  static void reduce(V* c, int n, double s, V& slope) {
    if (n == 0) {
      slope = V{};
      return;
    }
    for (int level = n; level > 1; --level)
      for (int i = 0; i < level; ++i) c[i] += s * (c[i + 1] - c[i]);
    slope = (0.5 * n) * (c[1] - c[0]);
    c[0] += s * (c[1] - c[0]);
  }

  // What is to be known of a cell before it is cut.
  struct Outline {
    double extent_x = 0, extent_y = 0;  // of the two functions over the cell
    double bend_x = 0, bend_y = 0;      // change of the derivative by x along x, by y along y
  };

  // Bounds |E| by rows. `a` and `b` are the columns of J^-1.
  Pair deviation(const Pair* c, const Pair& a, const Pair& b) const {
    Lanes ex{}, ey{}, two, next, a2, b2;
    const auto include = [&](const Lanes& one, Lanes& most) {
      // J^-1 (next - two) - one, of either.
      const Lanes d = next - two;
      Lanes e = __builtin_shufflevector(d, d, 0, 0, 2, 2) * a2 + __builtin_shufflevector(d, d, 1, 1, 3, 3) * b2 - one;
      absolute(e, e);
      raise(most, e);
    };
    twice(0.5 * p() * a, a2), twice(0.5 * p() * b, b2);
    for (int i = 0; i < p(); ++i)
      for (int k = 0; k <= q(); k += 2) {
        load(c + i * (q() + 1), k, q(), 1, two);
        load(c + (i + 1) * (q() + 1), k, q(), 1, next);
        include(Lanes{1, 0, 1, 0}, ex);
      }
    twice(0.5 * q() * a, a2), twice(0.5 * q() * b, b2);
    for (int i = 0; i <= p(); ++i)
      for (int k = 0; k < q(); k += 2) {
        const int from = std::min(k, std::max(q() - 2, 0));  // of an odd number the last two: one comes twice
        load(c + i * (q() + 1), from, q() - 1, 1, two);
        load(c + i * (q() + 1) + 1, from, q() - 1, 1, next);
        include(Lanes{0, 1, 0, 1}, ey);
      }
    return larger_half(ex) + larger_half(ey);
  }

  Outline outline(const Pair* c) const {
    // The largest first and second differences of the lines of coefficients c[0], c[stride], ...
    const auto differences = [](const Pair* line, int lines, int step, int degree, int stride, Lanes& first,
                                Lanes& second) {
      for (int k = 0; k < lines; k += 2) {
        Lanes before, here, d, dd;
        load(line, k, lines - 1, step, here);
        for (int i = 1; i <= degree; ++i) {
          const Lanes last = d;
          before = here;
          load(line + i * stride, k, lines - 1, step, here);
          d = here - before;
          if (i > 1) {
            dd = d - last;
            absolute(dd, dd);
            raise(second, dd);
          }
          Lanes size;
          absolute(d, size);
          raise(first, size);
        }
      }
    };
    Lanes dx{}, dy{}, dxx{}, dyy{};
    differences(c, q() + 1, 1, p(), q() + 1, dx, dxx);
    differences(c, p() + 1, q() + 1, q(), 1, dy, dyy);
    const auto largest = [](const Lanes& a) { return largest_of(larger_half(a)); };
    return {p() * largest(dx), q() * largest(dy), p() * (p() - 1) * largest(dxx), q() * (q() - 1) * largest(dyy)};
  }

  // Newton's iteration in a cell that has one root at most; false if it does not settle. Only where it `contracts` is
  // it is known that there is no root if none is found; then one that `border` allows outside of the cell is taken.
  bool newton(const Pair* c, const Cell& cell, const Pair& first, const Pair& slacks, const Pair& border,
              bool contracts) {
    const double slack = largest_of(slacks);
    const Pair outside = contracts ? larger(pair(slack), border) : pair(slack);
    // The remaining error is of the order of the square of the step, and not below the rounding of points of a surface
    // itself.
    const Pair settles = near_ ? larger(pair(1e-7), 4 * slacks) : pair(1e-7);
    double x = std::clamp(first[0], -1.0, 1.0), y = std::clamp(first[1], -1.0, 1.0);
    bool settled = false;
    const int most = contracts ? 40 : 8;
    for (int iteration = 0; iteration < most; ++iteration) {
      Jacobian j;
      const Pair f = near_ ? at_near(cell, x, y, j) : at(c, x, y, j);
      const double determinant = j.determinant();
      if (determinant == 0) return false;
      const double ex = x - (f[0] * j.y[1] - f[1] * j.y[0]) / determinant;
      const double ey = y - (j.x[0] * f[1] - j.x[1] * f[0]) / determinant;
      const double nx = std::clamp(ex, -1.0, 1.0), ny = std::clamp(ey, -1.0, 1.0);
      // A root lies within the contraction factor times the way still to go, at most the cell's width 2, of the step's
      // end: a step that ends farther outside means none.
      constexpr double farthest = 1 + 2 * (2 * kContraction / (1 - kContraction));
      if (std::abs(ex) > farthest + outside[0] || std::abs(ey) > farthest + outside[1]) return contracts;
      if (std::abs(nx - x) < settles[0] && std::abs(ny - y) < settles[1]) {
        // What the projection cut off must be rounding, or the slack.
        if (std::abs(ex - nx) <= outside[0] && std::abs(ey - ny) <= outside[1]) {
          const double size = std::max(cell.hx, cell.hy);
          double root_x = cell.x + cell.hx * nx, root_y = cell.y + cell.hy * ny;
          // Where weights differ much the surface runs that much faster somewhere.
          if (!near_ && (slack - kBorderSlack) * size * unevenness_ > kSameHit)
            settle_on_surface(root_x, root_y, slack * size, kSameHit);
          add(root_x, root_y, 4 * slack * size);
          return true;
        }
        if (!contracts) return false;
        if (settled) return true;
        settled = true;
      }
      x = nx;
      y = ny;
    }
    return false;
  }

  PatchPoint surface_at(double x, double y) const {
    PatchPoint p = evaluate(patch_, 0.5 * (place_.x + place_.hx * x + 1), 0.5 * (place_.y + place_.hy * y + 1));
    p.ds *= 0.5 * place_.hx;
    p.dt *= 0.5 * place_.hy;
    return p;
  }
  double along(const Vec3& point) const {
    return glm::dot(point - line_.line.origin, line_.line.direction) * line_.inverse_length2;
  }

  Vec2 across(const Vec3& point) const {
    const Vec3 from = point - line_.line.origin;
    return {glm::dot(line_.n1, from), glm::dot(line_.n2, from)};
  }
  // Where weights differ much the coefficients are known too badly to tell a plain root, which the surface's own points
  // do: Newton's iteration on these, kept in the cell that was asked but for `outside`. False, and the place as it was,
  // if it does not settle.
  // `noise`: what the rounding of the points moves the place by, at least kSameHit.
  bool settle_on_surface(double& root_x, double& root_y, double outside, double noise) const {
    constexpr int kMaxSteps = 30;
    double x = root_x, y = root_y;
    for (int step = 0; step < kMaxSteps; ++step) {
      const PatchPoint at = surface_at(x, y);
      const Vec2 f = across(at.point), a(glm::dot(line_.n1, at.ds), glm::dot(line_.n2, at.ds)),
                 b(glm::dot(line_.n1, at.dt), glm::dot(line_.n2, at.dt));
      const double determinant = a.x * b.y - a.y * b.x;
      if (!(std::abs(determinant) > 1e-6 * glm::length(a) * glm::length(b))) return false;
      const double sx = (b.x * f.y - b.y * f.x) / determinant, sy = (a.y * f.x - a.x * f.y) / determinant;
      x += sx, y += sy;
      if (!(std::max(std::abs(x), std::abs(y)) <= 1 + kBorderSlack + outside)) return false;
      // With the whole patch for a cell its points' own rounding moves the root by some 1e-11.
      if (std::max(std::abs(sx), std::abs(sy)) <= noise) {
        root_x = x, root_y = y;
        return true;
      }
    }
    return false;
  }

  // Cells with a common border may both find a root on it.
  void add(double x, double y, double near) {
    near = std::max(near, 4 * kBorderSlack);
    for (int i = 0; i < hits_.size(); ++i)
      if (std::abs(hits_[i].x - x) <= near && std::abs(hits_[i].y - y) <= near) return;
    hits_.add({along(near_ ? near_->at(x, y).point : surface_at(x, y).point), x, y});
  }

  // What is left of a cell that cannot be decided. Cells around a singular point differ in the parameter that does not
  // matter there.
  void leave(const Cell& cell) {
    if (near_)
      near_->undecided(cell.x, cell.y, cell.hx, cell.hy);
    else
      add_if_singular(cell.x, cell.y);
  }
  void add_if_singular(double x, double y) {
    // Bounds on the extent mean little where weights differ much.
    Box3 hull;
    for (int k = 0; k < n(); ++k) hull.include(Vec3(patch_.points[k]) / patch_.points[k].w);
    const double size = std::min(whole_.x + whole_.y, hull.diameter());
    if (allowance_ > kBorderSlack * size * min_weight_ && settle_on_surface(x, y, 0, kSameHit)) {
      add(x, y, 10 * kSameHit);
      return;
    }
    const PatchPoint at = surface_at(x, y);
    const double lx = glm::length(at.ds), ly = glm::length(at.dt);
    if (!(lx <= 1e-6 * std::min(whole_.x, size) || ly <= 1e-6 * std::min(whole_.y, size) ||
          glm::length(glm::cross(at.ds, at.dt)) <= 1e-6 * lx * ly)) {
      add_if_crossed(at, x, y);
      return;
    }
    if (!(glm::length(across(at.point)) <= kSameHit * size)) return;
    const double t = along(at.point);
    const double near = 1e-9 * size * std::sqrt(line_.inverse_length2);
    for (int i = 0; i < hits_.size(); ++i)
      if (std::abs(hits_[i].t - t) <= near) return;
    hits_.add({t, x, y});
  }

  // Beside a line along which a derivative vanishes the other one is short, and rounding moves a root far in
  // parameters, but not in space. A tangent, which is undecided too, has a short derivative across the line alone.
  void add_if_crossed(const PatchPoint& at, double x, double y) {
    constexpr double kMaxNoise = 1e-3;
    const auto steepness = [&](const PatchPoint& p) {
      const Vec3 across = glm::cross(p.ds, p.dt);
      return std::abs(glm::dot(across, line_.line.direction)) * std::sqrt(line_.inverse_length2) /
             (glm::length(p.ds) * glm::length(p.dt));
    };
    const double noise =
        std::max(kSameHit, 8 * allowance_ / (min_weight_ * std::min(glm::length(at.ds), glm::length(at.dt))));
    if (!(noise <= kMaxNoise) || !(steepness(at) > 1e-6) || !settle_on_surface(x, y, noise, noise) ||
        !(steepness(surface_at(x, y)) > 1e-6))
      return;
    add(x, y, 10 * noise);
  }

  // Keeps the part of [-1, 1] of a row of coefficients from x on, or up to x.
  static void keep_after(Lanes* c, int n, double x) {
    const double s = 0.5 * (x + 1);
    for (int level = n; level > 0; --level)
      for (int i = 0; i < level; ++i) c[i] += s * (c[i + 1] - c[i]);
  }
  static void keep_before(Lanes* c, int n, double x) {
    const double s = 0.5 * (x + 1);
    for (int level = 1; level <= n; ++level)
      for (int i = n; i >= level; --i) c[i] = c[i - 1] + s * (c[i] - c[i - 1]);
  }
  // Of `lines` rows of coefficients c[0], c[stride], ... `step` apart.
  static void clip(Pair* c, int lines, int step, int n, int stride, double lo, double hi) {
    Lanes work[kMaxDegree + 1];
    for (int k = 0; k < lines; k += 2) {
      for (int i = 0; i <= n; ++i) load(c + i * stride, k, lines - 1, step, work[i]);
      if (hi < 1) keep_before(work, n, hi);
      if (lo > -1) keep_after(work, n, hi < 1 ? 2 * (lo + 1) / (hi + 1) - 1 : lo);
      for (int i = 0; i <= n; ++i) store(work[i], c + i * stride, k, lines - 1, step);
    }
  }
  void clip_x(Pair* c, double lo, double hi) const { clip(c, q() + 1, 1, p(), q() + 1, lo, hi); }
  void clip_y(Pair* c, double lo, double hi) const { clip(c, p() + 1, q() + 1, q(), 1, lo, hi); }

  // First half stays in c, second goes to `other`.
  static void halve(Pair* c, int lines, int step, int n, int stride, Pair* other) {
    Lanes work[kMaxDegree + 1];
    for (int k = 0; k < lines; k += 2) {
      for (int i = 0; i <= n; ++i) load(c + i * stride, k, lines - 1, step, work[i]);
      store(work[n], other + n * stride, k, lines - 1, step);
      for (int level = 1; level <= n; ++level) {
        for (int i = n; i >= level; --i) work[i] = 0.5 * (work[i - 1] + work[i]);
        store(work[n], other + (n - level) * stride, k, lines - 1, step);
      }
      for (int i = 0; i <= n; ++i) store(work[i], c + i * stride, k, lines - 1, step);
    }
  }
  void halve_x(Pair* c, Pair* other) const { halve(c, q() + 1, 1, p(), q() + 1, other); }
  void halve_y(Pair* c, Pair* other) const { halve(c, p() + 1, q() + 1, q(), 1, other); }

  // Finds the root of a cell with its coefficients in c, or that there is none; or makes the cell smaller; or says how
  // it is to be halved.
  Rest treat(Pair* c, Cell& cell) {
    if (++cells_ > kMaxCells || excluded(c)) return Rest::nothing;
    Jacobian j;
    const Pair f = center(c, j);
    const double determinant = j.determinant();
    Pair slack = pair(kBorderSlack);  // how far rounding moves a root, as a part of the cell
    if (determinant != 0) {
      const double inverse = 1 / determinant;
      const Pair a{j.y[1] * inverse, -j.x[1] * inverse}, b{-j.y[0] * inverse, j.x[0] * inverse};
      const Pair root = -(f[0] * a + f[1] * b);
      const Pair sizes = magnitude(a) + magnitude(b), unknown = allowance_ * sizes;
      const Pair border = near_ ? Pair{near_->slack_x / cell.hx, near_->slack_y / cell.hy} : pair(kBorderSlack);
      const Pair uncertain = unknown + border;
      Pair e = deviation(c, a, b);
      if (near_) e += sizes * (cell.hx * near_->off_x + cell.hy * near_->off_y);
      slack += rounding_ * sizes;
      const Pair lo = root - e - uncertain, hi = root + e + uncertain;
      if (lo[0] > 1 || lo[1] > 1 || hi[0] < -1 || hi[1] < -1) return Rest::nothing;
      const double worst = largest_of(slack);
      const bool contracts = e[0] <= kContraction && e[1] <= kContraction;
      if (e[0] <= kInjective && e[1] <= kInjective && worst < kMaxRounding &&
          newton(c, cell, root, slack, border, contracts))
        return Rest::nothing;
      if (near_ && largest_of(unknown) > kTooWide) {
        near_->undecided(cell.x, cell.y, cell.hx, cell.hy);
        return Rest::nothing;
      }
      if (!contracts) {
        if (excluded_across(c, j)) return Rest::nothing;
        if (clip_to(root, larger(e + uncertain, slack / (0.25 * kMaxRounding)), c, cell)) {
          if (std::max(cell.hx, cell.hy) >= kSmallestCell) return Rest::smaller;
          leave(cell);
          return Rest::nothing;
        }
      }
    }
    const Outline o = outline(c);
    if (cell.depth == kDeepest || std::max(cell.hx, cell.hy) < kSmallestCell ||
        std::max(o.extent_x, o.extent_y) <= 4 * allowance_) {
      leave(cell);
      return Rest::nothing;
    }
    // Across the direction in which the functions bend most; where that is neither (at a pole the sectors of a cap
    // never become simpler by being made narrower), across the longer one.
    const bool bent = std::max(o.bend_x, o.bend_y) > 0.5 * std::min(o.extent_x, o.extent_y);
    cell.along_x = bent ? o.bend_x >= o.bend_y : o.extent_x >= o.extent_y;
    // Unless rounding has the last word there already, and not in the other one. (At the centre alone it may have it:
    // on a cusp a derivative vanishes, and the determinant is nothing but rounding.)
    const auto is_spent = [&](bool along_x) {
      return slack[along_x ? 0 : 1] > 0.5 * kMaxRounding &&
             rounding_ > 0.5 * kMaxRounding * (along_x ? o.extent_x : o.extent_y);
    };
    if (is_spent(cell.along_x) && !is_spent(!cell.along_x)) cell.along_x = !cell.along_x;
    return Rest::halves;
  }

  // Cuts away what is farther from a place than `reach`, if that leaves little.
  bool clip_to(const Pair& place, const Pair& reach, Pair* c, Cell& cell) const {
    const double lo_x = std::max(-1.0, place[0] - reach[0]), hi_x = std::min(1.0, place[0] + reach[0]);
    const double lo_y = std::max(-1.0, place[1] - reach[1]), hi_y = std::min(1.0, place[1] + reach[1]);
    if (!(0.5 * std::min(hi_x - lo_x, hi_y - lo_y) < kWorthClipping)) return false;
    if (hi_x - lo_x < 2 * 0.95) {
      clip_x(c, lo_x, hi_x);
      cell.x += 0.5 * cell.hx * (lo_x + hi_x);
      cell.hx *= 0.5 * (hi_x - lo_x);
    }
    if (hi_y - lo_y < 2 * 0.95) {
      clip_y(c, lo_y, hi_y);
      cell.y += 0.5 * cell.hy * (lo_y + hi_y);
      cell.hy *= 0.5 * (hi_y - lo_y);
    }
    return true;
  }

  // The first half stays, the second is returned, with its coefficients behind the first one's.
  Cell halve(Pair* c, Cell& cell) const {
    ++cell.depth;
    Cell second = cell;
    if (cell.along_x) {
      halve_x(c, c + n());
      cell.hx = second.hx = 0.5 * cell.hx;
      second.x += cell.hx, cell.x -= cell.hx;
    } else {
      halve_y(c, c + n());
      cell.hy = second.hy = 0.5 * cell.hy;
      second.y += cell.hy, cell.y -= cell.hy;
    }
    return second;
  }

  const PatchView& patch_;
  CellPlace place_;
  Vec2 whole_;
  NearSurface* near_;  // nullptr: the patch stands for itself
  const LineBasis& line_;
  CellHits& hits_;
  Pair* room_;
  double rounding_ = 0;   // of the functions
  double allowance_ = 0;  // with the distance of the surface that the patch stands for
  double excludes_ = 0;   // and the slack at its border
  int cells_ = 0;
  double min_weight_ = 1;
  double unevenness_ = 1;  // of the weights: the largest by the least
};

LEKALO_WIDE void search_bicubic(const PatchView& patch, const CellPlace& place, const Vec2& reach, NearSurface* near,
                                const LineBasis& line, CellHits& hits) {
  NetSearch<3, 3>(patch, place, reach, near, line, hits).run();
}
LEKALO_WIDE void search_fitted(const PatchView& patch, const CellPlace& place, const Vec2& reach, const LineBasis& line,
                               CellHits& hits) {
  NetSearch<7, 7>(patch, place, reach, nullptr, line, hits).run();
}

}  // namespace

void search_net(const PatchView& patch, const CellPlace& place, double reach_x, double reach_y, const LineBasis& line,
                CellHits& hits) {
  const Vec2 reach(reach_x, reach_y);
  for_degrees(patch, [&]<int kP, int kQ>() {
    if constexpr (kP == 3 && kQ == 3)
      search_bicubic(patch, place, reach, nullptr, line, hits);
    else if constexpr (kP == 7 && kQ == 7)
      search_fitted(patch, place, reach, line, hits);
    else
      NetSearch<kP ? kP : kAnyDegree, kQ ? kQ : kAnyDegree>(patch, place, reach, nullptr, line, hits).run();
  });
}

void search_net(const PatchView& patch, NearSurface& near, const LineBasis& line, CellHits& hits) {
  search_bicubic(patch, {}, Vec2(0), &near, line, hits);
}

}  // namespace lekalo::geometry
