// Where curves and surfaces meet themselves: closed forms, singular cases whose truth is known, and random ones against
// chords and triangles.
#include "geometry/queries/self_intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/surfaces/formula_surface.h"
#include "geometry/surfaces/torus.h"
#include "geometry/surfaces/sphere.h"
#include "support/tier.h"

namespace lekalo::geometry {
namespace {

}  // namespace
}  // namespace lekalo::geometry
