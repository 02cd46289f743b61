// Straight segment, r(t) = (1 - t) p_0 + t p_1, t in [0, 1] (Golovanov 2016, 2.3).
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

class Segment final : public Curve {
 public:
  // Throws FieldError (field to) when the points coincide.
  Segment(const Vec3& from, const Vec3& to);

  Interval domain() const override { return {0, 1}; }
  bool is_closed() const override { return false; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override { return kMaxCurveEnclosureOrder; }
  std::optional<NurbsCurveForm> as_nurbs() const override;

  const Vec3& from() const { return from_; }
  const Vec3& to() const { return to_; }

 private:
  Vec3 from_, to_;
};

}  // namespace lekalo::geometry
