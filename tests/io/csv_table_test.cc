#include "libindet/io/csv_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/io/utf8.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace std::string_literals;

struct Text {
  const char* name;
  std::string text;
  std::string message;  ///< After the name of the file; empty where the text is read.
};

void PrintTo(const Text& text, std::ostream* stream) { *stream << text.name; }

std::string name_of(const ::testing::TestParamInfo<Text>& instance) { return instance.param.name; }

/// The same table in other hands: id 0 and 1, x 0.5 and −2, name "north, west" and nothing.
class CsvTableRead : public ::testing::TestWithParam<Text> {};

TEST_P(CsvTableRead, HasTheSameNumbers) {
  const test::TemporaryFolder folder;
  folder.write("t.csv", GetParam().text);
  const Table table = read_csv(folder / "t.csv");
  EXPECT_THAT(table.columns(), ElementsAre("id", "x", "name"));
  ASSERT_EQ(table.rows(), 2);
  EXPECT_EQ(table.integer(0, "id"), 0);
  EXPECT_EQ(table.integer(1, "id"), 1);
  EXPECT_EQ(table.number(0, "x"), 0.5);
  EXPECT_EQ(table.number(1, "x"), -2);
  EXPECT_EQ(table.text(0, "name"), "north, west");
  EXPECT_TRUE(table.is_empty(1, "name"));
}

INSTANTIATE_TEST_SUITE_P(
    All, CsvTableRead,
    ::testing::Values(Text{"Plain", "id,x,name\n0,0.5,\"north, west\"\n1,-2,\n", ""},
                      Text{"SeparatorLine", "sep=,\nid,x,name\n0,0.5,\"north, west\"\n1,-2,\n", ""},
                      Text{"QuotedSeparatorLine",
                           "\xEF\xBB\xBF\"sep=,\"\r\nid,x,name\r\n0,0.5,\"north, west\"\r\n1,-2,\r\n", ""},
                      Text{"SeparatorLineOfSemicolons", "SEP=;\nid;x;name\n0;0.5;north, west\n1;-2;\n", ""},
                      Text{"SeparatorLineOfTabs", "sep=\t\nid\tx\tname\n0\t0.5\tnorth, west\n1\t-2\t\n", ""},
                      Text{"Semicolons", "id;x;name\n0;0.5;north, west\n1;-2;\n", ""},
                      Text{"DecimalCommas", "id;x;name\r\n0;0,5;\"north, west\"\r\n1;-2,0;\r\n", ""},
                      Text{"DecimalCommasWithExponents", "id;x;name\n0;+5,0e-1;north, west\n1;-0,2E1;\n", ""},
                      Text{"Tabs", "id\tx\tname\n0\t0,5\tnorth, west\n1\t-2\t\n", ""},
                      Text{"IndexOfPandas", ",id,x,name\n0,0,0.5,\"north, west\"\n1,1,-2.0,\n", ""},
                      Text{"IndexOfASelection", "\"\",id,x,name\n17,0,0.5,\"north, west\"\n3,1,-2.0,\n", ""},
                      Text{"IndexReadBack", "Unnamed: 0,id,x,name\n0,0,0.5,\"north, west\"\n1,1,-2.0,\n", ""},
                      Text{"IndexAndSemicolons", ";id;x;name\n0;0;0,5;north, west\n1;1;-2,0;\n", ""},
                      Text{"WholeNumbersAsReals", "id,x,name\n0.0,0.5,\"north, west\"\n1.0,-2,\n", ""}),
    name_of);

class CsvTableRefused : public ::testing::TestWithParam<Text> {};

TEST_P(CsvTableRefused, NamesFileLineAndReason) {
  const test::TemporaryFolder folder;
  folder.write("t.csv", GetParam().text);
  const auto use = [&] {
    const Table table = read_csv(folder / "t.csv");
    for (int row = 0; row < table.rows(); ++row) {
      table.integer(row, "id");
      table.number(row, "x");
    }
  };
  EXPECT_THAT(
      use, ::testing::ThrowsMessage<InputError>(HasSubstr((folder / "t.csv").string() + GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, CsvTableRefused,
    ::testing::Values(
        Text{"Latin1", "id,x,name\n0,1,W\xE4nde\n",
             ":2: the byte 0xE4 is not UTF-8 text (it may be Latin-1)"},
        Text{"Latin1InAComment",
             "# \xFC"
             "berall\nid,x\n",
             ":1: the byte 0xFC is not UTF-8"},
        Text{"CutInASequence", "id,x,name\n0,1,W\xC3", ":2: the byte 0xC3 is not UTF-8"},
        Text{"ZeroByte", "id,x\n0,\0"s + "1\n", ":2: the byte 0x00 is not UTF-8 text: save"},
        Text{"SeparatorOfAnotherKind", "sep=|\nid|x\n0|1\n",
             ":1: fields are separated by commas, semicolons or tabs, "
             "not by \"|\""},
        Text{"OnlyTheSeparator", "sep=;\n", ": the file is empty"},
        Text{"Blanks", "id x\n0 1\n",
             ":1: fields must be separated by commas, semicolons or tabs, not by blanks"},
        Text{"DecimalCommasBetweenCommas", "id,x\n0,0,5\n",
             ":2: 3 fields, but there are 2 columns (id, x); decimal commas are read only where semicolons"},
        Text{"QuotedDecimalComma", "id,x\n0,\"0,5\"\n",
             ":2: column x: \"0,5\" is not a number: it must have a decimal "
             "point"},
        Text{"Thousands", "id;x\n0;1.234,5\n",
             ":2: column x: \"1.234,5\" is not a number: it must have a decimal point "
             "and no separator of thousands"},
        Text{"BothMarks", "id;x\n0;0.5\n\n1;1,234\n",
             ":4: the number \"1,234\" has another decimal mark than \"0.5\" in line 2"},
        Text{"BothMarksReversed", "id;x\n0;1,234\n1;0.5\n",
             ":3: the number \"0.5\" has another decimal mark than \"1,234\" in line 2"},
        Text{"NamelessTextColumn", ",id,x\na,0,1\n",
             ":2: the first column has no name, so it must be the row numbers of "
             "pandas, but here it has \"a\""},
        Text{"NamelessLaterColumn", "id,x,\n0,1,2\n", ":1: column 3 has no name"},
        Text{"OpenQuote", "id,x\n0,\"1\n", ":2: a double quote is not closed"},
        Text{"LineEndsOfOldMacs", "id,x\r0,1\r", ":1: a carriage return alone ends this line"},
        Text{"NotWhole", "id,x\n0.5,1\n", ":2: column id: \"0.5\" is not a whole number"},
        Text{"HugeId", "id,x\n1e300,1\n", ":2: column id: \"1e300\" is not a whole number"}),
    name_of);

/// Any table of numbers, written in any of the ways, reads back to the same bits.
void check_a_dialect() {
  const int rows = *rc::gen::inRange(0, 6);
  const int columns = *rc::gen::inRange(2, 5);
  const char separator = *rc::gen::element(',', ';', '\t');
  const bool comma = separator != ',' && *rc::gen::arbitrary<bool>();
  const bool index = *rc::gen::arbitrary<bool>();
  const bool quotes = *rc::gen::arbitrary<bool>();
  const std::string end = *rc::gen::element("\n"s, "\r\n"s);
  std::string text = *rc::gen::element(""s, "\xEF\xBB\xBF"s);
  if (*rc::gen::arbitrary<bool>()) text += fmt::format("sep={}{}", separator, end);

  const auto written = [&](const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (i > 0) text += separator;
      text += quotes ? "\"" + fields[i] + "\"" : fields[i];
    }
    text += end;
  };
  std::vector<std::string> header;
  if (index) header.emplace_back("");
  for (int j = 0; j < columns; ++j) header.push_back(fmt::format("c{}", j));
  written(header);
  std::vector<std::vector<double>> values;
  for (int i = 0; i < rows; ++i) {
    std::vector<std::string> fields;
    if (index) fields.push_back(fmt::format("{}", *rc::gen::inRange(0, 100)));
    values.emplace_back();
    for (int j = 0; j < columns; ++j) {
      const double value = *rc::gen::arbitrary<double>();
      values.back().push_back(value);
      fields.push_back(fmt::format("{}", value));
      if (comma) std::replace(fields.back().begin(), fields.back().end(), '.', ',');
    }
    written(fields);
  }
  const test::TemporaryFolder folder;
  folder.write("t.csv", text);
  const Table table = read_csv(folder / "t.csv");
  RC_ASSERT(table.rows() == rows);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      RC_ASSERT(table.number(i, fmt::format("c{}", j)) ==
                values[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
}

TEST(CsvTable, NumbersDoNotDependOnTheDialect) { EXPECT_TRUE(rc::check(check_a_dialect)); }

/// UTF-8 by its definition: the bits of a code point in one to four bytes.
std::string encoded(char32_t point) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((point >> shift) & 0x3F)); };
  if (point < 0x80) return {static_cast<char>(point)};
  if (point < 0x800) return {static_cast<char>(0xC0 | (point >> 6)), tail(0)};
  if (point < 0x10000) return {static_cast<char>(0xE0 | (point >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | (point >> 18)), tail(12), tail(6), tail(0)};
}

TEST(Utf8, EveryCodePointIsValidButSurrogatesAndWhatLiesBeyond) {
  for (char32_t point = 0; point < 0x110400; ++point) {
    const std::string text = encoded(point);
    const bool valid = (point < 0xD800 || point > 0xDFFF) && point <= 0x10FFFF;
    ASSERT_EQ(valid_utf8_length(text), valid ? text.size() : 0) << std::hex << static_cast<unsigned>(point);
    if (valid && text.size() > 1) {
      ASSERT_EQ(valid_utf8_length("a" + text.substr(0, text.size() - 1)), 1u);  // cut
      ASSERT_EQ(valid_utf8_length(text.substr(1)), 0u);                         // without its first byte
    }
  }
}

TEST(Utf8, OverlongFormsAreNotValid) {
  for (const char* text : {"\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xE0\x9F\xBF", "\xF0\x80\x80\x80",
                           "\xF0\x8F\xBF\xBF", "\xF8\x88\x80\x80\x80", "\xFF"}) {
    EXPECT_EQ(valid_utf8_length("x" + std::string(text)), 1u);
  }
}

}  // namespace
}  // namespace indet
