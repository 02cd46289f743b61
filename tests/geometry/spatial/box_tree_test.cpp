#include "geometry/spatial/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/tier.h"

namespace lekalo::geometry::box_tree_test {
namespace {

// The part of a line in a box, in long double. `by`: the box is larger by so much.
struct Inside {
  long double enter, leave;
};
Inside inside(const Box3& box, const Line& line, const Interval& t, long double by) {
  Inside part{t.lo, t.hi};
  for (int k = 0; k < 3; ++k) {
    const long double o = line.origin[k], d = line.direction[k];
    const long double lo = box.lo[k] - by - o, hi = box.hi[k] + by - o;
    if (d == 0) {
      if (lo > 0 || hi < 0) return {1, 0};
      continue;
    }
    part.enter = std::max(part.enter, std::min(lo / d, hi / d));
    part.leave = std::min(part.leave, std::max(lo / d, hi / d));
  }
  return part;
}

// Lines at random, along axes, in the planes of sides and through corners, from near and far, over boxes of which some
// are flat or unbounded.
TEST(BoxTree, LinesMeetTheBoxesThatTheyAreIn) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&](double reach) {
    const double x = unit(random), y = unit(random);
    return reach * Vec3(x, y, unit(random));
  };
  int met = 0, visited_only = 0;
  for (int scene = 0; scene < tests::tier_count(400, 40); ++scene) {
    const Vec3 off = scene % 3 == 0 ? any(1e6) : Vec3(0);
    std::vector<Box3> boxes;
    for (int i = 0; i < 40; ++i) {
      Box3 box;
      const Vec3 at = off + any(5);
      box.include(at);
      box.include(at + (i % 7 == 0 ? Vec3(unit(random), 0, unit(random)) : any(1)));
      if (i == 11) box.hi.z = kInfinity;
      boxes.push_back(box);
    }
    const BoxTree tree(boxes);
    for (int k = 0; k < 200; ++k) {
      const Box3& aimed = boxes[static_cast<size_t>(k) % 11];
      Line line{off + any(k % 4 == 0 ? 1e5 : 8), any(1)};
      if (k % 5 == 1) line.direction = aimed.lo - line.origin;
      if (k % 5 == 2) line.direction[k % 3] = 0;
      if (k % 5 == 3) {
        line.direction = Vec3(0);
        line.direction[k % 3] = k % 2 ? 1 : -1;
      }
      if (k % 2) line.origin[(k + 1) % 3] = aimed.hi[(k + 1) % 3];
      if (line.direction == Vec3(0)) continue;
      const Interval t = k % 3 ? Interval{-kInfinity, kInfinity} : Interval{0, 1.5};
      std::set<int> visited;
      tree.along(line, t, [&](int i) { EXPECT_TRUE(visited.insert(i).second); });
      for (int i = 0; i < 40; ++i) {
        const Inside exact = inside(boxes[i], line, t, 0);
        if (exact.enter <= exact.leave) {
          ++met;
          EXPECT_TRUE(visited.count(i)) << "scene " << scene << ", line " << k << ", box " << i;
        } else if (visited.count(i)) {
          ++visited_only;  // for rounding
          const long double near = 1e-14L * (glm::length(line.origin) + glm::length(off) + 10);
          const Inside larger = inside(boxes[i], line, t, near);
          EXPECT_LE(larger.enter, larger.leave) << "scene " << scene << ", line " << k << ", box " << i;
        }
      }
    }
  }
  EXPECT_GT(met, 1000);
  tests::report_figure("met", met);
  tests::report_figure("visited_beside", visited_only);
}

}  // namespace
}  // namespace lekalo::geometry::box_tree_test
