#include "render/model/color_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/differential/fundamental_forms.h"
#include "render/scene/values/color_names.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// sRGB at even steps. Viridis, magma: Smith, van der Walt 2015; blue to red: Moreland 2009, through white.
const std::map<std::string, std::vector<const char*>>& scales() {
  static const std::map<std::string, std::vector<const char*>> all = {
      {"viridis",
       {"#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c", "#22a884", "#44bf70", "#7ad151", "#bddf26",
        "#fde725"}},
      {"magma",
       {"#000004", "#140e36", "#3b0f70", "#641a80", "#8c2981", "#b73779", "#de4968", "#f7705c", "#fe9f6d", "#fecf92",
        "#fcfdbf"}},
      {"blue_red", {"#3b4cc0", "#6788ee", "#9abbff", "#c9d7f0", "#f2f2f2", "#f7bfa6", "#f49a7b", "#de604d", "#b40426"}},
      {"grey", {"#202020", "#e0e0e0"}}};
  return all;
}

constexpr int kPlaces = 400;

}  // namespace

std::vector<std::string> color_scales() { return {"viridis", "magma", "blue_red", "grey"}; }

Vec3 color_at(const std::string& scale, double x) {
  const std::vector<const char*>& colors = scales().at(scale);
  const double place = std::clamp(std::isnan(x) ? 0 : x, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const size_t k = std::min(static_cast<size_t>(place), colors.size() - 2);
  const double w = place - static_cast<double>(k);
  return (1 - w) * *hex_color(colors[k]) + w * *hex_color(colors[k + 1]);
}

double place_on_scale(const PictureScale& scale, double value) {
  if (scale.bands) {
    const auto above = std::upper_bound(scale.levels.begin(), scale.levels.end(), value);
    const double lo = above == scale.levels.begin() ? scale.range.lo : std::max(scale.range.lo, *std::prev(above));
    const double hi = above == scale.levels.end() ? scale.range.hi : std::min(scale.range.hi, *above);
    value = 0.5 * (lo + hi);
  }
  return std::clamp((value - scale.range.lo) / scale.range.width(), 0.0, 1.0);
}

std::vector<double> round_numbers(const Interval& range, int count) {
  const double wanted = range.width() / std::max(1, count), power = std::pow(10, std::floor(std::log10(wanted)));
  const double part = wanted / power, step = power * (part > std::sqrt(50.0)   ? 10
                                                      : part > std::sqrt(10.0) ? 5
                                                      : part > std::sqrt(2.0)  ? 2
                                                                               : 1);
  std::vector<double> numbers;
  for (double k = std::ceil(range.lo / step - 1e-9); k <= range.hi / step + 1e-9; ++k) numbers.push_back(k * step);
  return numbers;
}

std::vector<std::string> curve_quantities() {
  return {"curvature", "signed_curvature", "torsion", "speed", "parameter", "geodesic_curvature", "normal_curvature"};
}

SurfaceBend surface_bend(const Curve& curve, double t) {
  const auto* on_surface = dynamic_cast<const SurfaceCurve*>(&curve);
  if (!on_surface)
    throw FieldError("by", "the curve lies on no surface",
                     "surface_curve, geodesic_curve, curvature_line and asymptotic_line do");
  const Vec3 image = on_surface->image()->point(t);
  const CurveJet jet = curve.evaluate(t, 2);
  SurfaceBend bend;
  bend.up = on_surface->surface()->normal(image.x, image.y);
  if (!(glm::length(jet.d[1]) > 0)) return bend;
  const CurveOnSurfaceCurvature c = curvature_on_surface(jet, bend.up);
  bend.geodesic = c.geodesic;
  bend.normal = c.normal;
  bend.across = glm::cross(bend.up, glm::normalize(jet.d[1]));
  return bend;
}

double curve_quantity(const Curve& curve, const std::string& quantity, double t) {
  if (quantity == "parameter") return t;
  if (quantity == "geodesic_curvature" || quantity == "normal_curvature") {
    const SurfaceBend bend = surface_bend(curve, t);
    const double found = quantity == "normal_curvature" ? bend.normal : bend.geodesic;
    return std::isfinite(found) ? found : 0;
  }
  const CurveJet jet = curve.evaluate(t, 3);
  double value = 0;
  if (quantity == "speed") {
    value = glm::length(jet.d[1]);
  } else {
    const CurveCurvature c = geometry::curvature(jet);
    value = quantity == "torsion" ? c.torsion : c.curvature;
    if (quantity == "signed_curvature" && glm::cross(jet.d[1], jet.d[2]).z < 0) value = -value;
  }
  return std::isfinite(value) ? value : 0;
}

Interval curve_range(const Curve& curve, const std::string& quantity, const std::string& colors) {
  const Interval domain = curve.domain();
  double least = kInfinity, largest = -kInfinity;
  for (int k = 0; k <= kPlaces; ++k) {
    const double value = curve_quantity(curve, quantity, domain.clamp(domain.lo + domain.width() * k / kPlaces));
    least = std::min(least, value), largest = std::max(largest, value);
  }
  const double size = std::max(std::abs(least), std::abs(largest)), middle = 0.5 * (least + largest);
  if (colors == "blue_red" && least < 0 && largest > 0) return {-size, size};
  if (largest - least > 1e-9 * size) return {least, largest};
  const double half = size > 0 ? 0.1 * size : 1;
  return {middle - half, middle + half};
}

}  // namespace lekalo::render
