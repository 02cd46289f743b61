// Projections of curves: on spheres and planes by their formulas, on patches against the certified projection of single
// points; derivatives by differences, enclosures by samples.
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "support/tier.h"

namespace lekalo::geometry {

TypeDeclaration projected_curve_type();

}  // namespace lekalo::geometry

namespace lekalo::geometry::projected_curve_test {

namespace {

using checks::distance;
using Values = std::vector<std::pair<std::string, std::any>>;

CurvePtr projected(const CurvePtr& curve, const SurfacePtr& surface, const Values& more = {}) {
  Fields fields;
  fields.set("of", curve);
  fields.set("onto", surface);
  fields.set("hit", 0);
  for (const auto& [name, value] : more) fields.set(name, value);
  return std::any_cast<CurvePtr>(projected_curve_type().build(fields));
}

std::string refusal(const CurvePtr& curve, const SurfacePtr& surface, const Values& more = {}) {
  try {
    projected(curve, surface, more);
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "none";
}

const SurfacePtr kBall = std::make_shared<SphereSurface>(Frame{}, 2);

SurfacePtr hills(const std::vector<double>& knots_u) {
  std::vector<Vec3> points;
  const int rows = static_cast<int>(knots_u.size()) - 4;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 4; ++j) points.push_back({i, j, 0.4 * std::sin(1.7 * i + 0.3) * std::cos(2.1 * j)});
  return std::make_shared<NurbsSurface>(SplineAxis(3, knots_u, Extension::tangent),
                                        SplineAxis(3, {0, 0, 0, 0, 1, 1, 1, 1}, Extension::tangent), points);
}

CurvePtr cubic(const std::vector<Vec3>& points) { return std::make_shared<NurbsCurve>(bezier_curve(points)); }

TEST(ProjectedCurve, OnASphereIsRadial) {
  const CurvePtr curve = cubic({{3, 1, 1}, {1, 4, 0}, {-1, 4, -2}, {-3, 0, 1}});
  const CurvePtr shadow = projected(curve, kBall);
  EXPECT_EQ(shadow->domain(), curve->domain());
  for (double t = 0; t <= 1; t += 0.01) {
    const CurveJet c = curve->evaluate(t, 3);
    // 2 c/|c| as a Taylor polynomial.
    Triple<Jet<double, 3>> series;
    double factorial = 1;
    for (int k = 0; k <= 3; ++k) {
      if (k > 0) factorial *= k;
      series.x.c[k] = c.d[k].x / factorial, series.y.c[k] = c.d[k].y / factorial, series.z.c[k] = c.d[k].z / factorial;
    }
    const auto exact = Jet<double, 3>(2.0) / length(series) * series;
    const CurveJet jet = shadow->evaluate(t, 3);
    for (int k = 0; k <= 3; ++k) {
      const Vec3 d(exact.x.derivative(k), exact.y.derivative(k), exact.z.derivative(k));
      EXPECT_LE(distance(jet.d[k], d), 1e-13 * (2 + glm::length(d))) << k << " at " << t;
    }
  }
  EXPECT_EQ(shadow->max_order(), 3);
  EXPECT_TRUE(std::isnan(shadow->evaluate(0.5, 4).d[4].x));
  checks::check_enclosures(*shadow, shadow->domain());
  checks::check_pieces(*shadow);
}

TEST(ProjectedCurve, AlongADirectionKeepsTheOtherCoordinates) {
  const CurvePtr curve = cubic({{1, -1, 3}, {0.5, 1.5, 5}, {-1, 1, 3}, {-1, -1, 4}});
  for (const int hit : {0, 1}) {
    const CurvePtr shadow = projected(curve, kBall, {{"direction", Vec3(0, 0, -1)}, {"hit", hit}});
    for (double t = 0; t <= 1; t += 0.01) {
      const Vec3 c = curve->point(t), p = shadow->point(t);
      const double z = std::sqrt(4 - c.x * c.x - c.y * c.y);
      EXPECT_LE(distance(p, {c.x, c.y, hit == 0 ? z : -z}), 4e-15);
    }
    checks::check_differences(*shadow, shadow->domain(), 4, 1e-6);
    checks::check_enclosures(*shadow, shadow->domain());
  }
  EXPECT_EQ(refusal(curve, kBall, {{"direction", Vec3(0, 0, -1)}, {"hit", 2}}),
            "hit: seen along the direction from the curve's beginning, t = 0, there are 2 points of the surface");
  EXPECT_EQ(refusal(curve, kBall, {{"direction", Vec3(0, 0, 1)}}),
            "direction: seen along the direction from the curve's beginning, t = 0, there is nothing of the surface");
}

TEST(ProjectedCurve, OnAPlaneIsExact) {
  const SurfacePtr plane = std::make_shared<Plane>(Frame{});
  const CurvePtr curve = cubic({{1, -1, 3}, {0.5, 1.5, 5}, {-1, 1, 3}, {-1, -1, 4}});
  const CurvePtr shadow = projected(curve, plane);
  const CurveJet c = curve->evaluate(0.3, 3), p = shadow->evaluate(0.3, 3);
  for (int k = 0; k <= 3; ++k) EXPECT_LE(distance(p.d[k], {c.d[k].x, c.d[k].y, 0}), 1e-14 * glm::length(c.d[k]));
}

TEST(ProjectedCurve, IsTheFootOfEachPoint) {
  for (const std::vector<double>& knots :
       {std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}, std::vector<double>{0, 0, 0, 0, 0.4, 0.4, 1, 1, 1, 1}}) {
    const SurfacePtr patch = hills(knots);
    const double far = knots.size() == 8 ? 2.5 : 4.5;
    const CurvePtr curve = cubic({{0.4, 0.5, 0.5}, {1, 2.5, 0.2}, {2, 0.5, 0.6}, {far, 2.5, 0.3}});
    const CurvePtr shadow = projected(curve, patch);
    const int count = tests::tier_count(2000, 40);
    for (int i = 0; i <= count; ++i) {
      const double t = static_cast<double>(i) / count;
      const Vec3 c = curve->point(t), p = shadow->point(t);
      EXPECT_NEAR(glm::length(c - p), project(c, *patch).foot_points.front().distance, 1e-13) << t;
    }
    for (const CurvePiece& piece : shadow->pieces()) {
      if (piece.domain.width() < 0.01) continue;
      const double room = 0.02 * piece.domain.width();
      checks::check_differences(*shadow, {piece.domain.lo + room, piece.domain.hi - room}, 3, 1e-5);
    }
    checks::check_enclosures(*shadow, shadow->domain());
    checks::check_pieces(*shadow);
  }
}

TEST(ProjectedCurve, OfClosedCurvesCloses) {
  const SurfacePtr torus = std::make_shared<TorusSurface>(Frame{}, 3, 1);
  const CurvePtr ring = projected(std::make_shared<Circle>(Frame{{0, 0, 2}}, 2.5), torus);
  EXPECT_EQ(ring->period(), kTwoPi);
  EXPECT_TRUE(ring->is_closed());
  const double radius = 3 - 0.5 / std::hypot(0.5, 2.0), z = 2 / std::hypot(0.5, 2.0);
  for (double t = -1; t < 8; t += 0.1)
    EXPECT_LE(distance(ring->point(t), {radius * std::cos(t), radius * std::sin(t), z}), 1e-14 * 4);
  // Not round the axis: the image itself closes.
  const Frame upright = frame_from({4.5, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const CurvePtr spot = projected(std::make_shared<Circle>(upright, 0.5), torus);
  EXPECT_EQ(spot->period(), kTwoPi);
  checks::check_period(*spot);
  checks::check_enclosures(*spot, spot->domain());
}

TEST(ProjectedCurve, SaysWhereItCannotGoOn) {
  EXPECT_EQ(refusal(std::make_shared<Segment>(Vec3(3, 0.1, 0.1), Vec3(-3, -0.1, -0.1)), kBall).substr(0, 40),
            "of: the projection jumps at t = 0.5: the");
  const SurfacePtr patch = hills({0, 0, 0, 0, 1, 1, 1, 1});
  const CurvePtr long_way = std::make_shared<Segment>(Vec3(1, 1, 1), Vec3(9, 1, 1));
  const std::string leaves = refusal(long_way, patch, {{"direction", Vec3(0, 0, -1)}});
  EXPECT_EQ(leaves, "of: the projection leaves the surface at t = 0.25");
  const CurvePtr part = projected(long_way, patch, {{"direction", Vec3(0, 0, -1)}, {"range", Interval(0, 0.25)}});
  EXPECT_EQ(part->domain(), Interval(0, 0.25));
  EXPECT_EQ(refusal(long_way, patch, {{"range", Interval(0, 2)}}), "range: the curve's domain is [0, 1]");
  const auto over = [](double y) { return std::make_shared<Segment>(Vec3(2.5, y, 3), Vec3(-2.5, y, 3)); };
  const Values down = {{"direction", Vec3(0, 0, -1)}, {"range", Interval(0.2, 1)}};
  EXPECT_EQ(refusal(over(0), kBall, down), "of: the projection meets a pole of the surface at t = 0.5");
  EXPECT_EQ(refusal(over(1.2), kBall, down),
            "of: the projection jumps at t = 0.82: there the direction touches the surface");
}

}  // namespace
}  // namespace lekalo::geometry::projected_curve_test
