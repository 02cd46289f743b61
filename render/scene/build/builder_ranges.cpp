// Values that are right by themselves and show nothing of what they are for: parameters outside of a domain, levels
// beyond a degree, annotations of no size.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "geometry/queries/contours/parameter_lines.h"
#include "render/lines/curve_figures.h"
#include "render/lines/surface_figures.h"
#include "render/model/color_scale.h"
#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"

namespace lekalo::render {

using geometry::CurvePtr;
using geometry::Interval;
using geometry::kPi;
using geometry::ParameterValues;
using geometry::SurfacePtr;

namespace {

constexpr double kRounding = 1e-9;  // of the domain: an end that has been computed

bool is_in(const Interval& range, double x) {
  const double free = range.width() < geometry::kInfinity ? kRounding * range.width() : 0;
  return x >= range.lo - free && x <= range.hi + free;
}

// Where parameter lines may run on a shape.
struct LineRange {
  Interval range;
  double period = 0;

  bool contains(double x) const { return is_in(range, x + geometry::shift_into(range, x, period)); }
};

// For u or v; curves and meshes have none.
std::vector<LineRange> line_ranges(const Entity& entity, bool u) {
  std::vector<LineRange> ranges;
  const auto add = [&](const geometry::Surface& surface) {
    ranges.push_back({u ? surface.domain().u : surface.domain().v, u ? surface.periods().u : surface.periods().v});
  };
  if (const auto* surface = std::get_if<SurfacePtr>(&entity)) add(**surface);
  if (const auto* set = std::get_if<SurfaceSet>(&entity))
    for (const SurfacePtr& surface : *set) add(*surface);
  if (const auto* body = std::get_if<geometry::BodyPtr>(&entity))
    for (const geometry::FaceRegion& face : geometry::face_regions(**body)) {
      add(*face.surface);
      if (face.region) ranges.back().range = u ? face.region->u_range() : face.region->v_range();
    }
  return ranges;
}

// Whether it says what it is without names: no counter, parameter or thing changes it.
bool is_written_out(const Value& value) {
  if (value.is_sequence()) return std::all_of(value.items.begin(), value.items.end(), is_written_out);
  return value.is_scalar() && value.text.find_first_not_of("0123456789.+-*/()eE ") == std::string::npos;
}

}  // namespace

void Builder::outside_of_domain(const Value& value, const std::string& name, double x, const char* what,
                                const Interval& domain) {
  const bool degrees = value.is_scalar() && value.text.ends_with("deg");
  const double scale = degrees ? 180 / kPi : 1;
  const char* unit = degrees ? " deg" : "";
  const auto number = [&](double at) { return fmt::format("{:.6g}{}", at * scale, unit); };
  diagnostics_.error(value.place, fmt::format("{} = {} lies outside of the {}", name, number(x), what),
                     std::isinf(domain.lo) ? fmt::format("{} is at most {}", name, number(domain.hi))
                     : std::isinf(domain.hi)
                         ? fmt::format("{} is at least {}", name, number(domain.lo))
                         : fmt::format("{} goes from {} to {}", name, number(domain.lo), number(domain.hi)));
}

// A parameter of a place on a curve or surface; those that go round come back.
bool Builder::check_parameter(const Value& value, const char* name, double x, const char* what, const Interval& domain,
                              double period) {
  if (period > 0 || is_in(domain, x)) return true;
  outside_of_domain(value, name, x, what, domain);
  return false;
}

// Values of u or v at which an object has lines: each on one of its shapes.
bool Builder::check_line_values(const Value& given, const char* name, const ParameterValues& asked,
                                const std::vector<std::any>& shapes) {
  const bool u = std::string_view(name).ends_with("u");
  std::vector<LineRange> ranges;
  for (const std::any& shape : shapes) {
    const Entity entity = entity_of(shape);
    if (std::holds_alternative<geometry::ShapePtr>(entity)) return true;  // its ranges are not known
    const std::vector<LineRange> some = line_ranges(entity, u);
    ranges.insert(ranges.end(), some.begin(), some.end());
  }
  if (ranges.empty()) return true;
  for (size_t k = 0; k < asked.values.size(); ++k) {
    const double x = asked.values[k];
    if (std::any_of(ranges.begin(), ranges.end(), [&](const LineRange& range) { return range.contains(x); })) continue;
    Interval all = ranges.front().range;
    for (const LineRange& one : ranges) all = {std::min(all.lo, one.range.lo), std::max(all.hi, one.range.hi)};
    const bool listed = given.is_sequence() && given.items.size() == asked.values.size();
    outside_of_domain(listed ? given.items[k] : given, u ? "u" : "v", x, shapes.size() > 1 ? "shapes" : "shape", all);
    return false;
  }
  return true;
}

// What is drawn of a curve or surface can be.
bool Builder::check_figure(const Value& map, const std::function<void()>& make) {
  try {
    make();
    return true;
  } catch (const geometry::FieldError& error) {
    diagnostics_.error(error.field.empty() ? map.place : place_of_field(map, error.field), error.what(), error.hint);
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(map.place, error.what());
  }
  return false;
}

// Parameters and levels of what an object shows beside it; `place` is the map of the helper's fields.
bool Builder::check_helper_values(const Helper& helper, const Value& map, const std::vector<std::any>& shapes) {
  const Fields& f = helper.values;
  bool good = true;
  const bool has_lines = helper.type == "normals" || is_surface_figure(helper.type);
  if (has_lines && f.has("at_u"))
    for (const char* name : {"at_u", "at_v"})
      if (const Value* given = map.find(name))
        good = check_line_values(*given, name, f.get<ParameterValues>(name), shapes) && good;
  int degree = 0;
  for (const std::any& shape : shapes) {
    const Entity entity = entity_of(shape);
    if (const auto* surface = std::get_if<SurfacePtr>(&entity); surface && is_surface_figure(helper.type)) {
      // Lines are not searched for here: that may take long.
      const bool is_quick = f.has("u");
      good = check_figure(
                 map, [&] { is_quick ? void(surface_figure(*surface, helper)) : check_surface_figure(**surface); }) &&
             good;
    }
    const auto* curve = std::get_if<CurvePtr>(&entity);
    if (!curve) continue;
    const Interval domain = (*curve)->domain();
    const double period = (*curve)->period();
    if (const auto form = (*curve)->as_nurbs()) degree = std::max(degree, form->degree);
    if (const Value* t = map.find("t"); t && f.has("t"))
      if (!is_in(domain, f.number("t"))) outside_of_domain(*t, "t", f.number("t"), "curve", domain), good = false;
    if (const Value* at = map.find("at"); at && f.holds<std::vector<double>>("at")) {
      const std::vector<double>& values = f.numbers("at");
      const bool listed = at->is_sequence() && at->items.size() == values.size();
      for (size_t k = 0; k < values.size(); ++k)
        good = check_parameter(listed ? at->items[k] : *at, "t", values[k], "curve", domain, period) && good;
    }
    if (good && (helper.type == "comb" || helper.type == "colored") && domain.width() < geometry::kInfinity)
      good = check_figure(map, [&] { curve_quantity(**curve, f.text("by"), domain.middle()); });
    if (good && is_curve_figure(helper.type)) good = check_figure(map, [&] { curve_figure(*curve, helper); });
  }
  const Value* levels = map.find("levels");
  if (!levels || !f.has("levels") || degree == 0) return good;
  const std::vector<double>& asked = f.numbers("levels");
  const bool listed = levels->is_sequence() && levels->items.size() == asked.size();
  for (size_t k = 0; k < asked.size(); ++k)
    if (asked[k] > degree) {
      diagnostics_.error((listed ? levels->items[k] : *levels).place,
                         fmt::format("there is no level {:g}: the curve is of degree {}", asked[k], degree),
                         degree == 1 ? "it has level 1 alone" : fmt::format("levels go from 1 to {}", degree));
      return false;
    }
  return good;
}

// An annotation that is written out with no size is a mistake; one that gets there, as its parameters change, is left
// out, which the drawing says.
bool Builder::check_size(const TypeDeclaration& type, const Fields& fields, const Value& map) {
  const auto lack = lack_of_size(type.name, fields);
  if (!lack) return true;
  for (const char* point : {"at", "from", "to"})
    if (const Value* given = map.find(point); given && !is_written_out(*given)) return true;
  diagnostics_.error(place_of_field(map, lack->field), lack->what(), lack->hint);
  return false;
}

}  // namespace lekalo::render
