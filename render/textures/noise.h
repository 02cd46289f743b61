// Gradient noise: a smooth random function of space without grain or direction.
#pragma once

#include <cstdint>

#include "geometry/vectors.h"

namespace lekalo::render {

// Perlin's noise ("Improving noise", 2002) with the gradients of the lattice's points from a hash of the seed: zero at
// whole coordinates, twice continuously differentiable, within [-1, 1].
double gradient_noise(const geometry::Vec3& place, uint64_t seed);

// Sum of `octaves` (>= 1) of it, each of half the grain and half the height of the one before, scaled to stay within
// [-1, 1].
double fractal_noise(const geometry::Vec3& place, int octaves, uint64_t seed);

}  // namespace lekalo::render
