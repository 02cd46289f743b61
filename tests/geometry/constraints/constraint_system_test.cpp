// Systems of constraints: closed forms of Golovanov 2016, 7.5 and 7.6, and random sketches and chains that are
// disturbed and found again.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "geometry/constraints/conditions.h"
#include "support/tier.h"

namespace lekalo::geometry::constraint_system_test {
namespace {

UnknownPoint free_point(ConstraintSystem& system, const Vec3& at, bool in_plane) {
  UnknownPoint point;
  point.at = at;
  for (int k = 0; k < (in_plane ? 2 : 3); ++k) {
    point.coordinates[k] = static_cast<int>(system.start.size());
    system.start.push_back(at[k]);
    system.weights.push_back(1);
  }
  return point;
}

// The rows of every kind of condition against differences.
TEST(ConstraintSystem, JacobiansAgreeWithDifferences) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  for (int round = 0; round < 20; ++round) {
    ConstraintSystem system;
    const UnknownPoint a = free_point(system, vector(), false), b = free_point(system, vector(), false),
                       c = free_point(system, vector(), false), d = free_point(system, vector(), false);
    const auto marker = [&] {
      Marker m;
      m.point.at = vector();
      m.point.pose = {static_cast<int>(system.start.size()), vector()};
      const Frame frame = frame_about(Vec3(0), glm::normalize(vector()));
      m.normal = frame.z, m.direction = frame.x;
      for (int k = 0; k < 6; ++k) system.start.push_back(round == 0 ? 0 : any(random)), system.weights.push_back(1);
      return m;
    };
    const Marker m = marker(), n = marker();
    const Start start = system.start;
    system.constraints = {coincidence("", a, m.point),
                          distance_between("", a, b, 2),
                          coordinate_distance("", a, n.point, 1, 0.3, start),
                          angle_between("", a, b, c, 1),
                          parallel("", {a, b}, {c, d}, start),
                          perpendicular("", {a, b}, {c, d}, start),
                          equal_lengths("", {a, b}, {c, d}),
                          point_to_plane("", m, n, 0.1),
                          point_on_axis("", m, n),
                          axis_along_plane("", m, n),
                          plane_angle("", m, n, 1),
                          parallel_planes("", m, n),
                          aligned("", m, n)};
    const auto count = static_cast<Eigen::Index>(system.start.size());
    for (const Constraint& one : system.constraints) {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(one.count), after = f, before = f;
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(one.count, count), unused = jacobian;
      one.evaluate(system.start, f, jacobian);
      for (Eigen::Index k = 0; k < count; ++k) {
        constexpr double h = 1e-6;
        std::vector<double> moved = system.start;
        moved[static_cast<size_t>(k)] += h;
        one.evaluate(moved, after, unused);
        moved[static_cast<size_t>(k)] -= 2 * h;
        one.evaluate(moved, before, unused);
        EXPECT_LE((jacobian.col(k) - (after - before) / (2 * h)).norm(), 2e-8);
      }
    }
  }
}

// A random triangulated sketch is rigid; disturbed, it comes back with all of its lengths.
TEST(ConstraintSystem, RandomSketchesAreFoundAgain) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  const int rounds = tests::tier_count(500, 20);
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec3> truth{{0, 0, 0}, {2 + any(random), 0, 0}};
    std::vector<std::array<int, 2>> lengths{{0, 1}};
    for (int k = 2; k < 8; ++k) {
      truth.push_back(Vec3(k + any(random), 2 * any(random) + (k % 2 == 0 ? 3 : -3), 0));
      lengths.push_back({k - 2, k}), lengths.push_back({k - 1, k});
    }
    ConstraintSystem system;
    system.size = 10;
    std::vector<UnknownPoint> points;
    for (const Vec3& p : truth)
      points.push_back(free_point(system, p + 0.05 * Vec3(any(random), any(random), 0), true));
    for (const auto& [i, j] : lengths)
      system.constraints.push_back(distance_between("", points[i], points[j], glm::length(truth[i] - truth[j])));
    const ConstraintSolution found = solve(system);
    EXPECT_EQ(found.freedom, 3);  // Laman: 2 n - 3 lengths
    EXPECT_EQ(found.redundant, 0);
    for (const auto& [i, j] : lengths)
      EXPECT_NEAR(glm::length(place_of(points[i], found.unknowns) - place_of(points[j], found.unknowns)),
                  glm::length(truth[i] - truth[j]), 1e-10);
    // Least change: the change is normal to all motions that are left.
    const Eigen::MatrixXd free = allowed_velocities(system, found);
    Eigen::VectorXd change(static_cast<Eigen::Index>(found.unknowns.size()));
    for (size_t k = 0; k < found.unknowns.size(); ++k)
      change[static_cast<Eigen::Index>(k)] = found.unknowns[k] - system.start[k];
    EXPECT_LE((free.transpose() * change).norm(), 1e-9);
  }
}

// Closed loops of bodies with generic revolute joints: rank of the Jacobian (Golovanov 2016, 7.6).
TEST(ConstraintSystem, LoopsOfBodies) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  for (const auto& [bodies, freedom] : {std::pair{3, 6}, {4, 6}, {5, 6}, {6, 6}, {7, 7}, {8, 8}}) {
    ConstraintSystem system;
    std::vector<UnknownPose> poses;
    for (int k = 0; k < bodies; ++k) {
      poses.push_back({6 * k, vector()});
      for (int i = 0; i < 6; ++i) system.start.push_back(0), system.weights.push_back(1);
    }
    for (int k = 0; k < bodies; ++k) {
      Marker a;
      a.point.at = vector();
      const Frame frame = frame_about(Vec3(0), glm::normalize(vector()));
      a.normal = frame.z, a.direction = frame.x;
      Marker b = a;
      a.point.pose = poses[k], b.point.pose = poses[(k + 1) % bodies];
      system.constraints.push_back(coincidence("", a.point, b.point));
      system.constraints.push_back(parallel_planes("", a, b));
    }
    EXPECT_EQ(6 * bodies - jacobian_rank(system, system.start), freedom) << bodies;
  }
}

TEST(ConstraintSystem, ContradictionsAreNamed) {
  ConstraintSystem system;
  const UnknownPoint a = free_point(system, {0, 0, 0}, true), b = free_point(system, {3.5, 0, 0}, true);
  system.constraints = {distance_between("short", a, b, 3), distance_between("long", a, b, 4)};
  try {
    solve(system);
    FAIL() << "solved";
  } catch (const ConstraintError& error) {
    EXPECT_EQ(error.unmet.size(), 2u);
  }
}

}  // namespace
}  // namespace lekalo::geometry::constraint_system_test
