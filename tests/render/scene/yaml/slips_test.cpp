// The slips that people make in scene files, and what the reader says to each. The texts are the behaviour: whoever
// changes one looks at the sentence, not at the code.
#include <gtest/gtest.h>

#include <string>

#include "render/scene/yaml/reader.h"

namespace lekalo::render::slips_test {
namespace {

// The messages and hints for a text, without source lines, carets and notes.
std::string said(const std::string& text) {
  Diagnostics diagnostics;
  read_document(make_source("s", text), diagnostics);
  std::string result;
  for (const Diagnostic& d : diagnostics.sorted())
    result += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.message +
              (d.hint.empty() ? "" : " -> " + d.hint) + "\n";
  return result;
}

TEST(Slips, Tabs) {
  EXPECT_EQ(said("a:\n\tb: 1\n"),
            "2:1 a tab in the indentation -> indent with spaces; most editors can replace all tabs\n");
  EXPECT_EQ(said("a:\t1\n"), "1:3 a tab before a value -> use spaces; most editors can replace all tabs\n");
  EXPECT_EQ(said("a: 1\t# a tab before a comment is harmless\n"), "");
}

TEST(Slips, ColorsWithoutQuotes) {
  EXPECT_EQ(said("m:\n  color: #ff0000\n  type: diffuse\n"),
            "2:10 '#ff0000' without quotes is a comment, so 'color' has no value -> write color: '#ff0000'\n");
  EXPECT_EQ(said("m: { color: #f00 }\n"), "1:13 '#f00' without quotes is a comment -> write '#f00' in quotes\n");
  EXPECT_EQ(said("m: [#f00, #0f0]\n"), "1:5 '#f00' without quotes is a comment -> write '#f00' in quotes\n");
  EXPECT_EQ(said("m: [1, #add more here\n  2]\n"), "") << "a comment that begins with hexadecimal letters";
}

TEST(Slips, ColonWithoutSpace) {
  EXPECT_EQ(said("a: { type:ball, radius: 2 }\n"),
            "1:6 a space is missing behind the ':' of 'type:ball' -> write 'type: ball'\n");
  EXPECT_EQ(said("a: { at:[1, 2] }\n"), "1:6 a space is missing behind 'at:' -> write 'at: [...'\n");
  EXPECT_EQ(said("a:\n  radius:2\n"), "2:3 a space is missing behind 'radius:' -> write 'radius: 2'\n");
  EXPECT_EQ(said("a:\n  b: 1\n  radius:2\n"), "3:3 a space is missing behind 'radius:' -> write 'radius: 2'\n");
  EXPECT_EQ(said("a: http://a.b/c\nb: [C:/x]\n"), "") << "a colon inside a word is text";
}

TEST(Slips, OtherWritingsOfEntries) {
  EXPECT_EQ(said("a:\n  r = 2\n"), "2:5 'r' is followed by '=' -> write 'r: 2'\n");
  EXPECT_EQ(said("a: 1\ncamera\n"), "2:1 a ':' is missing behind 'camera' -> write 'camera: ...'\n");
  EXPECT_EQ(said("a:\n  b: 1\n  title：x\n"), "3:8 this is a full-width colon -> write 'title: x'\n");
  EXPECT_EQ(said("a: 1\n3 + 4\n"),
            "2:1 expected 'key: value' -> every line of a map is 'key: value', or 'key:' with indented lines below\n");
}

TEST(Slips, TexInBrackets) {
  EXPECT_EQ(said("a: { label: $\\mathbf{p}$ }\n"),
            "1:21 '$\\mathbf' is followed by '{' -> inside brackets a text that contains [ ] { } or ',' needs single "
            "quotes: '$\\mathbf{p}$'\n");
}

TEST(Slips, TexInDoubleQuotes) {
  const std::string cure = " -> write texts with backslashes in single quotes: '$\\theta$'\n";
  EXPECT_EQ(said("a: \"$\\theta$\"\n"), "1:6 in double quotes '\\theta' is not TeX: '\\t' stands for a tab" + cure);
  EXPECT_EQ(said("a: \"$\\nabla f$\"\n"),
            "1:6 in double quotes '\\nabla' is not TeX: '\\n' stands for a line break" + cure);
  EXPECT_EQ(said("a: \"\\frac12\"\n"), "1:5 in double quotes '\\frac' is not TeX: '\\f' stands for a form feed" + cure);
  EXPECT_EQ(said("a: \"\\mathbf{p}\"\n"), "1:5 in double quotes '\\mathbf' means nothing" + cure);
  EXPECT_EQ(said("a: \"\\upsilon\"\n"), "1:5 in double quotes '\\upsilon' means nothing" + cure);
  EXPECT_EQ(said("a: \"one\\ntwo\\t3 \\uABCDef $\"\n"),
            "1:8 in double quotes '\\ntwo' is not TeX: '\\n' stands for a line break" + cure);
  EXPECT_EQ(said("a: \"one\\ntwo\\t3 \\uABCDef\"\nb: \"$\\\\theta$ \\u00e9\"\n"), "") << "JSON's escapes";
}

TEST(Slips, CommasOfFunctionsInBrackets) {
  EXPECT_EQ(said("a: [t, max(a, b), 3]\n"),
            "1:8 'max(a' has a '(' without ')' -> inside brackets a ',' ends the value; put a function with commas in "
            "quotes: 'max(a, b)'\n");
  EXPECT_EQ(said("a: { p: f(1, g(2, 3)) }\n"),
            "1:9 'f(1' has a '(' without ')' -> inside brackets a ',' ends the value; put a function with commas in "
            "quotes: 'f(1, g(2, 3))'\n");
  EXPECT_EQ(said("a: max(1, 2)\nb: ['max(1, 2)', sin(t)]\n"), "");
}

TEST(Slips, DecimalCommasInBrackets) {
  EXPECT_EQ(said("a: { radius: 2,5 }\n"),
            "1:14 '2,5' is two entries: the comma ends the first -> decimal numbers have a point: 2.5\n");
  EXPECT_EQ(
      said("a: { radius: 2, red }\n"),
      "1:17 'red' has no value -> inside { } every entry is 'key: value'; a value that contains ',' needs quotes\n");
}

TEST(Slips, SignsThatYamlReserves) {
  EXPECT_EQ(said("a: *2\n"),
            "1:4 a value cannot begin with '*': to YAML that is an alias, and scene files have none -> write a product "
            "with its factors on both sides ('2*a'); repeat an entity by its name\n");
  EXPECT_EQ(
      said("a: &b { c: 1 }\n"),
      "1:4 a value cannot begin with '&': to YAML that is an anchor, and scene files have none -> name the thing in "
      "its section and refer to it by the name; 'like: NAME' copies fields\n");
  EXPECT_EQ(said("a: !!int 3\n"),
            "1:4 a value cannot begin with '!': to YAML that is a tag, and scene files have none -> put the value in "
            "single quotes if it is text\n");
  for (const std::string sign : {"%", "@", "`", "|", ">"})
    EXPECT_EQ(said("a: [" + sign + "x]\n"),
              "1:5 a value without quotes cannot begin with '" + sign + "' -> put it in single quotes\n");
  EXPECT_EQ(said("a: { <<: b }\n"),
            "1:6 scene files have no merge key '<<' -> 'like: NAME' copies the fields of another entity\n");
  EXPECT_EQ(said("? a\n: b\n"), "1:1 a '?' at the beginning of an entry -> a key is a plain name: 'name: value'\n");
  EXPECT_EQ(said("a: { b: why? }\n"),
            "1:12 a '?' inside brackets needs quotes -> put the whole value in single quotes\n");
  EXPECT_EQ(said("a: [- 1]\n"),
            "1:5 a '-' with nothing attached to it inside brackets -> items in brackets have no dashes; a minus sign "
            "stands directly before its number\n");
}

TEST(Slips, SecondDocuments) {
  EXPECT_EQ(
      said("a: 1\n---\nb: 2\n"),
      "2:1 '---' begins or ends a second document, and a scene file is one document -> remove this line; a second "
      "scene goes into a file of its own\n");
  EXPECT_EQ(said("%YAML 1.2\na: 1\n"),
            "1:1 a line that begins with '%' is a directive to YAML, and scene files have none -> remove this line\n");
}

TEST(Slips, NothingAsAValue) {
  const std::string cure = " -> leave the entry out to have its default; put the word in quotes if it is text\n";
  EXPECT_EQ(said("a: null\nb: [~]\n"),
            "1:4 'null' means nothing in scene files" + cure + "2:5 '~' means nothing in scene files" + cure);
  EXPECT_EQ(said("a:\nb:\n  -\n  - 1\nc: { d: , e: 1 }\n"),
            "1:1 'a' has no value -> give it a value, indent below it what belongs to it, or remove the line\n"
            "3:3 this list item is empty -> remove the '-', or write the item behind it\n"
            "5:6 'd' has no value -> give it a value, or remove it\n");
  EXPECT_EQ(said("a: 'null'\n"), "");
}

TEST(Slips, KeysGivenTwice) {
  Diagnostics diagnostics;
  read_document(make_source("ring.yaml", "geometry:\n  a: 1\n  b: 2\n  a: 3\n"), diagnostics);
  EXPECT_EQ(diagnostics.text(),
            "ring.yaml:4:3: 'a' is given twice, in lines 2 and 4\n"
            "      a: 3\n"
            "      ^\n"
            "hint: remove one of them\n"
            "ring.yaml:2:3: note: the first is here\n"
            "      a: 1\n"
            "      ^\n");
}

TEST(Slips, NamesOfKeys) {
  EXPECT_EQ(said("сircle: 1\n"),
            "1:1 'сircle' contains the Cyrillic letter 'с' (U+0441), which looks like 'c' -> write 'circle' with ASCII "
            "letters\n");
  EXPECT_EQ(said("corner radius: 1\n"), "1:1 ' ' cannot be part of a key: 'corner radius' -> write 'corner_radius'\n");
  EXPECT_EQ(said("2: 1\n"),
            "1:1 '2' begins with a digit -> names consist of letters, digits and _, and begin with a letter or _\n");
  EXPECT_EQ(said("[1, 2]: 3\n"), "1:7 a list or map cannot be a key -> keys are names\n");
}

TEST(Slips, Indentation) {
  EXPECT_EQ(said("a:\n    b: 1\n  c: 2\n"),
            "3:3 this line is indented by 2, the entries above it by 0 or 4 -> lines that belong together begin in the "
            "same column\n");
  EXPECT_EQ(
      said("o:\n  - shape: a\n     material: b\n"),
      "3:6 nothing can be indented under 'shape', which has the value 'a' -> to stand beside it, begin in column 5; "
      "to belong to it, 'a' needs a key of its own\n");
  EXPECT_EQ(said("a: [1]\n  b: 2\n"),
            "2:3 this line is indented under 'a', which is complete -> to stand beside it, begin in column 1\n");
  EXPECT_EQ(said("o:\n  a: 1\n  - b\n"),
            "3:3 a list item among the keys of a map -> indent it more than the key it belongs to, and leave that key "
            "without a value\n");
  EXPECT_EQ(
      said("o:\n  - a\n  b: 1\n"),
      "3:3 expected '- ': the lines above in this column are the items of a list -> begin with '- ', or indent this "
      "line if it belongs to the item above\n");
  EXPECT_EQ(said("o: - a\n"),
            "1:4 a list cannot begin on the line of its key 'o' -> begin the first '- ' on the next line, or write the "
            "list in brackets: [1, 2]\n");
}

TEST(Slips, ValuesOverSeveralLines) {
  EXPECT_EQ(
      said("a: a long\n  title\n"),
      "2:3 the value 'a long' cannot continue on a further line -> write it on one line; long texts go behind '>-' "
      "on indented lines\n");
  EXPECT_EQ(
      said("a: [b\n  c]\n"),
      "2:3 expected ',' or ']' before this line -> a ',' is missing at the end of the line above; a value without "
      "quotes cannot continue on a further line\n");
  EXPECT_EQ(
      said("a: 'b\n  c'\n"),
      "1:4 this single quote is not closed on its line -> close it; an apostrophe inside single quotes is written "
      "twice; long texts go behind '>-' on indented lines\n");
}

TEST(Slips, Quotes) {
  EXPECT_EQ(said("a: 'de Casteljau's'\n"),
            "1:18 unexpected text behind the closing quote -> an apostrophe inside single quotes is written twice: "
            "'Casteljau''s'\n");
  EXPECT_EQ(
      said("a: Fig: one\n"),
      "1:7 a ':' inside a value without quotes -> put the whole value in single quotes; or, if it is a key, begin it "
      "on the next line, indented\n");
  EXPECT_EQ(said("a: “b”\n"), "1:4 '“' is a typographic quote -> write straight quotes: '...'\n");
}

TEST(Slips, Brackets) {
  EXPECT_EQ(said("a: { p: [1, 2 }\n"),
            "1:15 '}' cannot close '[' -> a ']' is missing before it, or it should be one\n");
  EXPECT_EQ(said("a: [1, 2\nb:\n  - c\n"), "1:4 '[' is not closed -> a ']' is missing\n");
  EXPECT_EQ(said("a: { b: 1\nc: 2\n"), "1:4 '{' is not closed -> a '}' is missing\n");
  EXPECT_EQ(said("a: [1, 2\n"), "1:4 '[' is never closed -> a ']' is missing\n");
  EXPECT_EQ(said("a: ]\n"), "1:4 ']' closes a bracket that was never opened -> remove it\n");
  EXPECT_EQ(said("a: [1,, 2]\n"), "1:7 nothing stands before this ',' -> remove the ',', or write what is missing\n");
  EXPECT_EQ(said("a: [b: 1]\n"),
            "1:6 a ':' inside [ ] -> a list holds values; write [{ key: value }] for maps in a list\n");
  EXPECT_EQ(
      said("a: [1, 2] x\n"),
      "1:11 unexpected text behind the closing bracket -> a value that goes on behind its quotes or brackets needs "
      "quotes as a whole\n");
}

TEST(Slips, Characters) {
  EXPECT_EQ(said("a: caf\xE9\n"), "1:7 byte 0xE9 is not UTF-8 -> save the file as UTF-8\n");
  EXPECT_EQ(said("\xFF\xFEl\0"), "1:1 this file is UTF-16, not UTF-8 -> save it as UTF-8\n");
  EXPECT_EQ(said(std::string("a: \0b", 5)),
            "1:4 this file holds a zero byte: it is not a text file -> scene files are plain UTF-8 text\n");
  EXPECT_EQ(said("a: 1\x07\n"), "1:5 the control character U+0007 is not allowed in a scene file -> remove it\n");
  EXPECT_EQ(
      said("a: 1\u00a0mm\n"),
      "1:5 the no-break space (U+00A0) in a value without quotes -> replace it by an ordinary space, or remove it\n");
  EXPECT_EQ(said("a:\u00a01\n"), "1:3 the no-break space (U+00A0) behind 'a:' -> replace it by an ordinary space\n");
}

TEST(Slips, EmptyFiles) {
  for (const char* text : {"", "\n\n", "# nothing\n", "---\n"})
    EXPECT_EQ(said(text), "0:1 this file is empty -> a scene file begins with 'lekalo: 1'\n");
  EXPECT_EQ(said("- a\n"), "1:1 a scene file is a map of sections, not a list -> it begins with 'lekalo: 1'\n");
}

// The alias bomb that yaml-cpp 0.7 would expand to 9^9 items.
TEST(Slips, AliasBombIsRefusedAtItsFirstAnchor) {
  std::string bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c < 'j'; ++c) {
    bomb += std::string(1, c) + ": &" + c + " [";
    for (int i = 0; i < 9; ++i) bomb += std::string(i ? ", *" : "*") + static_cast<char>(c - 1);
    bomb += "]\n";
  }
  EXPECT_EQ(said(bomb).substr(0, 33), "1:4 a value cannot begin with '&'");
}

}  // namespace
}  // namespace lekalo::render::slips_test
