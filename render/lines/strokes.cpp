#include "render/lines/strokes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/curves/curve_part.h"
#include "geometry/curves/nurbs_curve.h"
#include "geometry/curves/parameter_line.h"
#include "geometry/curves/polyline.h"
#include "geometry/curves/segment.h"
#include "geometry/queries/ball_outlines.h"
#include "geometry/queries/body_contours.h"
#include "geometry/queries/box_tree.h"
#include "geometry/queries/contours.h"
#include "geometry/queries/csg_contours.h"
#include "geometry/queries/curve_intersections.h"
#include "geometry/queries/self_intersections.h"
#include "geometry/queries/trim.h"
#include "geometry/surfaces/plane.h"
#include "geometry/transformed.h"
#include "render/lines/curve_helpers.h"
#include "render/scene/color_names.h"
#include "render/scene/look.h"
#include "render/scene/objects.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr double kPixelsPerInch = 96;  // of pictures without a size on paper
// Faded lines lose so much of their opacity with each layer beyond the first.
constexpr double kFadeOfLayer = 0.6;
// Where drawings have their light from, for one of the way to the viewer.
constexpr double kLightFromLeft = 0.7, kLightFromAbove = 0.9;
// Faces meet smoothly where their normals differ by less than this: what a modeller means by it.
constexpr double kSmoothEdge = 1e-3;
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
constexpr const char* kHelpersShown[] = {"control_polygon", "control_net", "knots", "normals"};

bool shows(std::span<const char* const> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// De Casteljau's and de Boor's triangles, which are shown of curves.
bool is_triangle(const Helper& helper) { return helper.type == "de_casteljau" || helper.type == "de_boor"; }

// Evenly spaced values with both ends of the range, or without the second where it is the first again.
std::vector<double> values_in(const ParameterValues& asked, const Interval& range, bool periodic) {
  std::vector<double> values;
  if (asked.count == 1 && !periodic) return {range.middle()};
  for (int i = 0; i < asked.count; ++i)
    values.push_back(range.clamp(range.lo + range.width() * i / (periodic ? asked.count : asked.count - 1)));
  for (const double value : asked.values)
    if (range.contains(value)) values.push_back(value);
  return values;
}

// True if the opposite edges of the domain are one line of space, which may run the other way there (a Moebius band).
bool is_closed_in(const Surface& surface, HeldParameter held) {
  const Rectangle domain = surface.domain();
  const bool u = held == HeldParameter::u;
  if (const double period = u ? surface.periods().u : surface.periods().v; period > 0)
    return std::abs((u ? domain.u : domain.v).width() - period) <= 1e-9 * period;
  const Interval &range = u ? domain.u : domain.v, &along = u ? domain.v : domain.u;
  const auto at = [&](double held_at, double x) {
    const double t = along.clamp(along.lo + x * along.width());
    return u ? surface.point(held_at, t) : surface.point(t, held_at);
  };
  const double same = 1e-9 * bounds(surface).diameter();
  bool meets = true, meets_turned = true;
  for (const double x : {0.0, 0.25, 0.55, 0.8, 1.0}) {
    const Vec3 first = at(range.lo, x);
    meets = meets && glm::length(first - at(range.hi, x)) <= same;
    meets_turned = meets_turned && glm::length(first - at(range.hi, 1 - x)) <= same;
  }
  return meets || meets_turned;
}

LineLook look_of_style(const Style& style, double pixels, double least_width) {
  LineLook look;
  const double width = style.width * pixels;
  look.half_width = 0.5 * std::max(width, least_width);
  look.opacity = style.opacity * (least_width > 0 ? std::min(width / least_width, 1.0) : 1.0);
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
                                    double least_width) {
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
      if (least_width > 0) look.opacity *= std::min(1.0, seen.half_width);
      look.half_width = std::max(0.5 * least_width, 0.5 * seen.half_width);
      return look;
    case HiddenLines::Way::faded:
      look.opacity /= 3;
      return look;
    case HiddenLines::Way::styled:
      return look_of_style(hidden.style, pixels, least_width);
  }
  return std::nullopt;
}

class Collector {
 public:
  explicit Collector(const World& world, bool drawing) : model_(world.model()), drawing_(drawing) {
    pixels_ = drawing ? 1 : 1 / millimetres_of_pixel(model_);
    least_width_ = drawing ? 0 : 1;
    if (model_.camera) {
      const Camera& camera = *model_.camera;
      view_.central = !camera.is_parallel();
      view_.direction_or_eye =
          view_.central ? camera.ray(0.5 * camera.width(), 0.5 * camera.height()).origin : camera.view_direction();
    }
    for (size_t i = 0; i < world.objects().size(); ++i) numbers_.emplace(world.objects()[i], static_cast<int>(i));
    work_.fills = drawing && model_.camera && model_.drawing.ground == Ground::fill;
    add(model_.objects, Affine());
    if (work_.fills) add_meetings();
  }
  LineWork take() { return std::move(work_); }

 private:
  void add(const std::vector<Object>& objects, const Affine& to_world) {
    for (const Object& object : objects) {
      const Affine map = to_world * object.transform;
      if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
        add((*group)->objects, map);
        continue;
      }
      if (!(object.visible_to & static_cast<uint32_t>(RayKind::camera))) continue;
      object_ = &object;
      object_number_ = numbers_.at(&object);
      to_world_ = map;
      solid_ = nullptr;
      if (drawing_ && std::holds_alternative<MeshPtr>(object.shape)) leave_out("lines of meshes");
      const bool is_point = std::holds_alternative<Vec3>(object.shape),
                 is_curve = std::holds_alternative<CurvePtr>(object.shape);
      const bool says = object.look && object.look->lines;
      if (drawing_ || says || is_point || is_curve) add_lines(says ? *object.look->lines : model_.drawing.lines);
      if (work_.fills) add_borders_of_fill(fill_of(model_, object));
      if (object.look)
        for (const Helper& helper : object.look->helpers) {
          kind_ = helper.type;
          add_helper(helper);
        }
      if (drawing_ && !object.legend.empty()) add_legend(object);
    }
  }

  void leave_out(const std::string& what) {
    if (std::find(work_.left_out.begin(), work_.left_out.end(), what) == work_.left_out.end())
      work_.left_out.push_back(what);
  }

  // The line or the sign that stands for an object: what there is of it first.
  void add_legend(const Object& object) {
    const int number = numbers_.at(&object);
    LegendEntry entry{object.legend, {}, {}};
    for (const Stroke& stroke : work_.strokes)
      if (stroke.object == number && stroke.drawn && (!entry.line || stroke.kind == "curve")) entry.line = stroke.look;
    if (!entry.line)
      for (const Mark& mark : work_.marks)
        if (mark.object == number && !entry.mark) entry.mark = mark;
    work_.legend.push_back(std::move(entry));
  }

  LineLook look_of(const Style& style) {
    LineLook look = look_of_style(style, pixels_, least_width_);
    look.color = rgb(color_of(style));
    return look;
  }

  // Of the palette, the next colour for each object that is drawn in the style.
  Vec3 color_of(const Style& style) {
    if (!style.cycles) return style.color;
    auto& of_style = cycles_[style.name];
    const size_t number = of_style.emplace(object_, of_style.size()).first->second;
    return *hex_color(kPalette[number % std::size(kPalette)]);
  }

  void stroke(CurvePtr curve, const Style& style, const HiddenLines& hidden) {
    if (!(curve->domain().width() < kInfinity)) return;
    Stroke stroke;
    stroke.curve = std::move(curve);
    stroke.to_world = to_world_;
    stroke.look = look_of(style);
    stroke.hidden = hidden_look(model_, stroke.look, hidden, pixels_, least_width_);
    if (hidden.way == HiddenLines::Way::faded) stroke.fade = kFadeOfLayer;
    stroke.most_layers = hidden.most_layers;
    stroke.object = object_number_;
    stroke.order = order_++;
    stroke.kind = kind_;
    stroke.drawn = !undrawn_;
    stroke.outlines = outlines_;
    stroke.borders = borders_;
    stroke.hosts = std::move(hosts_);
    stroke.cusps = std::move(cusps_);
    stroke.aside = std::move(aside_);
    hosts_.clear(), cusps_.clear();
    stroke.arrow_at_start = style.arrows == "start" || style.arrows == "both";
    stroke.arrow_at_end = style.arrows == "end" || style.arrows == "both";
    stroke.arrow_size = style.arrow_size;
    work_.strokes.push_back(std::move(stroke));
  }

  void polygon(std::vector<Vec3> points, bool closed, const Style& style, const HiddenLines& hidden) {
    points.erase(std::unique(points.begin(), points.end()), points.end());
    while (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
    if (points.size() < 2) return;
    stroke(std::make_shared<NurbsCurve>(polyline(points, closed && points.size() > 2)), style, hidden);
  }

  void mark(const Vec3& point, const std::string& sign, const Style& style, const HiddenLines& hidden) {
    const auto found = mark_sign(sign);
    if (!found) return;  // none
    Mark mark;
    mark.point = to_world_.point(point);
    mark.sign = *found;
    mark.radius = std::max(0.5 * least_width_, 0.5 * style.marker_size * pixels_);
    mark.line = look_of(style);
    mark.line.opacity = style.opacity;
    if (style.fill) mark.fill = rgb(*style.fill);
    if (hidden.way != HiddenLines::Way::drop)
      mark.hidden_opacity = mark.line.opacity * (hidden.way == HiddenLines::Way::faded ? 1.0 / 3 : 1.0);
    mark.object = object_number_;
    mark.order = order_++;
    work_.marks.push_back(mark);
  }

  // The label of a helper's point, for these counters.
  void label(const Vec3& point, std::initializer_list<double> counters, const Helper& helper) {
    if (!drawing_ || !helper.values.has("label") || !helper.values.holds<TextTemplate>("label")) return;
    text(point, helper.values.get<TextTemplate>("label").text({counters.begin(), counters.size()}), helper,
         helper.values.has("marker") && helper.values.text("marker") != "none");
  }
  void text(const Vec3& point, std::string words, const Helper& helper, bool marked) {
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

  void add_lines(const Lines& lines) {
    const bool is_drawings_own = !object_->look || !object_->look->lines;
    for (const char* kind : drawing_ ? std::span<const char* const>(kLinesDrawn) : kLinesShown) {
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

  void add_kind(std::string_view kind, const Style& style, const Lines& lines) {
    if (kind == "curve") {
      if (const auto* curve = std::get_if<CurvePtr>(&object_->shape)) stroke(*curve, style, lines.hidden);
      if (const auto* point = std::get_if<Vec3>(&object_->shape))
        mark(*point, style.marker == "none" ? "dot" : style.marker, style, lines.hidden);
    } else if (kind == "silhouette") {
      add_silhouettes(view_from(to_world_.inverse()), style, lines.hidden);
    } else if (kind == "section") {
      for (const SectionPlane& plane : lines.planes) add_section(plane, style, lines.hidden);
    } else if (kind == "intersection") {
      for (const std::any& other : lines.with) add_intersections(entity_of(other), style, lines.hidden);
    } else if (kind == "self_intersection") {
      each_surface([&](const SurfacePtr& surface) {
        add(self_intersection(surface), {surface, surface}, style, lines.hidden);
      });
    } else if (const auto* body = std::get_if<BodyPtr>(&object_->shape)) {
      if (kind == "parameter")
        add_parameter_lines(**body, lines, style);
      else
        add_edges(**body, kind, style, lines.hidden);
    } else if (const auto* shape = std::get_if<ShapePtr>(&object_->shape)) {
      if (kind == "sharp") add_solid(*shape, view_from(to_world_.inverse()), true, style, lines.hidden);
    } else {
      each_surface([&](const SurfacePtr& surface) {
        if (kind == "boundary") add_boundary(surface, style, lines.hidden);
        if (kind == "parameter")
          for (const HeldParameter held : {HeldParameter::u, HeldParameter::v})
            add_parameter_lines(surface, held, held == HeldParameter::u ? lines.at_u : lines.at_v, style, lines.hidden);
      });
    }
  }

  template <class Visit>
  void each_surface(const Visit& visit) const {
    if (const auto* surface = std::get_if<SurfacePtr>(&object_->shape)) visit(*surface);
    if (const auto* set = std::get_if<SurfaceSet>(&object_->shape))
      for (const SurfacePtr& surface : *set) visit(surface);
  }
  // Those of bodies too.
  template <class Visit>
  void each_face(const Visit& visit) const {
    each_surface(visit);
    if (const auto* body = std::get_if<BodyPtr>(&object_->shape))
      for (const Face& face : (*body)->faces) visit(face.surface);
  }

  void add_boundary(const SurfacePtr& surface, const Style& style, const HiddenLines& hidden) {
    if (!surface->bounded()) return;
    const Rectangle domain = surface->domain();
    const DegenerateEdges edges = surface->degenerate_edges();
    const auto edge = [&](HeldParameter held, double at) {
      lies_on_line(surface, held, at);
      stroke(std::make_shared<ParameterLine>(surface, held, at), style, hidden);
    };
    if (!is_closed_in(*surface, HeldParameter::u)) {
      if (!edges.u_min) edge(HeldParameter::u, domain.u.lo);
      if (!edges.u_max) edge(HeldParameter::u, domain.u.hi);
    }
    if (!is_closed_in(*surface, HeldParameter::v)) {
      if (!edges.v_min) edge(HeldParameter::v, domain.v.lo);
      if (!edges.v_max) edge(HeldParameter::v, domain.v.hi);
    }
  }

  void add_parameter_lines(const SurfacePtr& surface, HeldParameter held, const ParameterValues& asked,
                           const Style& style, const HiddenLines& hidden) {
    if (!surface->bounded()) return;
    const Rectangle domain = surface->domain();
    const bool u = held == HeldParameter::u;
    const DegenerateEdges edges = surface->degenerate_edges();
    const Interval& range = u ? domain.u : domain.v;
    for (const double at : values_in(asked, range, asked.count > 1 && is_closed_in(*surface, held))) {
      if ((at == range.lo && (u ? edges.u_min : edges.v_min)) || (at == range.hi && (u ? edges.u_max : edges.v_max)))
        continue;
      lies_on_line(surface, held, at);
      stroke(std::make_shared<ParameterLine>(surface, held, at), style, hidden);
    }
  }

  // Of a body's faces, as far as the faces go.
  void add_parameter_lines(const Body& body, const Lines& lines, const Style& style) {
    for (size_t index = 0; index < body.faces.size(); ++index) {
      const Face& face = body.faces[index];
      const auto region = trim_of(body, static_cast<int>(index));
      if (!region) {
        for (const HeldParameter held : {HeldParameter::u, HeldParameter::v})
          add_parameter_lines(face.surface, held, held == HeldParameter::u ? lines.at_u : lines.at_v, style,
                              lines.hidden);
        continue;
      }
      std::vector<Curve2Ptr> borders;
      for (const int loop : face.loops)
        for (const int coedge : body.loops[loop].coedges) borders.push_back(body.coedges[coedge].image);
      for (const HeldParameter held : {HeldParameter::u, HeldParameter::v}) {
        const bool u = held == HeldParameter::u;
        const Interval range = u ? region->u_range() : region->v_range(),
                       along = u ? region->v_range() : region->u_range();
        for (const double at : values_in(u ? lines.at_u : lines.at_v, range, false)) {
          const auto place = [&](double t) { return u ? Vec3(at, t, 0) : Vec3(t, at, 0); };
          const Segment line(place(along.lo), place(along.hi));
          std::vector<double> cuts{along.lo, along.hi};
          for (const Curve2Ptr& border : borders)
            for (const CurveMeeting& meeting : intersect(line, *border).points)
              cuts.push_back(along.lo + meeting.s * along.width());
          std::sort(cuts.begin(), cuts.end());
          for (size_t k = 0; k + 1 < cuts.size(); ++k) {
            const Interval t{cuts[k], cuts[k + 1]};
            const Vec3 middle = place(t.middle());
            if (t.width() <= 1e-9 * along.width() || !region->contains(middle.x, middle.y)) continue;
            lies_on_line(face.surface, held, at, t);
            stroke(std::make_shared<ParameterLine>(face.surface, held, at, t), style, lines.hidden);
          }
        }
      }
    }
  }

  void add_edges(const Body& body, std::string_view kind, const Style& style, const HiddenLines& hidden) {
    for (const Edge& edge : body.edges)
      if (edge.kind == EdgeKind::regular && edge.curve && kind_of(body, edge) == kind) {
        if (drawing_)
          for (const int c : edge.coedges) {
            const Coedge& coedge = body.coedges[c];
            hosts_.push_back({body.faces[body.loops[coedge.loop].face].surface, coedge.image});
          }
        stroke(edge.curve, style, hidden);
      }
  }

  // The line of a surface on which its parameter is held.
  void lies_on_line(const SurfacePtr& surface, HeldParameter held, double at) {
    lies_on_line(surface, held, at, held == HeldParameter::u ? surface->domain().v : surface->domain().u);
  }
  void lies_on_line(const SurfacePtr& surface, HeldParameter held, double at, const Interval& along) {
    if (!drawing_) return;
    const bool u = held == HeldParameter::u;
    const Vec3 from = u ? Vec3(at, along.lo, 0) : Vec3(along.lo, at, 0),
               to = u ? Vec3(at, along.hi, 0) : Vec3(along.hi, at, 0);
    NurbsCurveForm form;
    form.degree = 1;
    form.knots = {along.lo, along.lo, along.hi, along.hi};
    form.points = {Vec4(from, 1), Vec4(to, 1)};
    hosts_.push_back({surface, std::make_shared<NurbsCurve>(form)});
  }

  void add(const Contours& contours, const std::vector<SurfacePtr>& surfaces, const Style& style,
           const HiddenLines& hidden) {
    if (!contours.complete) ++work_.incomplete;
    for (const Contour& contour : contours.branches) {
      for (size_t k = 0; k < contour.images.size() && k < surfaces.size(); ++k)
        hosts_.push_back({surfaces[k], contour.images[k]});
      cusps_ = contour.cusps;
      stroke(contour.curve, style, hidden);
    }
  }
  void add(const BodyContours& contours, const Body& body, const Style& style, const HiddenLines& hidden) {
    if (!contours.complete) ++work_.incomplete;
    for (const BodyContour& branch : contours.branches)
      for (const BodyContourPart& part : branch.parts) {
        const Interval all = part.contour.curve->domain();
        const auto add_part = [&](const Interval& t) {
          if (!(t.width() > 0)) return;
          hosts_.push_back({body.faces[part.face].surface, part.contour.images[0]});
          for (const double cusp : part.contour.cusps)
            if (t.contains(cusp)) cusps_.push_back(cusp);
          stroke(t.width() == all.width() ? part.contour.curve : std::make_shared<CurvePart>(part.contour.curve, t),
                 style, hidden);
        };
        add_part({part.t.lo, std::min(part.t.hi, all.hi)});
        if (part.t.hi > all.hi) add_part({all.lo, part.t.hi - all.width()});
      }
  }

  // The view is one of the object's own coordinates.
  void add_silhouettes(const ViewOf& view, const Style& style, const HiddenLines& hidden) {
    if (const auto* body = std::get_if<BodyPtr>(&object_->shape)) add(silhouette(**body, view), **body, style, hidden);
    if (const auto* shape = std::get_if<ShapePtr>(&object_->shape)) add_solid(*shape, view, false, style, hidden);
    each_surface([&](const SurfacePtr& surface) {
      if (!surface->bounded() || dynamic_cast<const Plane*>(surface.get())) return;
      add(silhouette(surface, view), {surface}, style, hidden);
    });
  }

  // The edges or outlines of a shape, which may have been moved as a whole: of balls, tubes, and of solids put together
  // of others.
  void add_solid(const ShapePtr& shape, ViewOf view, bool edges, const Style& style, const HiddenLines& hidden) {
    const auto* moved = dynamic_cast<const TransformedShape*>(shape.get());
    const Shape& original = moved ? *moved->original() : *shape;
    const auto* solid = dynamic_cast<const Csg*>(&original);
    const auto* tube = dynamic_cast<const Tube*>(&original);
    const auto* balls = dynamic_cast<const Balls*>(&original);
    if (!solid && !tube && !balls) {
      leave_out("outlines of implicit surfaces");
      return;
    }
    const Affine to_world = to_world_;
    if (moved) to_world_ = to_world * moved->map(), view = seen_through(view, moved->map().inverse());
    if (!solid) {
      const ShapeOutlines found = tube ? outlines(*tube, view) : outlines(*balls, view);
      if (!found.complete && !edges) ++work_.incomplete;
      for (const ShapeOutline& line : found.lines) {
        if (line.edge != edges) continue;
        aside_ = line.aside, cusps_ = line.turns;
        stroke(line.curve, style, hidden);
      }
      to_world_ = to_world;
      return;
    }
    if (solid_ != shape || solid_view_ != view.direction_or_eye) {
      solid_ = shape, solid_view_ = view.direction_or_eye;
      solid_lines_ = csg_lines(*solid, view);
      if (!solid_lines_.complete) ++work_.incomplete;
    }
    for (const CsgLine& line : solid_lines_.lines) {
      if (line.edge != edges) continue;
      for (const CsgLine::Host& host : line.hosts) hosts_.push_back({host.surface, host.image});
      cusps_ = line.cusps;
      stroke(line.curve, style, hidden);
    }
    to_world_ = to_world;
  }

  // What ends areas of a fill besides outlines, drawn or not: where the surface turns away from the light, which is its
  // outline as seen from there, and where one face goes on smoothly as another.
  void add_borders_of_fill(const Fill& fill) {
    undrawn_ = borders_ = true;
    if (fill.shading == Fill::Shading::two_tone || (fill.hatching && fill.hatching->shade_only)) {
      kind_ = "terminator";
      add_silhouettes(seen_through({false, light_of(fill, *model_.camera)}, to_world_.inverse()), Style(), {});
    }
    if (const auto* body = std::get_if<BodyPtr>(&object_->shape); body && fill.shading == Fill::Shading::gradient) {
      kind_ = "smooth";
      add_edges(**body, kind_, Style(), {});
    }
    undrawn_ = borders_ = false;
    each_face([&](const SurfacePtr& surface) {
      if (surface->bounded()) faces_.push_back({transformed(surface, to_world_), object_number_});
    });
  }

  // Where different objects go through one another.
  void add_meetings() {
    undrawn_ = borders_ = true;
    kind_ = "intersection";
    to_world_ = Affine();
    std::vector<Box3> boxes;
    for (const PlacedFace& face : faces_) boxes.push_back(bounds(*face.surface));
    const BoxTree tree(boxes);
    for (size_t k = 0; k < faces_.size(); ++k)
      tree.around(boxes[k], [&](int other) {
        const PlacedFace &a = faces_[k], &b = faces_[static_cast<size_t>(other)];
        if (static_cast<size_t>(other) <= k || a.object == b.object) return;
        object_number_ = a.object;
        add(intersect(a.surface, b.surface), {a.surface, b.surface}, Style(), {});
      });
    undrawn_ = borders_ = false;
  }

  // A view in the coordinates to which the map leads.
  static ViewOf seen_through(ViewOf view, const Affine& map) {
    view.direction_or_eye =
        view.central ? map.point(view.direction_or_eye) : glm::normalize(map.direction(view.direction_or_eye));
    return view;
  }
  ViewOf view_from(const Affine& map) const { return seen_through(view_, map); }

  void add_section(const SectionPlane& plane, const Style& style, const HiddenLines& hidden) {
    // A plane of the world in the object's coordinates.
    const Affine back = to_world_.inverse();
    const Vec3 through = back.point(plane.through), normal = glm::transpose(to_world_.linear) * plane.normal;
    if (const auto* body = std::get_if<BodyPtr>(&object_->shape))
      add(plane_section(**body, through, normal), **body, style, hidden);
    each_surface(
        [&](const SurfacePtr& surface) { add(plane_section(surface, through, normal), {surface}, style, hidden); });
  }

  void add_intersections(const Entity& other, const Style& style, const HiddenLines& hidden) {
    const auto* body = std::get_if<BodyPtr>(&object_->shape);
    if (const auto* with = std::get_if<BodyPtr>(&other)) {
      if (body) add(intersect(**body, **with), **body, style, hidden);
      each_surface([&](const SurfacePtr& surface) { add(intersect(**with, surface), **with, style, hidden); });
    } else if (const auto* with_surface = std::get_if<SurfacePtr>(&other)) {
      if (body) add(intersect(**body, *with_surface), **body, style, hidden);
      each_surface([&](const SurfacePtr& surface) {
        add(intersect(surface, *with_surface), {surface, *with_surface}, style, hidden);
      });
    }
  }

  static std::string_view kind_of(const Body& body, const Edge& edge) {
    if (edge.coedges.size() < 2) return "boundary";
    const Interval domain = edge.curve->domain();
    for (const double x : {0.23, 0.5, 0.81}) {
      const double t = domain.lo + x * domain.width();
      const auto normal = [&](int which) {
        const Coedge& coedge = body.coedges[edge.coedges[which]];
        const Vec3 uv = coedge.image->point(t);
        return body.normal(body.loops[coedge.loop].face, uv.x, uv.y);
      };
      if (glm::length(normal(0) - normal(1)) > kSmoothEdge) return "sharp";
    }
    return "smooth";
  }

  void add_helper(const Helper& helper) {
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
          if (helper.values.text("label_points") == "all" || i == 0 || i + 1 == points.size())
            label(points[i], {static_cast<double>(i)}, helper);
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
    } else if (helper.type == "comb" && curve && drawing_) {
      add_comb(**curve, helper);
    } else if (helper.type == "frames" && curve && drawing_) {
      add_frames(**curve, helper);
    }
    each_surface([&](const SurfacePtr& surface) {
      const auto form = surface->as_nurbs();
      if (helper.type == "control_net" && form) add_net(*form, surface->periods(), sign, helper);
      if (helper.type == "knots" && form)
        for (const HeldParameter held : {HeldParameter::u, HeldParameter::v}) {
          const auto& list = held == HeldParameter::u ? form->knots_u : form->knots_v;
          const std::set<double> knots(list.begin(), list.end());
          add_parameter_lines(surface, held, {0, {knots.begin(), knots.end()}}, helper.style, helper.hidden);
        }
      if (helper.type == "normals" && surface->bounded()) add_normals(*surface, helper);
    });
  }

  // De Boor's points of each level (Golovanov 2016, 2.9), which for a Bezier curve are de Casteljau's:
  //
  //   d_i^r = (1 - a) d_(i-1)^(r-1) + a d_i^(r-1),   a = (t - t_i)/(t_(i+p-r+1) - t_i)
  void add_triangle(const NurbsCurveForm& form, const std::string& sign, const Helper& helper) {
    const int p = form.degree, last = static_cast<int>(form.points.size()) - 1;
    const double t = helper.values.number("t");
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
      for (size_t i = 0; i < shown.size(); ++i)
        label(shown[i],
              {static_cast<double>(i + (form.degree + 1 == static_cast<int>(form.points.size()) ? 0 : span - p)),
               static_cast<double>(level)},
              helper);
    }
  }

  // A periodic direction repeats its first points, as many as the degree.
  static int distinct(size_t count, int degree, bool periodic) {
    return static_cast<int>(count) - (periodic ? degree : 0);
  }

  static std::vector<Vec3> control_points(const std::vector<Vec4>& points, int first, int step, int count) {
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
      const Vec4& p = points[first + static_cast<size_t>(i) * step];
      if (p.w != 0) result.push_back(Vec3(p) / p.w);  // else at infinity
    }
    return result;
  }

  void add_net(const NurbsSurfaceForm& form, const Periods& periods, const std::string& sign, const Helper& helper) {
    const bool closed_u = periods.u > 0, closed_v = periods.v > 0;
    const int rows = distinct(form.count_u(), form.degree_u, closed_u),
              columns = distinct(form.count_v(), form.degree_v, closed_v);
    std::vector<std::vector<Vec3>> all;
    for (int i = 0; i < rows; ++i) {
      all.push_back(control_points(form.points, i * form.count_v(), 1, columns));
      polygon(all.back(), closed_v, helper.style, helper.hidden);
    }
    for (int j = 0; j < columns; ++j)
      polygon(control_points(form.points, j, form.count_v(), rows), closed_u, helper.style, helper.hidden);
    const bool corners = helper.values.text("label_points") == "corners";
    for (size_t i = 0; i < all.size(); ++i)
      for (size_t j = 0; j < all[i].size(); ++j) {
        mark(all[i][j], sign, helper.style, helper.hidden);
        const bool corner = (i == 0 || i + 1 == all.size()) && (j == 0 || j + 1 == all[i].size());
        if (corner || !corners) label(all[i][j], {static_cast<double>(i), static_cast<double>(j)}, helper);
      }
  }

  void add_comb(const Curve& curve, const Helper& helper) {
    const CurvatureComb comb = curvature_comb(curve, helper.values.integer("count"), helper.values.number("scale"));
    for (size_t k = 0; k < comb.feet.size(); ++k)
      if (comb.tips[k] != comb.feet[k])
        stroke(std::make_shared<Segment>(comb.feet[k], comb.tips[k]), helper.style, helper.hidden);
    if (helper.values.boolean("envelope")) polygon(comb.tips, false, helper.style, helper.hidden);
  }

  void add_frames(const Curve& curve, const Helper& helper) {
    const std::vector<Frame> frames = helper_frames(curve, helper);
    Style style = helper.style;
    style.arrows = "end";
    const double length = helper.values.number("length");
    const std::string& named = helper.values.text("label");
    for (size_t k = 0; k < frames.size(); ++k) {
      const bool names = named == "all" || (named == "first" && k == 0) || (named == "last" && k + 1 == frames.size());
      const auto arrow = [&](const Vec3& axis, const char* name) {
        const Vec3 tip = frames[k].origin + length * axis;
        stroke(std::make_shared<Segment>(frames[k].origin, tip), style, helper.hidden);
        if (names) text(tip, name, helper, false);
      };
      arrow(frames[k].z, "$\\mathbf{t}$");
      arrow(frames[k].x, "$\\mathbf{n}$");
      arrow(frames[k].y, "$\\mathbf{b}$");
    }
  }

  void add_normals(const Surface& surface, const Helper& helper) {
    const Rectangle domain = surface.domain();
    const double length = helper.values.number("length");
    for (const double u :
         values_in(helper.values.get<ParameterValues>("at_u"), domain.u, is_closed_in(surface, HeldParameter::u)))
      for (const double v :
           values_in(helper.values.get<ParameterValues>("at_v"), domain.v, is_closed_in(surface, HeldParameter::v))) {
        const Vec3 foot = surface.point(u, v);
        stroke(std::make_shared<Segment>(foot, foot + length * surface.normal(u, v)), helper.style, helper.hidden);
      }
  }

  const Model& model_;
  bool drawing_;
  double pixels_ = 1;       // of a millimetre on the page
  double least_width_ = 1;  // of lines
  ViewOf view_;
  std::map<const Object*, int> numbers_;
  std::map<std::string, std::map<const Object*, size_t>> cycles_;
  LineWork work_;
  int order_ = 0;
  // What is being added.
  const Object* object_ = nullptr;
  int object_number_ = 0;
  Affine to_world_;
  std::string kind_;
  bool undrawn_ = false, outlines_ = false, borders_ = false;
  std::vector<Stroke::Host> hosts_;  // of the next stroke
  std::vector<double> cusps_;        // likewise
  CurvePtr aside_;                   // likewise
  ShapePtr solid_;                   // the last one, and its lines as seen so
  Vec3 solid_view_{0};
  CsgLines solid_lines_;
  // Of fills: all faces in the world.
  struct PlacedFace {
    SurfacePtr surface;
    int object;
  };
  std::vector<PlacedFace> faces_;
};

}  // namespace

LineLook drawn_look(const Style& style) { return look_of_style(style, 1, 0); }

std::optional<LineLook> drawn_hidden_look(const Model& model, const LineLook& seen, const HiddenLines& hidden) {
  return hidden_look(model, seen, hidden, 1, 0);
}

std::optional<Mark::Sign> mark_sign(std::string_view name) {
  const auto found = kSigns.find(name);
  return found == kSigns.end() ? std::nullopt : std::optional(found->second);
}

double millimetres_of_pixel(const Model& model) {
  return model.paper.width > 0 ? model.paper.width / model.film.width : kMillimetresPerInch / kPixelsPerInch;
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

LineWork line_work(const World& world) { return Collector(world, false).take(); }
LineWork drawing_work(const World& world) { return Collector(world, true).take(); }

std::vector<std::string> left_to_drawings(const std::vector<Object>& objects) {
  std::set<std::string> lines, helpers;
  const auto visit = [&](const auto& self, const std::vector<Object>& list) -> void {
    for (const Object& object : list) {
      if (const auto* group = std::get_if<GroupPtr>(&object.shape)) self(self, (*group)->objects);
      if (!object.look) continue;
      if (object.look->lines)
        for (const auto& [kind, style] : object.look->lines->styles)
          if (!shows(kLinesShown, kind)) lines.insert(kind);
      for (const Helper& helper : object.look->helpers)
        if (!shows(kHelpersShown, helper.type) &&
            !(is_triangle(helper) && std::holds_alternative<CurvePtr>(object.shape)))
          helpers.insert(helper.type);
    }
  };
  visit(visit, objects);
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
