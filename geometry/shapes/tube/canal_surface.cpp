#include "geometry/shapes/tube/canal_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/curve_parts.h"
#include "geometry/curves/operations/moving_frame.h"
#include "geometry/describe.h"
#include "geometry/formula.h"
#include "geometry/numerics/chebyshev.h"
#include "geometry/numerics/halving.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

namespace {

constexpr double kModelError = 1e-13;  // of the size
// Parts of a range that are not divided, relative to it: there the radius or its derivative jumps.
constexpr double kNarrowest = 1e-7;
constexpr int kQuarters = 4;

// cos and sin of v with their derivatives.
template <class S>
std::array<std::array<S, kMaxSurfaceOrder + 1>, 2> waves(const S& v) {
  using std::cos, std::sin;
  const S c = cos(v), s = sin(v);
  return {{{c, -s, -c, s, c}, {s, c, -s, -c, s}}};
}

}  // namespace

CanalSurface::CanalSurface(const BallSweep& sweep, const Interval& range, bool closes)
    : range_(sweep.moving(range)), is_closed_(closes && sweep.curve().is_closed() && range == sweep.curve().domain()) {
  const CurvePtr whole(CurvePtr(), &sweep.curve());  // which outlives the ribbon
  const CurvePtr curve = is_closed_ ? whole : std::make_shared<CurvePart>(whole, range_);
  const auto across = direction_across(*curve, {});
  const auto circle = [&](double t) -> std::array<Vec3, 3> {
    const BallJet ball = sweep.ball(t);
    const double speed = glm::length(ball.center[1]), p = -ball.radius[1] / speed;
    if (!(std::abs(p) < 1))
      throw FieldError("radius", fmt::format("the radius changes as fast as the curve runs at t = {:.6g}", t));
    const Vec3 e = ball.center[1] / speed, w = across->point(t);
    const Vec3 x = ball.radius[0] * std::sqrt(1 - p * p) * glm::normalize(w - glm::dot(w, e) * e);
    return {ball.center[0] + ball.radius[0] * p * e, x, glm::cross(e, x)};
  };
  for (const Interval& part : parts_of(*whole, range_)) cut(part, circle, kModelError * sweep.size());
  set_reversed(true);
}

void CanalSurface::cut(const Interval& t, const std::function<std::array<Vec3, 3>(double)>& circle, double agree) {
  const auto at = [&](double x) { return circle(t.middle() + 0.5 * t.width() * x); };
  std::array<std::array<Vec3, kTerms>, 3> values;
  for (int j = 0; j < kTerms; ++j) {
    const std::array<Vec3, 3> here = at(chebyshev_point(j, kTerms));
    for (int k = 0; k < 3; ++k) values[k][j] = here[k];
  }
  const auto polynomial = [&](int k) {
    return Curve3{t, 2 / t.width(), powers_of_chebyshev(chebyshev_coefficients(values[k]))};
  };
  Part part{polynomial(0), polynomial(1), polynomial(2)};
  const bool agrees = [&] {
    for (const double x : {-0.9999, -0.6, -0.2, 0.35, 0.8, 0.9999}) {
      const std::array<Vec3, 3> here = at(x);
      if (!(glm::length(part.center.value(x) - here[0]) <= agree && glm::length(part.x.value(x) - here[1]) <= agree &&
            glm::length(part.y.value(x) - here[2]) <= agree))
        return false;
    }
    return true;
  }();
  if (agrees) {
    parts_.push_back(std::move(part));
    return;
  }
  if (t.width() <= kNarrowest * range_.width() || !can_be_halved(t))
    throw FieldError("radius", fmt::format("the radius jumps at t = {:.6g}", t.middle()));
  cut({t.lo, t.middle()}, circle, agree);
  cut({t.middle(), t.hi}, circle, agree);
}

const CanalSurface::Part& CanalSurface::part(double u) const {
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), u,
                                      [](double x, const Part& part) { return x < part.center.t.lo; });
  return after == parts_.begin() ? *after : after[-1];
}

SurfaceJet CanalSurface::evaluate(double u, double v, int order) const {
  if (is_closed_) u = wrapped(u, range_);
  const Part& at = part(u);  // its polynomials go on beyond the range
  const double x = at.center.local(u);
  const auto turn = waves(v);
  SurfaceJet jet(order);
  for (int i = 0; i <= order; ++i) {
    const Vec3 along_x = at.x.derivative(i, x), along_y = at.y.derivative(i, x);
    for (int j = 0; i + j <= order; ++j) jet.d(i, j) = turn[0][j] * along_x + turn[1][j] * along_y;
    jet.d(i, 0) += at.center.derivative(i, x);
  }
  return jet;
}

SurfaceEnclosure CanalSurface::enclose(const Rectangle& box, int order) const {
  const auto turn = waves(box.v);
  SurfaceEnclosure result;
  for (const Part& part : parts_) {
    const Interval common = intersect(part.center.t, box.u);
    if (common.empty() || (common.width() == 0 && box.u.width() > 0)) continue;
    std::array<Box3, kMaxSurfaceOrder + 1> x, y, center;
    part.x.include_ranges(order, common, x.data());
    part.y.include_ranges(order, common, y.data());
    part.center.include_ranges(order, common, center.data());
    for (int i = 0; i <= order; ++i) {
      const Triple<Interval> along_x = triple(x[i]), along_y = triple(y[i]);
      for (int j = 0; i + j <= order; ++j) {
        Triple<Interval> sum = turn[0][j] * along_x + turn[1][j] * along_y;
        if (j == 0) sum = sum + triple(center[i]);
        result.values[SurfaceJet::index(i, j)].include(box_of(sum));
      }
    }
  }
  return result;
}

Vec3 CanalSurface::outward(double u, double v) const {
  if (is_closed_) u = wrapped(u, range_);
  const Part& at = part(u);
  const double x = at.center.local(u);
  const Vec3 from_axis = std::cos(v) * at.x.value(x) + std::sin(v) * at.y.value(x), n = normal(u, v);
  return glm::dot(n, from_axis) < 0 ? -n : n;
}

std::vector<SurfacePiece> CanalSurface::pieces() const {
  std::vector<SurfacePiece> pieces;
  for (const Part& part : parts_)
    for (int k = 0; k < kQuarters; ++k)
      pieces.push_back(plain_piece({part.center.t, {kTwoPi * k / kQuarters, kTwoPi * (k + 1) / kQuarters}}));
  return pieces;
}

}  // namespace lekalo::geometry
