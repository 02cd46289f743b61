// Interpolation by blended circular arcs in the plane and in space (Zavyalov, Leus, Skorospelov 1985, III.1, III.2).
//
// Between the nodes P, Q with the chord l e, with A before P and B behind Q, the curve is a mean of the circles through
// A, P, Q and through P, Q, B:
//
//   r(x) = P + x e + (l - x)/l g(x, a) + x/l g(x, b),   0 <= x <= l
//   g(x, a) = a x (l - x) / (sqrt(1 - |a|^2 l^2/4) + sqrt(1 - |a|^2 (x - l/2)^2)),   a = 2 n(P - A)/(|P - A||Q - A|)
//
// n the part across e; |a| is the curvature of the circle, a points from the chord to the arc (0 for points on a line).
// The tangent at a node is that of the circle through it and its neighbours (G1); the parameter is the sum of chords.
// The first and the last segment of an open curve have one circle. Each arc must be shorter than a half circle.
#pragma once

#include <optional>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

// How far the interpolant may be from the curve that its nodes are of, by the curvatures k and the torsion of that
// curve over three neighbouring segments (III.1, formulas 136, 138; III.2, formulas 143, 147, 149, 153), the worst
// segment's. H(k) = (1 - sqrt(1 - (l k/2)^2))/k is the height of an arc over the chord.
//   plane  position H(k_max) - H(k_min),  angle l k/sqrt(1 - (l k/2)^2), k the largest |k|
//   space  with t the largest turn of a segment, k_max S, and P the integral of |torsion|: the plane curvatures are in
//          [k_min cos P, k_max/cos^2 t], position sqrt(H1^2 + H2^2 - 2 H1 H2 cos F), F = 2 atan(tan(P/2)/cos t),
//          angle t + atan(position/(l cos t))
struct ArcBlendBounds {
  double position = 0;  // length
  double angle = 0;     // radians
};

class ArcBlendCurve final : public Curve {
 public:
  // Nodes, unrepeated if closed. At least 2, 3 when closed. Throws FieldError (field points) for coinciding neighbours
  // and for an arc of a half circle or more.
  ArcBlendCurve(std::vector<Vec3> nodes, bool closed);

  Interval domain() const override { return {0, breaks_.back()}; }
  double period() const override { return closed_ ? breaks_.back() : 0; }
  bool is_closed() const override { return closed_; }
  CurveJet evaluate(double t, int order) const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  // One for each segment.
  std::vector<CurvePiece> pieces() const override;

  int segments() const { return static_cast<int>(segments_.size()); }
  // Of the curve that it interpolates, where that is known.
  const std::optional<ArcBlendBounds>& bounds() const { return bounds_; }
  void set_bounds(const ArcBlendBounds& bounds) { bounds_ = bounds; }

 private:
  struct Segment {
    Vec3 from{0}, along{0};  // unit vector
    double length = 0;
    Vec3 first{0}, second{0};  // a and b
  };
  template <class T>
  auto formula(const Segment& segment, const T& x) const;
  int segment_at(double t) const;

  bool closed_;
  std::vector<Segment> segments_;
  std::vector<double> breaks_;
  std::optional<ArcBlendBounds> bounds_;
};

// From nodes at these parameters of a curve, the ends of the domain among them. Curvature and torsion are taken at 33
// places of each segment. Nothing where the turn of a segment or a plane's torsion leaves no bound (more nodes do).
std::optional<ArcBlendBounds> arc_blend_bounds(const Curve& curve, const std::vector<double>& parameters);

}  // namespace lekalo::geometry
