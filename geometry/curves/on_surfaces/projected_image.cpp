#include "geometry/curves/on_surfaces/projected_image.h"

#include <cmath>
#include <stdexcept>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/point_formulas.h"
#include "geometry/surface_series.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

using Mat2 = std::array<std::array<double, 2>, 2>;

constexpr int kMaxSteps = 30;
// Determinants below this part of their terms are rounding.
constexpr double kSingular = 1e-11;

template <class S>
Triple<S> triple_of(const Vec3& v) {
  return {S(v.x), S(v.y), S(v.z)};
}
Triple<Interval> triple_of(const Box3& box) { return {along(box, 0), along(box, 1), along(box, 2)}; }

template <class M>
bool inverse(const M& m, Mat2& result) {
  const double a = m[0][0], b = m[0][1], c = m[1][0], d = m[1][1], det = a * d - b * c;
  if (!(std::abs(det) > kSingular * (std::abs(a * d) + std::abs(b * c)))) return false;
  result = {{{d / det, -b / det}, {-c / det, a / det}}};
  return true;
}

template <int N>
Triple<Jet<double, N>> series_of(const CurveJet& c) {
  Triple<Jet<double, N>> result;
  double factorial = 1;
  for (int k = 0; k <= std::min(N, c.order); ++k) {
    if (k > 0) factorial *= k;
    result.x.c[k] = c.d[k].x / factorial;
    result.y.c[k] = c.d[k].y / factorial;
    result.z.c[k] = c.d[k].z / factorial;
  }
  return result;
}

}  // namespace

ProjectionEquations::ProjectionEquations(CurvePtr curve, SurfacePtr surface, std::optional<Vec3> direction)
    : curve_(std::move(curve)), surface_(std::move(surface)), direction_(direction) {
  size_ = bounds(*curve_).diameter();
  if (surface_->bounded()) size_ = std::max(size_, bounds(*surface_).diameter());
  if (!direction_) return;
  const Frame frame = frame_about(Vec3(0), *direction_);
  across_[0] = frame.x;
  across_[1] = frame.y;
}

// Derivatives of the equations by u and v.
template <class S, class Derivatives>
ProjectionEquations::Matrix<S> ProjectionEquations::matrix(const Derivatives& surface, const Triple<S>& curve) const {
  const Triple<S> u = derivative_of(surface, 1, 0), v = derivative_of(surface, 0, 1);
  Matrix<S> result;
  if (direction_) {
    for (int k = 0; k < 2; ++k) result[k] = {-dot(u, triple_of<S>(across_[k])), -dot(v, triple_of<S>(across_[k]))};
    return result;
  }
  const Triple<S> way = curve - derivative_of(surface, 0, 0);
  const S mixed = dot(way, derivative_of(surface, 1, 1)) - dot(u, v);
  result[0] = {dot(way, derivative_of(surface, 2, 0)) - dot(u, u), mixed};
  result[1] = {mixed, dot(way, derivative_of(surface, 0, 2)) - dot(v, v)};
  return result;
}

template <class S, int N, class Derivatives>
std::array<Jet<S, N>, 2> ProjectionEquations::residual(const Derivatives& surface, const Triple<Jet<S, N>>& curve,
                                                       const std::array<Jet<S, N>, 2>& x) const {
  const auto way = curve - along_surface(surface, x[0], x[1]);
  if (direction_) return {dot(way, triple_of<S>(across_[0])), dot(way, triple_of<S>(across_[1]))};
  return {dot(way, along_surface(surface, x[0], x[1], 1, 0)), dot(way, along_surface(surface, x[0], x[1], 0, 1))};
}

std::optional<Vec2> ProjectionEquations::solve(double t, const Vec2& start) const {
  const Vec3 c = curve_->point(t);
  Vec2 x = start;
  double before = kInfinity;
  for (int step = 0; step < kMaxSteps; ++step) {
    const SurfaceJet s = surface_->evaluate(x.x, x.y, direction_ ? 1 : 2);
    const Vec3 way = c - s.point();
    const Vec2 f = direction_ ? Vec2(glm::dot(way, across_[0]), glm::dot(way, across_[1]))
                              : Vec2(glm::dot(way, s.du()), glm::dot(way, s.dv()));
    Mat2 c_of;
    if (!inverse(matrix<double>(s, triple_of<double>(c)), c_of)) return std::nullopt;
    const Vec2 by(-(c_of[0][0] * f.x + c_of[0][1] * f.y), -(c_of[1][0] * f.x + c_of[1][1] * f.y));
    x += by;
    const double moved = glm::length(by.x * s.du() + by.y * s.dv());
    if (!std::isfinite(moved)) return std::nullopt;
    if (moved <= 2e-16 * size_ || (moved <= 1e-11 * size_ && moved >= 0.5 * before)) return x;
    before = moved;
  }
  return std::nullopt;
}

bool ProjectionEquations::is_nearest(double t, const Vec2& solution) const {
  const auto m = matrix<double>(surface_->evaluate(solution.x, solution.y, 2), triple_of<double>(curve_->point(t)));
  return m[0][0] < 0 && m[0][0] * m[1][1] > m[0][1] * m[1][0];
}

std::array<Jet<double, ProjectionEquations::kOrder>, 2> ProjectionEquations::series(double t, const Vec2& solution,
                                                                                    int order) const {
  std::array<Jet<double, kOrder>, 2> x{Jet<double, kOrder>(solution.x), Jet<double, kOrder>(solution.y)};
  if (order == 0) return x;
  const int needed = std::min(kMaxSurfaceOrder, order + (direction_ ? 0 : 1));
  const SurfaceJet s = surface_->evaluate(solution.x, solution.y, std::max(needed, 2));
  SurfaceJet known(kMaxSurfaceOrder);
  std::copy_n(s.values.begin(), (s.order + 1) * (s.order + 2) / 2, known.values.begin());
  const auto curve = series_of<kOrder>(curve_->evaluate(t, order));
  Mat2 c_of;
  if (!inverse(matrix<double>(s, triple_of<double>(curve_->point(t))), c_of)) {
    for (auto& one : x)
      for (int k = 1; k <= order; ++k) one.c[k] = std::numeric_limits<double>::infinity();
    return x;
  }
  // The coefficient k of the equations is that with x_k left out, and the matrix times x_k.
  for (int k = 1; k <= order; ++k) {
    const auto f = residual<double, kOrder>(known, curve, x);
    for (int i = 0; i < 2; ++i) x[i].c[k] = -(c_of[i][0] * f[0].c[k] + c_of[i][1] * f[1].c[k]);
  }
  return x;
}

SurfaceEnclosure ProjectionEquations::surface_over(const std::array<Interval, 2>& x, int order) const {
  const int known = std::min(order, surface_->enclosure_order());
  SurfaceEnclosure result = enclose_unwrapped(*surface_, {x[0], x[1]}, known);
  for (int k = 0; k <= order && known < order; ++k) {
    Box3 seen;
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; j <= 2; ++j)
        seen.include(surface_->evaluate(x[0].lo + 0.5 * i * x[0].width(), x[1].lo + 0.5 * j * x[1].width(), order)
                         .d(order - k, k));
    result.values[SurfaceJet::index(order - k, k)] = seen.inflated(0.5 * seen.diameter());
  }
  return result;
}

std::optional<ProjectionEquations::Ranges> ProjectionEquations::enclose(const PolynomialCurve::Part& about,
                                                                        const Interval& t, int order) const {
  constexpr int kTries = 6;
  const double middle = t.middle();
  const auto x0 = solve(middle, Vec2(about.value(about.local(middle))));
  if (!x0) return std::nullopt;
  const double place[2] = {x0->x, x0->y};
  const SurfaceJet at = surface_->evaluate(x0->x, x0->y, 2);
  Mat2 c_of;
  if (!inverse(matrix<double>(at, triple_of<double>(curve_->point(middle))), c_of)) return std::nullopt;
  const auto preconditioned = [&](int i, const Interval& a, const Interval& b) {
    return Interval(c_of[i][0]) * a + Interval(c_of[i][1]) * b;
  };
  const Interval thin(middle);
  const Box3 c0 = curve_->enclose(thin, 0).d[0];
  const auto f0 = residual<Interval, 0>(surface_over({Interval(place[0]), Interval(place[1])}, direction_ ? 0 : 1),
                                        Triple<Jet<Interval, 0>>{along(c0, 0), along(c0, 1), along(c0, 2)},
                                        std::array<Jet<Interval, 0>, 2>{Interval(place[0]), Interval(place[1])});
  const CurveEnclosure curve = curve_->enclose(t, std::max(order, 1));
  const Triple<Interval> speed = triple_of(curve.d[1]);
  std::array<Interval, 2> x, rate;
  Box3 start;
  about.include_ranges(0, t, &start);
  const Vec3 speeds[2] = {at.du(), at.dv()};
  for (int i = 0; i < 2; ++i) {
    const double room =
        0.05 * along(start, i).width() + 1e-13 * size_ / glm::length(speeds[i]) + 1e-15 * std::abs(place[i]);
    x[i] = {start.lo[i] - room, start.hi[i] + room};
  }
  Matrix<Interval> near{};  // C times the matrix
  bool certified = false;
  for (int time = 0; time < kTries; ++time) {
    const SurfaceEnclosure s = surface_over(x, direction_ ? 1 : 2);
    const auto m = matrix<Interval>(s, triple_of(curve.d[0]));
    const std::array<Triple<Interval>, 2> by =
        direction_ ? std::array{triple_of<Interval>(across_[0]), triple_of<Interval>(across_[1])}
                   : std::array{derivative_of(s, 1, 0), derivative_of(s, 0, 1)};
    const Interval drift[2] = {dot(speed, by[0]), dot(speed, by[1])};
    std::array<Interval, 2> next;
    bool holds = true;
    for (int i = 0; i < 2; ++i) {
      rate[i] = -preconditioned(i, drift[0], drift[1]);
      next[i] = Interval(place[i]) - preconditioned(i, f0[0].c[0], f0[1].c[0]) + rate[i] * (t - Interval(middle));
      for (int j = 0; j < 2; ++j) {
        near[i][j] = preconditioned(i, m[0][j], m[1][j]);
        next[i] += (Interval(i == j ? 1 : 0) - near[i][j]) * (x[j] - Interval(place[j]));
      }
      if (!(next[i].width() < kInfinity)) return std::nullopt;
      holds = holds && x[i].contains(next[i]);
    }
    if (holds || certified) {
      certified = true;
      bool narrower = false;
      for (int i = 0; i < 2; ++i) {
        const Interval both = intersect(x[i], next[i]);
        narrower = narrower || both.width() < 0.7 * x[i].width();
        x[i] = both;
      }
      if (!narrower) break;
      continue;
    }
    // Only what is too narrow is widened: a wider range of one makes the other's wider too.
    for (int i = 0; i < 2; ++i) {
      if (x[i].contains(next[i])) continue;
      const Interval both = hull(x[i], next[i]);
      x[i] = {both.lo - 0.1 * both.width(), both.hi + 0.1 * both.width()};
    }
  }
  if (!certified) return std::nullopt;
  Ranges result;
  result.x[0][0] = x[0];
  result.x[1][0] = x[1];
  const Interval det = near[0][0] * near[1][1] - near[0][1] * near[1][0];
  if (order >= 1 && det.contains(0)) return std::nullopt;
  const auto solved = [&](int k, const Interval& a, const Interval& b) {
    result.x[0][k] = (near[1][1] * a - near[0][1] * b) / det;
    result.x[1][k] = (near[0][0] * b - near[1][0] * a) / det;
  };
  if (order >= 1) solved(1, rate[0], rate[1]);
  if (order < 2) return result;
  std::array<Jet<Interval, 2>, 2> jets;
  for (int i = 0; i < 2; ++i) jets[i].c[0] = x[i], jets[i].c[1] = result.x[i][1];
  Triple<Jet<Interval, 2>> c;
  for (int k = 0; k <= 2; ++k) {
    const Interval factor(k == 2 ? 0.5 : 1.0);
    c.x.c[k] = factor * along(curve.d[k], 0);
    c.y.c[k] = factor * along(curve.d[k], 1);
    c.z.c[k] = factor * along(curve.d[k], 2);
  }
  const auto f = residual<Interval, 2>(surface_over(x, direction_ ? 2 : 3), c, jets);
  solved(2, Interval(-2) * preconditioned(0, f[0].c[2], f[1].c[2]),
         Interval(-2) * preconditioned(1, f[0].c[2], f[1].c[2]));
  return result;
}

ProjectedImage::ProjectedImage(std::shared_ptr<const ProjectionEquations> equations, PolynomialCurve starts)
    : equations_(std::move(equations)), starts_(std::move(starts)) {
  const Interval range = domain(), all = equations_->curve().domain();
  const Vec3 apart = starts_.point(range.hi) - starts_.point(range.lo);
  if (equations_->curve().period() > 0 && equations_->curve().is_closed() && range == all &&
      glm::length(apart) <= kClosedCurve * bounds(starts_).diameter())
    period_ = range.width();
}

CurveJet ProjectedImage::evaluate(double t, int order) const {
  if (order > equations_->highest_order())
    throw std::invalid_argument(equations_->is_along_normals()
                                    ? "a projection along normals has derivatives up to order 3"
                                    : "a projection along a direction has derivatives up to order 4");
  if (period_ > 0) t = wrapped(t, domain());
  const double inside = domain().clamp(t);
  const Vec2 start(starts_.point(inside));
  const Vec2 x = equations_->solve(inside, start).value_or(start);
  const auto series = equations_->series(inside, x, t == inside ? order : std::max(order, 1));
  CurveJet jet;
  jet.order = order;
  for (int k = 0; k <= order; ++k) jet.d[k] = Vec3(series[0].derivative(k), series[1].derivative(k), 0);
  if (t == inside) return jet;
  jet.d[0] += (t - inside) * Vec3(series[0].c[1], series[1].c[1], 0);
  for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  return jet;
}

void ProjectedImage::enclose_part(const PolynomialCurve::Part& part, const Interval& t, int order, int depth,
                                  CurveEnclosure& result) const {
  constexpr int kMaxHalvings = 16;
  if (const auto ranges = equations_->enclose(part, t, order)) {
    for (int k = 0; k <= order; ++k) {
      const Interval &u = ranges->x[0][k], &v = ranges->x[1][k];
      result.d[k].include(Box3{{u.lo, v.lo, 0}, {u.hi, v.hi, 0}});
    }
    return;
  }
  if (depth == kMaxHalvings || !(t.width() > 0)) {
    // Next to a place where the equations are singular: nothing is known of the derivatives.
    Box3 box;
    part.include_ranges(0, t, &box);
    result.d[0].include(box.inflated(1e-9 * std::max(1.0, box.diameter())));
    for (int k = 1; k <= order; ++k) result.d[k] = Box3::everything();
    return;
  }
  enclose_part(part, {t.lo, t.middle()}, order, depth + 1, result);
  enclose_part(part, {t.middle(), t.hi}, order, depth + 1, result);
}

CurveEnclosure ProjectedImage::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  for (const PolynomialCurve::Part& part : starts_.parts()) {
    const Interval common = intersect(part.t, t);
    if (common.empty() || (common.width() == 0 && t.width() > 0)) continue;
    enclose_part(part, common, order, 0, result);
  }
  return result;
}

}  // namespace lekalo::geometry
