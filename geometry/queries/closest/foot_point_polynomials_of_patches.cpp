// The second half of foot_point_polynomials.h: patches.
#include <algorithm>
#include <cmath>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"
#include "geometry/queries/closest/foot_point_polynomials.h"

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxHalvings = 12;  // in each direction
constexpr int kMaxCells = 1000, kMaxUndecided = 100;
constexpr double kOneToOne = 0.9;
constexpr double kTells = 3;     // a sum of |I - C J| with which Krawczyk's operator may exclude a cell
constexpr int kMaxColumns = 20;  // 3 * 6 + 1, to a multiple of four
static_assert(3 * FootPointPolynomials::kMaxDegree + 1 <= kMaxColumns);

using Net = FootPointPolynomials::Net;

double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

// --- the making of the nets, in scaled form: coefficients times binomials

Net operator*(const Net& a, const Net& b) {
  Net r{a.rows + b.rows - 1, a.columns + b.columns - 1, {}};
  r.values.assign(static_cast<size_t>(r.rows) * r.columns, 0.0);
  for (int i = 0; i < a.rows; ++i)
    for (int j = 0; j < a.columns; ++j) {
      const double x = a.values[i * a.columns + j];
      for (int k = 0; k < b.rows; ++k)
        for (int l = 0; l < b.columns; ++l) r.values[(i + k) * r.columns + j + l] += x * b.values[k * b.columns + l];
    }
  return r;
}

Net derivative(const Net& a, bool by_u) {
  Net r{a.rows - (by_u ? 1 : 0), a.columns - (by_u ? 0 : 1), {}};
  const int n = (by_u ? a.rows : a.columns) - 1;
  for (int i = 0; i < r.rows; ++i)
    for (int j = 0; j < r.columns; ++j) {
      const int k = by_u ? i : j;
      const double next = a.values[(i + by_u) * a.columns + j + !by_u], here = a.values[i * a.columns + j];
      r.values.push_back(n * binomial(n - 1, k) * (next / binomial(n, k + 1) - here / binomial(n, k)));
    }
  return r;
}

// Coefficients from scaled ones, elevated to so many columns.
Net finished(const Net& a, int columns) {
  Net ones{1, columns - a.columns + 1, {}};
  for (int j = 0; j < ones.columns; ++j) ones.values.push_back(binomial(ones.columns - 1, j));
  Net r = a * ones;
  for (int i = 0; i < r.rows; ++i)
    for (int j = 0; j < r.columns; ++j)
      r.values[i * r.columns + j] /= binomial(r.rows - 1, i) * binomial(r.columns - 1, j);
  return r;
}

// --- the search

struct Range {
  double lo, hi;
  double middle() const { return 0.5 * (lo + hi); }
  double radius() const { return 0.5 * (hi - lo); }
};

struct Bounds {
  Range value, by_x, by_y;
};

inline void load(const double* p, Lanes& lanes) { std::memcpy(&lanes, p, sizeof lanes); }
inline void store(const Lanes& lanes, double* p) { std::memcpy(p, &lanes, sizeof lanes); }
inline void load_difference(const double* a, const double* b, Lanes& lanes) {
  Lanes other;
  load(a, lanes), load(b, other);
  lanes -= other;
}
void min_and_most(const Lanes& x, Lanes& least, Lanes& most) {
  least = x < least ? x : least;
  most = x > most ? x : most;
}
Range across(const Lanes& least, const Lanes& most, double by) {
  return {by * std::min(std::min(least[0], least[1]), std::min(least[2], least[3])),
          by * std::max(std::max(most[0], most[1]), std::max(most[2], most[3]))};
}

LEKALO_WIDE Range values_of(const double* b, int rows, int columns) {
  Lanes least, most, x;
  load(b, least), most = least;
  for (int k = 4; k < rows * columns; k += 4) load(b + k, x), min_and_most(x, least, most);
  return across(least, most, 1);
}

// Derivatives by the unit square's parameters.
LEKALO_WIDE void slopes_of(const double* b, int rows, int columns, Bounds& bounds) {
  Lanes least{}, most{}, x;
  for (int k = 0; k < (rows - 1) * columns; k += 4) {
    load_difference(b + k + columns, b + k, x);
    if (k == 0) least = most = x;
    min_and_most(x, least, most);
  }
  bounds.by_x = across(least, most, rows - 1);
  load_difference(b + 1, b, x);
  least = most = x;
  // The last four differences of a row overlap those before.
  for (int i = 0; i < rows; ++i, b += columns)
    for (int j = 0; j < columns - 1; j += 4) {
      const double* at = b + std::min(j, columns - 5);
      load_difference(at + 1, at, x);
      min_and_most(x, least, most);
    }
  bounds.by_y = across(least, most, columns - 1);
}

// The matrices that halve a row, [from][to].
struct Halving {
  std::array<std::array<double, kMaxColumns>, kMaxColumns> lower{}, upper{};
  explicit Halving(int columns) {
    for (int to = 0; to < columns; ++to)
      for (int from = 0; from <= to; ++from)
        upper[columns - 1 - from][columns - 1 - to] = lower[from][to] = std::ldexp(binomial(to, from), -to);
  }
};
const Halving& halving_of(int columns) {
  static const std::array<Halving, 4> all = {Halving(8), Halving(12), Halving(16), Halving(20)};
  return all[columns / 4 - 2];
}

// `upper` may be b itself.
LEKALO_WIDE void halve_rows(const double* b, int rows, int columns, double* lower, double* upper) {
  if (upper != b) std::memcpy(upper, b, sizeof(double) * rows * columns);
  for (int k = 0; k < rows; ++k) {
    std::memcpy(lower + k * columns, upper, sizeof(double) * columns);
    for (int at_end = (rows - 1 - k) * columns, i = 0; i < at_end; i += 4) {
      Lanes here, next;
      load(upper + i, here), load(upper + i + columns, next);
      store(0.5 * (here + next), upper + i);
    }
  }
}
LEKALO_WIDE void halve_columns(const double* b, int rows, int columns, const Halving& by, double* lower,
                               double* upper) {
  for (int i = 0; i < rows; ++i, b += columns, lower += columns, upper += columns) {
    double row[kMaxColumns];
    std::memcpy(row, b, sizeof(double) * columns);
    for (int j = 0; j < columns; j += 4) {
      Lanes low{}, high{}, weights;
      for (int k = 0; k < j + 4; ++k) load(by.lower[k].data() + j, weights), low += row[k] * weights;
      for (int k = j; k < columns; ++k) load(by.upper[k].data() + j, weights), high += row[k] * weights;
      store(low, lower + j);
      store(high, upper + j);
    }
  }
}

// Bernstein's functions of degree count - 1, by powers of x/(1 - x): good to rounding below 1.
void bernstein_weights(int count, double x, double* weights) {
  x = std::min(x, 1 - 1e-12);
  double first = 1;
  for (int k = 1; k < count; ++k) first *= 1 - x;
  const double ratio = x / (1 - x);
  for (int k = 0; k < count; ++k) {
    weights[k] = first;
    first *= ratio * ((count - 1 - k) / (k + 1.0));
  }
}

LEKALO_WIDE double value_of(const double* b, int rows, int columns, const double* by_rows, const double* by_columns) {
  Lanes sum{}, weights, values;
  for (int j = 0; j < columns; j += 4) {
    Lanes line{};
    for (int i = 0; i < rows; ++i) load(b + i * columns + j, values), line += by_rows[i] * values;
    load(by_columns + j, weights);
    sum += weights * line;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

class PatchIsolation {
 public:
  PatchIsolation(const std::array<Net, 2>& nets, double error, SurfaceFootPointZeros& found)
      : nets_(nets), error_(error), found_(found) {}

  bool run() {
    const size_t each = nets_[0].values.size() + nets_[1].values.size();
    room_.resize(each * (2 * kMaxHalvings + 2));
    std::copy(nets_[0].values.begin(), nets_[0].values.end(), room_.begin());
    std::copy(nets_[1].values.begin(), nets_[1].values.end(), room_.begin() + nets_[0].values.size());
    struct Cell {
      Rectangle box;
      int halvings[2];
    };
    std::vector<Cell> cells{{{{0, 1}, {0, 1}}, {0, 0}}};
    for (int seen = 0; !cells.empty(); ++seen) {
      if (seen > kMaxCells || found_.undecided.size() > kMaxUndecided) return false;
      Cell& cell = cells.back();
      double* f = room_.data() + each * (cells.size() - 1);
      double* g = f + nets_[0].values.size();
      const int direction = visit(f, g, cell.box);
      if (direction < 0) {
        cells.pop_back();
        continue;
      }
      if (cell.halvings[direction] == kMaxHalvings) {
        found_.undecided.push_back(cell.box);
        cells.pop_back();
        continue;
      }
      ++cell.halvings[direction];
      Cell upper = cell;
      Interval& low = direction == 0 ? cell.box.u : cell.box.v;
      Interval& high = direction == 0 ? upper.box.u : upper.box.v;
      low.hi = high.lo = low.middle();
      for (const auto& [net, b] : {std::pair(&nets_[0], f), std::pair(&nets_[1], g)}) {
        // The upper half goes to the next place, the lower one stays.
        if (direction == 0) {
          double* next = b + each;
          halve_rows(b, net->rows, net->columns, b, next);
        } else {
          halve_columns(b, net->rows, net->columns, halving_of(net->columns), b, b + each);
        }
      }
      cells.push_back(upper);
    }
    return true;
  }

 private:
  // The direction in which to halve, or -1 if all is known.
  int visit(const double* f, const double* g, const Rectangle& box) {
    const Net &nf = nets_[0], &ng = nets_[1];
    Bounds bounds[2];
    for (int k = 0; k < 2; ++k) {
      const Net& net = nets_[k];
      bounds[k].value = values_of(k == 0 ? f : g, net.rows, net.columns);
      if (bounds[k].value.lo > error_ || bounds[k].value.hi < -error_) return -1;
    }
    for (int k = 0; k < 2; ++k) {
      const Net& net = nets_[k];
      slopes_of(k == 0 ? f : g, net.rows, net.columns, bounds[k]);
      bounds[k].by_x = inflated(bounds[k].by_x, 2 * net.rows * error_);
      bounds[k].by_y = inflated(bounds[k].by_y, 2 * net.columns * error_);
    }
    const double a = bounds[0].by_x.middle(), b = bounds[0].by_y.middle(), c = bounds[1].by_x.middle(),
                 d = bounds[1].by_y.middle();
    const double determinant = a * d - b * c;
    if (!(std::abs(determinant) > 1e-10 * (std::abs(a * d) + std::abs(b * c)))) return wider(bounds, box);
    const double inverse[2][2] = {{d / determinant, -b / determinant}, {-c / determinant, a / determinant}};
    double spread[2][2];  // |I - C J|
    for (int i = 0; i < 2; ++i) {
      const double x = std::abs(inverse[i][0]), y = std::abs(inverse[i][1]);
      spread[i][0] = 1e-10 + (1 + 1e-10) * (x * bounds[0].by_x.radius() + y * bounds[1].by_x.radius());
      spread[i][1] = 1e-10 + (1 + 1e-10) * (x * bounds[0].by_y.radius() + y * bounds[1].by_y.radius());
    }
    const bool one_to_one = spread[0][0] + spread[0][1] < kOneToOne && spread[1][0] + spread[1][1] < kOneToOne;
    const bool tells = std::max(spread[0][0] + spread[0][1], spread[1][0] + spread[1][1]) < kTells;
    Range x{0, 1}, y{0, 1};
    bool exists = false;
    for (int cut = 0; cut < (one_to_one ? kMaxCuts : tells ? 1 : 0); ++cut) {
      const double mx = x.middle(), my = y.middle();
      double by_columns[kMaxColumns], by_rows[kMaxColumns];
      bernstein_weights(nf.columns, my, by_columns);
      bernstein_weights(nf.rows, mx, by_rows);
      const double vf = value_of(f, nf.rows, nf.columns, by_rows, by_columns);
      bernstein_weights(ng.rows, mx, by_rows);
      const double vg = value_of(g, ng.rows, ng.columns, by_rows, by_columns);
      Range next[2];
      for (int i = 0; i < 2; ++i) {
        const double by = inverse[i][0] * vf + inverse[i][1] * vg;
        const double reach = spread[i][0] * x.radius() + spread[i][1] * y.radius() +
                             (std::abs(inverse[i][0]) + std::abs(inverse[i][1])) * error_ + 1e-11;
        const double center = (i == 0 ? mx : my) - by;
        next[i] = {center - reach, center + reach};
      }
      const bool inside = x.lo < next[0].lo && next[0].hi < x.hi && y.lo < next[1].lo && next[1].hi < y.hi;
      exists = exists || (one_to_one && inside);
      if (exists && std::max(next[0].radius(), next[1].radius()) < kNearZero) {
        const Rectangle within{part(box.u, next[0]), part(box.v, next[1])};
        found_.single.push_back({within, {within.u.middle(), within.v.middle()}});
        return -1;
      }
      x = {std::max(x.lo, next[0].lo), std::min(x.hi, next[0].hi)};
      y = {std::max(y.lo, next[1].lo), std::min(y.hi, next[1].hi)};
      if (x.lo > x.hi || y.lo > y.hi) return -1;
    }
    if (one_to_one && cuts_to_border(x, y)) {
      found_.undecided.push_back({part(box.u, x), part(box.v, y)});
      return -1;
    }
    const double by_x = std::max(spread[0][0], spread[1][0]), by_y = std::max(spread[0][1], spread[1][1]);
    return by_x >= by_y ? 0 : 1;
  }

  static Range inflated(const Range& x, double by) { return {x.lo - by, x.hi + by}; }
  static Interval part(const Interval& of, const Range& x) {
    return {of.lo + of.width() * std::max(x.lo, 0.0), of.lo + of.width() * std::min(x.hi, 1.0)};
  }
  // What is left of a square on which the equations are one-to-one lies along its border.
  static bool cuts_to_border(const Range& x, const Range& y) { return x.hi - x.lo < 0.05 && y.hi - y.lo < 0.05; }
  int wider(const Bounds* bounds, const Rectangle& box) const {
    const auto relative = [](const Range& r) {
      const double most = std::max(std::abs(r.lo), std::abs(r.hi));
      return most > 0 ? r.radius() / most : 0.0;
    };
    const double x = std::max(relative(bounds[0].by_x), relative(bounds[1].by_x)) * box.u.width();
    const double y = std::max(relative(bounds[0].by_y), relative(bounds[1].by_y)) * box.v.width();
    return x >= y ? 0 : 1;
  }

  static constexpr int kMaxCuts = 12;
  static constexpr double kNearZero = 0.05;  // of the cell: the surface's own Newton's steps end it
  const std::array<Net, 2>& nets_;
  const double error_;
  SurfaceFootPointZeros& found_;
  std::vector<double> room_;
};

}  // namespace

FootPointPolynomials::FootPointPolynomials(const SurfacePiece& piece, const Vec3& origin) : origin_(origin) {
  const int p = piece.degree_u, q = piece.degree_v;
  std::array<Net, 4> a;  // x, y, z, w
  double weight = 0;
  reach_ = 0;
  for (const Vec4& point : piece.points) weight = std::max(weight, std::abs(point.w));
  for (Net& net : a) net = {p + 1, q + 1, {}};
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4& point = piece.points[i * (q + 1) + j];
      const Vec4 moved(Vec3(point) - point.w * origin, point.w);
      reach_ = std::max(reach_, glm::length(Vec3(moved)) / weight);
      for (int k = 0; k < 4; ++k) a[k].values.push_back(binomial(p, i) * binomial(q, j) * moved[k]);
    }
  const int columns = std::max(8, (3 * q + 1 + 3) / 4 * 4);
  const auto numerator = [&](const Net& d, bool by_u) {
    Net left = d * derivative(a[3], by_u);
    const Net right = derivative(d, by_u) * a[3];
    for (size_t i = 0; i < left.values.size(); ++i) left.values[i] = 2 * left.values[i] - right.values[i];
    return finished(left, columns);
  };
  Net square = a[0] * a[0];
  for (int k = 1; k < 3; ++k) {
    const Net own = a[k] * a[k];
    for (size_t i = 0; i < square.values.size(); ++i) square.values[i] += own.values[i];
  }
  for (const bool by_u : {true, false}) {
    std::array<Net, 4>& to = nets_[by_u ? 0 : 1];
    for (int k = 0; k < 3; ++k) to[k] = numerator(a[k] * a[3], by_u);
    to[3] = numerator(square, by_u);
  }
  // As for curves, with the roundings of both directions and of the elevation.
  const int degree = std::max({p, q, 1});
  min_error_ = 8.0 * degree * (6 * degree + columns + 40) * kEpsilon * weight * sqr(weight) * (2 + 2 * kMaxHalvings);
}

bool FootPointPolynomials::isolate(const Vec3& p, SurfaceFootPointZeros& found) const {
  const Vec3 q = -2.0 * (p - origin_);
  std::array<Net, 2> nets;
  for (int by = 0; by < 2; ++by) {
    const std::array<Net, 4>& from = nets_[by];
    nets[by] = {from[0].rows, from[0].columns, from[3].values};
    for (size_t i = 0; i < nets[by].values.size(); ++i)
      nets[by].values[i] += q.x * from[0].values[i] + q.y * from[1].values[i] + q.z * from[2].values[i];
  }
  return PatchIsolation(nets, min_error_ * sqr(reach_ + 0.5 * glm::length(q)), found).run();
}

}  // namespace lekalo::geometry
