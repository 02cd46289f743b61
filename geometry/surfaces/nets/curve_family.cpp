#include "geometry/surfaces/nets/curve_family.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/derived/reparametrized_curve.h"

namespace lekalo::geometry {

std::vector<CurvePtr> read_family(const Fields& fields, const char* field) {
  std::vector<CurvePtr> curves;
  for (const std::any& one : fields.references(field)) curves.push_back(std::any_cast<CurvePtr>(one));
  if (curves.size() < 2) throw FieldError(field, "the surface needs two curves at least");
  for (size_t i = 0; i < curves.size(); ++i)
    if (!(curves[i]->domain().width() < kInfinity))
      throw FieldError(field, fmt::format("curve {} is unbounded", i), "give it a domain");
  return one_domain(std::move(curves), fields);
}

std::vector<CurvePtr> one_domain(std::vector<CurvePtr> curves, const Fields& fields) {
  if (fields.has("match") && fields.text("match") == "arc_length")
    for (CurvePtr& curve : curves) curve = by_length_fraction(curve);
  const Interval domain = curves.front()->domain();
  const bool same = std::all_of(curves.begin(), curves.end(), [&](const CurvePtr& c) { return c->domain() == domain; });
  if (!same)
    for (CurvePtr& curve : curves)
      if (curve->domain() != Interval(0, 1)) curve = with_domain(curve, {0, 1});
  return curves;
}

std::vector<double> steps_between(const std::vector<CurvePtr>& curves, bool closed) {
  constexpr int kSamples = 16;
  std::vector<double> steps;
  for (size_t i = 0; i + (closed ? 0 : 1) < curves.size(); ++i) {
    const Curve &a = *curves[i], &b = *curves[(i + 1) % curves.size()];
    const Interval domain = a.domain();
    double sum = 0;
    for (int k = 0; k <= kSamples; ++k) {
      const double u = domain.lo + domain.width() * k / kSamples;
      sum += glm::length(b.point(u) - a.point(u));
    }
    steps.push_back(sum / (kSamples + 1));
  }
  return steps;
}

std::vector<double> read_nodes(const Fields& fields, const char* field, const std::vector<CurvePtr>& curves,
                               bool closed) {
  const size_t count = curves.size() + (closed ? 1 : 0);
  if (fields.has(field)) {
    const std::vector<double>& nodes = fields.numbers(field);
    if (nodes.size() != count)
      throw FieldError(field, fmt::format("{} values for {} curves{}", nodes.size(), curves.size(),
                                          closed ? " and the first again" : ""));
    for (size_t i = 1; i < nodes.size(); ++i)
      if (!(nodes[i] > nodes[i - 1])) throw FieldError(field, fmt::format("value {} is not above the one before", i));
    return nodes;
  }
  const std::vector<double> steps = steps_between(curves, closed);
  std::vector<double> nodes{0};
  for (size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] > 0))
      throw FieldError("of", fmt::format("curves {} and {} are the same", i, (i + 1) % curves.size()));
    nodes.push_back(nodes.back() + steps[i]);
  }
  for (double& v : nodes) v /= nodes.back();
  nodes.back() = 1;
  return nodes;
}

double common_period(const std::vector<CurvePtr>& curves) {
  const double period = curves.front()->period();
  for (const CurvePtr& curve : curves)
    if (curve->period() != period) return 0;
  return period;
}

}  // namespace lekalo::geometry
