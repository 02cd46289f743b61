// Where bands meet edges and faces, by Newton's iteration from places beside.
#pragma once

#include <optional>

#include "geometry/bodies/blends/blend_band.h"

namespace lekalo::geometry {

// A place of a band and of a curve.
struct BandOnCurve {
  double s = 0, z = 0, t = 0;
  Vec3 point{0};
};

// Where the border z of a band meets a curve (which goes on beyond its domain as curves do).
std::optional<BandOnCurve> border_on_curve(const BlendBand& band, double z, const Curve& curve, double s, double t);
// Where a band meets a curve.
std::optional<BandOnCurve> band_on_curve(const BlendBand& band, const Curve& curve, const BandOnCurve& near);

struct BandOnSurface {
  double s = 0;
  Vec2 place{0};
};
// Where the line z of a band meets a surface.
std::optional<BandOnSurface> line_on_surface(const BlendBand& band, double z, const Surface& surface,
                                             const BandOnSurface& near);

// Where the section of a band at s meets a surface: `s` of the result is z.
std::optional<BandOnSurface> section_on_surface(const BlendBand& band, double s, const Surface& surface,
                                                const BandOnSurface& near);

// The parameter of a curve at which it first comes near to the line through p along d, as it goes from one end of its
// domain.
double first_approach(const Curve& curve, bool from_end, const Vec3& p, const Vec3& d);

}  // namespace lekalo::geometry
