// Tubes: all that a ball sweeps whose center moves along a curve (pipe and canal surfaces, with what closes them).
#pragma once

#include "geometry/shape.h"
#include "geometry/shapes/tube/ball_sweep.h"
#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

// How a tube ends.
enum class Caps {
  round,  // with the last balls
  flat,   // cut off across the curve
  none    // the same, and open
};

// The union of the balls about r(t) with radius R(t). Flat ends (and none): the balls of the stretch that begins at the
// end, as far as they reach behind the plane across the curve there, are cut by it. A curve that is closed has no ends.
//
// u is the curve's parameter t, v the angle about the curve from a direction that turns with it no more than it must
// (Wang, Juettler, Zheng, Liu 2008), beginning with any. At a closed curve's seam v may jump.
class Tube final : public Shape {
 public:
  // Throws FieldError (fields of, radius).
  Tube(CurvePtr curve, RadiusLaw radius, Caps caps);

  Box3 bounds() const override { return box_; }
  // face: 0 the wall and round ends, 1 and 2 the flat end where the curve begins and where it ends.
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  // du is zero on ends, and so is dv on flat ones.
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  // A circle of the wall about the curve is a line of curvature, of the curvature -1/R.
  std::optional<Mat3> shape_operator(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return caps_ != Caps::none; }
  std::string how_to_close() const override { return "a tube is closed with caps: round, or flat"; }

  // Of a thin tube the wall and round ends, cut where the balls' centers are about a radius apart; then the flat ends.
  std::vector<SurfacePart> surface_parts() const override;
  Box3 piece_box(const PieceOfSurface& piece) const override;
  PieceOfSurface piece_of(const SurfaceHit& hit) const override;

  const BallSweep& sweep() const { return sweep_; }
  Caps caps() const { return caps_; }  // round for closed curves
  // The flat or open ends.
  struct End {
    Vec3 point{0};
    Vec3 inward{0};
    int begin = 0, end = 0;  // the cells that its plane cuts
  };
  const End& end(int side) const { return ends_[side]; }
  // True if the point is inside of the tube, for open ends as if they were closed.
  bool holds(const Vec3& p) const;
  // True if an end's plane cuts off this point of the ball at t.
  bool is_cut_off(const Vec3& p, double t) const;
  LineMethod method() const override {
    return {"ball sweep", sweep_.cells().size(), sweep_.cells().size() * sizeof(BallSweep::Cell)};
  }

 private:
  void find_ends();
  SpanLimit limit(int cell, const Line& line) const;
  Vec3 reference(int cell, double t, const Vec3& tangent) const;
  int64_t pieces_in(int cell) const { return first_piece_[cell + 1] - first_piece_[cell]; }
  Box3 box_of_balls(int cell, int64_t piece) const;

  BallSweep sweep_;
  Caps caps_;
  std::array<End, 2> ends_;
  struct Start {
    Vec3 point;
    Vec3 tangent;
    Vec3 reference;  // of v = 0
  };
  std::vector<Start> starts_;            // of each cell, where it begins
  std::vector<int64_t> first_piece_{0};  // of each cell, and the count of all
  bool is_thin_ = false;                 // the pieces' boxes are much less than the whole's
  Box3 box_;
  Vec3 center_{0};
  BoxTree tree_;
};

}  // namespace lekalo::geometry
