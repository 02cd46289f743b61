// The homogeneous curve H(t) = weight(t) (x, y, z, 1) is a polynomial in a span's own parameter q in [0, 1]: where the
// law is one of t directly, t = lo + q (hi - lo); where it is one of cosines, with
//   u = tan((s - m)/2) = tan(d/4) (2q - 1),  d = hi - lo,  m the middle,  s = speed t        (ParameterMap, half_angle)
//   cos(s - m) = (1 - u^2)/(1 + u^2),  sin(s - m) = 2u/(1 + u^2),
// so (1 + u^2)^degree H is a polynomial of twice the degree in q. Its Bezier points are those of the polynomial through
// its values at Chebyshev's points, both ends among them.
#include "geometry/curves/analytic/rational_form.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"

namespace lekalo::geometry {

namespace {

// Spans of cosines are a quarter turn at most. Those of polynomials are no wider than this and their distance from 0,
// for weights such as 1 + t^2.
constexpr double kWidest = 2;
// Halvings of a span for bounds of the weight that keep away from 0.
constexpr int kMaxHalvings = 8;

class RationalCurve {
 public:
  RationalCurve(const PointFormulas& point, const RationalLaw& law)
      : point_(point),
        weight_({law.weight, zero(), zero()}, Coordinates::cartesian, {"t"}),
        law_(law),
        degree_(is_of_angles() ? 2 * law.degree : law.degree),
        factors_(bernstein_at_nodes()) {}

  bool is_of_angles() const { return law_.speed > 0; }
  double speed() const { return is_of_angles() ? law_.speed : 1; }
  int degree() const { return degree_; }

  // -1 or 1, or 0 where the weight may vanish.
  int sign_of_weight(const Interval& t, int halvings = 0) const {
    const Interval bounds = weight_(t).x;
    if (bounds.lo > 0) return 1;
    if (bounds.hi < 0) return -1;
    if (halvings == kMaxHalvings) return 0;
    const int below = sign_of_weight({t.lo, t.middle()}, halvings + 1);
    return below != 0 && below == sign_of_weight({t.middle(), t.hi}, halvings + 1) ? below : 0;
  }

  bool has_one_weight(const Interval& t) const { return !is_of_angles() && weight_(t).x.width() == 0; }

  // Bezier points of a span of s.
  std::vector<Vec4> points(const Interval& s, int sign) const {
    const ParameterMap map = map_of(s);
    Eigen::MatrixX4d values(degree_ + 1, 4);
    for (int j = 0; j <= degree_; ++j) {
      const Vec4 h = double(sign) * homogeneous(map, node(j));
      values.row(j) << h.x, h.y, h.z, h.w;
    }
    const Eigen::MatrixX4d found = factors_.solve(values);
    std::vector<Vec4> result;
    for (int j = 0; j <= degree_; ++j) result.emplace_back(found(j, 0), found(j, 1), found(j, 2), found(j, 3));
    return result;
  }

  ParameterMap map_of(const Interval& s) const {
    return {is_of_angles() ? ParameterMap::Kind::half_angle : ParameterMap::Kind::affine, s.lo, s.hi};
  }

 private:
  static Expression zero() { return formula_of("0", {"t"}); }

  double node(int j) const { return j == degree_ ? 1 : 0.5 * (1 - std::cos(kPi * j / degree_)); }

  Vec4 homogeneous(const ParameterMap& map, double q) const {
    const double s = q == 0 ? map.lo : q == 1 ? map.hi : map.natural_of_bezier(q), t = s / speed();
    const double u = is_of_angles() ? std::tan(0.25 * (map.hi - map.lo)) * (2 * q - 1) : 0;
    const double w = weight_(t).x * std::pow(1 + u * u, is_of_angles() ? law_.degree : 0);
    const Triple<double> p = point_(t);
    return {w * p.x, w * p.y, w * p.z, w};
  }

  Eigen::PartialPivLU<Eigen::MatrixXd> bernstein_at_nodes() const {
    Eigen::MatrixXd matrix(degree_ + 1, degree_ + 1);
    for (int j = 0; j <= degree_; ++j) {
      double choices = 1;  // n over k
      for (int k = 0; k <= degree_; choices = choices * (degree_ - k) / (k + 1), ++k)
        matrix(j, k) = choices * std::pow(node(j), k) * std::pow(1 - node(j), degree_ - k);
    }
    return Eigen::PartialPivLU<Eigen::MatrixXd>(matrix);
  }

  const PointFormulas& point_;
  PointFormulas weight_;
  const RationalLaw& law_;
  int degree_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

// Quarter turns: more of them are no figure, and a form of many thousand spans serves nobody.
constexpr int kMaxSpans = 4096;

// Ends of spans, from lo to hi.
std::vector<double> span_ends(const Interval& s, bool is_of_angles) {
  if (is_of_angles) {
    const int spans = std::max(1, static_cast<int>(std::ceil(s.width() / (0.5 * kPi) - 1e-9)));
    std::vector<double> ends;
    for (int k = 0; k < spans; ++k) ends.push_back(s.lo + s.width() * k / spans);
    ends.push_back(s.hi);
    return ends;
  }
  const double distance = s.contains(0) ? 0 : std::min(std::abs(s.lo), std::abs(s.hi));
  if (s.width() <= kWidest + distance) return {s.lo, s.hi};
  std::vector<double> ends = span_ends({s.lo, s.middle()}, false);
  const std::vector<double> above = span_ends({s.middle(), s.hi}, false);
  ends.insert(ends.end(), above.begin() + 1, above.end());
  return ends;
}

}  // namespace

std::optional<RationalForm> rational_form(const PointFormulas& point, const RationalLaw& law, const Interval& domain) {
  if (law.degree < 1 || (law.speed > 0 ? 2 : 1) * law.degree > kMaxDegree) return std::nullopt;
  const RationalCurve curve(point, law);
  const int sign = curve.sign_of_weight(domain), degree = curve.degree();
  if (sign == 0) return std::nullopt;
  const Interval s(curve.speed() * domain.lo, curve.speed() * domain.hi);
  RationalForm result{{degree, {s.lo}, {}, {}}, curve.speed()};
  NurbsCurveForm& form = result.form;
  const bool is_polynomial = curve.has_one_weight(domain);
  if (!is_polynomial && curve.is_of_angles() && s.width() > 0.5 * kPi * kMaxSpans) return std::nullopt;
  const std::vector<double> ends = is_polynomial ? std::vector<double>{s.lo, s.hi} : span_ends(s, curve.is_of_angles());
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    std::vector<Vec4> points = curve.points({ends[k], ends[k + 1]}, sign);
    if (is_polynomial)
      for (Vec4& p : points) p.w = points[0].w;
    form.knots.insert(form.knots.end(), degree, ends[k]);
    form.points.insert(form.points.end(), points.begin() + (k > 0 ? 1 : 0), points.end());
    if (curve.is_of_angles()) form.maps.push_back(curve.map_of({ends[k], ends[k + 1]}));
  }
  form.knots.insert(form.knots.end(), degree + 1, s.hi);
  return result;
}

}  // namespace lekalo::geometry
