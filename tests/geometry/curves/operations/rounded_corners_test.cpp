// Rounded corners: tangents and speeds where pieces meet, the rest of the curve untouched.
#include "geometry/curves/operations/rounded_corners.h"

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::rounded_corners_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;

// A jump of r' beyond rounding anywhere, the seam included where it meets.
void check_smooth(const NurbsCurve& curve) {
  for (const CurvePiece& piece : curve.pieces()) {
    const double t = piece.domain.lo;
    if (t == curve.domain().lo) continue;
    const CurveJet before = curve.evaluate(t - 1e-10, 1), after = curve.evaluate(t, 1);
    EXPECT_LE(distance(before.d[0], after.d[0]), 1e-8);
    EXPECT_LE(distance(before.d[1], after.d[1]), 1e-7) << t;
  }
}

TEST(RoundedCorners, OfAPolylineAreCubicsBetweenTheirSides) {
  const NurbsCurve curve = rounded_corners(polyline(Points{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 5}}), 0.5);
  check_smooth(curve);
  EXPECT_EQ(curve.point(curve.domain().lo), Vec3(0));
  EXPECT_LE(distance(curve.point(curve.domain().hi), {0, 2, 5}), 1e-15);
  // The first side up to P = (3.5, 0) has the polyline's parameter; Q = (4, 0.5) lies |PQ| / 4 behind it.
  EXPECT_LE(distance(curve.point(0.875), {3.5, 0, 0}), 1e-15);
  const CurveJet q = curve.evaluate(0.875 + std::sqrt(0.5) / 4, 1);
  EXPECT_LE(distance(q.d[0], {4, 0.5, 0}), 1e-14);
  EXPECT_LE(distance(q.d[1], {0, 4, 0}), 1e-13);
  checks::check_pieces(curve);
  checks::check_enclosures(curve, curve.domain());
}

TEST(RoundedCorners, OfAClosedPolylineHaveOneAtTheSeam) {
  const NurbsCurve curve = rounded_corners(polyline(Points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, true), 1);
  check_smooth(curve);
  EXPECT_EQ(curve.pieces().size(), 8);
  EXPECT_TRUE(curve.is_closed());
  const CurveJet start = curve.evaluate(curve.domain().lo, 1), end = curve.evaluate(curve.domain().hi, 1);
  EXPECT_LE(distance(start.d[1], end.d[1]), 1e-13);
  for (const CurvePiece& piece : curve.pieces()) EXPECT_LE(glm::length(curve.point(piece.domain.middle())), 5.5);
}

TEST(RoundedCorners, RefusesZonesThatMeet) {
  for (const double zone : {1.1, 5.}) try {
      rounded_corners(polyline(Points{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}}), zone);
      FAIL();
    } catch (const FieldError& error) {
      EXPECT_EQ(error.field, "zone");
    }
  try {
    rounded_corners(Circle(Frame{}, 1), 0.1);
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_EQ(error.field, "of");
  }
}

}  // namespace
}  // namespace lekalo::geometry::rounded_corners_test
