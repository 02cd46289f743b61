// Curves on surfaces that are given by equations, and what is known of each: intersections of two surfaces (Golovanov
// 2016, 4.7 and 4.8), silhouettes (4.6), isophotes, reflection lines, sections by planes. Capabilities 4.6e, 4.7a-d,
// 4.8a-c. They are found in geometry/queries/contours.
//
// All of them are found, by one search (geometry/numerics/solution_curves.h) over each smooth piece of the surface or
// each pair of pieces that can meet, then joined over the borders of pieces into branches that are as long as they can
// be. Where branches cross, each goes straight on.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

// A contour that was found by a search and solves its equations anew where it is evaluated: its pieces are short arcs.
// Other contours have a closed form, and pieces of any length.
class SearchedCurve : public Curve {};
inline bool is_searched(const Curve& curve) { return dynamic_cast<const SearchedCurve*>(&curve) != nullptr; }

enum class ContourKind {
  crossing,  // the surfaces cross, the function changes its sign
  touching,  // the surfaces, or the surface and the plane, touch along it
  border     // of a region where they coincide
};

struct Contour {
  CurvePtr curve;                 // in space
  std::vector<Curve2Ptr> images;  // on the surface, or on both, with the same parameter
  bool closed = false;
  ContourKind kind = ContourKind::crossing;
  // Of silhouettes: where the curve runs along the line of sight, so that its picture has a cusp; by t.
  std::vector<double> cusps;
  double error = 0;  // the largest distance from the surfaces or from the true contour seen along it
};

enum class ContourPointKind {
  contact,   // isolated: the surfaces touch, the silhouette shrinks to a point
  crossing,  // branches cross here
  end        // branches end here, or turn back
};
struct ContourPoint {
  ContourPointKind kind = ContourPointKind::contact;
  Vec3 point{0};
  std::vector<double> parameters;  // u, v of the surface, or of both
  double distance = 0;             // between the surfaces
};

struct Contours {
  std::vector<Contour> branches;
  std::vector<ContourPoint> points;  // singular ones
  // There are regions where the surfaces coincide. Their borders are among the branches; a surface that coincides as a
  // whole, and is closed, has none.
  bool coincident = false;
  // False where something is left out: surfaces that nearly touch along a curve or nearly coincide, that touch in a way
  // that is not followed (through poles, to a higher order), a plane seen edge-on, a branch that stops inside.
  bool complete = true;
  // The branches are conics, straight lines and hippopedes, found without a search
  // (geometry/queries/contours/analytic/closed_contours.h).
  bool closed_form = false;
};

// How a scene is seen: along a direction, or from an eye.
struct ViewOf {
  bool central = false;
  Vec3 direction_or_eye{0, 0, -1};
};

}  // namespace lekalo::geometry
