// How long paths of light are followed, by all integrators that follow them.
#pragma once

#include <algorithm>

namespace lekalo::render {

// Boundaries in a row that are no boundaries for light; more can only be a broken scene.
inline constexpr int kMaxPasses = 1000;
// Paths live at least so many bounces, and then by chance (Russian roulette).
inline constexpr int kSafeBounces = 4;
inline constexpr double kLongestLife = 0.95, kMinLife = 0.02;

// The chance to go on of a path that still brings this share of its light.
inline double chance_to_live(double share) { return std::clamp(share, kMinLife, kLongestLife); }

}  // namespace lekalo::render
