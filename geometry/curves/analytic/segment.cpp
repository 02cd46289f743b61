#include "geometry/curves/analytic/segment.h"

#include "geometry/curves/splines/blossom.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

Segment::Segment(const Vec3& from, const Vec3& to) : from_(from), to_(to) {
  if (from == to) throw FieldError("to", "the ends of the segment coincide", "move one of them");
}

CurveJet Segment::evaluate(double t, int order) const {
  CurveJet jet;
  jet.order = order;
  jet.d[0] = affine_mix(1 - t, from_, t, to_);
  if (order >= 1) jet.d[1] = to_ - from_;
  for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  return jet;
}

CurveEnclosure Segment::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval step = Interval(to_[axis]) - Interval(from_[axis]);
    const Interval x = intersect(Interval(from_[axis]) + t * step, Interval(to_[axis]) - (1 - t) * step);
    const Interval derivatives[kMaxCurveEnclosureOrder + 1] = {x, step, Interval(0), Interval(0), Interval(0)};
    for (int k = 0; k <= order; ++k) {
      result.d[k].lo[axis] = derivatives[k].lo;
      result.d[k].hi[axis] = derivatives[k].hi;
    }
  }
  return result;
}

std::optional<NurbsCurveForm> Segment::as_nurbs() const {
  return NurbsCurveForm{1, {0, 0, 1, 1}, {Vec4(from_, 1), Vec4(to_, 1)}, {}};
}

TypeDeclaration segment_type() {
  return declare(Category::curve, "segment", "Straight segment between two points; t runs in 0..1.")
      .example("from: [0, 0, 0], to: [1, 2, 0]")
      .field("from", point(), "start, t = 0")
      .field("to", point(), "end, t = 1")
      .built_by([](const Fields& f) { return Segment(f.vec3("from"), f.vec3("to")); });
}

}  // namespace lekalo::geometry
