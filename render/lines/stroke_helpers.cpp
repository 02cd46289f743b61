#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/surfaces/splines/t_spline.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"
#include "geometry/transformed.h"
#include "render/lines/curve_figures.h"
#include "render/lines/curve_helpers.h"
#include "render/lines/mesh_figures.h"
#include "render/lines/route_figures.h"
#include "render/lines/stroke_collector.h"
#include "render/lines/surface_figures.h"
#include "render/model/color_scale.h"
#include "render/model/look.h"
#include "render/model/objects.h"

namespace lekalo::render {

using namespace geometry;

bool is_triangle(const Helper& helper) { return helper.type == "de_casteljau" || helper.type == "de_boor"; }

void StrokeCollector::add_helper(const Helper& helper) {
  const auto* curve = std::get_if<CurvePtr>(&object_->shape);
  const std::string sign = helper.values.has("marker") ? helper.values.text("marker") : "none";
  const auto marks = [&](const std::vector<Vec3>& points) {
    for (const Vec3& point : points) mark(point, sign, helper.style, helper.hidden);
  };
  if (helper.type == "control_polygon" && curve) {
    if (const auto form = (*curve)->as_nurbs()) {
      const bool closed = (*curve)->period() > 0;
      const std::vector<Vec3> points =
          control_points(form->points, 0, 1, distinct(form->points.size(), form->degree, closed));
      polygon(points, closed, helper.style, helper.hidden);
      marks(points);
      for (size_t i = 0; i < points.size(); ++i)
        if (helper.values.text("label_points") == "all" || i == 0 || i + 1 == points.size()) {
          label(points[i], {static_cast<double>(i)}, helper);
          if (helper.values.boolean("blossom")) blossom(points[i], *form, i, 0, 0, helper);
        }
    }
  } else if (is_triangle(helper) && curve) {
    if (const auto form = (*curve)->as_nurbs()) add_triangle(*form, sign, helper);
  } else if (helper.type == "knots" && curve) {
    if (const auto form = (*curve)->as_nurbs()) {
      std::vector<Vec3> points;
      for (size_t i = 0; i < form->knots.size(); ++i) {
        const double knot = form->knots[i];
        if ((i > 0 && form->knots[i - 1] == knot) || !(*curve)->domain().contains(knot)) continue;
        points.push_back((*curve)->point(knot));
        label(points.back(), {static_cast<double>(i)}, helper);
      }
      marks(points);
    }
  } else if (is_curve_figure(helper.type) && curve && drawing_) {
    add_figure(*curve, sign, helper);
  } else if (is_route_figure(helper.type) && curve) {
    const RouteFigure figure = route_figure(**curve, helper);
    for (const RouteFigure::Line& line : figure.lines) {
      Style style = helper.style;
      if (line.arrow && drawing_) style.arrows = "end";
      stroke(line.curve, style, helper.hidden);
    }
    if (drawing_)
      for (const RouteFigure::Text& one : figure.texts) text(one.point, one.words, helper, sign != "none");
    marks(figure.points);
  } else if (helper.type == "colored" && curve && drawing_) {
    add_colored(*curve, helper);
  } else if (helper.type == "jumps" && curve) {
    const CurveJumps jumps = curve_jumps(**curve);
    for (const Vec3& point : jumps.limits) mark(point, "circle", helper.style, helper.hidden);
    for (const Vec3& point : jumps.values) mark(point, "dot", helper.style, helper.hidden);
  } else if (helper.type == "comb" && curve && drawing_) {
    add_comb(**curve, helper);
  } else if (helper.type == "frames" && curve && drawing_) {
    add_frames(**curve, helper);
  }
  if (const auto* mesh = std::get_if<MeshPtr>(&object_->shape); mesh && is_mesh_figure(helper.type)) {
    const MeshFigure figure = mesh_figure(**mesh, helper);
    for (const CurvePtr& line : figure.lines) stroke(line, helper.style, helper.hidden);
    marks(figure.points);
  }
  const std::vector<double> levels = levels_of(helper);
  if (const auto* body = std::get_if<BodyPtr>(&object_->shape); body && lies_on_surface(helper))
    add_figure(**body, levels, sign, helper);
  each_surface([&](const SurfacePtr& surface) {
    const auto net = triangular_net(*surface);
    if (net && helper.type == "de_casteljau")
      add_triangle(*net, placed_triangle(*surface).surface->triangle(), sign, helper);
    if (const auto mesh = shown_mesh(*surface, helper)) add_mesh(*mesh, sign, helper);
    if (is_mesh_on_surface(helper)) add_mesh_image(surface, sign, helper);
    const auto form = helper.type == "knots" ? surface->as_nurbs() : std::nullopt;
    if (form) {
      // Of those of a period alone: others come back into it.
      const auto within = [](const std::vector<double>& knots, const Interval& domain) {
        std::set<double> values;
        for (const double knot : knots)
          if (domain.contains(knot)) values.insert(knot);
        return values;
      };
      const std::set<double> u = within(form->knots_u, surface->domain().u),
                             v = within(form->knots_v, surface->domain().v);
      for (const NetLine& line : parameter_lines(surface, {{0, {u.begin(), u.end()}}, {0, {v.begin(), v.end()}}}))
        add(line, helper.style, helper.hidden);
    }
    if (helper.type == "normals" && surface->bounded()) add_normals(*surface, helper);
    if (is_surface_figure(helper.type)) add_figure(surface, levels, sign, helper);
  });
}

// De Boor's points of each level (Golovanov 2016, 2.10), which for a Bezier curve are de Casteljau's:
//
//   d_i^r = (1 - a) d_(i-1)^(r-1) + a d_i^(r-1),   a = (t - t_i)/(t_(i+p-r+1) - t_i)
//
// In the span t_s <= t < t_(s+1) those of level r have the indices s-p+r to s; de Casteljau's count from 0.
void StrokeCollector::add_triangle(const NurbsCurveForm& form, const std::string& sign, const Helper& helper) {
  const int p = form.degree, last = static_cast<int>(form.points.size()) - 1;
  const double t = helper.values.number("t");
  const bool de_boor = helper.type == "de_boor";
  int span = p;
  while (span < last && form.knots[span + 1] <= t) ++span;
  std::vector<Vec4> points(form.points.begin() + (span - p), form.points.begin() + (span + 1));
  for (int level = 1; level <= p; ++level) {
    for (int k = p; k >= level; --k) {
      const int i = span - p + k;
      const double a = (t - form.knots[i]) / (form.knots[i + p - level + 1] - form.knots[i]);
      points[k] = (1 - a) * points[k - 1] + a * points[k];
    }
    if (helper.values.has("levels")) {
      const std::vector<double>& levels = helper.values.numbers("levels");
      if (std::find(levels.begin(), levels.end(), level) == levels.end()) continue;
    }
    const std::vector<Vec3> shown = control_points(points, level, 1, p + 1 - level);
    polygon(shown, false, helper.style, helper.hidden);
    for (const Vec3& point : shown) mark(point, sign, helper.style, helper.hidden);
    for (size_t i = 0; i < shown.size(); ++i) {
      const size_t index = i + static_cast<size_t>(span - p + level);
      label(shown[i], {static_cast<double>(de_boor ? index : i), static_cast<double>(level)}, helper);
      if (helper.values.boolean("blossom")) blossom(shown[i], form, index, level, t, helper);
    }
  }
}

// The arguments of the polar form whose value the point is: t as often as its level says, and the knots after it
// (Ramshaw 1989).
void StrokeCollector::blossom(const Vec3& point, const NurbsCurveForm& form, size_t index, int level, double t,
                              const Helper& helper) {
  if (!drawing_) return;
  std::vector<double> arguments(static_cast<size_t>(level), t);
  const auto first = form.knots.begin() + static_cast<std::ptrdiff_t>(index) + 1;
  arguments.insert(arguments.end(), first, first + form.degree - level);
  std::sort(arguments.begin(), arguments.end());
  std::string words;
  for (const double x : arguments) words += fmt::format("{}{:g}", words.empty() ? "" : ", ", x);
  text(point, fmt::format("$({})$", words), helper, helper.values.text("marker") != "none");
}

int StrokeCollector::distinct(size_t count, int degree, bool periodic) {
  return static_cast<int>(count) - (periodic ? degree : 0);
}

std::vector<Vec3> StrokeCollector::control_points(const std::vector<Vec4>& points, int first, int step, int count) {
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) {
    const Vec4& p = points[first + static_cast<size_t>(i) * step];
    if (p.w != 0) result.push_back(Vec3(p) / p.w);  // else at infinity
  }
  return result;
}

void StrokeCollector::add_mesh(const ControlMesh& mesh, const std::string& sign, const Helper& helper) {
  for (const ControlMesh::Line& line : mesh.lines) {
    std::vector<Vec3> points;
    for (const int k : line.points) points.push_back(mesh.points[k].at);
    polygon(points, line.closed, helper.style, helper.hidden);
  }
  const bool all = !helper.values.has("label_points") || helper.values.text("label_points") == "all";
  for (const ControlMesh::Point& point : mesh.points) {
    mark(point.at, sign, helper.style, helper.hidden);
    const auto& [i, j, k] = point.counters;
    if (all || point.is_corner) label(point.at, {i, j, k}, helper);
  }
}

// De Casteljau's points of each level at parameters of the triangle (Golovanov 2016, 3.11.7).
void StrokeCollector::add_triangle(TriangularNet net, const ParameterTriangle& triangle, const std::string& sign,
                                   const Helper& helper) {
  if (!helper.values.has("u") || !helper.values.has("v")) return;
  const Barycentric at = triangle.coordinates({helper.values.number("u"), helper.values.number("v")});
  const int degree = net.degree;
  for (int level = 1; level <= degree; ++level) {
    net = de_casteljau_step(net, at);
    if (helper.values.has("levels")) {
      const std::vector<double>& levels = helper.values.numbers("levels");
      if (std::find(levels.begin(), levels.end(), level) == levels.end()) continue;
    }
    std::vector<Vec3> shown;
    for (const Vec4& p : net.points) shown.push_back(Vec3(p) / p.w);
    each_index(net.degree - 1, [&](int i, int j, int) {
      const auto point = [&](int p, int q) { return shown[static_cast<size_t>(net.index(p, q))]; };
      polygon({point(i + 1, j), point(i, j + 1), point(i, j)}, true, helper.style, helper.hidden);
    });
    for (size_t k = 0; k < shown.size(); ++k) {
      mark(shown[k], sign, helper.style, helper.hidden);
      label(shown[k], {static_cast<double>(k), static_cast<double>(level)}, helper);
    }
  }
}

// The lines of the mesh on the surface itself, as far as it goes.
void StrokeCollector::add_mesh_image(const SurfacePtr& surface, const std::string& sign, const Helper& helper) {
  const TSpline* of = placed<TSpline>(*surface).surface;
  if (!of) return;
  const TSpline& spline = *of;
  const Rectangle domain = spline.domain();
  for (const auto& [i, j] : spline.edges()) {
    const Vec2 a = spline.place(i), b = spline.place(j);
    const bool along_u = a.y == b.y;
    const Interval part = along_u ? intersect({a.x, b.x}, domain.u) : intersect({a.y, b.y}, domain.v);
    const double at = along_u ? a.y : a.x;
    if (part.width() > 0 && (along_u ? domain.v : domain.u).contains(at))
      add(NetLine{surface, along_u ? IsoDirection::v : IsoDirection::u, at, part}, helper.style, helper.hidden);
  }
  for (size_t i = 0; i < spline.points().size(); ++i) {
    const Vec2 place = spline.place(static_cast<int>(i));
    if (!domain.contains(place.x, place.y)) continue;
    mark(surface->point(place.x, place.y), sign, helper.style, helper.hidden);
    label(surface->point(place.x, place.y), {static_cast<double>(i), 0.0}, helper);
  }
}

void StrokeCollector::add_figure(const CurvePtr& curve, const std::string& sign, const Helper& helper) {
  const CurveFigure figure = curve_figure(curve, helper);
  Style style = helper.style;
  if (figure.arrows) style.arrows = "end";
  for (const CurvePtr& line : figure.lines) stroke(line, style, helper.hidden);
  for (const Vec3& point : figure.points) mark(point, sign, helper.style, helper.hidden);
  if (!figure.counts.empty())
    label(figure.label_at, {static_cast<double>(figure.counts[0]), static_cast<double>(figure.counts[1])}, helper);
}

// Of contour lines, which all surfaces of the object have at the same levels.
std::vector<double> StrokeCollector::levels_of(const Helper& helper) {
  std::vector<SurfacePtr> surfaces;
  if (helper.type == "contour_lines")
    each_face([&](const SurfacePtr& one) {
      if (one->bounded()) surfaces.push_back(one);
    });
  return surfaces.empty() ? std::vector<double>() : contour_levels(helper, surfaces);
}

void StrokeCollector::add_figure(const SurfacePtr& surface, const std::vector<double>& levels, const std::string& sign,
                                 const Helper& helper) {
  const SurfaceFigure figure = surface_figure(surface, helper, levels);
  if (!figure.complete) is_incomplete();
  for (const SurfaceFigure::Line& line : figure.lines) {
    Style style = helper.style;
    if (line.arrow) style.arrows = "end";
    if (line.image && (drawing_ || !cutters_.empty())) supporting_surfaces_.push_back({surface, line.image});
    stroke(line.curve, style, helper.hidden);
  }
  for (const SurfaceFigure::Text& one : figure.texts) text(one.point, one.words, helper, false);
  for (const Vec3& point : figure.points) mark(point, sign, helper.style, helper.hidden);
}

void StrokeCollector::add_figure(const Body& body, const std::vector<double>& levels, const std::string& sign,
                                 const Helper& helper) {
  for (const FaceRegion& face : face_regions(body)) {
    if (!face.surface->bounded()) {
      leave_out(helper.type + " of unbounded surfaces (" + name_of_object() + ")");
      continue;
    }
    if (face.region) cutters_.push_back(cutter_of(face, to_world_));
    add_figure(face.surface, levels, sign, helper);
    if (face.region) cutters_.pop_back();
  }
}

// Parts of equal ranges of the parameter, each in the colour of its middle.
void StrokeCollector::add_colored(const CurvePtr& curve, const Helper& helper) {
  const Fields& f = helper.values;
  const std::string &by = f.text("by"), &colors = f.text("colors");
  const Interval range = f.has("range") ? f.range("range") : curve_range(*curve, by, colors), domain = curve->domain();
  const int count = f.integer("count");
  const auto at = [&](double k) { return domain.clamp(domain.lo + domain.width() * k / count); };
  for (int k = 0; k < count; ++k) {
    Style style = helper.style;
    style.color = color_at(colors, (curve_quantity(*curve, by, at(k + 0.5)) - range.lo) / range.width());
    style.cycles = false;
    stroke(std::make_shared<CurvePart>(curve, Interval(at(k), at(k + 1))), style, helper.hidden);
  }
}

void StrokeCollector::add_comb(const Curve& curve, const Helper& helper) {
  for (const CurvatureComb& comb : curvature_combs(curve, helper.values.integer("count"), helper.values.number("scale"),
                                                   helper.values.text("by"))) {
    for (size_t k = 0; k < comb.foot_points.size(); ++k)
      if (comb.tips[k] != comb.foot_points[k])
        stroke(std::make_shared<Segment>(comb.foot_points[k], comb.tips[k]), helper.style, helper.hidden);
    if (helper.values.boolean("envelope")) polygon(comb.tips, false, helper.style, helper.hidden);
  }
}

void StrokeCollector::add_frames(const Curve& curve, const Helper& helper) {
  const std::vector<Frame> frames = helper_frames(curve, helper);
  Style style = helper.style;
  style.arrows = "end";
  const double length = helper.values.number("length");
  const std::string& named = helper.values.text("label");
  const auto& called = helper.values.get<std::vector<TextTemplate>>("names");
  for (size_t k = 0; k < frames.size(); ++k) {
    const bool names = named == "all" || (named == "first" && k == 0) || (named == "last" && k + 1 == frames.size());
    const auto arrow = [&](const Vec3& axis, size_t which) {
      const Vec3 tip = frames[k].origin + length * axis;
      stroke(std::make_shared<Segment>(frames[k].origin, tip), style, helper.hidden);
      if (names) text(tip, called[which].text(), helper, false);
    };
    arrow(frames[k].z, 0);
    arrow(frames[k].x, 1);
    arrow(frames[k].y, 2);
  }
}

void StrokeCollector::add_normals(const Surface& surface, const Helper& helper) {
  const Rectangle domain = surface.domain();
  for (const double u :
       values_in(helper.values.get<ParameterValues>("at_u"), domain.u, is_closed_in(surface, IsoDirection::u)))
    for (const double v :
         values_in(helper.values.get<ParameterValues>("at_v"), domain.v, is_closed_in(surface, IsoDirection::v))) {
      const Vec3 foot_point = surface.point(u, v);
      for (const Vec3& tip : normal_tips(surface, u, v, helper))
        stroke(std::make_shared<Segment>(foot_point, tip), helper.style, helper.hidden);
    }
}

}  // namespace lekalo::render
