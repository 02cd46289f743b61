// Enclosures by the chain rule:
//
//   r' = S_u u' + S_v v',  r'' = S_uu u'^2 + 2 S_uv u' v' + S_vv v'^2 + S_u u'' + S_v v''.
#include "geometry/curves/operations/surface_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/composition.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/describe.h"
#include "geometry/numerics/root_search.h"
#include "geometry/point_formulas.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// A range beyond the domain in parts that lie in it, moved by whole periods.
std::vector<Interval> parts_within(const Interval& range, const Interval& domain, double period) {
  if (period == 0) return {{domain.clamp(range.lo), domain.clamp(range.hi)}};
  if (domain.contains(range)) return {range};
  if (range.width() >= period) return {domain};
  const double turns = std::floor((range.lo - domain.lo) / period);
  const double lo = std::clamp(next_down(range.lo - turns * period), domain.lo, domain.hi);
  const double hi = next_up(range.hi - turns * period);
  if (hi <= domain.hi) return {{lo, hi}};
  return {{lo, domain.hi}, {domain.lo, std::min(next_up(hi - period), domain.hi)}};
}

// An image that ends on the border of the domain is beyond it by rounding, where the surface may go on in another way.
void move_inside(double& x, const Interval& range) {
  const double inside = range.clamp(x);
  if (std::abs(x - inside) <= kDomainSlack * range.width()) x = inside;
}
template <int N>
void move_inside(Jet<double, N>& x, const Interval& range) {
  move_inside(x.c[0], range);
}

// u(t) = at or v(t) = at.
struct Passage {
  const Curve& image;
  int axis;
  double at;
  SystemValue<Interval, 1, 1> enclose(const ParameterBox<1>& box) const {
    const CurveEnclosure c = image.enclose(box[0], 1);
    return {{along(c.d[0], axis) - Interval(at)}, {{{along(c.d[1], axis)}}}};
  }
  SystemValue<double, 1, 1> evaluate(const ParameterPoint<1>& t) const {
    const CurveJet c = image.evaluate(t[0], 1);
    return {{c.d[0][axis] - at}, {{{c.d[1][axis]}}}};
  }
};

// Derivatives beside a place are told apart beyond this part of their size, at this part of the domain from it.
constexpr double kJump = 1e-6, kBeside = 1e-9;

}  // namespace

Periods closed_periods(const Surface& surface) {
  const Rectangle domain = surface.domain();
  const Periods periods = surface.periods();
  const auto closed = [](double period, const Interval& range) {
    return std::abs(period - range.width()) <= kDomainSlack * period ? period : 0.0;
  };
  return {closed(periods.u, domain.u), closed(periods.v, domain.v)};
}

SurfaceCurve::SurfaceCurve(SurfacePtr surface, Curve2Ptr image, double error)
    : surface_(std::move(surface)), image_(std::move(image)), error_(error), period_(image_->period()) {
  const Interval range = image_->domain();
  const Periods periods = closed_periods(*surface_);
  if (period_ > 0 || (periods.u == 0 && periods.v == 0) || !(range.width() < kInfinity)) return;
  const Vec3 apart = image_->point(range.hi) - image_->point(range.lo);
  const auto turns = [](double way, double period) {
    if (period == 0) return way == 0 ? 0.0 : 0.5;
    const double count = way / period;
    return std::abs(count - std::round(count)) <= kClosedCurve ? std::round(count) : 0.5;
  };
  const double u = turns(apart.x, periods.u), v = turns(apart.y, periods.v);
  if (u != 0.5 && v != 0.5 && (u != 0 || v != 0)) period_ = range.width();
}

CurveJet SurfaceCurve::evaluate(double t, int order) const {
  if (period_ > 0 && image_->period() == 0) t = wrapped(t, domain());
  if (order > kMaxSurfaceOrder) throw std::invalid_argument("a curve on a surface has derivatives up to order 4");
  const Rectangle range = surface_->domain();
  const auto at = [&](const auto& parameter) {
    auto uv = curve_at(*image_, parameter);
    move_inside(uv.x, range.u), move_inside(uv.y, range.v);
    return surface_at(*surface_, uv.x, uv.y);
  };
  return evaluate_curve_formula(at, t, order);
}

SurfaceEnclosure enclose_unwrapped(const Surface& surface, const Rectangle& place, int order) {
  const Rectangle domain = surface.domain();
  const Periods periods = closed_periods(surface);
  SurfaceEnclosure result;
  for (const Interval& u : parts_within(place.u, domain.u, periods.u))
    for (const Interval& v : parts_within(place.v, domain.v, periods.v)) {
      const SurfaceEnclosure part = surface.enclose({u, v}, order);
      for (int i = 0; i < (order + 1) * (order + 2) / 2; ++i) result.values[i].include(part.values[i]);
    }
  return result;
}

CurveEnclosure SurfaceCurve::enclose(const Interval& t, int order) const {
  const CurveEnclosure c = image_->enclose(t, order);
  const SurfaceEnclosure s = enclose_unwrapped(*surface_, {along(c.d[0], 0), along(c.d[0], 1)}, order);
  CurveEnclosure result;
  result.d[0] = s.d(0, 0);
  const auto set = [](Box3& box, int k, const Interval& x) {
    box.lo[k] = x.lo;
    box.hi[k] = x.hi;
  };
  for (int k = 0; k < 3 && order >= 1; ++k) {
    const Interval u1 = along(c.d[1], 0), v1 = along(c.d[1], 1), s_u = along(s.d(1, 0), k), s_v = along(s.d(0, 1), k);
    set(result.d[1], k, s_u * u1 + s_v * v1);
    if (order < 2) continue;
    const Interval u2 = along(c.d[2], 0), v2 = along(c.d[2], 1);
    set(result.d[2], k,
        along(s.d(2, 0), k) * sqr(u1) + Interval(2) * along(s.d(1, 1), k) * (u1 * v1) + along(s.d(0, 2), k) * sqr(v1) +
            s_u * u2 + s_v * v2);
  }
  return result;
}

bool SurfaceCurve::jumps(double t) const {
  const double beside = kBeside * domain().width();
  const CurveJet before = evaluate(t - beside, 2), behind = evaluate(t + beside, 2);
  for (int k = 1; k <= 2; ++k)
    if (glm::length(before.d[k] - behind.d[k]) > kJump * (glm::length(before.d[1]) / (k == 1 ? 1 : domain().width()) +
                                                          glm::length(before.d[k]) + glm::length(behind.d[k])))
      return true;
  return false;
}

// Where the image passes over the lines of the surface on which its pieces meet and derivatives jump.
void SurfaceCurve::add_breaks(const Interval& piece, int axis, std::vector<double> lines,
                              std::vector<double>& ends) const {
  const Periods periods = closed_periods(*surface_);
  const double period = axis == 0 ? periods.u : periods.v;
  const Interval reach = along(image_->enclose(piece, 0).d[0], axis);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  if (period == 0) lines.erase(lines.begin());  // the border of the domain
  RootSearchOptions<1, 1> options;
  options.least[0] = 1e-12 * piece.width();
  options.slack[0] = kBorderSlack * piece.width();
  const double room = 1e-9 * piece.width();
  for (const double line : lines)
    for (double at = period > 0 ? line + period * std::ceil((reach.lo - line) / period) : line; at <= reach.hi;
         at += period) {
      if (at < reach.lo) break;
      for (const auto& t : search_roots<1, 1>(Passage{*image_, axis, at}, ParameterBox<1>{piece}, options).isolated)
        if (t[0] - piece.lo > room && piece.hi - t[0] > room && jumps(t[0])) ends.push_back(t[0]);
      if (period == 0) break;
    }
}

std::vector<CurvePiece> SurfaceCurve::pieces() const {
  std::vector<double> lines_u, lines_v;
  for (const SurfacePiece& piece : surface_->pieces()) {
    lines_u.push_back(piece.domain.u.lo);
    lines_v.push_back(piece.domain.v.lo);
  }
  std::vector<CurvePiece> result;
  for (const CurvePiece& piece : image_->pieces()) {
    std::vector<double> ends{piece.domain.lo, piece.domain.hi};
    if (!lines_u.empty()) {
      add_breaks(piece.domain, 0, lines_u, ends);
      add_breaks(piece.domain, 1, lines_v, ends);
    }
    std::sort(ends.begin(), ends.end());
    for (size_t i = 0; i + 1 < ends.size(); ++i)
      if (ends[i] < ends[i + 1])
        result.push_back({{ends[i], ends[i + 1]}, {ParameterMap::Kind::affine, ends[i], ends[i + 1]}, {}});
  }
  return result;
}

namespace {

// The image must be plane and lie where the surface is.
void check_image(const Surface& surface, const Curve& image) {
  const Interval range = image.domain();
  if (!(range.width() < kInfinity)) throw FieldError("image", "the image is unbounded");
  const Box3 box = bounds(image);
  if (!(std::max(std::abs(box.lo.z), std::abs(box.hi.z)) <= 1e-12 * box.diameter()))
    throw FieldError("image", "the image does not lie in the parameter plane", "its points are (u, v), without z");
  const Rectangle domain = surface.domain();
  const Periods periods = closed_periods(surface);
  constexpr int kPlaces = 200;  // of a piece that may leave the domain
  for (int axis = 0; axis < 2; ++axis) {
    const Interval& allowed = axis == 0 ? domain.u : domain.v;
    const double room = kDomainSlack * (allowed.width() < kInfinity ? allowed.width() : 0);
    const Interval roomy{allowed.lo - room, allowed.hi + room};
    if ((axis == 0 ? periods.u : periods.v) > 0 || roomy.contains(along(box, axis))) continue;
    for (const CurvePiece& piece : image.pieces())
      for (int i = 0; i <= kPlaces; ++i) {
        const double t = piece.domain.lo + piece.domain.width() * i / kPlaces;
        const double at = image.point(t)[axis];
        if (!roomy.contains(at))
          throw FieldError("image", fmt::format("the image leaves the surface at t = {:.6g}: {} = {:.6g} is outside of "
                                                "[{:.6g}, {:.6g}]",
                                                t, axis == 0 ? "u" : "v", at, allowed.lo, allowed.hi));
      }
  }
}

}  // namespace

TypeDeclaration surface_curve_type() {
  return declare(
             Category::curve, "surface_curve",
             "Curve on a surface whose points (u, v) are those of a plane curve. On a closed surface the plane curve "
             "may go on beyond the domain.")
      .example("of: { type: sphere_surface, radius: 2 }, image: { type: circle, center: [3, 0], radius: 0.5 }")
      .field("of", reference({Category::surface}), "the surface")
      .field("image", reference({Category::curve}), "the curve in the parameter plane: its x is u, its y is v")
      .built_by([](const Fields& f) {
        check_image(*f.surface("of"), *f.curve("image"));
        return SurfaceCurve(f.surface("of"), f.curve("image"));
      });
}

}  // namespace lekalo::geometry
