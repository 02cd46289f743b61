// What surfaces are like, in colours. The first hit of the camera's ray is asked for a quantity, which is computed from
// the surface's own derivatives there (Golovanov 2016, 3.1.11-3.1.14); no light is followed. A number becomes a colour
// of a scale, or that of its band between two levels, or one of two by stripes:
//
//   radiance = colour(value) (1 - s + s |m . d|),   m normal, d line of sight, s the shading
//
// A line of equal value runs where the value differs from a level by less than half the line's width in pixels times
// its change from one pixel to the next; that is found from rays half a pixel beside. Stripes show the mean over that
// change, so that those narrower than a pixel become grey.
#include "render/integrators/analysis.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/model/attributes.h"
#include "render/model/color_scale.h"
#include "render/model/model.h"
#include "render/model/text_template.h"
#include "render/trace/hit_curvature.h"

namespace lekalo::render {

using namespace geometry;

namespace {

const Spectrum kUnknown(0.35f, 0.35f, 0.35f);
const Spectrum kDarkStripe(0.02f, 0.02f, 0.02f), kLightStripe(0.85f, 0.85f, 0.85f);
const Spectrum kLine(0.01f, 0.01f, 0.01f);

// The picture is first looked at in so many places a side.
constexpr int kPlaces = 64;

// The part of light stripes, the even ones, in so wide a range about a value.
double light_share(double value, double width, double stripe) {
  const auto light_below = [&](double x) {
    const double pairs = std::floor(x / (2 * stripe));
    return pairs * stripe + std::min(x - 2 * stripe * pairs, stripe);
  };
  if (width > 1e-9 * stripe)
    return std::clamp((light_below(value + 0.5 * width) - light_below(value - 0.5 * width)) / width, 0.0, 1.0);
  return std::fmod(std::floor(value / stripe), 2) == 0 ? 1 : 0;
}

class AnalysisIntegrator final : public Integrator {
 public:
  explicit AnalysisIntegrator(const AnalysisOptions& options) : options_(options) {}

  RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream&) const override {
    RaySample sample;
    if (first.instance < 0) {
      sample.radiance = world.model().background;
      return sample;
    }
    const SurfacePoint point = world.surface_point(ray, first);
    sample.point = point;
    sample.depth = first.t;
    sample.alpha = 1;
    const std::optional<double> value = value_at(world, first, point);
    if (value) sample.quantity = static_cast<float>(*value);
    const double cosine = std::abs(glm::dot(point.normal, ray.direction));
    const auto shade = static_cast<float>(1 - options_.shading + options_.shading * cosine);
    const std::optional<double> change =
        value && (line_pixels_ > 0 || is_striped()) ? change_per_pixel(world, ray, first, point, *value) : std::nullopt;
    Spectrum color = options_.quantity.is_direction ? rgb(0.5 * (point.normal + Vec3(1)))
                     : value                        ? color_of(*value, change.value_or(0))
                                                    : kUnknown;
    color *= shade;
    if (change && line_pixels_ > 0) {
      const float cover = line_cover(*value, *change);
      color = (1 - cover) * color + cover * kLine;
    }
    sample.radiance = sample.direct = color;
    sample.key = (static_cast<uint64_t>(point.instance) << 32) ^ static_cast<uint32_t>(point.face);
    return sample;
  }

  IntegratorPtr prepared(const World& world) const override {
    auto result = std::make_shared<AnalysisIntegrator>(options_);
    result->look(world);
    return result;
  }
  bool uses_parameters() const override { return true; }
  std::string quantity() const override { return options_.quantity.is_direction ? "" : options_.quantity.name; }
  bool has_scale() const override { return options_.quantity.value && options_.quantity.stripe == 0; }
  std::optional<PictureScale> scale() const override { return scale_; }
  std::vector<std::string> notes() const override {
    if (unknown_.empty()) return {};
    std::string names;
    for (const std::string& name : unknown_) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name);
    return {fmt::format("the quantity '{}' is not known everywhere; grey in the picture, 0 in its layer: {}",
                        options_.quantity.name, names)};
  }

 private:
  std::optional<double> value_at(const World& world, const Hit& hit, const SurfacePoint& point) const {
    const Quantity& q = options_.quantity;
    if (!q.value) return std::nullopt;
    AnalysedPlace place{point, nullptr, &world.object(point), {}};
    if (q.needs_parameters) place.surface = world.target(hit).surface;
    if (q.needs_curvature) place.curvature = curvature_at(world, hit, point);
    return q.value(place);
  }

  // Stripes of a number that grows along the surface; the squares of parameters are not.
  bool is_striped() const { return options_.quantity.stripe > 0 && !options_.quantity.needs_parameters; }

  Spectrum color_of(double value, double change) const {
    if (options_.quantity.stripe > 0) {
      const auto light = static_cast<float>(light_share(value, change, options_.quantity.stripe));
      return light * kLightStripe + (1 - light) * kDarkStripe;
    }
    if (!scale_) return kUnknown;
    return rgb(color_at(scale_->colors, place_on_scale(*scale_, value)));
  }

  // How much of a line of equal value covers the sample's place.
  float line_cover(double value, double per_pixel) const {
    const std::vector<double>& levels = scale_->levels;
    const auto above = std::lower_bound(levels.begin(), levels.end(), value);
    double off = kInfinity;
    if (above != levels.end()) off = *above - value;
    if (above != levels.begin()) off = std::min(off, value - *std::prev(above));
    if (!(off < kInfinity) || !(per_pixel > 0)) return 0;  // where the value is the same all around there is no line
    return static_cast<float>(std::clamp(0.5 * line_pixels_ + 0.5 - off / per_pixel, 0.0, std::min(1.0, line_pixels_)));
  }

  // How fast the value changes across the picture.
  std::optional<double> change_per_pixel(const World& world, const Ray& ray, const Hit& hit, const SurfacePoint& point,
                                         double value) const {
    const Frame across = frame_about(Vec3(0), ray.direction);
    double square = 0;
    for (const Vec3& side : {across.x, across.y}) {
      const auto change = change_along(world, ray, hit, value, 0.5 * point.pixel_size * side);
      if (!change) return std::nullopt;
      square += 4 * *change * *change;
    }
    return std::sqrt(square);
  }

  // Of the value from this ray to one beside, or on the other side: through the same eye, or parallel to it.
  std::optional<double> change_along(const World& world, const Ray& ray, const Hit& hit, double value,
                                     const Vec3& beside) const {
    const bool parallel = !world.model().camera || world.model().camera->is_parallel();
    for (const double sign : {1.0, -1.0}) {
      Ray other = ray;
      if (parallel)
        other.origin += sign * beside;
      else
        other.direction = glm::normalize(hit.t * ray.direction + sign * beside);
      Hit there;
      if (!world.nearest(other, there) || there.instance != hit.instance || there.face != hit.face) continue;
      if (const auto found = value_at(world, there, world.surface_point(other, there))) return *found - value;
    }
    return std::nullopt;
  }

  // What there is to see.
  void look(const World& world) {
    const Model& model = world.model();
    std::vector<double> values;
    std::vector<std::vector<std::pair<double, int>>> rows(kPlaces);  // a value, or an object where there is none
    tbb::parallel_for(tbb::blocked_range<int>(0, kPlaces), [&](const tbb::blocked_range<int>& some) {
      for (int j = some.begin(); j < some.end(); ++j)
        for (int i = 0; i < kPlaces; ++i) {
          const Ray ray = model.camera->ray((i + 0.5) * model.camera->width() / kPlaces,
                                            (j + 0.5) * model.camera->height() / kPlaces);
          Hit hit;
          if (!world.nearest(ray, hit)) continue;
          const SurfacePoint point = world.surface_point(ray, hit);
          const auto value = value_at(world, hit, point);
          rows[static_cast<size_t>(j)].emplace_back(value.value_or(0), value ? -1 : point.object);
        }
    });
    for (const auto& row : rows)
      for (const auto& [value, object] : row) {
        if (object < 0)
          values.push_back(value);
        else if (options_.quantity.value)
          unknown_.insert(world.objects()[static_cast<size_t>(object)]->name);
      }
    if (!has_scale()) return;
    PictureScale scale;
    scale.range = options_.range ? *options_.range : range_of(std::move(values), options_.quantity.has_sign);
    scale.colors = !options_.colors.empty() ? options_.colors : options_.quantity.has_sign ? "blue_red" : "viridis";
    scale.levels =
        options_.levels.count > 0 ? round_numbers(scale.range, options_.levels.count) : options_.levels.values;
    std::sort(scale.levels.begin(), scale.levels.end());
    scale.bands = options_.bands;
    scale.title = options_.title;
    scale_ = std::move(scale);
    if (options_.line_width > 0 && model.paper.width > 0)
      line_pixels_ = options_.line_width * model.film.width / model.paper.width;
  }

  AnalysisOptions options_;
  // What look() finds.
  std::optional<PictureScale> scale_;
  double line_pixels_ = 0;
  std::set<std::string> unknown_;  // objects of which the quantity is not known
};

}  // namespace

IntegratorPtr make_analysis_integrator(const AnalysisOptions& options) {
  return std::make_shared<AnalysisIntegrator>(options);
}

TypeDeclaration analysis_integrator_type() {
  TypeDeclaration type =
      declare(Category::integrator, "analysis",
              "What surfaces are like, in colours: curvatures, angles, stripes, a formula, exact at each pixel, or an "
              "attribute of elements. Its "
              "numbers are a layer of OpenEXR files that is called as the quantity.");
  add_quantity_fields(type);
  return type
      .optional("range", range(),
                "numbers of the first and last colour; by default those in the picture but for the outermost two in a "
                "hundred, about zero where they have signs")
      .optional("colors", choice(color_scales()), "scale of colours; blue_red for numbers with signs, else viridis")
      .field("levels", counts(), "where bands end and lines run: about how many round numbers, or which", "10")
      .field("bands", boolean(), "one colour between two levels", "false")
      .field("lines", boolean(), "lines of equal value at the levels", "false")
      .field("line_width", page_length().positive(), "of these lines", "0.25 mm")
      .field("shading", number().between(0, 1), "how much darker surfaces are that are seen edge-on", "0.3")
      .optional("title", label(), "of the numbers, for the colour bar")
      .built_by([](const Fields& f) {
        AnalysisOptions options;
        options.quantity = quantity_of(f);
        const bool has_scale = !options.quantity.is_direction && options.quantity.stripe == 0;
        for (const char* field : {"range", "colors", "levels", "bands", "lines", "title"})
          if (f.given(field) && !has_scale)
            throw FieldError(field, fmt::format("the quantity '{}' has no scale of colours", options.quantity.name));
        if (f.has("range")) options.range = f.range("range");
        if (f.has("colors")) options.colors = f.text("colors");
        options.levels = f.get<ParameterValues>("levels");
        options.bands = f.boolean("bands");
        if (f.boolean("lines")) options.line_width = f.number("line_width");
        options.shading = f.number("shading");
        if (f.has("title"))
          options.title = f.get<TextTemplate>("title").text();
        else if (f.has("attribute"))
          options.title = title_of_attribute(f.text("attribute"));
        return make_analysis_integrator(options);
      });
}

}  // namespace lekalo::render
