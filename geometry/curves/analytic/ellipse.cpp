// Ellipse and elliptic arc (Golovanov 2016, 2.2):
//
//   r(t) = o + a cos t x + b sin t y,   r^(k)(t) = a cos(t + k pi/2) x + b sin(t + k pi/2) y.
//
// Exact rational form: arcs of at most a quarter turn, images of circular arcs under (x, y) -> (a x, b y) (2.14).
#include "geometry/curves/analytic/ellipse.h"

#include <cmath>
#include <stdexcept>

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/describe.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

namespace {

// The derivatives of order 0..order, without the origin. T is double or Interval.
template <class T, class Result>
void derivatives(const Frame& frame, double a, double b, const T& t, int order, Result result) {
  using std::cos;
  using std::sin;
  T c = cos(t), s = sin(t);
  for (int k = 0; k <= order; ++k) {
    result(k, (a * c) * triple(frame.x) + (b * s) * triple(frame.y));
    const T turned = -s;
    s = c;
    c = turned;
  }
}

}  // namespace

Ellipse::Ellipse(const Frame& frame, double a, double b, const Interval& arc) : frame_(frame), a_(a), b_(b), arc_(arc) {
  if (!(a > 0 && b > 0)) throw std::invalid_argument("the semi-axes of an ellipse must be positive");
  if (!(arc.width() > 0)) throw std::invalid_argument("the arc is empty: its end must lie above its start");
  if (!(arc.width() <= kTwoPi * (1 + 1e-12))) throw std::invalid_argument("the arc is longer than one turn");
}

CurveJet Ellipse::evaluate(double t, int order) const {
  CurveJet jet;
  jet.order = order;
  derivatives(frame_, a_, b_, t, order, [&](int k, const Triple<double>& r) { jet.d[k] = {r.x, r.y, r.z}; });
  jet.d[0] += frame_.origin;
  return jet;
}

CurveEnclosure Ellipse::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  derivatives(frame_, a_, b_, t, order,
              [&](int k, const Triple<Interval>& r) { result.d[k] = box_of(k == 0 ? r + triple(frame_.origin) : r); });
  return result;
}

std::optional<NurbsCurveForm> Ellipse::as_nurbs() const {
  NurbsCurveForm form = circle_form(arc_);
  for (Vec4& p : form.points) p = {p.w * frame_.origin + (a_ * p.x) * frame_.x + (b_ * p.y) * frame_.y, p.w};
  return form;
}

TypeDeclaration ellipse_type() {
  return declare(Category::curve, "ellipse", "Ellipse or elliptic arc in the x, y plane of its frame.")
      .example("semi_axes: [2, 1]")
      .field("frame", frame(), "placement: x and y carry the semi-axes, z is normal to the plane", "{}")
      .field("semi_axes", numbers().count(2, 2).positive(), "semi-axes along x and y")
      .optional("arc", angle_range(),
                "part of the ellipse: start and end of the eccentric angle (measured from x towards y on the circle "
                "that is stretched into the ellipse); at most one turn")
      .built_by([](const Fields& f) {
        const std::vector<double>& axes = f.numbers("semi_axes");
        if (!(axes[0] > 0 && axes[1] > 0)) throw FieldError("semi_axes", "semi-axes must be positive");
        if (!f.has("arc")) return Ellipse(f.frame(), axes[0], axes[1]);
        if (f.range("arc").width() > kTwoPi * (1 + 1e-12))
          throw FieldError("arc", "the arc is longer than one turn", "end - start must not exceed 360");
        return Ellipse(f.frame(), axes[0], axes[1], f.range("arc"));
      });
}

}  // namespace lekalo::geometry
