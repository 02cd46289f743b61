#include "render/drawing/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "geometry/queries/rays/fitted_pieces.h"
#include "render/cameras/framed_content.h"
#include "render/cameras/window.h"
#include "render/drawing/annotations/annotations.h"
#include "render/drawing/annotations/detail_circle.h"
#include "render/drawing/annotations/label_placement.h"
#include "render/drawing/areas/fills.h"
#include "render/drawing/page/graph_axes.h"
#include "render/drawing/page/legend.h"
#include "render/drawing/page/line_groups.h"
#include "render/drawing/page/page_edges.h"
#include "render/drawing/page/panel_layout.h"
#include "render/drawing/paths/overlaps.h"
#include "render/film/render.h"
#include "render/image/display.h"
#include "render/model/section.h"
#include "render/scene/values/diagnostics.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kPoint = 1e-3;   // millimetres: a line that is seen end-on
constexpr double kFitted = 0.01;  // pixels: how far a path may be from its curve
// Ends of lines nearer in space than this, of the scene's radius, are one.
constexpr double kJoined = 1e-8;
// Lines are cut so far outside of a graph or a panel, for their own width.
constexpr double kClipFree = 0.35;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void add_once(std::string what, std::vector<std::string>& all) {
  if (std::find(all.begin(), all.end(), what) == all.end()) all.push_back(std::move(what));
}

// Whether a box about a line is outside of the square about the circle: what is cut off whole is not written.
bool is_apart(const Path& path, double half_width, const PageCircle& circle) {
  SheetBox box;
  box.include(path.from);
  for (const PathStep& step : path.steps) {
    box.include(step.to);
    if (step.kind == PathStep::Kind::curve) box.include(step.first), box.include(step.second);
    if (step.kind != PathStep::Kind::arc) continue;
    const PictureEllipse& ellipse = step.ellipse;
    const Vec2 half = glm::abs(ellipse.x) + glm::abs(ellipse.y);
    box.include(ellipse.center - half), box.include(ellipse.center + half);
  }
  const Vec2 reach(circle.radius + half_width);
  return glm::any(glm::lessThan(box.hi, circle.center - reach)) ||
         glm::any(glm::greaterThan(box.lo, circle.center + reach));
}

// What of the objects only lines show is not rendered under them. Copies of a group stay copies of one.
class WithoutLines {
 public:
  std::vector<Object> of(const std::vector<Object>& objects) {
    std::vector<Object> kept;
    for (Object object : objects) {
      if (std::holds_alternative<CurvePtr>(object.shape) || std::holds_alternative<Vec3>(object.shape)) continue;
      if (auto* group = std::get_if<GroupPtr>(&object.shape)) *group = of(*group);
      object.look = nullptr;
      kept.push_back(std::move(object));
    }
    return kept;
  }

 private:
  GroupPtr of(const GroupPtr& group) {
    const auto known = groups_.find(group.get());
    if (known != groups_.end()) return known->second;
    return groups_[group.get()] = std::make_shared<const Group>(Group{of(group->objects)});
  }
  std::unordered_map<const Group*, GroupPtr> groups_;
};

// Draws one view onto the sheet.
class ViewDrawing {
 public:
  ViewDrawing(std::shared_ptr<const Model> model, const View& view, bool clipped, const FigureOptions& options,
              Figure& figure)
      : model_(std::move(model)), view_(view), clipped_(clipped), options_(options), figure_(figure), world_(model_) {
    figure_.seconds_of_world += seconds_since(begin_);
    if (const DetailPtr detail = detail_of(model_->drawing)) circle_ = circle_of(view_, *detail);
  }

  void draw(SolidLines& solids) {
    const auto begin = std::chrono::steady_clock::now();
    LineWork work = drawing_work(world_, &solids);
    figure_.statistics.seconds_of_lines += seconds_since(begin);
    const std::vector<LegendEntry> legend = std::move(work.legend);
    PageWork page;
    view_.scale = scale_of_ground();
    add_annotations(view_, work, page);
    if (!model_->drawing.title.empty()) add_title(view_, under_title(), page);
    note_left_out(std::move(work.left_out));
    const OneFaces one_faces = std::move(work.one_faces);
    const VisibleLines lines = visible_lines(world_, std::move(work), options_.progress);
    add_statistics(lines);
    for (const Object* object : world_.objects()) names_.push_back(object->name);
    if (model_->drawing.ground == Ground::shaded) add_ground();
    if (model_->drawing.ground == Ground::fill || has_hatched_cuts(model_->objects)) add_fills(lines, one_faces);
    // What is hidden lies under what is seen, which is known first.
    SheetGroup seen = line_paths(lines, false), hidden = line_paths(lines, true);
    SheetGroup marks = marks_of(lines);
    for (const SheetItem& item : page.shapes) add_obstacles(item);
    GraphWork graph = graph_axes(view_, legend, obstacles_);
    note_left_out(std::move(graph.left_out));
    for (std::string& what : graph.covered) add_once(std::move(what), figure_.cut_off);
    append(std::move(graph.under));
    add_group(std::move(hidden)), add_group(std::move(seen));
    append(std::move(graph.over));
    add_group(std::move(marks));
    append(std::move(page.shapes));
    std::vector<Label> labels = std::move(page.labels);
    labels.insert(labels.end(), std::make_move_iterator(graph.labels.begin()),
                  std::make_move_iterator(graph.labels.end()));
    add_texts(lines, labels);
  }

 private:
  // For those who ask: the integrator looks at the scene once more.
  std::optional<PictureScale> scale_of_ground() const {
    const std::vector<Annotation>& all = model_->drawing.annotations;
    if (!model_->integrator || !std::any_of(all.begin(), all.end(), tells_scale_of_ground)) return std::nullopt;
    const IntegratorPtr prepared = model_->integrator->prepared(world_);
    return prepared ? prepared->scale() : std::nullopt;
  }

  // As far as the picture shows it.
  SheetBox under_title() const {
    const SheetBox all = box_under_title(*model_, FramedContent(model_->objects), view_.camera, view_.millimetres);
    if (!(all.lo.x <= all.hi.x)) return all;
    const Vec2 size(view_.width(), view_.height());
    return {view_.at + glm::clamp(all.lo, Vec2(0), size), view_.at + glm::clamp(all.hi, Vec2(0), size)};
  }

  void append(std::vector<SheetItem> items) {
    for (SheetItem& item : items) figure_.sheet.items.push_back(std::move(item));
  }

  void add_group(SheetGroup group) {
    if (!group.items.empty()) figure_.sheet.items.push_back(std::move(group));
  }

  void note_left_out(std::vector<std::string> left_out) {
    for (std::string& what : left_out) add_once(std::move(what), figure_.left_out);
  }

  void add_statistics(const VisibleLines& lines) {
    LineStatistics& sum = figure_.statistics;
    const LineStatistics& one = lines.statistics;
    sum.lines += one.lines, sum.pieces += one.pieces, sum.crossings += one.crossings, sum.rays += one.rays;
    sum.seconds_of_lines += one.seconds_of_lines, sum.seconds_of_crossings += one.seconds_of_crossings;
    sum.seconds_of_rays += one.seconds_of_rays;
    figure_.incomplete += lines.incomplete;
    for (const std::string& name : lines.incomplete_objects) add_once(name, figure_.incomplete_objects);
  }

  // The picture as rendered, pixel by pixel where the view has it.
  void add_ground() {
    const auto begin = std::chrono::steady_clock::now();
    auto model = std::make_shared<Model>(*model_);
    model->objects = WithoutLines().of(model_->objects);
    model->film.width = view_.camera.width(), model->film.height = view_.camera.height();
    model->film.crop = {};
    model->film.layers = {"color"};
    RenderOptions settings;
    settings.threads = options_.threads;
    if (options_.rendering) settings.progress = [&](double done, uint64_t) { options_.rendering(done); };
    const World world(model, false);
    const RenderResult rendered = render(world, settings);
    for (const std::string& note : rendered.notes) add_once(note, figure_.notes);
    DisplayTransform transform;
    for (const OutputFile& file : model->outputs)
      if (file.kind == "render" && file.path.ends_with(".png")) transform = file.display;
    SheetPicture picture;
    picture.at = view_.at;
    picture.width = view_.width(), picture.height = view_.height();
    picture.picture = std::make_shared<const DisplayImage>(to_display(rendered.image, transform).image);
    SheetGroup ground{"ground", "", {}, {}, {picture}};
    if (circle_) clip(ground);
    add_group(std::move(ground));
    figure_.seconds_of_ground += seconds_since(begin);
  }

  void add_fills(const VisibleLines& lines, const OneFaces& one_faces) {
    const auto begin = std::chrono::steady_clock::now();
    Fills fills = fills_of(world_, view_, lines, one_faces, kFitted);
    figure_.open_areas += fills.open;
    SheetGroup all{"fills", "", {}, {}, std::move(fills.items)};
    clip(all);
    add_group(std::move(all));
    figure_.seconds_of_ground += seconds_since(begin);
  }

  void clip(SheetGroup& group) const {
    if (circle_) {
      group.clip_at = circle_->center - Vec2(circle_->radius);
      group.clip_size = Vec2(2 * circle_->radius);
      group.clip_is_round = true;
      return;
    }
    if (!clipped_ && !sticks_out()) return;
    group.clip_at = view_.at - Vec2(kClipFree);
    group.clip_size = Vec2(view_.width(), view_.height()) + Vec2(2 * kClipFree);
  }

  // Whether a line goes on beyond the picture: how far is chance.
  bool sticks_out() const {
    return std::any_of(obstacles_.segments.begin(), obstacles_.segments.end(),
                       [&](const auto& segment) { return is_beyond(segment.first) || is_beyond(segment.second); });
  }
  bool is_beyond(const Vec2& place) const {
    const Vec2 off = place - view_.at;
    return !(off.x > -kClipFree && off.y > -kClipFree && off.x < view_.width() + kClipFree &&
             off.y < view_.height() + kClipFree);
  }
  // Where the lines of objects are cut there is nothing that belongs to them.
  bool is_cut_off(const Vec2& place) const {
    return circle_ ? glm::length(place - circle_->center) > circle_->radius : clipped_ && is_beyond(place);
  }

  std::string name_of(int object) const { return object < 0 ? std::string() : names_[static_cast<size_t>(object)]; }

  // Where, on the way from the piece's end to its middle, the line is so far from the end's place.
  static double shortened(const VisibleLine& line, double end, double other, double distance) {
    const Vec2 tip = line.curve->place(end).p;
    double near = end, far = 0.5 * (end + other);
    if (glm::length(line.curve->place(far).p - tip) < distance) return far;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (near + far);
      (glm::length(line.curve->place(middle).p - tip) < distance ? near : far) = middle;
    }
    return far;
  }

  SheetGroup line_paths(const VisibleLines& lines, bool hidden) {
    struct Candidate {
      const VisibleLine* line;
      VisiblePiece piece;
      int rank;
      double depth;  // of its middle
      DrawnLines drawn;
    };
    // From the last, which lies over the others.
    std::vector<Candidate> all;
    for (auto line = lines.lines.rbegin(); line != lines.lines.rend(); ++line) {
      if (!line->stroke.drawn || (hidden && !line->stroke.hidden)) continue;
      for (const VisiblePiece& piece : line->pieces)
        if ((piece.layers > 0) == hidden && piece.layers <= line->stroke.max_layers)
          all.push_back({&*line,
                         piece,
                         line_rank(line->stroke.kind),
                         view_.camera.project(line->curve->tangent(piece.t.middle()).origin).depth,
                         {}});
    }
    // Of lines that lie on one another in the picture edges are drawn, not the parameter lines along them; of one kind
    // what is nearer, so that the edges of a face that is seen straight on are its own and meet in its corners.
    std::vector<Candidate*> order;
    for (Candidate& one : all) order.push_back(&one);
    std::stable_sort(order.begin(), order.end(), [](const Candidate* a, const Candidate* b) {
      return a->rank != b->rank ? a->rank > b->rank : a->depth < b->depth;
    });
    for (Candidate* one : order) one->drawn = drawn_piece(*one->line, one->piece);
    std::vector<DrawnLines> found;
    for (Candidate& one : all)
      if (!one.drawn.paths.empty() || !one.drawn.heads.empty()) found.push_back(std::move(one.drawn));
    SheetGroup result = line_groups(std::move(found), hidden, kJoined * world_.radius(), kFitted * view_.millimetres);
    clip(result);
    return result;
  }

  // A stretch of a line as far as nothing that has been drawn lies over it, with arrow heads.
  DrawnLines drawn_piece(const VisibleLine& line, const VisiblePiece& piece) {
    const Stroke& stroke = line.stroke;
    const bool hidden = piece.layers > 0;
    // The number of layers before it is one of its classes.
    DrawnLines drawn;
    drawn.object = stroke.object, drawn.name = name_of(stroke.object), drawn.line = stroke.kind;
    drawn.kind = hidden ? fmt::format("{} hidden layers-{}", stroke.kind, piece.layers) : stroke.kind;
    drawn.pen = hidden ? *stroke.hidden : stroke.look;
    if (hidden) drawn.pen.opacity *= std::pow(stroke.fade, piece.layers - 1);
    const Interval domain = stroke.curve->domain();
    Interval t = piece.t;
    const auto head = [&](bool at_end) {
      const double end = at_end ? t.hi : t.lo, other = at_end ? t.lo : t.hi;
      const Vec2 tip = view_.place(line.curve->place(end).p), rest = view_.place(line.curve->place(other).p);
      const Vec2 middle = view_.place(line.curve->place(0.5 * (end + other)).p);  // closed lines end where they begin
      const double reach = std::max(glm::length(tip - rest), glm::length(tip - middle));
      const double size = std::min(stroke.arrow_size, 0.6 * reach);
      if (!(size > 0.05)) return;
      const double back = shortened(line, end, other, size / view_.millimetres);
      const Vec2 way = tip - view_.place(line.curve->place(back).p);
      if (!(glm::length(way) > 0)) return;
      drawn.heads.push_back(arrow_head(tip, glm::normalize(way), size, drawn.pen));
      add_obstacles(drawn.heads.back());
      (at_end ? t.hi : t.lo) = shortened(line, end, other, shortened_by(size) / view_.millimetres);
    };
    if (stroke.arrow_at_end && piece.t.hi == domain.hi) head(true);
    if (stroke.arrow_at_start && piece.t.lo == domain.lo) head(false);
    std::vector<double> breaks;
    for (const CurvePiece& one : stroke.curve->pieces()) breaks.push_back(one.domain.lo);
    const Path whole = view_.placed(fitted_path(*line.curve, t, breaks, kFitted));
    // Without caps it shows nothing.
    if (drawn.pen.cap == LineLook::Cap::butt && is_point(whole, kPoint)) return drawn;
    if (circle_ && is_apart(whole, drawn.pen.half_width, *circle_)) return drawn;
    const Overlaps::Pen pen{drawn.pen.half_width, drawn.pen.opacity, drawn.pen.dash.empty(), hidden, stroke.object};
    for (Path& path : overlaps_.left_of(whole, pen)) {
      add_obstacles(path);
      // Where it is cut, or has a head, nothing goes on.
      PathInSpace part;
      if (t.lo == piece.t.lo && path.from == whole.from) part.begin = line.curve->tangent(t.lo).origin;
      if (t.hi == piece.t.hi && path.end() == whole.end()) part.end = line.curve->tangent(t.hi).origin;
      part.path = std::move(path);
      drawn.paths.push_back(std::move(part));
    }
    return drawn;
  }

  void add_obstacles(const Path& path) {
    Vec2 at = path.from;
    for (const PathStep& step : path.steps) {
      const int parts = step.kind == PathStep::Kind::line ? 1 : 8;
      const Vec2 begin = at;
      for (int k = 1; k <= parts; ++k) {
        const Vec2 next = point_on(begin, step, static_cast<double>(k) / parts);
        obstacles_.segments.emplace_back(at, next);
        at = next;
      }
    }
    if (path.closed && at != path.from) obstacles_.segments.emplace_back(at, path.from);
  }

  void add_obstacles(const SheetItem& item) {
    if (const auto* group = std::get_if<SheetGroup>(&item))
      for (const SheetItem& one : group->items) add_obstacles(one);
    if (const auto* path = std::get_if<SheetPath>(&item))
      for (const Path& one : path->parts) add_obstacles(one);
  }

  SheetGroup marks_of(const VisibleLines& lines) {
    SheetGroup all{"marks", "", {}, {}, {}};
    for (const VisibleMark& visible : lines.marks) {
      const double opacity = visible.layers > 0 ? visible.mark.hidden_opacity.value_or(0) : visible.mark.line.opacity;
      if (!(opacity > 0)) continue;
      const Vec2 at = view_.place(visible.place);
      if (visible.mark.object >= 0 && is_cut_off(at)) continue;
      obstacles_.discs.emplace_back(at, visible.mark.radius);
      SheetGroup& group = group_of(all, "mark", name_of(visible.mark.object));
      for (SheetItem& item : drawn_mark(visible.mark, at, opacity, view_)) group.items.push_back(std::move(item));
    }
    return all;
  }

  void add_texts(const VisibleLines& lines, std::vector<Label>& labels) {
    for (const VisibleText& visible : lines.texts) {
      const PointText& text = visible.text;
      const double opacity = visible.layers > 0 ? text.hidden_opacity : 1;
      if (!(opacity > 0) || (text.object >= 0 && is_cut_off(view_.place(visible.place)))) continue;
      Label label;
      label.text = text_in(text.style, text.text);
      label.text.brush.opacity *= opacity;
      label.at = view_.place(visible.place);
      label.side = text.side;
      label.distance = text.distance;
      label.kind = text.kind, label.object = name_of(text.object);
      if (text.leader) {
        label.leader = drawn_look(text.style);
        label.leader->opacity *= opacity;
      }
      if (text.style.fill) label.box = Brush{rgb(*text.style.fill), 1};
      labels.push_back(std::move(label));
    }
    obstacles_.width = figure_.sheet.width, obstacles_.height = figure_.sheet.height;
    place_labels(labels, obstacles_);
    const PageEdges page{"page", {Vec2(0), {figure_.sheet.width, figure_.sheet.height}}, model_->paper.margin};
    const PageEdges own{"panel", view_.room, 0};
    for (const Label& label : labels)
      if (std::string cut = over_the_edge(label, label.kind == "legend" && view_.is_panel ? own : page); !cut.empty())
        add_once(std::move(cut), figure_.cut_off);
    SheetGroup all{"labels", "", {}, {}, {}};
    for (const Label& label : labels) all.items.push_back(drawn_label(label));
    add_group(std::move(all));
  }

  std::shared_ptr<const Model> model_;
  View view_;
  bool clipped_;
  std::optional<PageCircle> circle_;  // at which a detail is cut
  const FigureOptions& options_;
  Figure& figure_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  World world_;
  std::vector<std::string> names_;
  LabelObstacles obstacles_;
  Overlaps overlaps_;
};

// The view of a model into a rectangle of the sheet, less the room that its axes and legend take.
void add_view(Model model, const Vec2& at, Vec2 size, bool panel, const FigureOptions& options, SolidLines& solids,
              Figure& figure) {
  const double per_pixel = millimetres_of_pixel(model);
  const auto camera_for = [&](const Vec2& millimetres) {
    const auto pixels = [&](double length) { return std::max(1, static_cast<int>(std::lround(length / per_pixel))); };
    return model.make_camera ? model.make_camera(pixels(millimetres.x), pixels(millimetres.y)) : model.camera;
  };
  Vec2 corner = at, room = size;
  model.camera = camera_for(size);
  if (!model.camera->is_linear()) {
    Diagnostics found;
    found.error({}, "straight lines are bent before this camera: there are no drawings of it",
                "render it, or take a perspective, parallel or graph camera");
    throw SceneError(std::move(found));
  }
  const bool graph = model.camera->is_graph();
  const bool grows_down = !panel && !graph && model.paper.auto_height,
             grows_wide = !panel && !graph && model.paper.auto_width;
  const auto grow = [&](const Vec2& by) {
    size += by;
    figure.sheet.width += by.x, figure.sheet.height += by.y;
  };
  Vec2 least(0);  // picture beside which the legend has room
  if (graph || model.drawing.legend) {
    const std::vector<LegendEntry> legend = legend_of(model.objects);
    const View trial{model, *model.camera, at, per_pixel, {}, {at, at + size}};
    const Insets insets = insets_of(trial, legend);
    const Vec2 taken(insets.left + insets.right, insets.top + insets.bottom);
    corner += Vec2(insets.left, insets.top);
    room -= taken;
    // An automatic page grows by the legend: the picture keeps its shape.
    least = insets.least;
    if (grows_down) room.y = std::max(room.x * size.y / size.x, least.y);
    if (grows_wide) room.x = std::max(room.y * size.x / size.y, least.x);
    if (!(room.x > 1 && room.y > 1))
      does_not_fit(model.paper.size_place,
                   fmt::format("axes, numbers and legend leave no room for the graph: they take {:.1f} x {:.1f} mm of "
                               "{:.1f} x {:.1f} mm",
                               taken.x, taken.y, size.x, size.y),
                   "a larger `size` of the image, or a smaller `text_size`");
    grow(room + taken - size);
    model.camera = camera_for(room);
  }
  if (!graph && model.camera_frames && !(model.drawing.annotations.empty() && model.drawing.title.empty())) {
    const Vec2 before = room;
    CameraPtr camera = camera_with_room(model, room, grows_down, per_pixel);
    if (grows_down && room.y < least.y) {
      room.y = least.y;
      camera = camera_with_room(model, room, false, per_pixel);
    }
    model.camera = camera;
    grow(room - before);
  }
  const auto shared = std::make_shared<const Model>(std::move(model));
  const View view{*shared,
                  *shared->camera,
                  corner,
                  per_pixel,
                  panel ? Vec2(at.x, at.y + size.y) : Vec2(0, figure.sheet.height),
                  {at, at + size},
                  panel};
  ViewDrawing(shared, view, graph || panel, options, figure).draw(solids);
}

// Of the page's pixels those that the scene keeps.
void crop(Sheet& sheet, const Model& model) {
  const Film::Crop& kept = model.film.crop;
  if (kept.x1 == 0) return;
  const double per_pixel = millimetres_of_pixel(model);
  sheet.corner = per_pixel * Vec2(kept.x0, kept.y0);
  sheet.width = per_pixel * (kept.x1 - kept.x0), sheet.height = per_pixel * (kept.y1 - kept.y0);
}

void add_page(Model model, const FigureOptions& options, Figure& figure) {
  figure.sheet.width = model.paper.width, figure.sheet.height = model.paper.height;
  const Vec2 margin(model.paper.margin);
  const Vec2 size = Vec2(figure.sheet.width, figure.sheet.height) - 2.0 * margin;
  const double given = model.paper.auto_height  ? figure.sheet.width
                       : model.paper.auto_width ? figure.sheet.height
                                                : std::min(figure.sheet.width, figure.sheet.height);
  if (!(size.x > 1 && size.y > 1))
    does_not_fit(model.paper.margin_place,
                 fmt::format("a margin of {:g} mm leaves nothing of {}", model.paper.margin,
                             page_in_words(model.paper, figure.sheet.width, figure.sheet.height)),
                 fmt::format("less than {:.1f} mm", 0.5 * (given - 1)));
  SolidLines solids;
  add_view(std::move(model), margin, size, false, options, solids, figure);
}

// Panels that neither the layout nor an output of their own shows.
void note_unplaced_panels(const Model& model, Figure& figure) {
  std::set<std::string> placed;
  for (const auto& row : model.layout.rows) placed.insert(row.begin(), row.end());
  for (const OutputFile& file : model.outputs) placed.insert(file.panel);
  for (const Panel& panel : model.panels)
    if (!placed.contains(panel.name))
      figure.left_out.push_back(fmt::format("the panel '{}', which `rows` of the layout do not name", panel.name));
}

}  // namespace

Figure figure_of(const std::shared_ptr<const Model>& given, const FigureOptions& options) {
  const KeptFits kept;
  Model model = *given;
  Figure figure;
  if (!(model.paper.width > 0)) {
    const double per_pixel = millimetres_of_pixel(model);
    model.paper.width = model.film.width * per_pixel, model.paper.height = model.film.height * per_pixel;
  }
  if (options.width > 0) {
    // Margins keep their width: an automatic page has the shape of what is between them.
    Paper& paper = model.paper;
    const double margins = paper.auto_width || paper.auto_height ? 2 * paper.margin : 0;
    paper.height = margins + (paper.height - margins) * (options.width - margins) / (paper.width - margins);
    paper.width = options.width;
  }
  figure.sheet.title = model.title;
  figure.sheet.paper = rgb(model.drawing.paper);
  if (!model.panels.empty()) {
    PanelLayout layout = panel_layout(model, options.panel);
    if (options.panel.empty()) note_unplaced_panels(model, figure);
    figure.sheet.width = layout.width, figure.sheet.height = layout.height;
    SolidLines solids;
    double panels_done = 0;
    for (PlacedPanel& panel : layout.panels) {
      FigureOptions of_panel = options;
      const double before_it = panels_done++, all = static_cast<double>(layout.panels.size());
      const auto share = [&](double done) { return (before_it + done) / all; };
      if (options.progress) of_panel.progress = [&](double done) { options.progress(share(done)); };
      if (options.rendering) of_panel.rendering = [&](double done) { options.rendering(share(done)); };
      std::vector<SheetItem> before;
      std::vector<std::string> left_out;
      std::swap(before, figure.sheet.items), std::swap(left_out, figure.left_out);
      add_view(std::move(panel.model), panel.at, panel.size, true, of_panel, solids, figure);
      std::swap(before, figure.sheet.items), std::swap(left_out, figure.left_out);
      // Another panel may show it.
      for (const std::string& what : left_out)
        add_once(fmt::format("{}, in the panel '{}'", what, panel.name), figure.left_out);
      figure.sheet.items.push_back(SheetGroup{"panel", panel.name, {}, {}, std::move(before)});
    }
    crop(figure.sheet, model);
    return figure;
  }
  const Model page = model;
  add_page(std::move(model), options, figure);
  crop(figure.sheet, page);
  return figure;
}

}  // namespace lekalo::render
