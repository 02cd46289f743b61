// Certified real roots by Bernstein subdivision (Lane, Riesenfeld 1981; Golovanov 2016, 4.5 for the use of hulls).
//
// On a cell the polynomial lies in the hull of its Bernstein coefficients, and has no more roots than they have changes
// of sign (0: none, 1: exactly one). The coefficients are intervals, so each answer is certain or open. An open cell is
// split; when all its coefficients contain zero, or it has shrunk to some ulps, splitting can decide no more: it joins
// a cluster.
#include "geometry/numerics/polynomial.h"

#include <cmath>

namespace lekalo::geometry {
namespace {

using Coefficients = std::vector<Interval>;

// Not one half: roots of human-made polynomials like halves, and a root on a cut costs fifty levels on both sides.
constexpr double kCut = 63.0 / 128;

int certain_sign(const Interval& x) { return x.lo > 0 ? 1 : x.hi < 0 ? -1 : 0; }

struct Cell {
  double lo, hi;  // in the parameter 0..1 of the domain
  Coefficients b;
};

// De Casteljau: b becomes the left part, the returned one is the right part.
Coefficients split(Coefficients& b, const Interval& t) {
  const Interval s = 1.0 - t;
  const int n = static_cast<int>(b.size()) - 1;
  Coefficients right(b.size());
  for (int level = 0; level <= n; ++level) {
    right[n - level] = b[n];
    for (int i = n; i > level; --i) b[i] = s * b[i - 1] + t * b[i];
  }
  return right;
}

// The polynomial's value and derivative (by the local parameter) at t, in plain numbers.
struct Value {
  double p, slope;
};
Value evaluate(const std::vector<double>& b, double t, std::vector<double>& work) {
  work = b;
  const int n = static_cast<int>(b.size()) - 1;
  double slope = 0;
  for (int level = n; level > 0; --level) {
    if (level == 1) slope = n * (work[1] - work[0]);
    for (int i = 0; i < level; ++i) work[i] += t * (work[i + 1] - work[i]);
  }
  return {work[0], slope};
}

std::vector<double> middles(const Coefficients& b) {
  std::vector<double> result;
  for (const Interval& x : b) result.push_back(x.middle());
  return result;
}

// Where the polynomial changes sign in (0, 1), by Newton steps kept in a shrinking bracket.
double crossing(const std::vector<double>& b) {
  std::vector<double> work;
  const bool rising = b.front() < b.back();
  double lo = 0, hi = 1, t = b.front() == b.back() ? 0.5 : b.front() / (b.front() - b.back());
  for (int step = 0; step < 200; ++step) {
    if (!(lo < t && t < hi)) t = 0.5 * (lo + hi);
    const Value v = evaluate(b, t, work);
    if (v.p == 0) return t;
    ((v.p < 0) == rising ? lo : hi) = t;
    const double next = t - v.p / v.slope;
    if (std::fabs(next - t) <= 0x1p-53 * t || hi - lo <= 0x1p-53) return std::fmin(std::fmax(next, 0.0), 1.0);
    // Every third step halves, so that the bracket shrinks whatever the shape.
    t = step % 3 == 2 ? 0.5 * (lo + hi) : next;
  }
  return t;
}

class RootFinder {
 public:
  RootFinder(std::span<const Interval> b, const Interval& domain) : whole_(b.begin(), b.end()), domain_(domain) {
    // Cells of a few ulps of the largest parameter are not split further.
    smallest_ = std::max(0x1p-51, 0x1p-50 * magnitude(domain) / domain.width());
  }

  std::vector<CertifiedRoot> find() {
    visit({0, 1, whole_});
    close_cluster(0);
    return std::move(roots_);
  }

 private:
  void visit(Cell cell) {
    int changes = 0, previous = 0;
    bool open = false, hopeless = true;
    for (const Interval& x : cell.b) {
      const int sign = certain_sign(x);
      if (sign == 0) {
        open = true;
        continue;
      }
      hopeless = false;
      if (previous != 0 && sign != previous) ++changes;
      previous = sign;
    }
    if (!open && changes == 0) return close_cluster(previous);
    if (!open && changes == 1) return single_root(cell);
    if (hopeless || cell.hi - cell.lo <= smallest_) return extend_cluster(cell);
    const double middle = cell.lo + kCut * (cell.hi - cell.lo);
    // The rounded middle is what counts from here on; its exact place in the cell is an interval.
    const Interval t = (Interval(middle) - cell.lo) / (Interval(cell.hi) - cell.lo);
    Coefficients right = split(cell.b, t);
    const double hi = cell.hi;
    cell.hi = middle;
    visit(std::move(cell));
    visit({middle, hi, std::move(right)});
  }

  // Exactly one root, a change of sign: found in plain numbers, then surrounded by two certain signs.
  void single_root(const Cell& cell) {
    const int left = certain_sign(cell.b.front());
    close_cluster(left);
    const double t = cell.lo + crossing(middles(cell.b)) * (cell.hi - cell.lo);
    CertifiedRoot root;
    root.x = place(t);
    root.within = Interval{place(cell.lo), place(cell.hi)};
    for (double radius = 2 * smallest_; radius < cell.hi - cell.lo; radius *= 4) {
      const double a = std::fmax(cell.lo, t - radius), b = std::fmin(cell.hi, t + radius);
      if (sign_at(a) == left && sign_at(b) == -left) {
        root.within = hull_of_places(a, b);
        break;
      }
    }
    root.x = root.within.clamp(root.x);
    roots_.push_back(root);
    sign_before_ = -left;
  }

  void extend_cluster(const Cell& cell) {
    if (!in_cluster_) cluster_ = {cell.lo, cell.hi};
    cluster_.hi = cell.hi;
    in_cluster_ = true;
  }

  // The sign right of the place reached is known (0: the end of the domain).
  void close_cluster(int sign_after) {
    if (in_cluster_) roots_.push_back(cluster_root(sign_after));
    in_cluster_ = false;
    sign_before_ = sign_after;
  }

  CertifiedRoot cluster_root(int sign_after) const {
    const std::vector<double> b = middles(over_cluster(whole_));
    const Coefficients slope = over_cluster(differences());
    const int product = sign_before_ * sign_after;
    CertifiedRoot root;
    root.tangent = product > 0 || (product == 0 && is_open(slope));
    double t = 0.5;
    if (root.tangent) {
      if (!slope.empty() && slope.front().middle() * slope.back().middle() < 0) t = crossing(middles(slope));
    } else if (b.front() * b.back() < 0) {
      t = crossing(b);
    } else if (product == 0) {
      t = std::fabs(b.front()) < std::fabs(b.back()) ? 0 : 1;
    }
    root.within = hull_of_places(cluster_.lo, cluster_.hi);
    root.x = root.within.clamp(place(cluster_.lo + t * cluster_.width()));
    return root;
  }

  Coefficients over_cluster(Coefficients b) const {
    if (b.empty()) return b;
    if (cluster_.hi < 1) split(b, cluster_.hi);
    return cluster_.lo > 0 ? split(b, Interval(cluster_.lo) / cluster_.hi) : b;
  }

  // The derivative's coefficients, but for the factor n.
  Coefficients differences() const {
    Coefficients result;
    for (std::size_t i = 1; i < whole_.size(); ++i) result.push_back(whole_[i] - whole_[i - 1]);
    return result;
  }

  static bool is_open(const Coefficients& b) {
    const int sign = b.empty() ? 0 : certain_sign(b[0]);
    return sign == 0 || std::any_of(b.begin(), b.end(), [&](const Interval& x) { return certain_sign(x) != sign; });
  }

  int sign_at(double t) const {
    Coefficients b = whole_;
    for (std::size_t level = b.size() - 1; level > 0; --level) {
      for (std::size_t i = 0; i < level; ++i) b[i] = (1.0 - Interval(t)) * b[i] + t * b[i + 1];
    }
    return certain_sign(b[0]);
  }

  Interval certain_place(double t) const {
    if (t <= 0) return domain_.lo;
    if (t >= 1) return domain_.hi;
    return (1.0 - Interval(t)) * domain_.lo + Interval(t) * domain_.hi;
  }
  double place(double t) const { return domain_.clamp(certain_place(t).middle()); }
  Interval hull_of_places(double a, double b) const {
    return intersect(hull(certain_place(a), certain_place(b)), domain_);
  }

  Coefficients whole_;
  Interval domain_;
  double smallest_;
  std::vector<CertifiedRoot> roots_;
  Interval cluster_;
  bool in_cluster_ = false;
  int sign_before_ = 0;
};

}  // namespace

std::vector<CertifiedRoot> bernstein_roots(std::span<const Interval> b, const Interval& domain) {
  if (b.empty() || !std::isfinite(domain.lo) || !std::isfinite(domain.hi) || domain.empty()) return {};
  double largest = 0;
  for (const Interval& x : b) {
    if (!std::isfinite(x.lo) || !std::isfinite(x.hi)) return {};
    largest = std::fmax(largest, magnitude(x));
  }
  if (domain.width() == 0) {
    if (certain_sign(b.front()) != 0) return {};
    return {CertifiedRoot{{domain.lo, false}, domain}};
  }
  // Scaled by a power of two so that neither large nor tiny coefficients leave the range of double on the way.
  Coefficients scaled(b.begin(), b.end());
  if (largest > 0) {
    const int exponent = -std::ilogb(largest);
    for (Interval& x : scaled) {
      const Interval exact{std::ldexp(x.lo, exponent), std::ldexp(x.hi, exponent)};
      // Only a number 2^1000 times smaller than the largest can lose bits here.
      const bool lossless = std::ldexp(exact.lo, -exponent) == x.lo && std::ldexp(exact.hi, -exponent) == x.hi;
      x = lossless ? exact : Interval{next_down(exact.lo), next_up(exact.hi)};
    }
  }
  return RootFinder(scaled, domain).find();
}

std::vector<CertifiedRoot> bernstein_roots(std::span<const double> b, const Interval& domain) {
  const Coefficients exact(b.begin(), b.end());
  return bernstein_roots(std::span<const Interval>(exact), domain);
}

// x = lo + width s:  p = sum d_k s^k,  then  b_j = sum_(k <= j) C(j, k) / C(n, k) d_k.
std::vector<CertifiedRoot> power_roots(std::span<const double> c, const Interval& domain) {
  if (c.empty() || !std::isfinite(domain.lo) || !std::isfinite(domain.hi)) return {};
  const int n = static_cast<int>(c.size()) - 1;
  Coefficients d(c.begin(), c.end());
  for (int k = 0; k < n; ++k) {
    for (int i = n - 1; i >= k; --i) d[i] += domain.lo * d[i + 1];
  }
  const Interval width = Interval(domain.hi) - domain.lo;
  Interval scale = 1.0;
  for (int k = 1; k <= n; ++k) {
    // d_k / C(n, k), with C(n, k) = C(n, k - 1) (n - k + 1) / k carried along in the scale.
    scale = scale * width * (static_cast<double>(k) / Interval(n - k + 1.0));
    d[k] = d[k] * scale;
  }
  // The sum with binomials C(j, k) is a table of repeated sums.
  for (int k = 1; k <= n; ++k) {
    for (int i = n; i >= k; --i) d[i] += d[i - 1];
  }
  return bernstein_roots(std::span<const Interval>(d), domain);
}

}  // namespace lekalo::geometry
