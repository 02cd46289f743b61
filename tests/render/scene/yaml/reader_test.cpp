// What the reader makes of well-formed texts. Facts from the YAML 1.2 and JSON specifications, and the limits of
// syntax.h.
#include "render/scene/yaml/reader.h"

#include <gtest/gtest.h>

#include <string>

namespace lekalo::render::reader_test {
namespace {

Value read(const std::string& text) {
  Diagnostics diagnostics;
  Value root = read_document(make_source("scene.yaml", text), diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return root;
}

std::string errors(const std::string& text, const ReadLimits& limits = {}) {
  Diagnostics diagnostics;
  read_document(make_source("scene.yaml", text), diagnostics, limits);
  return diagnostics.text();
}

TEST(Reader, KeepsScalarsAsWritten) {
  const Value root = read("a: 2.10\nb: R - e/2\nc: true\nd: -z\n");
  ASSERT_TRUE(root.is_map());
  EXPECT_EQ(root.find("a")->text, "2.10");
  EXPECT_EQ(root.find("b")->text, "R - e/2");
  EXPECT_EQ(root.find("c")->text, "true");
  EXPECT_EQ(root.find("d")->text, "-z");
  EXPECT_EQ(root.find("e"), nullptr);
}

TEST(Reader, TellsQuotedTextFromPlain) {
  const Value root = read("figure: '2.10'\nsection: 2.10\ntitle: \"a \\\"b\\\" \\u00e9\"\nowner: 'Casteljau''s'\n");
  EXPECT_TRUE(root.find("figure")->quoted);
  EXPECT_FALSE(root.find("section")->quoted);
  EXPECT_EQ(root.find("title")->text, "a \"b\" é");
  EXPECT_EQ(root.find("owner")->text, "Casteljau's");
}

TEST(Reader, GivesEveryValueItsPlace) {
  const Value root = read("geometry:\n  ring: { type: torus, name: 'é', of: section }\n");
  const Entry& ring = root.find("geometry")->entries.front();
  EXPECT_EQ(ring.key.place.line, 2);
  EXPECT_EQ(ring.key.place.column, 3);
  EXPECT_EQ(ring.key.place.length, 4);
  EXPECT_EQ(ring.value.place.column, 9);
  const Value& name = *ring.value.find("name");
  EXPECT_EQ(name.place.column, 30);
  EXPECT_EQ(name.place.length, 3);
  const Entry* of = ring.value.find_entry("of");
  EXPECT_EQ(of->key.place.column, 35) << "columns count characters, not bytes";
  EXPECT_EQ(of->value.place.length, 7);
}

TEST(Reader, FindsPlacesInsideScalars) {
  const Value root = read("a: R - side/2\nb: 'max(é, bb)'\nc: \"\\u00e9 + x\"\n");
  EXPECT_EQ(root.find("a")->place_of(4, 4).column, 8);
  EXPECT_EQ(root.find("a")->place_of(4, 4).length, 4);
  EXPECT_EQ(root.find("b")->place_of(8, 2).column, 12) << "behind the quote, after one two-byte character";
  EXPECT_EQ(root.find("c")->place_of(5, 1).column, 4) << "with escapes: the scalar as a whole";
}

TEST(Reader, ReadsBlockListsInBothIndentations) {
  const Value root = read("objects:\n- a\n-\n  - b\n  - - c\noutputs:\n  - x.png\n");
  const Value& objects = *root.find("objects");
  ASSERT_EQ(objects.items.size(), 2u);
  EXPECT_EQ(objects.items[1].items[1].items[0].text, "c");
  EXPECT_EQ(root.find("outputs")->items[0].text, "x.png");
}

TEST(Reader, ReadsMapsInListItems) {
  const Value root = read("objects:\n  - shape: r\n    lines: { curve: thick }\n  - { shape: q }\n");
  EXPECT_EQ(root.find("objects")->items[0].find("lines")->find("curve")->text, "thick");
  EXPECT_EQ(root.find("objects")->items[1].find("shape")->text, "q");
}

TEST(Reader, ReadsBlockTexts) {
  const Value root = read("a: |\n  one\n    # two: 2\n\n  three\nb: >-\n  one\n  two\nc: |-\n  one\n");
  EXPECT_EQ(root.find("a")->text, "one\n  # two: 2\n\nthree\n");
  EXPECT_EQ(root.find("b")->text, "one two");
  EXPECT_EQ(root.find("c")->text, "one");
  EXPECT_TRUE(root.find("c")->quoted);
}

TEST(Reader, ReadsJson) {
  const Value root = read(
      "{\n\t\"lekalo\":1,\r\n\t\"patch\": {\"points\":[[0,-2.5e3],[1,2]],\"closed\":false, \"to\": \"a\\/b\\n\"}}");
  EXPECT_EQ(root.find("lekalo")->text, "1");
  EXPECT_EQ(root.find("patch")->find("points")->items[0].items[1].text, "-2.5e3");
  EXPECT_EQ(root.find("patch")->find("to")->text, "a/b\n");
}

TEST(Reader, ReadsEveryLineBreakAndByteOrderMark) {
  for (const char* text : {"a: 1\nb: 2\n", "a: 1\r\nb: 2\r\n", "a: 1\rb: 2",
                           "\xEF\xBB\xBF"
                           "a: 1\nb: 2"}) {
    const Value root = read(text);
    EXPECT_EQ(root.find("a")->text, "1");
    EXPECT_EQ(root.find("b")->place.line, 2);
  }
}

TEST(Reader, ReadsTexInSingleQuotesAnywhere) {
  const Value root = read("a: { label: '$\\mathbf{p}_%i^{(%k)}$', side: above }\n");
  EXPECT_EQ(root.find("a")->find("label")->text, "$\\mathbf{p}_%i^{(%k)}$");
}

TEST(Reader, LetsCommentsAndOneDocumentStartPass) {
  const Value root = read("# scene\n---\na: 1   # not #ff0000\nb: [1, # one\n    2]\nc: a#b\n");
  EXPECT_EQ(root.find("a")->text, "1");
  EXPECT_EQ(root.find("b")->items.size(), 2u);
  EXPECT_EQ(root.find("c")->text, "a#b");
}

TEST(Reader, KeepsTheFirstOfEqualKeysAndGoesOn) {
  Diagnostics diagnostics;
  const Value root = read_document(make_source("scene.yaml", "a: 1\nb: 2\na: 3\nb: 4\nc: ~\nd: 5\n"), diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 3u) << diagnostics.text();
  EXPECT_EQ(root.find("a")->text, "1");
  EXPECT_TRUE(root.find("c")->invalid);
  EXPECT_EQ(root.find("d")->text, "5");
}

TEST(Reader, HoldsItsLimits) {
  std::string nested(64, '['), deeper(64, '{');
  EXPECT_NE(errors("a: " + nested).find("nested more than 64 deep"), std::string::npos);
  EXPECT_EQ(errors("a: " + nested.substr(1) + std::string(63, ']')), "");
  EXPECT_NE(errors(std::string(1'000'000, '[')).find("nested more than 64 deep"), std::string::npos);
  std::string dashes = "a:\n  ";
  for (int i = 0; i < 100'000; ++i) dashes += "- ";
  EXPECT_NE(errors(dashes).find("nested more than 64 deep"), std::string::npos);
  ReadLimits limits;
  limits.nodes = 100;
  std::string list = "a: [0";
  for (int i = 0; i < 200; ++i) list += ", 0";
  EXPECT_NE(errors(list + "]", limits).find("scene.yaml:1:296: this file has more than 100 values"), std::string::npos);
  limits.bytes = 500;
  EXPECT_NE(errors(list + "]", limits).find("this file has 0.0 million bytes"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::render::reader_test
