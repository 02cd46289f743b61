#include "render/lines/surface_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/expression/expression.h"
#include "geometry/queries/contours/isophote.h"
#include "geometry/queries/contours/level_lines.h"
#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/queries/differential/tool_axis.h"
#include "geometry/queries/differential/umbilics.h"
#include "geometry/queries/surface_lines/surface_lines.h"
#include "render/integrators/quantities.h"
#include "render/model/color_scale.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Lines of a family keep this distance from each other, in parts of the steps of their beginnings.
constexpr double kApart = 0.45;
constexpr int kPlacesOfLine = 200;
// Below this part of the other a curvature is none.
constexpr double kFlat = 1e-9;
// How far hyperbolas of an indicatrix reach, in their semi-axes.
constexpr double kReach = 1.4;

std::vector<double> values_along(const Surface& surface, const Fields& f, IsoDirection held) {
  const Rectangle domain = surface.domain();
  const bool u = held == IsoDirection::u;
  return values_in(f.get<ParameterValues>(u ? "at_u" : "at_v"), u ? domain.u : domain.v, is_closed_in(surface, held));
}

// Where lines begin: inside, in the middles of the cells of a net of places.
std::vector<Vec2> beginnings(const Surface& surface, const Fields& f, Vec2& step) {
  const auto middles = [&](const char* name, const Interval& range, double& width) {
    const ParameterValues& asked = f.get<ParameterValues>(name);
    std::vector<double> values = asked.values;
    for (int k = 0; k < asked.count; ++k) values.push_back(range.lo + range.width() * (k + 0.5) / asked.count);
    width = range.width() / static_cast<double>(std::max<size_t>(1, values.size()));
    return values;
  };
  std::vector<Vec2> places;
  const std::vector<double> u = middles("at_u", surface.domain().u, step.x),
                            v = middles("at_v", surface.domain().v, step.y);
  for (const double a : u)
    for (const double b : v) places.emplace_back(a, b);
  return places;
}

// Lines through the places, but for those that come too near to one before; there are none at singular places.
void add_family(SurfaceFigure& figure, const SurfacePtr& surface, const Fields& f,
                const std::function<SurfaceLine(const Vec2&)>& line_through) {
  Vec2 step;
  const std::vector<Vec2> places = beginnings(*surface, f, step);
  const Periods periods = closed_periods(*surface);
  const auto apart = [](double a, double b, double period) {
    const double d = a - b;
    return period > 0 ? d - period * std::round(d / period) : d;
  };
  std::vector<Vec2> taken;
  for (const Vec2& place : places) {
    const bool is_near = std::any_of(taken.begin(), taken.end(), [&](const Vec2& other) {
      return std::hypot(apart(place.x, other.x, periods.u) / step.x, apart(place.y, other.y, periods.v) / step.y) <
             kApart;
    });
    if (is_near) continue;
    SurfaceLine line;
    try {
      line = line_through(place);
    } catch (const FieldError& error) {
      if (error.field == "length") throw;
      continue;  // an umbilic, a place without asymptotic directions
    }
    const Interval domain = line.image->domain();
    for (int k = 0; k <= kPlacesOfLine; ++k)
      taken.emplace_back(line.image->point(domain.clamp(domain.lo + domain.width() * k / kPlacesOfLine)));
    figure.lines.push_back({std::make_shared<SurfaceCurve>(surface, line.image, line.error), line.image});
  }
}

std::optional<double> length_of(const Fields& f) {
  return f.has("length") ? std::optional(f.number("length")) : std::nullopt;
}

SurfaceFigure curvature_lines(const SurfacePtr& surface, const Fields& f) {
  SurfaceFigure figure;
  for (const auto& [name, family] :
       {std::pair("maximum", CurvatureFamily::maximum), std::pair("minimum", CurvatureFamily::minimum)})
    if (f.text("family") == "both" || f.text("family") == name)
      add_family(figure, surface, f,
                 [&, family = family](const Vec2& at) { return curvature_line(*surface, at, family, length_of(f)); });
  return figure;
}

SurfaceFigure asymptotic_lines(const SurfacePtr& surface, const Fields& f) {
  SurfaceFigure figure;
  for (const auto& [name, family] :
       {std::pair("first", AsymptoticFamily::first), std::pair("second", AsymptoticFamily::second)})
    if (f.text("family") == "both" || f.text("family") == name)
      add_family(figure, surface, f,
                 [&, family = family](const Vec2& at) { return asymptotic_line(*surface, at, family, length_of(f)); });
  return figure;
}

SurfaceFigure contour_lines(const SurfacePtr& surface, const Fields& f, const std::vector<double>& levels) {
  const Quantity quantity = quantity_of(f);
  const auto value = [&](double u, double v) { return value_on(quantity, *surface, u, v); };
  SurfaceFigure figure;
  for (const double level : levels)
    for (const LevelLine& line : level_lines(*surface, value, level)) {
      std::vector<Vec3> places;
      for (const Vec2& place : line.places) places.emplace_back(place, 0);
      const auto image = std::make_shared<NurbsCurve>(polyline(places, line.closed));
      figure.lines.push_back({std::make_shared<SurfaceCurve>(surface, image), image});
      if (!f.boolean("labels")) continue;
      const Vec2& middle = line.places[line.places.size() / 2];
      figure.texts.push_back({surface->point(middle.x, middle.y), fmt::format("{:g}", level)});
    }
  return figure;
}

SurfaceFigure isophotes(const SurfacePtr& surface, const Fields& f) {
  const ParameterValues& asked = f.get<ParameterValues>("angles");
  std::vector<double> angles;
  for (int k = 1; k <= asked.count; ++k) angles.push_back(180.0 * k / (asked.count + 1));
  for (const double angle : asked.values) angles.push_back(angle);
  SurfaceFigure figure;
  for (const double angle : angles) {
    const Contours found = isophote(surface, f.vec3("direction"), angle * kPi / 180);
    figure.complete = figure.complete && found.complete;
    for (const Contour& branch : found.branches) figure.lines.push_back({branch.curve, branch.images.front()});
  }
  return figure;
}

// Where lamps in a plane, side by side, are seen mirrored from an eye or along a direction.
SurfaceFigure reflections(const SurfacePtr& surface, const Fields& f) {
  const ViewOf view{f.has("eye"), f.vec3(f.has("eye") ? "eye" : "along")};
  const Axis lamp = f.axis("lamp");
  const Vec3 across = glm::cross(f.vec3("ceiling"), lamp.along);
  const int count = f.integer("count");
  SurfaceFigure figure;
  for (int k = 0; k < count; ++k) {
    const Vec3 off = (k - 0.5 * (count - 1)) * f.number("spacing") * glm::normalize(across);
    const Contours found = reflection_line(surface, view, {lamp.through + off, lamp.along});
    figure.complete = figure.complete && found.complete;
    for (const Contour& branch : found.branches) figure.lines.push_back({branch.curve, branch.images.front()});
  }
  return figure;
}

SurfaceFigure principal_directions(const SurfacePtr& surface, const Fields& f) {
  SurfaceFigure figure;
  const double half = 0.5 * f.number("length");
  for (const double u : values_along(*surface, f, IsoDirection::u))
    for (const double v : values_along(*surface, f, IsoDirection::v)) {
      const SurfaceCurvature c = curvature(*surface, u, v);
      const double size = std::max(std::abs(c.principal[0]), std::abs(c.principal[1]));
      if (!c.regular || !(c.principal[0] - c.principal[1] > 1e-7 * size)) continue;  // all directions are
      const Vec3 point = surface->point(u, v);
      for (const Vec3& way : c.directions)
        figure.lines.push_back({std::make_shared<Segment>(point - half * way, point + half * way), nullptr});
    }
  return figure;
}

// Needles along the normal, as long as a quantity times the scale; the tips of each row along u joined.
SurfaceFigure hedgehog(const SurfacePtr& surface, const Fields& f) {
  const Quantity quantity = quantity_of(f);
  const double scale = f.number("scale");
  SurfaceFigure figure;
  for (const double v : values_along(*surface, f, IsoDirection::v)) {
    std::vector<Vec3> tips;
    for (const double u : values_along(*surface, f, IsoDirection::u)) {
      const double value = value_on(quantity, *surface, u, v);
      if (!std::isfinite(value)) continue;
      const Vec3 foot = surface->point(u, v), tip = foot + scale * value * surface->normal(u, v);
      if (tip != foot) figure.lines.push_back({std::make_shared<Segment>(foot, tip), nullptr});
      if (tips.empty() || tips.back() != tip) tips.push_back(tip);
    }
    if (f.boolean("envelope") && tips.size() > 1)
      figure.lines.push_back({std::make_shared<NurbsCurve>(polyline(tips)), nullptr});
  }
  return figure;
}

// Arrows along the axes of a tool that runs along rows of places; none where a row has no tangent.
SurfaceFigure tool_axis_field(const SurfacePtr& surface, const Fields& f) {
  const Expression& tilt = f.get<Expression>("tilt");
  const bool along_u = f.text("rows") == "u";
  SurfaceFigure figure;
  for (const double u : values_along(*surface, f, IsoDirection::u))
    for (const double v : values_along(*surface, f, IsoDirection::v)) {
      const SurfaceJet jet = surface->evaluate(u, v, 1);
      const Vec3 tangent = along_u ? jet.du() : jet.dv(), other = along_u ? jet.dv() : jet.du();
      if (!(glm::length(tangent) > kFlat * glm::length(other))) continue;
      const std::array<double, 2> place{u, v};
      const Vec3 q = tool_axis(tangent, surface->normal(u, v), tilt.evaluate(std::span<const double>(place)));
      figure.lines.push_back(
          {std::make_shared<Segment>(jet.point(), jet.point() + f.number("length") * q), nullptr, true});
    }
  return figure;
}

SurfaceFigure umbilic_points(const SurfacePtr& surface, const Fields&) {
  SurfaceFigure figure;
  for (const Vec2& place : umbilics(*surface)) figure.points.push_back(surface->point(place.x, place.y));
  return figure;
}

// The tangent plane at the place of a helper: point, principal directions, normal.
struct PlaceOfFigure {
  Vec3 point, normal;
  SurfaceCurvature curvature;
};
void check_place(const Surface& surface, double u, double v) {
  const auto check = [&](const char* name, double x, const Interval& range) {
    if (!range.contains(x))
      throw FieldError(name, fmt::format("the surface has no {} = {:g}", name, x),
                       fmt::format("its domain is {:g} to {:g}", range.lo, range.hi));
  };
  check("u", u, surface.domain().u);
  check("v", v, surface.domain().v);
}
PlaceOfFigure place_of(const Surface& surface, const Fields& f) {
  const double u = f.number("u"), v = f.number("v");
  check_place(surface, u, v);
  PlaceOfFigure at{surface.point(u, v), surface.normal(u, v), curvature(surface, u, v)};
  if (!at.curvature.regular) throw FieldError("u", "the surface has no curvature at this place", "take one beside it");
  return at;
}
bool is_flat(const SurfaceCurvature& c, int k) {
  const double size = std::max(std::abs(c.principal[0]), std::abs(c.principal[1]));
  return !(std::abs(c.principal[k]) > kFlat * size);
}

// The circles of curvature of the principal normal sections, with radii 1/k and centres r + m/k.
SurfaceFigure principal_circles(const SurfacePtr& surface, const Fields& f) {
  const PlaceOfFigure at = place_of(*surface, f);
  SurfaceFigure figure;
  figure.points.push_back(at.point);
  for (const int k : {0, 1}) {
    if (is_flat(at.curvature, k)) continue;
    const double radius = 1 / at.curvature.principal[k];
    const Vec3 center = at.point + radius * at.normal, &along = at.curvature.directions[k];
    const Vec3 out = glm::normalize(at.point - center);
    figure.lines.push_back(
        {std::make_shared<Circle>(Frame{center, out, along, glm::cross(out, along)}, std::abs(radius)), nullptr});
    if (!f.boolean("center")) continue;
    figure.lines.push_back({std::make_shared<Segment>(center, at.point), nullptr});
    figure.points.push_back(center);
  }
  return figure;
}

CurvePtr hyperbola_branch(const PlaceOfFigure& at, const Vec3& x, const Vec3& y, double a, double b) {
  const double w = std::cosh(kReach);  // of the middle point: the tangents at +-t meet at a / cosh t
  const std::vector<Vec4> points{Vec4(at.point + a * std::cosh(kReach) * x - b * std::sinh(kReach) * y, 1),
                                 w * Vec4(at.point + a / w * x, 1),
                                 Vec4(at.point + a * std::cosh(kReach) * x + b * std::sinh(kReach) * y, 1)};
  return std::make_shared<NurbsCurve>(NurbsCurveForm{2, {0, 0, 0, 1, 1, 1}, points, {}});
}

// Dupin's indicatrix, k_1 x^2 + k_2 y^2 = +-1 in the tangent plane along the principal directions, `scale` times as
// large: an ellipse, two hyperbolas, or two parallel lines.
SurfaceFigure dupin_indicatrix(const SurfacePtr& surface, const Fields& f) {
  const PlaceOfFigure at = place_of(*surface, f);
  const SurfaceCurvature& c = at.curvature;
  const double scale = f.number("scale");
  SurfaceFigure figure;
  figure.points.push_back(at.point);
  const auto semi_axis = [&](int k) { return scale / std::sqrt(std::abs(c.principal[k])); };
  if (is_flat(c, 0) && is_flat(c, 1)) throw FieldError("u", "the surface is flat here: it has no indicatrix");
  for (const int k : {0, 1})
    if (is_flat(c, k)) {
      const double a = semi_axis(1 - k);
      for (const double side : {-a, a}) {
        const Vec3 middle = at.point + side * c.directions[1 - k];
        figure.lines.push_back(
            {std::make_shared<Segment>(middle - 2 * a * c.directions[k], middle + 2 * a * c.directions[k]), nullptr});
      }
      return figure;
    }
  const double a = semi_axis(0), b = semi_axis(1);
  if (c.principal[0] * c.principal[1] > 0) {
    const Frame frame{at.point, c.directions[0], c.directions[1], glm::cross(c.directions[0], c.directions[1])};
    figure.lines.push_back({std::make_shared<Ellipse>(frame, a, b), nullptr});
    return figure;
  }
  for (const double side : {1.0, -1.0}) {
    figure.lines.push_back({hyperbola_branch(at, side * c.directions[0], c.directions[1], a, b), nullptr});
    figure.lines.push_back({hyperbola_branch(at, side * c.directions[1], c.directions[0], b, a), nullptr});
  }
  return figure;
}

// A square of the tangent plane, with its sides along the u line, and if asked for m and the unit vectors along r_u and
// r_v.
SurfaceFigure tangent_plane(const SurfacePtr& surface, const Fields& f) {
  const double u = f.number("u"), v = f.number("v"), half = 0.5 * f.number("size");
  check_place(*surface, u, v);
  const SurfaceJet jet = surface->evaluate(u, v, 1);
  const Vec3 normal = surface->normal(u, v), point = jet.point();
  const bool has_u_line = glm::length(jet.du()) > 1e-12 * glm::length(jet.dv());
  const Vec3 x = has_u_line ? glm::normalize(jet.du()) : frame_about(point, normal).x, y = glm::cross(normal, x);
  SurfaceFigure figure;
  const std::vector<Vec3> corners{point - half * x - half * y, point + half * x - half * y, point + half * x + half * y,
                                  point - half * x + half * y};
  figure.lines.push_back({std::make_shared<NurbsCurve>(polyline(corners, true)), nullptr});
  figure.points.push_back(point);
  if (!f.boolean("vectors")) return figure;
  const auto add = [&](const Vec3& way) {
    if (glm::length(way) > 0)
      figure.lines.push_back({std::make_shared<Segment>(point, point + half * glm::normalize(way)), nullptr, true});
  };
  add(normal);
  if (has_u_line) add(jet.du());
  if (glm::length(jet.dv()) > 1e-12 * glm::length(jet.du())) add(jet.dv());
  return figure;
}

using Draw = SurfaceFigure (*)(const SurfacePtr&, const Fields&);

const std::map<std::string, Draw, std::less<>>& figures() {
  static const std::map<std::string, Draw, std::less<>> all = {{"curvature_lines", curvature_lines},
                                                               {"asymptotic_lines", asymptotic_lines},
                                                               {"isophotes", isophotes},
                                                               {"reflections", reflections},
                                                               {"principal_directions", principal_directions},
                                                               {"umbilics", umbilic_points},
                                                               {"hedgehog", hedgehog},
                                                               {"tool_axis_field", tool_axis_field},
                                                               {"principal_circles", principal_circles},
                                                               {"dupin_indicatrix", dupin_indicatrix},
                                                               {"tangent_plane", tangent_plane}};
  return all;
}

}  // namespace

bool is_surface_figure(const std::string& helper) { return helper == "contour_lines" || figures().count(helper) > 0; }

bool lies_on_surface(const Helper& helper) {
  const std::string& type = helper.type;
  return type == "contour_lines" || type == "isophotes" || type == "reflections" || type == "curvature_lines" ||
         type == "asymptotic_lines";
}

bool leaves_surface(const Helper& helper) {
  return is_surface_figure(helper.type) &&
         (helper.values.has("u") || helper.type == "hedgehog" || helper.type == "tool_axis_field");
}

void check_surface_figure(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
}

std::vector<double> contour_levels(const Helper& helper, const std::vector<SurfacePtr>& surfaces) {
  const ParameterValues& asked = helper.values.get<ParameterValues>("levels");
  return asked.values.empty() ? round_numbers(range_on(quantity_of(helper.values), surfaces), asked.count)
                              : asked.values;
}

SurfaceFigure surface_figure(const SurfacePtr& surface, const Helper& helper, const std::vector<double>& levels) {
  check_surface_figure(*surface);
  if (helper.type == "contour_lines") return contour_lines(surface, helper.values, levels);
  return figures().at(helper.type)(surface, helper.values);
}

}  // namespace lekalo::render
