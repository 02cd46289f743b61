// Integrals over the parameter region of a face.
#pragma once

#include <functional>
#include <span>

#include "geometry/body.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {

// Writes `count` integrands at a point of the parameter plane; the area element du dv is not part of them.
using SurfaceIntegrand = std::function<void(const SurfaceJet& jet, std::span<double> values)>;

// Over a rectangle of the surface's parameters.
Integral integrate_over(const Surface& surface, const Rectangle& box, const SurfaceIntegrand& f, int count,
                        const IntegrationGoal& goal);

// Over the face of a body, inside its loops.
Integral integrate_over(const Body& body, int face, const SurfaceIntegrand& f, int count, const IntegrationGoal& goal);

}  // namespace lekalo::geometry
