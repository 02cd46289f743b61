#include "render/scene/values/value_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "render/scene/values/types.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::Dimension;
using geometry::Field;
using geometry::FieldType;
using geometry::Kind;

namespace {

// Angles are declared in radians and written in degrees.
std::string limits(const FieldType& type) {
  const double scale = type.dimension == Dimension::angle ? 180 / geometry::kPi : 1;
  std::string text;
  if (std::isfinite(type.minimum))
    text += fmt::format(" {} {:.9g}", type.minimum_excluded ? "greater than" : "at least", type.minimum * scale);
  if (std::isfinite(type.maximum))
    text += fmt::format("{} {} {:.9g}", text.empty() ? "" : " and", type.maximum_excluded ? "less than" : "at most",
                        type.maximum * scale);
  return text;
}

std::string number_text(const FieldType& type) {
  switch (type.dimension) {
    case Dimension::length:
      return "length" + limits(type);
    case Dimension::angle:
      return "angle in degrees" + limits(type);
    case Dimension::wavelength:
      return "wavelength in nm" + limits(type);
    case Dimension::plain:
      break;
  }
  return "number" + limits(type);
}

std::string count_text(const FieldType& type) {
  const bool upper = type.maximum_count < (1 << 30);
  if (upper && type.minimum_count == type.maximum_count) return fmt::format(" ({} of them)", type.minimum_count);
  if (upper) return fmt::format(" ({} to {})", type.minimum_count, type.maximum_count);
  if (type.minimum_count > 1) return fmt::format(" (at least {})", type.minimum_count);
  return "";
}

std::string plain_value_text(const FieldType& type) {
  switch (type.kind) {
    case Kind::number:
      return number_text(type);
    case Kind::integer:
      return "whole number" + limits(type);
    case Kind::boolean:
      return "true or false";
    case Kind::choice:
      return "one of " + listed(type.choices);
    case Kind::text:
      return "text";
    case Kind::file:
      return "name of a file";
    case Kind::name:
      return "a name";
    case Kind::point:
      return "point: coordinates, name or place";
    case Kind::direction:
      return "direction: x, -z, [a, b, c]";
    case Kind::vector:
      return "vector: [a, b, c]";
    case Kind::axis:
      return "axis: z, { through, along }";
    case Kind::frame:
      return "frame: { origin, z, x }, or center and normal (or axis) beside it";
    case Kind::range:
      return type.dimension == Dimension::angle ? "range of angles [from, to] in degrees" : "range [from, to]";
    case Kind::rectangle:
      return "part { u: [from, to], v: [from, to] }";
    case Kind::points:
      return "points" + count_text(type);
    case Kind::points2:
      return "points of the parameter plane" + count_text(type);
    case Kind::net:
      return "rows of points";
    case Kind::numbers:
      return "list of numbers" + limits(type) + count_text(type);
    case Kind::number_grid:
      return "rows of numbers" + limits(type);
    case Kind::indices:
      return "lists of point numbers, from 0";
    case Kind::knots:
      return "list of knots, or " +
             (type.choices.empty() ? "clamped, uniform, chord_length, centripetal" : listed(type.choices));
    case Kind::color:
      return std::find(type.categories.begin(), type.categories.end(), Category::texture) == type.categories.end()
                 ? "color"
                 : "color or texture";
    case Kind::formula:
      return "formula of " + listed(type.variables);
    case Kind::formulas:
      return "formulas of " + listed(type.variables) + count_text(type);
    case Kind::reference:
      return describe(type.categories) + ": name or map" + (type.fields ? ", or { style, hidden }" : "");
    case Kind::references:
      return "names or maps of " + describe(type.categories);
    case Kind::group:
    case Kind::groups: {
      std::vector<std::string> names;
      for (const Field& field : *type.fields) names.push_back(field.name);
      return fmt::format("{}{{ {} }}", type.kind == Kind::groups ? "list of " : "", listed(names));
    }
    case Kind::transform:
      return "step or list of steps: translate, rotate, scale, mirror, matrix";
    case Kind::page_length:
      return "length on the page, with unit: mm, pt, px";
    case Kind::picture_size:
      return "[width, height]";
    case Kind::words:
      return "list of words: " + listed(type.choices);
    case Kind::texts:
      return "list of texts in quotes";
    case Kind::command:
      return "list of words: a program and its arguments";
    case Kind::page_lengths:
      return "lengths on the page, with units" + count_text(type);
    case Kind::anchor:
      return "point, or { page: [5 mm, 8 mm] } from the lower left corner";
    case Kind::counts:
      return "count, list, or range 0..6";
    case Kind::label:
      return type.variables.empty() ? "TeX text"
                                    : "TeX text with %" + fmt::format("{}", fmt::join(type.variables, ", %"));
    case Kind::labels:
      return "TeX texts" + count_text(type);
    case Kind::name_rows:
      return "rows of names: [[a, b], [c, empty]]";
    case Kind::helpers:
      return "map of helpers: { control_polygon: { style: thin } }, or names";
  }
  return "";
}

}  // namespace

std::string value_text(const FieldType& type) {
  std::string text = plain_value_text(type);
  if (!type.choices.empty() && type.kind != Kind::choice && type.kind != Kind::words && type.kind != Kind::knots)
    text += ", or " + listed(type.choices);
  if (type.per_direction) text += "; or { u: ..., v: ... }";
  return text;
}

}  // namespace lekalo::render
