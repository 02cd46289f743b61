// Composite Hermite curves and estimated tangents: what the estimates are exact for, the books' numbers, closed curves.
#include "geometry/curves/interpolation/hermite_curve.h"

#include "geometry/curves/curve_checks.h"
#include "geometry/curves/interpolation/point_parameters.h"

namespace lekalo::geometry::hermite_curve_test {
namespace {

using checks::distance;
using Points = std::vector<Vec3>;
using List = std::vector<double>;

struct Data {
  Points points;
  List parameters;
  PointSequence sequence(bool closed = false) const {
    return {points, std::span(parameters).first(points.size() + (closed ? 1 : 0)), closed};
  }
};

// Of a function at uneven parameters.
template <class Function>
Data sampled(const Function& f, int count) {
  Data data;
  double t = -0.4;
  for (int i = 0; i <= count; ++i) {
    data.parameters.push_back(t);
    if (i < count) data.points.push_back(f(t));
    t += 0.3 + 0.2 * ((7 * i) % 5);
  }
  return data;
}

TEST(TangentEstimates, AreExactForPolynomials) {
  const auto power = [](int n) { return [n](double t) { return Vec3(std::pow(t, n), t, 1 - std::pow(t, n)); }; };
  const std::pair<const char*, int> estimates[] = {{"two_point", 1}, {"secant", 1},      {"akima", 1},
                                                   {"monotone", 1},  {"three_point", 2}, {"four_point", 3},
                                                   {"five_point", 4}};
  for (const auto& [estimate, degree] : estimates) {
    const Data data = sampled(power(degree), 8);
    const auto tangents = estimated_tangents(estimate, data.sequence());
    for (int i = 0; i < 8; ++i) {
      const double slope = degree * std::pow(data.parameters[i], degree - 1);
      EXPECT_LE(distance(tangents[i], {slope, 1, -slope}), 1e-14 * (10 + std::abs(slope))) << estimate;
    }
  }
}

// Zavyalov et al. 1985, (16): four points, at their first and second.
TEST(TangentEstimates, OfFourPointsAreTheBooks) {
  const Data data = sampled([](double t) { return Vec3(std::exp(t), std::sin(3 * t), t); }, 4);
  const PointSequence s = data.sequence();
  const double h0 = s.step(0), h1 = s.step(1), h2 = s.step(2), sigma = h0 / (h0 + h1 + h2);
  const double lambda1 = h1 / (h0 + h1), mu1 = h0 / (h0 + h1), mu2 = h1 / (h1 + h2);
  const Vec3 f01 = s.slope(0), f12 = s.slope(1), f23 = s.slope(2);
  const auto tangents = estimated_tangents("four_point", s);
  EXPECT_LE(distance(tangents[0], (1 + mu1 + sigma) * f01 - (mu1 + sigma + sigma * mu2 / lambda1) * f12 +
                                      sigma * mu2 / lambda1 * f23),
            1e-14);
  EXPECT_LE(distance(tangents[1],
                     lambda1 * (1 - sigma) * f01 + (mu1 + lambda1 * sigma + mu2 * sigma) * f12 - mu2 * sigma * f23),
            1e-14);
}

// Golovanov 2016, 2.3: inside as of parabolas through three points, and no second derivative at the ends.
TEST(TangentEstimates, OfBesselLeaveTheEndsFree) {
  const Data data = sampled([](double t) { return Vec3(std::exp(t), std::sin(3 * t), t * t); }, 6);
  const PointSequence s = data.sequence();
  const auto tangents = estimated_tangents("bessel", s);
  for (int i = 1; i < 5; ++i) {
    const double before = s.step(i - 1), after = s.step(i);
    EXPECT_LE(distance(tangents[i], (after * s.slope(i - 1) + before * s.slope(i)) / (before + after)), 1e-14) << i;
  }
  const NurbsCurve curve = hermite_curve(s, tangents);
  const Interval domain = curve.domain();
  const double size = glm::length(curve.evaluate(0.5 * (domain.lo + domain.hi), 2).d[2]);
  for (const double end : {domain.lo, domain.hi})
    EXPECT_LE(glm::length(curve.evaluate(end, 2).d[2]), 1e-13 * (1 + size)) << end;
}

TEST(TangentEstimates, OfCirclesAreTheirTangents) {
  Points points;
  for (const double angle : {0.3, 0.9, 2.1, 2.4, 3.9}) points.push_back({std::cos(angle), std::sin(angle), 0});
  for (const bool closed : {false, true}) {
    const List t = point_parameters({"chord_length", {}}, points, closed);
    for (const char* estimate : {"circle", "five_point_circle"})
      for (size_t i = 0; i < points.size(); ++i) {
        const Vec3 tangent = estimated_tangents(estimate, {points, t, closed})[i];
        EXPECT_LE(distance(glm::normalize(tangent), {-points[i].y, points[i].x, 0}), 2e-15) << estimate << " " << i;
      }
  }
}

// Three points on a line on one side: the tangent goes along it (Zavyalov et al. 1985, II.5).
TEST(TangentEstimates, OfFivePointsFollowALine) {
  const Points points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {3, 2.5, 0}};
  const List t = point_parameters({"chord_length", {}}, points, false);
  EXPECT_LE(distance(glm::normalize(estimated_tangents("five_point_circle", {points, t, false})[2]), {1, 0, 0}), 1e-15);
}

double energy(const NurbsCurve& curve) {
  double sum = 0;
  for (const CurvePiece& piece : curve.pieces()) {  // r'' is linear over a piece: Simpson's rule is exact
    const double h = piece.domain.width();
    const auto second = [&](double w) { return curve.evaluate(piece.domain.lo + w * h, 2).d[2]; };
    const Vec3 a = second(1e-9), m = second(0.5), b = second(1 - 1e-9);
    sum += h / 6 * (glm::dot(a, a) + 4 * glm::dot(m, m) + glm::dot(b, b));
  }
  return sum;
}

TEST(HermiteCurve, LeastEnergySpeedsHaveTheLeastEnergy) {
  const Data data = sampled([](double t) { return Vec3(t, std::sin(2 * t), t * t); }, 6);
  for (const bool closed : {false, true}) {
    const PointSequence s = data.sequence(closed);
    std::vector<Vec3> directions = estimated_tangents("secant", s);
    for (Vec3& d : directions) d = glm::normalize(d);
    const std::vector<double> speeds = min_energy_speeds(s, directions);
    const auto with = [&](int point, double change) {
      std::vector<Vec3> tangents;
      for (int i = 0; i < s.size(); ++i) tangents.push_back((speeds[i] + (i == point ? change : 0)) * directions[i]);
      return energy(hermite_curve(s, tangents));
    };
    for (int i = 0; i < s.size(); ++i) {
      EXPECT_GT(with(i, 0.01), with(i, 0));
      EXPECT_GT(with(i, -0.01), with(i, 0));
      EXPECT_NEAR(with(i, 0.01) / with(i, -0.01), 1, 1e-6);
    }
  }
}

TEST(HermiteCurve, HasItsPointsAndTangentsOpenAndClosed) {
  const Data data = sampled([](double t) { return Vec3(std::cos(2 * t), std::sin(3 * t), t); }, 7);
  for (const bool closed : {false, true}) {
    const PointSequence s = data.sequence(closed);
    const std::vector<Vec3> tangents = estimated_tangents("bessel", s);
    const NurbsCurve curve = hermite_curve(s, tangents);
    for (int i = 0; i < s.size(); ++i) {
      const CurveJet jet = curve.evaluate(s.parameter(i), 1);
      EXPECT_LE(distance(jet.d[0], s.point(i)), 1e-15);
      EXPECT_LE(distance(jet.d[1], tangents[i]), 2e-14);
      if (i + 1 == s.size() && !closed) break;
      // Golovanov 2016, 2.3.10, in the middle of a span.
      const Vec3 middle =
          0.5 * (s.point(i) + s.point(i + 1)) + s.step(i) / 8 * (tangents[i] - tangents[(i + 1) % tangents.size()]);
      EXPECT_LE(distance(curve.point(0.5 * (s.parameter(i) + s.parameter(i + 1))), middle), 2e-15);
    }
    EXPECT_EQ(curve.period() > 0, closed);
    checks::check_pieces(curve);
    checks::check_enclosures(curve, curve.domain());
    checks::check_period(curve);
  }
}

}  // namespace
}  // namespace lekalo::geometry::hermite_curve_test
