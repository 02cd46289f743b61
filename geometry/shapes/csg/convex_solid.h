// Convex solids with closed forms: half-spaces, and bodies that several half-spaces and at most one ball, round
// cylinder or nappe of a round cone have in common: boxes, convex prisms and pyramids, balls, cylinders, cones, frusta,
// and their affine images. A line is inside on one stretch, the common part of one stretch for each of them.
#pragma once

#include <optional>
#include <vector>

#include "geometry/body.h"
#include "geometry/shape.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/quadric_line.h"
#include "geometry/surfaces/analytic/sphere.h"

namespace lekalo::geometry {

// A line with what every solid along it asks for.
struct LineOfSolids {
  explicit LineOfSolids(const Line& l) : line(l), inverse_square(geometry::inverse_square(l.direction)) {}
  const Line& line;
  double inverse_square;  // 1 / |direction|^2
};

class ConvexSolid {
 public:
  // Nothing for a body of another form.
  static std::optional<ConvexSolid> of(const Body& body);
  // z <= 0 in the frame: one face, 0.
  static ConvexSolid half_space(const Frame& frame);

  // A line is inside from t = in to t = out, and crosses these faces there. Of an unbounded solid t may be infinite;
  // there is no face then.
  struct Stretch {
    double in = -kInfinity, out = kInfinity;
    int face_in = 0, face_out = 0;
  };
  // False if the line misses the solid, or only touches it. The same line meets the same plane or ball at the same t,
  // whatever solids they bound.
  bool stretch(const LineOfSolids& line, Stretch& inside) const;

  // What shows at a point of a face, which lies at `near` but for rounding; parameters and derivatives may be zero
  // where they are not asked for.
  ShapePoint point(int face, const Vec3& near, bool parameters) const;

 private:
  // -depth <= dot(p - at_hi, normal) <= 0; the depth may be infinite.
  struct Slab {
    Vec3 normal, at_hi, at_lo;  // a point of either side
    double depth;
    int face_lo, face_hi;
  };
  // A face's surface, which may be the image of one of three.
  struct Side {
    SurfacePtr surface;
    bool has_closest_point;
    const Plane* plane = nullptr;
    const SphereSurface* sphere = nullptr;
    const ConeSurface* cone = nullptr;
    bool mapped = false;
    Affine map, inverse;
    double sign = 1;  // of the outward normal

    explicit Side(SurfacePtr side);
  };
  enum class Round { none, ball, ellipsoid, cylinder, cone };

  ConvexSolid() = default;
  void add_plane(int face, const Vec3& through, const Vec3& normal);
  void add_round(int face);
  bool holds_corners_of(const Body& body) const;
  bool clip_to_slabs(const Line& line, Stretch& inside) const;
  bool clip_to_ball(const LineOfSolids& line, Stretch& inside) const;
  bool clip_to_quadric(const LineOfSolids& line, Stretch& inside) const;

  std::vector<Side> sides_;  // by face
  std::vector<Slab> slabs_;
  Round round_ = Round::none;
  int round_face_ = -1;
  Vec3 center_{0};     // of a ball or ellipsoid, a point of the axis of the others
  double radius_ = 0;  // of a ball
  // Of the others: coordinates in which the round side is quadric_ = 0 are to_unit_ (p - center_) + unit_center_.
  Mat3 to_unit_{1};
  Vec3 unit_center_{0};
  Quadric quadric_;
};

}  // namespace lekalo::geometry
