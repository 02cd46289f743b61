#include "render/lines/tool_figures.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/machining/tool_path.h"
#include "render/lines/curve_helpers.h"

namespace lekalo::render {

using namespace geometry;

namespace {

std::vector<CutterPose> poses_of(const CurvePtr& curve, const ToolPath& path, const Fields& f) {
  std::vector<CutterPose> poses;
  for (const double t : f.has("at") ? f.numbers("at") : even_parameters(*curve, f.integer("count")))
    poses.push_back(path.pose(t));
  return poses;
}

const ToolPath& path_of(const CurvePtr& curve) {
  if (const auto* path = dynamic_cast<const ToolPath*>(curve.get())) return *path;
  throw FieldError("", "the curve is no path of a cutter, or one that was moved",
                   "transform what the path is made from");
}

void add_outline(CurveFigure& figure, const Cutter& cutter, const Frame& frame, int meridians) {
  // Two make a profile; of more, radii of the ends would only be a star.
  const bool is_profile = meridians <= 2;
  for (int k = 0; k < meridians; ++k) {
    const Affine turn = Affine::rotation(kTwoPi * k / meridians, frame.z, frame.origin);
    const Frame turned{frame.origin, turn.direction(frame.x), turn.direction(frame.y), frame.z};
    for (const MeridianPart& part : meridian(cutter, turned))
      if (is_profile || part.name == std::string_view("corner") || part.name == std::string_view("flank"))
        figure.lines.push_back(part.curve);
  }
  const auto circle = [&](double radius, double height) {
    if (!(radius > 1e-9 * cutter.radius)) return;
    Frame at = frame;
    at.origin += height * frame.z;
    figure.lines.push_back(std::make_shared<Circle>(at, radius));
  };
  circle(cutter.ring_radius(), 0);
  const Vec2 flank = cutter.flank_start();
  if (flank.y > 0) circle(flank.x, flank.y);
  circle(cutter.top_radius(), cutter.length);
}

}  // namespace

CurveFigure cutters_figure(const CurvePtr& curve, const Fields& f) {
  const ToolPath& path = path_of(curve);
  CurveFigure figure;
  for (const CutterPose& pose : poses_of(curve, path, f))
    add_outline(figure, path.cutter(), frame_of(pose), f.integer("meridians"));
  return figure;
}

CurveFigure tool_axes_figure(const CurvePtr& curve, const Fields& f) {
  const ToolPath& path = path_of(curve);
  CurveFigure figure;
  figure.arrows = true;
  const double length = f.has("length") ? f.number("length") : path.cutter().length;
  for (const CutterPose& pose : poses_of(curve, path, f)) {
    figure.lines.push_back(std::make_shared<Segment>(pose.reference, pose.reference + length * pose.axis));
    figure.points.push_back(pose.reference);
  }
  return figure;
}

CurveFigure contacts_figure(const CurvePtr& curve, const Fields& f) {
  const ToolPath& path = path_of(curve);
  CurveFigure figure;
  figure.arrows = true;
  const double length = f.has("length") ? f.number("length") : path.cutter().radius;
  for (const CutterPose& pose : poses_of(curve, path, f)) {
    if (!pose.contact) continue;
    figure.points.push_back(pose.contact->point);
    figure.lines.push_back(
        std::make_shared<Segment>(pose.contact->point, pose.contact->point + length * pose.contact->normal));
  }
  return figure;
}

CurveFigure tool_moves_figure(const CurvePtr& curve, const Fields& f) {
  const auto& kinds = f.get<std::vector<std::string>>("kinds");
  CurveFigure figure;
  figure.arrows = f.boolean("arrows");
  for (const ToolMove& move : path_of(curve).moves())
    if (std::find(kinds.begin(), kinds.end(), name(move.kind)) != kinds.end()) figure.lines.push_back(move.curve);
  return figure;
}

}  // namespace lekalo::render
