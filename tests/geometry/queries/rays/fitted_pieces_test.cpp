#include "geometry/queries/rays/fitted_pieces.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/composition.h"
#include "geometry/numerics/triple.h"

namespace lekalo::geometry {
namespace {

// A wavy tube about a helix: its own formula in the type of its parameters.
struct Wavy {
  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    using std::cos;
    using std::sin;
    const T r = 1.0 + 0.2 * cos(5.0 * u);
    return {(3.0 + r * cos(u)) * cos(v), (3.0 + r * cos(u)) * sin(v), 0.5 * v + r * sin(u)};
  }
};

// The length of (u, v): no derivative is bounded about zero.
struct Tip {
  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    using std::sqrt;
    return {u, v, sqrt(u * u + v * v)};
  }
};

template <class Formula>
ComposedSurface<Formula> surface_of(const Interval& u, const Interval& v) {
  SurfaceProperties properties;
  properties.domain = {u, v};
  properties.breaks_u = {u.lo, u.hi};
  properties.breaks_v = {v.lo, v.hi};
  return {Formula{}, properties};
}

// The point of a patch of degree 7 by de Casteljau's algorithm.
Vec3 point_of(const SurfacePiece& piece, double s, double t) {
  const auto cast = [](std::vector<Vec3> p, double at) {
    for (size_t n = p.size() - 1; n > 0; --n)
      for (size_t i = 0; i < n; ++i) p[i] = (1 - at) * p[i] + at * p[i + 1];
    return p[0];
  };
  std::vector<Vec3> rows;
  for (int i = 0; i <= piece.degree_u; ++i) {
    std::vector<Vec3> row;
    for (int j = 0; j <= piece.degree_v; ++j) row.push_back(Vec3(piece.points[i * (piece.degree_v + 1) + j]));
    rows.push_back(cast(row, t));
  }
  return cast(rows, s);
}

TEST(FittedPieces, AgreeWithTheSurface) {
  const auto surface = surface_of<Wavy>({0, 6.25}, {0, 9});
  const FittedPieces fitted = fitted_pieces(surface, {surface.domain()});
  EXPECT_TRUE(fitted.rest.empty());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  double area = 0;
  for (const SurfacePiece& piece : fitted.patches) {
    area += piece.domain.u.width() * piece.domain.v.width();
    for (int k = 0; k < 20; ++k) {
      const double s = unit(random), t = unit(random);
      const Vec3 there =
          surface.point(piece.domain.u.lo + s * piece.domain.u.width(), piece.domain.v.lo + t * piece.domain.v.width());
      ASSERT_LT(glm::length(point_of(piece, s, t) - there), kFitDistance * 12);
    }
  }
  EXPECT_NEAR(area, 6.25 * 9, 1e-9);
}

TEST(FittedPieces, LeaveWhatIsNotSmooth) {
  const auto surface = surface_of<Tip>({-0.3, 1}, {-0.4, 1});
  const FittedPieces fitted = fitted_pieces(surface, {surface.domain()});
  EXPECT_FALSE(fitted.patches.empty());
  double area = 0;
  for (const Rectangle& box : fitted.rest) area += box.u.width() * box.v.width();
  EXPECT_GT(area, 0);
  EXPECT_LT(area, 0.01);
  for (const SurfacePiece& piece : fitted.patches) {
    const Vec3 there = surface.point(piece.domain.u.middle(), piece.domain.v.middle());
    EXPECT_LT(glm::length(point_of(piece, 0.5, 0.5) - there), kFitDistance * 3);
  }
}

}  // namespace
}  // namespace lekalo::geometry
