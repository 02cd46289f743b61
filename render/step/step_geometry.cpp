#include "render/step/step_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/composition.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/nurbs_of.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"
#include "geometry/external/external_surface.h"
#include "geometry/queries/contours/analytic/elementary_surface.h"
#include "geometry/queries/quadrics/conic_of_curve.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::render {

namespace {

using namespace geometry;

// Semi-axes that differ by less, of their length, are a circle's.
constexpr double kRound = 1e-13;

struct DistinctKnots {
  std::vector<std::string> values;
  std::vector<std::string> times;
};

DistinctKnots distinct(const std::vector<double>& knots) {
  DistinctKnots result;
  for (size_t i = 0; i < knots.size();) {
    size_t end = i;
    while (end < knots.size() && knots[end] == knots[i]) ++end;
    result.values.push_back(step_real(knots[i]));
    result.times.push_back(fmt::format("{}", end - i));
    i = end;
  }
  return result;
}

// First and last knots as often as the degree needs, so that the ends are on the border.
bool is_clamped(const std::vector<double>& knots, int degree) {
  return knots[0] == knots[degree] && knots.end()[-1] == knots.end()[-1 - degree];
}

bool is_polynomial(const std::vector<Vec4>& points) {
  return std::all_of(points.begin(), points.end(), [&](const Vec4& p) { return p.w == points[0].w; });
}

bool is_finite(const std::vector<Vec4>& points) {
  return std::all_of(points.begin(), points.end(), [](const Vec4& p) { return p.w > 0; });
}

// Asks a surface as code outside would be asked: what a spline is fitted to.
class SurfaceFunction final : public ExternalFunction {
 public:
  explicit SurfaceFunction(SurfacePtr surface) : surface_(std::move(surface)) {}
  void evaluate(std::span<const double> places, int order, std::span<double> values) const override {
    size_t at = 0;
    for (size_t i = 0; i + 1 < places.size(); i += 2) {
      const SurfaceJet jet = surface_->evaluate(places[i], places[i + 1], order);
      for (int total = 0; total <= order; ++total)
        for (int v = 0; v <= total; ++v) {
          const Vec3& d = jet.d(total - v, v);
          values[at++] = d.x, values[at++] = d.y, values[at++] = d.z;
        }
    }
  }

 private:
  SurfacePtr surface_;
};

std::vector<double> lines_of(const std::vector<SurfacePiece>& pieces, Interval Rectangle::*along) {
  std::vector<double> lines;
  for (const SurfacePiece& piece : pieces)
    lines.insert(lines.end(), {(piece.domain.*along).lo, (piece.domain.*along).hi});
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

std::optional<NurbsSurfaceForm> exact_form(const Surface& surface) {
  const auto form = surface.as_nurbs();
  if (form && is_finite(form->points) && is_clamped(form->knots_u, form->degree_u) &&
      is_clamped(form->knots_v, form->degree_v))
    return form;
  std::vector<SurfacePiece> pieces = surface.pieces();
  if (!std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& p) { return p.is_rational(); }))
    return std::nullopt;
  std::sort(pieces.begin(), pieces.end(), [](const SurfacePiece& a, const SurfacePiece& b) {
    return std::pair(a.domain.u.lo, a.domain.v.lo) < std::pair(b.domain.u.lo, b.domain.v.lo);
  });
  const std::vector<double> lines_u = lines_of(pieces, &Rectangle::u), lines_v = lines_of(pieces, &Rectangle::v);
  if (pieces.size() != (lines_u.size() - 1) * (lines_v.size() - 1)) return std::nullopt;
  auto joined = form_of_pieces(pieces, lines_u, lines_v);
  return joined && is_finite(joined->points) ? joined : std::nullopt;
}

// The ellipse that a curve runs along: as it was given, else from its rational form.
std::optional<CanonicalConic> ellipse_of(const Curve& curve, const NurbsOfCurve& as_spline) {
  if (const auto* ellipse = dynamic_cast<const Ellipse*>(&curve))
    return CanonicalConic{CanonicalConic::Kind::ellipse, ellipse->frame(), ellipse->semi_axis_x(),
                          ellipse->semi_axis_y()};
  if (!as_spline.exact || as_spline.form.degree != 2) return std::nullopt;
  const auto conic = conic_of(NurbsCurve(as_spline.form));
  return conic && conic->kind == CanonicalConic::Kind::ellipse ? conic : std::nullopt;
}

bool keeps_angles(const Mat3& map) {
  const Mat3 square = glm::transpose(map) * map;
  for (int k = 0; k < 3; ++k)
    if (!(glm::length(square[k] - square[0][0] * Mat3(1.0)[k]) <= kRound * square[0][0])) return false;
  return true;
}

// Of a surface that turns about an axis, or a plane: in the world's lengths.
struct Elementary {
  Vec3 origin, x, y, z;
  double scale;  // a length of the world in one of its own
  Vec3 at(double along_z) const { return origin + along_z / scale * z; }
};

}  // namespace

std::string StepGeometry::spline(const NurbsCurveForm& form) {
  std::vector<std::string> points, weights;
  for (const Vec4& p : form.points) {
    points.push_back(writer_.point(Vec3(p) / p.w));
    weights.push_back(step_real(p.w));
  }
  const DistinctKnots knots = distinct(form.knots);
  const std::string net = fmt::format("{},{},.UNSPECIFIED.,.F.,.F.", form.degree, step_list(points));
  const std::string axis = fmt::format("{},{},.UNSPECIFIED.", step_list(knots.times), step_list(knots.values));
  if (is_polynomial(form.points)) return writer_.add(fmt::format("B_SPLINE_CURVE_WITH_KNOTS('',{},{})", net, axis));
  return writer_.add(
      fmt::format("(BOUNDED_CURVE()B_SPLINE_CURVE({})B_SPLINE_CURVE_WITH_KNOTS({})CURVE()"
                  "GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE({})REPRESENTATION_ITEM(''))",
                  net, axis, step_list(weights)));
}

std::string StepGeometry::spline(const NurbsSurfaceForm& form) {
  std::vector<std::string> points, weights;
  for (int i = 0; i < form.count_u(); ++i) {
    std::vector<std::string> row, row_weights;
    for (int j = 0; j < form.count_v(); ++j) {
      const Vec4& p = form.points[static_cast<size_t>(i) * form.count_v() + j];
      row.push_back(writer_.point(Vec3(p) / p.w));
      row_weights.push_back(step_real(p.w));
    }
    points.push_back(step_list(row));
    weights.push_back(step_list(row_weights));
  }
  const DistinctKnots u = distinct(form.knots_u), v = distinct(form.knots_v);
  const std::string net =
      fmt::format("{},{},{},.UNSPECIFIED.,.F.,.F.,.F.", form.degree_u, form.degree_v, step_list(points));
  const std::string axes = fmt::format("{},{},{},{},.UNSPECIFIED.", step_list(u.times), step_list(v.times),
                                       step_list(u.values), step_list(v.values));
  if (is_polynomial(form.points)) return writer_.add(fmt::format("B_SPLINE_SURFACE_WITH_KNOTS('',{},{})", net, axes));
  return writer_.add(
      fmt::format("(BOUNDED_SURFACE()B_SPLINE_SURFACE({})B_SPLINE_SURFACE_WITH_KNOTS({})"
                  "GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({})REPRESENTATION_ITEM('')SURFACE())",
                  net, axes, step_list(weights)));
}

std::string StepGeometry::curve(const Curve& curve) {
  const Interval domain = curve.domain();
  const NurbsOfCurve found = nurbs_of(curve, domain, tolerance_ * bounds(curve).diameter());
  if (!found.exact) fitted_(found.deviation);
  const CurveJet begin = curve.evaluate(domain.lo, 1);
  if (found.exact && found.form.degree == 1 && found.form.points.size() == 2) {
    const Vec3 way = curve.point(domain.hi) - begin.point();
    const std::string from = writer_.point(begin.point()), along = writer_.direction(glm::normalize(way));
    return writer_.add(fmt::format(
        "LINE('',{},{})", from, writer_.shared(fmt::format("VECTOR('',{},{})", along, step_real(glm::length(way))))));
  }
  if (const auto conic = ellipse_of(curve, found)) {
    const Frame& frame = conic->frame;
    const Vec3 from_center = begin.point() - frame.origin;
    const Vec3 axis = glm::dot(glm::cross(from_center, begin.derivative(1)), frame.z) > 0 ? frame.z : -frame.z;
    if (std::abs(conic->a - conic->b) <= kRound * conic->a)
      return writer_.add(fmt::format(
          "CIRCLE('',{},{})", writer_.placement(frame.origin, axis, glm::normalize(from_center)), step_real(conic->a)));
    const bool along_x = conic->a >= conic->b;
    return writer_.add(fmt::format("ELLIPSE('',{},{},{})",
                                   writer_.placement(frame.origin, axis, along_x ? frame.x : frame.y),
                                   step_real(std::max(conic->a, conic->b)), step_real(std::min(conic->a, conic->b))));
  }
  return spline(found.form);
}

std::optional<StepGeometry::SurfaceEntity> StepGeometry::elementary(const SurfacePtr& surface) {
  const auto found = elementary_surface(surface);
  if (!found) return std::nullopt;
  using Kind = CanonicalSurface::Kind;
  const auto middle = [](const Interval& range) { return range.width() < kInfinity ? range.middle() : 0.0; };
  const Rectangle own = surface->domain(), domain = found->surface->domain();
  const SurfaceJet there = surface->evaluate(middle(own.u), middle(own.v), 1);
  const Vec3 normal = glm::cross(there.du(), there.dv());
  const auto entity = [&](const std::string& text, const Vec3& own_normal) {
    return SurfaceEntity{writer_.add(text), glm::dot(normal, own_normal) > 0};
  };
  if (found->kind == Kind::plane) {
    const Vec3 z = glm::normalize(normal);
    return entity(fmt::format("PLANE('',{})", writer_.placement(found->origin, z, glm::normalize(there.du()))), z);
  }
  const auto scale = found->scale();
  if (!scale) return std::nullopt;
  const Mat3 rows = glm::transpose(found->to_local);
  const Elementary e{found->origin, rows[0] / *scale, rows[1] / *scale, rows[2] / *scale, *scale};
  // The seam is where the surface begins.
  const Vec3 x = std::cos(domain.u.lo) * e.x + std::sin(domain.u.lo) * e.y;
  const auto across = [&](const Vec3& p) { return p - e.origin - glm::dot(p - e.origin, e.z) * e.z; };
  const Vec3 from_axis = across(there.point());
  if (found->kind == Kind::ellipsoid)
    return entity(
        fmt::format("SPHERICAL_SURFACE('',{},{})", writer_.placement(e.origin, e.z, x), step_real(1 / *scale)),
        there.point() - e.origin);
  if (found->kind == Kind::torus) {
    // Rings that touch themselves are not the format's.
    if (!(found->major > found->minor)) return std::nullopt;
    const Vec3 tube = e.origin + found->major / *scale * glm::normalize(from_axis);
    return entity(fmt::format("TOROIDAL_SURFACE('',{},{},{})", writer_.placement(e.origin, e.z, x),
                              step_real(found->major / *scale), step_real(found->minor / *scale)),
                  there.point() - tube);
  }
  if (found->kind != Kind::cone) return std::nullopt;
  if (found->widening == 0)
    return entity(fmt::format("CYLINDRICAL_SURFACE('',{},{})", writer_.placement(e.origin, e.z, x),
                              step_real(found->radius / *scale)),
                  from_axis);
  // From the narrow end on; parts on both sides of the apex are not the format's.
  const double at_lo = found->radius + found->widening * domain.v.lo,
               at_hi = found->radius + found->widening * domain.v.hi;
  if (!(std::min(at_lo, at_hi) >= 0 && std::isfinite(at_lo) && std::isfinite(at_hi))) return std::nullopt;
  const bool widens = at_hi * found->height >= at_lo * found->height;
  const double narrow = at_lo < at_hi ? domain.v.lo : domain.v.hi;
  return entity(fmt::format("CONICAL_SURFACE('',{},{},{})",
                            writer_.placement(e.at(found->height * narrow), widens ? e.z : -e.z, x),
                            step_real(std::min(at_lo, at_hi) / *scale),
                            step_real(std::atan2(std::abs(found->widening), std::abs(found->height)))),
                from_axis);
}

std::optional<StepGeometry::SurfaceEntity> StepGeometry::extruded(const SurfacePtr& surface) {
  const auto [extrusion, map] = placed<ExtrusionSurface>(*surface);
  if (!extrusion) return std::nullopt;
  const Vec3 along = map.direction(extrusion->along());
  const std::string section = curve(*transformed(curve_over(extrusion->curve(), extrusion->domain().u), map)),
                    direction = writer_.direction(glm::normalize(along)),
                    vector = writer_.shared(fmt::format("VECTOR('',{},{})", direction, step_real(glm::length(along))));
  return SurfaceEntity{writer_.add(fmt::format("SURFACE_OF_LINEAR_EXTRUSION('',{},{})", section, vector)), true};
}

std::optional<StepGeometry::SurfaceEntity> StepGeometry::revolved(const SurfacePtr& surface) {
  const auto [revolution, map] = placed<RevolutionSurface>(*surface);
  if (!revolution || !keeps_angles(map.linear)) return std::nullopt;
  const Axis axis = revolution->axis();
  const Rectangle domain = revolution->domain();
  // The seam is where the surface begins.
  const Affine turn = Affine::rotation(domain.v.lo, axis.along, axis.through);
  const std::string section = curve(*transformed(curve_over(revolution->curve(), domain.u), map * turn));
  const std::string through = writer_.point(map.point(axis.through)),
                    along = writer_.direction(glm::normalize(map.direction(axis.along))),
                    line = writer_.shared(fmt::format("AXIS1_PLACEMENT('',{},{})", through, along));
  // The entity's u is the angle; a mirror image turns the other way.
  return SurfaceEntity{writer_.add(fmt::format("SURFACE_OF_REVOLUTION('',{},{})", section, line)),
                       map.determinant() < 0};
}

StepGeometry::SurfaceEntity StepGeometry::surface(const SurfacePtr& surface) {
  if (const auto found = elementary(surface)) return *found;
  if (!surface->bounded()) throw std::invalid_argument("it has no bounds; give it a domain");
  if (const auto found = extruded(surface)) return *found;
  if (const auto found = revolved(surface)) return *found;
  if (const auto form = exact_form(*surface)) return {spline(*form), true};
  const Rectangle domain = surface->domain();
  const bool closed_u = is_closed_along(*surface, Along::u), closed_v = is_closed_along(*surface, Along::v);
  try {
    const ExternalSurface fit(std::make_shared<SurfaceFunction>(surface), domain, {closed_u, closed_v}, 0, tolerance_);
    fitted_(fit.report().distance());
    return {spline(*fit.as_nurbs()), true};
  } catch (const FieldError& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace lekalo::render
