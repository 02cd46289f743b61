// Surfaces made of others, as scenes build them: derivatives, enclosures, pieces, and what they are the same as
// (Golovanov 2016, 3.15, 3.16, 4.9, 4.10).
#include <gtest/gtest.h>

#include "geometry/surfaces/surface_checks.h"
#include "render/scene/scene_text.h"

namespace lekalo::render {
namespace {

using geometry::Rectangle;
using geometry::SurfacePtr;
using geometry::Vec3;

const char* kBase =
    "  wave: { type: formula_surface, point: [u, v, 0.3*sin(2*u)*cos(v)], domain: { u: [0, 2], v: [0, 2] } }\n"
    "  patch: { type: bezier_surface, points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 2], [1, 2, 0]], "
    "[[2, 0, 0], [2, 1, 0.5], [2, 2, 1]]] }\n"
    "  floor: { type: plane, size: [8, 8] }\n"
    "  post: { type: cylinder_surface, radius: 1, height: 3, frame: { origin: [0, 0, -1], z: [0.3, 0, 1] } }\n";

SurfacePtr built(const std::string& fields) {
  const BuiltText text = build_text("geometry:\n" + std::string(kBase) + "  s: " + fields + "\n");
  return std::get<SurfacePtr>(text.model.geometry.at("s"));
}

void check(const std::string& fields, const Rectangle& smooth, int order, double tolerance = 1e-6) {
  SCOPED_TRACE(fields);
  const SurfacePtr surface = built(fields);
  geometry::checks::check_differences(*surface, smooth, order, tolerance);
  geometry::checks::check_enclosures(*surface, surface->domain());
  geometry::checks::check_normals(*surface, smooth);
  if (surface->as_nurbs()) geometry::checks::check_pieces(*surface);
}

TEST(DerivedSurfaces, HaveDerivativesAndEnclosures) {
  const std::string tangent = "{ type: extended_surface, of: wave, before: 1, after: 1.5, mode: tangent }";
  check(tangent, {{0, 2}, {0, 2}}, 3);
  check(tangent, {{2, 3.5}, {0, 2}}, 3);
  check(tangent, {{-1, 0}, {2, 3.5}}, 3);
  check("{ type: extended_surface, of: patch, before: 0.2, after: { u: 0.5, v: -0.3 } }", {{0, 1}, {0, 0.7}}, 3);
  check("{ type: extended_surface, of: wave, after: 1 }", {{0, 3}, {0, 3}}, 4);
  const std::string moves = "count: 5, degree: 3, moves: [{ at: [2, 2], ";
  check("{ type: deformed_surface, of: wave, " + moves + "height: 0.4 }] }", {{0, 1}, {0, 1}}, 3);
  check("{ type: deformed_surface, of: wave, " + moves + "vector: [0.1, 0.2, 0.4] }] }", {{1, 2}, {0, 1}}, 3);
  check("{ type: reparametrized_surface, of: patch, swap: true, reverse: [v], domain: { u: [1, 3], v: [0, 5] } }",
        {{1, 3}, {0, 5}}, 4);
  check("{ type: reparametrized_surface, of: wave, u: 2*w^2, v: 2*w, domain: { u: [0.2, 1], v: [0, 1] } }",
        {{0.2, 1}, {0, 1}}, 4);
  check(
      "{ type: reparametrized_surface, of: { type: torus_surface, major_radius: 2, minor_radius: 0.5, domain: { u: [0, "
      "2.5], v: [0, 5] } }, swap: true, reverse: [u] }",
      {{0, 5}, {0, 2.5}}, 3);
  check("{ type: offset_surface, of: { type: offset_surface, of: wave, distance: 0.1*u }, distance: 0.1 }",
        {{0, 2}, {0, 2}}, 3);
  check("{ type: fillet_surface, of: [floor, post], radius: 0.2 + 0.1*s*(1 - s), section: parabola }",
        {{0.1, 0.5}, {0, 1}}, 2);
  check("{ type: fillet_surface, of: [floor, post], chord: 0.4, even: true }", {{0.1, 0.5}, {0, 1}}, 2);
  check("{ type: chamfer_surface, of: [floor, post], legs: [0.2 + 0.1*s*(1 - s), 0.3] }", {{0.1, 0.5}, {0, 1}}, 2);
}

void check_same(const std::string& a, const std::string& b, const Rectangle& range) {
  SCOPED_TRACE(a);
  const SurfacePtr first = built(a), second = built(b);
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j <= 6; ++j) {
      const double u = range.u.lo + range.u.width() * i / 6, v = range.v.lo + range.v.width() * j / 6;
      EXPECT_LE(glm::length(first->point(u, v) - second->point(u, v)), 1e-13) << u << ", " << v;
      EXPECT_LE(glm::length(first->normal(u, v) - second->normal(u, v)), 1e-12) << u << ", " << v;
    }
}

TEST(DerivedSurfaces, OfOneAnotherAreOfTheBase) {
  check_same("{ type: offset_surface, of: { type: offset_surface, of: wave, distance: 0.3 }, distance: -0.1 }",
             "{ type: offset_surface, of: wave, distance: 0.2 }", {{0, 2}, {0, 2}});
  check_same("{ type: offset_surface, of: { type: offset_surface, of: wave, distance: u*v/9 }, distance: 0.1 }",
             "{ type: offset_surface, of: wave, distance: 0.1 + u*v/9 }", {{0, 2}, {0, 2}});
  check_same(
      "{ type: extended_surface, mode: tangent, after: 0.5, of: { type: extended_surface, of: wave, after: 1, "
      "mode: tangent } }",
      "{ type: extended_surface, of: wave, after: 1.5, mode: tangent }", {{0, 3.5}, {0, 3.5}});
  check_same("{ type: offset_surface, distance: 0.2, of: { type: reparametrized_surface, of: wave, reverse: [u, v] } }",
             "{ type: reparametrized_surface, reverse: [u, v], of: { type: offset_surface, of: wave, distance: 0.2 } }",
             {{0, 2}, {0, 2}});
  const std::string mirrored = "transform: [{ mirror: z }, { scale: 2 }, { rotate: 30, axis: x }]";
  check_same(
      "{ type: offset_surface, distance: 0.3, of: { type: formula_surface, point: [u, v, 0.3*sin(2*u)*cos(v)], "
      "domain: { u: [0, 2], v: [0, 2] }, " +
          mirrored + " } }",
      "{ type: offset_surface, of: wave, distance: -0.15, " + mirrored + " }", {{0, 2}, {0, 2}});
}

TEST(DerivedSurfaces, EqualHeightsMakeTheOffset) {
  const std::string row = "[0.2, 0.2, 0.2, 0.2]";
  check_same(
      "{ type: deformed_surface, of: wave, count: 4, heights: [" + row + ", " + row + ", " + row + ", " + row + "] }",
      "{ type: offset_surface, of: wave, distance: 0.2 }", {{0, 2}, {0, 2}});
}

// A direction that is closed stays so where the other one is extended.
TEST(DerivedSurfaces, ExtendedTubesStayClosed) {
  const SurfacePtr longer = built(
      "{ type: extended_surface, after: { u: 0, v: 1 }, of: { type: formula_surface, point: [cos(u), sin(u), v], "
      "domain: "
      "{ u: [0, 2*pi], v: [0, 1] }, closed: { u: true, v: false } } }");
  EXPECT_NEAR(longer->periods().u, geometry::kTwoPi, 1e-15);
  EXPECT_EQ(longer->domain().v.hi, 2);
  EXPECT_NE(build_text("geometry:\n  s: { type: extended_surface, mode: tangent, of: { type: plane } }\n")
                .said.find("the surface is unbounded"),
            std::string::npos);
}

// A torus whose offset would pass its axis within the domain is an offset by points.
TEST(DerivedSurfaces, OffsetsOfToriBeyondTheAxis) {
  const SurfacePtr offset = built(
      "{ type: offset_surface, distance: 0.8, of: { type: torus_surface, major_radius: 2, minor_radius: 1.5, domain: { "
      "u: "
      "[0, 2*pi], v: [-2, 2] } } }");
  const SurfacePtr base =
      built("{ type: torus_surface, major_radius: 2, minor_radius: 1.5, domain: { u: [0, 2*pi], v: [-2, 2] } }");
  for (const double v : {-1.9, 0.3, 1.5})
    EXPECT_NEAR(glm::length(offset->point(1, v) - base->point(1, v) - 0.8 * base->normal(1, v)), 0, 1e-13);
}

// Functions of a T-spline do not move with it.
TEST(DerivedSurfaces, FunctionsOfMovedTSplines) {
  const std::string mesh =
      "type: t_spline, degree: 1, at: [[0, 0], [2, 0], [1, 0], [0, 2], [1, 2], [2, 2]], lines: [[0, "
      "1], [3, 5], [0, 3], [1, 5], [2, 4]]";
  const SurfacePtr plain = built("{ type: t_spline_functions, of: { " + mesh + " }, vertices: [2] }");
  const SurfacePtr moved =
      built("{ type: t_spline_functions, of: { " + mesh + ", transform: { translate: [0, 0, 3] } }, vertices: [2] }");
  EXPECT_EQ(plain->point(0.5, 0.5), moved->point(0.5, 0.5));
}

}  // namespace
}  // namespace lekalo::render
