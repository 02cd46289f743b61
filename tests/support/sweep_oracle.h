// The oracle for balls that a curve sweeps: where along a line the distance to the curve equals the radius.
//
//   F(s) = min over t of |o + s d - r(t)| - R(t)
//
// in long double, the minimum by dense samples and golden sections. F changes by at most s, so a walk by |F| passes no
// crossing (Hart 1996); where |F| is below the shortest step a touch may be passed. It shares nothing with the
// product's solver: no derivative, no root finding but bisection.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::oracle {

struct SweptBall {
  long double x, y, z, radius;
};

class SweepOracle {
 public:
  // `breaks`: ends of the curve's smooth parts, in order.
  SweepOracle(std::function<SweptBall(long double)> ball, std::vector<double> breaks, int samples)
      : ball_(std::move(ball)) {
    for (size_t k = 0; k + 1 < breaks.size(); ++k)
      for (int i = 0; i <= samples; ++i)
        if (k == 0 || i > 0) t_.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / samples);
    for (const long double t : t_) balls_.push_back(ball_(t));
    for (size_t i = 1; i < balls_.size(); ++i) {
      const SweptBall &a = balls_[i - 1], &b = balls_[i];
      step_ = std::max(step_, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) + std::abs(a.radius - b.radius));
    }
  }

  // Crossings with s from lo to hi in units of the unit direction.
  std::vector<double> crossings(const geometry::Line& line, long double lo, long double hi, long double size) const {
    const long double shortest = 1e-5L * size;
    std::vector<double> result;
    long double s = lo, f = distance(line, s);
    while (s < hi) {
      const long double next = s + std::max(std::abs(f), shortest), g = distance(line, next);
      if ((f < 0) != (g < 0)) {
        long double a = s, b = next;
        for (int i = 0; i < 60 && b - a > 1e-17L * size; ++i) {
          const long double middle = (a + b) / 2;
          ((distance(line, middle) < 0) == (f < 0) ? a : b) = middle;
        }
        result.push_back(static_cast<double>((a + b) / 2));
      }
      s = next;
      f = g;
    }
    return result;
  }

  long double distance(const geometry::Line& line, long double s) const {
    const long double x = line.origin.x + s * line.direction.x, y = line.origin.y + s * line.direction.y,
                      z = line.origin.z + s * line.direction.z;
    const auto from = [&](const SweptBall& b) { return std::hypot(x - b.x, y - b.y, z - b.z) - b.radius; };
    thread_local std::vector<long double> f;
    f.resize(balls_.size());
    long double least = 1e300L;
    for (size_t i = 0; i < balls_.size(); ++i) least = std::min(least, f[i] = from(balls_[i]));
    long double result = least;
    for (size_t i = 0; i < f.size(); ++i) {
      const bool low = (i == 0 || f[i] <= f[i - 1]) && (i + 1 == f.size() || f[i] <= f[i + 1]);
      if (!low || f[i] > least + step_) continue;
      long double a = t_[i == 0 ? 0 : i - 1], b = t_[std::min(i + 1, f.size() - 1)];
      const long double golden = 0.618033988749894848204586834L;
      long double p = b - golden * (b - a), q = a + golden * (b - a), fp = from(ball_(p)), fq = from(ball_(q));
      for (int k = 0; k < 48; ++k) {
        if (fp < fq) {
          b = q, q = p, fq = fp, p = b - golden * (b - a), fp = from(ball_(p));
        } else {
          a = p, p = q, fp = fq, q = a + golden * (b - a), fq = from(ball_(q));
        }
      }
      result = std::min({result, fp, fq});
    }
    return result;
  }

 private:
  std::function<SweptBall(long double)> ball_;
  std::vector<long double> t_;
  std::vector<SweptBall> balls_;
  long double step_ = 0;
};

}  // namespace lekalo::oracle
