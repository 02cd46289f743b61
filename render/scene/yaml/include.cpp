// Reading a scene with its includes.
#include "render/scene/yaml/include.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>

#include "geometry/expression/nearest_name.h"
#include "render/scene/values/characters.h"
#include "render/scene/values/scalars.h"
#include "render/scene/yaml/merge.h"

namespace lekalo::render {

namespace fs = std::filesystem;

std::optional<std::string> read_file(const fs::path& path, std::size_t limit, bool regular, std::string& reason) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    reason = "no such file";
    return std::nullopt;
  }
  if (status.type() == fs::file_type::none) {
    reason = error.message();
    return std::nullopt;
  }
  if (fs::is_directory(status) || (regular && !fs::is_regular_file(status))) {
    reason = fs::is_directory(status) ? "it is a folder" : "it is not a regular file";
    return std::nullopt;
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    reason = errno != 0 ? std::strerror(errno) : "it cannot be opened";
    return std::nullopt;
  }
  std::string text;
  constexpr std::size_t kStep = 1 << 16;
  while (stream && text.size() <= limit) {
    const std::size_t size = text.size();
    text.resize(size + kStep);
    stream.read(text.data() + size, kStep);
    text.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) {
    reason = "reading failed";
    return std::nullopt;
  }
  if (text.size() > limit) {
    reason = fmt::format("it is longer than {:.1f} million bytes", static_cast<double>(limit) * 1e-6);
    return std::nullopt;
  }
  return text;
}

std::optional<fs::path> find_input(const SourceFile& from, std::string_view name,
                                   const std::vector<fs::path>& search_path) {
  const fs::path wanted{std::string(name)};
  std::error_code error;
  if (wanted.is_absolute()) return fs::exists(wanted, error) ? std::optional(wanted) : std::nullopt;
  fs::path beside = (from.path.parent_path() / wanted).lexically_normal();
  if (fs::exists(beside, error)) return beside;
  for (const fs::path& folder : search_path) {
    fs::path shipped = (folder / wanted).lexically_normal();
    if (fs::exists(shipped, error)) return shipped;
  }
  return std::nullopt;
}

Named find_named(const Value& section, std::string_view name, std::string_view scope) {
  for (;;) {
    for (std::size_t end = name.size(); end != std::string_view::npos && end > 0; end = name.rfind('.', end - 1)) {
      std::string full(scope);
      if (!full.empty()) full += '.';
      full += name.substr(0, end);
      if (const Entry* entry = section.find_entry(full)) return {entry, name.substr(std::min(end + 1, name.size()))};
    }
    if (scope.empty()) return {};
    const std::size_t dot = scope.rfind('.');
    scope = dot == std::string_view::npos ? std::string_view{} : scope.substr(0, dot);
  }
}

namespace {

// One entry of `include`.
struct Inclusion {
  std::string name;
  std::string prefix;
  const Value* set = nullptr;
  Place place;
};

class SceneReader {
 public:
  SceneReader(const ReadOptions& options, Diagnostics& diagnostics) : options_(options), diagnostics_(diagnostics) {}

  SceneDescription read(const std::shared_ptr<const SourceFile>& file) {
    SceneDescription scene;
    scene.root = read_one(file, &scene.kind);
    if (!scene.root.invalid && scene.kind == FileKind::scene) scene.root = with_includes(std::move(scene.root), file);
    scene.files = std::move(files_);
    return scene;
  }

 private:
  // The map of one file, its first key checked. Without `kind` it must be a scene.
  Value read_one(const std::shared_ptr<const SourceFile>& file, FileKind* kind);
  bool check_kind(const Value& root, FileKind* kind);
  // `root` over all that its `include` names; the key itself is taken out.
  Value with_includes(Value root, const std::shared_ptr<const SourceFile>& file);
  std::vector<Inclusion> inclusions(const Value& include);
  std::optional<Inclusion> inclusion(const Value& entry);
  std::optional<Value> include(const Inclusion& inclusion, const std::shared_ptr<const SourceFile>& from);
  void refuse_constraints(const Value& value, const Inclusion& inclusion, bool is_second);
  std::shared_ptr<const SourceFile> open(const fs::path& path, const Inclusion& inclusion, std::string scope);
  void apply_set(Value& root, const Inclusion& inclusion);

  const ReadOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<std::shared_ptr<const SourceFile>> files_;
  std::vector<fs::path> open_paths_;                       // the chain of files being read, for cycles
  std::map<std::pair<fs::path, std::string>, bool> once_;  // (file, scope) -> read with `set`
  std::size_t bytes_ = 0;                                  // of all files together
};

bool SceneReader::check_kind(const Value& root, FileKind* kind) {
  const Place whole = root.place;
  if (root.entries.empty()) {
    diagnostics_.error(whole, "this file says nothing", "a scene file begins with 'lekalo: 1'");
    return false;
  }
  const Entry& first = root.entries.front();
  const bool suite = first.key.name == "lekalo_suite";
  if (!suite && first.key.name != "lekalo") {
    const Entry* later = root.find_entry("lekalo");
    if (!later) later = root.find_entry("lekalo_suite");
    if (later)
      diagnostics_.error(later->key.place, fmt::format("'{}' must be the first key of the file", later->key.name),
                         "move this line to the top");
    else
      diagnostics_.error(first.key.place, "the first key of a scene file is 'lekalo', of a test suite 'lekalo_suite'",
                         "begin the file with the line 'lekalo: 1', which names the version of its language");
    return true;
  }
  if (suite && !kind) {
    diagnostics_.error(first.key.place, "a test suite cannot be included", "include scene files only");
    return false;
  }
  if (kind) *kind = suite ? FileKind::suite : FileKind::scene;
  const Reading<int> version = read_integer(first.value);
  if (!version) {
    report(diagnostics_, first.value, {"the version is a whole number", fmt::format("write '{}: 1'", first.key.name)});
    return true;
  }
  if (*version > 1) {
    diagnostics_.error(
        first.value.place,
        fmt::format("this file is written for version {} of the scene language; this program knows version 1",
                    *version),
        "use a newer lekalo, or find out what the file needs from it and write 'lekalo: 1'");
    return false;
  }
  if (*version < 1)
    diagnostics_.error(first.value.place, fmt::format("there is no version {} of the scene language", *version),
                       fmt::format("write '{}: 1'", first.key.name));
  return true;
}

Value SceneReader::read_one(const std::shared_ptr<const SourceFile>& file, FileKind* kind) {
  files_.push_back(file);
  bytes_ += std::min(file->text.size(), options_.limits.bytes - bytes_);
  Value root = read_document(file, diagnostics_, options_.limits);
  if (!root.invalid && !check_kind(root, kind)) root.invalid = true;
  return root;
}

std::optional<Inclusion> SceneReader::inclusion(const Value& entry) {
  if (entry.invalid) return std::nullopt;
  constexpr const char* kForm = "write a file name or { file: bolt.yaml, as: b1, set: { length: 4 } }";
  if (entry.is_sequence()) {
    diagnostics_.error(entry.place, "expected a file to include, found a list", kForm);
    return std::nullopt;
  }
  const Value* file = entry.is_scalar() ? &entry : entry.find("file");
  if (!file) diagnostics_.error(entry.place, "'include' without 'file'", kForm);
  if (file && file->is_scalar() && !file->invalid && file->text.empty())
    diagnostics_.error(file->place, "the name of the file to include is empty", kForm);
  Inclusion result;
  if (file && file->is_scalar() && !file->invalid) {
    result.name = file->text;
    result.place = file->place;
  }
  for (const Entry& field : entry.entries) {
    if (&field.value == file && file->is_scalar()) continue;
    if (field.key.name == "as" && field.value.is_scalar()) {
      const Reading<std::string> prefix = read_name(field.value);
      if (!prefix) report(diagnostics_, field.value, prefix.slip());
      if (prefix) result.prefix = *prefix;
    } else if (field.key.name == "set" && field.value.is_map()) {
      result.set = &field.value;
    } else if (field.key.name == "file" || field.key.name == "as" || field.key.name == "set") {
      report(diagnostics_, field.value,
             {fmt::format("'{}' cannot be {}", field.key.name, kind_name(field.value)), kForm});
    } else {
      diagnostics_.error(field.key.place, fmt::format("unknown field '{}' of 'include'", field.key.name), kForm);
    }
  }
  if (result.name.empty()) return std::nullopt;
  return result;
}

std::vector<Inclusion> SceneReader::inclusions(const Value& include) {
  std::vector<Inclusion> result;
  const auto add = [&](const Value& entry) {
    if (auto one = inclusion(entry)) result.push_back(std::move(*one));
  };
  if (include.is_sequence())
    std::for_each(include.items.begin(), include.items.end(), add);
  else
    add(include);
  return result;
}

Value SceneReader::with_includes(Value root, const std::shared_ptr<const SourceFile>& file) {
  Value include_value;
  const auto found =
      std::find_if(root.entries.begin(), root.entries.end(), [](const Entry& e) { return e.key.name == "include"; });
  const bool main = files_.size() == 1;
  std::vector<Inclusion> all;
  if (found != root.entries.end()) {
    include_value = std::move(found->value);
    root.entries.erase(found);
    all = inclusions(include_value);
  }
  if (main)
    for (const fs::path& path : options_.includes)
      all.push_back({fs::absolute(path).string(), {}, nullptr, {file, 0, 0, 1}});
  if (all.empty()) return root;

  std::error_code error;
  open_paths_.push_back(fs::weakly_canonical(file->path, error));
  Value included;
  included.kind = Value::Kind::map;
  for (const Inclusion& one : all) {
    std::optional<Value> value = include(one, file);
    if (value) refuse_constraints(*value, one, included.find("constraints") || root.find("constraints"));
    if (value) merge_sibling(included, std::move(*value), root, diagnostics_);
  }
  open_paths_.pop_back();
  return merge_over(std::move(included), std::move(root), diagnostics_);
}

// A scene has one system of constraints, whose names get no prefix.
void SceneReader::refuse_constraints(const Value& value, const Inclusion& inclusion, bool is_second) {
  const Entry* const entry = value.find_entry("constraints");
  if (!entry) return;
  if (!inclusion.prefix.empty())
    diagnostics_.error(entry->key.place,
                       fmt::format("a file that is included as '{}' has 'constraints'", inclusion.prefix),
                       "their names get no prefix: include it without 'as'");
  else if (is_second)
    diagnostics_.error(entry->key.place, "a second section 'constraints'",
                       "a scene has one system of constraints: write all of it in one file");
}

std::shared_ptr<const SourceFile> SceneReader::open(const fs::path& path, const Inclusion& inclusion,
                                                    std::string scope) {
  if (files_.size() > options_.limits.included_files) {
    diagnostics_.error(inclusion.place, fmt::format("more than {} files are included", options_.limits.included_files),
                       "a file that includes itself many times under different prefixes multiplies");
    return nullptr;
  }
  std::string reason;
  std::optional<std::string> text = read_file(path, options_.limits.bytes - bytes_, true, reason);
  if (!text) {
    diagnostics_.error(inclusion.place, fmt::format("'{}' cannot be included: {}", inclusion.name, reason));
    return nullptr;
  }
  return make_source(path.string(), std::move(*text), path, std::move(scope), inclusion.place);
}

std::optional<Value> SceneReader::include(const Inclusion& inclusion, const std::shared_ptr<const SourceFile>& from) {
  const std::optional<fs::path> path = find_input(*from, inclusion.name, options_.search_path);
  if (!path) {
    std::string looked = from->path.parent_path().empty() ? "the current folder" : from->path.parent_path().string();
    for (const fs::path& folder : options_.search_path) looked += ", " + folder.string();
    diagnostics_.error(inclusion.place, fmt::format("there is no file '{}' to include", inclusion.name),
                       fmt::format("looked in: {}", looked));
    return std::nullopt;
  }
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(*path, error);
  if (std::find(open_paths_.begin(), open_paths_.end(), canonical) != open_paths_.end()) {
    diagnostics_.error(inclusion.place, fmt::format("'{}' includes itself", inclusion.name),
                       "files may not include each other in a circle");
    return std::nullopt;
  }
  if (open_paths_.size() > static_cast<std::size_t>(options_.limits.include_depth)) {
    diagnostics_.error(inclusion.place,
                       fmt::format("files are included more than {} deep", options_.limits.include_depth));
    return std::nullopt;
  }
  std::string scope = from->scope;
  if (!inclusion.prefix.empty()) scope += (scope.empty() ? "" : ".") + inclusion.prefix;
  const auto [once, is_new] = once_.emplace(std::pair(canonical, scope), inclusion.set != nullptr);
  if (!is_new) {
    if (once->second || inclusion.set)
      diagnostics_.error(inclusion.place, fmt::format("'{}' is included twice, with 'set'", inclusion.name),
                         "give each inclusion a prefix of its own: { file: bolt.yaml, as: b1, set: { length: 4 } }");
    return std::nullopt;
  }
  const std::shared_ptr<const SourceFile> file = open(*path, inclusion, std::move(scope));
  if (!file) return std::nullopt;
  Value root = read_one(file, nullptr);
  if (root.invalid) return std::nullopt;
  root = with_includes(std::move(root), file);
  if (!root.entries.empty() && root.entries.front().key.name == "lekalo") root.entries.erase(root.entries.begin());
  std::erase_if(root.entries, [](const Entry& e) { return e.key.name == "lekalo"; });
  apply_set(root, inclusion);
  if (!inclusion.prefix.empty()) prefix_names(root, inclusion.prefix);
  return root;
}

// "(did you mean 'length'?)" behind a message about an unknown parameter.
std::string suggestion(const Value* parameters, const std::string& name) {
  std::vector<std::string> names;
  if (parameters)
    for (const Entry& entry : parameters->entries) names.push_back(entry.key.name);
  const auto nearest = geometry::nearest_name(name, names);
  return nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : "";
}

// The first names of all parameters, for hints.
std::string parameter_names(const Value* parameters) {
  if (!parameters || parameters->entries.empty()) return "it has no parameters";
  std::string names = "its parameters are";
  constexpr std::size_t kShown = 12;
  for (std::size_t i = 0; i < std::min(parameters->entries.size(), kShown); ++i)
    names += (i == 0 ? " " : ", ") + parameters->entries[i].key.name;
  if (parameters->entries.size() > kShown) names += ", ...";
  return names;
}

void SceneReader::apply_set(Value& root, const Inclusion& inclusion) {
  if (!inclusion.set) return;
  Value* parameters = root.find("parameters");
  for (const Entry& entry : inclusion.set->entries) {
    Value* parameter = parameters ? parameters->find(entry.key.name) : nullptr;
    if (parameter)
      *parameter = entry.value;
    else
      diagnostics_.error(entry.key.place,
                         fmt::format("'{}' has no parameter '{}'{}", inclusion.name, entry.key.name,
                                     suggestion(parameters, entry.key.name)),
                         parameter_names(parameters));
  }
}

// A value from outside as if it stood in a file of its own, which messages call by the option.
void set_parameter(Value& root, const ParameterSetting& setting, Diagnostics& diagnostics) {
  const auto& [name, text, option] = setting;
  const std::string written = name + "=" + text;
  const auto source = make_source(option.empty() ? "--set " + written : option, written);
  PlaceFinder places(source);
  const Place name_place = places.at(0, name.size());
  const Place value_place = places.at(name.size() + 1, text.size());
  if (const auto bad = find_bad_character(source->text)) {
    diagnostics.error(places.at(bad->offset, bad->length), bad->message, bad->hint);
    return;
  }
  Value* parameters = root.find("parameters");
  Value* parameter = parameters ? parameters->find(name) : nullptr;
  if (!parameter) {
    diagnostics.error(name_place, fmt::format("the scene has no parameter '{}'{}", name, suggestion(parameters, name)),
                      parameter_names(parameters));
    return;
  }
  if (text.find_first_not_of(" \t\n") == std::string::npos) {
    diagnostics.error(name_place, fmt::format("'{}' is set to nothing", name), fmt::format("write {}=VALUE", name));
    return;
  }
  Value value;
  value.place = value_place;
  value.text = text;
  *parameter = std::move(value);
}

}  // namespace

SceneDescription read_scene(const std::shared_ptr<const SourceFile>& file, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  SceneDescription scene = SceneReader(options, diagnostics).read(file);
  if (scene.root.invalid) return scene;
  for (const ParameterSetting& setting : options.set_parameters) set_parameter(scene.root, setting, diagnostics);
  return scene;
}

SceneDescription read_scene(const fs::path& path, const ReadOptions& options, Diagnostics& diagnostics) {
  std::string reason;
  std::optional<std::string> text = read_file(path, options.limits.bytes, false, reason);
  if (text) return read_scene(make_source(path.string(), std::move(*text), path), options, diagnostics);
  SceneDescription nothing;
  nothing.root.kind = Value::Kind::map;
  nothing.root.invalid = true;
  nothing.files = {make_source(path.string(), {}, path)};
  nothing.root.place = {nothing.files.front(), 0, 0, 1};
  diagnostics.unreadable(nothing.root.place, fmt::format("cannot be read: {}", reason));
  return nothing;
}

}  // namespace lekalo::render
