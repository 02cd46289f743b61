// Colours by a number that belongs to the place: its height, its parameters, the curvature of the surface there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/describe.h"
#include "geometry/queries/differential/curvature.h"
#include "render/materials/textured_color.h"
#include "render/model/color_scale.h"

namespace lekalo::render {

using namespace geometry;

namespace {

using Measure = double (*)(const SurfacePoint&);

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <double (*of)(const SurfaceCurvature&)>
double curved(const SurfacePoint& point) {
  if (!point.curvature_source) return kUnknown;
  const SurfaceCurvature c = point.curvature_source->curvature(point);
  return c.regular ? of(c) : kUnknown;
}
double gaussian(const SurfaceCurvature& c) { return c.gaussian; }
double mean(const SurfaceCurvature& c) { return c.mean; }
double first(const SurfaceCurvature& c) { return c.principal[0]; }
double second(const SurfaceCurvature& c) { return c.principal[1]; }
double largest(const SurfaceCurvature& c) { return std::max(std::fabs(c.principal[0]), std::fabs(c.principal[1])); }

const std::map<std::string, Measure>& measures() {
  static const std::map<std::string, Measure> all = {
      {"x", [](const SurfacePoint& p) { return p.position.x; }},
      {"y", [](const SurfacePoint& p) { return p.position.y; }},
      {"z", [](const SurfacePoint& p) { return p.position.z; }},
      {"u", [](const SurfacePoint& p) { return p.u; }},
      {"v", [](const SurfacePoint& p) { return p.v; }},
      {"facing", [](const SurfacePoint& p) { return std::fabs(glm::dot(p.incoming, p.normal)); }},
      {"gaussian_curvature", curved<gaussian>},
      {"mean_curvature", curved<mean>},
      {"k1", curved<first>},
      {"k2", curved<second>},
      {"largest_curvature", curved<largest>}};
  return all;
}

std::vector<std::string> names_of_measures() {
  std::vector<std::string> names;
  for (const auto& [name, measure] : measures()) names.push_back(name);
  return names;
}

struct Stop {
  double at;  // rising
  TexturedColor color;
};

class RampTexture final : public Texture {
 public:
  RampTexture(Measure measure, std::vector<Stop> stops, TexturedColor unknown)
      : measure_(measure), stops_(std::move(stops)), unknown_(std::move(unknown)) {}

  Spectrum at(const SurfacePoint& point) const override {
    const double value = measure_(point);
    if (std::isnan(value)) return unknown_.at(point);
    const auto above = std::upper_bound(stops_.begin(), stops_.end(), value,
                                        [](double number, const Stop& stop) { return number < stop.at; });
    if (above == stops_.begin()) return stops_.front().color.at(point);
    if (above == stops_.end()) return stops_.back().color.at(point);
    const Stop& below = *std::prev(above);
    const auto share = static_cast<float>((value - below.at) / (above->at - below.at));
    return (1 - share) * below.color.at(point) + share * above->color.at(point);
  }

 private:
  Measure measure_;
  std::vector<Stop> stops_;
  TexturedColor unknown_;
};

std::vector<Stop> given_stops(const Fields& f) {
  std::vector<Stop> stops;
  for (const Fields& stop : f.groups("stops")) {
    if (!stops.empty() && stop.number("at") < stops.back().at)
      throw FieldError("stops",
                       fmt::format("the stop at {:.9g} comes after that at {:.9g}", stop.number("at"), stops.back().at),
                       "give them in rising order; two at one number make a sharp edge");
    stops.push_back({stop.number("at"), color_texture(stop, "color")});
  }
  return stops;
}

// Those of a scale over the range.
std::vector<Stop> stops_of(const std::string& scale, const Interval& range) {
  constexpr int kParts = 64;
  std::vector<Stop> stops;
  for (int k = 0; k <= kParts; ++k) {
    const double share = static_cast<double>(k) / kParts;
    stops.push_back({range.lo + share * (range.hi - range.lo), color_at(scale, share)});
  }
  return stops;
}

}  // namespace

TypeDeclaration ramp_type() {
  return declare(Category::texture, "ramp",
                 "Colours by a number of the place: height, parameters, curvature. Beyond the ends the end's colour.")
      .example("by: z, range: [0, 2], scale: viridis")
      .field("by", choice(names_of_measures()),
             "x, y, z: coordinates in the scene; u, v: parameters; facing: cosine of the angle between ray and normal; "
             "curvatures as of the integrator `analysis`",
             "z")
      .optional("range", range(), "the numbers of the scale's first and last colour; needed unless `stops` are given")
      .field("scale", choice(color_scales()), "the colours, where there are no `stops`", "viridis")
      .optional("stops",
                groups({{"at", number(), "the number", true, {}}, {"color", textured_color(), "its colour", true, {}}}),
                "colours of single numbers, in rising order; between them they are mixed")
      .field("unknown", textured_color(), "where the number is not known: curvatures of mere triangles, of tips",
             "grey")
      .built_by([](const Fields& f) -> TexturePtr {
        if (f.has("range") == f.has("stops"))
          throw FieldError(
              f.has("range") ? "stops" : "range", "a ramp needs one of 'range' and 'stops'",
              "range: [0, 2] spreads the colours of `scale`; stops: [{ at: 0, color: blue }, ...] gives them");
        if (f.has("range") && !(f.range("range").lo < f.range("range").hi))
          throw FieldError("range", "the range is empty", "its first number is less than its second");
        std::vector<Stop> stops = f.has("stops") ? given_stops(f) : stops_of(f.text("scale"), f.range("range"));
        if (stops.empty()) throw FieldError("stops", "a ramp without stops has no colour", "give one at least");
        return std::make_shared<RampTexture>(measures().at(f.text("by")), std::move(stops),
                                             color_texture(f, "unknown"));
      });
}

}  // namespace lekalo::render
