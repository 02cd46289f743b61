// The motion of a section along a path with a frame (Golovanov 2016, 3.3.7), for whoever makes other things of it than
// one surface.
#pragma once

#include <array>
#include <vector>

#include "geometry/curve.h"
#include "geometry/describe.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Declares how the frame turns and the section changes: frame, start, twist, pitch, yaw, scale.
void declare_motion(TypeDeclaration& type);

// Through curves over one domain along the guide of the fields `along`, `at_v`, `frame` (Golovanov 2016, 3.4.9).
SurfacePtr guided_loft(const Fields& fields, const std::vector<CurvePtr>& curves);
// What the field `frame` of a guide accepts.
FieldType guide_frame();

class SectionMotion {
 public:
  // From the fields of declare_motion, `path`, and `rail` where that is declared. Throws FieldError.
  explicit SectionMotion(const Fields& fields);

  const CurvePtr& path() const { return path_; }  // by the fraction v of its length
  // Origin on the path, z along it; with a rail x runs to that, and z across x in the plane of both.
  Frame frame(double v) const;
  // By which a section grows besides its laws: the distance from the path to the rail, or 1.
  double reach(double v) const;
  // Where a section in the frame's coordinates stands, with its laws.
  Affine placement(double v) const;
  // What sections in the frame's coordinates sweep, over one domain and standing at these v; v in 0..1.
  SurfacePtr surface(const std::vector<CurvePtr>& sections, const std::vector<double>& at) const;

 private:
  CurvePtr path_, across_, rail_;  // the last two: one of them
  std::array<CurvePtr, 3> axes_;
};

}  // namespace lekalo::geometry
