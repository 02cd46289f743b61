#include "geometry/external/external_curve.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/describe.h"
#include "geometry/point_formulas.h"
#include "geometry/surfaces/analytic/parameter_range.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Places where the size is taken.
constexpr int kTried = 64;

std::vector<Vec3> points_of(const ExternalFunction& function, std::span<const double> t) {
  std::vector<Vec3> points;
  for (const CurveJet& jet : curve_jets(function, t, 0)) points.push_back(jet.point());
  return points;
}

}  // namespace

ExternalCurve::ExternalCurve(std::shared_ptr<const ExternalFunction> function, const Interval& domain, bool closed,
                             int order, double tolerance)
    : function_(std::move(function)), domain_(domain), closed_(closed), order_(order) {
  if (!(domain.width() > 0 && domain.width() < kInfinity))
    throw FieldError("domain", "the domain of an external curve must be finite and not empty");
  std::vector<double> tried;
  for (int i = 0; i <= kTried; ++i) tried.push_back(i == kTried ? domain.hi : domain.lo + domain.width() * i / kTried);
  const std::vector<Vec3> points = points_of(*function_, tried);
  Box3 box;
  for (const Vec3& p : points) box.include(p);
  report_.size = box.diameter();
  report_.tolerance = tolerance;
  if (!(report_.size > 0)) throw FieldError("domain", "the function gives the same point everywhere in its domain");
  if (closed && glm::length(points.front() - points.back()) > kClosedCurve * report_.size)
    throw FieldError("closed", "the curve is not closed: its ends do not meet");

  const double allowed = tolerance * report_.size;
  const auto samples = [&](std::span<const double> t) { return points_of(*function_, t); };
  const std::vector<double> breaks = fitting_breaks(samples, 1, domain, allowed);
  const std::vector<double> knots = fitting_knots(breaks);
  std::vector<Vec3> sites = samples(fitting_sites(knots));
  if (closed) sites.back() = sites.front();
  fit_ = std::make_shared<NurbsCurve>(SplineAxis(kFitDegree, knots, Extension::tangent), interpolate(knots, sites, 1));

  const int known = std::min(order, 2);
  const std::vector<double> t = checking_places(breaks);
  std::vector<CurveJet> found(t.size());
  fit_->evaluate_many(t, known, found);
  report_.deviations = deviations(curve_jets(*function_, t, known), found, t, known);
  report_.places = t.size();
  report_.spans = fmt::format("{}", breaks.size() - 1);
  judge(report_, {&breaks, 1});
}

CurveJet ExternalCurve::evaluate(double t, int order) const {
  CurveJet jet;
  evaluate_many({&t, 1}, order, {&jet, 1});
  return jet;
}

void ExternalCurve::evaluate_many(std::span<const double> t, int order, std::span<CurveJet> result) const {
  std::vector<double> asked;
  std::vector<size_t> answered;
  for (size_t i = 0; i < t.size(); ++i) {
    const double place = closed_ ? wrapped(t[i], domain_) : t[i];
    const auto inside = within(domain_, place);
    if (!inside || order > order_) result[i] = fit_->evaluate(place, order);
    if (!inside) continue;
    asked.push_back(*inside);
    answered.push_back(i);
  }
  const int known = std::min(order, order_);
  const std::vector<CurveJet> jets = curve_jets(*function_, asked, known);
  for (size_t k = 0; k < answered.size(); ++k) {
    CurveJet& jet = result[answered[k]];
    jet.order = order;
    std::copy_n(jets[k].d.begin(), known + 1, jet.d.begin());
  }
}

CurveEnclosure ExternalCurve::enclose(const Interval& t, int order) const {
  CurveEnclosure result = fit_->enclose(t, order);
  for (size_t k = 0; k < report_.deviations.size() && k < result.d.size(); ++k)
    result.d[k] = result.d[k].inflated(report_.deviations[k].largest);
  return result;
}

}  // namespace lekalo::geometry
