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

#include "geometry/describe.h"
#include "render/scene/include.h"
#include "render/scene/model.h"
#include "render/scene/scope.h"
#include "render/scene/types.h"

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
  };
  std::vector<Member> members;
  bool used = false;  // by another thing, an object or a camera
};

struct BuildOptions {
  std::vector<std::filesystem::path> search_path;  // of shipped files
};

class Builder {
 public:
  Builder(const SceneDescription& scene, const BuildOptions& options, Diagnostics& diagnostics);

  // Everything in the scene, all errors reported. The model is of use only without errors.
  Model build();

  // Lines for stderr: which defaults were taken.
  const std::vector<std::string>& defaults_taken() const { return defaults_; }

  // Every file that a field named, in the order of reading.
  const std::vector<std::filesystem::path>& files_named() const { return files_named_; }

  // For other kinds of files, which have fields, lists and repeats as scenes have (suite.cpp); nothing after an error.
  std::optional<Fields> read_fields(const std::vector<Field>& declared, const Value& map, const Counters& counters,
                                    const std::string& what, const std::vector<std::string>& also_allowed = {});
  // Items of a list, repeats expanded; a single value stands for a list of one.
  std::vector<Scoped> items(const Value& value, const Counters& counters);
  // A copy in which every text has its templates filled: %k, %02k, %.3r, %(k+1); %% is a percent sign (templates.cpp).
  std::optional<Value> fill_templates(const Value& value, const Counters& counters);
  // A formula as --set takes it: as written, or its value if it speaks of counters.
  std::optional<std::string> setting(const Value& value, const Counters& counters);

 private:
  // --- builder_values.cpp: one value by a field's type; nothing after an error has been reported.
  std::optional<std::any> read(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<double> read_number_by(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::Interval> read_range_by(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<std::vector<double>> read_numbers(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::Knots> read_knots(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<Expression> read_formula(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<std::any> read_color(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::Grid<double>> read_number_grid(const FieldType& type, const Value& value,
                                                         const Counters& counters);
  std::optional<geometry::PictureSize> read_picture_size(const Value& value, const Counters& counters);
  bool check_count(const FieldType& type, const Value& value, size_t count);

  // --- builder_places.cpp: points, directions, frames, transforms.
  std::optional<Vec3> read_point(const Value& value, const Counters& counters);
  std::optional<Vec3> read_coordinates(const Value& value, const Counters& counters);
  std::optional<Vec3> read_place_on(const Value& map, const Counters& counters);
  std::optional<Vec3> read_vector(const Value& value, const Counters& counters, bool unit);
  std::optional<Axis> read_axis(const Value& value, const Counters& counters);
  std::optional<Frame> read_frame(const Value& value, const Counters& counters);
  std::optional<Frame> read_short_frame(const Value& map, const Value* frame, const Counters& counters);
  std::optional<std::vector<Vec3>> read_points(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<geometry::Grid<Vec3>> read_net(const FieldType& type, const Value& value, const Counters& counters);
  std::optional<Affine> read_transform(const Value& value, const Counters& counters);
  std::optional<Affine> read_transform_step(const Value& step, const Counters& counters);

  // --- builder_types.cpp: maps with a `type`, references, families.
  void declare_section(const char* section);
  bool read_field(const Field& field, const Value& value, const Counters& counters, Fields& fields);
  const Value& default_value(const std::string& text);
  bool check(const TypeDeclaration& type, const Fields& fields, const Value& map);
  std::optional<Built> build_typed(const Value& map, const Counters& counters, std::span<const Category> wanted,
                                   const char* default_type = nullptr);
  std::optional<Built> refer(const Value& value, const Counters& counters, std::span<const Category> wanted);
  std::optional<std::vector<std::any>> refer_all(const Value& value, const Counters& counters,
                                                 std::span<const Category> wanted);
  std::optional<std::vector<Built>> named(const Value& value, std::span<const Category> wanted);
  const Built* member(NamedThing& thing, NamedThing::Member& member, std::span<const Category> wanted);
  std::optional<Built> part_of(const Built& whole, std::string_view part, const Value& asked);
  const Value* with_like(const Value& map, const Value* section);
  // Calls visit(counters, member name) for every combination of a map's `repeat`.
  bool repeat(const Value& map, const Counters& counters,
              const std::function<void(const Counters&, const std::string&)>& visit);
  std::map<std::string, NamedThing, std::less<>>* section_of(Category category);
  const Value* section(const char* name) const;
  std::optional<Built> transformed(Built built, const Affine& map, const Value& place);

  // --- builder_scene.cpp: sections to model.
  void build_named(Model& model);
  void build_objects(Model& model);
  void build_object(const Value& map, const Counters& counters, Model& model, std::vector<Object>& into);
  void build_picture(Model& model);
  void build_camera(Model& model);
  void build_lights(Model& model);
  void build_outputs(Model& model);
  void check_drawing();
  void default_objects(Model& model);
  MaterialPtr default_material();

  const SceneDescription& scene_;
  BuildOptions options_;
  Diagnostics& diagnostics_;
  Parameters parameters_;
  std::map<std::string, std::map<std::string, NamedThing, std::less<>>> sections_;
  std::map<std::string, Value> default_values_;
  std::deque<Value> made_;  // maps that `like` made
  std::map<const Value*, const Value*> liked_;
  std::vector<std::string> defaults_;
  std::vector<std::filesystem::path> files_named_;
  MaterialPtr default_material_;
  std::set<std::string> like_in_work_;
  int depth_ = 0;
};

Entity entity_of(const Built& built);

}  // namespace lekalo::render
