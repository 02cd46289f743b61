// Curves continued beyond their ends (Golovanov 2016, 2.15.1): an analytic curve by its own law, any other along its
// tangents there,
//
//   r(t) = r(t_min) + (t - t_min) r'(t_min) for t < t_min, and so at the other end.
#include <fmt/format.h>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

CurvePtr tangent_at(const Curve& curve, double t, double from, double to) {
  const CurveJet jet = curve.evaluate(t, 1);
  if (!(glm::length(jet.d[1]) > 0))
    throw FieldError("of", fmt::format("the curve rests at its end t = {:.6g}: it has no tangent there", t));
  return with_domain(std::make_shared<Segment>(jet.d[0] + (from - t) * jet.d[1], jet.d[0] + (to - t) * jet.d[1]),
                     {from, to});
}

CurvePtr extended(const CurvePtr& of, double before, double after) {
  const Interval domain = of->domain();
  if (!(domain.width() < kInfinity)) throw FieldError("of", "the curve is unbounded already");
  if (of->period() > 0 && of->is_closed())
    throw FieldError("of", "a closed curve has no ends to go on from", "trimmed_curve takes more or less of it");
  if (CurvePtr own = of->continued({domain.lo - before, domain.hi + after})) return own;
  std::vector<CurvePtr> parts;
  if (before > 0) parts.push_back(tangent_at(*of, domain.lo, domain.lo - before, domain.lo));
  parts.push_back(of);
  if (after > 0) parts.push_back(tangent_at(*of, domain.hi, domain.hi, domain.hi + after));
  return std::make_shared<CompositeCurve>(std::move(parts), false, 1e-9, domain.lo - before);
}

}  // namespace

TypeDeclaration extended_curve_type() {
  return declare(
             Category::curve, "extended_curve",
             "A curve with more of it before and after: circles, conics and formulas go on by their own law, others "
             "along their end tangents. The parameter is the curve's, beyond its domain.")
      .example("of: my_curve, before: 0.5, after: 1")
      .field("of", reference({Category::curve}), "the curve")
      .field("before", number().non_negative(), "how far the parameter goes below the domain", "0")
      .field("after", number().non_negative(), "how far it goes above", "0")
      .built_by(
          [](const Fields& f) { return std::any(extended(f.curve("of"), f.number("before"), f.number("after"))); });
}

}  // namespace lekalo::geometry
