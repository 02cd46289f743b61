// A conic through a pole at t = p has x and y there as the product of one factor and two functions without a common
// zero, so that the direction from the axis is known on both sides:
//
//   cos t - cos p = -2 sin m sin h,  sin t - sin p = 2 cos m sin h;   cosh, sinh alike;   t^2 - p^2 = 2 m (t - p),
//   m = (t + p)/2, h = (t - p)/2.
#include "geometry/queries/quadrics/conic_image.h"

#include <algorithm>
#include <cmath>

#include "geometry/formula.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

// Distances from the axis below the first part of the conic's size are a pole's; up to the second they are unclear.
constexpr double kAtPole = 1e-14, kBesidePole = 1e-9;
// Parts of ellipses and of other conics, so that enclosures are narrow.
constexpr double kLongestPart = 0.25 * kPi;
constexpr int kFewestParts = 4;

double size_of(const Conic& conic) { return glm::length(conic.origin) + glm::length(conic.x) + glm::length(conic.y); }

}  // namespace

ConicImage::ConicImage(CanonicalSurface surface, const Conic& conic, const Interval& t)
    : surface_(std::move(surface)), conic_(surface_.local(conic)), domain_(t) {
  divide(surface_.has_poles() ? find_poles() : std::vector<double>());
}

std::vector<double> ConicImage::find_poles() {
  std::vector<double> near;
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
    for (double t : plane_roots(conic_, normal, 0)) {
      if (conic_.is_closed()) t += kTwoPi * std::ceil((domain_.lo - 1e-9 - t) / kTwoPi);
      if (t >= domain_.lo - 1e-9 && t <= domain_.hi + 1e-9) near.push_back(t);
      if (conic_.is_closed() && t + kTwoPi <= domain_.hi + 1e-9) near.push_back(t + kTwoPi);
    }
  const auto off_axis = [&](double t) {
    const Vec3 q = conic_.point(t);
    return std::hypot(q.x, q.y);
  };
  std::sort(near.begin(), near.end());
  std::vector<double> poles;
  for (const double t : near) {
    const double off = off_axis(t);
    if (off > kBesidePole * size_of(conic_)) continue;
    // Of the roots of both coordinates at one place the better one counts.
    if (!poles.empty() && t - poles.back() < 1e-6) {
      if (off < off_axis(poles.back())) poles.back() = t;
    } else {
      poles.push_back(t);
    }
  }
  for (double& t : poles) {
    if (off_axis(t) > kAtPole * size_of(conic_)) beside_pole_ = true;
    if (std::abs(t - domain_.lo) < 1e-9) t = domain_.lo;
    if (std::abs(t - domain_.hi) < 1e-9) t = domain_.hi;
  }
  return poles;
}

void ConicImage::divide(const std::vector<double>& poles) {
  std::vector<double> ends = poles;
  ends.push_back(domain_.lo);
  ends.push_back(domain_.hi);
  if (!surface_.is_affine())
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
      for (const double t : plane_roots(conic_, normal, 0))
        for (const double turn : {0.0, kTwoPi, -kTwoPi})
          if ((turn == 0 || conic_.is_closed()) && domain_.contains(t + turn)) ends.push_back(t + turn);
  const int parts = conic_.is_closed() ? static_cast<int>(std::ceil(domain_.width() / kLongestPart)) : kFewestParts;
  for (int k = 1; k < parts; ++k) ends.push_back(domain_.lo + k * domain_.width() / parts);
  std::sort(ends.begin(), ends.end());
  double from = domain_.lo;
  for (const double to : ends) {
    const bool is_pole = std::find(poles.begin(), poles.end(), to) != poles.end();
    if (!(to - from > (is_pole ? 0 : 1e-3 * domain_.width() / parts))) continue;
    // What is left before the end belongs to the part before.
    const bool last = to == domain_.hi || domain_.hi - to < 1e-3 * domain_.width() / parts;
    parts_.push_back(made({from, last && !is_pole ? domain_.hi : to}, poles));
    from = parts_.back().t.hi;
  }
}

ConicImage::Part ConicImage::made(const Interval& t, const std::vector<double>& poles) const {
  Part part;
  part.t = t;
  if (surface_.is_affine()) return part;
  for (const double pole : poles)
    if (pole == t.lo || pole == t.hi) part.pole = pole;
  part.side = surface_.side(conic_.point(t.middle()).z);
  double factor = 1;
  const Triple<double> q = seen(part, t.middle(), factor);
  const Rectangle domain = surface_.surface->domain();
  // u and v go on from the part before; after a pole, and at the begin, they are the domain's.
  const auto near = [](double angle, double before) { return angle + kTwoPi * std::round((before - angle) / kTwoPi); };
  const bool starts = parts_.empty() || (part.pole && *part.pole == t.lo);
  const double u = std::atan2(q.y, q.x), length = std::hypot(q.x, q.y);
  part.direction = {q.x / length, q.y / length};
  part.u = starts ? angle_within(domain.u, u).value_or(u) : near(u, parts_.back().u);
  if (surface_.kind == CanonicalSurface::Kind::torus) {
    const double rho = factor * length - surface_.major, v = std::atan2(q.z, rho);
    part.on_meridian = Vec2(rho, q.z) / std::hypot(rho, q.z);
    part.v = starts ? angle_within(domain.v, v).value_or(v) : near(v, parts_.back().v);
  }
  return part;
}

template <class T>
Triple<T> ConicImage::seen(const Part& part, const T& t, T& factor) const {
  using std::cos;
  using std::cosh;
  using std::sin;
  using std::sinh;
  const Triple<T> q = conic_.at(t);
  if (!part.pole) return {part.side * q.x, part.side * q.y, q.z};
  const double p = *part.pole, sign = part.t.hi > p ? 1 : -1;
  const T m = 0.5 * (t + p), h = 0.5 * (t - p);
  T f(0.0), g(1.0);
  switch (conic_.kind) {
    case Conic::Kind::ellipse:
      f = -sin(m), g = cos(m), factor = 2.0 * sign * sin(h);
      break;
    case Conic::Kind::hyperbola:
      f = sinh(m), g = cosh(m), factor = 2.0 * sign * sinh(h);
      break;
    case Conic::Kind::parabola:
      f = 2.0 * m, factor = 2.0 * sign * h;
      break;
    case Conic::Kind::line:
      factor = 2.0 * sign * h;
      break;
  }
  const double turn = sign * part.side;
  return {turn * (f * conic_.x.x + g * conic_.y.x), turn * (f * conic_.x.y + g * conic_.y.y), q.z};
}

template <class T>
Triple<T> ConicImage::place(const Part& part, const T& t) const {
  using std::atan2;
  using std::hypot;
  if (surface_.is_affine()) {
    const Triple<T> q = conic_.at(t);
    return {q.x, q.y, T(0.0)};
  }
  T factor(1.0);
  const Triple<T> q = seen(part, t, factor);
  const T along = part.direction.x * q.x + part.direction.y * q.y,
          across = part.direction.x * q.y - part.direction.y * q.x;
  const T u = part.u + atan2(across, along);
  T rho = hypot(along, across);
  if (part.pole) rho = factor * rho;
  if (surface_.kind != CanonicalSurface::Kind::torus) return {u, surface_.parameter(part.side * rho, q.z), T(0.0)};
  const T out = rho - surface_.major;
  const Vec2& e = part.on_meridian;
  return {u, part.v + atan2(e.x * q.z - e.y * out, e.x * out + e.y * q.z), T(0.0)};
}

CurveJet ConicImage::evaluate(double t, int order) const {
  const auto after =
      std::upper_bound(parts_.begin(), parts_.end(), t, [](double at, const Part& part) { return at < part.t.lo; });
  const Part& part = after == parts_.begin() ? parts_.front() : *(after - 1);
  return evaluate_curve_formula([&](const auto& x) { return place(part, x); }, t, order);
}

CurveEnclosure ConicImage::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  for (const Part& part : parts_) {
    const Interval common = intersect(part.t, t);
    // At a common end of two parts the one before counts, as derivatives from the left do.
    if (common.empty() || (common.width() == 0 && t.width() > 0)) continue;
    const CurveEnclosure one = enclose_curve_formula([&](const auto& x) { return place(part, x); }, common, order);
    for (int k = 0; k <= order; ++k) result.d[k].include(one.d[k]);
  }
  return result;
}

std::vector<CurvePiece> ConicImage::pieces() const {
  std::vector<CurvePiece> result;
  for (const Part& part : parts_) {
    CurvePiece piece;
    piece.domain = part.t;
    piece.map = {ParameterMap::Kind::affine, part.t.lo, part.t.hi};
    result.push_back(piece);
  }
  return result;
}

}  // namespace lekalo::geometry
