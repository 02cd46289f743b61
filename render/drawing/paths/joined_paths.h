// Paths that go on in one another, as one: what a pen draws without being lifted.
#pragma once

#include <optional>
#include <vector>

#include "render/drawing/paths/paths.h"

namespace lekalo::render {

// A path with where in space it begins and ends; none where it is cut there and goes on in nothing.
struct PathInSpace {
  Path path;
  std::optional<Vec3> begin, end;
};

// Ends that are one point in space (to `same`) and in the picture are joined: two that are alone there, and of more
// those that go on smoothly in one another. The paths are in the order of the first of each, and run as it does.
std::vector<PathInSpace> joined(const std::vector<PathInSpace>& paths, double same);

// Of each path, whether one of its ends is one point with another end: a corner at which it stays a path of its own.
std::vector<bool> ends_at_corners(const std::vector<PathInSpace>& paths, double same);

}  // namespace lekalo::render
