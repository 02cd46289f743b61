// A surface, or a face of a body, as distances see it: its smooth patches, where it is sharp, and how to step into it;
// and the smooth pieces of curves and surfaces.
#pragma once

#include "geometry/queries/closest/distance_elements.h"

namespace lekalo::geometry {

struct FaceAdjacency {
  SurfacePtr surface;
  std::shared_ptr<const TrimRegion> trim;
  std::array<double, 2> scale{};  // ranges of u and v
  std::vector<DistanceElement*> patches;

  // The step from a place in that direction, none if that leads out of the sheet.
  std::optional<DistanceStep> step(const Vec2& from, const std::array<double, 2>& direction) const;
  void add_all_around(const Vec2& from, std::vector<DistanceStep>& steps) const;
  // To both sides of an image in the parameter plane.
  void add_across(const CurveJet& image, std::vector<DistanceStep>& steps) const;

  // Of the parameter i: ends of the domain that are `borders`, unless the surface goes on smoothly there, and creases.
  std::vector<double> sharp_places(int i, const Rectangle& domain, const Rectangle& borders) const;
  // That line is an element of its own for the patches that end there.
  void mark(int i, double at);
};

// Unit tangents that differ by more make a kink, derivatives across a line that differ by more of their length a
// crease.
inline constexpr double kSharp = 1e-9;

// Pieces that a transcendental parametrisation only has for its rational form are one smooth piece.
std::vector<CurvePiece> smooth_pieces(const Curve& curve);
std::vector<SurfacePiece> smooth_pieces(const Surface& surface);

// Whether they are so but for rounding; sets the element's axis.
bool is_straight(const CurvePiece& piece, const Curve& curve, DistanceElement& element);
bool is_plane(const SurfacePiece& piece, const Surface& surface, DistanceElement& element);

}  // namespace lekalo::geometry
