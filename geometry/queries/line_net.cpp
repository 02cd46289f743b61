#include "geometry/queries/line_net.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/curves/bspline_basis.h"
#include "geometry/queries/bezier_sums.h"
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
constexpr int kMostCells = 20000;

// A cell is clipped rather than halved where that leaves less of one side than this.
constexpr double kWorthClipping = 0.7;

// Newton's iteration is trusted in cells in which rounding moves roots by less than this part, and cells are not made
// so small that it moves them more: a line along a parameter line is soon known across it, long before it is along it.
constexpr double kMostRounding = 1e-3;

// Ratio of the weights of a patch from which on it is worth while to know what rounding does in the cell alone.
constexpr double kUneven = 8;

// A cell in which the bound of a patch's distance from its surface moves roots by more than this part is left to a
// better patch.
constexpr double kTooWide = 0.25;

// Two doubles side by side, (f, g) of a control point.
using Pair = double __attribute__((vector_size(16)));

Pair pair(double a) { return Pair{a, a}; }
Pair larger(Pair a, Pair b) { return a > b ? a : b; }
Pair smaller(Pair a, Pair b) { return a < b ? a : b; }
Pair magnitude(Pair a) {
  using Bits = int64_t __attribute__((vector_size(16)));
  constexpr int64_t kAllButSign = std::numeric_limits<int64_t>::max();
  return (Pair)((Bits)a & Bits{kAllButSign, kAllButSign});
}
double largest_of(Pair a) { return std::max(a[0], a[1]); }

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
    double least_weight = kInfinity, most_weight = 0;
    for (int k = 0; k < n(); ++k) {
      const Vec4& c = patch.points[k];
      const Vec3 r = Vec3(c) - c.w * line.line.origin;
      room_[k] = Pair{glm::dot(line.n1, r), glm::dot(line.n2, r)};
      const double size = std::abs(r.x) + std::abs(r.y) + std::abs(r.z);
      room_[n() + k] = pair(size);
      rounding_ = std::max(rounding_, size);
      least_weight = std::min(least_weight, c.w);
      most_weight = std::max(most_weight, c.w);
    }
    const auto clip = [&](Pair* c) {
      clip_x(c, place.x - place.hx, place.x + place.hx);
      clip_y(c, place.y - place.hy, place.y + place.hy);
    };
    clip(room_);
    // A coefficient is wrong by a few roundings of the terms that made it, and of the averages that clipping and
    // halving take; the same averages of the terms' sizes bound that. Where weights differ much they are far smaller
    // here than elsewhere in the patch.
    if (most_weight > kUneven * least_weight) {
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

  void run() { visit(room_, 0, 0, 1, 1, 0); }

 private:
  int p() const { return kP == kAnyDegree ? patch_.degree_u : kP; }
  int q() const { return kQ == kAnyDegree ? patch_.degree_v : kQ; }
  int n() const { return (p() + 1) * (q() + 1); }

  // Two directions of kSmallestCell each, and then some for clips that leave more than half.
  static constexpr int kDeepest = 96;

  static Pair* workspace(size_t size) {
    // Kept by the thread, so that tracing does not allocate once it is warm.
    thread_local std::vector<Pair> room;
    if (room.size() < size) room.resize(size);
    return room.data();
  }

  // All coefficients of one function on one side of zero.
  bool excluded(const Pair* c) const {
    Pair lo = c[0], hi = c[0];
    for (int k = 1; k < n(); ++k) {
      lo = smaller(lo, c[k]);
      hi = larger(hi, c[k]);
    }
    const double e = excludes_;
    return lo[0] > e || hi[0] < -e || lo[1] > e || hi[1] < -e;
  }

  // Functions and derivatives at the centre.
  Pair center(const Pair* c, Jacobian& j) const {
    const Middle &mx = middle(p()), &my = middle(q());
    Pair f = pair(0);
    j.x = j.y = pair(0);
    for (int i = 0; i <= p(); ++i, c += q() + 1) {
      Pair row = pair(0), slope = pair(0);
      for (int k = 0; k <= q(); ++k) {
        row += my.value[k] * c[k];
        slope += my.slope[k] * c[k];
      }
      f += mx.value[i] * row;
      j.x += mx.slope[i] * row;
      j.y += mx.value[i] * slope;
    }
    return f;
  }

  // The same at any place, by de Casteljau's algorithm along the rows and across.
  Pair at(const Pair* c, double x, double y, Jacobian& j) const {
    const double s = 0.5 * (x + 1), t = 0.5 * (y + 1);
    Pair rows[kMaxDegree + 1], slopes[kMaxDegree + 1], work[kMaxDegree + 1];
    for (int i = 0; i <= p(); ++i, c += q() + 1) {
      for (int k = 0; k <= q(); ++k) work[k] = c[k];
      rows[i] = reduce(work, q(), t, slopes[i]);
    }
    Pair ignored;
    j.y = reduce(slopes, p(), s, ignored);
    return reduce(rows, p(), s, j.x);
  }
  // The same of the surface itself.
  Pair at_near(double x0, double y0, double hx, double hy, double x, double y, Jacobian& j) const {
    const PatchPoint p = near_->at(x0 + hx * x, y0 + hy * y);
    const Vec3 r = p.point - line_.line.origin;
    j.x = hx * Pair{glm::dot(line_.n1, p.ds), glm::dot(line_.n2, p.ds)};
    j.y = hy * Pair{glm::dot(line_.n1, p.dt), glm::dot(line_.n2, p.dt)};
    return Pair{glm::dot(line_.n1, r), glm::dot(line_.n2, r)};
  }
  // Value at s of the polynomial with the given coefficients, which are overwritten; slope by x in [-1, 1].
  static Pair reduce(Pair* c, int n, double s, Pair& slope) {
    if (n == 0) {
      slope = pair(0);
      return c[0];
    }
    for (int level = n; level > 1; --level)
      for (int i = 0; i < level; ++i) c[i] += s * (c[i + 1] - c[i]);
    slope = (0.5 * n) * (c[1] - c[0]);
    return c[0] + s * (c[1] - c[0]);
  }

  // What is to be known of a cell before it is cut.
  struct Outline {
    double extent_x = 0, extent_y = 0;  // of the two functions over the cell
    double bend_x = 0, bend_y = 0;      // change of the derivative by x along x, by y along y
  };

  // Bounds |E| by rows (returned), and the outline. `a` and `b` are the columns of J^-1.
  Pair deviation(const Pair* c, const Pair& a, const Pair& b) const {
    Pair ex = pair(0), ey = pair(0);
    const double hp = 0.5 * p(), hq = 0.5 * q();
    for (int i = 0; i <= p(); ++i)
      for (int k = 0; k <= q(); ++k) {
        const Pair& here = c[i * (q() + 1) + k];
        if (i < p()) {
          const Pair d = hp * (c[(i + 1) * (q() + 1) + k] - here);
          ex = larger(ex, magnitude(d[0] * a + d[1] * b - Pair{1, 0}));
        }
        if (k < q()) {
          const Pair d = hq * (c[i * (q() + 1) + k + 1] - here);
          ey = larger(ey, magnitude(d[0] * a + d[1] * b - Pair{0, 1}));
        }
      }
    return ex + ey;
  }

  Outline outline(const Pair* c) const {
    Pair dx = pair(0), dy = pair(0), dxx = pair(0), dyy = pair(0);
    for (int i = 0; i <= p(); ++i)
      for (int k = 0; k <= q(); ++k) {
        const Pair* here = c + i * (q() + 1) + k;
        if (i < p()) dx = larger(dx, magnitude(here[q() + 1] - here[0]));
        if (k < q()) dy = larger(dy, magnitude(here[1] - here[0]));
        if (i > 0 && i < p()) dxx = larger(dxx, magnitude(here[q() + 1] - 2 * here[0] + here[-(q() + 1)]));
        if (k > 0 && k < q()) dyy = larger(dyy, magnitude(here[1] - 2 * here[0] + here[-1]));
      }
    return {p() * largest_of(dx), q() * largest_of(dy), p() * (p() - 1) * largest_of(dxx),
            q() * (q() - 1) * largest_of(dyy)};
  }

  // Newton's iteration in a cell that has one root at most; false if it does not settle. Only where it `contracts` is
  // it is known that there is no root if none is found; then one that `border` allows outside of the cell is taken.
  bool newton(const Pair* c, double x0, double y0, double hx, double hy, const Pair& first, const Pair& slacks,
              const Pair& border, bool contracts) {
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
      const Pair f = near_ ? at_near(x0, y0, hx, hy, x, y, j) : at(c, x, y, j);
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
          add(x0 + hx * nx, y0 + hy * ny, 4 * slack * std::max(hx, hy));
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
    p.ds *= place_.hx;
    p.dt *= place_.hy;
    return p;
  }
  double along(const Vec3& point) const {
    return glm::dot(point - line_.line.origin, line_.line.direction) * line_.inverse_length2;
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
  void leave(double x, double y, double hx, double hy) {
    if (near_)
      near_->undecided(x, y, hx, hy);
    else
      add_if_singular(x, y);
  }
  void add_if_singular(double x, double y) {
    const PatchPoint at = surface_at(x, y);
    const double lx = glm::length(at.ds), ly = glm::length(at.dt);
    if (!(lx <= 1e-6 * whole_.x || ly <= 1e-6 * whole_.y || glm::length(glm::cross(at.ds, at.dt)) <= 1e-6 * lx * ly))
      return;
    const double t = along(at.point);
    const double size = whole_.x + whole_.y;
    const double near = size < kInfinity ? 1e-9 * size * std::sqrt(line_.inverse_length2) : 0;
    for (int i = 0; i < hits_.size(); ++i)
      if (std::abs(hits_[i].t - t) <= near) return;
    hits_.add({t, x, y});
  }

  // Keeps the part of [-1, 1] of a row of coefficients from x on, or up to x.
  static void keep_after(Pair* c, int n, int stride, double x) {
    const double s = 0.5 * (x + 1);
    for (int level = n; level > 0; --level)
      for (int i = 0; i < level; ++i) c[i * stride] += s * (c[(i + 1) * stride] - c[i * stride]);
  }
  static void keep_before(Pair* c, int n, int stride, double x) {
    const double s = 0.5 * (x + 1);
    for (int level = 1; level <= n; ++level)
      for (int i = n; i >= level; --i) c[i * stride] = c[(i - 1) * stride] + s * (c[i * stride] - c[(i - 1) * stride]);
  }
  void clip_x(Pair* c, double lo, double hi) const {
    for (int k = 0; k <= q(); ++k) {
      if (hi < 1) keep_before(c + k, p(), q() + 1, hi);
      if (lo > -1) keep_after(c + k, p(), q() + 1, hi < 1 ? 2 * (lo + 1) / (hi + 1) - 1 : lo);
    }
  }
  void clip_y(Pair* c, double lo, double hi) const {
    for (int i = 0; i <= p(); ++i) {
      Pair* row = c + i * (q() + 1);
      if (hi < 1) keep_before(row, q(), 1, hi);
      if (lo > -1) keep_after(row, q(), 1, hi < 1 ? 2 * (lo + 1) / (hi + 1) - 1 : lo);
    }
  }

  // First half stays in c, second goes to `other`.
  void halve_x(Pair* c, Pair* other) const {
    for (int k = 0; k <= q(); ++k) halve_row(c + k, p(), q() + 1, other + k);
  }
  void halve_y(Pair* c, Pair* other) const {
    for (int i = 0; i <= p(); ++i) halve_row(c + i * (q() + 1), q(), 1, other + i * (q() + 1));
  }
  static void halve_row(Pair* c, int n, int stride, Pair* other) {
    other[n * stride] = c[n * stride];
    for (int level = 1; level <= n; ++level) {
      for (int i = n; i >= level; --i) c[i * stride] = 0.5 * (c[(i - 1) * stride] + c[i * stride]);
      other[(n - level) * stride] = c[n * stride];
    }
  }

  // A cell with its coefficients in c; what lies behind them is free for its parts.
  void visit(Pair* c, double x0, double y0, double hx, double hy, int depth) {
    for (;;) {
      if (++cells_ > kMostCells || excluded(c)) return;
      Jacobian j;
      const Pair f = center(c, j);
      const double determinant = j.determinant();
      Pair slack = pair(kBorderSlack);  // how far rounding moves a root, as a part of the cell
      double clip = 1;                  // part of the cell that a clip leaves
      if (determinant != 0) {
        const double inverse = 1 / determinant;
        const Pair a{j.y[1] * inverse, -j.x[1] * inverse}, b{-j.y[0] * inverse, j.x[0] * inverse};
        const Pair root = -(f[0] * a + f[1] * b);
        const Pair sizes = magnitude(a) + magnitude(b), unknown = allowance_ * sizes;
        const Pair border = near_ ? Pair{near_->slack_x / hx, near_->slack_y / hy} : pair(kBorderSlack);
        const Pair uncertain = unknown + border;
        Pair e = deviation(c, a, b);
        if (near_) e += sizes * (hx * near_->off_x + hy * near_->off_y);
        slack += rounding_ * sizes;
        const Pair lo = root - e - uncertain, hi = root + e + uncertain;
        if (lo[0] > 1 || lo[1] > 1 || hi[0] < -1 || hi[1] < -1) return;
        const double worst = std::fmax(slack[0], slack[1]);
        const bool contracts = e[0] <= kContraction && e[1] <= kContraction;
        if (e[0] <= kInjective && e[1] <= kInjective && worst < kMostRounding &&
            newton(c, x0, y0, hx, hy, root, slack, border, contracts))
          return;
        if (near_ && largest_of(unknown) > kTooWide) {
          near_->undecided(x0, y0, hx, hy);
          return;
        }
        if (!contracts) {
          const Pair reach = larger(e + uncertain, slack / (0.25 * kMostRounding));
          const double lo_x = std::fmax(root[0] - reach[0], -1), hi_x = std::fmin(root[0] + reach[0], 1);
          const double lo_y = std::fmax(root[1] - reach[1], -1), hi_y = std::fmin(root[1] + reach[1], 1);
          clip = 0.5 * std::fmin(hi_x - lo_x, hi_y - lo_y);
          if (clip < kWorthClipping) {
            if (hi_x - lo_x < 2 * 0.95) {
              clip_x(c, lo_x, hi_x);
              x0 += 0.5 * hx * (lo_x + hi_x);
              hx *= 0.5 * (hi_x - lo_x);
            }
            if (hi_y - lo_y < 2 * 0.95) {
              clip_y(c, lo_y, hi_y);
              y0 += 0.5 * hy * (lo_y + hi_y);
              hy *= 0.5 * (hi_y - lo_y);
            }
            if (std::max(hx, hy) < kSmallestCell) {
              leave(x0, y0, hx, hy);
              return;
            }
            continue;
          }
        }
      }
      const Outline o = outline(c);
      if (depth == kDeepest || std::max(hx, hy) < kSmallestCell || std::max(o.extent_x, o.extent_y) <= 4 * allowance_) {
        leave(x0, y0, hx, hy);
        return;
      }
      // Across the direction in which the functions bend most; where that is neither (at a pole the sectors of a cap
      // never become simpler by being made narrower), across the longer one.
      const bool bent = std::max(o.bend_x, o.bend_y) > 0.5 * std::min(o.extent_x, o.extent_y);
      bool along_x = bent ? o.bend_x >= o.bend_y : o.extent_x >= o.extent_y;
      // Unless rounding has the last word there already, and not in the other one.
      if (slack[along_x ? 0 : 1] > 0.5 * kMostRounding && slack[along_x ? 1 : 0] <= 0.5 * kMostRounding)
        along_x = !along_x;
      Pair* other = c + n();
      if (along_x) {
        halve_x(c, other);
        hx *= 0.5;
        visit(other, x0 + hx, y0, hx, hy, depth + 1);
        x0 -= hx;
      } else {
        halve_y(c, other);
        hy *= 0.5;
        visit(other, x0, y0 + hy, hx, hy, depth + 1);
        y0 -= hy;
      }
      ++depth;
    }
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
};

}  // namespace

void search_net(const PatchView& patch, const CellPlace& place, double reach_x, double reach_y, const LineBasis& line,
                CellHits& hits) {
  const Vec2 reach(reach_x, reach_y);
  for_degrees(patch, [&]<int kP, int kQ>() {
    NetSearch<kP ? kP : kAnyDegree, kQ ? kQ : kAnyDegree>(patch, place, reach, nullptr, line, hits).run();
  });
}

void search_net(const PatchView& patch, NearSurface& near, const LineBasis& line, CellHits& hits) {
  NetSearch<3, 3>(patch, {}, Vec2(0), &near, line, hits).run();
}

}  // namespace lekalo::geometry
