// Parabola (Golovanov 2016, 2.2): r(t) = o + f t^2 x + 2 f t y. Its NURBS form is one polynomial quadratic.
#include "geometry/curves/analytic/parabola.h"

#include <cmath>
#include <stdexcept>

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/describe.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

Parabola::Parabola(const Frame& frame, double focal_length, const Interval& range)
    : frame_(frame), focal_length_(focal_length), range_(range) {
  if (!(focal_length > 0)) throw std::invalid_argument("the focal length of a parabola must be positive");
  if (!(range.width() > 0)) throw std::invalid_argument("the range is empty: its end must lie above its start");
  if (!std::isfinite(range.lo) || !std::isfinite(range.hi)) throw std::invalid_argument("the range must be finite");
}

CurveJet Parabola::evaluate(double t, int order) const {
  CurveJet jet;
  jet.order = order;
  const Vec3 x = focal_length_ * frame_.x, y = 2 * focal_length_ * frame_.y;
  jet.d[0] = frame_.origin + t * (t * x + y);
  if (order >= 1) jet.d[1] = 2 * t * x + y;
  if (order >= 2) jet.d[2] = 2.0 * x;
  return jet;
}

CurveEnclosure Parabola::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  const Triple<double> x = triple(focal_length_ * frame_.x), y = triple(2 * focal_length_ * frame_.y);
  result.d[0] = box_of(sqr(t) * x + t * y + triple(frame_.origin));
  if (order >= 1) result.d[1] = box_of(2.0 * t * x + y);
  if (order >= 2) result.d[2] = box_of(Interval(2) * x);
  for (int k = 3; k <= order; ++k) result.d[k] = {Vec3(0), Vec3(0)};
  return result;
}

std::optional<NurbsCurveForm> Parabola::as_nurbs() const {
  return parabola_form(range_, frame_.origin, 2 * focal_length_ * frame_.y, focal_length_ * frame_.x);
}

TypeDeclaration parabola_type() {
  return declare(Category::curve, "parabola", "Arc of a parabola, (f t^2, 2 f t) in the x, y plane of its frame.")
      .field("frame", frame(), "placement: the vertex; x is the axis, towards the focus, z is normal to the plane",
             "{}")
      .field("focal_length", length().positive(), "f: from the vertex to the focus and to the directrix")
      .field("range", range(), "of t; the vertex is at t = 0")
      .example("focal_length: 0.5, range: [-2, 2]")
      .built_by([](const Fields& f) { return Parabola(f.frame(), f.number("focal_length"), f.range("range")); });
}

}  // namespace lekalo::geometry
