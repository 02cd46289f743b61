#include "geometry/composition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

std::vector<double> breaks_of(const Curve& curve) {
  std::vector<double> breaks{curve.domain().lo};
  for (const CurvePiece& piece : curve.pieces()) breaks.push_back(piece.domain.hi);
  return breaks;
}

// Neighbours nearer than this part of all are one.
constexpr double kSameBreak = 1e-14;

void join(std::vector<double>& breaks, const std::vector<double>& others) {
  const Interval all(breaks.front(), breaks.back());
  for (const double t : others)
    if (all.lo < t && t < all.hi) breaks.push_back(t);
  std::sort(breaks.begin(), breaks.end());
  const auto same = [&](double a, double b) { return b - a <= kSameBreak * all.width(); };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
  breaks.back() = all.hi;
}

}  // namespace

CurveProperties properties_of(const Curve& operand, int derivatives) {
  return {operand.domain(), operand.period(), breaks_of(operand), operand.max_order() - derivatives,
          operand.enclosure_order() - derivatives};
}

void add_operand(CurveProperties& properties, const Curve& operand, int derivatives) {
  join(properties.breaks, breaks_of(operand));
  properties.max_order = std::min(properties.max_order, operand.max_order() - derivatives);
  properties.enclosure_order = std::min(properties.enclosure_order, operand.enclosure_order() - derivatives);
}

void cut_to(CurveProperties& properties, const Interval& domain) {
  std::vector<double> breaks{domain.lo};
  const double room = kSameBreak * domain.width();
  for (const double t : properties.breaks)
    if (domain.lo + room < t && t < domain.hi - room) breaks.push_back(t);
  breaks.push_back(domain.hi);
  properties.domain = domain;
  properties.breaks = std::move(breaks);
}

SurfaceProperties properties_of(const Surface& operand, int derivatives) {
  SurfaceProperties properties;
  properties.domain = operand.domain();
  properties.periods = operand.periods();
  properties.breaks_u = {properties.domain.u.lo, properties.domain.u.hi};
  properties.breaks_v = {properties.domain.v.lo, properties.domain.v.hi};
  std::vector<double> lines_u, lines_v;
  for (const SurfacePiece& piece : operand.pieces()) {
    lines_u.push_back(piece.domain.u.lo);
    lines_v.push_back(piece.domain.v.lo);
  }
  join(properties.breaks_u, lines_u);
  join(properties.breaks_v, lines_v);
  properties.max_order = operand.max_order() - derivatives;
  properties.enclosure_order = operand.enclosure_order() - derivatives;
  return properties;
}

SurfaceProperties properties_along_u(const Curve& operand, const Interval& v, int derivatives) {
  SurfaceProperties properties;
  properties.domain = {operand.domain(), v};
  properties.periods.u = operand.period();
  properties.breaks_u = breaks_of(operand);
  properties.breaks_v = {v.lo, v.hi};
  properties.max_order = std::min(kMaxSurfaceOrder, operand.max_order() - derivatives);
  properties.enclosure_order = operand.enclosure_order() - derivatives;
  return properties;
}

void add_operand(SurfaceProperties& properties, const Curve& operand, Along along, int derivatives) {
  join(along == Along::u ? properties.breaks_u : properties.breaks_v, breaks_of(operand));
  properties.max_order = std::min(properties.max_order, operand.max_order() - derivatives);
  properties.enclosure_order = std::min(properties.enclosure_order, operand.enclosure_order() - derivatives);
}

std::optional<NurbsSurfaceForm> form_of_pieces(const std::vector<SurfacePiece>& pieces,
                                               const std::vector<double>& lines_u, const std::vector<double>& lines_v) {
  const size_t m = lines_u.size() - 1, n = lines_v.size() - 1;
  if (pieces.size() != m * n || pieces.empty() || !pieces.front().is_rational()) return std::nullopt;
  const int p = pieces.front().degree_u, q = pieces.front().degree_v;
  NurbsSurfaceForm form;
  form.degree_u = p, form.degree_v = q;
  const auto knots = [](int degree, const std::vector<double>& lines) {
    std::vector<double> result(1, lines.front());
    for (const double x : lines) result.insert(result.end(), degree, x);
    result.push_back(lines.back());
    return result;
  };
  form.knots_u = knots(p, lines_u), form.knots_v = knots(q, lines_v);
  form.points.assign((m * p + 1) * (n * q + 1), Vec4(0));
  for (size_t i = 0; i < m; ++i)
    for (size_t j = 0; j < n; ++j) {
      const SurfacePiece& piece = pieces[i * n + j];
      if (piece.degree_u != p || piece.degree_v != q) return std::nullopt;
      for (int k = 0; k <= p; ++k)
        for (int l = 0; l <= q; ++l) {
          Vec4& point = form.points[(i * p + k) * (n * q + 1) + j * q + l];
          const Vec4& own = piece.points[k * (q + 1) + l];
          if (point.w != 0 && std::abs(point.w - own.w) > 1e-14 * std::abs(own.w)) return std::nullopt;
          point = own;
        }
      if (j == 0) form.maps_u.push_back(piece.map_u);
      if (i == 0) form.maps_v.push_back(piece.map_v);
    }
  const auto drop_affine = [](std::vector<ParameterMap>& maps) {
    if (std::all_of(maps.begin(), maps.end(),
                    [](const ParameterMap& map) { return map.kind == ParameterMap::Kind::affine; }))
      maps.clear();
  };
  drop_affine(form.maps_u), drop_affine(form.maps_v);
  return form;
}

SampledShape sampled_shape(const Surface& surface, const Rectangle& domain) {
  constexpr int kTried = 16;
  Box3 box;
  const auto at = [](const Interval& range, int i) { return range.lo + range.width() * i / kTried; };
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const double u = at(domain.u, i), v = at(domain.v, j);
      const Vec3 p = surface.point(u, v);
      if (!std::isfinite(p.x + p.y + p.z))
        throw FieldError("of", fmt::format("the surface has no point at u = {:.6g}, v = {:.6g}", u, v),
                         "take a part without that place");
      box.include(p);
    }
  const auto is_point = [&](const Interval& range, auto edge) {
    const Vec3 first = edge(range.lo);
    for (int i = 1; i <= kTried; ++i)
      if (glm::length(edge(at(range, i)) - first) > kCollapsedEdge * box.diameter()) return false;
    return true;
  };
  const auto at_u = [&](double u) { return [&surface, u](double v) { return surface.point(u, v); }; };
  const auto at_v = [&](double v) { return [&surface, v](double u) { return surface.point(u, v); }; };
  return {{is_point(domain.v, at_u(domain.u.lo)), is_point(domain.v, at_u(domain.u.hi)),
           is_point(domain.u, at_v(domain.v.lo)), is_point(domain.u, at_v(domain.v.hi))},
          box.diameter()};
}

bool is_closed_along(const Surface& surface, Along along) {
  const Rectangle domain = surface.domain();
  const double bound = bounds(surface).diameter();
  const double near = 1e-9 * (bound < kInfinity ? bound : sampled_shape(surface, domain).size);
  const Interval &run = along == Along::u ? domain.u : domain.v, &other = along == Along::u ? domain.v : domain.u;
  const auto at = [&](double t, double x) {
    return along == Along::u ? surface.evaluate(t, x, 1) : surface.evaluate(x, t, 1);
  };
  constexpr int kTried = 12;
  for (int i = 0; i <= kTried; ++i) {
    const double x = other.lo + other.width() * i / kTried;
    const SurfaceJet a = at(run.lo, x), b = at(next_down(run.hi), x);
    const Vec3 turn = run.width() * (along == Along::u ? a.du() - b.du() : a.dv() - b.dv());
    if (glm::length(a.point() - b.point()) > near || glm::length(turn) > 1e3 * near) return false;
  }
  return true;
}

double sampled_size(const Curve& curve, const Interval& domain) {
  constexpr int kTried = 64;
  Box3 box;
  for (int i = 0; i <= kTried; ++i) {
    const double t = domain.lo + domain.width() * i / kTried;
    const Vec3 p = curve.point(t);
    if (!std::isfinite(p.x + p.y + p.z))
      throw FieldError("of", fmt::format("the curve has no point at t = {:.6g}", t), "take a part without that place");
    box.include(p);
  }
  return box.diameter();
}

namespace detail {

std::vector<Interval> between(const std::vector<double>& breaks, const Interval& t) {
  std::vector<Interval> parts;
  double from = t.lo;
  for (auto next = std::upper_bound(breaks.begin(), breaks.end(), t.lo); next != breaks.end() && *next < t.hi; ++next) {
    parts.push_back({from, *next});
    from = *next;
  }
  parts.push_back({from, t.hi});
  return parts;
}

CurvePiece plain_curve_piece(const Interval& domain) {
  return {domain, {ParameterMap::Kind::affine, domain.lo, domain.hi}, {}};
}

std::vector<SurfacePiece> plain_pieces(const std::vector<double>& breaks_u, const std::vector<double>& breaks_v) {
  std::vector<SurfacePiece> pieces;
  for (size_t i = 0; i + 1 < breaks_u.size(); ++i)
    for (size_t j = 0; j + 1 < breaks_v.size(); ++j)
      pieces.push_back(plain_piece({{breaks_u[i], breaks_u[i + 1]}, {breaks_v[j], breaks_v[j + 1]}}));
  return pieces;
}

}  // namespace detail

}  // namespace lekalo::geometry
