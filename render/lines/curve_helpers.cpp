#include "render/lines/curve_helpers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/curves/operations/moving_frame.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/differential/trihedron.h"
#include "geometry/queries/measures/arc_length.h"
#include "render/lines/control_mesh.h"
#include "render/lines/curve_figures.h"
#include "render/lines/mesh_figures.h"
#include "render/lines/route_figures.h"
#include "render/lines/surface_figures.h"
#include "render/model/color_scale.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Curvature below this, in units of the curve's own derivatives, is none.
constexpr double kStraight = 1e-12;
// Neighbouring numbers give points as near as this, but at a jump.
constexpr double kJump = 1e-5;

// Of a line beside a curve, where the picture is framed by it.
constexpr int kFramedPlaces = 64;

// k n = ((r' x r'') x r') / |r'|^4, or zero.
Vec3 curvature_vector(const CurveJet& at) {
  const double square = glm::dot(at.d[1], at.d[1]);
  const Vec3 across = glm::cross(glm::cross(at.d[1], at.d[2]), at.d[1]);
  if (!(square > 0) || !(glm::length(across) > kStraight * square * glm::length(at.d[2]))) return Vec3(0);
  return across / (square * square);
}

// From a point of the curve to the tip of its tooth of scale 1; nothing where the curve rests.
std::optional<Vec3> tooth(const Curve& curve, double t, const std::string& by) {
  const CurveJet at = curve.evaluate(t, by == "torsion" ? 3 : 2);
  if (!(glm::length(at.d[1]) > 0)) return std::nullopt;
  if (by == "torsion") {
    const CurveCurvature frame = curvature(at);
    return frame.torsion * frame.binormal;
  }
  if (by == "geodesic_curvature" || by == "normal_curvature") {
    const SurfaceBend bend = surface_bend(curve, t);
    return -(by == "normal_curvature" ? bend.normal * bend.up : bend.geodesic * bend.across);
  }
  return -curvature_vector(at);
}

// Joints of pieces at which the teeth of both sides differ.
std::vector<double> tooth_jumps(const Curve& curve, const std::string& by) {
  std::vector<double> jumps;
  const std::vector<CurvePiece> pieces = curve.pieces();
  for (size_t k = 1; k < pieces.size(); ++k) {
    const double t = pieces[k].domain.lo;
    const std::optional<Vec3> before = tooth(curve, next_down(t), by), after = tooth(curve, next_up(t), by);
    if (before && after && glm::length(*before - *after) > kJump * (glm::length(*before) + glm::length(*after)))
      jumps.push_back(t);
  }
  return jumps;
}

std::vector<Frame> frames_on_surfaces(const Curve& curve, const std::vector<double>& at, const Fields& f) {
  std::vector<SurfacePtr> surfaces;
  for (const std::any& one : f.references("surfaces")) surfaces.push_back(std::any_cast<SurfacePtr>(one));
  const SurfaceTrihedron trihedron(surfaces, f.number("share"));
  std::vector<Frame> frames;
  for (const double t : at) frames.push_back(trihedron.at(curve.evaluate(t, 1)));
  return frames;
}

}  // namespace

std::vector<CurvatureComb> curvature_combs(const Curve& curve, int count, double scale, const std::string& by) {
  const Interval domain = curve.domain();
  const std::vector<double> jumps = tooth_jumps(curve, by);
  auto jump = jumps.begin();
  std::vector<CurvatureComb> combs(1);
  const auto add = [&](double t) {
    const std::optional<Vec3> along = tooth(curve, t, by);
    if (!along) return;
    combs.back().foot_points.push_back(curve.point(t));
    combs.back().tips.push_back(combs.back().foot_points.back() + scale * *along);
  };
  for (int k = 0; k < count; ++k) {
    const double t = domain.clamp(domain.lo + domain.width() * k / (count - 1));
    bool at_jump = false;
    for (; jump != jumps.end() && *jump <= t; ++jump) {
      at_jump = *jump == t;
      add(next_down(*jump));
      combs.emplace_back();
      add(next_up(*jump));
    }
    if (!at_jump) add(t);
  }
  return combs;
}

CurveJumps curve_jumps(const Curve& curve) {
  const std::vector<CurvePiece> pieces = curve.pieces();
  CurveJumps jumps;
  for (size_t k = 1; k < pieces.size(); ++k) {
    // Where a pole parts them the curve has no value; a number with a value of its own lies between two pieces.
    const double t = pieces[k - 1].domain.hi, next = pieces[k].domain.lo;
    if (next > next_up(next_up(t))) continue;
    const Vec3 before = curve.point(next_down(t)), at = curve.point(t), after = curve.point(next_up(next));
    const auto differ = [&](const Vec3& a, const Vec3& b) {
      return glm::length(a - b) > kJump * (1 + glm::length(a) + glm::length(b));
    };
    if (!differ(before, after) && !differ(before, at)) continue;
    jumps.values.push_back(at);
    for (const Vec3& limit : {before, after})
      if (differ(limit, at)) jumps.limits.push_back(limit);
  }
  return jumps;
}

std::vector<double> even_parameters(const Curve& curve, int count) {
  if (count == 1) return {parameter_at_fraction(curve, 0.5)};
  std::vector<double> at;
  const int parts = curve.is_closed() ? count : count - 1;
  for (int k = 0; k < count; ++k) at.push_back(parameter_at_fraction(curve, static_cast<double>(k) / parts));
  return at;
}

std::vector<Frame> frenet_frames(const Curve& curve, const std::vector<double>& at) {
  std::vector<Frame> frames;
  for (const double t : at) {
    const CurveJet jet = curve.evaluate(t, 2);
    const Vec3 bend = curvature_vector(jet);
    if (bend == Vec3(0)) continue;
    const Vec3 z = glm::normalize(jet.d[1]), x = glm::normalize(bend);
    frames.push_back({jet.d[0], x, glm::cross(z, x), z});
  }
  return frames;
}

std::vector<Frame> rotation_minimizing_frames(const Curve& curve, const std::vector<double>& at) {
  FrameLaw law;
  law.start = curvature_vector(curve.evaluate(curve.domain().lo, 2));
  if (law.start != Vec3(0)) law.start = glm::normalize(law.start);
  const auto across = direction_across(curve, law);
  std::vector<Frame> frames;
  for (const double t : at) {
    const CurveJet jet = curve.evaluate(t, 1);
    const Vec3 z = glm::normalize(jet.d[1]), x = across->point(t);
    frames.push_back({jet.d[0], x, glm::cross(z, x), z});
  }
  return frames;
}

std::vector<Vec3> helper_points(const Object& object) {
  std::vector<Vec3> points;
  if (!object.look) return points;
  const auto* curve = std::get_if<CurvePtr>(&object.shape);
  std::vector<SurfacePtr> surfaces;
  if (const auto* surface = std::get_if<SurfacePtr>(&object.shape)) surfaces = {*surface};
  if (const auto* set = std::get_if<SurfaceSet>(&object.shape)) surfaces = *set;
  const auto add = [&](const std::vector<Vec4>& form) {
    for (const Vec4& p : form)
      if (p.w != 0) points.push_back(Vec3(p) / p.w);
  };
  const auto add_places = [&](const Curve& line) {
    const Interval domain = line.domain();
    for (int k = 0; k <= kFramedPlaces; ++k)
      points.push_back(line.point(domain.clamp(domain.lo + domain.width() * k / kFramedPlaces)));
  };
  for (const Helper& helper : object.look->helpers) {
    const Fields& f = helper.values;
    if (helper.type == "control_polygon" && curve)
      if (const auto form = (*curve)->as_nurbs()) add(form->points);
    if (curve && is_curve_figure(helper.type)) {
      const CurveFigure figure = curve_figure(*curve, helper);
      points.insert(points.end(), figure.points.begin(), figure.points.end());
      for (const CurvePtr& line : figure.lines) add_places(*line);
    }
    if (curve && is_route_figure(helper.type)) {
      const RouteFigure figure = route_figure(**curve, helper);
      points.insert(points.end(), figure.points.begin(), figure.points.end());
      for (const RouteFigure::Line& line : figure.lines) add_places(*line.curve);
    }
    if (const auto* mesh = std::get_if<MeshPtr>(&object.shape); mesh && is_mesh_figure(helper.type))
      for (const CurvePtr& line : mesh_figure(**mesh, helper).lines) add_places(*line);
    if (helper.type == "comb" && curve) {
      for (const CurvatureComb& comb : curvature_combs(**curve, f.integer("count"), f.number("scale"), f.text("by")))
        points.insert(points.end(), comb.tips.begin(), comb.tips.end());
    }
    if (helper.type == "frames" && curve && (*curve)->domain().width() < kInfinity)
      for (const Frame& frame : helper_frames(**curve, helper))
        for (const Vec3& axis : {frame.x, frame.y, frame.z}) points.push_back(frame.origin + f.number("length") * axis);
    for (const SurfacePtr& surface : surfaces) {
      // Meshes on the surface are framed with it.
      if (const auto mesh = shown_mesh(*surface, helper))
        for (const ControlMesh::Point& point : mesh->points) points.push_back(point.at);
      if (leaves_surface(helper) && surface->bounded())
        for (const SurfaceFigure::Line& line : surface_figure(surface, helper).lines) add_places(*line.curve);
      if (helper.type == "normals" && surface->bounded()) {
        const Rectangle domain = surface->domain();
        for (const double u : {domain.u.lo, domain.u.middle(), domain.u.hi})
          for (const double v : {domain.v.lo, domain.v.middle(), domain.v.hi})
            for (const Vec3& tip : normal_tips(*surface, u, v, helper)) points.push_back(tip);
      }
    }
  }
  std::erase_if(points, [](const Vec3& p) { return !std::isfinite(p.x + p.y + p.z); });
  return points;
}

std::vector<Vec3> normal_tips(const Surface& surface, double u, double v, const Helper& helper) {
  const double length = helper.values.number("length");
  const SurfaceJet jet = surface.evaluate(u, v, 1);
  const Vec3 normal = surface.normal(u, v);
  std::vector<Vec3> tips{jet.point() + length * normal};
  // At a pole rounding leaves r_u a direction.
  const bool vanishes = !(glm::length(jet.du()) > 1e-12 * glm::length(jet.dv()));
  if (!helper.values.boolean("frames") || vanishes) return tips;
  const Vec3 tangent = glm::normalize(jet.du());
  for (const Vec3& axis : {tangent, glm::cross(tangent, normal)}) tips.push_back(jet.point() + length * axis);
  return tips;
}

std::vector<Frame> helper_frames(const Curve& curve, const Helper& helper) {
  const Fields& f = helper.values;
  const std::vector<double> at = f.has("at") ? f.numbers("at") : even_parameters(curve, f.integer("count"));
  if (f.text("kind") == "on_surfaces") return frames_on_surfaces(curve, at, f);
  return f.text("kind") == "frenet" ? frenet_frames(curve, at) : rotation_minimizing_frames(curve, at);
}

}  // namespace lekalo::render
