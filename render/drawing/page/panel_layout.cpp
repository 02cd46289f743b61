#include "render/drawing/page/panel_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "render/cameras/window.h"
#include "render/drawing/annotations/annotations.h"
#include "render/drawing/annotations/detail_circle.h"
#include "render/drawing/page/graph_axes.h"
#include "render/drawing/page/legend.h"
#include "render/drawing/text/text_layout.h"
#include "render/model/length_unit.h"
#include "render/scene/values/diagnostics.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kFree = 1.5;   // millimetres around what a panel shows
constexpr int kTrial = 1000;    // pixels of cameras by which sizes are found
constexpr double kTallest = 3;  // times its width: pictures whose height is found
constexpr double kRounding = 1e-6;
constexpr double kMinRoom = 1;  // millimetres of a panel, and for what is shown beside its annotations
constexpr const char* kAnchorFields[] = {"at", "from", "to"};

Model model_of(const Model& page, const Panel& panel) {
  Model model = page;
  model.panels.clear();
  if (panel.objects) model.objects = *panel.objects;
  model.drawing = panel.drawing;
  model.camera = panel.camera;
  model.make_camera = panel.make_camera;
  model.camera_frames = panel.camera_frames;
  return model;
}

void include(const SheetItem& item, SheetBox& part) {
  if (const auto* group = std::get_if<SheetGroup>(&item))
    for (const SheetItem& one : group->items) include(one, part);
  if (const auto* path = std::get_if<SheetPath>(&item))
    for (const Path& one : path->parts) {
      part.include(one.from);
      for (const PathStep& step : one.steps) part.include(step.to);
    }
}

// What the panel shows in millimetres, and the room that annotations take around it.
struct Extent {
  Vec2 middle{0};            // of its objects: by these views of a row or column are aligned
  Vec2 before{0}, after{0};  // left and above, right and below of the middle
  CameraPtr camera;          // a picture whose pixels are as large as `millimetres` says
  double millimetres = 1;
};

// The room of a legend in a panel that is no graph: that of graphs is theirs.
Insets legend_room(const Model& model, const Camera& camera, const Vec2& at, const Vec2& size) {
  if (!model.drawing.legend || camera.is_graph()) return {};
  const View view{model, camera, at, millimetres_of_pixel(model), {}, {at, at + size}, true};
  return insets_of(view, legend_of(model.objects));
}

// Of a detail on a page that has a scale.
double own_scale(const Model& model, const Detail& detail, const std::string& name) {
  if (!(detail.scale > 0))
    does_not_fit(model.layout.scale_place,
                 fmt::format("the detail of the panel '{}' has no scale, but the page has one", name),
                 fmt::format("detail: {{ scale: {:g} }}", 5 * model.layout.scale));
  return detail.scale;
}

// At a scale: millimetres for one scene unit.
Extent extent_at(const Model& model, double scale, const std::string& name) {
  Extent extent;
  if (const DetailPtr detail = detail_of(model.drawing)) scale *= own_scale(model, *detail, name) / model.layout.scale;
  extent.camera = model.make_camera(kTrial, kTrial);
  if (!extent.camera->is_parallel())
    does_not_fit(model.layout.scale_place,
                 fmt::format("the panel '{}' has a perspective camera: a scale is for parallel views", name),
                 "a parallel camera, or scale: fit");
  extent.millimetres = scale * extent.camera->pixel_size(Vec3(0));
  const FramedContent shown(model.objects);
  SheetBox objects = box_under_title(model, shown, *extent.camera, extent.millimetres);
  if (!(objects.lo.x < kInfinity)) objects = shown_box(model, shown, *extent.camera, extent.millimetres);
  extent.middle = 0.5 * (objects.lo + objects.hi);
  const SheetBox all = annotated_box(model, shown, *extent.camera, extent.millimetres);
  extent.before = extent.middle - all.lo + Vec2(kFree);
  extent.after = all.hi - extent.middle + Vec2(kFree);
  const Insets legend = legend_room(model, *extent.camera, Vec2(0), extent.before + extent.after);
  extent.before += Vec2(legend.left, legend.top), extent.after += Vec2(legend.right, legend.bottom);
  const Vec2 taken(legend.left + legend.right, legend.top + legend.bottom);
  const Vec2 missing = legend.least + taken - (extent.before + extent.after);
  extent.before += 0.5 * glm::max(missing, Vec2(0)), extent.after += 0.5 * glm::max(missing, Vec2(0));
  return extent;
}

// Room on both sides of the line through the middles of a row or column.
struct Track {
  double before = 0, after = 0;
  double size() const { return before + after; }
};

}  // namespace

namespace {

void include(const Vec3& point, const Camera& camera, double millimetres, SheetBox& part) {
  const PicturePoint p = camera.project(point);
  if (p.visible_side) part.include(millimetres * Vec2(p.x, p.y));
}

void include(const SheetBox& other, SheetBox& part) {
  if (other.lo.x <= other.hi.x) part.include(other.lo), part.include(other.hi);
}

// Of the points that annotations speak of.
SheetBox anchors_box(const Model& model, const Camera& camera, double millimetres) {
  const View view{model, camera, Vec2(0), millimetres, {0, millimetres * camera.height()}};
  LineWork work;
  PageWork page;
  add_annotations(view, work, page);
  SheetBox part;
  for (const Vec3& anchor : page.anchors) include(anchor, camera, millimetres, part);
  return part;
}

// Empty where no object shows anything: then cameras frame a cube, which is not seen.
SheetBox objects_box(const FramedContent& shown, const Camera& camera, double millimetres) {
  SheetBox part;
  if (shown.box.empty()) return part;
  for (const Vec3& point : shown.points()) include(point, camera, millimetres, part);
  return part;
}

// Of all that annotations draw, but for what is held on the page: that stays where it is. With the title.
SheetBox annotations_box(const Model& model, const SheetBox& under_title, const Camera& camera, double millimetres) {
  Model trial = model;
  std::erase_if(trial.drawing.annotations, [](const Annotation& one) {
    return std::any_of(std::begin(kAnchorFields), std::end(kAnchorFields), [&](const char* field) {
      return one.values.holds<Anchor>(field) && one.values.get<Anchor>(field).on_page;
    });
  });
  const View view{trial, camera, Vec2(0), millimetres, {0, millimetres * camera.height()}};
  LineWork work;
  PageWork page;
  add_annotations(view, work, page);
  add_title(view, under_title, page);
  SheetBox all;
  for (const SheetItem& item : page.shapes) include(item, all);
  for (const Vec2& place : page.reach) all.include(place);
  for (const Mark& mark : work.marks) {
    const PicturePoint at = camera.project(mark.point);
    if (!at.visible_side) continue;
    all.include(view.place(Vec2(at.x, at.y)) - Vec2(mark.radius));
    all.include(view.place(Vec2(at.x, at.y)) + Vec2(mark.radius));
  }
  std::vector<Label> labels = std::move(page.labels);
  for (const PointText& text : work.texts) {
    if (text.side.empty() || !camera.project(text.point).visible_side) continue;  // finds a place on the paper
    Label label;
    label.text = text_in(text.style, text.text);
    label.at = view.place(text.point), label.side = text.side, label.distance = text.distance;
    labels.push_back(std::move(label));
  }
  LabelObstacles free;
  free.width = free.height = kInfinity;
  for (Label& label : labels) {
    // Of places to choose from the best liked one.
    if (label.side.empty() && !label.spots.empty()) label.spots.resize(1);
    std::vector<Label> one{label};
    place_labels(one, free);
    include(box_of(one[0].text), all);
  }
  return all;
}

}  // namespace

SheetBox shown_box(const Model& model, const FramedContent& shown, const Camera& camera, double millimetres) {
  if (const DetailPtr detail = detail_of(model.drawing))
    return box_of(circle_of({model, camera, Vec2(0), millimetres}, *detail));
  SheetBox part = anchors_box(model, camera, millimetres);
  include(objects_box(shown, camera, millimetres), part);
  if (!(part.lo.x < kInfinity))
    part.include(Vec2(0)), part.include(millimetres * Vec2(camera.width(), camera.height()));
  return part;
}

SheetBox box_under_title(const Model& model, const FramedContent& shown, const Camera& camera, double millimetres) {
  if (const DetailPtr detail = detail_of(model.drawing))
    return box_of(circle_of({model, camera, Vec2(0), millimetres}, *detail));
  return objects_box(shown, camera, millimetres);
}

SheetBox annotated_box(const Model& model, const FramedContent& shown, const Camera& camera, double millimetres) {
  SheetBox all = shown_box(model, shown, camera, millimetres);
  include(annotations_box(model, box_under_title(model, shown, camera, millimetres), camera, millimetres), all);
  return all;
}

namespace {

// Of a detail whose circle is drawn with a radius that has room to grow `at_most` so many times.
double own_growth(const Model& model, const Detail& detail, double radius, double at_most) {
  const double grow = detail.scale * millimetres_of(model.unit).value_or(1) * detail.radius / radius;
  if (grow > at_most * (1 + kRounding))
    does_not_fit(
        model.paper.size_place, fmt::format("a detail at its scale {:g} has no room in its panel", detail.scale),
        fmt::format("scale: {:.2g} fits; or scale: fit, a larger `size` of the image", detail.scale * at_most / grow));
  return grow;
}

}  // namespace

CameraPtr camera_with_room(const Model& model, Vec2& size, bool auto_height, double millimetres) {
  const FramedContent objects_shown(model.objects);
  const SheetBox objects = objects_box(objects_shown, *model.camera, millimetres), picture{Vec2(0), size};
  const DetailPtr detail = detail_of(model.drawing);
  const bool shows_objects = !detail && objects.lo.x < kInfinity;
  // A camera may frame some of the objects: then its picture counts, not what lies outside of it.
  const bool frames_all = glm::all(glm::greaterThan(objects.lo, picture.lo - Vec2(kFree))) &&
                          glm::all(glm::lessThan(objects.hi, picture.hi + Vec2(kFree)));
  CameraPtr camera = model.camera;
  double zoom = 1;
  Vec2 corner(0);  // of the window in the model's own picture, pixels
  const auto now = [&](const Vec2& place) { return zoom * (place - millimetres * corner); };
  // What annotations take hardly depends on the scale: it is soon found.
  constexpr int kRounds = 12;
  constexpr double kFound = 1e-3;  // of the scale
  for (int round = 0; round < kRounds; ++round) {
    SheetBox shown = anchors_box(model, *camera, millimetres), under_title;
    if (frames_all || !shows_objects) {
      shown = shown_box(model, objects_shown, *camera, millimetres);
      under_title = box_under_title(model, objects_shown, *camera, millimetres);
    } else {
      under_title = {now(picture.lo), now(picture.hi)};
      include(under_title, shown);
    }
    SheetBox all = shown;
    include(annotations_box(model, under_title, *camera, millimetres), all);
    const bool fits = all.lo.x >= -kRounding && all.lo.y >= -kRounding && all.hi.x <= size.x + kRounding &&
                      all.hi.y <= size.y + kRounding;
    if (round == 0 && fits && shows_objects) break;
    const Vec2 before = shown.lo - all.lo + Vec2(kFree), after = all.hi - shown.hi + Vec2(kFree);
    const Vec2 content = shown.size();
    Vec2 room = size - before - after;
    if (auto_height) room.y = std::max(kTallest * size.x, size.y) - before.y - after.y;
    if (!(room.x > kMinRoom && room.y > kMinRoom)) break;  // for both: the scene keeps its place
    double grow = kInfinity;
    for (const int axis : {0, 1})
      if (content[axis] > 0) grow = std::min(grow, room[axis] / content[axis]);
    if (!(grow < kInfinity)) grow = 1;  // a point
    if (detail && detail->scale > 0) grow = own_growth(model, *detail, 0.5 * content.x, grow);
    // Objects are never larger than their camera shows them.
    if (shows_objects) grow = std::min(grow, 1 / zoom);
    if (auto_height) size.y = before.y + after.y + grow * content.y;
    // The middle of what is shown comes to the middle of its room.
    const Vec2 middle = corner + 0.5 * (shown.lo + shown.hi) / (millimetres * zoom);
    zoom *= grow;
    corner = middle - (before + 0.5 * (size - before - after)) / (millimetres * zoom);
    camera = window_of(model.camera, corner.x, corner.y, zoom, static_cast<int>(std::lround(size.x / millimetres)),
                       std::max(1, static_cast<int>(std::lround(size.y / millimetres))));
    if (std::abs(grow - 1) < kFound) break;
  }
  return camera;
}

void does_not_fit(const Place& place, std::string message, std::string hint) {
  Diagnostics found;
  found.error(place, std::move(message), std::move(hint));
  throw SceneError(std::move(found));
}

std::string page_in_words(const Paper& paper, double width, double height) {
  if (paper.auto_height) return fmt::format("a page {:.1f} mm wide", width);
  if (paper.auto_width) return fmt::format("a page {:.1f} mm high", height);
  return fmt::format("a page of {:.1f} x {:.1f} mm", width, height);
}

namespace {

using Rows = std::vector<std::vector<std::string>>;
using PanelsByName = std::map<std::string, const Panel*>;

// Rows and columns of panels at a scale.
struct Tracks {
  std::map<std::string, Extent> extents;
  std::vector<Track> across, down;
  Vec2 size{0};  // of the page that they need
};

Tracks tracks_at(const Model& page, const Rows& rows, const PanelsByName& panels, size_t columns, double scale) {
  Tracks result;
  std::vector<Track>&across = result.across, &down = result.down;
  across.resize(columns), down.resize(rows.size());
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t j = 0; j < rows[i].size(); ++j) {
      if (rows[i][j].empty()) continue;
      const Extent extent = extent_at(model_of(page, *panels.at(rows[i][j])), scale, rows[i][j]);
      across[j].before = std::max(across[j].before, extent.before.x);
      across[j].after = std::max(across[j].after, extent.after.x);
      down[i].before = std::max(down[i].before, extent.before.y);
      down[i].after = std::max(down[i].after, extent.after.y);
      result.extents.emplace(rows[i][j], extent);
    }
  const auto sum = [&](const std::vector<Track>& tracks) {
    double total = 2 * page.paper.margin + page.layout.gap * static_cast<double>(tracks.size() - 1);
    for (const Track& track : tracks) total += track.size();
    return total;
  };
  result.size = {sum(across), sum(down)};
  return result;
}

// What to do where panels need more than the page has at a scale.
std::string fitting_scale(const Model& page, const Vec2& needed, const Vec2& fixed, const Vec2& size) {
  double share = 1;
  for (const int axis : {0, 1})
    if (needed[axis] > size[axis]) share = std::min(share, (size[axis] - fixed[axis]) / (needed[axis] - fixed[axis]));
  const std::string larger =
      fmt::format("a larger `size` of the image, scale: fit{}", share > 0 ? "" : ", fewer panels");
  if (!(share > 0)) return larger;
  const double scale = share * page.layout.scale, digit = std::pow(10, std::floor(std::log10(scale)) - 1);
  return fmt::format("scale: {:g} fits; or {}", std::floor(scale / digit) * digit, larger);
}

// All at the page's scale.
void add_scaled(const Model& page, const Rows& rows, const PanelsByName& panels, size_t columns, bool alone,
                PanelLayout& layout) {
  const double scale = page.layout.scale * millimetres_of(page.unit).value_or(1);
  const Tracks tracks = tracks_at(page, rows, panels, columns, scale);
  const Vec2& needed = tracks.size;
  if (page.paper.auto_width || alone) layout.width = needed.x;
  if (page.paper.auto_height || alone) layout.height = needed.y;
  if (needed.x > layout.width + 1e-6 || needed.y > layout.height + 1e-6) {
    constexpr double kSmall = 1e-6;  // times the scale: what hardly depends on it is left
    const Vec2 fixed = tracks_at(page, rows, panels, columns, kSmall * scale).size;
    does_not_fit(page.layout.scale_place,
                 fmt::format("the panels do not fit at this scale: they need {:.1f} x {:.1f} mm, the page has {:.1f} x "
                             "{:.1f} mm",
                             needed.x, needed.y, layout.width, layout.height),
                 fitting_scale(page, needed, fixed, {layout.width, layout.height}));
  }
  const std::vector<Track>&across = tracks.across, &down = tracks.down;
  // What is free stands around all.
  Vec2 at = Vec2(page.paper.margin) + 0.5 * (Vec2(layout.width, layout.height) - needed);
  for (size_t i = 0; i < rows.size(); ++i) {
    double x = at.x;
    for (size_t j = 0; j < rows[i].size(); ++j) {
      if (!rows[i][j].empty()) {
        const Extent& extent = tracks.extents.at(rows[i][j]);
        Model model = model_of(page, *panels.at(rows[i][j]));
        // A window of the trial's picture, its middle on the lines of row and column.
        const double per_pixel = millimetres_of_pixel(page), zoom = extent.millimetres / per_pixel;
        const Vec2 size(across[j].size(), down[i].size());
        const Insets legend = legend_room(model, *extent.camera, {x, at.y}, size);
        const Vec2 corner =
            (extent.middle - Vec2(across[j].before - legend.left, down[i].before - legend.top)) / extent.millimetres;
        model.camera_frames = false;  // all has its room
        model.make_camera = [camera = extent.camera, corner, zoom](int w, int h) {
          return window_of(camera, corner.x, corner.y, zoom, w, h);
        };
        layout.panels.push_back({rows[i][j], std::move(model), {x, at.y}, size});
      }
      x += across[j].size() + page.layout.gap;
    }
    at.y += down[i].size() + page.layout.gap;
  }
}

}  // namespace

PanelLayout panel_layout(const Model& page, const std::string& only) {
  const Rows rows = only.empty() ? page.layout.rows : Rows{{only}};
  PanelsByName panels;
  for (const Panel& panel : page.panels) panels.emplace(panel.name, &panel);
  if (!only.empty() && !panels.contains(only))
    throw std::runtime_error(fmt::format("there is no panel called '{}'", only));
  size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  const double gap = page.layout.gap, margin = page.paper.margin;
  PanelLayout layout;
  layout.width = page.paper.width, layout.height = page.paper.height;

  if (page.layout.scale > 0) {
    add_scaled(page, rows, panels, columns, !only.empty(), layout);
    return layout;
  }

  // Shares of the page, equal ones where the scene does not say.
  std::vector<double> widths(columns, 1.0);
  if (!page.layout.columns.empty() && only.empty()) widths = page.layout.columns;
  double sum = 0;
  for (const double share : widths) sum += share;
  for (double& share : widths) share *= (layout.width - 2 * margin - gap * static_cast<double>(columns - 1)) / sum;
  std::vector<double> heights;
  for (const auto& row : rows) {
    double tallest = 0;
    for (size_t j = 0; j < row.size(); ++j) {
      const std::string& name = row[j];
      const double width = widths[j];
      if (name.empty()) continue;
      Model model = model_of(page, *panels.at(name));
      const Vec2 shown = shown_box(model, FramedContent(model.objects), *model.make_camera(kTrial, kTrial), 1).size();
      const Insets legend = legend_room(model, *model.make_camera(kTrial, kTrial), Vec2(0), {width, kTallest * width});
      const double free = std::max(1.0, width - legend.left - legend.right);
      Vec2 size(free, shown.x > 0 ? std::clamp(shown.y / shown.x, 0.1, kTallest) * free : free);
      const double per_pixel = millimetres_of_pixel(page);
      const auto pixels = [&](double length) { return std::max(1, static_cast<int>(std::lround(length / per_pixel))); };
      model.camera = model.make_camera(pixels(size.x), pixels(size.y));
      if (model.camera_frames) camera_with_room(model, size, true, per_pixel);
      tallest = std::max(tallest, std::max(size.y, legend.least.y) + legend.top + legend.bottom);
    }
    heights.push_back(page.paper.auto_height || !only.empty()
                          ? tallest
                          : (layout.height - 2 * margin - gap * static_cast<double>(rows.size() - 1)) /
                                static_cast<double>(rows.size()));
  }
  if (page.paper.auto_height || !only.empty()) {
    layout.height = 2 * margin + gap * static_cast<double>(rows.size() - 1);
    for (const double height : heights) layout.height += height;
  }
  const double narrowest = *std::min_element(widths.begin(), widths.end());
  const double mean =
      (layout.width - 2 * margin - gap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
  const Place& place = page.layout.gap_place.file && gap > margin ? page.layout.gap_place : page.paper.margin_place;
  if (!(narrowest > kMinRoom) && mean > kMinRoom)
    does_not_fit(place,
                 fmt::format("of the `columns` of the layout the narrowest has {:.3f} mm on {}", narrowest,
                             page_in_words(page.paper, layout.width, layout.height)),
                 "a larger share of the width for it");
  if (!(narrowest > kMinRoom) || !(*std::min_element(heights.begin(), heights.end()) > kMinRoom))
    does_not_fit(
        place,
        fmt::format("margins and gaps leave no room for {} panel{} in a row and {} in a column on {}", columns,
                    columns == 1 ? "" : "s", rows.size(), page_in_words(page.paper, layout.width, layout.height)),
        "smaller ones, or a larger `size` of the image");
  double y = margin;
  for (size_t i = 0; i < rows.size(); ++i) {
    double x = margin;
    for (size_t j = 0; j < rows[i].size(); ++j) {
      if (!rows[i][j].empty()) {
        PlacedPanel placed{rows[i][j], model_of(page, *panels.at(rows[i][j])), {x, y}, {widths[j], heights[i]}};
        layout.panels.push_back(std::move(placed));
      }
      x += widths[j] + gap;
    }
    y += heights[i] + gap;
  }
  return layout;
}

}  // namespace lekalo::render
