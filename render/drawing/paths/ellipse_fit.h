// Arcs of ellipses told from places on them: circles and other conics as a picture shows them.
#pragma once

#include <optional>
#include <vector>

#include "render/drawing/paths/paths.h"

namespace lekalo::render {

struct EllipticArc {
  PictureEllipse ellipse;
  double begin = 0, end = 0;  // angles of the first and the last place, at most a whole turn apart
};

// The arc on which these places follow one another in this order, none farther from it than `tolerance`; none where
// there is no such ellipse, where the arc is shorter than `min_turn` (radians), or where the ellipse is as narrow as
// a line. The first and the last place may be one. The lengths are those of the places.
std::optional<EllipticArc> elliptic_arc(const std::vector<Vec2>& places, double tolerance, double min_turn);

}  // namespace lekalo::render
