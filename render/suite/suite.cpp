#include "render/suite/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "geometry/expression/nearest_name.h"
#include "render/image/atomic_file.h"
#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/yaml/data_path.h"

namespace lekalo::render {

namespace fs = std::filesystem;

namespace {

std::vector<Field> picture_fields() {
  using namespace geometry;
  return {
      {"size", picture_size(), "of the picture in pixels, instead of the scene's", false, {}},
      {"samples", integer().between(1, 1 << 20), "per pixel, instead of the scene's", false, {}},
      {"representation", choice({"direct", "mesh"}), "of every object, instead of the scene's", false, {}},
      {"integrator", reference({Category::integrator}), "instead of the scene's", false, {}},
      {"command", choice({"render", "draw"}), "what makes the picture; drawings are not made yet", false, "render"},
      {"layer", text(), "what is compared: color, normal, geometric_normal, depth, position, uv, albedo", false,
       "color"},
      {"compare",
       group({{"metric", choice({"flip", "rmse", "psnr", "ssim", "max"}), "what is measured", false, "flip"},
              {"mean", number().non_negative(), "flip: largest mean error", false, {}},
              {"maximum",
               number().non_negative(),
               "flip: largest error of a pixel; rmse, max: largest figure",
               false,
               {}},
              {"minimum", number(), "ssim, psnr: smallest figure", false, {}}}),
       "every limit given must hold; without a limit only equal pictures pass", false, "{}"},
      {"time_limit", number().positive().at_most(86400), "seconds; a test that takes longer has failed", false, "60"}};
}

std::vector<Field> test_fields() {
  using namespace geometry;
  std::vector<Field> fields = {
      {"name", text(), "of the test and of its pictures: letters, digits, _ - and .", true, {}},
      {"scene", file(), "scene file, beside the suite", true, {}},
      {"include", texts(), "scene files included after those of the scene: what a geometry kernel wrote", false, {}}};
  for (Field& field : picture_fields()) fields.push_back(std::move(field));
  fields.push_back({"against", text(), "another test whose picture is the golden one", false, {}});
  fields.push_back({"expect",
                    groups({{"measure", text(), "geometry whose length, area or volume is known", false, {}},
                            {"length", number(), "of the curve", false, {}},
                            {"area", number(), "of the surface, body or mesh", false, {}},
                            {"volume", number(), "of the body or closed mesh", false, {}},
                            {"evaluate", text(), "curve or surface whose points are known", false, {}},
                            {"samples", text(), "table of them: columns t, x, y, z or u, v, x, y, z", false, {}},
                            {"tolerance",
                             number().non_negative(),
                             "measure: relative to the expected number; evaluate: largest distance",
                             true,
                             {}}}),
                    "numbers that the scene's geometry must have",
                    false,
                    {}});
  return fields;
}

// The fields of a group or groups field.
const std::vector<Field>& fields_of(const char* name) {
  static const std::vector<Field> fields = test_fields();
  for (const Field& field : fields)
    if (field.name == name) return *field.type.fields;
  throw std::logic_error(std::string("tests have no field ") + name);
}

constexpr const char* kFigures[] = {"length", "area", "volume"};

class SuiteReader {
 public:
  SuiteReader(const fs::path& path, const SceneDescription& file, Diagnostics& diagnostics)
      : path_(path), file_(file), diagnostics_(diagnostics), builder_(file, {data_folders()}, diagnostics) {}

  Suite read();

 private:
  fs::path folder(const char* key, const char* otherwise);
  void check_folders();
  void check_sections();
  void read_tests(const Value& tests);
  void read_test(const Value& given, const Counters& counters);
  Value completed(const Value& test) const;
  void check_name(const Value& name);
  void read_settings(const Value& test, const Counters& counters, SuiteTest& into);
  PictureLimits limits_of(const Value& compare);
  std::vector<Expectation> expectations_of(const Value& expect, const Counters& counters);
  void check_against();

  const fs::path path_;
  const SceneDescription& file_;
  Diagnostics& diagnostics_;
  Builder builder_;
  Suite suite_;
  std::map<std::string, Place> names_;
  std::map<std::string, Value> against_;  // of each test by its name
};

fs::path SuiteReader::folder(const char* key, const char* otherwise) {
  const Value* value = file_.root.find(key);
  if (!value || value->invalid) return otherwise;
  const auto text = read_text(*value);
  if (!text)
    report(diagnostics_, *value, text.slip());
  else if (text->empty())
    diagnostics_.error(value->place, fmt::format("'{}' names a folder", key));
  else
    return *text;
  return otherwise;
}

// A run removes earlier results before it makes them anew.
void SuiteReader::check_folders() {
  if (resolved_path(suite_.golden) != resolved_path(suite_.results)) return;
  const Value* results = file_.root.find("results");
  const Value* golden = file_.root.find("golden");
  diagnostics_.error((results  ? *results
                      : golden ? *golden
                               : file_.root)
                         .place,
                     fmt::format("'golden' and 'results' are one folder, {}: a run would destroy the golden pictures",
                                 suite_.golden.string()),
                     "golden lies beside the suite, results in the current folder; give one of them another name");
}

void SuiteReader::check_sections() {
  std::vector<std::string> known{"lekalo_suite"};
  for (const SuiteSection& section : suite_sections()) known.push_back(section.name);
  for (const Entry& entry : file_.root.entries) {
    if (std::find(known.begin(), known.end(), entry.key.name) != known.end()) continue;
    const auto nearest = geometry::nearest_name(entry.key.name, known);
    diagnostics_.error(entry.key.place,
                       fmt::format("unknown section '{}' of a suite{}", entry.key.name,
                                   nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""),
                       nearest ? "" : "sections are golden, results, defaults, tests");
  }
}

// The fields of `defaults` stand behind those of the test.
Value SuiteReader::completed(const Value& test) const {
  Value all = test;
  const Value* defaults = file_.root.find("defaults");
  if (!defaults || !defaults->is_map()) return all;
  static const std::vector<Field> known = picture_fields();
  for (const Entry& entry : defaults->entries)
    if (!test.find(entry.key.name) &&
        std::any_of(known.begin(), known.end(), [&](const Field& field) { return field.name == entry.key.name; }))
      all.entries.push_back(entry);
  return all;
}

void SuiteReader::check_name(const Value& name) {
  const bool plain = std::all_of(name.text.begin(), name.text.end(),
                                 [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; });
  if (!plain || name.text.empty() || name.text.front() == '.' || name.text.front() == '-')
    diagnostics_.error(name.place, fmt::format("a test cannot be called '{}'", name.text),
                       "its pictures have this name: letters, digits, _ - and ., a letter, digit or _ first");
  const auto [first, is_new] = names_.emplace(name.text, name.place);
  if (is_new) return;
  if (first->second.line == name.place.line && first->second.column == name.place.column)
    diagnostics_.error(name.place, fmt::format("all repetitions of this test are called '{}'", name.text),
                       "put the counter into the name: fillet_%02k");
  else
    diagnostics_.error(name.place, fmt::format("there are two tests called '{}'", name.text), {},
                       {Diagnostics::note(first->second, "the first one is here")});
}

void SuiteReader::read_settings(const Value& test, const Counters& counters, SuiteTest& into) {
  const Value* set = test.find("set");
  if (!set || set->invalid) return;
  if (!set->is_map()) {
    diagnostics_.error(set->place, fmt::format("'set' is a map of parameters, found {}", kind_name(*set)),
                       "write set: { R: 1, r: 0.5 }");
    return;
  }
  for (const Entry& entry : set->entries)
    if (const auto text = builder_.setting(entry.value, counters)) into.set.emplace_back(entry.key.name, *text);
}

PictureLimits SuiteReader::limits_of(const Value& compare) {
  PictureLimits limits;
  if (!compare.is_map()) return limits;
  const auto fields = builder_.read_fields(fields_of("compare"), compare, {}, "'compare'");
  if (!fields) return limits;
  limits.metric = *metric_from_name(fields->text("metric"));
  const bool flip = limits.metric == Metric::flip, least = larger_is_better(limits.metric);
  const auto take = [&](const char* key, bool fits, std::optional<double>& into) {
    if (!fields->has(key)) return;
    into = fields->number(key);
    if (fits) return;
    diagnostics_.error(compare.find(key)->place, fmt::format("'{}' is no limit of {}", key, metric_name(limits.metric)),
                       flip    ? "limits of flip are mean and maximum"
                       : least ? fmt::format("write minimum: the smallest {} that passes", metric_name(limits.metric))
                               : fmt::format("write maximum: the largest {} that passes", metric_name(limits.metric)));
  };
  take("mean", flip, limits.mean);
  take("maximum", !least, limits.maximum);
  take("minimum", least, limits.minimum);
  return limits;
}

std::vector<Expectation> SuiteReader::expectations_of(const Value& expect, const Counters& counters) {
  std::vector<Expectation> all;
  for (const Scoped& item : builder_.items(expect, counters)) {
    if (!item.value->is_map()) continue;
    const auto fields =
        builder_.read_fields(fields_of("expect"), *item.value, item.counters, "an expectation", {"repeat"});
    if (!fields) continue;
    Expectation one;
    one.tolerance = fields->number("tolerance");
    for (const char* figure : kFigures)
      if (fields->has(figure)) one.measures[figure] = fields->number(figure);
    const bool measure = fields->has("measure"), evaluate = fields->has("evaluate"), samples = fields->has("samples");
    if (measure == evaluate || measure == samples || measure == one.measures.empty()) {
      diagnostics_.error(item.value->place, "an expectation measures or evaluates one thing",
                         "write { measure: ring, area: 12.5, tolerance: 1e-9 } (length, area, volume) or "
                         "{ evaluate: patch, samples: patch.csv, tolerance: 1e-9 }");
      continue;
    }
    one.name = fields->text(measure ? "measure" : "evaluate");
    if (samples) one.samples = path_.parent_path() / fields->text("samples");
    all.push_back(std::move(one));
  }
  return all;
}

void SuiteReader::read_test(const Value& given, const Counters& counters) {
  if (!given.is_map()) {
    if (!given.invalid)
      diagnostics_.error(given.place, fmt::format("a test is a map, found {}", kind_name(given)),
                         "write - { name: sphere, scene: sphere.yaml }");
    return;
  }
  const Value whole = completed(given);
  auto filled = builder_.fill_templates(whole, counters);
  if (!filled) return;
  // Lists of texts are filled where they are read, and only once: %% must stay a percent sign.
  for (Entry& entry : filled->entries)
    if (entry.key.name == "include") entry.value = *whole.find("include");
  // Everything is looked at, whatever else is wrong: all errors in one run.
  const auto fields = builder_.read_fields(test_fields(), *filled, counters, "a test", {"repeat", "set"});
  SuiteTest test;
  const Value* name = filled->find("name");
  if (name && name->is_scalar() && !name->invalid) check_name(*name);
  read_settings(*filled, counters, test);
  if (const Value* compare = filled->find("compare")) test.limits = limits_of(*compare);
  if (const Value* expect = filled->find("expect")) test.expectations = expectations_of(*expect, counters);
  if (const Value* command = filled->find("command"); command && command->text == "draw")
    diagnostics_.error(command->place, "this version makes no drawings and cannot test them",
                       "leave the test out until it does");
  if (const Value* against = filled->find("against"); against && name) against_[name->text] = *against;
  if (!fields) return;
  test.name = fields->text("name");
  test.scene = fields->text("scene");
  if (fields->has("include"))
    for (const std::string& file : fields->get<std::vector<std::string>>("include"))
      test.includes.push_back(path_.parent_path() / file);
  if (fields->has("size")) {
    const auto& size = fields->get<geometry::PictureSize>("size");
    if (size.on_paper || size.width == 0 || size.height == 0)
      diagnostics_.error(filled->find("size")->place, "pictures of tests have a size in pixels", "write [320, 240]");
    test.size = {static_cast<int>(size.width), static_cast<int>(size.height)};
  }
  if (fields->has("samples")) test.samples = fields->integer("samples");
  if (fields->has("representation"))
    test.representation = fields->text("representation") == "mesh" ? Representation::mesh : Representation::direct;
  if (fields->has("integrator")) test.integrator = fields->get<IntegratorPtr>("integrator");
  test.layer = fields->text("layer");
  test.time_limit = fields->number("time_limit");
  if (fields->has("against")) test.against = fields->text("against");
  suite_.tests.push_back(std::move(test));
}

void SuiteReader::read_tests(const Value& tests) {
  for (const Scoped& item : builder_.items(tests, {})) read_test(*item.value, item.counters);
}

// `against` names a test, and following it ends.
void SuiteReader::check_against() {
  std::vector<std::string> known;
  for (const auto& [name, place] : names_) known.push_back(name);
  for (const auto& [name, against] : against_) {
    if (!names_.count(against.text)) {
      const auto nearest = geometry::nearest_name(against.text, known);
      diagnostics_.error(against.place, fmt::format("there is no test called '{}'{}", against.text,
                                                    nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""));
      continue;
    }
    std::set<std::string> seen;
    std::string at = name;
    while (against_.count(at) && seen.insert(at).second) at = against_[at].text;
    if (at == name)
      diagnostics_.error(against.place, fmt::format("'{}' is compared with itself in the end", name),
                         "one of the tests in this circle needs a golden picture");
  }
}

Suite SuiteReader::read() {
  check_sections();
  suite_.file = path_;
  suite_.golden = path_.parent_path() / folder("golden", "golden");
  suite_.results = folder("results", "results");
  check_folders();
  const Value* defaults = file_.root.find("defaults");
  if (defaults && !defaults->invalid) {
    if (!defaults->is_map())
      diagnostics_.error(defaults->place, fmt::format("'defaults' is a map of fields, found {}", kind_name(*defaults)));
    else
      builder_.read_fields(picture_fields(), *defaults, {}, "'defaults'");
  }
  const Value* tests = file_.root.find("tests");
  if (!tests)
    diagnostics_.error(file_.root.place, "the suite has no tests", "write tests: and a list of them");
  else if (!tests->invalid)
    read_tests(*tests);
  check_against();
  return std::move(suite_);
}

}  // namespace

const SuiteTest* Suite::find(std::string_view name) const {
  for (const SuiteTest& test : tests)
    if (test.name == name) return &test;
  return nullptr;
}

Suite read_suite(const fs::path& path) {
  Diagnostics diagnostics;
  const SceneDescription file = read_scene(path, {}, diagnostics);
  if (file.root.invalid) throw SceneError(diagnostics);
  if (file.kind != FileKind::suite) {
    diagnostics.error(file.root.place, "this is a scene, not a regression suite",
                      "a suite begins with 'lekalo_suite: 1'; lekalo render makes pictures of a scene");
    throw SceneError(diagnostics);
  }
  Suite suite = SuiteReader(path, file, diagnostics).read();
  if (diagnostics.has_errors()) throw SceneError(diagnostics);
  return suite;
}

const std::vector<SuiteSection>& suite_sections() {
  static const std::vector<SuiteSection> all = {
      {"golden",
       "folder of the golden pictures, beside the suite; NAME.exr, and NAME.txt says who accepted it, when and "
       "why; golden by default",
       {}},
      {"results",
       "folder in the current one for the pictures that a run makes, under the same names; results by default",
       {}},
      {"defaults", "fields of every test that does not give them itself", picture_fields()},
      {"tests", "what is rendered and what must come out", test_fields()}};
  return all;
}

}  // namespace lekalo::render
