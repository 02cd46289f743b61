// Pairs of surfaces that meet, ours and OCCT's of the same numbers, and OCCT's branches of their intersection.
#pragma once

#include <GeomAPI_IntSS.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <string>

#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "occt/occt_shapes.h"

namespace lekalo::geometry {

struct OcctTwin {
  SurfacePtr own;
  Handle(Geom_Surface) theirs;
};

inline OcctTwin twin_of(const NurbsSurface& surface) {
  return {std::make_shared<NurbsSurface>(surface), occt_spline(surface)};
}
inline OcctTwin sphere_twin(const Frame& frame, double radius) {
  return {std::make_shared<SphereSurface>(frame, radius), new Geom_SphericalSurface(occt_frame(frame), radius)};
}
inline OcctTwin torus_twin(const Frame& frame, double major, double minor) {
  return {std::make_shared<TorusSurface>(frame, major, minor),
          new Geom_ToroidalSurface(occt_frame(frame), major, minor)};
}
inline OcctTwin cone_twin(const Frame& frame, double radius, double top_radius, double height) {
  const Handle(Geom_Surface) whole =
      new Geom_ConicalSurface(occt_frame(frame), std::atan2(top_radius - radius, height), radius);
  return {std::make_shared<ConeSurface>(frame, radius, top_radius, height),
          new Geom_RectangularTrimmedSurface(whole, 0, std::hypot(top_radius - radius, height), false)};
}
inline OcctTwin cylinder_twin(const Frame& frame, double radius, double height) {
  return {std::make_shared<CylinderSurface>(frame, radius, height),
          new Geom_RectangularTrimmedSurface(new Geom_CylindricalSurface(occt_frame(frame), radius), 0, height, false)};
}
// The same surface as a spline.
inline OcctTwin spline_twin(const OcctTwin& twin) { return twin_of(NurbsSurface(*twin.own->as_nurbs())); }

struct OcctPair {
  std::string name;
  OcctTwin a, b;
};

// Every two of sphere, cylinder, cone and torus in random places so that they meet, `each` times.
inline std::vector<OcctPair> analytic_pairs(unsigned seed, int each) {
  static const char* const kNames[] = {"sphere", "cylinder", "cone", "torus"};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  const auto direction = [&] {
    const double x = normal(random), y = normal(random);
    return Vec3(x, y, normal(random));
  };
  const auto make = [&](int kind) {
    const Vec3 z = glm::normalize(direction()), x = direction();
    const double size = 0.8 + 0.4 * unit(random);
    const Frame frame = frame_from(0.4 * glm::normalize(direction()) - (kind == 1 || kind == 2 ? 2.0 : 0.0) * z, z, x);
    switch (kind) {
      case 0:
        return sphere_twin(frame, size);
      case 1:
        return cylinder_twin(frame, 0.7 * size, 4);
      case 2:
        return cone_twin(frame, 1.2 * size, 0.3 * size, 4);
      default:
        return torus_twin(frame, size, 0.4 * size);
    }
  };
  std::vector<OcctPair> pairs;
  for (int a = 0; a < 4; ++a)
    for (int b = a; b < 4; ++b)
      for (int k = 0; k < each; ++k) {
        const OcctTwin first = make(a);
        pairs.push_back({std::string(kNames[a]) + "_" + kNames[b] + "_" + std::to_string(k), first, make(b)});
      }
  return pairs;
}

// Rational bicubic sheets with `points` x `points` control points each over the same square.
inline std::vector<OcctPair> sheet_pairs(unsigned seed, int points, int count) {
  std::vector<OcctPair> pairs;
  const SplineAxis axis = points == 4 ? bezier_axis(3) : clamped_axis(3, points);
  for (int k = 0; k < count; ++k)
    pairs.push_back({"sheets_" + std::to_string(points) + "_" + std::to_string(k),
                     twin_of(random_sheet(seed + 2 * k, axis, axis)),
                     twin_of(random_sheet(seed + 2 * k + 1, axis, axis))});
  return pairs;
}

inline Vec3 occt_place(const Handle(Geom_Curve) & curve, double share) {
  const double first = curve->FirstParameter(), last = curve->LastParameter();
  return from_occt(curve->Value(first + share * (last - first)).XYZ());
}

struct OcctBranches {
  bool done = false;
  std::vector<Handle(Geom_Curve)> pieces;
  int closed = 0, open = 0;  // branches, pieces joined end to end
  std::vector<Vec3> ends;    // of open ones
  int count() const { return closed + open; }
};

// OCCT cuts branches where they cross a seam, and where its approximation ends a span: ends nearer than `gap` are one,
// and pieces shorter than it none.
inline OcctBranches occt_branches(const OcctPair& pair, double tolerance, double gap) {
  OcctBranches result;
  try {
    const GeomAPI_IntSS found(pair.a.theirs, pair.b.theirs, tolerance);
    if (!found.IsDone()) return result;
    for (int i = 1; i <= found.NbLines(); ++i) {
      const Handle(Geom_Curve)& piece = found.Line(i);
      double length = 0;
      for (int k = 0; k < 8; ++k) length += glm::length(occt_place(piece, (k + 1) / 8.0) - occt_place(piece, k / 8.0));
      if (length > gap) result.pieces.push_back(piece);
    }
  } catch (const Standard_Failure&) {
    return result;
  }
  result.done = true;
  // End 2 k and 2 k + 1 of piece k; each with its nearest other that is free.
  const int ends = 2 * static_cast<int>(result.pieces.size());
  std::vector<Vec3> places;
  for (int end = 0; end < ends; ++end) places.push_back(occt_place(result.pieces[end / 2], end % 2));
  std::vector<int> mate(ends, -1);
  for (;;) {
    int first = -1, second = -1;
    double least = gap;
    for (int a = 0; a < ends; ++a)
      for (int b = a + 1; b < ends; ++b)
        if (mate[a] < 0 && mate[b] < 0 && glm::length(places[a] - places[b]) < least)
          first = a, second = b, least = glm::length(places[a] - places[b]);
    if (first < 0) break;
    mate[first] = second, mate[second] = first;
  }
  std::vector<bool> seen(ends, false);
  const auto follow = [&](int end) {
    while (end >= 0 && !seen[end]) {
      seen[end] = seen[end ^ 1] = true;
      end = mate[end ^ 1];
    }
  };
  for (int end = 0; end < ends; ++end)
    if (mate[end] < 0) {
      result.ends.push_back(places[end]);
      if (!seen[end]) ++result.open, follow(end);
    }
  for (int end = 0; end < ends; ++end)
    if (!seen[end]) ++result.closed, follow(end);
  return result;
}

}  // namespace lekalo::geometry
