// How findings are shown: the caret stands under the place for tabs, wide and combining characters (widths of Unicode
// Standard Annex 11) and lines longer than the screen.
#include "render/scene/values/diagnostics.h"

#include <gtest/gtest.h>

namespace lekalo::render::diagnostics_test {
namespace {

std::string shown(const std::string& text, int line, int column, int length) {
  Diagnostics diagnostics;
  diagnostics.error({make_source("f", text), line, column, length}, "m");
  return diagnostics.text();
}

TEST(Diagnostics, ShowTheLineTheCaretAndTheHint) {
  const auto file = make_source("ring.yaml", "lekalo: 1\n  ring: { type: revolution_surface, of: section, axes: z }\n");
  Diagnostics diagnostics;
  diagnostics.error({file, 2, 50, 4}, "unknown field 'axes' of 'revolution_surface' (did you mean 'axis'?)",
                    "fields: of, axis");
  EXPECT_EQ(diagnostics.text(),
            "ring.yaml:2:50: unknown field 'axes' of 'revolution_surface' (did you mean 'axis'?)\n"
            "      ring: { type: revolution_surface, of: section, axes: z }\n"
            "                                                     ^~~~\n"
            "hint: fields: of, axis\n");
}

TEST(Diagnostics, PutTheCaretUnderTheCharacter) {
  EXPECT_EQ(shown("é: x\n", 1, 4, 1), "f:1:4: m\n    é: x\n       ^\n") << "two bytes, one column";
  EXPECT_EQ(shown("図: x\n", 1, 4, 1), "f:1:4: m\n    図: x\n        ^\n") << "one character, two columns";
  EXPECT_EQ(shown("e\u0301: x\n", 1, 5, 1), "f:1:5: m\n    e\u0301: x\n       ^\n")
      << "a combining accent has no width";
  EXPECT_EQ(shown("\tx\n", 1, 2, 1), "f:1:2: m\n        x\n        ^\n") << "a tab is shown as four spaces";
  EXPECT_EQ(shown("a\xFF"
                  "b\n",
                  1, 3, 1),
            "f:1:3: m\n    a\xEF\xBF\xBD"
            "b\n      ^\n")
      << "a byte that is not UTF-8";
  EXPECT_EQ(shown("ab\n", 1, 3, 1), "f:1:3: m\n    ab\n      ^\n") << "behind the end of the line";
  EXPECT_EQ(shown("ab\n", 1, 1, 99), "f:1:1: m\n    ab\n    ^~\n") << "not beyond the end of the line";
}

TEST(Diagnostics, ShowAWindowOfLongLines) {
  const std::string text = shown(std::string(1000, 'a') + "X" + std::string(1000, 'b'), 1, 1001, 1);
  EXPECT_EQ(text, "f:1:1001: m\n    ..." + std::string(60, 'a') + "X" + std::string(49, 'b') + "...\n" +
                      std::string(67, ' ') + "^\n");
}

TEST(Diagnostics, AreSortedAndWithoutRepetitions) {
  const auto main = make_source("main", "a\nb\n"), other = make_source("other", "c\n");
  Diagnostics diagnostics;
  diagnostics.error({main, 2, 1, 1}, "second");
  diagnostics.error({other, 1, 1, 1}, "third");
  diagnostics.warning({main, 1, 1, 1}, "first");
  diagnostics.error({main, 2, 1, 1}, "also second");
  diagnostics.error({main, 2, 1, 1}, "second");
  EXPECT_EQ(diagnostics.text(),
            "main:1:1: warning: first\n    a\n    ^\n"
            "main:2:1: second\n    b\n    ^\n"
            "main:2:1: also second\n    b\n    ^\n"
            "other:1:1: third\n    c\n    ^\n");
  EXPECT_EQ(diagnostics.error_count(), 4u);
}

TEST(Diagnostics, EndAfterAHundred) {
  Diagnostics diagnostics;
  const auto file = make_source("f", std::string(5000, '\n'));
  for (int i = 1; i <= 5000; ++i) diagnostics.error({file, i, 1, 1}, "wrong");
  const std::string text = diagnostics.text();
  EXPECT_NE(text.find("f:100:1:"), std::string::npos);
  EXPECT_EQ(text.find("f:101:1:"), std::string::npos);
  EXPECT_TRUE(text.ends_with("and 4900 more\n"));
}

TEST(Diagnostics, NameTheFilesThatIncluded) {
  const auto main = make_source("main.yaml", "lekalo: 1\ninclude: part.yaml\n");
  const auto part = make_source("part.yaml", "x\n", {}, {}, {main, 2, 10, 9});
  Diagnostics diagnostics;
  diagnostics.error({part, 1, 1, 1}, "wrong");
  EXPECT_EQ(diagnostics.text(), "part.yaml:1:1: wrong\n    x\n    ^\nmain.yaml:2:10: note: included from here\n");
}

TEST(Diagnostics, TravelInAnException) {
  Diagnostics diagnostics;
  diagnostics.unreadable({make_source("a.yaml", ""), 0, 0, 1}, "cannot be read: no such file");
  const SceneError error(diagnostics);
  EXPECT_STREQ(error.what(), "a.yaml: cannot be read: no such file\n");
  EXPECT_TRUE(error.diagnostics().cannot_read());
}

}  // namespace
}  // namespace lekalo::render::diagnostics_test
