// The report: its files, its determinism and that no text of a user becomes markup. The magma colours against the
// published table's ends and middle.
#include "render/suite/report.h"

#include <gtest/gtest.h>

#include "render/image/colormap.h"
#include "render/image/temporary_folder.h"

namespace lekalo::render::report_test {
namespace {

const std::filesystem::path kPairs = std::filesystem::path(LEKALO_SOURCE_DIR) / "tests/data/flip";

std::vector<ReportEntry> suite() {
  const auto compare = [](const char* a, const char* b, Metric metric, double threshold) {
    ComparisonResult result = compare_images(kPairs / a, kPairs / b, {.metric = metric, .threshold = threshold});
    result.path_a = a;
    result.path_b = b;
    return result;
  };
  std::vector<ReportEntry> entries;
  entries.push_back({"hdr", true, "", compare("hdr1_reference.exr", "hdr1_test.exr", Metric::flip, 0.1)});
  entries.push_back(
      {"<b>&\"", false, "the shift is <wanted>", compare("ldr1_reference.png", "ldr1_test.png", Metric::max, 0.1)});
  entries.push_back({"horn", false, "the golden image golden/horn.exr is missing", {}});
  return entries;
}

TEST(Report, ASuiteIsOnePageWithItsPictures) {
  const TemporaryFolder folder;
  write_report(folder / "deep/report", "kernel & co", suite());
  const std::string html = file_bytes(folder / "deep/report/index.html");
  for (const char* picture :
       {"0001-a.png", "0001-b.png", "0001-error.png", "0002-a.png", "0002-b.png", "0002-error.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "deep/report" / picture)) << picture;
    EXPECT_NE(html.find(std::string("src=\"") + picture + "\""), std::string::npos) << picture;
  }
  EXPECT_NE(html.find("<title>kernel &amp; co</title>"), std::string::npos);
  EXPECT_NE(html.find("2 of 3 failed"), std::string::npos);
  EXPECT_NE(html.find("the golden image golden/horn.exr is missing"), std::string::npos);
  EXPECT_NE(html.find("&lt;b&gt;&amp;&quot;"), std::string::npos);
  EXPECT_EQ(html.find("<wanted>"), std::string::npos);
  EXPECT_NE(html.find("0.0929"), std::string::npos);          // the published mean
  EXPECT_EQ(html.find("http"), std::string::npos);            // nothing from elsewhere
  EXPECT_LT(html.find("id=\"t2\""), html.find("id=\"t1\""));  // failed first
}

TEST(Report, TheSameEntriesGiveTheSameBytes) {
  const TemporaryFolder folder;
  write_report(folder / "a", "suite", suite());
  write_report(folder / "b", "suite", suite());
  for (const char* file : {"index.html", "0001-a.png", "0001-error.png", "0002-error.png"}) {
    EXPECT_EQ(file_bytes(folder / "a" / file), file_bytes(folder / "b" / file)) << file;
  }
}

TEST(Colormap, MagmaIsThePublishedTable) {
  using Color = std::array<std::uint8_t, 3>;
  EXPECT_EQ(magma(0), (Color{0, 0, 4}));  // 0.001462 0.000466 0.013866
  EXPECT_EQ(magma(128 / 255.0), (Color{183, 55, 121}));
  EXPECT_EQ(magma(1), (Color{252, 253, 191}));  // 0.987053 0.991438 0.749504
  EXPECT_EQ(magma(-1), magma(0));
  EXPECT_EQ(magma(7), magma(1));
}

}  // namespace
}  // namespace lekalo::render::report_test
