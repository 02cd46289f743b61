// Completeness of the whole path of rays, Embree included: surfaces of all kinds against oracles that share nothing
// with the solvers, all hits along each ray and the nearest; and closed bodies are crossed an even number of times.
//
// In the full tier ten million random rays over all surfaces and a million aimed ones: along silhouettes, past them by
// 1e-3 to 1e-9 of the size on either side, and at or past seams, poles, edges and the borders of pieces and of their
// dyadic parts. Origins lie in the bounds, two, a thousand and a million sizes away; subjects also lie a thousand and a
// million sizes off the origin of coordinates.
//
// The band: a ray is in it where the oracle's own hits are others after a shift of 1e-9 of the size and of the rounding
// of the coordinates that go into the line: their number changes, one is gone and another appears, or they move as far
// as those found are off. Shifts go to the corners of a cube, in 24 directions, and to the surface around each hit that
// was found (at narrow corners of open surfaces, and where a line hardly turns from the surface, few others tell). It
// is in it, too, where a shift takes one of its hits from one side of the subject to the other, where two of its
// crossings are that near to each other or to its origin, and where the oracle cannot tell. Such rays are counted and
// reported; of the random ones there is at most one in ten thousand.
#include <gtest/gtest.h>

#include <set>

#include "render/completeness/all_entries.h"
#include "render/trace/world.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::completeness::completeness_test {
namespace {

const Vec3 kAway = glm::normalize(Vec3(6, -7, 4));  // where subjects off the origin lie
constexpr double kJump = 1e-4;                      // of the size: a hit that a shift moves farther is another one
constexpr int kAllRandom = 10000000, kAllAimed = 1000000;  // of all surfaces, in the full tier
constexpr int kMaxTries = 10;  // for each ray along a silhouette, which only some lines find

// From inside the bounds, from up to two sizes away, and now and then from a thousand or a million.
Ray random_ray(const Subject& subject, Random& random) {
  const double size = subject.box.diameter(), kind = unit(random);
  Ray ray;
  ray.direction = any_direction(random);
  const double distance = kind < 0.2 ? 0 : kind < 0.8 ? 2 * unit(random) : kind < 0.9 ? 1e3 : 1e6;
  // Beside flat subjects rather than in them.
  ray.origin = any_point(random, subject.box.inflated(0.05 * size)) - distance * size * ray.direction;
  return ray;
}

// Along a silhouette or past a special place; false where none was found.
bool aimed_ray(const Subject& subject, const World& world, Random& random, Ray& ray) {
  const double size = subject.box.diameter();
  const auto any_shift = [&](double least) { return size * std::pow(10.0, -3 + (least + 3) * unit(random)); };
  Vec3 through;
  if (!subject.special || unit(random) < 0.5) {
    Ray finder = random_ray(subject, random);
    finder.origin = any_point(random, subject.box) - 2 * size * finder.direction;
    const std::vector<Hit> hits = world.all_hits(finder);
    if (hits.empty()) return false;
    const SurfacePoint at = world.surface_point(finder, hits[static_cast<size_t>(unit(random) * hits.size())]);
    const Vec3 normal = at.geometric_normal;
    const Vec3 across = glm::cross(normal, any_direction(random));
    if (!(glm::length(across) > 0.01)) return false;
    ray.direction = glm::normalize(across);
    through = at.position + (unit(random) < 0.5 ? 1 : -1) * any_shift(-9) * normal;
  } else {
    const auto [place, other] = subject.special(random);
    const bool along = unit(random) < 0.2 && glm::length(other - place) > 1e-3 * size;
    ray.direction = along ? glm::normalize(other - place) : any_direction(random);
    through = unit(random) < 0.3 ? place : place + any_shift(-12) * any_direction(random);
  }
  const double kind = unit(random);
  ray.origin = through - (kind < 0.6 ? 2 * unit(random) : kind < 0.8 ? 1e3 : 1e6) * size * ray.direction;
  return true;
}

// Exactly, as C++ reads it.
std::string text_of(const Ray& ray) {
  const auto vector = [](const Vec3& v) { return fmt::format("{{{:a}, {:a}, {:a}}}", v.x, v.y, v.z); };
  return fmt::format("ray {{{}, {}}}", vector(ray.origin), vector(ray.direction));
}

struct Tally {
  int rays = 0, hits = 0, wrong = 0, band = 0, other = 0;  // other: nearest or shadow not as all hits say
  double worst = 0;                                        // difference of t, of the size
  void add(const Tally& t) {
    rays += t.rays, hits += t.hits, wrong += t.wrong, band += t.band, other += t.other;
    worst = tests::worse(worst, t.worst);
  }
};

class Comparison {
 public:
  Comparison(const Subject& subject, const World& world)
      : subject_(subject), world_(world), size_(subject.box.diameter()) {}

  void compare(const Ray& ray, Tally& tally) {
    bool undecided = false;
    const std::vector<double> truth = truth_of(ray, undecided);
    const std::vector<Hit> found = world_.all_hits(ray);
    ++tally.rays;
    tally.hits += static_cast<int>(truth.size());
    if (same(ray, found, truth, tally.worst)) {
      tally.other += !agrees(ray, found);
      return;
    }
    if (undecided || in_band(ray, found, truth)) {
      ++tally.band;
      return;
    }
    if (++tally.wrong <= 5) ADD_FAILURE() << description(ray, found, truth);
  }

 private:
  // What the rounding of the coordinates that go into the line may move it by.
  double rounding(const Ray& ray) const {
    return 8e-16 * (glm::length(ray.origin) + glm::length(ray.origin - subject_.box.center()));
  }
  std::vector<double> truth_of(const Ray& ray, bool& undecided) const {
    std::vector<double> t = subject_.truth(ray, undecided);
    std::erase_if(t, [&](double x) { return x < ray.t_min; });
    return t;
  }
  bool same(const Ray& ray, const std::vector<Hit>& found, const std::vector<double>& truth, double& worst) const {
    if (found.size() != truth.size()) return false;
    double largest = 0;
    for (size_t i = 0; i < found.size(); ++i) {
      const double off = std::abs(found[i].t - truth[i]);
      if (off > subject_.same * size_) {
        // The rounding of the line is seen under the angle.
        const SurfacePoint at = world_.surface_point(ray, found[i]);
        const double slope = std::abs(glm::dot(at.geometric_normal, ray.direction));
        if (off > subject_.same * size_ + rounding(ray) / std::max(slope, 1e-5)) return false;
      }
      largest = tests::worse(largest, off / size_);
    }
    worst = tests::worse(worst, largest);
    return true;
  }
  bool in_band(const Ray& ray, const std::vector<Hit>& found, const std::vector<double>& truth) const {
    const double reach = subject_.band * size_ + rounding(ray);
    bool undecided = false;
    const std::vector<double> all = subject_.truth(ray, undecided);
    for (size_t i = 0; i < all.size(); ++i)
      if (std::abs(all[i] - ray.t_min) <= reach || (i > 0 && all[i] - all[i - 1] <= reach)) return true;
    // How far the shifts move the hits: farther than those found are off, where the line passes an edge of two faces.
    std::vector<double> moves(truth.size(), 0.0);
    const auto changes = [&](const Vec3& shift) {
      Ray shifted = ray;
      shifted.origin += shift;
      const std::vector<double> there = truth_of(shifted, undecided);
      if (there.size() != truth.size() || undecided) return true;
      for (size_t i = 0; i < truth.size(); ++i) {
        const double moved = std::abs(there[i] - truth[i]);
        if (moved > kJump * size_) return true;  // not the same hit: one is gone, and there is another
        moves[i] = tests::worse(moves[i], moved);
      }
      return false;
    };
    Random random(1);
    for (int copy = 0; copy < 8; ++copy)
      if (changes(reach * Vec3(copy & 1 ? 1 : -1, copy & 2 ? 1 : -1, copy & 4 ? 1 : -1))) return true;
    for (int copy = 8; copy < 32; ++copy)
      if (changes(std::sqrt(3) * reach * any_direction(random))) return true;
    for (const Hit& hit : found) {
      // What was found beside a narrow corner, or where the line hardly turns from the surface, few shifts lead to.
      const SurfacePoint at = world_.surface_point(ray, hit);
      // So flat that a shift takes the hit from one side of the subject to the other: the line runs in the surface.
      if (std::abs(glm::dot(at.geometric_normal, ray.direction)) * size_ <= reach) return true;
      const Vec3 to_hit = at.position - ray.at(hit.t);
      const double lu = glm::length(at.du), lv = glm::length(at.dv);
      for (int u = -1; u <= 1; ++u)
        for (int v = -1; v <= 1; ++v) {
          Vec3 lateral_offset(0);
          if (u != 0 && lu > 0) lateral_offset += u / lu * at.du;
          if (v != 0 && lv > 0) lateral_offset += v / lv * at.dv;
          if (glm::length(lateral_offset) > 0) lateral_offset *= reach / glm::length(lateral_offset);
          Vec3 shift = to_hit + lateral_offset;
          shift -= glm::dot(shift, ray.direction) * ray.direction;
          if (glm::length(shift) <= std::sqrt(3) * reach && changes(shift)) return true;
        }
    }
    bool moved = found.size() == truth.size();
    for (size_t i = 0; moved && i < truth.size(); ++i) moved = std::abs(found[i].t - truth[i]) <= moves[i];
    return moved;
  }
  // The nearest hit and shadows are decided on paths of their own.
  bool agrees(const Ray& ray, const std::vector<Hit>& found) const {
    Hit nearest;
    const bool met = world_.nearest(ray, nearest);
    if (met != !found.empty() || (met && nearest.t != found[0].t)) return false;
    Ray shadow = ray;
    shadow.kind = RayKind::shadow;
    if (world_.occluded(shadow) != met) return false;
    if (!met) return true;
    shadow.t_max = found[0].t * (1 - 1e-9);
    return shadow.t_max <= shadow.t_min || !world_.occluded(shadow);
  }
  std::string description(const Ray& ray, const std::vector<Hit>& found, const std::vector<double>& truth) const {
    std::string text = fmt::format("{} (from {} sizes away), found", text_of(ray),
                                   glm::length(ray.origin - subject_.box.center()) / size_);
    for (const Hit& hit : found) text += fmt::format(" {} ({}, {})", hit.t, hit.u, hit.v);
    text += ", expected";
    for (const double t : truth) text += fmt::format(" {}", t);
    return text;
  }

  const Subject& subject_;
  const World& world_;
  double size_;
};

using Completeness = OfAllEntries;

void report(const std::string& kind, const Tally& tally) {
  tests::report_figure(kind + "_rays", tally.rays);
  tests::report_figure(kind + "_hits", tally.hits);
  tests::report_figure(kind + "_in_band", tally.band);
  tests::report_figure(kind + "_missing_or_false", tally.wrong);
}

TEST_P(Completeness, NoMissAndNoFalseHit) {
  const Entry& entry = entries()[GetParam()];
  const auto share = [&](int all) { return tests::tier_count(all / static_cast<int>(entries().size()) + 1); };
  const double size = entry.make(Vec3(0)).box.diameter();
  Random random(GetParam() + 1);
  Tally any, aimed;
  for (const auto& [distance, part] : {std::pair(0.0, 0.8), std::pair(1e3, 0.1), std::pair(1e6, 0.1)}) {
    const Subject subject = entry.make(distance * size * kAway);
    const World world(model_of(subject));
    Comparison comparison(subject, world);
    for (int k = static_cast<int>(part * share(kAllRandom)); k > 0; --k)
      comparison.compare(random_ray(subject, random), any);
    Ray ray;
    const int rays = static_cast<int>(part * share(kAllAimed));
    for (int found = 0, tries = 0; found < rays && tries < kMaxTries * rays; ++tries)
      if (aimed_ray(subject, world, random, ray)) comparison.compare(ray, aimed), ++found;
  }
  EXPECT_EQ(any.wrong, 0) << "of " << any.rays;
  EXPECT_EQ(aimed.wrong, 0) << "of " << aimed.rays;
  EXPECT_EQ(any.other + aimed.other, 0) << "rays whose nearest hit or shadow is not as all hits say";
  EXPECT_LE(any.band, 1 + any.rays / 10000);
  EXPECT_GT(any.hits, any.rays / 20);
  report("random", any);
  report("aimed", aimed);
  tests::report_figure("largest_difference_of_t", std::max(any.worst, aimed.worst));
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Completeness, testing::Range<size_t>(0, all_entries().size()),
                         OfAllEntries::name_of);

// Rays that the suite found wrong once; none is in the band.
TEST(CompletenessOfRays, ThatWereWrongOnce) {
  struct Case {
    std::string name;
    double distance;  // of the subject off the origin, in sizes
    Ray ray;
  };
  const auto ray = [](const Vec3& origin, const Vec3& direction) {
    Ray made;
    made.origin = origin;
    made.direction = direction;
    return made;
  };
  const Case cases[] = {
      // Normals of a pole's neighbourhood pointed both ways: one crossing twice.
      {"spindle", 1e3,
       ray({0x1.26019abc04244p+11, -0x1.56ee7d0d0915bp+11, 0x1.87e0722a4798ap+10},
           {-0x1.2de2b34ce8084p-4, -0x1.73a8d501edd4dp-1, -0x1.5e20a0c1d40c1p-1})},
      // Grazes where a weight is a thousandth of others: their rounding was taken for its own.
      {"weights_1e6_7_4", 0,
       ray({0x1.16641562f8ebep+9, -0x1.cc5f3fbca97fbp+10, -0x1.62230521c4446p+7},
           {-0x1.26b06ad2e3d51p-2, 0x1.e815bf229de96p-1, 0x1.77cd1197c18cdp-4})},
      {"weights_1e6_7_4", 0,
       ray({-0x1.1bd76059dd0e2p+9, 0x1.cd6fa7f5baec7p+10, 0x1.17694529dcc49p+5},
           {0x1.2d65ca47d69dbp-2, -0x1.e93ba358819cap-1, -0x1.26fd072a31d2fp-6})},
      // Lines across one parameter: the cell shrank to the rounding of the surface's points, where nothing settles.
      {"formula_ruled_cubic", 0,
       ray({-0x1.7e76bd9efd959p+0, 0x1.6666664819c2dp-2, 0x1.9012fa878e6c6p+2},
           {0x1.cdd0b4e4c763cp-3, 0x0p+0, -0x1.f2d02144c2a8p-1})},
      {"formula_torus", 1e3,
       ray({0x1.21c73f7c725cap+12, -0x1.52160f0843bdep+12, 0x1.82463fd0ef3bcp+11},
           {0x1.736753db8ab45p-4, 0x1.fde40ea4ae905p-1, 0x0p+0})},
      // In the plane of the seam, past the inner circle: a part of a cell was left out that the slack reached.
      {"formula_torus", 1e3,
       ray({0x1.222dc414df092p+12, -0x1.52202b6dbf6bp+12, 0x1.82463fd0ef3bcp+11},
           {-0x1.ce21dededd5aap-1, 0x1.b8ce9fe2db24ap-2, 0x0p+0})},
      // Past the double line, nearly in one of its sheets: the two hits were taken for one crossing.
      {"formula_umbrella", 1e3,
       ray({-0x1.dc9d7957a72fdp+9, -0x1.f8cfe6cb66f4bp+9, 0x1.d72a0dc0c99e2p+11},
           {0x1.e61d02495685p-3, 0x1.016fa4e692efp-2, -0x1.e06c5c0d07be6p-1})},
  };
  for (const Entry& entry : all_entries())
    for (const Case& one : cases) {
      if (one.name != entry.name) continue;
      const Subject subject = entry.make(one.distance * entry.make(Vec3(0)).box.diameter() * kAway);
      const World world(model_of(subject));
      Tally tally;
      Comparison(subject, world).compare(one.ray, tally);
      EXPECT_EQ(tally.wrong + tally.other + tally.band, 0) << one.name;
    }
}

// The closed ones of all entries, and more.
std::vector<Entry> all_closed_entries() {
  std::vector<Entry> entries = closed_entries();
  for (const Entry& entry : all_entries())
    if (entry.closed) entries.push_back(entry);
  return entries;
}

class Parity : public testing::TestWithParam<size_t> {
 protected:
  static const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = all_closed_entries();
    return all;
  }
};

// A ray with an odd number is in the band if it grazes an edge: the numbers of its shifts by 1e-9 of the size (and of
// the rounding of its coordinates) are even, but for few, and not all the same.
TEST_P(Parity, EveryRayFromOutsideCrossesAnEvenNumberOfTimes) {
  const Entry& entry = entries()[GetParam()];
  const auto share = [&](int all) { return tests::tier_count(all / static_cast<int>(entries().size()) + 1); };
  const double size = entry.make(Vec3(0)).box.diameter();
  Random random(1000 + GetParam());
  struct Count {
    int rays = 0, hits = 0, odd = 0, band = 0;
  } any, aimed;
  for (const auto& [distance, part] : {std::pair(0.0, 0.8), std::pair(1e3, 0.1), std::pair(1e6, 0.1)}) {
    const Subject subject = entry.make(distance * size * kAway);
    const World world(model_of(subject));
    const Vec3 center = subject.box.center();
    const auto grazes = [&](const Ray& ray) {
      const double reach = 1e-9 * size + 8e-16 * (glm::length(ray.origin) + glm::length(ray.origin - center));
      Random shifts(1);
      std::set<size_t> counts;
      int still_odd = 0;
      for (int copy = 0; copy < 32; ++copy) {
        Ray shifted = ray;
        shifted.origin += std::sqrt(3) * reach * any_direction(shifts);
        const size_t count = world.all_hits(shifted).size();
        count % 2 == 0 ? static_cast<void>(counts.insert(count)) : static_cast<void>(++still_odd);
      }
      // A shift along the edge changes nothing.
      return counts.size() > 1 && still_odd <= 2;
    };
    const auto follow = [&](Ray ray, Count& count) {
      // From outside: at least one size before the middle of the bounds.
      const double before = glm::dot(ray.origin - center, ray.direction) / size;
      if (before > -1) ray.origin -= (before + 1) * size * ray.direction;
      const size_t hits = world.all_hits(ray).size();
      ++count.rays;
      count.hits += static_cast<int>(hits);
      if (hits % 2 == 0) return;
      if (grazes(ray)) {
        ++count.band;
      } else if (++count.odd <= 5) {
        ADD_FAILURE() << hits << " crossings of " << text_of(ray);
      }
    };
    for (int k = static_cast<int>(part * share(kAllRandom)); k > 0; --k) follow(random_ray(subject, random), any);
    Ray ray;
    const int rays = static_cast<int>(part * share(kAllAimed));
    for (int found = 0, tries = 0; found < rays && tries < kMaxTries * rays; ++tries)
      if (aimed_ray(subject, world, random, ray)) follow(ray, aimed), ++found;
  }
  EXPECT_EQ(any.odd, 0) << "of " << any.rays;
  EXPECT_EQ(aimed.odd, 0) << "of " << aimed.rays;
  EXPECT_LE(any.band, 1 + any.rays / 100000);
  EXPECT_GT(any.hits, any.rays / 20);
  for (const auto& [kind, count] : {std::pair("random", any), std::pair("aimed", aimed)}) {
    tests::report_figure(std::string(kind) + "_rays", count.rays);
    tests::report_figure(std::string(kind) + "_in_band", count.band);
    tests::report_figure(std::string(kind) + "_odd", count.odd);
  }
}

std::string name_of_closed(const testing::TestParamInfo<size_t>& info) {
  return word(all_closed_entries()[info.param].name);
}

INSTANTIATE_TEST_SUITE_P(ClosedShapes, Parity, testing::Range<size_t>(0, all_closed_entries().size()), name_of_closed);

}  // namespace
}  // namespace lekalo::render::completeness::completeness_test
