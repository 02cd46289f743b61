#include "geometry/describe.h"

namespace lekalo::geometry {

std::string_view name(Category category) {
  switch (category) {
    case Category::point:
      return "point";
    case Category::curve:
      return "curve";
    case Category::surface:
      return "surface";
    case Category::body:
      return "body";
    case Category::mesh:
      return "mesh";
    case Category::shape:
      return "shape";
    case Category::group:
      return "group";
    case Category::object:
      return "object";
    case Category::material:
      return "material";
    case Category::texture:
      return "texture";
    case Category::light:
      return "light";
    case Category::camera:
      return "camera";
    case Category::integrator:
      return "integrator";
    case Category::style:
      return "style";
    case Category::helper:
      return "helper";
    case Category::annotation:
      return "annotation";
    case Category::quantity:
      return "quantity";
    case Category::panel:
      return "panel";
  }
  return "";
}

namespace {
FieldType of_kind(Kind kind) {
  FieldType type;
  type.kind = kind;
  return type;
}
}  // namespace

FieldType FieldType::positive() const {
  FieldType type = *this;
  type.minimum = 0;
  type.minimum_excluded = true;
  return type;
}
FieldType FieldType::non_negative() const { return at_least(0); }
FieldType FieldType::at_least(double lowest) const {
  FieldType type = *this;
  type.minimum = lowest;
  type.minimum_excluded = false;
  return type;
}
FieldType FieldType::at_most(double highest) const {
  FieldType type = *this;
  type.maximum = highest;
  return type;
}
FieldType FieldType::above(double bound) const {
  FieldType type = at_least(bound);
  type.minimum_excluded = true;
  return type;
}
FieldType FieldType::below(double bound) const {
  FieldType type = at_most(bound);
  type.maximum_excluded = true;
  return type;
}
FieldType FieldType::between(double lowest, double highest) const { return at_least(lowest).at_most(highest); }
FieldType FieldType::count(int lowest, int highest) const {
  FieldType type = *this;
  type.minimum_count = lowest;
  type.maximum_count = highest;
  return type;
}
FieldType FieldType::for_each_direction() const {
  FieldType type = *this;
  type.per_direction = true;
  return type;
}
FieldType FieldType::or_word(std::vector<std::string> words) const {
  FieldType type = *this;
  type.choices = std::move(words);
  return type;
}

FieldType number() { return of_kind(Kind::number); }
FieldType length() {
  FieldType type = of_kind(Kind::number);
  type.dimension = Dimension::length;
  return type;
}
FieldType angle() {
  FieldType type = of_kind(Kind::number);
  type.dimension = Dimension::angle;
  return type;
}
FieldType integer() { return of_kind(Kind::integer); }
FieldType boolean() { return of_kind(Kind::boolean); }
FieldType choice(std::vector<std::string> words) { return of_kind(Kind::choice).or_word(std::move(words)); }
FieldType text() { return of_kind(Kind::text); }
FieldType file() { return of_kind(Kind::file); }
FieldType new_name() { return of_kind(Kind::name); }
FieldType point() { return of_kind(Kind::point); }
FieldType direction() { return of_kind(Kind::direction); }
FieldType vector() { return of_kind(Kind::vector); }
FieldType axis() { return of_kind(Kind::axis); }
FieldType frame() { return of_kind(Kind::frame); }
FieldType range() { return of_kind(Kind::range); }
FieldType angle_range() {
  FieldType type = of_kind(Kind::range);
  type.dimension = Dimension::angle;
  return type;
}
FieldType rectangle() { return of_kind(Kind::rectangle); }
FieldType points() { return of_kind(Kind::points); }
FieldType parameter_points() { return of_kind(Kind::points2); }
FieldType net() { return of_kind(Kind::net); }
FieldType numbers() { return of_kind(Kind::numbers); }
FieldType number_grid() { return of_kind(Kind::number_grid); }
FieldType indices() { return of_kind(Kind::indices); }
FieldType knots() { return of_kind(Kind::knots); }
FieldType color() { return of_kind(Kind::color); }
FieldType formula(std::vector<std::string> variables) {
  FieldType type = of_kind(Kind::formula);
  type.variables = std::move(variables);
  return type;
}
FieldType angle_formula(std::vector<std::string> variables) {
  FieldType type = formula(std::move(variables));
  type.dimension = Dimension::angle;
  return type;
}
FieldType formulas(std::vector<std::string> variables, int lowest, int highest) {
  FieldType type = of_kind(Kind::formulas).count(lowest, highest);
  type.variables = std::move(variables);
  return type;
}
FieldType reference(std::vector<Category> categories) {
  FieldType type = of_kind(Kind::reference);
  type.categories = std::move(categories);
  return type;
}
FieldType references(std::vector<Category> categories) {
  FieldType type = of_kind(Kind::references).count(1);
  type.categories = std::move(categories);
  return type;
}
FieldType group(std::vector<Field> fields) {
  FieldType type = of_kind(Kind::group);
  type.fields = std::make_shared<const std::vector<Field>>(std::move(fields));
  return type;
}
FieldType groups(std::vector<Field> fields) {
  FieldType type = group(std::move(fields));
  type.kind = Kind::groups;
  return type;
}
FieldType transform() { return of_kind(Kind::transform); }
FieldType page_length() { return of_kind(Kind::page_length); }
FieldType texts() { return of_kind(Kind::texts); }
FieldType command() { return of_kind(Kind::command); }
FieldType page_lengths() { return of_kind(Kind::page_lengths); }
FieldType anchor() { return of_kind(Kind::anchor); }
FieldType counts() { return of_kind(Kind::counts); }
FieldType label(std::vector<std::string> counters) {
  FieldType type = of_kind(Kind::label);
  type.variables = std::move(counters);
  return type;
}
FieldType labels() { return of_kind(Kind::labels); }
FieldType name_rows() { return of_kind(Kind::name_rows); }
FieldType helpers() { return of_kind(Kind::helpers); }
FieldType wavelength() {
  FieldType type = of_kind(Kind::number);
  type.dimension = Dimension::wavelength;
  return type;
}
FieldType picture_size() { return of_kind(Kind::picture_size); }
FieldType words(std::vector<std::string> allowed) { return of_kind(Kind::words).or_word(std::move(allowed)); }

const std::any& Fields::any(std::string_view field) const {
  const auto found = values_.find(field);
  if (found == values_.end())
    throw std::logic_error("field '" + std::string(field) + "' was not declared or has no value");
  return found->second;
}

std::string Fields::word(std::string_view field) const {
  const std::string* word = std::any_cast<std::string>(&any(field));
  return word ? *word : std::string();
}

TypeDeclaration& TypeDeclaration::field(std::string field_name, FieldType type, std::string text) {
  fields.push_back({std::move(field_name), std::move(type), std::move(text), true, {}});
  return *this;
}
TypeDeclaration& TypeDeclaration::field(std::string field_name, FieldType type, std::string text,
                                        std::string default_text) {
  fields.push_back({std::move(field_name), std::move(type), std::move(text), false, std::move(default_text)});
  return *this;
}
TypeDeclaration& TypeDeclaration::optional(std::string field_name, FieldType type, std::string text) {
  fields.push_back({std::move(field_name), std::move(type), std::move(text), false, {}});
  return *this;
}
TypeDeclaration& TypeDeclaration::check(std::string condition, std::string message) {
  checks.push_back({std::move(condition), std::move(message)});
  return *this;
}
TypeDeclaration& TypeDeclaration::shows(std::vector<std::string> helper_names) {
  helpers = std::move(helper_names);
  return *this;
}

TypeDeclaration& TypeDeclaration::example(std::string fields_as_written) {
  example_fields = std::move(fields_as_written);
  return *this;
}

TypeDeclaration declare(Category category, std::string type_name, std::string description) {
  TypeDeclaration type;
  type.name = std::move(type_name);
  type.category = category;
  type.description = std::move(description);
  return type;
}

}  // namespace lekalo::geometry
