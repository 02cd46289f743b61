#include "render/lines/curve_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/curves/operations/spline_curves.h"
#include "geometry/queries/differential/osculation.h"
#include "geometry/queries/measures/arc_length.h"
#include "geometry/queries/measures/curve_features.h"
#include "render/lines/curve_helpers.h"
#include "render/lines/tool_figures.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Places of a smooth piece at which lines without a formula are drawn.
constexpr int kPlaces = 400;

void add_polygon(CurveFigure& figure, std::vector<Vec3> points, bool closed = false) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 2) return;
  figure.lines.push_back(std::make_shared<NurbsCurve>(polyline(points, closed && points.size() > 2)));
}

std::vector<double> places_of(const Curve& curve, const Fields& f) {
  return f.has("at") ? f.numbers("at") : even_parameters(curve, f.integer("count"));
}

Osculation osculation_at(const Curve& curve, double t) { return osculation(curve.evaluate(t, 3), curvature(curve, t)); }

CurveFigure osculating_circles(const CurvePtr& curve, const Fields& f) {
  CurveFigure figure;
  for (const double t : places_of(*curve, f)) {
    const Osculation at = osculation_at(*curve, t);
    if (!at.circle) continue;  // straight there
    const CurveCurvature frame = curvature(*curve, t);
    const Vec3 point = curve->point(t);
    figure.lines.push_back(std::make_shared<Circle>(
        Frame{at.circle->center, -frame.normal, -frame.tangent, frame.binormal}, at.circle->radius));
    if (!f.boolean("center")) continue;
    figure.lines.push_back(std::make_shared<Segment>(at.circle->center, point));
    figure.points.push_back(at.circle->center);
    figure.points.push_back(point);
  }
  return figure;
}

// Broken where the centres go to infinity, at straightening points.
CurveFigure evolute(const CurvePtr& curve, const Fields& f) {
  const double reach = f.has("reach") ? f.number("reach") : bounds(*curve).diameter();
  CurveFigure figure;
  for (const CurvePiece& piece : curve->pieces()) {
    std::vector<Vec3> centers;
    for (int k = 0; k <= kPlaces; ++k) {
      const double t = piece.domain.lo + piece.domain.width() * k / kPlaces;
      const Osculation at = osculation_at(*curve, k == kPlaces ? std::nextafter(t, piece.domain.lo) : t);
      if (at.circle && at.circle->radius <= reach) {
        centers.push_back(at.circle->center);
        continue;
      }
      add_polygon(figure, std::move(centers));
      centers.clear();
    }
    add_polygon(figure, std::move(centers));
  }
  return figure;
}

CurveFigure rays(const CurvePtr& curve, const Fields& f, const std::function<Vec3(const CurveCurvature&)>& way) {
  CurveFigure figure;
  const bool both = f.boolean("both");
  figure.arrows = !both;
  for (const double t : places_of(*curve, f)) {
    const Vec3 point = curve->point(t), tip = f.number("length") * way(curvature(*curve, t));
    if (tip == Vec3(0)) continue;  // no frame there
    figure.lines.push_back(std::make_shared<Segment>(both ? point - tip : point, point + tip));
    figure.points.push_back(point);
  }
  return figure;
}

CurveFigure features(const CurvePtr& curve, const Fields& f) {
  const auto& kinds = f.get<std::vector<std::string>>("kinds");
  CurveFigure figure;
  for (const CurveFeature& feature : curve_features(*curve).points)
    if (std::find(kinds.begin(), kinds.end(), name(feature.kind)) != kinds.end())
      figure.points.push_back(feature.point);
  return figure;
}

CurveFigure hodograph(const CurvePtr& curve, const Fields& f) {
  CurveFigure figure;
  for (const CurvePiece& piece : curve->pieces()) {
    std::vector<Vec3> tips;
    for (int k = 0; k <= kPlaces; ++k) {
      const double t = k == kPlaces ? std::nextafter(piece.domain.hi, piece.domain.lo)
                                    : piece.domain.lo + piece.domain.width() * k / kPlaces;
      tips.push_back(f.vec3("at") + f.number("scale") * curve->evaluate(t, 1).d[1]);
    }
    std::erase_if(tips, [](const Vec3& p) { return !std::isfinite(p.x + p.y + p.z); });
    add_polygon(figure, std::move(tips));
  }
  return figure;
}

// The parts of the curve that end in the heads: in the middles of so many parts of equal length, or at given places.
CurveFigure direction(const CurvePtr& curve, const Fields& f) {
  std::vector<double> ends;
  const int count = f.integer("count");
  if (f.has("at"))
    ends = f.numbers("at");
  else
    for (int k = 0; k < count; ++k) ends.push_back(parameter_at_fraction(*curve, (k + 0.5) / count));
  std::sort(ends.begin(), ends.end());
  CurveFigure figure;
  figure.arrows = true;
  double from = curve->domain().lo;
  for (const double end : ends) {
    if (end > from) figure.lines.push_back(std::make_shared<CurvePart>(curve, Interval(from, end)));
    from = end;
  }
  return figure;
}

NurbsCurveForm form_of(const Curve& curve) {
  const auto form = curve.as_nurbs();
  if (!form) throw FieldError("", "this curve has no NURBS form, so no control points");
  return *form;
}

std::vector<Vec3> control_points(const NurbsCurveForm& form, size_t first, size_t count) {
  std::vector<Vec3> points;
  for (size_t i = first; i < first + count; ++i)
    if (const Vec4& p = form.points[i]; p.w != 0) points.push_back(Vec3(p) / p.w);
  return points;
}

CurveFigure polygon_of(const NurbsCurve& curve) {
  CurveFigure figure;
  const bool closed = curve.period() > 0;
  const NurbsCurveForm form = *curve.as_nurbs();
  figure.points = control_points(form, 0, form.points.size() - (closed ? static_cast<size_t>(form.degree) : 0));
  add_polygon(figure, figure.points, closed);
  return figure;
}

// The corners of the convex hull of points in the plane of two axes, counterclockwise (Andrew 1979).
std::vector<Vec3> convex_hull(std::vector<Vec3> points, const Vec3& x, const Vec3& y) {
  const auto at = [&](const Vec3& p) { return std::pair(glm::dot(p, x), glm::dot(p, y)); };
  std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return at(a) < at(b); });
  std::vector<Vec3> hull;
  for (const int pass : {0, 1}) {
    const size_t begin = hull.size();
    for (const Vec3& p : points) {
      while (hull.size() >= begin + 2 &&
             glm::dot(glm::cross(hull.back() - hull[hull.size() - 2], p - hull.back()), glm::cross(x, y)) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Of points in one plane the hull's border; of others the edges of all triangles, among which those of the hull are.
void add_hull(CurveFigure& figure, const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.include(p);
  const double size = box.diameter();
  Vec3 x(0), normal(0);
  for (const Vec3& p : points)
    if (glm::length(p - points[0]) > glm::length(x)) x = p - points[0];
  for (const Vec3& p : points)
    if (const Vec3 across = glm::cross(x, p - points[0]); glm::length(across) > glm::length(normal)) normal = across;
  if (!(glm::length(normal) > 1e-12 * size * size)) return add_polygon(figure, {points[0], points[0] + x});
  x = glm::normalize(x), normal = glm::normalize(normal);
  const bool plane = std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
    return std::abs(glm::dot(p - points[0], normal)) <= 1e-9 * size;
  });
  if (plane) return add_polygon(figure, convex_hull(points, x, glm::cross(normal, x)), true);
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t j = i + 1; j < points.size(); ++j) add_polygon(figure, {points[i], points[j]});
}

CurveFigure hulls(const CurvePtr& curve, const Fields&) {
  const NurbsCurveForm form = form_of(*curve);
  CurveFigure figure;
  const auto p = static_cast<size_t>(form.degree);
  for (size_t span = p; span < form.points.size(); ++span)
    if (form.knots[span] < form.knots[span + 1] &&
        curve->domain().contains(0.5 * (form.knots[span] + form.knots[span + 1])))
      add_hull(figure, control_points(form, span - p, p + 1));
  return figure;
}

// One control point moved: the way, the sides of the polygon, and the part of the curve that it moves, between the
// knots i and i + p + 1.
CurveFigure moved_point(const CurvePtr& curve, const Fields& f) {
  NurbsCurveForm form = form_of(*curve);
  const auto p = static_cast<size_t>(form.degree), index = static_cast<size_t>(f.integer("index"));
  const bool closed = curve->period() > 0;
  const size_t distinct = form.points.size() - (closed ? p : 0);
  if (index >= distinct)
    throw FieldError("index", fmt::format("the curve has {} control points", distinct),
                     fmt::format("the last is {}", distinct - 1));
  if (form.points[index].w == 0)
    throw FieldError("index", "this point lies at infinity: it has no place to be moved from");
  const Vec3 before = Vec3(form.points[index]) / form.points[index].w;
  for (size_t i = index; i < form.points.size(); i += distinct)
    form.points[i] += Vec4(form.points[i].w * f.vec3("by"), 0.0);
  form.maps.clear();
  const auto moved = std::make_shared<NurbsCurve>(form);
  CurveFigure figure;
  for (size_t i = index; i < form.points.size(); i += distinct) {
    const Interval part = intersect({form.knots[i], form.knots[i + p + 1]}, moved->domain());
    if (part.width() > 0) figure.lines.push_back(std::make_shared<CurvePart>(moved, part));
  }
  const auto neighbour = [&](size_t i) { return control_points(form, i % distinct, 1); };
  const Vec3 now = before + f.vec3("by");
  std::vector<Vec3> legs;
  if (index > 0 || closed) legs = neighbour(index + distinct - 1);
  legs.push_back(now);
  if (index + 1 < distinct || closed)
    for (const Vec3& next : neighbour(index + 1)) legs.push_back(next);
  add_polygon(figure, legs);
  add_polygon(figure, {before, now});
  figure.points = {now};
  return figure;
}

// Where a plane across the drawing, its line, meets the curve; or its control polygon.
std::vector<Vec3> crossings_with(const Curve& curve, const Axis& line, const Vec3& across) {
  const double distance = glm::dot(across, line.through);
  const auto value = [&](const Vec3& p) { return glm::dot(across, p) - distance; };
  const auto range = [&](const Box3& box) {
    const auto along = [&](int k) { return Interval(across[k]) * Interval(box.lo[k], box.hi[k]); };
    return along(0) + along(1) + along(2) - Interval(distance);
  };
  std::vector<Vec3> points;
  for (const double t : sign_changes(curve, curve.is_closed(), range, value)) points.push_back(curve.point(t));
  return points;
}

// A line through a plane curve: no line crosses it more often than its polygon (variation diminishing).
CurveFigure crossings(const CurvePtr& curve, const Fields& f) {
  const NurbsCurveForm form = form_of(*curve);
  const Axis& line = f.axis("line");
  const Vec3 across = glm::cross(line.along, f.vec3("plane"));
  if (!(glm::length(across) > 0))
    throw FieldError("line", "the line is perpendicular to the plane of the curve", "say 'plane': its normal");
  const bool closed = curve->period() > 0;
  const std::vector<Vec3> corners = control_points(form, 0, form.points.size() - (closed ? form.degree : 0));
  const NurbsCurve polygon = polyline(corners, closed);
  const std::vector<Vec3> of_curve = crossings_with(*curve, line, across),
                          of_polygon = crossings_with(polygon, line, across);
  CurveFigure figure;
  figure.points = f.text("of") == "curve" ? of_curve : of_polygon;
  // The line as far as it meets the polygon, and somewhat beyond.
  Interval reach(kInfinity, -kInfinity);
  for (const Vec3& p : corners) reach = hull(reach, Interval(glm::dot(p - line.through, line.along)));
  const auto at = [&](double s) { return line.through + s * line.along; };
  const double more = 0.04 * reach.width();
  figure.lines.push_back(std::make_shared<Segment>(at(reach.lo - more), at(reach.hi + more)));
  figure.counts = {of_curve.size(), of_polygon.size()};
  figure.label_at = at(reach.hi + more);
  return figure;
}

using Draw = std::function<CurveFigure(const CurvePtr&, const Fields&)>;

const std::map<std::string, Draw, std::less<>>& figures() {
  static const std::map<std::string, Draw, std::less<>> all = {
      {"osculating_circle", osculating_circles},
      {"evolute", evolute},
      {"tangents", [](const CurvePtr& c,
                      const Fields& f) { return rays(c, f, [](const CurveCurvature& at) { return at.tangent; }); }},
      {"normal_lines", [](const CurvePtr& c,
                          const Fields& f) { return rays(c, f, [](const CurveCurvature& at) { return at.normal; }); }},
      {"features", features},
      {"hodograph", hodograph},
      {"direction", direction},
      {"insertion",
       [](const CurvePtr& c, const Fields& f) {
         return polygon_of(with_inserted_knots(c, f.numbers("at"), f.integer("times")));
       }},
      {"elevation",
       [](const CurvePtr& c, const Fields& f) {
         return polygon_of(with_degree(c, f.has("degree") ? std::optional(f.integer("degree")) : std::nullopt));
       }},
      {"hulls", hulls},
      {"crossings", crossings},
      {"cutters", cutters_figure},
      {"tool_axes", tool_axes_figure},
      {"contacts", contacts_figure},
      {"tool_moves", tool_moves_figure},
      {"moved_point", moved_point}};
  return all;
}

}  // namespace

bool is_curve_figure(const std::string& helper) { return figures().count(helper) > 0; }

CurveFigure curve_figure(const CurvePtr& curve, const Helper& helper) {
  if (!(curve->domain().width() < kInfinity))
    throw FieldError("", fmt::format("the curve has no ends, so no '{}' can be shown", helper.type),
                     "give it a domain");
  return figures().at(helper.type)(curve, helper.values);
}

}  // namespace lekalo::render
