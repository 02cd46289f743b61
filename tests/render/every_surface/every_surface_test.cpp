// Every type of surface that a scene file can name, by the example of its declaration: derivatives against references
// in 113 bits (its exact patches, or its formula written out again) and against differences, enclosures, normals.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "geometry/surfaces/surface_checks.h"
#include "render/every_surface/examples.h"
#include "render/every_surface/formulas.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::every_surface_test {
namespace {

using namespace geometry;
using namespace every_surface;

// Of solved contacts: solved_test.cpp has their equations.
const std::set<std::string> kSolved{"fillet_surface", "chamfer_surface"};

bool is_rational(const Surface& surface) {
  const std::vector<SurfacePiece> pieces = surface.pieces();
  return std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& piece) { return piece.is_rational(); });
}

// The parameter of a patch, in 0..1, for the surface's own.
J bezier(const ParameterMap& map, const J& t) {
  const Quad lo = map.lo, hi = map.hi, width = hi - lo, middle = (lo + hi) / 2.0;
  J share = (t - lo) / width;
  if (map.kind == ParameterMap::Kind::half_angle) {
    const J half = (t - middle) / 2.0;
    share = 0.5 + 0.5 * (sin(half) / cos(half)) / tan(width / 4.0);
  } else if (map.kind == ParameterMap::Kind::hyperbolic) {
    const J half = (t - middle) / 2.0;
    share = 0.5 + 0.5 * (sinh(half) / cosh(half)) / tanh(width / 4.0);
  }
  return (share - Quad(map.from)) / (Quad(map.to) - Quad(map.from));
}

using Coordinates4 = std::array<J, 4>;

Coordinates4 de_casteljau(std::vector<Coordinates4> p, const J& x) {
  for (size_t n = p.size(); n > 1; --n)
    for (size_t i = 0; i + 1 < n; ++i)
      for (int k = 0; k < 4; ++k) p[i][k] = (1.0 - x) * p[i][k] + x * p[i + 1][k];
  return p[0];
}

Point patch_at(const SurfacePiece& piece, const J& u, const J& v) {
  std::vector<Coordinates4> column;
  for (int i = 0; i <= piece.degree_u; ++i) {
    std::vector<Coordinates4> row;
    for (int j = 0; j <= piece.degree_v; ++j) {
      const Vec4& p = piece.points[static_cast<size_t>(i) * (piece.degree_v + 1) + j];
      row.push_back({J(p.x), J(p.y), J(p.z), J(p.w)});
    }
    column.push_back(de_casteljau(row, bezier(piece.map_v, v)));
  }
  const Coordinates4 p = de_casteljau(column, bezier(piece.map_u, u));
  return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
}

Vec3 derivative(const Point& p, int i, int j) {
  return {static_cast<double>(p.x.derivative(i, j)), static_cast<double>(p.y.derivative(i, j)),
          static_cast<double>(p.z.derivative(i, j))};
}

// Largest difference from the reference of each order at a place, as a part of the size of the derivatives up to that
// order. `size` and `steps`: of the surface, and the sides of its patch by their degrees, which rounding of a patch's
// derivatives goes with.
void compare(const Surface& surface, const Point& exact, const Vec2& at, double size, const Vec2& steps,
             Tolerances& worst) {
  const SurfaceJet jet = surface.evaluate(at.x, at.y, surface.max_order());
  double scale = size;
  for (int n = 0; n <= surface.max_order(); ++n) {
    for (int j = 0; j <= n; ++j)
      scale = std::max(
          {scale, glm::length(derivative(exact, n - j, j)), size / (std::pow(steps.x, n - j) * std::pow(steps.y, j))});
    for (int j = 0; j <= n; ++j)
      worst[n] = tests::worse(worst[n], glm::length(jet.d(n - j, j) - derivative(exact, n - j, j)) / scale);
  }
}

Point in_quad(const std::function<Point(const J&, const J&)>& formula, const Vec2& at) {
  return formula(J::u_variable(Quad(at.x)), J::v_variable(Quad(at.y)));
}

// Some of the pieces, spread over all.
std::vector<SurfacePiece> some_pieces(const Surface& surface, size_t count) {
  const std::vector<SurfacePiece> all = surface.pieces();
  std::vector<SurfacePiece> some;
  for (size_t k = 0; k < std::min(count, all.size()); ++k)
    some.push_back(all[k * all.size() / std::min(count, all.size())]);
  return some;
}

// Away from the borders, where a piece ends and rounding may lead to the next.
Vec2 inner_place(const Rectangle& r, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.001, 0.999);
  const double u = share(random);
  return {r.u.lo + u * r.u.width(), r.v.lo + share(random) * r.v.width()};
}

class EverySurface : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { surface_ = example_surface(GetParam()); }
  SurfacePtr surface_;
};

TEST_P(EverySurface, DerivativesAreThoseOfItsPatches) {
  if (!is_rational(*surface_)) {
    const auto all = references();
    const bool has_formula =
        std::any_of(all.begin(), all.end(), [](const Reference& one) { return one.type == GetParam(); });
    EXPECT_TRUE(has_formula || kSolved.count(GetParam())) << "write its formula in formulas.h";
    return;
  }
  std::mt19937_64 random(31);
  const double size = checks::size_of(bounds(*surface_));
  Tolerances worst{};
  for (const SurfacePiece& piece : some_pieces(*surface_, 8)) {
    const Vec2 steps(piece.domain.u.width() / piece.degree_u, piece.domain.v.width() / piece.degree_v);
    for (int k = 0; k < tests::tier_count(400, 8); ++k) {
      const Vec2 at = inner_place(piece.domain, random);
      const Point exact = in_quad([&](const J& u, const J& v) { return patch_at(piece, u, v); }, at);
      compare(*surface_, exact, at, size, glm::min(steps, Vec2(1)), worst);
    }
  }
  for (int n = 0; n <= surface_->max_order(); ++n) EXPECT_LE(worst[n], kRounding[n]) << "order " << n;
}

TEST_P(EverySurface, DerivativesAreThoseOfDifferences) {
  const double rounding = 1e-12 * checks::size_of(bounds(*surface_));
  for (const SurfacePiece& piece : some_pieces(*surface_, 6))
    ASSERT_NO_FATAL_FAILURE(
        checks::check_differences(*surface_, piece.domain, std::min(3, surface_->max_order()), 1e-7, rounding));
}

// But for the rounding of the samples, which shows where derivatives vanish.
TEST_P(EverySurface, EnclosuresContainSamples) {
  std::mt19937_64 random(33);
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * checks::size_of(bounds(*surface_));
  std::uniform_real_distribution<double> exponent(-4, 0);
  for (const SurfacePiece& piece : some_pieces(*surface_, 6)) {
    const Vec2 steps(piece.domain.u.width() / std::max(piece.degree_u, 1),
                     piece.domain.v.width() / std::max(piece.degree_v, 1));
    for (int k = 0; k < tests::tier_count(1000, 20); ++k) {
      const Vec2 a = checks::random_place(piece.domain, random);
      const double share = std::pow(10, exponent(random));
      const Rectangle box{{a.x, a.x + share * (piece.domain.u.hi - a.x)},
                          {a.y, a.y + share * (piece.domain.v.hi - a.y)}};
      const SurfaceEnclosure enclosure = surface_->enclose(box, 2);
      for (int i = 0; i < 20; ++i) {
        const Vec2 at = checks::random_place(box, random);
        const SurfaceJet jet = surface_->evaluate(at.x, at.y, 2);
        for (int n = 0; n <= std::min(2, surface_->max_order()); ++n)
          for (int j = 0; j <= n; ++j) {
            const double slack = rounding / (std::pow(steps.x, n - j) * std::pow(steps.y, j));
            ASSERT_TRUE(enclosure.d(n - j, j).inflated(slack).contains(jet.d(n - j, j)))
                << "derivative " << n - j << ", " << j << " at " << at.x << ", " << at.y;
          }
      }
    }
  }
}

TEST_P(EverySurface, NormalsAreAcross) { checks::check_normals(*surface_, surface_->domain()); }

INSTANTIATE_TEST_SUITE_P(Types, EverySurface, testing::ValuesIn(surface_type_names()),
                         [](const auto& type) { return type.param; });

class ComposedSurfaces : public testing::TestWithParam<Reference> {
 protected:
  void SetUp() override { surface_ = surface_of(described(GetParam())); }
  SurfacePtr surface_;
};

TEST_P(ComposedSurfaces, DerivativesAreThoseOfTheFormula) {
  std::mt19937_64 random(32);
  const Reference& one = GetParam();
  const double size = checks::size_of(bounds(*surface_));
  Tolerances worst{};
  for (int k = 0; k < tests::tier_count(4000, 40); ++k) {
    const Vec2 at = checks::random_place(one.range, random);
    compare(*surface_, in_quad(one.formula, at), at, size, Vec2(1), worst);
  }
  for (int n = 0; n <= surface_->max_order(); ++n) EXPECT_LE(worst[n], one.tolerances[n]) << "order " << n;
}

TEST_P(ComposedSurfaces, EnclosuresContainSamples) { checks::check_enclosures(*surface_, surface_->domain()); }

INSTANTIATE_TEST_SUITE_P(Formulas, ComposedSurfaces, testing::ValuesIn(references()),
                         [](const auto& one) { return std::to_string(one.index) + "_" + one.param.type; });

}  // namespace
}  // namespace lekalo::render::every_surface_test
