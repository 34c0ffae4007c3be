#include <gtest/gtest.h>

#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/numbers.h>

#include <tests/io/text/internal/csv_table.h>
#include <tests/random.h>
#include <tests/refusal.h>

// No row of a table is lost without a word.

namespace beeline::internal {
namespace {

using testing::Names;
using testing::Random;
using testing::Rows;
using testing::Table;
using testing::table_of;

constexpr const char* minus = "\xe2\x88\x92";

bool has_t(const Names& names) { return names.front() == "t"; }

/// The rows of a table: `LINE: NUMBERS` or `LINE: bad`.
std::vector<std::string> readings_of(const std::string& text, const CsvForms& forms = {}) {
  const std::string path = "a.csv";
  CsvLines lines(text, path);
  CsvRows rows(lines, path, forms);
  std::vector<std::string> readings;
  std::vector<double> row(rows.columns().size());
  while (rows.advance()) {
    readings.push_back(std::to_string(rows.line()) + ":");
    try {
      rows.parse(row.data());
      for (const double value : row) readings.back() += ' ' + exact(value);
    } catch (const Error&) {
      readings.back() += " bad";
    }
  }
  return readings;
}

/// Rows with any minus, rows of separators, rows of missing values and comments, in any order.
TEST(CsvRowsKept, EachLineBelowTheHeaderIsReadOrBad) {
  Random random;
  const char* const without_numbers[] = {"SS", "S", "---S---S---", "- - -", "--- --- ---"};
  for (int i = 0; i < 100 * testing::cases(3); ++i) {
    const std::string separator(1, ",; \t"[random.integer(0, 3)]);
    const bool header = random.integer(0, 1) == 0;
    std::string text = header ? "a" + separator + "b" + separator + "c\n" : "";
    std::vector<std::string> expected;
    int line = header ? 1 : 0;
    const int rows = random.integer(1, 8);
    for (int r = 0; r <= rows; ++r) {
      // A rule may be below the header, lines without data at the end; both are tested apart.
      const bool good = r == 0 || r == rows || random.integer(0, 2) == 0;
      std::string items, values;
      if (good) {
        for (int k = 0; k < 3; ++k) {
          const double value = random.integer(-99, 99) + 0.5;
          values += ' ' + exact(value);
          items += (k == 0 ? "" : separator) +
                   (value < 0 && random.integer(0, 1) ? minus + exact(-value) : exact(value));
        }
      } else {
        items = without_numbers[random.integer(0, 4)];
        for (std::size_t at; (at = items.find('S')) != items.npos;) items.replace(at, 1, separator);
        values = " bad";
      }
      text += items + '\n';
      ++line;
      const bool blank = items.find_first_not_of(" \t") == items.npos;
      if (!blank) expected.push_back(std::to_string(line) + ":" + values);
      if (random.integer(0, 3) == 0) {
        text += random.integer(0, 1) ? "# a comment\n" : "\n";
        ++line;
      }
    }
    const CsvForms forms{
        .without_header = {{"a", "b", "c"}}, .accepts = has_t, .reads_others = true};
    EXPECT_EQ(readings_of(text, forms), expected) << text;
  }
}

TEST(CsvRowsKept, ATableOfOtherNamesIsReadFromItsFirstRow) {
  const CsvForms forms{.accepts = has_t, .reads_others = true};
  const std::string text = std::string("q1,q2\n0,") + minus + "0.1\n1," + minus + "1\n2,2\nt,u\n";
  EXPECT_EQ(readings_of(text, forms),
            (std::vector<std::string>{"2: 0 -0.1", "3: 1 -1", "4: 2 2", "5: bad"}));
  EXPECT_REFUSED(table_of("q1,q2,state\n1,2,on\n1,2,off\n3,4,5\n", forms),
                 "a.csv:2: column state: \"on\" is not a number");
  EXPECT_REFUSED(table_of("q1,q2\n0x0,1\n1,2\n", forms), "a.csv:2: column q1");
  EXPECT_EQ(readings_of("q1,q2\n0x0,1\n1,2\n", {.accepts = has_t}),
            (std::vector<std::string>{"2: bad", "3: 1 2"}));
  EXPECT_REFUSED(table_of("q1,q2\n\"a\nb,c\n\nt,q1\n0,1\n", {.accepts = has_t}),
                 "a.csv:1: this line is not the header, as line 5 is");
}

TEST(CsvRowsKept, NumbersWithTheMinusOfUnicodeAreNoHeader) {
  const CsvForms forms{.without_header = {{"a", "b"}}};
  const std::string row = minus + std::string("1,5;") + minus + "2\n";
  EXPECT_EQ(table_of(row, forms).rows, (Rows{{-1.5, -2}})) << "with a decimal comma";
  EXPECT_FALSE(table_of(row, forms).has_header);
}

TEST(CsvRowsKept, EmptyRowsCountUnlessTheyAreTheLast) {
  EXPECT_EQ(readings_of("x,y\n,\n1,2\n;;\n# a\n\n3,4\n"),
            (std::vector<std::string>{"2: bad", "3: 1 2", "4: bad", "7: 3 4"}));
  EXPECT_EQ(readings_of(",,\nx,y\n1,2\n,\n,,\n\n,\n"), (std::vector<std::string>{"3: 1 2"}));
  std::string text = "x,y\n", bad;
  std::vector<std::string> expected;
  for (int i = 0; i < 300; ++i) {  // more kinds than are kept for the end
    text += std::string(static_cast<std::size_t>(1 + i % 2), ',') + '\n';
    expected.push_back(std::to_string(i + 2) + ": bad");
  }
  expected.emplace_back("302: 1 2");
  EXPECT_EQ(readings_of(text + "1,2\n"), expected);
  const CsvForms forms{.without_header = {{"x", "y"}}};
  for (const char* above : {",\n1,2\n", "# a\n--- ---\n1 2\n", ";\n1;2\n"}) {
    EXPECT_REFUSED(table_of(above, forms), ": this row has no numbers; remove it, or write");
  }
}

TEST(CsvRowsKept, RulesAreBesideTheHeaderOrInAFrame) {
  const std::vector<std::string> missing{"3: 1 2", "4: bad", "5: 3 4"};
  EXPECT_EQ(readings_of("x y\n--- ---\n1 2\n--- ---\n3 4\n"), missing);
  EXPECT_EQ(readings_of("|x|y|\n|---|---|\n|1|2|\n| --- | --- |\n|3|4|\n"), missing);
  EXPECT_EQ(readings_of("x y\n--- ---\n--- ---\n1 2\n"),
            (std::vector<std::string>{"3: bad", "4: 1 2"}));
  const std::string rule = "=== ===\n";
  const std::string table = rule + "x   y\n" + rule + "1   2\n";
  EXPECT_EQ(readings_of(table + rule), (std::vector<std::string>{"4: 1 2"}));
  EXPECT_EQ(readings_of(table + rule + "3 4\n"),
            (std::vector<std::string>{"4: 1 2", "5: bad", "6: 3 4"}));
  EXPECT_EQ(
      readings_of("+---+---+\n| x | y |\n+===+===+\n| 1 | 2 |\n+---+---+\n| 3 | 4 |\n+---+---+\n"),
      (std::vector<std::string>{"4: 1 2", "6: 3 4"}));
}

TEST(CsvRowsKept, AHeaderOfPandasWithSemicolonsIsNoComment) {
  const CsvForms forms{.without_header = {{"t", "q"}}, .has_index = true};
  for (const char* rows : {"0;0.1\n1;0.2\n", "# a\n\n0;0,1\n1;0,2\n", "\"0\";0.1;\n1;0.2\n"}) {
    const Table table = table_of(std::string(";q\n") + rows, forms);
    EXPECT_EQ(table.columns, (Names{index_name, "q"})) << rows;
    EXPECT_EQ(table.rows, (Rows{{0, 0.1}, {1, 0.2}})) << rows;
  }
  for (const char* text : {"; q\n0,0.1\n1,0.2\n", ";q\nt;q\n0;0.1\n1;0.2\n",
                           ";\nt;q\n0;0.1\n1;0.2\n", ";by hand\n;q\n# a\n0 0.1\n1 0.2\n"}) {
    const Table table = table_of(text, forms);
    EXPECT_EQ(table.columns, (Names{"t", "q"})) << text;
    EXPECT_EQ(table.rows, (Rows{{0, 0.1}, {1, 0.2}})) << text;
  }
}

}  // namespace
}  // namespace beeline::internal
