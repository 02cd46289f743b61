// Bodies that booleans have made, drawn: hidden lines against an oracle of closed forms (support/sight_oracle.h), which
// knows the operands alone; and how long bodies of random pairs take to draw and to render.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ctime>

#include "geometry/bodies/booleans/body_pairs.h"
#include "geometry/bodies/booleans/boolean.h"
#include "render/drawing/line_truth.h"
#include "render/drawing/random_solids.h"
#include "render/film/render.h"
#include "support/sight_oracle.h"
#include "support/tier.h"

namespace lekalo::render::boolean_truth_test {
namespace {

using namespace geometry;

constexpr std::array kOperations{BooleanOperation::unite, BooleanOperation::intersect, BooleanOperation::subtract};

TEST(BooleanTruth, HiddenLines) {
  using Kind = oracle::sight::PairSolid::Kind;
  constexpr std::array kInOracle{Kind::unite, Kind::intersect, Kind::subtract};
  Views views(43);
  Found found;
  int bodies = 0, k = 0;
  for (const int wanted = tests::tier_count(50, tests::min_of_slow(8)); bodies < wanted; ++k) {
    const Part a = random_part(views, k, 0.5), b = random_part(views, k + 1 + k / 5, 0.8);
    Body body;
    try {
      body = boolean(kOperations[k % 3], a.body, b.body);
    } catch (const BooleanError& error) {
      EXPECT_TRUE(error.empty) << k << ": " << error.what();
      continue;
    }
    ++bodies;
    const auto solid = std::make_shared<oracle::sight::PairSolid>(kInOracle[k % 3], a.solid, b.solid);
    for (const bool central : {false, true}) {
      SmallScene scene;
      show(scene, std::make_shared<Body>(body), {"sharp", "smooth", "silhouette", "parameter"}, 3);
      views.look(scene, central);
      Truth(*scene.world(), sheets_of(std::vector<SolidPtr>{solid}), views, found);
    }
  }
  expect_right(found, "results");
  tests::report_figure("bodies", bodies);
}

// Less than a second of processor time each, at 640 x 480.
void expect_fast(const Body& body, Views& views, const std::string& what) {
  constexpr int kWidth = 640, kHeight = 480;
  SmallScene scene;
  show(scene, std::make_shared<Body>(body), {"sharp", "smooth", "silhouette"});
  scene.model.film.width = kWidth, scene.model.film.height = kHeight;
  scene.model.film.samples = 1;
  const Box3 box = bounds(body);
  const Vec3 direction = views.direction();
  scene.model.camera = make_camera(
      PerspectiveView{box.center() + 1.5 * box.diameter() * direction, box.center(), views.direction(), 0.8}, kWidth,
      kHeight);
  scene.light(PointLight{.position = box.center() + 2 * box.diameter() * views.direction()});
  const auto seconds = [](const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  EXPECT_LT(seconds([&] {
              const auto world = scene.world();
              EXPECT_EQ(visible_lines(*world, drawing_work(*world)).incomplete, 0) << what;
            }),
            1)
      << "drawn: " << what;
  EXPECT_LT(seconds([&] { render(*scene.world(), {}); }), 1) << "rendered: " << what;
}

void expect_fast_results(int pairs, unsigned seed, const std::function<BodyPair(BodyPairs&, int)>& make) {
  Views views(seed);
  int bodies = 0;
  for (int k = 0; k < pairs; ++k) {
    BodyPairs random(seed + static_cast<unsigned>(k));
    const BodyPair pair = make(random, k);
    try {
      expect_fast(boolean(kOperations[k % 3], pair.a, pair.b), views, fmt::format("{}, {}", k, pair.kind));
      ++bodies;
    } catch (const BooleanError&) {
      // Nothing is left, or refused, which the tests of random pairs count.
    }
  }
  EXPECT_GT(bodies, pairs / 2);
  tests::report_figure("bodies", bodies);
}

TEST(BooleanTruth, GeneralPairsAreFast) {
  expect_fast_results(tests::tier_count(1000, tests::min_of_slow(10)), 2000,
                      [](BodyPairs& random, int) { return random.general(); });
}

TEST(BooleanTruth, DegeneratePairsAreFast) {
  expect_fast_results(tests::tier_count(300, tests::min_of_slow(BodyPairs::kKinds)), 5000,
                      [](BodyPairs& random, int k) { return random.degenerate(k); });
}

}  // namespace
}  // namespace lekalo::render::boolean_truth_test
