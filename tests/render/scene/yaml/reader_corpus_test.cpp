// The fuzzer's corpus through the reader: nothing crashes or hangs, and what reader_check.h states holds, for every
// file whole, cut off anywhere, and with bytes changed (fixed seed).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz/reader_check.h"

namespace lekalo::render::reader_corpus_test {
namespace {

namespace fs = std::filesystem;

struct Sample {
  std::string name, text;
};

std::vector<Sample> corpus() {
  std::vector<Sample> samples;
  for (const auto& file : fs::directory_iterator(fs::path(LEKALO_SOURCE_DIR) / "tests/fuzz/corpus/reader")) {
    std::ifstream stream(file.path(), std::ios::binary);
    samples.push_back({file.path().filename().string(), {std::istreambuf_iterator<char>(stream), {}}});
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.name < b.name; });
  return samples;
}

TEST(ReaderCorpus, EveryFileIsReadAsItShould) {
  const std::vector<Sample> samples = corpus();
  EXPECT_GE(samples.size(), 100u);
  for (const Sample& sample : samples) EXPECT_EQ(check_reader(sample.text), "") << sample.name;
}

TEST(ReaderCorpus, ExamplesHaveNoErrors) {
  for (const Sample& sample : corpus()) {
    if (!sample.name.starts_with("example-")) continue;
    Diagnostics diagnostics;
    read_document(make_source(sample.name, sample.text), diagnostics);
    EXPECT_EQ(diagnostics.text(), "");
  }
}

TEST(ReaderCorpus, FilesCutOffAnywhere) {
  for (const Sample& sample : corpus())
    for (std::size_t length = 0; length < std::min<std::size_t>(sample.text.size(), 600); ++length)
      ASSERT_EQ(check_reader(sample.text.substr(0, length)), "") << sample.name << " cut off at " << length;
}

TEST(ReaderCorpus, FilesWithChangedBytes) {
  std::mt19937 random(1);
  const std::string signs = " \n\t:-,[]{}'\"#&*!|>%@`?~\\$.0a\xC3\xA9";
  for (const Sample& sample : corpus()) {
    if (sample.text.empty() || sample.text.size() > 1500) continue;
    for (int round = 0; round < 30; ++round) {
      std::string text = sample.text;
      for (unsigned i = 0; i <= random() % 3; ++i) text[random() % text.size()] = signs[random() % signs.size()];
      ASSERT_EQ(check_reader(text), "") << sample.name << "\n" << text;
    }
  }
}

// Ten megabytes of nesting, of one line, of errors: time linear in the text.
TEST(ReaderCorpus, LargeTextsTakeBoundedTime) {
  const auto start = std::chrono::steady_clock::now();
  std::string nulls = "lekalo: 1\na: [";
  for (int i = 0; i < 30'000; ++i) nulls += "{\"b\":,\"b\":~},";
  EXPECT_EQ(check_reader(nulls + "1]"), "");
  EXPECT_EQ(check_reader("lekalo: 1\na: " + std::string(1'000'000, '{')), "");
  EXPECT_EQ(check_reader("lekalo: 1\na: '" + std::string(1'000'000, '\'')), "");
  EXPECT_EQ(check_reader("lekalo: 1\na: \"" + std::string(1'000'000, '\\')), "");
  EXPECT_EQ(check_reader("lekalo: 1\na: " + std::string(1'000'000, '(')), "");
  EXPECT_EQ(check_reader("lekalo: 1\n" + std::string(1'000'000, ' ') + "a"), "");
  EXPECT_EQ(check_reader(std::string(1'000'000, '\n') + "lekalo: 1"), "");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60)) << "seconds would mean quadratic time";
}

}  // namespace
}  // namespace lekalo::render::reader_corpus_test
