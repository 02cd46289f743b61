#include "geometry/curves/analytic/line_arc_path.h"

#include <fmt/format.h>

#include "geometry/curves/curve_checks.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry::line_arc_path_test {
namespace {

CurvePtr built(const std::string& name, const Fields& fields) {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == name) return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

const std::vector<Vec3> kInSpace{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {0.3, 1, 3}};

TEST(RoundedPath, MeetsTheGeneralChecks) {
  for (const bool closed : {false, true}) {
    const std::vector<double> radii{closed ? 0.2 : 0, 0.5, 0, 0.7, closed ? 0.1 : 0};
    const NurbsCurve curve = rounded_path(kInSpace, radii, closed, "radius");
    checks::check_enclosures(curve, curve.domain());
    checks::check_nurbs(curve);
    checks::check_pieces(curve);
    checks::check_period(curve);
  }
}

// Tangents run on over every arc, and its points lie on the sphere about its center.
TEST(RoundedPath, HasArcsThatTouchTheSides) {
  const NurbsCurve curve = rounded_path(kInSpace, std::vector<double>{0, 0.5, 0.4, 0.7, 0}, false, "radius");
  for (int knot = 1; knot < static_cast<int>(curve.domain().hi); ++knot) {
    const Vec3 before = curve.evaluate(knot - 1e-13, 1).d[1], after = curve.evaluate(knot, 1).d[1];
    EXPECT_LE(glm::length(glm::normalize(before) - glm::normalize(after)), 1e-11) << "knot " << knot;
  }
}

TEST(RoundedPath, SaysWhatFits) {
  const std::vector<Vec3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  try {
    rounded_path(square, std::vector<double>(4, 1.1), true, "corner_radius");
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_EQ(error.field, "corner_radius");
    EXPECT_EQ(error.hint, "the largest radius that fits is 1");
  }
  const NurbsCurve circle = rounded_path(square, std::vector<double>(4, 1.0), true, "corner_radius");
  for (int i = 0; i <= 40; ++i) EXPECT_NEAR(glm::length(circle.point(0.1 * i) - Vec3(1, 1, 0)), 1, 1e-15);
  EXPECT_EQ(circle.domain().hi, 4);
  const std::vector<Vec3> back{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(rounded_path(back, std::vector<double>{0, 0.1, 0}, false, "radius"), FieldError);
  EXPECT_NO_THROW(rounded_path(back, std::vector<double>{0, 0, 0}, false, "radius"));
}

// An arc of more than half a turn, against its own circle.
TEST(LineArcPath, DrawsLongArcs) {
  LineArcPath path({1, 0, 0}, 1);
  path.arc_to(Vec3(0), {0, 0, 1}, 1.75 * kPi, {std::sqrt(0.5), -std::sqrt(0.5), 0});
  const NurbsCurve arc = path.curve(false);
  EXPECT_NEAR(measure(arc).length.value, 1.75 * kPi, 1e-13);
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(glm::length(arc.point(0.01 * i)), 1, 1e-15);
}

// The second moment of area about the axis x through the centroid, by Green's theorem on fine polygons: -int y^3 dx
// / 3.
double second_moment(const Curve& outline, double middle) {
  constexpr int kPlaces = 4000;
  long double sum = 0;
  for (const CurvePiece& piece : outline.pieces())
    for (int i = 0; i < kPlaces; ++i) {
      const long double w = piece.domain.width() / kPlaces;
      const double t = piece.domain.lo + static_cast<double>((i + 0.5L) * w);
      const CurveJet jet = outline.evaluate(t, 1);
      const long double y = jet.d[0].y - middle;
      sum -= y * y * y * jet.d[1].x * w / 3;
    }
  return static_cast<double>(sum);
}

// IPE 100 and IPE 200 of EN 10365, Grezdov's data: 1.710121292e6 and 1.943168251e7 mm^4.
TEST(Profile, HasTheSecondMomentsOfStandardSections) {
  const auto section = [](double h, double b, double web, double flange, double root) {
    Fields f;
    for (const auto& [name, value] : std::map<std::string, double>{{"height", h},
                                                                   {"width", b},
                                                                   {"web_thickness", web},
                                                                   {"flange_thickness", flange},
                                                                   {"root_radius", root},
                                                                   {"toe_radius", 0.0},
                                                                   {"taper", 0.0}})
      f.set(name, value);
    f.set("preset", std::string("I"));
    f.set("frame", Frame());
    return built("profile", f);
  };
  EXPECT_NEAR(second_moment(*section(100, 55, 4.1, 5.7, 7), 50) / 1.710121292e6, 1, 1e-8);
  EXPECT_NEAR(second_moment(*section(200, 100, 5.6, 8.5, 12), 100) / 1.943168251e7, 1, 1e-8);
}

}  // namespace
}  // namespace lekalo::geometry::line_arc_path_test
