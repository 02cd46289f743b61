// Surfaces that a scene makes of curves, sections and laws: the general checks of surfaces, and the formulas of those
// that have one, in 113 bits.
#include <gtest/gtest.h>

#include "geometry/surfaces/surface_checks.h"
#include "render/scene/scene_text.h"

namespace lekalo::geometry::swept_surfaces_test {
namespace {

SurfacePtr surface(const std::string& fields) {
  const render::BuiltText built = render::build_text("geometry:\n  s: " + fields + "\n");
  return std::get<SurfacePtr>(built.model.geometry.at("s"));
}

Rectangle part_of(const Rectangle& domain, double from, double to) {
  return {{domain.u.lo + from * domain.u.width(), domain.u.lo + to * domain.u.width()},
          {domain.v.lo + from * domain.v.width(), domain.v.lo + to * domain.v.width()}};
}

TEST(SweptSurfaces, MeetTheGeneralChecks) {
  const std::string guide = "{ type: bezier_curve, points: [[0, 0, 0], [0, 4, 0], [4, 6, 2], [8, 4, 2]] }";
  for (const std::string& fields : std::vector<std::string>{
           "{ type: vintoid, preset: toroid, n: 3, c: 0.4 }", "{ type: vintoid, preset: knot }",
           "{ type: vintoid, preset: shell }", "{ type: serpentine, preset: coil, n: 1 }",
           "{ type: serpentine, preset: rope }",
           "{ type: sweep_surface, path: " + guide +
               ", section: { type: circle, radius: 0.3 }, pitch: 30*s, yaw: 20*sin(3*s), scale: [1 + s, 2 - s] }",
           "{ type: guided_loft, of: [{ type: circle, radius: 0.5, center: [2, 0, 0], normal: y }, { type: circle, "
           "radius: 1, center: [0, 2, 0], normal: -x }], along: { type: circle, radius: 2 }, at_v: [0, 90 deg], frame: "
           "{ "
           "fixed: z } }",
           "{ type: line_surface, of: { type: helix, radius: 1, pitch: 3, turns: 1 }, range: [0.2, 1] }",
           "{ type: developable_surface, of: [{ type: ellipse, semi_axes: [2, 1] }, { type: ellipse, semi_axes: [1, "
           "2], "
           "frame: { origin: [0, 0, 1.5] } }] }",
           "{ type: development, of: { type: cone_surface, radius: 1, top_radius: 0.5, height: 1.2 } }",
           "{ type: hermite_surface, points: [[[0, 0.1, 0], [0.2, 1, 0.4], [0, 2.1, 0]], [[1, 0, 0.5], [1.1, 1.2, 1], "
           "[1, "
           "2, 0.3]], [[2.1, 0.3, 0], [2, 1.1, 0.2], [2.2, 1.9, 0.7]]] }"}) {
    SCOPED_TRACE(fields);
    const SurfacePtr made = surface(fields);
    for (const double from : {0.02, 0.55})
      checks::check_differences(*made, part_of(made->domain(), from, from + 0.12), 2);
    checks::check_normals(*made, made->domain());
    checks::check_enclosures(*made, made->domain());
    checks::check_pieces(*made);
    checks::check_periods(*made, made->domain());
  }
}

TEST(SweptSurfaces, VintoidsHaveTheDerivativesOfTheirFormula) {
  const SurfacePtr knot = surface("{ type: vintoid, preset: knot }");
  const auto formula = [](const auto& u, const auto& v) {
    using T = std::decay_t<decltype(u)>;
    const T far = T(Quad(2)) + Quad(0.8) * cos(Quad(1.5) * u) + Quad(0.3) * cos(v);
    return Triple<T>{far * cos(u), far * sin(u), Quad(0.8) * sin(Quad(1.5) * u) + Quad(0.3) * sin(v)};
  };
  checks::check_derivatives(*knot, formula, knot->domain(), 1e-13);
}

TEST(SweptSurfaces, ATubeAboutACircleIsATorus) {
  const SurfacePtr torus = surface(
      "{ type: sweep_surface, path: { type: circle, radius: 2 }, section: { type: circle, radius: 0.5 }, frame: { "
      "fixed: "
      "z } }");
  // The frame: n = z, t the tangent, b = t x n outward.
  const auto formula = [](const auto& u, const auto& v) {
    using T = std::decay_t<decltype(u)>;
    const Quad turn = Quad(kTwoPi);
    const T far = T(Quad(2)) + Quad(0.5) * sin(u);
    return Triple<T>{far * cos(turn * v), far * sin(turn * v), Quad(0.5) * cos(u)};
  };
  // The axes are polynomials that agree to 1e-13; of their fourth derivatives so much less is left.
  checks::check_derivatives(*torus, formula, torus->domain(), 1e-8);
}

}  // namespace
}  // namespace lekalo::geometry::swept_surfaces_test
