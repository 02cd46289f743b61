// Regression suites as read; the rules are those written down in suite.h and templates.cpp.
#include "render/suite/suite.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "render/scene/values/diagnostics.h"

namespace lekalo::render::suite_test {
namespace {

namespace fs = std::filesystem;

class SuiteFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lekalo_suite_" + std::to_string(getpid()) + "_" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    std::ofstream(folder_ / "a.yaml") << "lekalo: 1\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  // The suite `lekalo_suite: 1` and the text, which begins in line 2.
  Suite read(const std::string& text) {
    std::ofstream(folder_ / "suite.yaml") << "lekalo_suite: 1\n" << text;
    return read_suite(folder_ / "suite.yaml");
  }

  // "line:column message" of each error, one a line.
  std::string errors(const std::string& text) {
    std::string said;
    try {
      read(text);
    } catch (const SceneError& error) {
      for (const Diagnostic& d : error.diagnostics().sorted())
        said += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.message + "\n";
    }
    return said;
  }

  fs::path folder_;
};

TEST_F(SuiteFile, DefaultsStandBehindTheFieldsOfATest) {
  const Suite suite = read(
      "defaults: { size: [320, 240], samples: 16, compare: { metric: flip, mean: 0.01, maximum: 0.25 } }\n"
      "tests:\n"
      "  - { name: plain, scene: a.yaml }\n"
      "  - { name: own, scene: a.yaml, samples: 64, layer: depth, compare: { metric: max, maximum: 1e-5 } }\n");
  ASSERT_EQ(suite.tests.size(), 2u);
  const SuiteTest& plain = suite.tests[0];
  EXPECT_EQ(plain.size, (std::pair{320, 240}));
  EXPECT_EQ(plain.samples, 16);
  EXPECT_EQ(plain.limits.metric, Metric::flip);
  EXPECT_EQ(plain.limits.mean, 0.01);
  EXPECT_EQ(plain.limits.maximum, 0.25);
  EXPECT_EQ(plain.layer, "color");
  EXPECT_EQ(plain.time_limit, 60);
  EXPECT_FALSE(plain.representation);
  const SuiteTest& own = suite.tests[1];
  EXPECT_EQ(own.samples, 64);
  EXPECT_EQ(own.size, (std::pair{320, 240}));
  EXPECT_EQ(own.layer, "depth");
  EXPECT_EQ(own.limits.metric, Metric::max);
  EXPECT_EQ(own.limits.maximum, 1e-5);
  EXPECT_FALSE(own.limits.mean) << "limits are taken together";
}

TEST_F(SuiteFile, FoldersAndFilesAreFoundBesideTheSuiteResultsInTheCurrentFolder) {
  const Suite suite =
      read("golden: gold\nresults: build/images\ntests: { name: a, scene: a.yaml, include: kernel/out.json }\n");
  EXPECT_EQ(suite.golden, folder_ / "gold");
  EXPECT_EQ(suite.results, "build/images");
  EXPECT_EQ(suite.tests.at(0).scene, folder_ / "a.yaml");
  EXPECT_EQ(suite.tests.at(0).includes, std::vector<fs::path>{folder_ / "kernel/out.json"});
}

TEST_F(SuiteFile, RepeatFillsTemplates) {
  const Suite suite = read(
      "tests:\n"
      "  - repeat: { k: 2..3, w: [0.5] }\n"
      "    name: fillet_%02k_%(10*k+1)_%.2w\n"
      "    scene: a.yaml\n"
      "    include: out_%k%%.json\n"
      "    set: { R: k/4, free: 1 + 1, turn: k*30 deg }\n"
      "    expect: { measure: p, area: k, tolerance: 1e-9 }\n");
  ASSERT_EQ(suite.tests.size(), 2u);
  EXPECT_EQ(suite.tests[0].name, "fillet_02_21_0.50");
  EXPECT_EQ(suite.tests[1].name, "fillet_03_31_0.50");
  EXPECT_EQ(suite.tests[1].includes.at(0).filename(), "out_3%.json");
  using Settings = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(suite.tests[1].set, (Settings{{"R", "0.75"}, {"free", "1 + 1"}, {"turn", "1.5707963267948966 rad"}}));
  EXPECT_EQ(suite.tests[1].expectations.at(0).measures.at("area"), 3);
}

TEST_F(SuiteFile, AllErrorsInOneRun) {
  EXPECT_EQ(errors("gloden: x\n"
                   "defaults: { smaples: 3 }\n"
                   "tests:\n"
                   "  - { name: a b, scene: a.yaml }\n"
                   "  - { name: c, scene: none.yaml, agianst: c }\n"
                   "  - { name: c, scene: a.yaml, against: d }\n"
                   "  - { name: e, scene: a.yaml, against: f }\n"
                   "  - { name: f, scene: a.yaml, against: e }\n"
                   "  - { repeat: { k: 1..3 }, name: g, scene: a.yaml, set: { R: q } }\n"
                   "  - { repeat: { k: 1..3 }, name: 'h_%02j', scene: a.yaml }\n"
                   "  - { name: i, scene: a.yaml, compare: { metric: ssim, maximum: 1 }, command: draw }\n"
                   "  - { name: j, scene: a.yaml, expect: { measure: x, tolerance: 0 }, size: [auto, 9] }\n"
                   "  - { name: l, scene: a.yaml, integrator: { type: telepathy } }\n"),
            "2:1 unknown section 'gloden' of a suite (did you mean 'golden'?)\n"
            "3:13 unknown field 'smaples' of 'defaults' (did you mean 'samples'?)\n"
            "5:13 a test cannot be called 'a b'\n"
            "6:23 there is no file 'none.yaml'\n"
            "6:34 unknown field 'agianst' of a test (did you mean 'against'?)\n"
            "7:13 there are two tests called 'c'\n"
            "7:40 there is no test called 'd'\n"
            "8:40 'e' is compared with itself in the end\n"
            "9:40 'f' is compared with itself in the end\n"
            "10:34 all repetitions of this test are called 'g'\n"
            "10:62 unknown name 'q'\n"
            "11:37 there is no counter 'j' here\n"
            "12:65 'maximum' is no limit of ssim\n"
            "12:79 this version makes no drawings and cannot test them\n"
            "13:39 an expectation measures or evaluates one thing\n"
            "13:75 pictures of tests have a size in pixels\n"
            "14:51 unknown type 'telepathy'\n");
}

TEST_F(SuiteFile, ASceneIsNoSuite) {
  std::ofstream(folder_ / "suite.yaml") << "lekalo: 1\n";
  EXPECT_THROW(read_suite(folder_ / "suite.yaml"), SceneError);
  EXPECT_NE(errors(""), "") << "a suite without tests";
  EXPECT_NE(errors("tests: 3\n"), "");
}

}  // namespace
}  // namespace lekalo::render::suite_test
