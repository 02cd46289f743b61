// Systems of constraints taken apart: known graphs, the rank of random ones, and the same solution as of the whole.
#include "geometry/constraints/decomposition.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <chrono>
#include <random>
#include <set>

#include "geometry/constraints/conditions.h"

namespace lekalo::geometry::decomposition_test {
namespace {

using Bars = std::vector<std::pair<int, int>>;
using Parts = std::vector<std::vector<int>>;

UnknownPoint free_point(ConstraintSystem& system, const Vec3& at) {
  UnknownPoint point;
  point.at = at;
  for (int k = 0; k < 2; ++k) {
    point.coordinates[k] = static_cast<int>(system.start.size());
    system.start.push_back(at[k]);
    system.weights.push_back(1 + 0.1 * k);
  }
  return point;
}

// p_0 fixed, each further point from the two before it by distances.
ConstraintSystem chain(int count, bool is_free) {
  ConstraintSystem system;
  std::vector<UnknownPoint> points;
  for (int k = 0; k < count; ++k) points.push_back(free_point(system, {k, k % 2 ? 0.9 : 0.0, 0}));
  const Start start = system.start;
  system.constraints.push_back(fixation("fixed", points[0], start));
  if (!is_free) system.constraints.push_back(coordinate_distance("level", points[0], points[1], 1, 0.9, start));
  system.constraints.push_back(distance_between("first", points[0], points[1], 1.4));
  for (size_t k = 2; k < points.size(); ++k)
    for (const size_t j : {k - 1, k - 2})
      system.constraints.push_back(distance_between("d", points[j], points[k], j == k - 1 ? 1.4 : 2.05));
  system.size = count;
  return system;
}

TEST(Decomposition, ChainsAreSolvedPointByPoint) {
  for (const bool is_free : {false, true}) {
    const ConstraintSystem system = chain(12, is_free);
    const Decomposition parts = decomposed(system);
    // Free to turn about p_0 all that follows is one under-determined block.
    EXPECT_EQ(parts.largest(), is_free ? 22u : 2u);
    EXPECT_EQ(parts.unmatched.size(), is_free ? 1u : 0u);
    const auto blocks = solved_by_blocks(system);
    ASSERT_TRUE(blocks.has_value());
    const ConstraintSolution whole = solved_as_one(system);
    EXPECT_EQ(blocks->rank, whole.rank);
    EXPECT_EQ(blocks->freedom, is_free ? 1 : 0);
    for (size_t i = 0; i < whole.unknowns.size(); ++i) EXPECT_NEAR(blocks->unknowns[i], whole.unknowns[i], 1e-12);
    ASSERT_EQ(blocks->multipliers.size(), whole.multipliers.size());
    for (size_t i = 0; i < whole.multipliers.size(); ++i)
      EXPECT_NEAR(blocks->multipliers[i], whole.multipliers[i], 1e-9 * (1 + std::abs(whole.multipliers[i])));
  }
}

// Each point from the one before by a distance and a height, so that rounding does not grow along it.
ConstraintSystem stair(int count) {
  ConstraintSystem system;
  std::vector<UnknownPoint> points;
  for (int k = 0; k < count; ++k) points.push_back(free_point(system, {k, k % 2 ? 0.8 : 0.0, 0}));
  const Start start = system.start;
  system.constraints.push_back(fixation("fixed", points[0], start));
  for (size_t k = 1; k < points.size(); ++k) {
    system.constraints.push_back(distance_between("d", points[k - 1], points[k], 1.3));
    system.constraints.push_back(coordinate_distance("h", points[k - 1], points[k], 1, 0.85, start));
  }
  return system;
}

TEST(Decomposition, ALongChainIsFasterInBlocks) {
  const ConstraintSystem system = stair(200);
  const auto seconds = [](auto run) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::optional<ConstraintSolution> blocks;
  ConstraintSolution whole;
  const double in_blocks = seconds([&] { blocks = solved_by_blocks(system); });
  const double as_one = seconds([&] { whole = solved_as_one(system); });
  ASSERT_TRUE(blocks.has_value());
  for (size_t i = 0; i < whole.unknowns.size(); ++i) EXPECT_NEAR(blocks->unknowns[i], whole.unknowns[i], 1e-12);
  EXPECT_LT(2 * in_blocks, as_one);
  RecordProperty("seconds", std::to_string(in_blocks) + " in blocks, " + std::to_string(as_one) + " as one");
}

// Equations by incidence alone: sums of their unknowns times fixed random numbers.
TEST(Decomposition, MatchingAndPartsOfRandomGraphs) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const int n = 1 + static_cast<int>(random() % 7), m = static_cast<int>(random() % 8);
    ConstraintSystem system;
    system.start.assign(static_cast<size_t>(n), 0.5), system.weights.assign(static_cast<size_t>(n), 1);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(m, n);
    for (int e = 0; e < m; ++e) {
      Constraint one{"", 1, false, {}, {}};
      for (int x = 0; x < n; ++x)
        if (random() % 3 == 0)
          one.unknowns.push_back(x), matrix(e, x) = 0.5 + static_cast<double>(random() % 1000003) / 1e6;
      one.evaluate = [row = Eigen::RowVectorXd(matrix.row(e))](auto p, auto f, auto jacobian) {
        f[0] = row * Eigen::Map<const Eigen::VectorXd>(p.data(), static_cast<Eigen::Index>(p.size()));
        jacobian.row(0) = row;
      };
      system.constraints.push_back(std::move(one));
    }
    const Decomposition parts = decomposed(system);
    // The structural rank is that of random numbers in these places.
    const int rank = m == 0 ? 0 : static_cast<int>(Eigen::FullPivLU<Eigen::MatrixXd>(matrix).rank());
    EXPECT_EQ(parts.matched, rank);
    std::set<int> unknowns, known;
    size_t equations = 0;
    for (const SystemBlock& block : parts.blocks) {
      for (const int x : block.unknowns) EXPECT_TRUE(unknowns.insert(x).second);
      equations += block.equations.size();
      // An equation has no unknowns of later blocks.
      known.insert(block.unknowns.begin(), block.unknowns.end());
      for (const Equation& e : block.equations)
        for (int x = 0; x < n; ++x)
          if (matrix(e.constraint, x) != 0) {
            EXPECT_TRUE(known.count(x) > 0);
          }
      if (block.part == Determined::well) {
        EXPECT_EQ(block.unknowns.size(), block.equations.size());
      }
      if (block.part == Determined::over) {
        EXPECT_LT(block.unknowns.size(), block.equations.size());
      }
      if (block.part == Determined::under) {
        EXPECT_GT(block.unknowns.size(), block.equations.size());
      }
    }
    EXPECT_EQ(unknowns.size(), static_cast<size_t>(n));
    EXPECT_EQ(equations, static_cast<size_t>(m));
  }
}

TEST(RigidParts, KnownFrameworks) {
  EXPECT_EQ(rigid_parts(3, Bars{{0, 1}, {1, 2}, {2, 0}}), (Parts{{0, 1, 2}}));
  EXPECT_EQ(rigid_parts(4, Bars{{0, 1}, {1, 2}, {2, 3}, {3, 0}}), (Parts{{0, 1}, {1, 2}, {2, 3}, {0, 3}}));
  EXPECT_EQ(rigid_parts(4, Bars{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}), (Parts{{0, 1, 2, 3}}));
  // Two triangles with a common corner turn against each other.
  EXPECT_EQ(rigid_parts(5, Bars{{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 2}}), (Parts{{0, 1, 2}, {2, 3, 4}}));
  // K_{3,3} is rigid without a triangle.
  Bars k33;
  for (int a = 0; a < 3; ++a)
    for (int b = 3; b < 6; ++b) k33.emplace_back(a, b);
  EXPECT_EQ(rigid_parts(6, k33), (Parts{{0, 1, 2, 3, 4, 5}}));
}

// Relative motions of random points under the rigidity matrix against the count.
TEST(RigidParts, AgreeWithTheRankOfRandomPoints) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const int n = 3 + static_cast<int>(random() % 6);
    std::vector<Eigen::Vector2d> p;
    for (int k = 0; k < n; ++k) p.emplace_back(any(random), any(random));
    Bars bars;
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b)
        if (random() % 2 == 0) bars.emplace_back(a, b);
    Eigen::MatrixXd rigidity = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(bars.size()) + 1, 2 * n);
    for (size_t k = 0; k < bars.size(); ++k) {
      const auto [a, b] = bars[k];
      const Eigen::RowVector2d d = (p[static_cast<size_t>(a)] - p[static_cast<size_t>(b)]).transpose();
      rigidity.block<1, 2>(static_cast<Eigen::Index>(k), 2 * a) = d;
      rigidity.block<1, 2>(static_cast<Eigen::Index>(k), 2 * b) = -d;
    }
    const Eigen::MatrixXd free = Eigen::FullPivLU<Eigen::MatrixXd>(rigidity).kernel();
    const Parts parts = rigid_parts(n, bars);
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) {
        const Eigen::RowVector2d d = (p[static_cast<size_t>(a)] - p[static_cast<size_t>(b)]).transpose();
        const bool keeps = (d * (free.middleRows<2>(2 * a) - free.middleRows<2>(2 * b))).norm() < 1e-8;
        bool together = false;
        for (const auto& part : parts)
          together |=
              std::binary_search(part.begin(), part.end(), a) && std::binary_search(part.begin(), part.end(), b);
        EXPECT_EQ(keeps, together) << "round " << round << ": " << a << ", " << b;
      }
  }
}

}  // namespace
}  // namespace lekalo::geometry::decomposition_test
