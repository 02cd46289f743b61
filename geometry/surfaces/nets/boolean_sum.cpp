#include "geometry/surfaces/nets/boolean_sum.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/nurbs_operations.h"

namespace lekalo::geometry {

namespace {

// The Bezier form of each curve over each part between breaks, of one degree for all: [part][curve].
struct Cells {
  int degree = 0;
  std::vector<std::vector<CurvePiece>> parts;
  bool is_rational = true;  // all have such a form
};

Cells cells_of(const std::vector<CurvePtr>& curves, const std::vector<double>& breaks) {
  Cells cells;
  cells.parts.resize(breaks.size() - 1);
  for (const CurvePtr& curve : curves) {
    const auto form = curve->as_nurbs();
    if (!form) return {0, {}, false};
    for (size_t k = 0; k + 1 < breaks.size(); ++k) {
      const auto pieces = bezier_pieces(*form, {breaks[k], breaks[k + 1]});
      if (pieces.size() != 1) return {0, {}, false};
      cells.parts[k].push_back(pieces.front());
      cells.degree = std::max(cells.degree, pieces.front().degree());
    }
  }
  return cells;
}

void elevate(Cells& cells, int degree) {
  for (auto& part : cells.parts)
    for (CurvePiece& piece : part) piece.points = elevated_bezier(std::move(piece.points), degree);
  cells.degree = degree;
}

bool is_near(double a, double b) { return std::abs(a - b) <= 1e-14 * std::max(std::abs(a), std::abs(b)); }

// A piece that is one point takes any denominator and any parameter.
bool is_one_point(const CurvePiece& piece) {
  const auto point = [](const Vec4& p) { return Vec3(p) / p.w; };
  return std::all_of(piece.points.begin(), piece.points.end(),
                     [&](const Vec4& p) { return point(p) == point(piece.points.front()); });
}

// Whether the members have one denominator, after a multiplication by constants, and one parameter.
bool share_denominator(std::vector<CurvePiece>& part) {
  for (CurvePiece& piece : part) {
    const double scale = 1 / piece.points.front().w;
    for (Vec4& p : piece.points) p *= scale;
  }
  const auto leading = std::find_if(part.begin(), part.end(), [](const CurvePiece& one) { return !is_one_point(one); });
  if (leading == part.end()) return true;
  const CurvePiece model = *leading;
  for (CurvePiece& piece : part) {
    const ParameterMap &a = piece.map, &b = model.map;
    if (is_one_point(piece)) {
      const Vec3 point = Vec3(piece.points.front());
      for (size_t i = 0; i < piece.points.size(); ++i)
        piece.points[i] = Vec4(model.points[i].w * point, model.points[i].w);
      piece.map = b;
    }
    if (a.kind != b.kind || !is_near(a.lo, b.lo) || !is_near(a.hi, b.hi) || a.from != b.from || a.to != b.to)
      return false;
    for (size_t i = 0; i < piece.points.size(); ++i)
      if (!is_near(piece.points[i].w, model.points[i].w)) return false;
  }
  return true;
}

bool is_polynomial(const std::vector<CurvePiece>& part) {
  return std::all_of(part.begin(), part.end(), [](const CurvePiece& piece) {
    return piece.map.kind == ParameterMap::Kind::affine &&
           std::all_of(piece.points.begin(), piece.points.end(), [](const Vec4& p) { return p.w == 1; });
  });
}

bool is_one(const std::vector<CurvePiece>& part) {
  return std::all_of(part.begin(), part.end(), [](const CurvePiece& piece) {
    return std::all_of(piece.points.begin(), piece.points.end(), [](const Vec4& p) { return p.x == 1 && p.w == 1; });
  });
}

}  // namespace

std::vector<SurfacePiece> BooleanSum::rational_pieces(const std::vector<double>& breaks_u,
                                                      const std::vector<double>& breaks_v) const {
  Cells c = cells_of(along_u.curves, breaks_u), b = cells_of(along_v.functions, breaks_u);
  Cells a = cells_of(along_u.functions, breaks_v), g = cells_of(along_v.curves, breaks_v);
  for (const Cells* cells : {&c, &b, &a, &g})
    if (!cells->is_rational) return {};
  const int p = std::max(c.degree, b.degree), q = std::max(a.degree, g.degree);
  if (p > kMaxDegree || q > kMaxDegree || along_u.curves.empty()) return {};
  for (Cells* cells : {&c, &b}) elevate(*cells, p);
  for (Cells* cells : {&a, &g}) elevate(*cells, q);
  // Of one family the denominator is the product of the curves' and the functions'. Of two it is the product of the
  // curves' where all functions are 1; else all are polynomials.
  const bool one_family = along_v.curves.empty();
  for (Cells* cells : {&c, &b, &a, &g})
    for (auto& part : cells->parts)
      if (!part.empty() && !share_denominator(part)) return {};
  std::vector<SurfacePiece> result;
  for (size_t m = 0; m + 1 < breaks_u.size(); ++m)
    for (size_t n = 0; n + 1 < breaks_v.size(); ++n) {
      const auto &c_m = c.parts[m], &b_m = b.parts[m], &a_n = a.parts[n], &g_n = g.parts[n];
      const bool ones = is_one(a_n) && is_one(b_m);
      if (!one_family && !ones)
        for (const auto* part : {&c_m, &b_m, &a_n, &g_n})
          if (!is_polynomial(*part)) return {};
      const CurvePiece &in_v = one_family ? a_n.front() : g_n.front(), &in_u = c_m.front();
      SurfacePiece piece = plain_piece({{breaks_u[m], breaks_u[m + 1]}, {breaks_v[n], breaks_v[n + 1]}});
      piece.degree_u = p, piece.degree_v = q;
      piece.map_u = in_u.map, piece.map_v = in_v.map;
      for (int k = 0; k <= p; ++k)
        for (int l = 0; l <= q; ++l) {
          const double w_u = in_u.points[k].w, w_v = in_v.points[l].w;
          const double of_c = one_family ? 1 : w_v;  // the functions of one family are homogeneous themselves
          Vec3 sum(0);
          for (size_t i = 0; i < c_m.size(); ++i) sum += a_n[i].points[l].x * of_c * Vec3(c_m[i].points[k]);
          for (size_t j = 0; j < g_n.size(); ++j) sum += b_m[j].points[k].x * w_u * Vec3(g_n[j].points[l]);
          for (size_t j = 0; j < points.size(); ++j)
            for (size_t i = 0; i < points[j].size(); ++i)
              sum -= b_m[j].points[k].x * a_n[i].points[l].x * w_u * of_c * points[j][i];
          piece.points.emplace_back(sum, w_u * w_v);
        }
      result.push_back(std::move(piece));
    }
  return result;
}

BlendedSurface blended_surface(BooleanSum sum, const Rectangle& domain, const Periods& periods) {
  SurfaceProperties properties;
  properties.domain = domain;
  properties.periods = periods;
  properties.breaks_u = {domain.u.lo, domain.u.hi};
  properties.breaks_v = {domain.v.lo, domain.v.hi};
  for (const CurvePtr& curve : sum.along_u.curves) add_operand(properties, *curve, Along::u);
  for (const CurvePtr& curve : sum.along_v.functions) add_operand(properties, *curve, Along::u);
  for (const CurvePtr& curve : sum.along_v.curves) add_operand(properties, *curve, Along::v);
  for (const CurvePtr& curve : sum.along_u.functions) add_operand(properties, *curve, Along::v);
  return BlendedSurface(std::move(sum), std::move(properties));
}

std::vector<Vec3> BooleanSum::points_over_grid(const std::vector<double>& u, const std::vector<double>& v) const {
  // Points of the curves: [place][curve].
  const auto known_at = [](const std::vector<CurvePtr>& curves, const std::vector<double>& places) {
    std::vector<std::vector<Triple<double>>> all(places.size());
    for (size_t k = 0; k < places.size(); ++k)
      for (const CurvePtr& curve : curves) all[k].push_back(curve_at(*curve, places[k]));
    return all;
  };
  const auto c = known_at(along_u.curves, u), b = known_at(along_v.functions, u);
  const auto a = known_at(along_u.functions, v), g = known_at(along_v.curves, v);
  std::vector<Vec3> found;
  found.reserve(u.size() * v.size());
  for (size_t k = 0; k < u.size(); ++k)
    for (size_t l = 0; l < v.size(); ++l) {
      Triple<double> point{0, 0, 0};
      for (size_t i = 0; i < c[k].size(); ++i) point += a[l][i].x * c[k][i];
      for (size_t j = 0; j < b[k].size(); ++j) point += b[k][j].x * g[l][j];
      for (size_t j = 0; j < points.size(); ++j)
        for (size_t i = 0; i < points[j].size(); ++i) point -= (b[k][j].x * a[l][i].x) * triple(points[j][i]);
      found.emplace_back(point.x, point.y, point.z);
    }
  return found;
}

}  // namespace lekalo::geometry
