#include "render/lines/strokes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/surfaces/analytic/plane.h"
#include "render/lines/mesh_figures.h"
#include "render/lines/route_figures.h"
#include "render/lines/stroke_collector.h"
#include "render/lines/surface_figures.h"
#include "render/model/look.h"
#include "render/model/mesh_tolerance.h"
#include "render/model/objects.h"
#include "render/model/placed_objects.h"
#include "render/model/section.h"
#include "render/scene/values/color_names.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr double kPixelsPerInch = 96;  // of pictures without a size on paper
// Faded lines lose so much of their opacity with each layer beyond the first.
constexpr double kFadeOfLayer = 0.6;
// Where drawings have their light from, for one of the way to the viewer.
constexpr double kLightFromLeft = 0.7, kLightFromAbove = 0.9;
// The colours of color: cycle; told apart with any kind of colour vision (Okabe, Ito 2008).
constexpr const char* kPalette[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#f0e442", "#000000"};

const std::map<std::string, Mark::Sign, std::less<>> kSigns = {
    {"dot", Mark::Sign::dot},           {"circle", Mark::Sign::circle},  {"ball", Mark::Sign::ball},
    {"cross", Mark::Sign::cross},       {"plus", Mark::Sign::plus},      {"square", Mark::Sign::square},
    {"triangle", Mark::Sign::triangle}, {"diamond", Mark::Sign::diamond}};

// What pictures show of `lines`, in the order in which they are drawn over one another; and of `show`.
constexpr const char* kLinesShown[] = {"parameter", "smooth", "sharp", "boundary", "curve"};
// Those of drawings.
constexpr const char* kLinesDrawn[] = {"parameter", "smooth",     "section",  "intersection", "self_intersection",
                                       "sharp",     "silhouette", "boundary", "curve"};
constexpr const char* kHelpersShown[] = {"control_polygon", "control_net", "t_mesh", "knots", "normals"};

bool shows(std::span<const char* const> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}
bool is_helper_shown(const Helper& helper, const Object& object) {
  return shows(kHelpersShown, helper.type) || is_surface_figure(helper.type) || is_mesh_figure(helper.type) ||
         is_route_figure(helper.type) || (is_triangle(helper) && std::holds_alternative<CurvePtr>(object.shape));
}

LineLook look_of_style(const Style& style, double pixels, double min_width) {
  LineLook look;
  const double width = style.width * pixels;
  look.half_width = 0.5 * std::max(width, min_width);
  look.opacity = style.opacity * (min_width > 0 ? std::min(width / min_width, 1.0) : 1.0);
  look.color = rgb(style.color);
  for (const double length : style.dash) look.dash.push_back(length * pixels);
  look.cap = style.cap == "round"    ? LineLook::Cap::round
             : style.cap == "square" ? LineLook::Cap::square
                                     : LineLook::Cap::butt;
  look.join = style.join == "miter"   ? LineLook::Join::miter
              : style.join == "bevel" ? LineLook::Join::bevel
                                      : LineLook::Join::round;
  return look;
}

std::optional<LineLook> hidden_look(const Model& model, const LineLook& seen, const HiddenLines& hidden, double pixels,
                                    double min_width) {
  LineLook look = seen;
  switch (hidden.way) {
    case HiddenLines::Way::show:
      return look;
    case HiddenLines::Way::drop:
      return std::nullopt;
    case HiddenLines::Way::dashed:
      look.dash.clear();
      if (const auto style = model.styles.find("hidden"); style != model.styles.end())
        for (const double length : style->second.dash) look.dash.push_back(length * pixels);
      return look;
    case HiddenLines::Way::thin:
      if (min_width > 0) look.opacity *= std::min(1.0, seen.half_width);
      look.half_width = std::max(0.5 * min_width, 0.5 * seen.half_width);
      return look;
    case HiddenLines::Way::faded:
      look.opacity /= 3;
      return look;
    case HiddenLines::Way::styled:
      return look_of_style(hidden.style, pixels, min_width);
  }
  return std::nullopt;
}

}  // namespace

StrokeCollector::StrokeCollector(const World& world, bool drawing, const std::atomic<bool>* stop, SolidLines* solids)
    : model_(world.model()), drawing_(drawing), solids_(solids ? *solids : own_solids_) {
  pixels_ = drawing ? 1 : 1 / millimetres_of_pixel(model_);
  min_width_ = drawing ? 0 : 1;
  if (model_.camera) {
    const Camera& camera = *model_.camera;
    view_.central = !camera.is_parallel();
    view_.direction_or_eye =
        view_.central ? camera.ray(0.5 * camera.width(), 0.5 * camera.height()).origin : camera.view_direction();
  }
  const auto is_wanted = [&](const Object& object) { return drawing || has_lines_in_pictures(object); };
  for (size_t i = 0; i < world.objects().size(); ++i)
    if (is_wanted(*world.objects()[i])) numbers_.emplace(world.objects()[i], static_cast<int>(i));
  work_.fills = drawing && model_.camera && (model_.drawing.ground == Ground::fill || has_hatched_cuts(model_.objects));
  PlacedObjects(model_.objects, is_wanted)
      .visit(
          [&](const Object& object, const Affine& to_world, int placement) { add_object(object, to_world, placement); },
          stop);
  if (work_.fills) add_intersections();
}

void StrokeCollector::add_object(const Object& object, const Affine& to_world, int placement) {
  if (!(object.visible_to & static_cast<uint32_t>(RayKind::camera))) return;
  object_ = &object;
  object_number_ = numbers_.at(&object), placement_ = placement;
  to_world_ = to_world;
  solid_ = nullptr;
  mesh_lines_.clear();
  if (const auto* mesh = std::get_if<MeshPtr>(&object.shape); mesh && drawing_)
    mesh_lines_ = mesh_lines(**mesh, view_from(to_world.inverse()));
  const bool is_point = std::holds_alternative<Vec3>(object.shape),
             is_curve = std::holds_alternative<CurvePtr>(object.shape);
  const bool says = object.look && object.look->lines;
  cutters_.clear(), planes_.clear();
  // They stand where the object is placed: in the world, or in its group.
  const Affine placed = same_map(to_world, object.transform) ? Affine() : to_world * object.transform.inverse();
  for (const ClipPlane& plane : object.clips) {
    planes_.push_back({placed.point(plane.through), placed.normal(plane.normal), plane.cap});
    cutters_.push_back(cutter_of(planes_.back()));
  }
  if (drawing_ || says || is_point || is_curve) add_lines(says ? *object.look->lines : model_.drawing.lines);
  if (work_.fills) add_borders_of_fill(fill_of(model_, object));
  // Helpers stay whole in drawings.
  if (drawing_) cutters_.clear(), planes_.clear();
  if (object.look)
    for (const Helper& helper : object.look->helpers) {
      kind_ = helper.type;
      add_helper(helper);
    }
  if (drawing_ && !object.legend.empty()) add_legend(object);
}

void StrokeCollector::leave_out(const std::string& what) {
  if (std::find(work_.left_out.begin(), work_.left_out.end(), what) == work_.left_out.end())
    work_.left_out.push_back(what);
}

bool StrokeCollector::is_seen(const Vec3& point, const char* what) {
  if (!drawing_ || !model_.camera || model_.camera->project(to_world_.point(point)).visible_side) return true;
  leave_out(fmt::format("{} of {} at points behind the eye", what, name_of_object()));
  return false;
}

void StrokeCollector::is_incomplete() {
  ++work_.incomplete;
  const std::string name = name_of_object();
  if (std::find(work_.incomplete_objects.begin(), work_.incomplete_objects.end(), name) ==
      work_.incomplete_objects.end())
    work_.incomplete_objects.push_back(name);
}

std::string StrokeCollector::name_of_object() const {
  for (const auto& [object, number] : numbers_)
    if (number == object_number_ && !object->name.empty()) return "'" + object->name + "'";
  return "object " + std::to_string(object_number_);
}

void StrokeCollector::add_legend(const Object& object) {
  const int number = numbers_.at(&object);
  LegendEntry entry{object.legend, {}, {}};
  for (const Stroke& stroke : work_.strokes)
    if (stroke.object == number && stroke.drawn && (!entry.line || stroke.kind == "curve")) entry.line = stroke.look;
  if (!entry.line)
    for (const Mark& mark : work_.marks)
      if (mark.object == number && !entry.mark) entry.mark = mark;
  work_.legend.push_back(std::move(entry));
}

LineLook StrokeCollector::look_of(const Style& style) {
  LineLook look = look_of_style(style, pixels_, min_width_);
  look.color = rgb(color_of(style));
  return look;
}

Vec3 StrokeCollector::color_of(const Style& style) {
  if (!style.cycles) return style.color;
  auto& of_style = cycles_[style.name];
  const size_t number = of_style.emplace(object_, of_style.size()).first->second;
  return *hex_color(kPalette[number % std::size(kPalette)]);
}

void StrokeCollector::stroke(CurvePtr curve, const Style& style, const HiddenLines& hidden) {
  if (!(curve->domain().width() < kInfinity)) return;
  Stroke stroke;
  stroke.curve = std::move(curve);
  stroke.to_world = to_world_;
  stroke.look = look_of(style);
  stroke.hidden = hidden_look(model_, stroke.look, hidden, pixels_, min_width_);
  if (hidden.way == HiddenLines::Way::faded) stroke.fade = kFadeOfLayer;
  stroke.max_layers = hidden.max_layers;
  stroke.object = object_number_, stroke.placement = placement_;
  stroke.met = met_, stroke.met_placement = met_placement_;
  stroke.order = order_++;
  stroke.kind = kind_;
  stroke.drawn = !undrawn_;
  stroke.outlines = outlines_;
  stroke.borders = borders_;
  stroke.supporting_surfaces = std::move(supporting_surfaces_);
  stroke.cusps = std::move(cusps_);
  stroke.outward_offset = std::move(outward_offset_);
  supporting_surfaces_.clear(), cusps_.clear();
  stroke.arrow_at_start = style.arrows == "start" || style.arrows == "both";
  stroke.arrow_at_end = style.arrows == "end" || style.arrows == "both";
  stroke.arrow_size = style.arrow_size;
  if (cap_) {
    supporting_surfaces_ = std::move(stroke.supporting_surfaces);
    lies_on_cap(stroke.curve, cap_);
    stroke.supporting_surfaces = std::move(supporting_surfaces_);
    supporting_surfaces_.clear();
  }
  for (const Interval& t : kept_parts(stroke)) add_part(stroke, t);
}

// Between steps and poles there is nothing; heads of arrows are at the ends of the whole.
void StrokeCollector::add_curve(const CurvePtr& curve, const Style& style, const HiddenLines& hidden) {
  const std::vector<CurvePtr> parts = unbroken_parts(curve);
  for (const CurvePtr& part : parts) {
    Style own = style;
    const bool start = part == parts.front() && (style.arrows == "start" || style.arrows == "both"),
               end = part == parts.back() && (style.arrows == "end" || style.arrows == "both");
    own.arrows = start && end ? "both" : start ? "start" : end ? "end" : "none";
    stroke(part, own, hidden);
  }
}

void StrokeCollector::polygon(std::vector<Vec3> points, bool closed, const Style& style, const HiddenLines& hidden) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 2) return;
  stroke(std::make_shared<NurbsCurve>(polyline(points, closed && points.size() > 2)), style, hidden);
}

void StrokeCollector::mark(const Vec3& point, const std::string& sign, const Style& style, const HiddenLines& hidden) {
  const auto found = mark_sign(sign);
  if (!found || !is_seen(point, "signs")) return;  // none
  Mark mark;
  mark.point = to_world_.point(point);
  for (const ClipPlane& plane : planes_)
    if (glm::dot(mark.point - plane.through, plane.normal) > 0) return;
  mark.sign = *found;
  mark.radius = std::max(0.5 * min_width_, 0.5 * style.marker_size * pixels_);
  mark.line = look_of(style);
  mark.line.opacity = style.opacity;
  if (style.fill) mark.fill = rgb(*style.fill);
  if (hidden.way != HiddenLines::Way::drop)
    mark.hidden_opacity = mark.line.opacity * (hidden.way == HiddenLines::Way::faded ? 1.0 / 3 : 1.0);
  mark.object = object_number_;
  mark.order = order_++;
  work_.marks.push_back(mark);
}

void StrokeCollector::label(const Vec3& point, std::initializer_list<double> counters, const Helper& helper) {
  if (!drawing_ || !helper.values.has("label") || !helper.values.holds<TextTemplate>("label")) return;
  text(point, helper.values.get<TextTemplate>("label").text({counters.begin(), counters.size()}), helper,
       helper.values.has("marker") && helper.values.text("marker") != "none");
}

void StrokeCollector::text(const Vec3& point, std::string words, const Helper& helper, bool marked) {
  if (!is_seen(point, "texts")) return;
  PointText text;
  text.point = to_world_.point(point);
  text.text = std::move(words);
  text.style = helper.style;
  text.kind = helper.type;
  text.distance = 0.6 + (marked ? 0.5 * helper.style.marker_size : 0);
  if (helper.hidden.way == HiddenLines::Way::drop) text.hidden_opacity = 0;
  if (helper.hidden.way == HiddenLines::Way::faded) text.hidden_opacity = 1.0 / 3;
  text.object = object_number_;
  work_.texts.push_back(std::move(text));
}

void StrokeCollector::add_lines(const Lines& lines) {
  const bool is_drawings_own = !object_->look || !object_->look->lines;
  // Colours along a curve take the place of the line that it has by default, which would cover them.
  const bool is_colored = drawing_ && is_drawings_own && object_->look &&
                          std::any_of(object_->look->helpers.begin(), object_->look->helpers.end(),
                                      [](const Helper& helper) { return helper.type == "colored"; });
  for (const char* kind : drawing_ ? std::span<const char* const>(kLinesDrawn) : kLinesShown) {
    if (is_colored && kind == std::string_view("curve")) continue;
    const auto style = lines.styles.find(kind);
    kind_ = kind;
    const std::string_view word = kind;
    // What others are hidden by ends at all of these, drawn or not.
    outlines_ = drawing_ && (word == "boundary" || word == "sharp" || word == "silhouette");
    undrawn_ = style == lines.styles.end();
    if (undrawn_ && outlines_)
      add_kind(kind, Style(), lines);
    else if (style != lines.styles.end())
      add_kind(kind, style->second, lines);
    else if (is_drawings_own && kind == std::string_view("curve"))
      undrawn_ = false, add_kind(kind, Style(), lines);  // a model made without a scene file
  }
  undrawn_ = outlines_ = false;
}

CurvePtr StrokeCollector::shown_curve(const CurvePtr& curve) const {
  if (object_->representation != Representation::mesh || !(curve->domain().width() < kInfinity)) return curve;
  try {
    return polygon_of(*curve, mesh_tolerance(*object_, to_world_, model_.camera));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("object {}: {}", name_of_object(), error.what()));
  }
}

void StrokeCollector::add_kind(std::string_view kind, const Style& style, const Lines& lines) {
  const HiddenLines& hidden = lines.hidden_of(kind);
  if (kind == "curve") {
    if (const auto* curve = std::get_if<CurvePtr>(&object_->shape)) add_curve(shown_curve(*curve), style, hidden);
    const auto* point = std::get_if<Vec3>(&object_->shape);
    if (point && style.marker != "none") mark(*point, style.marker, style, hidden);
  } else if (kind == "silhouette") {
    add_silhouettes(view_from(to_world_.inverse()), style, hidden);
    add_mesh_lines(MeshLineKind::silhouette, style, hidden);
  } else if (kind == "section") {
    for (const SectionPlane& plane : lines.planes) add_section(object_->shape, plane, style, hidden);
  } else if (kind == "intersection") {
    for (const std::any& other : lines.with) add_intersections(entity_of(other), style, hidden);
  } else if (kind == "self_intersection") {
    if (std::holds_alternative<ShapePtr>(object_->shape)) leave_out("self-intersections of " + name_of_object());
    each_surface([&](const SurfacePtr& surface) {
      if (surface->bounded())
        add(self_intersection(surface), {surface, surface}, style, hidden);
      else
        leave_out("lines of " + name_of_object() + ", which is unbounded");
    });
  } else if (const auto* body = std::get_if<BodyPtr>(&object_->shape)) {
    if (kind == "parameter")
      for (const NetLine& line : parameter_lines(**body, {lines.at_u, lines.at_v})) add(line, style, hidden);
    else
      add_edges(**body, kind, style, hidden);
    if (kind == "sharp") add_creases(**body, style, hidden);
  } else if (const auto* shape = std::get_if<ShapePtr>(&object_->shape)) {
    if (kind == "parameter") add_parameter_lines(*shape, lines, style);
    if (kind == "sharp" || kind == "smooth" || kind == "boundary")
      add_solid(*shape, view_from(to_world_.inverse()), true, style, hidden);
  } else if (std::holds_alternative<MeshPtr>(object_->shape)) {
    if (kind == "boundary") add_mesh_lines(MeshLineKind::boundary, style, hidden);
    if (kind == "sharp") add_mesh_lines(MeshLineKind::sharp, style, hidden);
    if (kind == "smooth") add_mesh_lines(MeshLineKind::smooth, style, hidden);
  } else {
    each_surface([&](const SurfacePtr& surface) {
      if (!undrawn_ && !surface->bounded() && (kind == "parameter" || !dynamic_cast<const Plane*>(surface.get())))
        leave_out("lines of " + name_of_object() + ", which is unbounded");
      if (kind == "boundary") add_boundary(surface, style, hidden);
      if (kind == "sharp") add_creases(surface, style, hidden);
      if (kind == "parameter")
        for (const NetLine& line : parameter_lines(surface, {lines.at_u, lines.at_v})) add(line, style, hidden);
    });
  }
  if (drawing_ && (kind == "sharp" || kind == "boundary")) add_cut_edges(kind, style, hidden);
}

ViewOf StrokeCollector::seen_through(ViewOf view, const Affine& map) {
  view.direction_or_eye =
      view.central ? map.point(view.direction_or_eye) : glm::normalize(map.direction(view.direction_or_eye));
  return view;
}

void OneFaces::join(int object, const std::set<int>& faces) {
  std::set<int> firsts;
  for (const int face : faces) firsts.insert(first(object, face));
  for (const int face : firsts)
    if (face != *firsts.begin()) before_[{object, face}] = *firsts.begin();
}

int OneFaces::first(int object, int face) const {
  for (auto found = before_.find({object, face}); found != before_.end(); found = before_.find({object, face}))
    face = found->second;
  return face;
}

LineLook drawn_look(const Style& style) { return look_of_style(style, 1, 0); }

std::optional<LineLook> drawn_hidden_look(const Model& model, const LineLook& seen, const HiddenLines& hidden) {
  return hidden_look(model, seen, hidden, 1, 0);
}

int line_rank(std::string_view kind) {
  const auto found = std::find(std::begin(kLinesDrawn), std::end(kLinesDrawn), kind);
  return found == std::end(kLinesDrawn) ? -1 : static_cast<int>(found - std::begin(kLinesDrawn));
}

std::optional<Mark::Sign> mark_sign(std::string_view name) {
  const auto found = kSigns.find(name);
  return found == kSigns.end() ? std::nullopt : std::optional(found->second);
}

double millimetres_of_pixel(const Model& model) {
  if (!(model.paper.width > 0)) return kMillimetresPerInch / kPixelsPerInch;
  // By the side that is given: the other has the margins of a drawing beside the picture.
  return model.paper.auto_width ? model.paper.height / model.film.height : model.paper.width / model.film.width;
}

const Fill& fill_of(const Model& model, const Object& object) {
  return object.look && object.look->fill ? *object.look->fill : model.drawing.fill;
}

Vec3 light_of(const Fill& fill, const Camera& camera) {
  if (fill.light) return *fill.light;
  const auto before = [&](double x, double y) {
    const Ray ray = camera.ray(0.5 * camera.width() + x, 0.5 * camera.height() + y);
    return ray.origin + ray.direction;
  };
  const Vec3 middle = before(0, 0), right = glm::normalize(before(1, 0) - middle),
             up = glm::normalize(before(0, -1) - middle);
  return glm::normalize(-camera.view_direction() - kLightFromLeft * right + kLightFromAbove * up);
}

LineWork line_work(const World& world, const std::atomic<bool>* stop) {
  return StrokeCollector(world, false, stop).take();
}
LineWork drawing_work(const World& world, SolidLines* solids) {
  return StrokeCollector(world, true, nullptr, solids).take();
}

bool has_lines_in_pictures(const Object& object) {
  if (std::holds_alternative<Vec3>(object.shape) || std::holds_alternative<CurvePtr>(object.shape)) return true;
  if (!object.look) return false;
  const Look& look = *object.look;
  return std::any_of(look.helpers.begin(), look.helpers.end(),
                     [&](const Helper& helper) { return is_helper_shown(helper, object); }) ||
         (look.lines && std::any_of(look.lines->styles.begin(), look.lines->styles.end(),
                                    [](const auto& kind) { return shows(kLinesShown, kind.first); }));
}

std::vector<std::string> left_to_drawings(const std::vector<Object>& objects) {
  std::set<std::string> lines, helpers;
  each_object(objects, [&](const Object& object) {
    if (!object.look) return;
    if (object.look->lines)
      for (const auto& [kind, style] : object.look->lines->styles)
        if (!shows(kLinesShown, kind)) lines.insert(kind);
    for (const Helper& helper : object.look->helpers)
      if (!is_helper_shown(helper, object)) helpers.insert(helper.type);
  });
  std::vector<std::string> result;
  const auto add = [&](const char* what, const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    if (!text.empty()) result.push_back(std::string(what) + " (" + text + ")");
  };
  add("lines", lines);
  add("helpers", helpers);
  return result;
}

}  // namespace lekalo::render
