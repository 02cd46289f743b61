#include "render/drawing/view_drawing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "render/cameras/framed_content.h"
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

}  // namespace

void add_once(std::string what, std::vector<std::string>& all) {
  if (std::find(all.begin(), all.end(), what) == all.end()) all.push_back(std::move(what));
}

class ViewDrawing::Work {
 public:
  Work(std::shared_ptr<const Model> model, const View& view, bool clipped, const FigureOptions& options, Figure& figure)
      : model_(std::move(model)), view_(view), clipped_(clipped), options_(options), figure_(figure) {
    if (const DetailPtr detail = detail_of(model_->drawing)) circle_ = circle_of(view_, *detail);
  }

  void find_lines(SolidLines* solids) {
    auto begin = std::chrono::steady_clock::now();
    built_.emplace(model_);
    seconds_of_world_ = seconds_since(begin);
    begin = std::chrono::steady_clock::now();
    work_ = drawing_work(world(), solids);
    seconds_of_lines_ = seconds_since(begin);
  }
  void annotate() {
    figure_.seconds_of_world += seconds_of_world_;
    figure_.statistics.seconds_of_lines += seconds_of_lines_;
    legend_ = std::move(work_.legend);
    view_.scale = scale_of_ground();
    add_annotations(view_, work_, page_);
    if (!model_->drawing.title.empty()) add_title(view_, under_title(), page_);
    note_left_out(std::move(work_.left_out));
  }
  Label* title() {
    const auto found =
        std::find_if(page_.labels.begin(), page_.labels.end(), [](const Label& one) { return one.kind == "title"; });
    return found == page_.labels.end() ? nullptr : &*found;
  }
  void see(const std::function<void(double)>& progress) {
    one_faces_ = std::move(work_.one_faces);
    lines_ = visible_lines(world(), std::move(work_), progress);
  }
  void draw() {
    PageWork& page = page_;
    const VisibleLines& lines = lines_;
    add_statistics(lines);
    for (const Object* object : world().objects()) names_.push_back(object->name);
    if (model_->drawing.ground == Ground::shaded) add_ground();
    if (model_->drawing.ground == Ground::fill || has_hatched_cuts(model_->objects)) add_fills(lines, one_faces_);
    // What is hidden lies under what is seen, which is known first.
    SheetGroup seen = line_paths(lines, false), hidden = line_paths(lines, true);
    SheetGroup marks = marks_of(lines);
    for (const SheetItem& item : page.shapes) add_obstacles(item);
    GraphWork graph = graph_axes(view_, legend_, obstacles_);
    note_left_out(std::move(graph.left_out));
    for (std::string& what : graph.covered) add_once(std::move(what), figure_.cut_off);
    for (const std::vector<SheetItem>* drawn : {&graph.under, &graph.over})
      for (const SheetItem& item : *drawn) add_obstacles(item);
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
    const IntegratorPtr prepared = model_->integrator->prepared(world());
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
    Fills fills = fills_of(world(), view_, lines, one_faces, kFitted);
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
    SheetGroup result = line_groups(std::move(found), hidden, kJoined * world().radius(), kFitted * view_.millimetres);
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
  const World& world() const { return *built_; }
  std::optional<World> built_;
  double seconds_of_world_ = 0, seconds_of_lines_ = 0;
  LineWork work_;
  std::vector<LegendEntry> legend_;
  PageWork page_;
  OneFaces one_faces_;
  VisibleLines lines_;
  std::vector<std::string> names_;
  LabelObstacles obstacles_;
  Overlaps overlaps_;
};

ViewDrawing::ViewDrawing(std::shared_ptr<const Model> model, const View& view, bool clipped,
                         const FigureOptions& options, Figure& figure)
    : work_(std::make_unique<Work>(std::move(model), view, clipped, options, figure)) {}
ViewDrawing::~ViewDrawing() = default;
void ViewDrawing::find_lines(SolidLines* solids) { work_->find_lines(solids); }
void ViewDrawing::annotate() { work_->annotate(); }
Label* ViewDrawing::title() { return work_->title(); }
void ViewDrawing::see(const std::function<void(double)>& progress) { work_->see(progress); }
void ViewDrawing::draw() { work_->draw(); }

}  // namespace lekalo::render
