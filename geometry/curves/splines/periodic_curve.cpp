#include "geometry/curves/splines/periodic_curve.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

NurbsCurve periodic(int degree, std::vector<double> knots, std::span<const Vec4> points) {
  std::vector<Vec3> places;
  std::vector<double> weights;
  for (const Vec4& point : points) {
    if (point.w == 0) throw std::invalid_argument("a control point lies at infinity");
    places.push_back(Vec3(point) / point.w);
    weights.push_back(point.w);
  }
  return NurbsCurve(SplineAxis(degree, std::move(knots), Extension::periodic), places, weights);
}

}  // namespace

bool is_whole_period(const NurbsCurve& curve) {
  const SplineAxis& axis = curve.axis();
  return axis.periodic() && axis.count() == axis.distinct() + axis.degree() &&
         curve.domain().lo == axis.knots()[static_cast<size_t>(axis.degree())] &&
         curve.domain().hi == axis.knots()[axis.knots().size() - 1 - static_cast<size_t>(axis.degree())];
}

// Of the knots lo (p + 1 times), a.., hi (p + 1 times) stay lo (p times), a.., hi (p times); before and after them
// those of the neighbouring periods.
NurbsCurve periodic_curve(const NurbsCurveForm& clamped) {
  const auto p = static_cast<size_t>(clamped.degree);
  const Vec4 &first = clamped.points.front(), &last = clamped.points.back();
  double size = 0;
  for (const Vec4& point : clamped.points) size = std::max(size, glm::length(point - first));
  if (!(glm::length(last - first) <= kClosedCurve * size)) throw std::invalid_argument("the curve's ends do not meet");
  const double period = clamped.domain().width();
  std::vector<double> knots(clamped.knots.begin() + 1, clamped.knots.end() - 1);
  const size_t count = clamped.points.size() - 1;  // knots[k + count] belongs one period after knots[k]
  knots.insert(knots.begin(), knots[count - 1] - period);
  while (knots.size() < count + 2 * p + 1) knots.push_back(knots[knots.size() - count] + period);
  return periodic(clamped.degree, std::move(knots), {clamped.points.data(), count});
}

NurbsCurve in_every_period(const NurbsCurve& curve,
                           const std::function<NurbsCurveForm(const NurbsCurveForm&)>& operation) {
  const SplineAxis& axis = curve.axis();
  const int n = axis.distinct(), p = axis.degree();
  NurbsCurveForm three{p, {}, {}, {}};
  const auto at = [](const auto& list, int i) { return list[static_cast<size_t>(i)]; };
  for (int k = -n; k < 2 * n + 2 * p + 1; ++k) {
    const int turns = (k + n) / n - 1;
    three.knots.push_back(at(axis.knots(), k - turns * n) + turns * axis.period());
  }
  for (int k = 0; k < 3 * n + p; ++k) three.points.push_back(at(curve.points(), k % n));
  const NurbsCurveForm changed = operation(three);
  const auto past = [&](double t) {
    return static_cast<int>(std::upper_bound(changed.knots.begin(), changed.knots.end(), t) - changed.knots.begin());
  };
  const int count = past(curve.domain().hi) - past(curve.domain().lo),
            first = past(curve.domain().lo) - 1 - changed.degree;
  const auto from = changed.knots.begin() + first;
  return periodic(changed.degree, {from, from + count + 2 * changed.degree + 1},
                  {changed.points.data() + first, static_cast<size_t>(count)});
}

}  // namespace lekalo::geometry
