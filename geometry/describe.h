// Declarations of the types that a scene file can name, as plain data.
//
// A type says once what it is called, which fields it takes (kind, unit, range, default, description) and how it is
// built from their values. Reading, checking, the JSON Schema, the reference manual and all messages are derived from
// these declarations by render/scene; nothing here knows files. Angles reach a builder in radians.
#pragma once

#include <any>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/surface.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

class Body;
class Mesh;
class Shape;
class Expression;
using BodyPtr = std::shared_ptr<const Body>;
using MeshPtr = std::shared_ptr<const Mesh>;
using ShapePtr = std::shared_ptr<const Shape>;

// What kind of thing a type builds; a reference field asks for one or more of these. The std::any that a builder
// returns holds the named C++ type.
enum class Category {
  point,    // Vec3
  curve,    // CurvePtr
  surface,  // SurfacePtr
  body,     // BodyPtr
  mesh,     // MeshPtr
  shape,    // ShapePtr
  group,    // the categories below are built by lekalo::render
  object,
  material,
  texture,
  light,
  camera,
  integrator,
  style,
  helper,
  annotation,
  quantity,
  panel
};
std::string_view name(Category category);

// Rectangular array of values, row-major: at(i, j) with i < rows (the u index), j < columns (the v index).
template <class T>
struct Grid {
  int rows = 0;
  int columns = 0;
  std::vector<T> values;
  T& at(int i, int j) { return values[static_cast<size_t>(i) * columns + j]; }
  const T& at(int i, int j) const { return values[static_cast<size_t>(i) * columns + j]; }
};

// Straight axis: the point and the unit direction.
struct Axis {
  Vec3 through{0};
  Vec3 along{0, 0, 1};
};

// A knot vector in full, or the name of the rule that makes it.
struct Knots {
  std::string rule;            // clamped, uniform, chord_length, centripetal; empty when `values` is given
  std::vector<double> values;  // the full vector
};

// Width and height of a picture; 0 stands for `auto`.
struct PictureSize {
  double width = 0;
  double height = 0;
  bool on_paper = false;  // millimetres rather than pixels
};

// Where an annotation is held: a point of space, or of the page in millimetres from its lower left corner.
struct Anchor {
  Vec3 point{0};
  bool on_page = false;
};

// Values of a parameter: so many, evenly spaced over its range, or these.
struct ParameterValues {
  int count = 0;  // 0 when `values` are given
  std::vector<double> values;
};

// What a field accepts.
enum class Kind {
  number,        // double; `dimension` says plain, length or angle
  integer,       // int
  boolean,       // bool
  choice,        // std::string, one of `choices`
  text,          // std::string
  file,          // std::string: path of an existing file, made absolute
  name,          // std::string: a new name, not looked up
  point,         // Vec3: a place (coordinates, a named point, a point on a curve or surface)
  direction,     // Vec3 of unit length: x, -z, a list, or taken from a curve or surface
  vector,        // Vec3 of any length
  axis,          // Axis
  frame,         // Frame: { origin, z, x }; with the short forms `center` and `normal` beside it
  range,         // Interval [a, b], a < b
  rectangle,     // Rectangle: { u: [a, b], v: [a, b] }
  points,        // std::vector<Vec3>
  points2,       // std::vector<Vec3> with z = 0: places in a parameter plane
  net,           // Grid<Vec3>
  numbers,       // std::vector<double>
  number_grid,   // Grid<double>
  indices,       // std::vector<std::vector<int>>: lists of point numbers
  knots,         // Knots
  color,         // Vec3: linear Rec.709
  formula,       // Expression of `variables`
  formulas,      // std::vector<Expression>, `minimum_count` to `maximum_count`
  reference,     // one built thing of one of `categories`, as std::any
  references,    // std::vector<std::any>; a family stands for its members
  group,         // Fields: a map with its own declared fields
  groups,        // std::vector<Fields>
  transform,     // Affine: a list of steps
  page_length,   // double in millimetres (of mm, pt, px at the page's resolution)
  picture_size,  // PictureSize: [960, 540], [84 mm, auto]
  words,         // std::vector<std::string>, each one of `choices`
  texts,         // std::vector<std::string>
  command,       // std::vector<std::string>: a program and its words; names of files beside the scene made absolute
  page_lengths,  // std::vector<double> in millimetres
  anchor,        // Anchor: a place, or { page: [5 mm, 8 mm] }
  counts,        // ParameterValues: a count, a list, or a range 0..6
  label,         // render::TextTemplate: TeX text with %i, %(formula); its counters are `variables`
  labels,        // std::vector<render::TextTemplate>
  name_rows,     // std::vector<std::vector<std::string>>: rows of names that stand elsewhere in the scene
  helpers        // std::vector<std::any>: a map from names of helpers to their fields
};

enum class Dimension { plain, length, angle, wavelength };

struct Field;

struct FieldType {
  Kind kind = Kind::number;
  Dimension dimension = Dimension::plain;
  double minimum = -kInfinity;
  double maximum = kInfinity;
  bool minimum_excluded = false;
  bool maximum_excluded = false;
  int minimum_count = 0;  // of list kinds
  int maximum_count = 1 << 30;
  std::vector<std::string> choices;                  // of a choice; for a number, words accepted in its place
  std::vector<Category> categories;                  // of references
  std::vector<std::string> variables;                // of formulas
  std::shared_ptr<const std::vector<Field>> fields;  // of groups
  bool per_direction = false;  // one value for both u and v, or { u:, v: }: read with Fields::u(), Fields::v()

  FieldType positive() const;
  FieldType non_negative() const;
  FieldType at_least(double lowest) const;
  FieldType at_most(double highest) const;
  FieldType between(double lowest, double highest) const;
  FieldType above(double bound) const;  // the bound itself excluded
  FieldType below(double bound) const;
  FieldType count(int lowest, int highest = 1 << 30) const;
  FieldType for_each_direction() const;
  FieldType or_word(std::vector<std::string> words) const;
};

// Field kinds, as declarations write them.
FieldType number();
FieldType length();
FieldType angle();
FieldType integer();
FieldType boolean();
FieldType choice(std::vector<std::string> words);
FieldType text();
FieldType file();
FieldType new_name();
FieldType point();
FieldType direction();
FieldType vector();
FieldType axis();
FieldType frame();
FieldType range();
FieldType angle_range();
FieldType rectangle();
FieldType points();
FieldType parameter_points();
FieldType net();
FieldType numbers();
FieldType number_grid();
FieldType indices();
FieldType knots();
FieldType color();
FieldType formula(std::vector<std::string> variables);
FieldType angle_formula(std::vector<std::string> variables);
FieldType formulas(std::vector<std::string> variables, int lowest, int highest);
FieldType reference(std::vector<Category> categories);
FieldType references(std::vector<Category> categories);
FieldType group(std::vector<Field> fields);
FieldType groups(std::vector<Field> fields);
FieldType transform();
FieldType page_length();
FieldType picture_size();
FieldType words(std::vector<std::string> words);
FieldType texts();
FieldType command();
FieldType page_lengths();
FieldType anchor();
FieldType counts();
FieldType label(std::vector<std::string> counters = {});
FieldType labels();
FieldType name_rows();
FieldType helpers();
FieldType wavelength();

struct Field {
  std::string name;
  FieldType type;
  std::string description;
  bool required = true;
  // Written as a scene file would; read by the same rules as a given value. Empty: an optional field without a value,
  // which the builder asks for with Fields::has.
  std::string default_text;
};

// A wrong value found while building: the scene reader reports it at the field's place.
class FieldError : public std::invalid_argument {
 public:
  FieldError(std::string field, const std::string& message, std::string hint = {})
      : std::invalid_argument(message), field(std::move(field)), hint(std::move(hint)) {}
  std::string field;
  std::string hint;
};

// The values of a declaration's fields, given or default, as a builder sees them. Asking for a field that was not
// declared, or by the wrong kind, is a mistake in the program (std::logic_error).
class Fields {
 public:
  bool has(std::string_view field) const { return values_.find(field) != values_.end(); }

  double number(std::string_view field) const { return get<double>(field); }
  int integer(std::string_view field) const { return get<int>(field); }
  bool boolean(std::string_view field) const { return get<bool>(field); }
  const std::string& text(std::string_view field) const { return get<std::string>(field); }
  // The word of a number field that also accepts words, or empty when it holds a number.
  std::string word(std::string_view field) const;
  const Vec3& vec3(std::string_view field) const { return get<Vec3>(field); }
  const Axis& axis(std::string_view field) const { return get<Axis>(field); }
  const Frame& frame(std::string_view field = "frame") const { return get<Frame>(field); }
  const Interval& range(std::string_view field) const { return get<Interval>(field); }
  const Rectangle& rectangle(std::string_view field) const { return get<Rectangle>(field); }
  const std::vector<Vec3>& points(std::string_view field) const { return get<std::vector<Vec3>>(field); }
  const Grid<Vec3>& net(std::string_view field) const { return get<Grid<Vec3>>(field); }
  const std::vector<double>& numbers(std::string_view field) const { return get<std::vector<double>>(field); }
  const Grid<double>& number_grid(std::string_view field) const { return get<Grid<double>>(field); }
  const std::vector<std::vector<int>>& indices(std::string_view field) const {
    return get<std::vector<std::vector<int>>>(field);
  }
  const Knots& knots(std::string_view field) const { return get<Knots>(field); }
  const Affine& transform(std::string_view field) const { return get<Affine>(field); }
  const Fields& group(std::string_view field) const { return get<Fields>(field); }
  const std::vector<Fields>& groups(std::string_view field) const { return get<std::vector<Fields>>(field); }

  // A per-direction field's two values.
  template <class T>
  const T& u(std::string_view field) const {
    return get<T>(std::string(field) + ".u");
  }
  template <class T>
  const T& v(std::string_view field) const {
    return get<T>(std::string(field) + ".v");
  }

  CurvePtr curve(std::string_view field) const { return get<CurvePtr>(field); }
  SurfacePtr surface(std::string_view field) const { return get<SurfacePtr>(field); }
  BodyPtr body(std::string_view field) const { return get<BodyPtr>(field); }
  const std::vector<std::any>& references(std::string_view field) const { return get<std::vector<std::any>>(field); }

  template <class T>
  const T& get(std::string_view field) const {
    const T* value = std::any_cast<T>(&any(field));
    if (!value) throw std::logic_error("field '" + std::string(field) + "' is not of the kind asked for");
    return *value;
  }
  template <class T>
  bool holds(std::string_view field) const {
    const auto found = values_.find(field);
    return found != values_.end() && std::any_cast<T>(&found->second);
  }
  const std::any& any(std::string_view field) const;
  void set(std::string field, std::any value) { values_[std::move(field)] = std::move(value); }
  // Takes over what was written in `other`.
  void override_by(const Fields& other) {
    for (const auto& [field, value] : other.values_)
      if (other.given(field.substr(0, field.find('.')))) values_[field] = value;
    given_.insert(other.given_.begin(), other.given_.end());
  }

  // Whether the field was written, and has not its default value.
  bool given(std::string_view field) const { return given_.find(field) != given_.end(); }
  void set_given(std::string field) { given_.insert(std::move(field)); }

 private:
  std::map<std::string, std::any, std::less<>> values_;
  std::set<std::string, std::less<>> given_;
};

// One type: all that the program knows about it apart from its class.
struct TypeDeclaration {
  std::string name;
  Category category = Category::curve;
  std::string description;
  std::vector<Field> fields;
  struct Check {
    std::string condition;  // expression over number fields
    std::string message;
  };
  std::vector<Check> checks;
  std::function<std::any(const Fields&)> build;
  // Names of the helpers that `show` of an object offers for this type alone (control_polygon, knots, ...).
  std::vector<std::string> helpers;
  // Fields of an example for the manual, "height: 2, radius: 1", where the needed ones alone make none that is good.
  std::string example_fields;
  // Building one runs code from outside the program: refused unless the user allows it.
  bool runs_foreign_code = false;

  TypeDeclaration& field(std::string name, FieldType type, std::string description);
  TypeDeclaration& field(std::string name, FieldType type, std::string description, std::string default_text);
  TypeDeclaration& optional(std::string name, FieldType type, std::string description);
  TypeDeclaration& check(std::string condition, std::string message);
  TypeDeclaration& shows(std::vector<std::string> helper_names);
  TypeDeclaration& example(std::string fields_as_written);
  // build takes const Fields& and returns a concrete Curve, Surface, ... by value; it is stored as the category's
  // shared pointer.
  template <class Build>
  TypeDeclaration& built_by(Build builder);
};

// Starts a declaration: declare(Category::surface, "torus_surface", "Ring, horn, ...").field(...).built_by(...)
TypeDeclaration declare(Category category, std::string name, std::string description);

// All types of lekalo_geometry: every family's declarations, from one list in each of curves/all.cpp, surfaces/all.cpp,
// bodies/all.cpp.
const std::vector<TypeDeclaration>& geometry_types();

namespace detail {
template <class T>
std::any as_built(T&& value) {
  using Plain = std::decay_t<T>;
  if constexpr (std::is_base_of_v<Curve, Plain>)
    return CurvePtr(std::make_shared<Plain>(std::forward<T>(value)));
  else if constexpr (std::is_base_of_v<Surface, Plain>)
    return SurfacePtr(std::make_shared<Plain>(std::forward<T>(value)));
  else if constexpr (std::is_same_v<Plain, std::any>)
    return value;
  else
    return std::any(std::forward<T>(value));
}
}  // namespace detail

template <class Build>
TypeDeclaration& TypeDeclaration::built_by(Build builder) {
  build = [builder](const Fields& fields) -> std::any { return detail::as_built(builder(fields)); };
  return *this;
}

}  // namespace lekalo::geometry
