// A plane curve wound on a circular cylinder without stretching: with R the radius, in the frame of the cylinder,
//
//   (x, y) -> (R cos(x/R), R sin(x/R), y)
//
// Arc lengths and angles stay (a cylinder is developable; Zavyalov et al. 1985, IV.4).
#include "geometry/composition.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

struct OnCylinder {
  CurvePtr of;
  Frame frame;
  double radius;

  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::cos;
    using std::sin;
    const Triple<T> plane = curve_at(*of, t);
    const T angle = plane.x / radius, across = (radius + plane.z) * cos(angle), up = (radius + plane.z) * sin(angle);
    return triple(frame.origin) + (across * triple(frame.x) + up * triple(frame.y) + plane.y * triple(frame.z));
  }
};

}  // namespace

TypeDeclaration wrapped_curve_type() {
  return declare(
             Category::curve, "wrapped_curve",
             "Plane curve wound on a circular cylinder without stretching: x goes round, y along the axis; z is the "
             "distance above the cylinder.")
      .example("of: { type: segment, from: [0, 0], to: [12, 3] }, radius: 1")
      .field("of", reference({Category::curve}), "the curve, in the plane x, y")
      .field("radius", length().positive(), "of the cylinder")
      .field("frame", frame(), "placement: z is the axis, x = 0 of the curve lies at the frame's x", "{}")
      .built_by([](const Fields& f) {
        const CurvePtr of = f.curve("of");
        CurveProperties properties = properties_of(*of);
        properties.period = 0;
        return std::any(CurvePtr(
            std::make_shared<ComposedCurve<OnCylinder>>(OnCylinder{of, f.frame(), f.number("radius")}, properties)));
      });
}

}  // namespace lekalo::geometry
