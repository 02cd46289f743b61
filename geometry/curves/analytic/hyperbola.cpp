// Hyperbola (Golovanov 2016, 2.2):
//
//   r(t) = o + a cosh t x + b sinh t y,   derivatives swap cosh and sinh.
//
// Exact rational form: images of arcs of the unit hyperbola under (x, y) -> (a x, b y) (2.5).
#include "geometry/curves/analytic/hyperbola.h"

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
  using std::cosh;
  using std::sinh;
  T c = cosh(t), s = sinh(t);
  for (int k = 0; k <= order; ++k) {
    result(k, (a * c) * triple(frame.x) + (b * s) * triple(frame.y));
    std::swap(c, s);
  }
}

// cosh of more is beyond what doubles hold of its parts.
constexpr double kFarthest = 300;

}  // namespace

Hyperbola::Hyperbola(const Frame& frame, double a, double b, const Interval& range)
    : frame_(frame), a_(a), b_(b), range_(range) {
  if (!(a > 0 && b > 0)) throw std::invalid_argument("the semi-axes of a hyperbola must be positive");
  if (!(range.width() > 0)) throw std::invalid_argument("the range is empty: its end must lie above its start");
  if (!(range.lo >= -kFarthest && range.hi <= kFarthest))
    throw std::invalid_argument("the range of a hyperbola lies between -300 and 300");
}

CurveJet Hyperbola::evaluate(double t, int order) const {
  CurveJet jet;
  jet.order = order;
  derivatives(frame_, a_, b_, t, order, [&](int k, const Triple<double>& r) { jet.d[k] = {r.x, r.y, r.z}; });
  jet.d[0] += frame_.origin;
  return jet;
}

CurveEnclosure Hyperbola::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  derivatives(frame_, a_, b_, t, order,
              [&](int k, const Triple<Interval>& r) { result.d[k] = box_of(k == 0 ? r + triple(frame_.origin) : r); });
  return result;
}

std::optional<NurbsCurveForm> Hyperbola::as_nurbs() const {
  NurbsCurveForm form = hyperbola_form(range_);
  for (Vec4& p : form.points) p = {p.w * frame_.origin + (a_ * p.x) * frame_.x + (b_ * p.y) * frame_.y, p.w};
  return form;
}

TypeDeclaration hyperbola_type() {
  return declare(Category::curve, "hyperbola",
                 "Arc of a hyperbola, (a cosh t, b sinh t) in the x, y plane of its frame.")
      .field("frame", frame(), "placement: the center; x points to the vertex of the branch, z is normal to the plane",
             "{}")
      .field("semi_axes", numbers().count(2, 2).positive(),
             "a, from the center to the vertex, and b; the asymptotes rise by b/a")
      .field("range", range(), "of t; the vertex is at t = 0")
      .example("semi_axes: [1, 0.5], range: [-2, 2]")
      .built_by([](const Fields& f) {
        const std::vector<double>& axes = f.numbers("semi_axes");
        if (!(axes[0] > 0 && axes[1] > 0)) throw FieldError("semi_axes", "semi-axes must be positive");
        if (f.range("range").lo < -kFarthest || f.range("range").hi > kFarthest)
          throw FieldError("range", "the range of a hyperbola lies between -300 and 300",
                           "t = 10 is 11000 semi-axes out");
        return Hyperbola(f.frame(), axes[0], axes[1], f.range("range"));
      });
}

}  // namespace lekalo::geometry
