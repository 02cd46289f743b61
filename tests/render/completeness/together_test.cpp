// Lists of rays find what each of their rays finds alone, bit by bit: bundles that pass through the hierarchy together,
// and others, over the surfaces of the completeness suite.
#include <gtest/gtest.h>

#include <bit>

#include "geometry/surfaces/analytic/plane.h"
#include "render/completeness/all_entries.h"
#include "render/trace/world.h"
#include "support/tier.h"

namespace lekalo::render::completeness::together_test {
namespace {

constexpr int kAllRays = 20000000;  // of all surfaces, in the full tier

bool same_bits(const Hit& a, const Hit& b) {
  const auto same = [](double x, double y) { return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y); };
  return same(a.t, b.t) && same(a.u, b.u) && same(a.v, b.v) && a.instance == b.instance && a.face == b.face &&
         a.piece == b.piece;
}

// Rays from one place, which may be on the surface, to places near each other.
std::vector<Ray> bundle(const Subject& subject, const World& world, Random& random) {
  const double size = subject.box.diameter(), kind = unit(random);
  const Vec3 target = any_point(random, subject.box);
  Ray first;
  const double distance = kind < 0.2 ? 0 : kind < 0.8 ? 2 * unit(random) : kind < 0.9 ? 1e3 : 1e6;
  first.origin = any_point(random, subject.box.inflated(0.05 * size)) - distance * size * any_direction(random);
  first.direction = glm::normalize(target - first.origin);
  Hit hit;
  if (unit(random) < 0.3 && world.nearest(first, hit)) {
    const SurfacePoint at = world.surface_point(first, hit);
    world.leave(at, at.geometric_normal, first);
  }
  const double width = size * std::pow(10, -5 * unit(random));
  std::vector<Ray> rays(1 + static_cast<size_t>(40 * unit(random)), first);
  for (Ray& ray : rays) {
    ray.direction = glm::normalize(target + width * any_direction(random) - ray.origin);
    if (unit(random) < 0.1) ray.t_max = 3 * size * unit(random);
    if (unit(random) < 0.1) ray.t_min = size * unit(random);
  }
  return rays;
}

// With an unbounded ground beside the subject, which is in no hierarchy.
std::shared_ptr<const Model> model_on_ground(const Subject& subject) {
  auto model = std::make_shared<Model>(*model_of(subject));
  Object ground;
  const Vec3 through = subject.box.lo + 0.3 * subject.box.size();
  ground.shape = SurfacePtr(std::make_shared<Plane>(frame_from(through, {0.1, 0.2, 1}, {1, 0, 0})));
  model->objects.push_back(std::move(ground));
  return model;
}

using Together = OfAllEntries;

TEST_P(Together, ListsOfRaysFindWhatTheirRaysFindAlone) {
  const Entry& entry = entries()[GetParam()];
  const double size = entry.make(Vec3(0)).box.diameter();
  const int count = tests::tier_count(kAllRays / static_cast<int>(entries().size()) + 1);
  Random random(2000 + GetParam());
  int done = 0, hits = 0;
  for (const double distance : {0.0, 1e3}) {
    const Subject subject = entry.make(distance * size * glm::normalize(Vec3(6, -7, 4)));
    const World world(distance == 0 ? model_of(subject) : model_on_ground(subject));
    for (const int end = done + count / 2; done < end;) {
      const std::vector<Ray> rays = bundle(subject, world, random);
      std::vector<Hit> together(rays.size());
      world.nearest(rays, together);
      const auto hidden = std::make_unique<bool[]>(rays.size());
      world.occluded(rays, {}, {hidden.get(), rays.size()});
      for (size_t i = 0; i < rays.size(); ++i) {
        Hit alone;
        const bool met = world.nearest(rays[i], alone);
        hits += met;
        ASSERT_EQ(met, together[i].instance >= 0) << "of ray " << i << " of " << rays.size();
        if (met) {
          ASSERT_TRUE(same_bits(alone, together[i])) << fmt::format("{:a} and {:a}", alone.t, together[i].t);
        }
        ASSERT_EQ(world.occluded(rays[i]), hidden[i]);
      }
      done += static_cast<int>(rays.size());
    }
  }
  EXPECT_GT(hits, done / 20);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Together, testing::Range<size_t>(0, all_entries().size()), OfAllEntries::name_of);

}  // namespace
}  // namespace lekalo::render::completeness::together_test
