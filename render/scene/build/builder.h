// From a scene description to its model: names, types, references, repeats. The declarations of geometry/describe.h say
// what each type takes; this file's class reads values by them. Every error goes to the diagnostics with its place.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/bodies/topology/selection.h"
#include "geometry/describe.h"
#include "render/cameras/cameras.h"
#include "render/model/attributes.h"
#include "render/model/model.h"
#include "render/model/objects.h"
#include "render/scene/build/constraint_report.h"
#include "render/scene/build/external_note.h"
#include "render/scene/build/scope.h"
#include "render/scene/values/types.h"
#include "render/scene/yaml/include.h"

namespace lekalo::render {

using geometry::Affine;
using geometry::Axis;
using geometry::Field;
using geometry::Fields;
using geometry::FieldType;
using geometry::Frame;

// A value with the counters of the repeats around it.
struct Scoped {
  const Value* value = nullptr;
  Counters counters;
};

// Something built: its category and the C++ value that the category promises (describe.h).
struct Built {
  Category category = Category::curve;
  std::any value;
};

// An entry of a named section: one thing, or a family made by `repeat`.
struct NamedThing {
  const Entry* entry = nullptr;
  bool is_family = false;
  struct Member {
    std::string name;  // "3", or "3.1" of two counters; empty for a single thing
    Scoped scoped;
    enum class State { unknown, in_work, known, wrong } state = State::unknown;
    Built built;
    std::optional<Built> as_operand;  // of bodies: the entities carry its name
  };
  std::vector<Member> members;
  bool used = false;  // by another thing, an object or a camera
};

struct BuildOptions {
  std::vector<std::filesystem::path> search_path;  // of shipped files
  bool allow_external = false;                     // code from outside the program may be run
};

class Builder {
 public:
  Builder(const SceneDescription& scene, const BuildOptions& options, Diagnostics& diagnostics);

  // Everything in the scene, all errors reported. The model is of use only without errors.
  Model build();

  // Lines for stderr: which defaults were taken.
  const std::vector<DefaultTaken>& defaults_taken() const { return defaults_; }

  // What is known of things whose points come from outside.
  const std::vector<ExternalNote>& external_notes() const { return external_notes_; }

  // Of the section `attributes`, read when first asked for.
  const AttributeTable& attributes();

  // Of the section `constraints`; null without one.
  const std::shared_ptr<const ConstraintReport>& constraints() const { return constraints_; }

  // Every file that a field named, in the order of reading.
  const std::vector<std::filesystem::path>& files_named() const { return files_named_; }

  // For other kinds of files, which have fields, lists and repeats as scenes have (suite.cpp); nothing after an error.
  std::optional<Fields> read_fields(const std::vector<Field>& declared, const Value& map, const Counters& counters,
                                    const std::string& what, const std::vector<std::string>& also_allowed = {});
  // The same into `fields`, which holds what is right even if something else is wrong; whether all is right.
  bool read_fields_into(Fields& fields, const std::vector<Field>& declared, const Value& map, const Counters& counters,
                        const std::string& what, const std::vector<std::string>& also_allowed = {});
  // Items of a list, repeats expanded; a single value stands for a list of one.
  void each_item(const Value& value, const Counters& counters,
                 const std::function<void(const Value& item, const Counters& inner)>& visit);
  std::vector<Scoped> items(const Value& value, const Counters& counters);  // of each_item()
  // The list of a row that is repeated, { repeat: { i: 0..5 }, row: [..] }; others are their own.
  static const Value& row_of(const Value& value);
  // A copy in which every text has its templates filled: %k, %02k, %.3r, %(k+1); %% is a percent sign (templates.cpp).
  std::optional<Value> fill_templates(const Value& value, const Counters& counters);
  // A formula as --set takes it: as written, or its value if it speaks of counters.
  std::optional<std::string> setting(const Value& value, const Counters& counters);

 private:
  // --- builder_values.cpp: one value by a field's type; nothing after an error has been reported.
  std::optional<std::any> read(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<std::vector<std::string>> read_command(const Value& value, const Counters& counters);
  bool check_count(const FieldType& type, const Value& value, size_t count);
  // The same as items, each read as `type`; nothing if one of them is wrong.
  template <class T>
  std::optional<std::vector<T>> read_list(const FieldType& type, const Value& value, const Counters& counters);

  // --- builder_numbers.cpp
  std::optional<double> read_number_by(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<double> read_wavelength(const Value& value, const Counters& counters);
  std::optional<geometry::Interval> read_interval(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<std::vector<double>> read_numbers(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::ParameterValues> read_counts(const FieldType& type, const Value& value,
                                                       const Counters& counters);
  std::optional<geometry::Knots> read_knots(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<Expression> read_formula(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::Grid<double>> read_number_grid(const FieldType& type, const Value& value,
                                                         const Counters& counters);

  // --- builder_pictures.cpp: colours, sizes, texts, names of panels.
  std::optional<std::any> read_color(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::PictureSize> read_picture_size(const Value& value, const Counters& counters);
  std::optional<double> read_page_length_by(const FieldType& type, const Value& value);
  std::optional<TextTemplate> read_label(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<std::vector<std::vector<std::string>>> read_name_rows(const Value& value);

  // --- builder_places.cpp: points and directions, given or on curves and surfaces.
  struct Located;  // a place on a curve or a surface
  std::optional<Located> locate(const Value& map, const Counters& counters, const char* what);
  std::optional<Vec3> read_point(const Value& value, const Counters& counters);
  std::optional<Vec3> read_coordinates(const Value& value, const Counters& counters);
  std::optional<Vec3> read_place_on(const Value& map, const Counters& counters);
  const Scoped* named_place(const Value& name);
  std::optional<Vec3> read_control_point(const Value& map, const Counters& counters);
  std::optional<geometry::Anchor> read_anchor(const Value& value, const Counters& counters);
  std::optional<Vec3> read_vector(const Value& value, const Counters& counters, bool unit);
  std::optional<Vec3> read_vector_on(const Value& map, const Counters& counters);

  // --- builder_selectors.cpp: faces, edges and vertices of bodies by conditions.
  std::optional<geometry::Selector> read_selector(const Value& map, const Counters& counters);
  std::optional<std::vector<std::string>> read_element_names(const Value& value, const Counters& counters,
                                                             const char* number_of);
  std::optional<std::vector<geometry::BodyPtr>> read_operands(const Value& value, const Counters& counters);
  void note_operands(const std::any& made, const std::vector<Field>& declared, const Fields& fields,
                     const Affine& placed);
  struct Choice {
    geometry::BodyPtr body;
    geometry::Element element;
    std::vector<int> indices;
  };
  std::optional<Choice> choose(const Value& map, const Counters& counters, std::span<const Category> wanted);
  std::optional<Choice> choose_one(const Value& map, const Counters& counters, std::span<const Category> wanted);
  std::optional<std::vector<Built>> selected(const Value& map, const Counters& counters,
                                             std::span<const Category> wanted);
  std::optional<std::vector<Built>> elements_called(const geometry::Body& body, std::string_view name,
                                                    const Value& asked, std::span<const Category> wanted);
  std::optional<Built> select_one(const Value& map, const Counters& counters, std::span<const Category> wanted);
  std::optional<Vec3> read_selected_place(const Value& map, const Counters& counters);
  std::vector<Vec3> spots_of(const Value& map, const Counters& counters);

  // --- builder_frames.cpp: axes, frames, points in lists and nets, transforms.
  std::optional<Axis> read_axis(const Value& value, const Counters& counters);
  std::optional<Frame> read_frame(const Value& value, const Counters& counters);
  std::optional<Frame> read_short_frame(const Value& map, const Value* frame, const Counters& counters);
  std::optional<std::vector<Vec3>> read_points(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::Grid<Vec3>> read_net(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<Affine> read_transform(const Value& value, const Counters& counters);
  std::optional<Affine> read_transform_step(const Value& step, const Counters& counters);

  // --- builder_fields.cpp: maps of declared fields.
  std::optional<std::any> read_group(const FieldType& type, const Value& map, const Counters& counters,
                                     const std::string& what);
  bool read_field(const Field& field, const Value& value, const Counters& counters, Fields& fields);
  const Value& default_value(const std::string& text);
  bool check(const TypeDeclaration& type, const Fields& fields, const Value& map);
  // make(), with what it throws reported at the fields of `map`.
  template <class Make>
  auto attempt(const Value& map, const std::string& what, Make make) -> std::optional<decltype(make())> {
    try {
      return make();
    } catch (const geometry::FieldError& error) {
      diagnostics_.error(place_of_field(map, error.field), error.what(), error.hint);
    } catch (const std::invalid_argument& error) {
      diagnostics_.error(map.place, what + ": " + error.what());
    }
    return std::nullopt;
  }
  static const Place& place_of_field(const Value& map, std::string_view path);

  // --- builder_types.cpp: maps with a `type`.
  std::optional<Built> build_typed(const Value& map, const Counters& counters, std::span<const Category> wanted);
  std::optional<Built> as_wanted(Built built, const Value& value, std::span<const Category> wanted);
  const TypeDeclaration* type_of(const Value& map, std::span<const Category> wanted);
  // The value of a map of the type's fields and those common to its category.
  std::optional<std::any> build_as(const TypeDeclaration& type, const Value& map, const Counters& counters);
  const std::vector<Field>& declared_fields(const TypeDeclaration& type);
  void note_external(const std::any& value, const Value& map);
  std::optional<Built> transformed(Built built, const Affine& map, const Value& place);
  // The same, or the thing itself where nothing moves it.
  std::optional<Built> placed(Built built, const Affine& transform, const Value& place);
  std::optional<std::vector<std::any>> read_helpers(const Value& value, const Counters& counters);
  bool check_helpers(const Value& object, const Fields& fields);
  bool check_lines(const Value& object, const Fields& fields);

  // --- builder_ranges.cpp: what shows nothing of what it is for.
  void outside_of_domain(const Value& value, const std::string& name, double x, const char* what,
                         const geometry::Interval& domain);
  bool check_parameter(const Value& value, const char* name, double x, const char* what,
                       const geometry::Interval& domain, double period);
  bool check_line_values(const Value& given, const char* name, const geometry::ParameterValues& asked,
                         const std::vector<std::any>& shapes);
  bool check_figure(const Value& map, const std::function<void()>& make);
  bool check_helper_values(const Helper& helper, const Value& map, const std::vector<std::any>& shapes);
  bool check_size(const TypeDeclaration& type, const Fields& fields, const Value& map);
  void note_shapes_spoken_of(const Value& map, const Counters& counters, Fields& values);

  // --- builder_references.cpp, builder_repeats.cpp: names, families.
  void declare_section(const char* section);
  // A name whose counters are put in: c.%i, or { of: c, member: i }; any other value itself.
  const Value& with_counters(const Value& value, const Counters& counters);
  std::optional<Built> refer(const Value& value, const Counters& counters, std::span<const Category> wanted);
  std::optional<std::vector<std::any>> refer_all(const Value& value, const Counters& counters,
                                                 std::span<const Category> wanted);
  // The same one by one, as there may be very many: false if one of them is wrong.
  bool refer_each(const Value& value, const Counters& counters, std::span<const Category> wanted,
                  const std::function<void(std::any)>& take);
  std::vector<std::string> names_of_references(const Value& value, const Counters& counters,
                                               std::span<const Category> wanted);
  std::optional<std::vector<Built>> named(const Value& value, std::span<const Category> wanted);
  // A thing that a name stands for, or the part of it: of blank.end the body and end.
  struct NamedPart {
    const NamedThing* thing = nullptr;
    NamedThing::Member* member = nullptr;
    std::string part;  // empty: the whole
  };
  // All of them, built; nothing after an error.
  std::optional<std::vector<NamedPart>> parts_named(const Value& value, std::span<const Category> wanted);
  const Built* member(NamedThing& thing, NamedThing::Member& member, std::span<const Category> wanted);
  // A member of a set, or the faces, edges or vertices of a body that a name stands for.
  std::optional<std::vector<Built>> part_of(const Built& whole, std::string_view part, const Value& asked,
                                            std::span<const Category> wanted);
  const Built& operand_of(const NamedThing& thing, NamedThing::Member& member);
  const Value* with_like(const Value& map, const Value* section);
  std::map<std::string, NamedThing, std::less<>>* things_of(Category category);
  const Value* section(const char* name) const;
  // Calls visit(counters, member name) for every combination of a map's `repeat`.
  bool repeat(const Value& map, const Counters& counters,
              const std::function<void(const Counters&, const std::string&)>& visit);
  std::optional<std::vector<double>> read_whole_numbers(const Value& range, const Counters& counters);

  // --- builder_attributes.cpp
  void read_attributes(const Value& map, const Counters& counters);
  bool read_numbers_of(const Value& map, const Counters& counters, ElementAttributes& into);
  std::optional<std::vector<NamedElement>> elements_of(const Value& value, const Counters& counters);
  std::optional<std::vector<NamedElement>> elements_of_item(const Value& written, const Counters& counters);
  const Entry* thing_named(const Value& written, const Counters& counters);
  std::optional<std::vector<NamedElement>> elements_named(const Value& name);
  std::optional<std::vector<NamedElement>> elements_selected(const Value& map, const Counters& counters);
  std::optional<geometry::BodyPtr> faces_of(const Built& whole, const Value& asked);
  std::optional<AttributeTable> said_of(const Entry* thing, const std::string& name);
  std::vector<std::string> names_of_attributes();
  std::optional<MeasuredQuantity> quantity_of_element(const QuantityOfElement& asked, const Value& map);
  // What attributes say of the shape; null: nothing.
  MaterialPtr material_of_shape(const Entity& shape);
  // The materials of its faces, and what shines through, by the attributes of its shape.
  void dress(Object& object);

  // --- builder_constraints.cpp
  void solve_constraints();

  // --- builder_scene.cpp: sections to model.
  std::optional<MeasuredQuantity> measured(const Value& map);
  void check_sections();
  void build_named(Model& model);
  // Calls visit(name, built) for everything right in a named section.
  void visit_named(const char* section, Category category,
                   const std::function<void(const std::string&, const Built&)>& visit);
  std::optional<std::vector<Object>> build_objects(const Value& list);
  void default_objects(Model& model);
  void fill_materials(std::vector<Object>& objects);
  GroupPtr in_material(const GroupPtr& group, const MaterialPtr& material);
  MaterialPtr default_material();

  // --- builder_view.cpp
  void build_lights(Model& model);
  void build_camera(Model& model);
  void build_film(const Fields& image, Model& model);
  void check_crop(const Fields& image, const Value* given, Film& film);
  bool names_frames() const;
  void build_outputs(Model& model);
  std::optional<OutputFile> build_output(const Value& value, const Counters& counters);

  // --- builder_drawing.cpp
  void merge_styles();
  void build_drawing(Model& model);
  void check_axes(const Value* drawing, bool graph);
  // Colour bars without numbers of their own belong to an integrator that has some.
  void check_color_bars(const Model& model);
  void build_panels(const std::optional<Fields>& drawing, Model& model);
  void build_layout(Model& model);
  // Reports a name that no panel has.
  bool check_panel(const Value& name);

  const SceneDescription& scene_;
  BuildOptions options_;
  Diagnostics& diagnostics_;
  std::map<std::string, const Value*, std::less<>> misspelt_sections_;  // by the name that is meant
  Parameters parameters_;
  Value styles_;    // the built-in ones with the scene's changes
  Value geometry_;  // the section with the points of constraints
  std::map<std::string, std::map<std::string, NamedThing, std::less<>>> sections_;
  std::shared_ptr<AttributeTable> attributes_;  // null: not asked for yet
  std::map<std::string, Value> default_values_;
  std::map<const TypeDeclaration*, std::vector<Field>> declared_;
  std::map<const void*, const TypeDeclaration*> types_;  // of built geometry, by identity()
  std::map<std::pair<const Group*, const Material*>, GroupPtr> groups_in_material_;
  std::map<const Value*, GroupPtr> alike_groups_;  // of families, before their transforms
  std::vector<GroupPtr> kept_groups_;              // so that no address of theirs is used again
  std::shared_ptr<const ConstraintReport> constraints_;
  std::deque<Value> made_;  // maps that `like` made
  std::map<const Value*, const Value*> liked_;
  bool names_use_ = true;  // not those by which a named place or a measured number says of what: it is shown
  std::vector<DefaultTaken> defaults_;
  CameraFactory scene_view_;  // of what it is given
  std::vector<ExternalNote> external_notes_;
  std::vector<std::filesystem::path> files_named_;
  MaterialPtr default_material_;
  std::set<std::string> like_in_work_;
  bool in_geometry_ = false;  // what is being read is a field of geometry
  std::map<const geometry::Body*, std::vector<geometry::BodyPtr>> operands_;  // of what was made of bodies
  std::vector<geometry::BodyPtr> kept_bodies_;                                // so that no address is used again
  int depth_ = 0;
};

// Whether a map says by conditions which faces, edges or vertices of a body are meant.
bool is_selector(const Value& map);

// Checks of one value by its field's type, with the words for messages.
bool is_outside(const FieldType& type, double x);
bool is_word(const FieldType& type, const Value& value);
// "between 0 and 1", "at least 3"; limits are multiplied by `scale`.
std::string range_text(const FieldType& type, double scale);

}  // namespace lekalo::render
