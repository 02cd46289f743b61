// Milling cutters (Zavyalov, Leus, Skorospelov 1985, V.1): bodies of revolution about the axis q, which leads from the
// end to the spindle, through the reference point P, the centre of the end.
//
// The meridian in (distance from the axis, height over P), R the radius, rho the corner radius, a the angle, L the
// length:
//
//   end     from (0, 0) to (R - rho, 0)
//   corner  an arc of radius rho about (R - rho, rho), to (R - rho + rho cos a, rho (1 - sin a))
//   flank   from there in the direction (sin a, cos a) to the height L
//   top     from there to the axis
//
// Where rho > R the corner begins at the axis, in a point. Where rho < 0, |rho| > R, the end is hollow, a cap of the
// sphere of radius |rho|, and its rim is sharp. a = -90 degrees with L = 2 rho: a disc with a full round, without
// flank.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

struct Cutter {
  double radius = 1;
  double corner_radius = 0;
  double length = 1;
  double angle = 0;  // radians; positive: wider away from the end

  // Radius of the corner that touches: 0 of a hollow end.
  double rounding() const { return corner_radius > 0 ? corner_radius : 0; }
  // Of the circle on which the centres of the corner lie; negative for a pointed end, 0 for a ball end.
  double ring_radius() const { return radius - rounding(); }
  bool operator==(const Cutter&) const = default;
  bool has_ball_end() const { return ring_radius() == 0; }
  // Where the corner ends and the flank begins: x the distance from the axis, y the height.
  Vec2 flank_start() const;
  double top_radius() const;
  // Of the flank, carried on to the height 0.
  double flank_radius() const;
};

// The meridian's parts in the plane y = 0 of a frame (x the distance from the axis, z the height), from the axis at the
// end to the axis at the top, with their names: end, corner, flank, top. Parts without length are left out.
struct MeridianPart {
  const char* name;
  CurvePtr curve;
};
std::vector<MeridianPart> meridian(const Cutter& cutter, const Frame& frame);

// The fields of a cutter: radius, corner_radius, length, angle.
std::vector<Field> cutter_fields();
// Throws FieldError for what no cutter has; `prefix` is that of the field's names ("cutter." in a group).
Cutter read_cutter(const Fields& fields, const std::string& prefix = {});

}  // namespace lekalo::geometry
