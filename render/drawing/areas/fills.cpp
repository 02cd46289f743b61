#include "render/drawing/areas/fills.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/shapes/csg/csg.h"
#include "render/drawing/areas/regions.h"
#include "render/material.h"
#include "render/model/face_materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr int kSamples = 24;  // of a gradient, across the area's longer side
constexpr int kStops = 12;
constexpr double kMinColor = 0.02;  // of a material that fills: black ones (glass, mirrors) do not
constexpr Vec3 kPlainColor(0.791298, 0.791298, 0.791298);  // #e6e6e6

// The real roots of c[0] + c[1] s + c[2] s^2 + c[3] s^3 in [0, 1).
std::vector<double> roots_in_unit(const std::array<double, 4>& c) {
  // Between the extrema the cubic is monotonic.
  std::vector<double> ends{0};
  const double a = 3 * c[3], b = 2 * c[2], discriminant = b * b - 4 * a * c[1];
  if (a == 0) {
    if (b != 0) ends.push_back(-c[1] / b);
  } else if (discriminant > 0) {
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    ends.push_back(q / a);
    if (q != 0) ends.push_back(c[1] / q);
  }
  std::erase_if(ends, [](double x) { return !(x >= 0 && x < 1); });
  ends.push_back(1);
  std::sort(ends.begin(), ends.end());
  const auto value = [&](double x) { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); };
  std::vector<double> roots;
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    double lo = ends[k], hi = ends[k + 1];
    // Half open: a root at an end belongs to what lies on one side of it.
    if ((value(lo) < 0) == (value(hi) < 0)) continue;
    for (double middle = 0.5 * (lo + hi); lo < middle && middle < hi; middle = 0.5 * (lo + hi))
      ((value(middle) < 0) == (value(ends[k]) < 0) ? lo : hi) = middle;
    roots.push_back(lo);
  }
  return roots;
}

// Parallel lines over the inside of loops, at multiples of the spacing from the page's corner so that neighbouring
// areas agree.
void add_hatching(const std::vector<Path>& given, double angle, double spacing, const LineLook& pen,
                  std::vector<SheetItem>& items) {
  constexpr double kArcTolerance = 1e-3;  // millimetres
  std::vector<Path> loops;
  for (const Path& loop : given) loops.push_back(without_arcs(loop, kArcTolerance));
  const Vec2 along(std::cos(angle), -std::sin(angle)), across(-along.y, along.x);
  double lo = kInfinity, hi = -kInfinity;
  const auto include = [&](const Vec2& p) {
    lo = std::min(lo, glm::dot(across, p)), hi = std::max(hi, glm::dot(across, p));
  };
  for (const Path& loop : loops) {
    include(loop.from);
    for (const PathStep& step : loop.steps) {
      include(step.to);
      if (step.kind == PathStep::Kind::curve) include(step.first), include(step.second);
    }
  }
  for (double k = std::ceil(lo / spacing); k * spacing < hi; ++k) {
    const double at = k * spacing;
    std::vector<double> places;
    for (const Path& loop : loops) {
      Vec2 begin = loop.from;
      const auto cross_step = [&](const PathStep& step) {
        const bool is_line = step.kind == PathStep::Kind::line;
        const Vec2 third = (step.to - begin) / 3.0, p1 = is_line ? begin + third : step.first,
                   p2 = is_line ? step.to - third : step.second;
        const auto coefficients = [&](const Vec2& axis) {
          const double a = glm::dot(axis, begin), b = glm::dot(axis, p1), c = glm::dot(axis, p2),
                       d = glm::dot(axis, step.to);
          return std::array<double, 4>{a, 3 * (b - a), 3 * (a - 2 * b + c), d - a + 3 * (b - c)};
        };
        std::array<double, 4> off = coefficients(across);
        off[0] -= at;
        const std::array<double, 4> way = coefficients(along);
        for (const double s : roots_in_unit(off)) places.push_back(way[0] + s * (way[1] + s * (way[2] + s * way[3])));
        begin = step.to;
      };
      for (const PathStep& step : loop.steps) cross_step(step);
      if (begin != loop.from) cross_step(line_to(loop.from));
    }
    std::sort(places.begin(), places.end());
    for (size_t i = 0; i + 1 < places.size(); i += 2)
      if (places[i + 1] > places[i])
        items.emplace_back(
            drawn(straight_path({at * across + places[i] * along, at * across + places[i + 1] * along}), pen));
  }
}

class Filling {
 public:
  Filling(const World& world, const View& view, const VisibleLines& lines, const OneFaces& one_faces, double tolerance)
      : world_(world), view_(view), one_faces_(one_faces), tolerance_(tolerance) {
    for (const Object* object : world.objects()) {
      fills_.push_back(&fill_of(view.model, *object));
      lights_.push_back(light_of(*fills_.back(), view.camera));
    }
    std::vector<RegionBorder> borders;
    for (const VisibleLine& line : lines.lines) {
      if (!line.stroke.outlines && !line.stroke.borders) continue;
      std::vector<double> breaks;
      for (const CurvePiece& piece : line.stroke.curve->pieces()) breaks.push_back(piece.domain.lo);
      for (const VisiblePiece& piece : line.pieces)
        if (piece.layers == 0) borders.push_back({line.curve, piece.t, breaks});
    }
    regions_ = std::make_unique<Regions>(std::move(borders), view.camera.width(), view.camera.height(),
                                         [&](const Vec2& place) { return label_at(place); });
  }

  Fills run() {
    std::map<int, std::vector<RegionLabel>> of_object;
    for (const RegionLabel& label : regions_->labels())
      if (label.object >= 0) of_object[label.object].push_back(label);
    for (const auto& [object, labels] : of_object) fill(object, labels);
    result_.open = regions_->open();
    return std::move(result_);
  }

 private:
  struct Interaction {
    RegionLabel label;
    double lambert = 0;  // cosine of the angle to the light, 0 where turned away
    Vec3 color{0};       // of the material, linear
  };
  Interaction seen_at(const Vec2& place) const {
    Interaction seen;
    const Ray ray = view_.camera.ray(place.x, place.y);
    Hit hit;
    if (!world_.nearest(ray, hit)) return seen;
    const SurfacePoint point = world_.surface_point(ray, hit);
    const Fill& fill = *fills_[static_cast<size_t>(point.object)];
    const bool front = glm::dot(point.geometric_normal, ray.direction) < 0;
    const double cosine =
        (front ? 1 : -1) * glm::dot(point.geometric_normal, lights_[static_cast<size_t>(point.object)]);
    seen.label.object = point.object;
    const Object& object = *world_.objects()[static_cast<size_t>(point.object)];
    seen.label.back = !front && object.back_material;
    if (face_materials(object))
      seen.label.face = point.face;
    else if (fill.shading == Fill::Shading::gradient)
      seen.label.face = one_faces_.first(point.object, point.face);
    if (fill.shading == Fill::Shading::two_tone || (fill.hatching && fill.hatching->shade_only))
      seen.label.shade = cosine < 0;
    seen.label.cut = is_cut_face(object, point.face);
    seen.lambert = std::max(cosine, 0.0);
    seen.color = rgb_of(world_.material(point, front).albedo(point, Wavelengths{}));
    return seen;
  }
  RegionLabel label_at(const Vec2& place) const {
    const Interaction seen = seen_at(place);
    if (seen.label.object >= 0) colors_.emplace(look_of(seen.label), seen.color);
    return seen.label;
  }
  // What of an object has one colour: a side, or a face of it where these have materials of their own.
  using OneColor = std::tuple<int, bool, int>;
  OneColor look_of(const RegionLabel& label) const {
    const bool by_face = face_materials(*world_.objects()[static_cast<size_t>(label.object)]) != nullptr;
    return {label.object, label.back, by_face ? label.face : 0};
  }
  // Crossings tell the leaf of the solid (csg.h).
  static bool is_cut_face(const Object& object, int face) {
    if (object.first_cut_leaf < 0) return false;
    const auto* solid = dynamic_cast<const Csg*>(std::get<ShapePtr>(object.shape).get());
    return solid && face % solid->leaf_count() >= object.first_cut_leaf;
  }
  static Vec3 rgb_of(const Spectrum& s) { return {s[0], s[1], s[2]}; }

  Vec3 color_of(const RegionLabel& label) const {
    const Fill& fill = *fills_[static_cast<size_t>(label.object)];
    if (fill.color) return *fill.color;
    const Vec3 color = colors_.at(look_of(label));
    return std::max({color.x, color.y, color.z}) < kMinColor ? kPlainColor : glm::clamp(color, 0.0, 1.0);
  }

  std::vector<Path> loops(const std::function<bool(const RegionLabel&)>& belongs) const {
    std::vector<Path> paths = regions_->loops(belongs, tolerance_);
    for (Path& path : paths) path = view_.placed(std::move(path));
    return paths;
  }

  void fill(int object, const std::vector<RegionLabel>& labels) {
    const Fill& fill = *fills_[static_cast<size_t>(object)];
    SheetGroup group{"fill", world_.objects()[static_cast<size_t>(object)]->name, {}, {}, {}};
    const auto part = [&](const std::function<bool(const RegionLabel&)>& belongs) {
      return loops([&](const RegionLabel& label) { return label.object == object && belongs(label); });
    };
    const Object& shown = *world_.objects()[static_cast<size_t>(object)];
    const bool filled = view_.model.drawing.ground == Ground::fill;
    std::map<OneColor, RegionLabel> looks;
    for (const RegionLabel& label : labels) looks.emplace(look_of(label), label);
    for (const auto& [look, first] : looks) {
      if (!filled || fill.shading == Fill::Shading::none) break;
      const Vec3 color = color_of(first);
      const auto is_so = [&](const RegionLabel& label) { return look_of(label) == look; };
      const auto lit = part(is_so);
      group.items.emplace_back(SheetPath{lit, {}, Brush{rgb(color), 1}, {}});
      if (fill.shading == Fill::Shading::two_tone)
        if (const auto shade = part([&](const RegionLabel& label) { return is_so(label) && label.shade; });
            !shade.empty())
          group.items.emplace_back(SheetPath{shade, {}, Brush{rgb(fill.shade * color), 1}, {}});
      if (fill.shading == Fill::Shading::gradient)
        for (const RegionLabel& label : labels) {
          if (!is_so(label)) continue;
          SheetPath area{loops([&](const RegionLabel& one) { return one == label; }), {}, {}, {}};
          area.gradient = gradient_of(label, area.parts, color, fill.shade);
          if (area.gradient) group.items.emplace_back(std::move(area));
        }
    }
    if (filled && fill.hatching)
      hatch(part([&](const RegionLabel& label) { return label.shade || !fill.hatching->shade_only; }), *fill.hatching,
            "hatching", group);
    if (shown.first_cut_leaf >= 0 && shown.cut_faces && shown.cut_faces->hatched)
      hatch(part([](const RegionLabel& label) { return label.cut; }), shown.cut_faces->hatching, "section_hatch",
            group);
    if (!group.items.empty()) result_.items.emplace_back(std::move(group));
  }

  static void hatch(const std::vector<Path>& area, const Hatching& hatching, const char* kind, SheetGroup& group) {
    const LineLook pen = drawn_look(hatching.style);
    SheetGroup lines{kind, "", {}, {}, {}};
    add_hatching(area, hatching.angle, hatching.spacing, pen, lines.items);
    if (hatching.crossed) add_hatching(area, hatching.angle + kPi / 2, hatching.spacing, pen, lines.items);
    if (!lines.items.empty()) group.items.emplace_back(std::move(lines));
  }

  // Along the direction of the page, or about the point, that says most of how the light falls on the area.
  std::optional<Gradient> gradient_of(const RegionLabel& label, const std::vector<Path>& area, const Vec3& color,
                                      double shade) const {
    Vec2 lo(kInfinity), hi(-kInfinity);
    for (const Path& path : area)
      for (const PathStep& step : path.steps) lo = glm::min(lo, step.to), hi = glm::max(hi, step.to);
    if (!(lo.x < hi.x && lo.y < hi.y)) return std::nullopt;
    struct Sample {
      Vec2 at;
      double light;
    };
    std::vector<Sample> samples;
    const double step = std::max(hi.x - lo.x, hi.y - lo.y) / kSamples;
    for (double y = lo.y + 0.5 * step; y < hi.y; y += step)
      for (double x = lo.x + 0.5 * step; x < hi.x; x += step) {
        const Interaction seen = seen_at((Vec2(x, y) - view_.at) / view_.millimetres);
        if (seen.label == label) samples.push_back({{x, y}, shade + (1 - shade) * seen.lambert});
      }
    if (samples.size() < 3) return std::nullopt;
    // Mean colours at even distances along what is measured; returns the squares of what they leave over.
    const auto means = [&](const auto& measure, std::vector<double>& values, Interval& range) {
      range = {kInfinity, -kInfinity};
      for (const Sample& s : samples) range = hull(range, Interval(measure(s.at)));
      std::vector<double> sums(kStops), counts(kStops);
      const auto bin = [&](const Sample& s) {
        const double share = range.width() > 0 ? (measure(s.at) - range.lo) / range.width() : 0;
        return std::min(static_cast<size_t>(share * kStops), static_cast<size_t>(kStops - 1));
      };
      for (const Sample& s : samples) sums[bin(s)] += s.light, counts[bin(s)] += 1;
      values.assign(kStops, -1);
      for (size_t k = 0; k < kStops; ++k)
        if (counts[k] > 0) values[k] = sums[k] / counts[k];
      double left = 0;
      for (const Sample& s : samples) left += (s.light - values[bin(s)]) * (s.light - values[bin(s)]);
      return left;
    };
    // The direction by least squares of a plane.
    Vec2 mean(0);
    double mean_light = 0;
    for (const Sample& s : samples) mean += s.at, mean_light += s.light;
    const auto count = static_cast<double>(samples.size());
    mean /= count, mean_light /= count;
    double xx = 0, xy = 0, yy = 0, xl = 0, yl = 0;
    for (const Sample& s : samples) {
      const Vec2 d = s.at - mean;
      const double l = s.light - mean_light;
      xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y, xl += d.x * l, yl += d.y * l;
    }
    const double area_of = xx * yy - xy * xy;
    Vec2 way = area_of != 0 ? Vec2(yy * xl - xy * yl, xx * yl - xy * xl) / area_of : Vec2(1, 0);
    way = glm::length(way) > 1e-9 ? glm::normalize(way) : Vec2(1, 0);
    const Vec2 brightest = std::max_element(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
                             return a.light < b.light;
                           })->at;
    std::vector<double> along, about;
    Interval along_range, about_range;
    const double left_along = means([&](const Vec2& p) { return glm::dot(way, p); }, along, along_range);
    const double left_about = means([&](const Vec2& p) { return glm::length(p - brightest); }, about, about_range);
    Gradient gradient;
    gradient.radial = left_about < left_along;
    const std::vector<double>& values = gradient.radial ? about : along;
    const Interval& range = gradient.radial ? about_range : along_range;
    if (gradient.radial) {
      gradient.from = brightest, gradient.to = brightest + Vec2(range.hi, 0);
    } else {
      gradient.from = mean + (range.lo - glm::dot(way, mean)) * way;
      gradient.to = mean + (range.hi - glm::dot(way, mean)) * way;
    }
    for (size_t k = 0; k < kStops; ++k) {
      if (values[k] < 0) continue;
      const double at = range.lo + range.width() * (static_cast<double>(k) + 0.5) / kStops;
      const double offset = gradient.radial ? at / range.hi : (at - range.lo) / range.width();
      gradient.stops.push_back({offset, rgb(values[k] * color)});
    }
    return gradient;
  }

  const World& world_;
  const View& view_;
  const OneFaces& one_faces_;
  double tolerance_;
  std::vector<const Fill*> fills_;  // of objects
  std::vector<Vec3> lights_;
  mutable std::map<OneColor, Vec3> colors_;
  std::unique_ptr<Regions> regions_;
  Fills result_;
};

}  // namespace

Fills fills_of(const World& world, const View& view, const VisibleLines& lines, const OneFaces& one_faces,
               double tolerance) {
  return Filling(world, view, lines, one_faces, tolerance).run();
}

}  // namespace lekalo::render
