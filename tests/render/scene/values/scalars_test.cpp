// Our own rules for scalars (never YAML's), and what is said about every other way to write a number, a truth or a
// name.
#include "render/scene/values/scalars.h"

#include <gtest/gtest.h>

#include "render/scene/yaml/reader.h"

namespace lekalo::render::scalars_test {
namespace {

Value plain(const std::string& text) {
  Value value;
  value.text = text;
  return value;
}

Value in_quotes(const std::string& text) {
  Value value = plain(text);
  value.quoted = true;
  return value;
}

template <class T>
std::string slip(const Reading<T>& reading) {
  return reading ? "no slip" : reading.slip().message + " -> " + reading.slip().hint;
}

TEST(Scalars, BooleansAreTwoWords) {
  EXPECT_TRUE(*read_boolean(plain("true")));
  EXPECT_FALSE(*read_boolean(plain("false")));
  EXPECT_EQ(slip(read_boolean(plain("yes"))), "expected true or false, found 'yes' -> write true");
  EXPECT_EQ(slip(read_boolean(plain("Off"))), "expected true or false, found 'Off' -> write false");
  EXPECT_EQ(slip(read_boolean(plain("0"))), "expected true or false, found '0' -> write false");
  EXPECT_EQ(slip(read_boolean(plain("drop"))), "expected true or false, found 'drop' -> ");
  EXPECT_EQ(slip(read_boolean(in_quotes("true"))), "'true' in quotes is a text -> write true without quotes");
}

TEST(Scalars, NumbersAreDecimal) {
  EXPECT_EQ(*read_number("2"), 2);
  EXPECT_EQ(*read_number("-2"), -2);
  EXPECT_EQ(*read_number("+3"), 3);
  EXPECT_EQ(*read_number(".5"), 0.5);
  EXPECT_EQ(*read_number("-.5"), -0.5);
  EXPECT_EQ(*read_number("2."), 2);
  EXPECT_EQ(*read_number("1e-3"), 1e-3);
  EXPECT_EQ(*read_number("0.1"), 0.1) << "correctly rounded";
  EXPECT_EQ(*read_number("0"), 0);
  EXPECT_EQ(*read_number("0e0"), 0);
}

TEST(Scalars, OtherWritingsOfNumbersAreExplained) {
  EXPECT_EQ(slip(read_number("2,5")), "'2,5' has a decimal comma -> write 2.5");
  EXPECT_EQ(slip(read_number("007")), "'007' begins with a zero -> write 7");
  EXPECT_EQ(slip(read_number("-00.5")), "'-00.5' begins with a zero -> write -0.5");
  EXPECT_EQ(slip(read_number("0x1F")), "'0x1F' is not a decimal number -> write 31");
  EXPECT_EQ(slip(read_number("0o17")), "'0o17' is not a decimal number -> write 15");
  EXPECT_EQ(slip(read_number("0b101")), "'0b101' is not a decimal number -> write 5");
  EXPECT_EQ(slip(read_number("1_000")), "'1_000' has separators between its digits -> write 1000");
  EXPECT_EQ(slip(read_number("1:30")), "'1:30' is not a number -> a ratio is written 1/30");
  EXPECT_EQ(slip(read_number(".inf")), "'.inf' is not a number here -> leave the field out, or give a large number");
  EXPECT_EQ(slip(read_number("-.NaN")), "'-.NaN' is not a number here -> give a number");
  EXPECT_EQ(slip(read_number("50%")), "'50%' is a percentage -> write 50/100");
  EXPECT_EQ(slip(read_number("−2")), "the character '−' (U+2212) is not a minus sign -> write -2");
  EXPECT_EQ(slip(read_number("1e999")), "'1e999' is beyond the range of numbers -> numbers reach from 1e-307 to 1e307");
  EXPECT_EQ(slip(read_number("abc")), "expected a number, found 'abc' -> ");
}

TEST(Scalars, FormulasAreNoSlips) {
  for (const char* text : {"R - e/2", "0.5*a", "180 deg*s", "max(1,2)", "n-1", "-x", "2*0", "", "10"})
    EXPECT_FALSE(number_slip(text)) << text;
}

TEST(Scalars, Integers) {
  EXPECT_EQ(*read_integer(plain("-12")), -12);
  EXPECT_EQ(*read_integer(plain("1e3")), 1000);
  EXPECT_EQ(slip(read_integer(plain("1.5"))), "expected an integer, found '1.5' -> ");
  EXPECT_EQ(slip(read_integer(plain("3000000000"))), "'3000000000' is too large -> ");
}

TEST(Scalars, Names) {
  EXPECT_EQ(*read_name(plain("pitch_radius2")), "pitch_radius2");
  EXPECT_EQ(*read_reference(plain("hole.3.side")), "hole.3.side");
  EXPECT_EQ(slip(read_name(plain("hole.3"))),
            "'.' cannot be part of a name: 'hole.3' -> names consist of letters, digits "
            "and _, and begin with a letter or _");
  EXPECT_EQ(slip(read_name(plain("top-face"))), "'-' cannot be part of a name: 'top-face' -> write 'top_face'");
  EXPECT_EQ(slip(read_name(plain("2d"))),
            "'2d' begins with a digit -> names consist of letters, digits and _, and begin with a letter or _");
  EXPECT_EQ(slip(read_reference(plain("hole."))),
            "'hole.' has a dot with nothing behind it -> members are written NAME.MEMBER: hole.3");
  EXPECT_EQ(slip(read_reference(plain("hole.3a"))),
            "'3a' begins with a digit -> names consist of letters, digits and _, and begin with a letter or _");
}

TEST(Scalars, LookAlikeLettersAreNamed) {
  EXPECT_EQ(
      slip(read_name(plain("rаdius"))),
      "'rаdius' contains the Cyrillic letter 'а' (U+0430), which looks like 'a' -> write 'radius' with ASCII letters");
  EXPECT_EQ(slip(read_name(plain("Τop"))),
            "'Τop' contains the Greek letter 'Τ' (U+03A4), which looks like 'T' -> write 'Top' with ASCII letters");
  EXPECT_EQ(slip(read_name(plain("θ"))),
            "'θ' contains the Greek letter 'θ' (U+03B8) -> names consist of the letters a-z and A-Z, digits and _");
}

TEST(Scalars, TextsThatAreNumbers) {
  EXPECT_EQ(*read_text(plain("2.10")), "2.10");
  EXPECT_EQ(*read_quoted_text(in_quotes("2.10")), "2.10");
  EXPECT_EQ(*read_quoted_text(plain("Gr 1")), "Gr 1");
  EXPECT_EQ(
      slip(read_quoted_text(plain("2.10"))),
      "'2.10' without quotes is a number, and 2.10 could not be told from other ways to write it -> write '2.10' in "
      "quotes");
}

TEST(Scalars, PageLengths) {
  EXPECT_DOUBLE_EQ(read_page_length(plain("84 mm"))->millimetres(300), 84);
  EXPECT_DOUBLE_EQ(read_page_length(plain("72pt"))->millimetres(300), 25.4) << "72 points are an inch";
  EXPECT_DOUBLE_EQ(read_page_length(plain("300 px"))->millimetres(300), 25.4);
  EXPECT_EQ(slip(read_page_length(plain("0.5"))),
            "the length '0.5' on the page has no unit -> write 0.5 mm, 0.5 pt or 0.5 px");
  EXPECT_EQ(slip(read_page_length(plain("8.4 cm"))), "'cm' is not a unit of page lengths -> write 84 mm");
  EXPECT_EQ(slip(read_page_length(plain("1 in"))), "'in' is not a unit of page lengths -> write 25.4 mm");
  EXPECT_EQ(slip(read_page_length(plain("2 MM"))), "'MM' is not a unit of page lengths -> write 2 mm");
  EXPECT_EQ(slip(read_page_length(plain("2 em"))), "'em' is not a unit of page lengths -> the units are mm, pt and px");
  EXPECT_EQ(slip(read_page_length(plain("0,5 pt"))), "'0,5' has a decimal comma -> write 0.5");
  EXPECT_EQ(slip(read_page_length(plain("thin"))),
            "expected a length on the page, found 'thin' -> a number with mm, pt or px: 0.5 pt");
}

TEST(Scalars, RangesSplitAtTwoDots) {
  Diagnostics diagnostics;
  const Value root = read_document(make_source("s", "i: 0 .. n-1\nj: .5...5\nk: 1..\nl: '0..2'\n"), diagnostics);
  EXPECT_TRUE(is_range(*root.find("i")));
  EXPECT_FALSE(is_range(*root.find("l")));
  const Reading<IntegerRange> range = read_range(*root.find("i"));
  ASSERT_TRUE(range);
  EXPECT_EQ(range->first, "0");
  EXPECT_EQ(range->last, "n-1");
  EXPECT_EQ(range->last_place.column, 9);
  EXPECT_EQ(range->last_place.length, 3);
  EXPECT_EQ(slip(read_range(*root.find("j"))),
            "the range '.5...5' has more than two dots -> a range is FIRST..LAST, both inclusive: 0..n-1");
  EXPECT_EQ(slip(read_range(*root.find("k"))),
            "the range '1..' has no end -> a range is FIRST..LAST, both inclusive: 0..n-1");
}

TEST(Scalars, WrongKindsAreNamed) {
  Value list;
  list.kind = Value::Kind::sequence;
  EXPECT_EQ(slip(read_number(list)), "expected a number, found a list -> ");
  EXPECT_EQ(slip(read_name(list)), "expected a name, found a list -> ");
}

}  // namespace
}  // namespace lekalo::render::scalars_test
