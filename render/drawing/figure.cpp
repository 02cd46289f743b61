#include "render/drawing/figure.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>
#include <set>

#include "geometry/queries/rays/fitted_pieces.h"
#include "render/cameras/kept_points.h"
#include "render/cameras/window.h"
#include "render/drawing/areas/filled_curves.h"
#include "render/drawing/page/graph_axes.h"
#include "render/drawing/page/legend.h"
#include "render/drawing/page/page_edges.h"
#include "render/drawing/page/panel_layout.h"
#include "render/drawing/view_drawing.h"
#include "render/model/placed_objects.h"
#include "render/scene/values/diagnostics.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kNearlyAsHigh = 2;  // heights of a title

// What objects say of fills stands in the drawing, or a note says why not.
void add_filled_curves(Model& model, Figure& figure) {
  std::vector<std::string> left_out;
  if (model.drawing.ground == Ground::fill) model.objects = with_filled_curves(model.objects, left_out);
  if (model.drawing.ground == Ground::none)
    each_object(model.objects, [&](const Object& object) {
      if (object.look && object.look->fill)
        left_out.push_back(
            fmt::format("the fill of '{}': areas are filled with `drawing: {{ ground: fill }}`", object.name));
    });
  for (std::string& what : left_out) add_once(std::move(what), figure.left_out);
}

// The view of a model into a rectangle of the sheet, less the room that its axes and legend take.
std::unique_ptr<ViewDrawing> view_drawing(Model model, const Vec2& at, Vec2 size, bool panel,
                                          const FigureOptions& options, Figure& figure) {
  add_filled_curves(model, figure);
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
  return std::make_unique<ViewDrawing>(shared, view, graph || panel, options, figure);
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
  const std::unique_ptr<ViewDrawing> view = view_drawing(std::move(model), margin, size, false, options, figure);
  view->find_lines(nullptr);
  view->annotate();
  view->see(options.progress);
  view->draw();
}

bool has_solids(const std::vector<Object>& objects) {
  return std::any_of(objects.begin(), objects.end(), [](const Object& object) {
    if (const auto* group = std::get_if<GroupPtr>(&object.shape)) return has_solids((*group)->objects);
    return std::holds_alternative<ShapePtr>(object.shape);
  });
}

// The views of several panels. Each is visited with others, or after them; what is thrown for the first in order is
// thrown.
class Panels {
 public:
  Panels(std::vector<PlacedPanel>& placed, const FigureOptions& options, Figure& figure)
      : placed_(placed), options_(options), done_(placed.size(), 0.0), figure_(figure) {
    for (PlacedPanel& panel : placed_) {
      // A solid that several panels show is searched for its lines once, one view after the other.
      side_by_side_ = side_by_side_ && !has_solids(panel.model.objects);
      FigureOptions of_panel = options;
      const double before_it = static_cast<double>(options_of_.size()), all = static_cast<double>(placed_.size());
      if (options.rendering)
        of_panel.rendering = [this, before_it, all](double done) { options_.rendering((before_it + done) / all); };
      options_of_.push_back(std::move(of_panel));
    }
  }

  void draw() {
    for (size_t k = 0; k < placed_.size(); ++k)
      views_.push_back(
          view_drawing(std::move(placed_[k].model), placed_[k].at, placed_[k].size, true, options_of_[k], figure_));
    SolidLines solids;
    const auto begin = std::chrono::steady_clock::now();
    each(side_by_side_, [&](size_t k) { views_[k]->find_lines(side_by_side_ ? nullptr : &solids); });
    const auto found = std::chrono::steady_clock::now();
    for (size_t k = 0; k < views_.size(); ++k) in_panel(k, [&] { views_[k]->annotate(); });
    align_titles();
    std::mutex telling;
    const auto annotated = std::chrono::steady_clock::now();
    each(true, [&](size_t k) {
      views_[k]->see(!options_.progress ? std::function<void(double)>() : [&, k](double done) {
        const std::lock_guard lock(telling);
        done_[k] = done;
        options_.progress(std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size()));
      });
    });
    const auto seen = std::chrono::steady_clock::now();
    for (size_t k = 0; k < views_.size(); ++k) {
      std::vector<SheetItem> before;
      std::swap(before, figure_.sheet.items);
      in_panel(k, [&] { views_[k]->draw(); });
      views_[k].reset();
      std::swap(before, figure_.sheet.items);
      figure_.sheet.items.emplace_back(SheetGroup{"panel", placed_[k].name, {}, {}, std::move(before)});
    }
    share_time(std::chrono::duration<double>(found - begin + seen - annotated).count());
  }

 private:
  // Titles of a row that stand nearly as high as its highest stand as high.
  void align_titles() {
    std::map<double, std::vector<Label*>> rows;  // by their upper edges
    for (size_t k = 0; k < views_.size(); ++k)
      if (Label* title = views_[k]->title()) rows[placed_[k].at.y].push_back(title);
    for (const auto& [y, titles] : rows) {
      double highest = kInfinity;
      for (const Label* title : titles) highest = std::min(highest, title->at.y);
      for (Label* title : titles)
        if (title->at.y - highest < kNearlyAsHigh * (title->text.ascent + title->text.descent)) title->at.y = highest;
    }
  }

  // Views side by side take less than the sum of their times: each stage gets its share of what passed.
  void share_time(double passed) {
    LineStatistics& s = figure_.statistics;
    double* const stages[] = {&figure_.seconds_of_world, &s.seconds_of_lines, &s.seconds_of_crossings,
                              &s.seconds_of_rays};
    double sum = 0;
    for (const double* stage : stages) sum += *stage;
    if (!(sum > passed)) return;
    for (double* stage : stages) *stage *= passed / sum;
  }

  template <class Visit>
  void each(bool side_by_side, const Visit& visit) {
    std::vector<std::exception_ptr> thrown(views_.size());
    const auto one = [&](size_t k) {
      try {
        // Whoever waits in one view does not begin another meanwhile.
        tbb::this_task_arena::isolate([&] { visit(k); });
      } catch (...) {
        thrown[k] = std::current_exception();
      }
    };
    if (side_by_side)
      tbb::parallel_for(size_t{0}, views_.size(), one, tbb::simple_partitioner());
    else
      for (size_t k = 0; k < views_.size() && (k == 0 || !thrown[k - 1]); ++k) one(k);
    for (const std::exception_ptr& error : thrown)
      if (error) std::rethrow_exception(error);
  }

  // Another panel may show what one leaves out.
  template <class Visit>
  void in_panel(size_t k, const Visit& visit) {
    std::vector<std::string> left_out;
    std::swap(left_out, figure_.left_out);
    visit();
    std::swap(left_out, figure_.left_out);
    for (const std::string& what : left_out)
      add_once(fmt::format("{}, in the panel '{}'", what, placed_[k].name), figure_.left_out);
  }

  std::vector<PlacedPanel>& placed_;
  const FigureOptions& options_;
  std::vector<FigureOptions> options_of_;
  std::vector<double> done_;  // shares of the panels' lines
  bool side_by_side_ = true;
  std::vector<std::unique_ptr<ViewDrawing>> views_;
  Figure& figure_;
};

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
  const KeptPoints kept_points;
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
    Panels(layout.panels, options, figure).draw();
    crop(figure.sheet, model);
    return figure;
  }
  const Model page = model;
  add_page(std::move(model), options, figure);
  crop(figure.sheet, page);
  return figure;
}

}  // namespace lekalo::render
