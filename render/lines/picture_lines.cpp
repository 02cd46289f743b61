#include "render/lines/picture_lines.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kBin = 16;  // pixels
constexpr double kPixelRadius = 0.70711;
// A curve this near a surface lies on it, in pixels across the surface: nobody sees the difference.
constexpr double kTouch = 1.0 / 64;
// A surface climbs no more than this times what its slopes at two places tell.
constexpr double kCurved = 2;
// Data layers show a line of at least this opacity.
constexpr double kShown = 0.5;
constexpr double kSteepest = 1e9;
// Lines count as instances from here downwards, so that no point of a surface is taken for one of a line.
constexpr int32_t kFirstLine = -2;
const Vec3 kLampOfBalls = glm::normalize(Vec3(-0.5, -0.6, 0.7));

// Slope of the depth along the picture of a surface that the ray meets at this cosine.
double slope_at(double cosine) {
  const double c = std::max(std::abs(cosine), 1 / kSteepest);
  return std::sqrt(std::max(0.0, 1 - c * c)) / c;
}

// How far a mesh may lie off the surface that it stands for.
double sag(const Object& object, double pixel) {
  if (object.representation != Representation::mesh) return 0;
  return object.sag > 0 ? object.sag : object.sag_pixels * pixel;
}

bool is_in_gap(const std::vector<double>& dash, double length) {
  double sum = 0;
  for (const double part : dash) sum += part;
  double rest = std::fmod(length, sum);
  for (size_t i = 0; i < dash.size(); ++i) {
    if (rest < dash[i]) return i % 2 != 0;
    rest -= dash[i];
  }
  return false;
}

// Whether the place q belongs to the line, `near` being the curve's nearest point.
bool covers(const LineLook& look, const ProjectedCurve& curve, int cell, const ProjectedCurve::Nearest& near,
            const Vec2& q) {
  if (near.end != 0) {
    if (look.cap == LineLook::Cap::butt) return false;
    if (look.cap == LineLook::Cap::round) return near.distance <= look.half_width;
    const double along = std::abs(glm::dot(q - near.place, near.tangent));
    const double across = std::sqrt(std::max(0.0, near.distance * near.distance - along * along));
    return along <= look.half_width && across <= look.half_width;
  }
  if (near.distance > look.half_width) return false;
  return look.dash.empty() || !is_in_gap(look.dash, curve.length_up_to(cell, near.t));
}

// Colour of a mark at the place p, in its radii from the middle, y down; none outside. `line`: half the width of its
// lines, in the same measure.
std::optional<Spectrum> color_at(const Mark& mark, const Vec2& p, double line) {
  const double r = glm::length(p);
  // Signed distances from the outline, below 0 inside.
  const auto outlined = [&](double distance) -> std::optional<Spectrum> {
    if (distance > 0) return std::nullopt;
    if (mark.fill && distance < -2 * line) return mark.fill;
    return mark.line.color;
  };
  const auto stroked = [&](double distance, double length) -> std::optional<Spectrum> {
    return distance <= line && length <= 1 ? std::optional(mark.line.color) : std::nullopt;
  };
  switch (mark.sign) {
    case Mark::Sign::dot:
      return r <= 1 ? std::optional(mark.line.color) : std::nullopt;
    case Mark::Sign::circle:
      if (r > 1 || (r < 1 - 2 * line && !mark.fill)) return std::nullopt;
      return r < 1 - 2 * line ? mark.fill : mark.line.color;
    case Mark::Sign::ball: {
      if (r > 1) return std::nullopt;
      const double light = glm::dot(Vec3(p, std::sqrt(1 - r * r)), kLampOfBalls);
      const float shine = static_cast<float>(0.4 * std::pow(std::max(0.0, light), 24));
      return static_cast<float>(0.25 + 0.75 * std::max(0.0, light)) * mark.line.color + shine * Spectrum(1, 1, 1);
    }
    case Mark::Sign::square:
      return outlined(std::max(std::abs(p.x), std::abs(p.y)) - 0.9);
    case Mark::Sign::diamond:
      return outlined((std::abs(p.x) + std::abs(p.y) - 1) * std::sqrt(0.5));
    case Mark::Sign::triangle:
      return outlined(std::max(p.y - 0.5, (std::sqrt(3.0) * std::abs(p.x) - p.y - 1) / 2));
    case Mark::Sign::plus:
      return std::abs(p.x) < std::abs(p.y) ? stroked(std::abs(p.x), std::abs(p.y))
                                           : stroked(std::abs(p.y), std::abs(p.x));
    case Mark::Sign::cross: {
      const double a = std::abs(p.x + p.y) * std::sqrt(0.5), b = std::abs(p.x - p.y) * std::sqrt(0.5);
      return a < b ? stroked(a, b) : stroked(b, a);
    }
  }
  return std::nullopt;
}

}  // namespace

PictureLines::PictureLines(const World& world, const std::atomic<bool>* stop)
    : world_(world), camera_(world.model().camera.get()) {
  if (!camera_->is_linear()) return;
  LineWork work = line_work(world, stop);
  // Numbers of lines that clip planes leave nothing of are missing.
  int orders = 0;
  for (const Stroke& stroke : work.strokes) orders = std::max(orders, stroke.order + 1);
  for (const Mark& mark : work.marks) orders = std::max(orders, mark.order + 1);
  colors_.resize(static_cast<size_t>(orders));
  for (const Stroke& stroke : work.strokes) colors_[stroke.order] = rgb(stroke.look.color);
  for (const Mark& mark : work.marks) colors_[mark.order] = rgb(mark.line.color);
  for (Stroke& stroke : work.strokes) {
    if (stop && stop->load(std::memory_order_relaxed)) return;
    const bool square =
        stroke.look.cap == LineLook::Cap::square || (stroke.hidden && stroke.hidden->cap == LineLook::Cap::square);
    const double half = std::max(stroke.look.half_width, stroke.hidden ? stroke.hidden->half_width : 0);
    const double reach = square ? std::sqrt(2.0) * half : half;
    ProjectedCurve curve(stroke.curve, stroke.to_world, *camera_, reach);
    if (!curve.cells().empty()) strokes_.push_back({std::move(stroke), std::move(curve), reach});
  }
  for (const Mark& mark : work.marks) {
    const PicturePoint at = camera_->project(mark.point);
    if (at.visible_side) marks_.push_back({mark, at, mark.radius});
  }
  sort_into_bins();
}

void PictureLines::sort_into_bins() {
  columns_ = (camera_->width() + kBin - 1) / kBin;
  rows_ = (camera_->height() + kBin - 1) / kBin;
  const auto each_item = [&](const auto& visit) {
    const auto over = [&](const Vec2& lo, const Vec2& hi, const Item& item) {
      // Clamped as doubles: a mark may stand anywhere.
      const auto bin = [](double x, int count) {
        return static_cast<int>(std::clamp(std::floor(x / kBin), -1.0, 1.0 * count));
      };
      const int x0 = std::max(bin(lo.x, columns_), 0), x1 = std::min(bin(hi.x, columns_), columns_ - 1);
      const int y0 = std::max(bin(lo.y, rows_), 0), y1 = std::min(bin(hi.y, rows_), rows_ - 1);
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) visit(static_cast<size_t>(y) * columns_ + x, item);
    };
    for (size_t s = 0; s < strokes_.size(); ++s) {
      const auto& cells = strokes_[s].curve.cells();
      for (size_t c = 0; c < cells.size(); ++c) {
        const Vec2 margin(strokes_[s].reach + cells[c].bulge);
        over(glm::min(cells[c].begin, cells[c].end) - margin, glm::max(cells[c].begin, cells[c].end) + margin,
             {static_cast<int>(s), static_cast<int>(c)});
      }
    }
    for (size_t m = 0; m < marks_.size(); ++m) {
      const Vec2 place(marks_[m].at.x, marks_[m].at.y);
      over(place - marks_[m].reach, place + marks_[m].reach, {-1 - static_cast<int>(m), 0});
    }
  };
  first_.assign(static_cast<size_t>(columns_) * rows_ + 1, 0);
  each_item([&](size_t bin, const Item&) { ++first_[bin + 1]; });
  for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  items_.resize(first_.back());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  each_item([&](size_t bin, const Item& item) { items_[next[bin]++] = item; });
}

PictureLines::Sight PictureLines::sight(const Vec3& point, const PicturePoint& at, double distance,
                                        const RaySample& sample) const {
  if (at.depth < 0) return {};
  const double pixel = camera_->pixel_size(point);
  const double touch = kTouch * pixel + 1e-13 * at.depth;
  const Ray ray = camera_->ray(at.x, at.y);
  Sight sight{true, 0, -ray.direction, -ray.direction};
  if (Hit hit; world_.nearest(ray, hit)) {
    const SurfacePoint met = world_.surface_point(ray, hit);
    const double cosine = glm::dot(ray.direction, met.geometric_normal);
    const double across = std::abs((hit.t - at.depth) * cosine);
    const bool touches = across <= touch + 4 * met.error + sag(world_.object(met), pixel);
    if (!touches && hit.t < at.depth) return {};
    if (touches) sight = {true, pixel * slope_at(cosine), met.geometric_normal, met.normal};
  }
  if (sample.point) {
    const double cosine = std::abs(glm::dot(sample.point->incoming, sample.point->geometric_normal));
    const double slope = std::max(sight.slope, pixel * slope_at(cosine));
    const double near = touch + 4 * sample.point->error + sag(world_.object(*sample.point), pixel);
    const double climb = kCurved * distance * slope + near / std::max(cosine, 1 / kSteepest);
    if (sample.depth < at.depth - climb) return {};
  }
  return sight;
}

void PictureLines::add_stroke(const Item& item, const Vec2& q, const RaySample& sample,
                              std::vector<Layer>& layers) const {
  const auto& [stroke, curve, reach] = strokes_[item.stroke];
  const auto near = curve.nearest(item.cell, q);
  if (!near || near->distance > reach) return;
  const bool shown = covers(stroke.look, curve, item.cell, *near, q),
             shown_hidden = stroke.hidden && covers(*stroke.hidden, curve, item.cell, *near, q);
  if (!shown && !shown_hidden) return;
  const Line tangent = curve.tangent(near->t);
  const PicturePoint at = camera_->project(tangent.origin);
  const Sight seen = sight(tangent.origin, at, near->distance, sample);
  if (!(seen.open ? shown : shown_hidden)) return;
  const LineLook& look = seen.open ? stroke.look : *stroke.hidden;
  Layer layer;
  layer.color = look.color;
  layer.opacity = look.opacity;
  layer.open = seen.open;
  layer.depth = at.depth;
  // The depth changes along a line too.
  const Vec3 along = camera_->ray(at.x, at.y).direction;
  const double deep = glm::dot(tangent.direction, along);
  const double own = std::abs(deep) / std::max(glm::length(tangent.direction - deep * along), 1 / kSteepest);
  layer.rise = look.half_width * std::max(seen.slope, camera_->pixel_size(tangent.origin) * own);
  layer.order = stroke.order;
  layer.object = stroke.object;
  layer.point = tangent.origin;
  layer.geometric_normal = seen.geometric_normal;
  layer.normal = seen.normal;
  layer.parameter = near->t;
  // A stroke covers a place once.
  for (Layer& other : layers)
    if (other.order == layer.order && other.open == layer.open) {
      if (layer.depth < other.depth) other = layer;
      return;
    }
  layers.push_back(layer);
}

void PictureLines::add_mark(const PlacedMark& placed, const Vec2& q, const RaySample& sample,
                            std::vector<Layer>& layers) const {
  const auto& [mark, at, reach] = placed;
  const Vec2 off = q - Vec2(at.x, at.y);
  const double distance = glm::length(off);
  if (distance > reach * std::sqrt(2.0)) return;
  const auto color = color_at(mark, off / mark.radius, mark.line.half_width / mark.radius);
  if (!color) return;
  const Sight seen = sight(mark.point, at, distance, sample);
  if (!seen.open && !mark.hidden_opacity) return;
  Layer layer;
  layer.color = *color;
  layer.opacity = seen.open ? mark.line.opacity : *mark.hidden_opacity;
  layer.open = seen.open;
  layer.depth = at.depth;
  layer.rise = mark.radius * seen.slope;
  layer.order = mark.order;
  layer.object = mark.object;
  layer.point = mark.point;
  layer.geometric_normal = seen.geometric_normal;
  layer.normal = seen.normal;
  layers.push_back(layer);
}

std::span<const PictureLines::Item> PictureLines::items_near(const Vec2& q) const {
  const int column = std::clamp(static_cast<int>(q.x) / kBin, 0, columns_ - 1),
            row = std::clamp(static_cast<int>(q.y) / kBin, 0, rows_ - 1);
  const size_t bin = static_cast<size_t>(row) * columns_ + column;
  return {items_.data() + first_[bin], items_.data() + first_[bin + 1]};
}

bool PictureLines::may_part(int x, int y) const {
  const Vec2 q(x + 0.5, y + 0.5);
  for (const Item& item : items_near(q)) {
    if (item.stroke < 0) {
      const PlacedMark& mark = marks_[-1 - item.stroke];
      if (glm::distance(q, Vec2(mark.at.x, mark.at.y)) <= std::sqrt(2.0) * mark.reach + kPixelRadius) return true;
      continue;
    }
    const auto& [stroke, curve, reach] = strokes_[item.stroke];
    const ProjectedCurve::Cell& cell = curve.cells()[item.cell];
    const Vec2 chord = cell.end - cell.begin, from_begin = q - cell.begin;
    const double length2 = glm::dot(chord, chord);
    const double along = length2 > 0 ? std::clamp(glm::dot(from_begin, chord) / length2, 0.0, 1.0) : 0.0;
    if (glm::length(from_begin - along * chord) > reach + cell.bulge + kPixelRadius) continue;
    // A wide line may cover all of the pixel.
    const auto near = curve.nearest(item.cell, q);
    const bool covered = near && near->end == 0 && stroke.look.dash.empty() && !stroke.hidden &&
                         near->distance + kPixelRadius <= stroke.look.half_width;
    if (!covered) return true;
  }
  return false;
}

void PictureLines::draw(const Vec2& q, RaySample& sample) const {
  const std::span<const Item> items = items_near(q);
  if (items.empty()) return;
  thread_local std::vector<Layer> layers;
  layers.clear();
  for (const Item& item : items)
    if (item.stroke >= 0)
      add_stroke(item, q, sample, layers);
    else
      add_mark(marks_[-1 - item.stroke], q, sample, layers);
  if (layers.empty()) return;

  // From the front to the back; those that meet, by their order.
  std::sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) {
    if (a.open != b.open) return a.open;
    return a.depth != b.depth ? a.depth < b.depth : a.order > b.order;
  });
  for (size_t pass = 1; pass < layers.size(); ++pass)
    for (size_t i = 0; i + 1 < layers.size(); ++i) {
      const Layer &front = layers[i], &behind = layers[i + 1];
      if (front.open == behind.open && front.order < behind.order &&
          behind.depth - front.depth <= front.rise + behind.rise)
        std::swap(layers[i], layers[i + 1]);
    }
  sample.line = layers.front().order + 1;
  for (size_t i = layers.size(); i-- > 0;) {
    const float over = static_cast<float>(layers[i].opacity), under = 1 - over;
    sample.radiance = over * layers[i].color + under * sample.radiance;
    sample.direct *= under;
    sample.alpha = over + under * sample.alpha;
    sample.key = (sample.key ^ static_cast<uint64_t>(layers[i].order + 1)) * 0x9e3779b97f4a7c15u;
  }
  const auto top = std::find_if(layers.begin(), layers.end(),
                                [](const Layer& layer) { return layer.open && layer.opacity >= kShown; });
  if (top == layers.end()) return;
  SurfacePoint point;
  point.position = point.smooth_position = top->point;
  point.incoming = camera_->ray(q.x, q.y).direction;
  point.geometric_normal = top->geometric_normal;
  point.normal = top->normal;
  point.u = top->parameter;
  point.instance = kFirstLine - top->order;
  point.object = top->object;
  sample.point = point;
  sample.depth = top->depth;
}

std::optional<Vec3> PictureLines::color(const SurfacePoint& point) const {
  if (point.instance > kFirstLine) return std::nullopt;
  return colors_[kFirstLine - point.instance];
}

}  // namespace lekalo::render
