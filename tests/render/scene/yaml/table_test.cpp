// Tables of numbers: forms, blocks, and every way in which a row can be wrong.
#include "render/scene/yaml/table.h"

#include <gtest/gtest.h>

#include <string>

namespace lekalo::render::table_test {
namespace {

std::optional<Table> read(const std::string& text, std::string* said = nullptr) {
  Diagnostics diagnostics;
  auto table = read_table(make_source("net.csv", text), diagnostics);
  if (said)
    for (const Diagnostic& d : diagnostics.sorted())
      *said += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.message + "\n";
  else
    EXPECT_EQ(diagnostics.text(), "");
  return table;
}

std::string said(const std::string& text) {
  std::string result;
  EXPECT_FALSE(read(text, &result));
  return result;
}

TEST(Table, CommasOrBlanksSeparateCells) {
  for (const char* text : {"0,1,2\n3,4,5\n", "0 1 2\n  3\t4   5", "# a net\n0, 1, 2  # first\r\n 3 , 4 , 5\r\n"}) {
    const auto table = read(text);
    ASSERT_TRUE(table) << text;
    EXPECT_EQ(table->column_count, 3u);
    EXPECT_EQ(table->values, (std::vector<double>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(table->at(1, 0), 3);
  }
}

TEST(Table, NumbersAreReadToTheLastBit) {
  const auto table = read("-0.1 .5 1e-3 +2 0.30000000000000004 -1.7976931348623157e308\n");
  EXPECT_EQ(table->values, (std::vector<double>{-0.1, 0.5, 1e-3, 2, 0.1 + 0.2, -1.7976931348623157e308}));
}

TEST(Table, TheFirstLineMayNameTheColumns) {
  const auto table = read("u,v,x\n0,1,2\n");
  EXPECT_EQ(table->columns, (std::vector<std::string>{"u", "v", "x"}));
  EXPECT_EQ(table->row_count(), 1u);
  EXPECT_EQ(table->place(0).line, 2);
}

TEST(Table, EmptyLinesBeginBlocks) {
  const auto table = read("0 0\n0 1\n\n\n1 0\n# no block ends here\n1 1\n\n");
  EXPECT_EQ(table->blocks, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(table->lines, (std::vector<int>{1, 2, 5, 7}));
}

TEST(Table, EveryWrongRowIsReported) {
  EXPECT_EQ(said("0,1\n2\n0x1,3\n,4\n5,abc\n1e999,0\nnan,inf\n"),
            "2:1 this row has 1 cells, the first has 2\n"
            "3:1 '0x1' is not a decimal number\n"
            "4:1 an empty cell\n"
            "5:3 expected a number, found 'abc'\n"
            "6:1 '1e999' is beyond the range of numbers\n"
            "7:1 'nan' is not a number here\n"
            "7:5 'inf' is not a number here\n");
  EXPECT_EQ(said("1,5;2,5\n"), "1:4 a ';' in a table of numbers\n");
  EXPECT_EQ(said("# nothing\n"), "0:0 this table has no rows\n");
  EXPECT_EQ(said("1 2\n\xFF 3\n"), "2:1 byte 0xFF is not UTF-8\n");
}

TEST(Table, AFileThatCannotBeReadIsReportedWhereItIsNamed) {
  Diagnostics diagnostics;
  const auto scene = make_source("s.yaml", "points: { file: no.csv }\n");
  EXPECT_FALSE(read_table("no.csv", {scene, 1, 17, 6}, diagnostics));
  EXPECT_EQ(diagnostics.text(),
            "s.yaml:1:17: the table 'no.csv' cannot be read: no such file\n"
            "    points: { file: no.csv }\n"
            "                    ^~~~~~\n");
}

}  // namespace
}  // namespace lekalo::render::table_test
