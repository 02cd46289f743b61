// Scenes of several files: search, merging, prefixes, parameters. The rules are those written down in include.h.
#include "render/scene/yaml/include.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "render/scene/build/builder.h"
#include "render/scene/yaml/data_path.h"

namespace lekalo::render::include_test {
namespace {

namespace fs = std::filesystem;

class Include : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lekalo_include_" + std::to_string(getpid()) + "_" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const fs::path& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  // Reads main.yaml; what was said is in said_, with the folder's name taken out.
  SceneDescription read(const std::string& main) {
    write("main.yaml", main);
    Diagnostics diagnostics;
    SceneDescription scene = read_scene(folder_ / "main.yaml", options_, diagnostics);
    said_.clear();
    for (const Diagnostic& d : diagnostics.sorted())
      said_ += (d.place.file ? fs::path(d.place.file->name).filename().string() : "") + ":" +
               std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.message + "\n";
    for (std::size_t at; (at = said_.find(folder_.string() + "/")) != std::string::npos;)
      said_.erase(at, folder_.string().size() + 1);
    return scene;
  }

  static std::string keys(const Value* map) {
    std::string result;
    if (map)
      for (const Entry& entry : map->entries) result += (result.empty() ? "" : " ") + entry.key.name;
    return result;
  }

  fs::path folder_;
  ReadOptions options_;
  std::string said_;
};

TEST_F(Include, FindsFilesBesideTheNamingFileThenInTheSearchPath) {
  write("shipped/studio/paper.yaml", "lekalo: 1\nlights: { sky: { type: ambient } }\n");
  write("parts/bolt.yaml", "lekalo: 1\ninclude: thread.yaml\ngeometry: { head: 1 }\n");
  write("parts/thread.yaml", "lekalo: 1\ngeometry: { thread: 1 }\n");
  options_.search_path = {folder_ / "shipped"};
  const SceneDescription scene = read("lekalo: 1\ninclude: [parts/bolt.yaml, studio/paper.yaml]\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(keys(scene.root.find("geometry")), "thread head");
  EXPECT_EQ(keys(scene.root.find("lights")), "sky");
  EXPECT_EQ(scene.root.find("include"), nullptr);
  EXPECT_EQ(scene.files.size(), 4u);
}

TEST_F(Include, SaysWhereItLookedForAFile) {
  options_.search_path = {folder_ / "shipped"};
  write("main.yaml", "lekalo: 1\ninclude: studio/papr.yaml\n");
  Diagnostics diagnostics;
  read_scene(folder_ / "main.yaml", options_, diagnostics);
  const std::string main = (folder_ / "main.yaml").string();
  EXPECT_EQ(diagnostics.text(), main + ":2:10: there is no file 'studio/papr.yaml' to include\n" +
                                    "    include: studio/papr.yaml\n" + "             ^~~~~~~~~~~~~~~~\n" +
                                    "hint: looked in: " + folder_.string() + ", " + (folder_ / "shipped").string() +
                                    "\n");
}

TEST_F(Include, SingleValuedSectionsMergeKeyByKeyAndTheIncluderWins) {
  write("a.yaml", "lekalo: 1\ncamera: { type: perspective, from: [1, 2, 3] }\nimage: { samples: 4 }\n");
  const SceneDescription scene = read("lekalo: 1\ninclude: a.yaml\ncamera: { from: [7, 8, 9], at: [0, 0, 0] }\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(keys(scene.root.find("camera")), "type from at");
  EXPECT_EQ(scene.root.find("camera")->find("from")->items[0].text, "7");
  EXPECT_EQ(scene.root.find("image")->find("samples")->text, "4");
}

TEST_F(Include, ListsAppendAndSingleEntriesAreListsOfOne) {
  write("a.yaml",
        "lekalo: 1\nobjects: { shape: table }\noutputs: a.png\ndrawing: { ground: fill, annotations: [{ type: axes }] "
        "}\n");
  const SceneDescription scene = read(
      "lekalo: 1\ninclude: a.yaml\nobjects: [{ shape: cup }]\noutputs: [b.png, c.png]\n"
      "drawing: { ground: none, annotations: { type: label } }\n");
  EXPECT_EQ(said_, "");
  ASSERT_EQ(scene.root.find("objects")->items.size(), 2u);
  EXPECT_EQ(scene.root.find("objects")->items[0].find("shape")->text, "table");
  EXPECT_EQ(scene.root.find("outputs")->items.size(), 3u);
  EXPECT_EQ(scene.root.find("drawing")->find("ground")->text, "none");
  EXPECT_EQ(scene.root.find("drawing")->find("annotations")->items.size(), 2u);
}

TEST_F(Include, ANameGivenTwiceIsAnErrorThatNamesBothPlaces) {
  write("a.yaml", "lekalo: 1\ngeometry:\n  ring: { radius: 1 }\n");
  read("lekalo: 1\ninclude: a.yaml\ngeometry:\n  ring: { radius: 2 }\n");
  EXPECT_EQ(said_, "main.yaml:4:3 'ring' is given twice in 'geometry': here and in a.yaml:3\n");
}

TEST_F(Include, BuiltInStylesMerge) {
  write("a.yaml", "lekalo: 1\nstyles: { thick: { width: 1 pt, color: red }, mine: { width: 1 pt } }\n");
  const SceneDescription scene = read("lekalo: 1\ninclude: a.yaml\nstyles: { thick: { width: 2 pt } }\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(scene.root.find("styles")->find("thick")->find("width")->text, "2 pt");
  EXPECT_EQ(scene.root.find("styles")->find("thick")->find("color")->text, "red");
  read("lekalo: 1\ninclude: a.yaml\nstyles: { mine: { width: 2 pt } }\n");
  EXPECT_EQ(said_, "main.yaml:3:11 'mine' is given twice in 'styles': here and in a.yaml:2\n");
}

TEST_F(Include, ParametersAreDefaults) {
  write("a.yaml", "lekalo: 1\nparameters: { R: 1, h: 2, d: 3 }\n");
  options_.set_parameters = {{"d", "2*R"}};
  const SceneDescription scene = read("lekalo: 1\ninclude: { file: a.yaml, set: { h: 20 } }\nparameters: { R: 10 }\n");
  EXPECT_EQ(said_, "");
  const Value& parameters = *scene.root.find("parameters");
  EXPECT_EQ(parameters.find("R")->text, "10") << "the including file over the included";
  EXPECT_EQ(parameters.find("h")->text, "20") << "set over the included";
  EXPECT_EQ(parameters.find("d")->text, "2*R") << "--set over all";
  EXPECT_EQ(parameters.find("d")->place.file->name, "--set d=2*R");
  EXPECT_EQ(parameters.find("d")->place.column, 3);
}

TEST_F(Include, ParametersOfTwoIncludedFilesNeedADecision) {
  write("a.yaml", "lekalo: 1\nparameters: { R: 1 }\n");
  write("b.yaml", "lekalo: 1\nparameters: { R: 2 }\n");
  read("lekalo: 1\ninclude: [a.yaml, b.yaml]\n");
  EXPECT_EQ(said_, "b.yaml:2:15 'R' is given twice in 'parameters': here and in a.yaml:2\n");
  const SceneDescription scene = read("lekalo: 1\ninclude: [a.yaml, b.yaml]\nparameters: { R: 3 }\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(scene.root.find("parameters")->find("R")->text, "3");
}

TEST_F(Include, UnknownParametersAreNamed) {
  write("a.yaml", "lekalo: 1\nparameters: { radius: 1 }\n");
  options_.set_parameters = {{"hight", "2"}};
  read("lekalo: 1\ninclude: { file: a.yaml, set: { raduis: 2 } }\n");
  EXPECT_EQ(
      said_,
      "main.yaml:2:33 'a.yaml' has no parameter 'raduis' (did you mean 'radius'?)\n--set hight=2:1:1 the scene has "
      "no parameter 'hight'\n");
}

TEST_F(Include, PrefixesKeepFilesApart) {
  write("bolt.yaml",
        "lekalo: 1\nparameters: { length: 4 }\ngeometry: { head: { height: length }, whole: { of: head } }\n"
        "objects: [{ shape: whole }]\n");
  const SceneDescription scene = read(
      "lekalo: 1\ninclude:\n  - { file: bolt.yaml, as: b1 }\n  - { file: bolt.yaml, as: b2, set: { length: 2*h } }\n"
      "parameters: { h: 5 }\ngeometry: { head: { type: ball } }\n");
  EXPECT_EQ(said_, "");
  const Value& geometry = *scene.root.find("geometry");
  EXPECT_EQ(keys(&geometry), "b1.head b1.whole b2.head b2.whole head");
  EXPECT_EQ(keys(scene.root.find("parameters")), "b1.length b2.length h");
  // A name is looked up as its file means it.
  const Value& used = *geometry.find("b2.whole")->find("of");
  EXPECT_EQ(used.place.file->scope, "b2");
  EXPECT_EQ(find_named(geometry, used.text, used.place.file->scope).entry->key.name, "b2.head");
  const Value& own = *geometry.find("head");
  EXPECT_EQ(find_named(geometry, "head", own.place.file->scope).entry->key.name, "head");
  // The formula of `set` stands in the including file and speaks of its names.
  EXPECT_EQ(scene.root.find("parameters")->find("b2.length")->place.file->scope, "");
  EXPECT_EQ(scene.root.find("objects")->items[1].find("shape")->place.file->scope, "b2");
}

TEST_F(Include, PrefixesNest) {
  write("thread.yaml", "lekalo: 1\ngeometry: { helix: 1 }\n");
  write("bolt.yaml",
        "lekalo: 1\ninclude: { file: thread.yaml, as: thread }\ngeometry: { head: 1 }\nmaterials: { steel: 1 }\n");
  const SceneDescription scene = read("lekalo: 1\ninclude: { file: bolt.yaml, as: b }\nmaterials: { brass: 1 }\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(keys(scene.root.find("geometry")), "b.thread.helix b.head");
  const Value& materials = *scene.root.find("materials");
  EXPECT_EQ(find_named(materials, "steel", "b.thread").entry->key.name, "b.steel");
  EXPECT_EQ(find_named(materials, "brass", "b.thread").entry->key.name, "brass");
  EXPECT_EQ(find_named(materials, "steel", "").entry, nullptr);
  const Named member = find_named(*scene.root.find("geometry"), "thread.helix.3.side", "b");
  EXPECT_EQ(member.entry->key.name, "b.thread.helix");
  EXPECT_EQ(member.member, "3.side");
}

TEST_F(Include, AFileReachedOnTwoWaysIsReadOnce) {
  write("paper.yaml", "lekalo: 1\nlights: { sky: 1 }\n");
  write("a.yaml", "lekalo: 1\ninclude: paper.yaml\n");
  write("b.yaml", "lekalo: 1\ninclude: paper.yaml\n");
  const SceneDescription scene = read("lekalo: 1\ninclude: [a.yaml, b.yaml]\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(keys(scene.root.find("lights")), "sky");
}

TEST_F(Include, CirclesAreErrors) {
  write("a.yaml", "lekalo: 1\ninclude: main.yaml\n");
  read("lekalo: 1\ninclude: a.yaml\n");
  EXPECT_EQ(said_, "a.yaml:2:10 'main.yaml' includes itself\n");
}

TEST_F(Include, DoublingChainsEnd) {
  for (int i = 0; i < 20; ++i) {
    const std::string next = "part" + std::to_string(i + 1) + ".yaml";
    write("part" + std::to_string(i) + ".yaml",
          "lekalo: 1\ninclude: [{ file: " + next + ", as: a }, { file: " + next + ", as: b }]\n");
  }
  options_.limits.included_files = 50;
  read("lekalo: 1\ninclude: part0.yaml\n");
  EXPECT_NE(said_.find("files are included more than 16 deep"), std::string::npos);
  EXPECT_NE(said_.find("more than 50 files are included"), std::string::npos);
}

TEST_F(Include, TheFirstKeyOfEveryFileIsItsVersion) {
  write("none.yaml", "geometry: { a: 1 }\n");
  write("later.yaml", "geometry: { b: 1 }\nlekalo: 1\n");
  write("newer.yaml", "lekalo: 2\nspline_cloud: 1\n");
  write("suite.yaml", "lekalo_suite: 1\ntests: []\n");
  read("lekalo: 1\ninclude: [none.yaml, later.yaml, newer.yaml, suite.yaml]\n");
  EXPECT_EQ(said_,
            "none.yaml:1:1 the first key of a scene file is 'lekalo', of a test suite 'lekalo_suite'\n"
            "later.yaml:2:1 'lekalo' must be the first key of the file\n"
            "newer.yaml:1:9 this file is written for version 2 of the scene language; this program knows version 1\n"
            "suite.yaml:1:1 a test suite cannot be included\n");
}

TEST_F(Include, SuitesAreReadAsWritten) {
  const SceneDescription scene = read("lekalo_suite: 1\ntests:\n  - { name: a, include: kernel/out/a.json }\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(scene.kind, FileKind::suite);
  EXPECT_EQ(scene.root.find("tests")->items[0].find("include")->text, "kernel/out/a.json");
}

TEST_F(Include, FurtherIncludesOfATest) {
  write("patch.json", "{\"lekalo\": 1, \"geometry\": {\"patch\": {\"type\": \"nurbs_surface\"}}}");
  options_.includes = {folder_ / "patch.json"};
  const SceneDescription scene = read("lekalo: 1\nobjects: [{ shape: patch }]\n");
  EXPECT_EQ(said_, "");
  EXPECT_EQ(keys(scene.root.find("geometry")), "patch");
}

TEST_F(Include, AllContentErrorsOfAllFilesComeInOneRun) {
  write("a.yaml", "lekalo: 1\ngeometry: { b: ~ }\n");
  read("lekalo: 1\ninclude: [a.yaml, b.yaml]\ngeometry: { c: ~, d: 1, d: 2 }\nlights: 3\n");
  EXPECT_EQ(said_,
            "main.yaml:2:19 there is no file 'b.yaml' to include\n"
            "main.yaml:3:16 '~' means nothing in scene files\n"
            "main.yaml:3:25 'd' is given twice, in lines 3 and 3\n"
            "a.yaml:2:16 '~' means nothing in scene files\n");
}

// The same scene from elsewhere: what the included camera says in other words gives way.
TEST_F(Include, CamerasAreReplacedWhereTheySayTheSameInOtherWords) {
  write("near.yaml", "lekalo: 1\ncamera: { from: [4, -7, 4], at: [0, 0, 1], up: x, field_of_view: 36 }\n");
  const auto camera = [&](const std::string& own) {
    const SceneDescription scene = read("lekalo: 1\ninclude: near.yaml\ncamera: " + own + "\n");
    EXPECT_EQ(said_, "");
    return keys(scene.root.find("camera"));
  };
  EXPECT_EQ(camera("{ view: top }"), "up field_of_view view");
  EXPECT_EQ(camera("{ from: [1, 1, 1] }"), "from at up field_of_view");
  EXPECT_EQ(camera("{ type: perspective, at: [0, 0, 2] }"), "from at up field_of_view type");
  EXPECT_EQ(camera("{ type: parallel, view: top }"), "type view");
  write("near.yaml", "lekalo: 1\ncamera: { type: parallel, view: top, margin: 0.1 }\n");
  EXPECT_EQ(camera("{ view: front }"), "type view margin");
  EXPECT_EQ(camera("{ from: [0, 0, 5], height: 3 }"), "type from height");
}

// A built-in style that an included file changes keeps its other fields, also where the file has a prefix.
TEST_F(Include, ChangedBuiltInStylesOfPrefixedFiles) {
  write("inner.yaml", "lekalo: 1\nstyles: { axis: { opacity: 0.5 } }\n");
  write("part.yaml",
        "lekalo: 1\ninclude: { file: inner.yaml, as: in }\n"
        "styles: { axis: { width: 1 mm }, ray: { like: thin }, own: { like: axis, cap: round } }\n");
  const SceneDescription scene =
      read("lekalo: 1\ninclude: { file: part.yaml, as: left }\nstyles: { axis: { color: red } }\n");
  ASSERT_EQ(said_, "");
  Diagnostics diagnostics;
  Builder builder(scene, {.search_path = data_folders()}, diagnostics);
  const Model model = builder.build();
  EXPECT_EQ(diagnostics.text(), "");
  const Style &axis = model.styles.at("axis"), &left = model.styles.at("left.axis"),
              &in = model.styles.at("left.in.axis"), &own = model.styles.at("left.own");
  EXPECT_EQ(axis.dash.size(), 4u);
  EXPECT_EQ(axis.color, geometry::Vec3(1, 0, 0));
  for (const Style* style : {&left, &in, &own}) {
    EXPECT_EQ(style->dash, axis.dash);
    EXPECT_EQ(style->color, axis.color);
    EXPECT_EQ(style->width, 1);
  }
  EXPECT_EQ(left.opacity, 1);
  EXPECT_EQ(in.opacity, 0.5);
  EXPECT_EQ(own.cap, "round");
  EXPECT_TRUE(model.styles.at("left.ray").arrows == "none");  // replaced, not changed
  EXPECT_EQ(model.styles.at("ray").arrows, "end");
}

TEST_F(Include, FormsOfIncludeAreChecked) {
  read("lekalo: 1\ninclude: [{ as: x }, { file: [a] }, { file: a.yaml, with: 1 }, [b], '']\n");
  EXPECT_EQ(said_,
            "main.yaml:2:11 'include' without 'file'\n"
            "main.yaml:2:30 'file' cannot be a list\n"
            "main.yaml:2:45 there is no file 'a.yaml' to include\n"
            "main.yaml:2:53 unknown field 'with' of 'include'\n"
            "main.yaml:2:64 expected a file to include, found a list\n"
            "main.yaml:2:69 the name of the file to include is empty\n");
}

TEST_F(Include, FilesThatCannotBeRead) {
  fs::create_directories(folder_ / "folder");
  read("lekalo: 1\ninclude: [folder, /dev/zero]\n");
  EXPECT_EQ(said_,
            "main.yaml:2:11 'folder' cannot be included: it is a folder\n"
            "main.yaml:2:19 '/dev/zero' cannot be included: it is not a regular file\n");
  Diagnostics diagnostics;
  const SceneDescription scene = read_scene("no/such/file.yaml", {}, diagnostics);
  EXPECT_EQ(diagnostics.text(), "no/such/file.yaml: cannot be read: no such file\n");
  EXPECT_TRUE(diagnostics.cannot_read());
  EXPECT_TRUE(scene.root.invalid);
}

}  // namespace
}  // namespace lekalo::render::include_test
