// The certified solver against the halving oracle on random rational patches.
#include "geometry/queries/rays/line_cells.h"

#include <gtest/gtest.h>

#include <random>

#include "support/line_oracle.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::line_cells_test {
namespace {

struct RandomPatch {
  std::vector<Vec4> points;
  int p, q;
  PatchView view() const { return {points.data(), p, q}; }
};

// A bumpy height field over the unit square; `spread` is the ratio of largest to smallest weight.
RandomPatch random_patch(std::mt19937_64& random, int p, int q, double spread, bool collapsed_edge) {
  std::uniform_real_distribution<double> unit(0, 1);
  RandomPatch patch{{}, p, q};
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const double w = std::pow(spread, unit(random) - 0.5);
      Vec3 x(i / double(p) + 0.3 * (unit(random) - 0.5), j / double(q) + 0.3 * (unit(random) - 0.5), unit(random));
      if (collapsed_edge && i == 0) x = Vec3(0.1, 0.5, 0.4);
      patch.points.push_back(Vec4(w * x, w));
    }
  return patch;
}

Line random_line(std::mt19937_64& random, double distance) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 target(unit(random), unit(random), unit(random));
  const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
  return {target - distance * d, d};
}

struct Tally {
  int lines = 0, hits = 0, wrong = 0, band = 0;
  double worst = 0;
  ~Tally() {
    tests::report_figure("lines", lines);
    tests::report_figure("wrong", wrong);
    tests::report_figure("in_band", band);
  }
};

// Lines whose oracle count changes under shifts of 1e-9 of the size are in the tangency band and not counted.
void compare(const RandomPatch& patch, std::mt19937_64& random, int count, double distance, Tally& tally) {
  const oracle::PatchOracle truth(patch.points, patch.p, patch.q);
  const CellModel model = model_of(patch.view());
  for (int k = 0; k < count; ++k) {
    const Line line = random_line(random, distance);
    // As callers do: the line's foot point near the patch.
    const double foot_point = glm::dot(model.point - line.origin, line.direction);
    CellHits cell_hits;
    intersect(patch.view(), PatchCell(patch.view(), model, {}), LineBasis({line.at(foot_point), line.direction}),
              {-kInfinity, kInfinity}, cell_hits);
    std::vector<CellHit> found;
    for (int i = 0; i < cell_hits.size(); ++i) found.push_back(cell_hits[i]);
    std::sort(found.begin(), found.end(), [](const CellHit& a, const CellHit& b) { return a.t < b.t; });
    const std::vector<oracle::Root> roots = truth.roots(line);
    ++tally.lines;
    bool same = roots.size() == found.size();
    for (int i = 0; same && i < static_cast<int>(found.size()); ++i) {
      // The oracle says how many roots there are and roughly where (its plane equations lose digits with extreme
      // weights); a point of the patch on the line is a root whatever the oracle's last digits.
      const CellHit& hit = found[i];
      const Vec3 on_patch = truth.point((hit.x + 1) / 2, (hit.y + 1) / 2);
      const double residual = glm::length(line.at(foot_point + hit.t) - on_patch);
      tally.worst = tests::worse(tally.worst, residual);
      // The parameters are doubles: half a unit in their last place moves the point by so much.
      const PatchPoint at = evaluate(patch.view(), (hit.x + 1) / 2, (hit.y + 1) / 2);
      const double unit = 1.2e-16 * (glm::length(at.ds) + glm::length(at.dt));
      same = residual <= 1e-12 + 4 * unit && std::abs(foot_point + hit.t - roots[i].t) <= 1e-6;
    }
    tally.hits += static_cast<int>(roots.size());
    if (same) continue;
    bool band = false;
    for (int copy = 0; copy < 8 && !band; ++copy) {
      Line shifted = line;
      shifted.origin += 1e-9 * Vec3(copy & 1 ? 1 : -1, copy & 2 ? 1 : -1, copy & 4 ? 1 : -1);
      band = truth.roots(shifted).size() != roots.size();
    }
    if (band)
      ++tally.band;
    else
      ++tally.wrong;
  }
}

TEST(LineCells, FindEveryRootOfRandomPatches) {
  std::mt19937_64 random(1);
  Tally tally;
  for (int degree = 1; degree <= 7; ++degree)
    for (int n = 0; n < tests::tier_count(300, 3); ++n)
      compare(random_patch(random, degree, 8 - degree, 1, false), random, 30, 2, tally);
  EXPECT_EQ(tally.wrong, 0) << "of " << tally.lines << " lines, band " << tally.band << ", worst " << tally.worst;
  EXPECT_GT(tally.hits, tally.lines / 2);
}

TEST(LineCells, FindEveryRootWithExtremeWeights) {
  std::mt19937_64 random(2);
  Tally tally;
  for (int n = 0; n < tests::tier_count(1000); ++n)
    compare(random_patch(random, 3, 3, 1e6, false), random, 40, 2, tally);
  EXPECT_EQ(tally.wrong, 0) << "of " << tally.lines << " lines, band " << tally.band << ", worst " << tally.worst;
}

TEST(LineCells, FindEveryRootNearACollapsedEdge) {
  std::mt19937_64 random(3);
  Tally tally;
  for (int n = 0; n < tests::tier_count(1000); ++n) {
    const RandomPatch patch = random_patch(random, 3, 3, 1, true);
    compare(patch, random, 30, 2, tally);
    // Lines that pass the collapsed edge at small distances.
    const CellModel model = model_of(patch.view());
    std::normal_distribution<double> normal;
    for (double off : {1e-2, 1e-4, 1e-6}) {
      const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
      const Vec3 past = Vec3(0.1, 0.5, 0.4) + off * Vec3(normal(random), normal(random), normal(random));
      CellHits found;
      intersect(patch.view(), PatchCell(patch.view(), model, {}), LineBasis({past, d}), {-kInfinity, kInfinity}, found);
      EXPECT_EQ(found.size(), static_cast<int>(oracle::PatchOracle(patch.points, 3, 3).roots({past, d}).size()));
    }
  }
  EXPECT_EQ(tally.wrong, 0) << "of " << tally.lines << " lines, band " << tally.band << ", worst " << tally.worst;
}

TEST(LineCells, ALineThroughACollapsedEdgeHitsItOnce) {
  std::mt19937_64 random(4);
  const RandomPatch patch = random_patch(random, 3, 3, 1, true);
  CellHits found;
  intersect(patch.view(), PatchCell(patch.view(), model_of(patch.view()), {}),
            LineBasis({Vec3(0.1, 0.5, 2), Vec3(0, 0, -1)}), {-kInfinity, kInfinity}, found);
  int at_the_pole = 0;
  for (int i = 0; i < found.size(); ++i) at_the_pole += std::abs(found[i].t - 1.6) < 1e-9;
  EXPECT_EQ(at_the_pole, 1);
}

// Where meets_once says so, no line of the direction has two roots; gentle patches are nearly always known to have one.
TEST(LineCells, KnowWhichDirectionsMeetThemOnce) {
  std::mt19937_64 random(5);
  int known = 0, several = 0, lines = 0, met = 0;
  for (int n = 0; n < tests::tier_count(2000, 40); ++n) {
    RandomPatch patch = random_patch(random, 1 + n % 5, 1 + n % 4, n % 3 == 0 ? 10 : 1, false);
    const double bumps = n % 2 == 0 ? 0.05 : 0.5;
    for (int i = 0; i <= patch.p; ++i)
      for (int j = 0; j <= patch.q; ++j) {
        Vec4& c = patch.points[i * (patch.q + 1) + j];
        const Vec3 even(i / double(patch.p), j / double(patch.q), 0.5);
        c = Vec4(c.w * (even + bumps * (Vec3(c) / c.w - even)), c.w);
      }
    const oracle::PatchOracle truth(patch.points, patch.p, patch.q);
    const CellModel model = model_of(patch.view());
    for (int k = 0; k < 30; ++k) {
      Line line = random_line(random, 2);
      line.origin = truth.point(0.1 + 0.8 * (k / 30.0), 0.1 + 0.8 * ((7 * k % 30) / 30.0)) - 2.0 * line.direction;
      const size_t roots = truth.roots(line).size();
      const bool once = meets_once(model, line.direction);
      ++lines;
      met += roots > 1;
      known += once;
      several += once && roots > 1;
    }
  }
  EXPECT_EQ(several, 0) << "of " << known << " directions said to meet once, " << met << " of " << lines << " do not";
  EXPECT_GT(known, lines / 5);
  EXPECT_GT(met, lines / 100);
}

}  // namespace
}  // namespace lekalo::geometry::line_cells_test
