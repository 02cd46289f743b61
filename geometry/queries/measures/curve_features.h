// Places of a curve where something happens to its shape, and numbers of its shape as a whole.
//
//   inflection  of a plane curve: the curvature changes its sign; of one in space: it vanishes (straightening point)
//   vertex      of a plane curve: its signed curvature is largest or least; of one in space: its curvature
//   cusp, rest  r' = 0: the tangent turns back, or goes on                       (Golovanov 2016, 2.1; do Carmo 1976)
//   corner      the tangent jumps between smooth pieces
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

struct CurveFeature {
  enum class Kind { inflection, vertex, cusp, rest, corner };
  Kind kind = Kind::inflection;
  double t = 0;
  Vec3 point{0};
  double curvature = 0;  // of a vertex, signed on plane curves; else 0
  double angle = 0;      // of a corner or cusp, by which the tangent turns, radians
};

// inflection, vertex, cusp, rest, corner.
std::string_view name(CurveFeature::Kind kind);

struct CurveFeatures {
  std::vector<CurveFeature> points;  // by t
  bool plane = false, closed = false;
  Vec3 normal{0, 0, 1};      // of the plane: its largest component is positive; of a straight line (0, 0, 1)
  Measured total_curvature;  // integral of k ds, with the angles of corners and cusps
  std::optional<Measured> total_torsion;  // of curves in space without cusps and straight parts
  // Of closed plane curves, counterclockwise about the normal: how often the tangent turns (none where there is a
  // cusp), and the area that the curve goes round, parts that it goes round twice counted twice.
  std::optional<double> turning_number;
  std::optional<Measured> area;
};

// Inflections, cusps and rests are searched for by enclosures; vertices by changes of sign between 400 places of each
// smooth piece. Changes nearer to each other than 1e-7 of a piece, or of vertices than two places, are not told apart.
// Throws std::invalid_argument for an unbounded curve.
CurveFeatures curve_features(const Curve& curve);

// How often a closed plane curve goes round a point of its plane, counterclockwise about its normal. Throws
// std::invalid_argument where the curve is not closed or not plane, or the point is not in its plane or lies on it.
int winding_number(const Curve& curve, const Vec3& point);

}  // namespace lekalo::geometry
