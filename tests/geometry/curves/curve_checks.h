// Checks that every family of curves must pass, each against something computed in another way:
//   derivatives  the family's formula, written out again in the test, on Taylor jets of 113-bit numbers
//   differences  Richardson-extrapolated central differences of the next lower derivative (curves without a formula)
//   enclosures   random parts of the domain against samples
//   NURBS form   the Cox-de Boor recursion in long double at mapped parameters
//   pieces       de Casteljau in long double, domains that join without gaps
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/curve.h"
#include "geometry/numerics/jet.h"
#include "geometry/numerics/triple.h"
#include "geometry/quad.h"

namespace lekalo::geometry::checks {

using Homogeneous = std::array<long double, 4>;

inline Homogeneous mix(long double a, const Homogeneous& p, long double b, const Homogeneous& q) {
  Homogeneous r;
  for (int i = 0; i < 4; ++i) r[i] = a * p[i] + b * q[i];
  return r;
}

inline Homogeneous widened(const Vec4& p) { return {p.x, p.y, p.z, p.w}; }

inline Vec3 projected(const Homogeneous& p) {
  return {static_cast<double>(p[0] / p[3]), static_cast<double>(p[1] / p[3]), static_cast<double>(p[2] / p[3])};
}

// Values of the B-splines of one degree at s by the Cox-de Boor recursion, 0/0 = 0 (Golovanov 2016, 2.8).
inline std::vector<long double> basis(int degree, const std::vector<double>& knots, long double s) {
  const int count = static_cast<int>(knots.size()) - 1;
  std::vector<long double> n(count, 0);
  const int last = count - degree - 1;  // the last span of the domain is closed
  for (int i = degree; i <= last; ++i) {
    const bool at_end = s >= knots[last + 1] && knots[i] < knots[last + 1] && knots[i + 1] == knots[last + 1];
    if (knots[i] < knots[i + 1] && ((s >= knots[i] && s < knots[i + 1]) || at_end)) {
      n[i] = 1;
      break;
    }
  }
  for (int k = 1; k <= degree; ++k) {
    for (int i = 0; i + k < count; ++i) {
      const long double left = static_cast<long double>(knots[i + k]) - knots[i];
      const long double right = static_cast<long double>(knots[i + k + 1]) - knots[i + 1];
      n[i] =
          (left > 0 ? (s - knots[i]) / left * n[i] : 0) + (right > 0 ? (knots[i + k + 1] - s) / right * n[i + 1] : 0);
    }
  }
  n.resize(count - degree);
  return n;
}

// The parameter map of the span that contains the natural parameter t; affine where the form has no maps.
inline ParameterMap map_at(int degree, const std::vector<double>& knots, const std::vector<ParameterMap>& maps,
                           double t) {
  if (maps.empty()) return {ParameterMap::Kind::affine, knots.front(), knots.back()};
  size_t index = 0;
  for (size_t i = degree; i + degree + 1 < knots.size(); ++i) {
    if (!(knots[i] < knots[i + 1])) continue;
    if (t < knots[i + 1] || index + 1 == maps.size()) break;
    ++index;
  }
  return maps.at(index);
}

inline Homogeneous de_casteljau(std::vector<Homogeneous> p, long double x) {
  for (size_t n = p.size(); n > 1; --n)
    for (size_t i = 0; i + 1 < n; ++i) p[i] = mix(1 - x, p[i], x, p[i + 1]);
  return p[0];
}

// The scale of rounding errors: the curve's extent and its distance from the origin.
inline double size_of(const Box3& box) {
  const Vec3 far = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  return std::max({far.x, far.y, far.z});
}

inline double distance(const Vec3& a, const Vec3& b) { return glm::length(a - b); }

// formula(T t) -> Triple<T> for T = double, Jet<Quad, 6>.
template <class Formula>
void check_derivatives(const Curve& curve, const Formula& formula, const Interval& range, double tolerance = 1e-14) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(range.lo, range.hi);
  for (int sample = 0; sample < 40; ++sample) {
    const double t = sample == 0 ? range.lo : sample == 1 ? range.hi : uniform(random);
    const auto exact = formula(Jet<Quad, kMaxCurveOrder>::variable(Quad(t)));
    for (int order = 0; order <= curve.max_order(); ++order) {
      const CurveJet jet = curve.evaluate(t, order);
      ASSERT_EQ(jet.order, order);
      for (int k = 0; k <= order; ++k) {
        const Vec3 d(static_cast<double>(exact.x.derivative(k)), static_cast<double>(exact.y.derivative(k)),
                     static_cast<double>(exact.z.derivative(k)));
        const double scale = std::max(glm::length(d), size_of(bounds(curve)));
        ASSERT_LE(distance(jet.d[k], d), tolerance * scale) << "derivative " << k << " at t = " << t;
      }
    }
  }
}

// Derivative k + 1 against central differences of derivative k with steps h, h/2, h/4 (error h^6 apart from rounding).
inline void check_differences(const Curve& curve, const Interval& range, int order = 4, double tolerance = 1e-7) {
  std::mt19937_64 random(12);
  const double h = 1e-2 * range.width();
  std::uniform_real_distribution<double> uniform(range.lo + h, range.hi - h);
  for (int sample = 0; sample < 25; ++sample) {
    const double t = uniform(random);
    const CurveJet jet = curve.evaluate(t, order);
    for (int k = 0; k < order; ++k) {
      const auto difference = [&](double step) {
        return (curve.evaluate(t + step, k).d[k] - curve.evaluate(t - step, k).d[k]) / (2 * step);
      };
      const Vec3 d0 = difference(h), d1 = difference(h / 2), d2 = difference(h / 4);
      const Vec3 e0 = (4.0 * d1 - d0) / 3.0, e1 = (4.0 * d2 - d1) / 3.0;
      const Vec3 d = (16.0 * e1 - e0) / 15.0;
      const double scale = glm::length(jet.d[k + 1]) + glm::length(jet.d[k]) / range.width();
      ASSERT_LE(distance(jet.d[k + 1], d), tolerance * scale) << "derivative " << k + 1 << " at t = " << t;
    }
  }
}

// 2000 samples in 40 random parts of the range.
inline void check_enclosures(const Curve& curve, const Interval& range) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int part = 0; part < 40; ++part) {
    const double width = range.width() * std::pow(10.0, -4 * uniform(random));
    const double lo = range.lo + uniform(random) * (range.width() - width);
    const Interval box(lo, std::min(lo + width, range.hi));
    const CurveEnclosure enclosure = curve.enclose(box, 2);
    const Box3 point_only = curve.enclose(box, 0).d[0];
    double fastest = 0;
    for (int i = 0; i < 50; ++i) {
      const double t = i == 0 ? box.lo : i == 1 ? box.hi : box.clamp(box.lo + uniform(random) * box.width());
      const CurveJet jet = curve.evaluate(t, 2);
      for (int k = 0; k <= 2; ++k)
        ASSERT_TRUE(enclosure.d[k].contains(jet.d[k])) << "derivative " << k << " at t = " << t;
      ASSERT_TRUE(point_only.contains(jet.d[0])) << "point at t = " << t;
      fastest = std::max(fastest, glm::length(jet.d[1]));
    }
    // An enclosure is of use only if it shrinks with its interval.
    const double slack = 1e-12 * size_of(point_only);
    ASSERT_LE(point_only.diameter(), 50 * (fastest + 1e-3 * glm::length(enclosure.d[1].size())) * box.width() + slack);
  }
}

inline void check_nurbs(const Curve& curve, double tolerance = 1e-13) {
  const auto form = curve.as_nurbs();
  ASSERT_TRUE(form.has_value());
  ASSERT_EQ(form->points.size() + form->degree + 1, form->knots.size());
  const Interval range = curve.domain();
  const double size = size_of(bounds(curve));
  for (int i = 0; i <= 200; ++i) {
    const double t = i == 200 ? range.hi : range.lo + range.width() * i / 200;
    const double s = map_at(form->degree, form->knots, form->maps, t).rational(t);
    const std::vector<long double> n = basis(form->degree, form->knots, s);
    Homogeneous sum{};
    for (size_t j = 0; j < n.size(); ++j) sum = mix(1, sum, n[j], widened(form->points[j]));
    ASSERT_LE(distance(projected(sum), curve.point(t)), tolerance * size) << "t = " << t;
  }
}

inline void check_pieces(const Curve& curve, double tolerance = 1e-13) {
  const std::vector<CurvePiece> pieces = curve.pieces();
  ASSERT_FALSE(pieces.empty());
  EXPECT_EQ(pieces.front().domain.lo, curve.domain().lo);
  EXPECT_EQ(pieces.back().domain.hi, curve.domain().hi);
  const double size = size_of(bounds(curve));
  for (size_t k = 0; k < pieces.size(); ++k) {
    const CurvePiece& piece = pieces[k];
    if (k > 0) {
      EXPECT_EQ(pieces[k - 1].domain.hi, piece.domain.lo);
    }
    if (!piece.is_rational()) continue;
    std::vector<Homogeneous> points;
    for (const Vec4& p : piece.points) points.push_back(widened(p));
    for (int i = 0; i <= 20; ++i) {
      const double t = piece.domain.clamp(piece.domain.lo + piece.domain.width() * i / 20);
      const Vec3 p = projected(de_casteljau(points, piece.map.bezier(t)));
      ASSERT_LE(distance(p, curve.point(t)), tolerance * size) << "piece " << k << ", t = " << t;
    }
  }
}

// Wraps by whole periods; closed exactly when the end points meet.
inline void check_period(const Curve& curve) {
  const Interval range = curve.domain();
  const double size = size_of(bounds(curve));
  if (curve.period() > 0) {
    for (const double t : {range.lo, range.middle(), range.hi}) {
      for (const int turns : {-2, 1, 3})
        EXPECT_LE(distance(curve.point(t + turns * curve.period()), curve.point(t)), 1e-14 * size * 10);
    }
  }
  const bool ends_meet = distance(curve.point(range.lo), curve.point(range.hi)) <= 1e-9 * size;
  EXPECT_EQ(curve.is_closed(), ends_meet);
}

}  // namespace lekalo::geometry::checks
