// The edge in which a band meets another surface: a face at the end of its edge, or the next band.
#pragma once

#include "geometry/bodies/blends/band_meetings.h"

namespace lekalo::geometry {

// A curve with its images on the band and on the other surface.
struct Crossing {
  CurvePtr curve;
  Curve2Ptr on_band, on_face;
};

// Between two places of a band, whose parameters on the other surface are `places`: the points where the lines z =
// const of the band meet it, fitted to 1e-13 of `size`; an arc or a straight line where that is a section. The
// parameter runs from the first to the second. Throws BlendError (of `edge`) where the lines do not meet the surface.
Crossing crossing(const BlendBand& band, const SurfacePtr& face, const std::array<BandOnCurve, 2>& ends,
                  const std::array<Vec2, 2>& places, double size, int edge);

// The same along the band: the points where the sections between two of its places meet a surface.
Crossing crossing_along(const BlendBand& band, const SurfacePtr& face, const std::array<BandOnCurve, 2>& ends,
                        const std::array<Vec2, 2>& places, double size, int edge);

}  // namespace lekalo::geometry
