#include "geometry/curve.h"

#include "geometry/curves/curve_checks.h"

namespace lekalo::geometry::curve_test {
namespace {

using checks::distance;
using Kind = ParameterMap::Kind;

// The defining equations of the maps in long double (Golovanov 2016, 2.5).
TEST(ParameterMap, SatisfiesItsEquation) {
  for (const Kind kind : {Kind::half_angle, Kind::hyperbolic}) {
    const ParameterMap map{kind, -0.75, 2.25};
    EXPECT_EQ(map.natural(-0.75), -0.75);
    EXPECT_EQ(map.natural(2.25), 2.25);
    EXPECT_DOUBLE_EQ(map.natural(0.75), 0.75);
    for (double s = -0.75; s <= 2.25; s += 0.125) {
      const double t = map.natural(s);
      const long double q = (s + 0.75L) / 3;
      const long double left = kind == Kind::half_angle ? std::tan((t - 0.75L) / 2) : std::tanh((t - 0.75L) / 2);
      const long double right = (kind == Kind::half_angle ? std::tan(0.75L) : std::tanh(0.75L)) * (2 * q - 1);
      EXPECT_NEAR(static_cast<double>(left), static_cast<double>(right), 4e-16);
      EXPECT_NEAR(map.rational(t), s, 4e-15);
      EXPECT_NEAR(map.natural_of_bezier(map.bezier(t)), t, 4e-15);
      // The slope against the chain rule of the equation.
      const long double h = kind == Kind::half_angle ? 1 + left * left : 1 - left * left;
      EXPECT_NEAR(map.derivative(s),
                  static_cast<double>((kind == Kind::half_angle ? std::tan(0.75L) : std::tanh(0.75L)) * 4 / 3 / h),
                  1e-14);
    }
  }
}

TEST(ParameterMap, CutsCoverTheirPart) {
  for (const Kind kind : {Kind::affine, Kind::half_angle, Kind::hyperbolic}) {
    const ParameterMap map{kind, 1, 3};
    const ParameterMap part = map.cut(1.25, 2.5);
    EXPECT_NEAR(part.natural_of_bezier(0), 1.25, 1e-15);
    EXPECT_NEAR(part.natural_of_bezier(1), 2.5, 1e-15);
    EXPECT_NEAR(part.bezier(2), (map.rational(2) - map.rational(1.25)) / (map.rational(2.5) - map.rational(1.25)),
                1e-15);
    for (const double x : {0.1, 0.5, 0.8}) {
      const double h = 1e-5;
      const double slope = (part.natural_of_bezier(x + h) - part.natural_of_bezier(x - h)) / (2 * h);
      EXPECT_NEAR(part.derivative_of_bezier(x), slope, 1e-9);
    }
  }
}

// A half circle of three quarters of pi as two rational spans with half-angle maps: every piece of every part of the
// domain is the circle at its angle.
TEST(BezierPieces, CutsInsideASpanKeepTheNaturalParameter) {
  const double d = 3 * kPi / 4, w = std::cos(d / 2), far = 1 / w;
  NurbsCurveForm form;
  form.degree = 2;
  form.knots = {0, 0, 0, d, d, 2 * d, 2 * d, 2 * d};
  for (int k = 0; k < 5; ++k) {
    const double angle = k * d / 2, radius = k % 2 ? far : 1, weight = k % 2 ? w : 1;
    form.points.emplace_back(weight * radius * Vec3(std::cos(angle), std::sin(angle), 0), weight);
  }
  form.maps = {{Kind::half_angle, 0, d}, {Kind::half_angle, d, 2 * d}};
  for (const Interval domain :
       {Interval(0, 2 * d), Interval(0.1, 2), Interval(0.3, d), Interval(d, 4), Interval(1, 4)}) {
    const auto pieces = bezier_pieces(form, domain);
    EXPECT_EQ(pieces.size(), domain.lo < d && domain.hi > d ? 2u : 1u);
    EXPECT_EQ(pieces.front().domain.lo, domain.lo);
    EXPECT_EQ(pieces.back().domain.hi, domain.hi);
    for (const CurvePiece& piece : pieces) {
      std::vector<checks::Homogeneous> points;
      for (const Vec4& p : piece.points) points.push_back(checks::widened(p));
      for (int i = 0; i <= 20; ++i) {
        const double t = piece.domain.clamp(piece.domain.lo + piece.domain.width() * i / 20);
        const Vec3 p = checks::projected(checks::de_casteljau(points, piece.map.bezier(t)));
        EXPECT_LE(distance(p, {std::cos(t), std::sin(t), 0}), 2e-15);
      }
    }
  }
}

TEST(BezierPieces, RefuseADomainOutsideTheForm) {
  const NurbsCurveForm form{1, {0, 0, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 1}}, {}};
  EXPECT_THROW(bezier_pieces(form, {0, 1.5}), std::invalid_argument);
  EXPECT_THROW(bezier_pieces(form, {-1, 1}), std::invalid_argument);
  NurbsCurveForm few = form;
  few.knots = {0, 0, 1, 2, 2};
  few.points.push_back({2, 0, 0, 1});
  few.maps = {{Kind::affine, 0, 1}};
  EXPECT_THROW(bezier_pieces(few, {0, 2}), std::invalid_argument);
}

// A piece narrower than rounding at an end of the domain joins its neighbour.
TEST(BezierPieces, SliversAreLeftToTheNeighbour) {
  const NurbsCurveForm form{1, {0, 0, 1, 2, 2}, {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}}, {}};
  const auto pieces = bezier_pieces(form, {1 - 1e-14, 2});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].domain, Interval(1 - 1e-14, 2));
}

}  // namespace
}  // namespace lekalo::geometry::curve_test
