// Points and directions, given by coordinates or names, or taken from curves and surfaces.
//
//   { of: r, t: 0.4 }   { of: r, s: 0.5 } fraction of the arc length   { of: patch, u: .5, v: .3 }
//   { of: patch, point: [2, 2] } control point   { of: r, t: 0.4, vector: tangent | normal | binormal }
//   { of: patch, u: .5, v: .3, vector: normal | du | dv }
//   { of: P, vector: tangent } at a place that has a name
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/measures/arc_length.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/transformed.h"
#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::Anchor;
using geometry::CurvePtr;
using geometry::SurfacePtr;

// A place on a curve (t) or on a surface (u, v).
struct Builder::Located {
  CurvePtr curve;
  SurfacePtr surface;
  double t = 0, u = 0, v = 0;
};

namespace {

const Category kCurveOrSurface[] = {Category::curve, Category::surface};

// The spline behind any number of transforms, with their product.
template <class Spline, class Transformed, class Pointer>
const Spline* spline_behind(const Pointer& shape, Affine& map) {
  if (const auto* moved = dynamic_cast<const Transformed*>(shape.get())) {
    map = map * moved->map();
    return spline_behind<Spline, Transformed>(moved->original(), map);
  }
  return dynamic_cast<const Spline*>(shape.get());
}

Vec3 cartesian(const geometry::Vec4& p) { return Vec3(p) / p.w; }

}  // namespace

std::optional<Vec3> Builder::read_coordinates(const Value& value, const Counters& counters) {
  if (!value.is_sequence() || value.items.size() < 2 || value.items.size() > 3) {
    diagnostics_.error(value.place, value.is_sequence()
                                        ? fmt::format("a point has 2 or 3 coordinates, found {}", value.items.size())
                                        : fmt::format("expected coordinates [x, y, z], found {}", kind_name(value)));
    return std::nullopt;
  }
  Vec3 point(0);
  bool good = true;
  for (size_t k = 0; k < value.items.size(); ++k) {
    const auto x = read_number_by(geometry::length(), value.items[k], counters);
    if (x)
      point[static_cast<int>(k)] = *x;
    else
      good = false;
  }
  return good ? std::optional(point) : std::nullopt;
}

std::optional<Vec3> Builder::read_point(const Value& value, const Counters& counters) {
  if (value.invalid) return std::nullopt;
  if (value.is_sequence()) return read_coordinates(value, counters);
  if (value.is_map()) {
    if (const Value* point = value.find("point"); point && !value.find("of")) return read_point(*point, counters);
    return read_place_on(value, counters);
  }
  const Category wanted[] = {Category::point};
  const auto built = refer(value, counters, wanted);
  if (!built) return std::nullopt;
  return std::any_cast<Vec3>(built->value);
}

// { page: [5 mm, 8 mm] }, or a point.
std::optional<Anchor> Builder::read_anchor(const Value& value, const Counters& counters) {
  const Value* page = value.find("page");
  if (!page) {
    if (value.is_sequence() && value.items.size() == 2 &&
        std::ranges::all_of(value.items, [](const Value& one) { return static_cast<bool>(read_page_length(one)); })) {
      diagnostics_.error(value.place, "a point of the scene has no units",
                         fmt::format("on the page: {{ page: [{}, {}] }}", value.items[0].text, value.items[1].text));
      return std::nullopt;
    }
    const auto point = read_point(value, counters);
    return point ? std::optional(Anchor{*point, false}) : std::nullopt;
  }
  for (const Entry& entry : value.entries)
    if (entry.key.name != "page") {
      diagnostics_.error(entry.key.place, fmt::format("unknown field '{}' of a place on the page", entry.key.name),
                         "{ page: [5 mm, 8 mm] }, from the lower left corner");
      return std::nullopt;
    }
  if (!page->is_sequence() || page->items.size() != 2) {
    diagnostics_.error(page->place, "a place on the page has two lengths",
                       "{ page: [5 mm, 8 mm] }, from the lower left corner");
    return std::nullopt;
  }
  Anchor anchor;
  anchor.on_page = true;
  for (int k = 0; k < 2; ++k) {
    const auto length = read_page_length_by(geometry::page_length(), page->items[static_cast<size_t>(k)]);
    if (!length) return std::nullopt;
    anchor.point[k] = *length;
  }
  return anchor;
}

// The place that `of` and the parameters beside it say; `what` is "a place" or "a direction".
std::optional<Builder::Located> Builder::locate(const Value& map, const Counters& counters, const char* what) {
  const bool direction = map.find("vector") != nullptr;
  std::vector<std::string> known = {"of", "t", "s", "u", "v"};
  known.push_back(direction ? "vector" : "point");
  for (const Entry& entry : map.entries)
    if (entry.key.name != "repeat" && std::find(known.begin(), known.end(), entry.key.name) == known.end()) {
      diagnostics_.error(
          entry.key.place,
          fmt::format("unknown field '{}' of {}{}", entry.key.name, what, suggestion(entry.key.name, known)),
          "{ of: curve, t: ... }, { of: curve, s: 0.5 }, { of: surface, u: ..., v: ... } or { of: "
          "surface, point: [i, j] }");
      return std::nullopt;
    }
  const Value& of = with_counters(*map.find("of"), counters);
  if (const Scoped* named = named_place(of)) {
    for (const Entry& entry : map.entries)
      if (entry.key.name != "of" && entry.key.name != "vector") {
        diagnostics_.error(entry.key.place,
                           fmt::format("'{}' is a place: it says '{}' itself", of.text, entry.key.name));
        return std::nullopt;
      }
    return locate(*named->value, named->counters, what);
  }
  const auto built = refer(of, counters, kCurveOrSurface);
  if (!built) return std::nullopt;
  Located place;
  const bool on_curve = built->category == Category::curve;
  if (on_curve) {
    place.curve = std::any_cast<CurvePtr>(built->value);
  } else if (const auto* surface = std::any_cast<SurfacePtr>(&built->value)) {
    place.surface = *surface;
  } else {
    diagnostics_.error(map.find("of")->place, "this is a set of surfaces; name one of its members",
                       "for example teapot.0");
    return std::nullopt;
  }
  for (const char* key : {"t", "s", "u", "v"})
    if (const Value* value = map.find(key); value && (key[0] == 't' || key[0] == 's') != on_curve) {
      diagnostics_.error(value->place, fmt::format("'{}' is no parameter of a {}", key, on_curve ? "curve" : "surface"),
                         on_curve ? "t: its parameter, or s: the fraction of its length" : "u and v are");
      return std::nullopt;
    }
  const auto parameter = [&](const char* key) -> std::optional<double> {
    if (const Value* value = map.find(key)) return parameters_.number(*value, counters);
    diagnostics_.error(map.place, fmt::format("missing '{}' of {} on a {}", key, what, on_curve ? "curve" : "surface"));
    return std::nullopt;
  };
  const Value* fraction = map.find("s");
  if (fraction && map.find("t")) {
    diagnostics_.error(fraction->place, "'t' and 's' both say where: leave one out");
    return std::nullopt;
  }
  if (fraction) {
    const auto s = read_number_by(geometry::number().between(0, 1), *fraction, counters);
    if (!s) return std::nullopt;
    const auto t = attempt(map, "s", [&] { return geometry::parameter_at_fraction(*place.curve, *s); });
    if (!t) return std::nullopt;
    place.t = *t;
    return place;
  }
  const auto first = parameter(on_curve ? "t" : "u");
  const auto second = on_curve ? first : parameter("v");
  if (!first || !second) return std::nullopt;
  place.t = place.u = *first;
  place.v = *second;
  if (on_curve) {
    const auto& curve = *place.curve;
    if (!check_parameter(*map.find("t"), "t", place.t, "curve", curve.domain(), curve.period())) return std::nullopt;
    return place;
  }
  const geometry::Rectangle domain = place.surface->domain();
  const geometry::Periods periods = place.surface->periods();
  const bool good_u = check_parameter(*map.find("u"), "u", place.u, "surface", domain.u, periods.u);
  const bool good_v = check_parameter(*map.find("v"), "v", place.v, "surface", domain.v, periods.v);
  if (!good_u || !good_v) return std::nullopt;
  return place;
}

// { of: r, point: 2 }, { of: patch, point: [2, 2] }
std::optional<Vec3> Builder::read_control_point(const Value& map, const Counters& counters) {
  const Value& point = *map.find("point");
  for (const Entry& entry : map.entries)
    if (entry.key.name != "of" && entry.key.name != "point" && entry.key.name != "repeat") {
      diagnostics_.error(entry.key.place, fmt::format("'{}' does not go with 'point'", entry.key.name),
                         "{ of: surface, point: [i, j] } is a control point");
      return std::nullopt;
    }
  const auto built = refer(*map.find("of"), counters, kCurveOrSurface);
  if (!built) return std::nullopt;
  Affine placed;
  std::vector<Vec3> points;
  int columns = 0;  // 0: a curve
  if (const auto* curve = std::any_cast<CurvePtr>(&built->value)) {
    if (const auto* spline = spline_behind<geometry::NurbsCurve, geometry::TransformedCurve>(*curve, placed))
      for (int i = 0; i < spline->axis().distinct(); ++i)
        points.push_back(cartesian(spline->points()[static_cast<size_t>(i)]));
  } else if (const auto* surface = std::any_cast<SurfacePtr>(&built->value)) {
    if (const auto* spline = spline_behind<geometry::NurbsSurface, geometry::TransformedSurface>(*surface, placed)) {
      columns = spline->axis_v().distinct();
      for (int i = 0; i < spline->axis_u().distinct(); ++i)
        for (int j = 0; j < columns; ++j)
          points.push_back(cartesian(spline->form().points[static_cast<size_t>(i * spline->form().count_v() + j)]));
    }
  }
  if (points.empty()) {
    diagnostics_.error(map.find("of")->place, "this has no control points",
                       "splines, Bezier curves and surfaces, and polylines have");
    return std::nullopt;
  }
  const int counts[2] = {static_cast<int>(points.size()) / std::max(columns, 1), columns};
  const auto indices = read_list<int>(geometry::integer(), point, counters);
  if (!indices) return std::nullopt;
  if (indices->size() != (columns ? 2u : 1u)) {
    diagnostics_.error(
        point.place,
        columns ? "a control point of a surface has two indices" : "a control point of a curve has one index",
        columns ? "point: [i, j], i along u, j along v, from 0" : "point: i, from 0");
    return std::nullopt;
  }
  for (size_t k = 0; k < indices->size(); ++k)
    if ((*indices)[k] < 0 || (*indices)[k] >= counts[k]) {
      const Place& place = point.is_sequence() && k < point.items.size() ? point.items[k].place : point.place;
      diagnostics_.error(place, fmt::format("there is no control point {}: {} goes from 0 to {}", (*indices)[k],
                                            columns == 0 ? "the index"
                                            : k == 0     ? "i"
                                                         : "j",
                                            counts[k] - 1));
      return std::nullopt;
    }
  const int index = columns ? (*indices)[0] * columns + (*indices)[1] : (*indices)[0];
  return placed.point(points[static_cast<size_t>(index)]);
}

std::optional<Vec3> Builder::read_place_on(const Value& map, const Counters& counters) {
  if (!map.find("of")) {
    if (map.find("page"))
      diagnostics_.error(map.place, "a place on the page is no point of space",
                         "give coordinates or a place { of: ... }");
    else
      diagnostics_.error(map.place, "expected a point",
                         "coordinates [x, y, z], the name of a point, or a place { of: curve, t: ... }");
    return std::nullopt;
  }
  if (map.find("point")) return read_control_point(map, counters);
  if (is_selector(map)) return read_selected_place(map, counters);
  if (const Value* vector = map.find("vector")) {
    diagnostics_.error(vector->place, "a place has no 'vector'", "this would be a direction");
    return std::nullopt;
  }
  const auto place = locate(map, counters, "a place");
  if (!place) return std::nullopt;
  return place->curve ? place->curve->point(place->t) : place->surface->point(place->u, place->v);
}

// Frenet's frame of a curve (Golovanov 2016, 2.1), the derivatives and the normal of a surface.
std::optional<Vec3> Builder::read_vector_on(const Value& map, const Counters& counters) {
  const Value* which = map.find("vector");
  if (!map.find("of") || !which || !which->is_scalar()) {
    diagnostics_.error(map.place, "expected a direction", "x, [a, b, c] or { of: curve, t: ..., vector: tangent }");
    return std::nullopt;
  }
  const auto place = locate(map, counters, "a direction");
  if (!place) return std::nullopt;
  const std::string& word = which->text;
  if (place->curve) {
    const auto jet = place->curve->evaluate(place->t, 2);
    const Vec3 binormal = glm::cross(jet.d[1], jet.d[2]);
    if (word == "tangent") return jet.d[1];
    if (word == "normal" || word == "binormal") {
      if (!(glm::length(binormal) > 1e-12 * glm::dot(jet.d[1], jet.d[1]))) {
        diagnostics_.error(which->place, fmt::format("the curve is straight here: it has no {}", word),
                           "its tangent is defined");
        return std::nullopt;
      }
      return word == "binormal" ? binormal : glm::cross(binormal, jet.d[1]);
    }
  } else {
    const auto jet = place->surface->evaluate(place->u, place->v, 1);
    if (word == "du") return jet.du();
    if (word == "dv") return jet.dv();
    if (word == "normal") return place->surface->normal(place->u, place->v);
  }
  const std::vector<std::string> known = place->curve ? std::vector<std::string>{"tangent", "normal", "binormal"}
                                                      : std::vector<std::string>{"normal", "du", "dv"};
  diagnostics_.error(
      which->place,
      fmt::format("'{}' is no vector of a {}{}", word, place->curve ? "curve" : "surface", suggestion(word, known)),
      "it has " + listed(known));
  return std::nullopt;
}

// x, -z, [1, 2, 0], or taken from a curve or surface.
std::optional<Vec3> Builder::read_vector(const Value& value, const Counters& counters, bool unit) {
  if (value.invalid) return std::nullopt;
  if (value.is_scalar()) {
    std::string_view word = value.text;
    const bool negative = word.starts_with('-');
    if (negative) word.remove_prefix(1);
    if (word == "x" || word == "y" || word == "z") {
      Vec3 axis(0);
      axis[word[0] - 'x'] = negative ? -1 : 1;
      return axis;
    }
    diagnostics_.error(value.place, fmt::format("expected a direction, found '{}'", value.text),
                       "x, y, z, -x, -y, -z or components [a, b, c]");
    return std::nullopt;
  }
  const auto result = value.is_sequence() ? read_coordinates(value, counters) : read_vector_on(value, counters);
  if (!result) return std::nullopt;
  const double length = glm::length(*result);
  if (!(length > 0) || !std::isfinite(length)) {
    if (!unit && length == 0) return result;
    diagnostics_.error(value.place, "this direction has no length", "for instance x, -z or [1, 0, 1]");
    return std::nullopt;
  }
  return unit ? *result / length : *result;
}

}  // namespace lekalo::render
