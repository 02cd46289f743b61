// What holds of every curve of a kind, with random data, as scenes make them. Errors are relative to what the sums have
// to round: the sum of |w_i B_i P_i| / |w| is at most the largest control point where weights are positive.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "geometry/curve.h"
#include "geometry/queries/measures/arc_length.h"
#include "geometry/queries/measures/mass_properties.h"
#include "render/scene/scene_text.h"
#include "support/tier.h"

namespace lekalo::render {
namespace {

using geometry::CurveJet;
using geometry::CurvePtr;
using geometry::Interval;
using geometry::kInfinity;
using geometry::Mat3;
using geometry::Vec3;

class CurveProperties : public testing::Test {
 protected:
  std::mt19937_64 random{7};
  const int count = tests::tier_count(2000, 20);

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }
  int whole(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); }

  std::string numbers(int n, double lo, double hi) {
    std::string text;
    for (int i = 0; i < n; ++i) text += fmt::format("{}{:.17g}", i == 0 ? "" : ", ", uniform(lo, hi));
    return "[" + text + "]";
  }
  // Points that go on along x, so that splines through them are tame; each coordinate within 10.
  std::vector<Vec3> points(int n) {
    std::vector<Vec3> result;
    for (int i = 0; i < n; ++i)
      result.emplace_back(-9 + 18.0 * (i + uniform(0, 0.6)) / n, uniform(-4, 4), uniform(-4, 4));
    return result;
  }
  static std::string text(const std::vector<Vec3>& points) {
    std::string text;
    for (const Vec3& p : points)
      text += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}]", text.empty() ? "" : ", ", p.x, p.y, p.z);
    return "[" + text + "]";
  }
  // A random NURBS curve of degree 1 to 5 with positive weights, clamped or not, with knots that may be double.
  std::string nurbs(const std::vector<Vec3>& points, int degree) {
    std::string knots;
    double knot = 0;
    for (int i = 0; i < static_cast<int>(points.size()) + degree + 1; ++i) {
      knots += fmt::format("{}{:.17g}", i == 0 ? "" : ", ", knot);
      if (degree == 1 || i == degree || i % 3 != 1) knot += uniform(0.2, 1);
    }
    return fmt::format("{{ type: nurbs_curve, degree: {}, points: {}, weights: {}, knots: [{}] }}", degree,
                       text(points), numbers(static_cast<int>(points.size()), 0.3, 3), knots);
  }
  std::string nurbs() {
    const int degree = whole(1, 5);
    return nurbs(points(whole(degree + 1, degree + 5)), degree);
  }

  static CurvePtr curve(const std::string& fields) {
    const BuiltText built = build_text("geometry:\n  c: " + fields + "\n");
    if (!built.said.empty()) throw std::runtime_error(built.said);
    return std::get<CurvePtr>(built.model.geometry.at("c"));
  }
  static constexpr double kSize = 10;
  // The largest distance of two curves at random parameters of the domain that they share, as a share of kSize.
  double difference(const geometry::Curve& a, const geometry::Curve& b) {
    const Interval domain = b.domain();
    double most = 0;
    for (int k = 0; k < 12; ++k) {
      const double t = uniform(domain.lo, domain.hi);
      most = std::max(most, glm::length(a.point(t) - b.point(t)) / kSize);
    }
    return most;
  }
};

constexpr double kRounding = 1e-13;

TEST_F(CurveProperties, AffineMapsOfControlPointsMapTheCurve) {
  for (int k = 0; k < count; ++k) {
    const int degree = whole(1, 5), n = whole(degree + 1, degree + 5);
    const std::vector<Vec3> from = points(n);
    Mat3 linear;
    for (int i = 0; i < 3; ++i) linear[i] = {uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5)};
    const Vec3 shift{uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
    std::vector<Vec3> to;
    for (const Vec3& p : from) to.push_back(linear * p + shift);
    const std::mt19937_64 state = random;
    const CurvePtr a = curve(nurbs(from, degree));
    random = state;
    const CurvePtr b = curve(nurbs(to, degree));
    const Interval domain = a->domain();
    for (int i = 0; i < 12; ++i) {
      const double t = uniform(domain.lo, domain.hi);
      ASSERT_LT(glm::length(linear * a->point(t) + shift - b->point(t)), kRounding * kSize);
    }
  }
}

// The rational functions sum to one.
TEST_F(CurveProperties, EqualCoordinatesStay) {
  for (int k = 0; k < count; ++k) {
    const int degree = whole(1, 5);
    std::vector<Vec3> at = points(whole(degree + 1, degree + 5));
    const double y = at[0].y;
    for (Vec3& p : at) p.y = y;
    const CurvePtr one = curve(nurbs(at, degree));
    for (int i = 0; i < 12; ++i) {
      const CurveJet jet = one->evaluate(uniform(one->domain().lo, one->domain().hi), 2);
      ASSERT_NEAR(jet.d[0].y, y, kRounding * kSize);
      ASSERT_NEAR(jet.d[1].y, 0, kRounding * (kSize + glm::length(jet.d[1])));
    }
  }
}

TEST_F(CurveProperties, ElevationInsertionAndSubdivisionKeepTheCurve) {
  for (int k = 0; k < count; ++k) {
    const std::string of = nurbs();
    const CurvePtr whole = curve(of);
    const Interval domain = whole->domain();
    const double t = uniform(domain.lo, domain.hi), to = uniform(t, domain.hi);
    EXPECT_LT(difference(*whole, *curve("{ type: elevated_curve, of: " + of + " }")), kRounding);
    EXPECT_LT(difference(*whole, *curve(fmt::format("{{ type: refined_curve, of: {}, at: [{:.17g}, {:.17g}] }}", of, t,
                                                    0.5 * (t + to)))),
              kRounding);
    // Its parameter begins at 0.
    const CurvePtr part =
        curve(fmt::format("{{ type: trimmed_curve, of: {}, from: {:.17g}, to: {:.17g} }}", of, t, to));
    for (const double w : {0.0, 0.3 * (to - t), to - t})
      EXPECT_LT(glm::length(part->point(w) - whole->point(t + w)), kRounding * kSize);
    EXPECT_LT(difference(*whole, *curve("{ type: nurbs_of, of: " + of + " }")), kRounding);
    if (HasFailure()) FAIL() << of;
  }
}

TEST_F(CurveProperties, SplinesGoThroughTheirPoints) {
  constexpr std::string_view kTypes[] = {
      "spline_curve, ends: natural",       "spline_curve, ends: parabolic",  "hermite_curve",
      "local_interpolant, beta: 0.7",      "spline_curve, closed: true",     "tension_spline, tension: 2",
      "hermite_curve, knots: centripetal", "exponential_spline, tension: 6", "exponential_spline, closed: true"};
  for (int k = 0; k < count; ++k) {
    const std::vector<Vec3> at = points(whole(6, 9));
    for (const std::string_view type : kTypes) {
      const std::string fields = fmt::format("{{ type: {}, points: {} }}", type, text(at));
      const CurvePtr one = curve(fields);
      // Each point is met: the least distance of the ends of the pieces, which are the knots, from it.
      for (const Vec3& p : at) {
        double least = kInfinity;
        for (const geometry::CurvePiece& piece : one->pieces())
          for (const double t : {piece.domain.lo, piece.domain.hi})
            least = std::min(least, glm::length(one->point(t) - p));
        ASSERT_LT(least, 1e-12 * kSize) << fields;
      }
    }
  }
}

TEST_F(CurveProperties, ArcLengthIsTheParameter) {
  double worst = 0;
  for (int k = 0; k < count; ++k) {
    const int degree = whole(2, 4);
    const CurvePtr of = curve(nurbs(points(degree + 3), degree));
    const double length = geometry::arc_length(*of, of->domain().lo, of->domain().hi).value;
    for (int i = 0; i < 3; ++i) {
      const double s = uniform(0, 1), t = geometry::parameter_at_fraction(*of, s);
      worst = std::max(worst, std::abs(geometry::arc_length(*of, of->domain().lo, t).value / length - s));
    }
  }
  tests::report_figure("largest_error_of_arc_length", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST_F(CurveProperties, OffsetsKeepTheirDistance) {
  for (int k = 0; k < count; ++k) {
    std::vector<Vec3> at = points(whole(4, 7));
    for (Vec3& p : at) p.z = 0;
    const double distance = uniform(-2, 2);
    const std::string of = fmt::format("{{ type: spline_curve, points: {} }}", text(at));
    const CurvePtr base = curve(of),
                   offset = curve(fmt::format("{{ type: offset_curve, of: {}, distance: {:.17g} }}", of, distance));
    for (int i = 0; i < 12; ++i) {
      const double t = uniform(base->domain().lo, base->domain().hi);
      const CurveJet here = base->evaluate(t, 1);
      const Vec3 away = offset->point(t) - here.d[0];
      ASSERT_NEAR(glm::length(away), std::abs(distance), 1e-10);
      ASSERT_NEAR(glm::dot(away, glm::normalize(here.d[1])), 0, 1e-10);
    }
  }
}

// Curvature vector and its derivative by arc length, from derivatives by any parameter.
struct Bend {
  Vec3 tangent, curvature, change;
};
Bend bend(const CurveJet& jet) {
  const Vec3 &a = jet.d[1], &b = jet.d[2], &c = jet.d[3];
  const double v = glm::length(a);
  const Vec3 t = a / v, k = (b - glm::dot(b, t) * t) / (v * v);
  // d/ds of (b - (b.t) t)/v^2.
  const Vec3 dt = v * k;
  const double dv = glm::dot(b, t);
  const Vec3 dk = (c - (glm::dot(c, t) + glm::dot(b, dt)) * t - glm::dot(b, t) * dt) / (v * v) - 2 * dv / v * k;
  return {t, k, dk / v};
}

TEST_F(CurveProperties, TransitionsHaveTheContinuityThatTheyPromise) {
  for (int k = 0; k < count; ++k) {
    std::vector<Vec3> first = points(5), second = points(5);
    for (Vec3& p : second) p += Vec3(25, 0, 0);
    const std::string a = nurbs(first, 4), b = nurbs(second, 4);
    const CurvePtr from = curve(a), to = curve(b);
    for (const int order : {1, 2, 3}) {
      const CurvePtr bridge =
          curve(fmt::format("{{ type: transition_curve, from: {}, to: {}, continuity: {} }}", a, b, order));
      const Bend ends[] = {bend(from->evaluate(from->domain().hi, 3)), bend(to->evaluate(to->domain().lo, 3))},
                 own[] = {bend(bridge->evaluate(0, 3)), bend(bridge->evaluate(1, 3))};
      for (const int i : {0, 1}) {
        ASSERT_LT(glm::length(ends[i].tangent - own[i].tangent), 1e-10);
        if (order > 1) {
          ASSERT_LT(glm::length(ends[i].curvature - own[i].curvature) * kSize,
                    1e-10 * (1 + kSize * glm::length(ends[i].curvature)));
        }
        if (order > 2) {
          ASSERT_LT(glm::length(ends[i].change - own[i].change) * kSize * kSize,
                    1e-10 * (1 + kSize * kSize * glm::length(ends[i].change)));
        }
      }
    }
  }
}

}  // namespace
}  // namespace lekalo::render
