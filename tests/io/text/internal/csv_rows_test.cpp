#include <gtest/gtest.h>

#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/numbers.h>

#include <tests/io/text/internal/csv_table.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::Names;
using testing::Rows;
using testing::Table;
using testing::table_of;

TEST(CsvRows, RowsKeepTheirLines) {
  const Table table = table_of("# a comment\nx, y\n1,2\n\n  # another\n3 , -4e-1\n");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(table.rows, (Rows{{1, 2}, {3, -0.4}}));
  EXPECT_EQ(table.lines, (std::vector<int>{3, 6}));
}

TEST(CsvRows, OtherProgramsHabitsAreUnderstood) {
  const Rows rows{{1, 2}};
  for (const char* text : {"x,y\r\n1,2\r\n", "\xef\xbb\xbfx,y\n1,2", "\"x\",\"y\"\n\"1\",\"2\"\n",
                           "x,y\n\t1 , 2 \n\n\n", " \"x\" , \"y\" \n1,2\n"}) {
    const Table table = table_of(text);
    EXPECT_EQ(table.rows, rows) << text;
    EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"})) << text;
  }
}

TEST(CsvRows, AnyNameSurvivesItsQuotes) {
  for (const char* name : {"a", "a,b", "say \"hi\"", " blank ", "#1", "\"", "gr\xc3\xbc\xc3\x9f"}) {
    const Table table = table_of("t," + csv_name(name) + "\n1,2\n");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"t", name}));
  }
  EXPECT_EQ(csv_name("joint1"), "joint1");
}

TEST(CsvRows, RandomTablesReadBackExactly) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const int columns = random.integer(1, 12);
    std::string text;
    for (int c = 0; c < columns; ++c) text += (c == 0 ? "c" : ",c") + std::to_string(c);
    Rows rows;
    for (int r = random.integer(1, 20); r > 0; --r) {
      text += '\n';
      rows.emplace_back();
      for (int c = 0; c < columns; ++c) {
        rows.back().push_back(random.uniform(-1, 1) * std::pow(10, random.integer(-300, 300)));
        text += (c == 0 ? "" : ",") + exact(rows.back().back());
      }
    }
    EXPECT_EQ(table_of(text).rows, rows);
  }
}

TEST(CsvRows, MistakesAreNamedWithTheirLine) {
  EXPECT_REFUSED(table_of(""), "a.csv: is empty; it needs a header and rows");
  EXPECT_REFUSED(table_of("\n# only this\n"), "a.csv: is empty");
  EXPECT_REFUSED(table_of("x,y\n"), "a.csv: has a header but no rows");
  EXPECT_REFUSED(table_of("x,y\n1,2\n1\n"), "a.csv:3: this row has 1 items; the header has 2");
  EXPECT_REFUSED(table_of("x,y\n1,2,3\n"), "a.csv:2: this row has 3 items");
  EXPECT_REFUSED(table_of("x,y\n1,two\n"), "a.csv:2: column y: \"two\" is not a number");
  EXPECT_REFUSED(table_of("x,y\n1,\n"), "a.csv:2: column y: a number is missing");
  EXPECT_REFUSED(table_of("x,y\n1,nan\n"), "a.csv:2: column y: \"nan\" must be finite");
  EXPECT_REFUSED(table_of("x,y\n\n1,inf\n"), "a.csv:3: column y: \"inf\" must be finite");
  EXPECT_REFUSED(table_of("x,x\n1,2\n"), "a.csv:1: column \"x\" is given twice");
  EXPECT_REFUSED(table_of("x,,y\n1,2,3\n"), "a.csv:1: the name of column 2 is empty");
  EXPECT_REFUSED(table_of("1,2\n3,4\n"), "a.csv:1: the first line must be a header");
  EXPECT_REFUSED(table_of("\"x,y\n1,2\n"), "a.csv:1: a quotation mark is not closed");
  EXPECT_REFUSED(table_of("\"x\"y\n1\n"), "a.csv:1: \"y\" follows a closing");
  EXPECT_REFUSED(table_of(std::string("x\n1\0\n", 5)), "a.csv:2: has a byte of 0");
}

TEST(CsvRows, SemicolonsSeparateWhereTheFirstLineHasNoComma) {
  const Table table = table_of("x;\"y,;\"\n1;2\n");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y,;"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<double>>{{1, 2}}));
  EXPECT_EQ(csv_separator("a,b;c"), ',');
  EXPECT_EQ(csv_separator("a"), ',');
  EXPECT_EQ(csv_name("a;b"), "\"a;b\"");
  EXPECT_EQ(table_of("a;b,c\n1,2\n").columns.front(), "a;b");
}

TEST(CsvRows, TabsAndBlanksSeparateToo) {
  const Rows rows{{1, -2.5}, {3, 4}};
  for (const char* text : {"x y\n1 -2.5\n3 4\n", "x   y\n 1  -2,5\n3\t4\n", "x\ty\n1\t-2,5\n3\t4\n",
                           "x\ty\n 1 \t -2.5\n3\t4\n", "\"x\" \"y\"\n\"1\" \"-2.5\"\n3 4\n"}) {
    const Table table = table_of(text);
    EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"})) << text;
    EXPECT_EQ(table.rows, rows) << text;
  }
  EXPECT_EQ(table_of("joint 1\tjoint 2\n1\t2\n").columns.front(), "joint 1");
  EXPECT_EQ(csv_separator("1,5 2"), ' ');
  EXPECT_EQ(csv_separator("1, 5, 2"), ',');
  EXPECT_EQ(csv_separator("1,5;2"), ';');
  EXPECT_EQ(csv_separator("1,2,3"), ',');
  EXPECT_EQ(csv_name("a b"), "\"a b\"");
  EXPECT_EQ(table_of(csv_name("a b") + "\n1\n").columns, std::vector<std::string>{"a b"});
  EXPECT_REFUSED(table_of("x\ty\n1\t\t2\n"), "a.csv:2: ");
}

TEST(CsvRows, DifferencesFromTheFirstRowAreExact) {
  const std::string path = "a.csv";
  CsvLines lines("t,x\n1700000000123456789,1\n\"1700000000123456790\",2\n1.5,3\n", path);
  CsvRows rows(lines, path);
  rows.count_from_first({0});
  std::vector<double> row, differences;
  while (rows.next(row)) differences.push_back(rows.from_first(0));
  EXPECT_EQ(differences, (std::vector<double>{0, 1, 1.5 - 1700000000123456789.0}));
}

TEST(CsvRows, EndlessHeadersAreRefused) {
  std::string many = "c0";
  for (int i = 1; i <= 100'000; ++i) many += ",c" + std::to_string(i);
  EXPECT_REFUSED(table_of(many + "\n1\n"), "more than 100000 columns");
}

TEST(CsvRows, ACommentBeforeTheFirstRowMayBeTheHeader) {
  const CsvForms forms{{}, [](const Names& names) { return names.front() == "x"; }};
  for (const char* text : {"# x,y\n1,2\n", "# by hand\n#x y\n1 2\n", "#\"x\";y\n\n1;2\n"}) {
    const Table table = table_of(text, forms);
    EXPECT_EQ(table.columns, (Names{"x", "y"})) << text;
    EXPECT_EQ(table.rows, (Rows{{1, 2}}));
    EXPECT_TRUE(table.has_header);
  }
  EXPECT_EQ(table_of("# x,y\nx,z\n1,2\n", forms).columns, (Names{"x", "z"}));
  EXPECT_REFUSED(table_of("# x,y,z\n1,2\n", forms), "a.csv:2: the first line must be a header");
  EXPECT_REFUSED(table_of("# y,x\n1,2\n", forms), "a.csv:2: the first line must be a header");
}

TEST(CsvRows, AFirstLineWithNumbersIsARowOfAFormAsLong) {
  const CsvForms forms{{{"a", "b"}, {"x", "y", "z"}}, {}};
  EXPECT_EQ(table_of("1,2\n", forms).columns, (Names{"a", "b"}));
  EXPECT_EQ(table_of("1;2,5;3\n", forms).rows, (Rows{{1, 2.5, 3}}));
  EXPECT_FALSE(table_of("1,2\n", forms).has_header);
  EXPECT_REFUSED(table_of("1,two\n", forms), "a.csv:1: column b: \"two\" is not a number");
  EXPECT_REFUSED(table_of("1,\n", forms), "a.csv:1: column b: a number is missing");
  EXPECT_REFUSED(table_of("1,1.2.3\n", forms), "\"1.2.3\" is not a number");
  EXPECT_EQ(table_of("a,b,1,2\n1,2,3,4\n", forms).columns.back(), "2") << "of no form";
  EXPECT_REFUSED(table_of("1,2,3,4\n", forms),
                 "a.csv:1: the first line must be a header of names; it has 4 numbers, and a row "
                 "without a header has one of 2 (a, b), 3 (x, y, z)");
  EXPECT_REFUSED(table_of("1\n", {{{"a", "b"}}, {}}), "this row has 1 items; rows have 2 (a, b)");
}

TEST(CsvRows, LinesMayEndInCrAlone) {
  EXPECT_EQ(table_of("x,y\r1,2\r\r3,4").rows, (Rows{{1, 2}, {3, 4}}));
  EXPECT_EQ(table_of("x,y\r1,2\r\r3,4").lines, (std::vector<int>{2, 4}));
  EXPECT_EQ(table_of("x,y\r\r\n1,2\r\r\n").rows, (Rows{{1, 2}}));
}

TEST(CsvRows, ARowWithAnotherSeparatorGetsAHint) {
  EXPECT_REFUSED(table_of("x,y,z\n1;2;3\n"),
                 "a.csv:2: this row has 1 items; the header has 3; write the same separator in");
  EXPECT_REFUSED(table_of("x;y\n1\t2\n"), "write the same separator in all lines");
}

TEST(CsvRows, ABadRowLeavesTheNextOneAsItIs) {
  const std::string path = "a.csv";
  CsvLines lines("t;x\n1.5;?\n1,5;2,5\n", path);
  CsvRows rows(lines, path);
  std::vector<double> row;
  EXPECT_REFUSED(rows.next(row), "is not a number");
  EXPECT_TRUE(rows.next(row)) << "the decimal points of a bad row do not count";
  EXPECT_EQ(row, (std::vector<double>{1.5, 2.5}));
}

/// Any dialect of a random table gives the same numbers.
TEST(CsvRows, EveryDialectGivesTheSameNumbers) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const int columns = random.integer(2, 6);
    const char* const separators[] = {",", ";", "\t", " ", " , ", " ; ", "   "};
    const std::string separator = separators[random.integer(0, 6)];
    const bool comma = separator.find(',') == std::string::npos && random.integer(0, 1) == 0;
    const char* const ends[] = {"\n", "\r\n", "\r", "\n\n"};
    const std::string end = ends[random.integer(0, 3)];
    const bool quoted = random.integer(0, 2) == 0;
    const auto item = [&](std::string text) {
      if (comma) std::replace(text.begin(), text.end(), '.', ',');
      return quoted ? "\"" + text + "\"" : text;
    };
    std::string text = random.integer(0, 1) == 0 ? "\xef\xbb\xbf" : "";
    if (random.integer(0, 1) == 0) text += "# made by a test" + end;
    for (int c = 0; c < columns; ++c) text += (c == 0 ? "" : separator) + ("c" + std::to_string(c));
    Rows rows;
    for (int r = random.integer(1, 5); r > 0; --r) {
      text += end;
      rows.emplace_back();
      for (int c = 0; c < columns; ++c) {
        rows.back().push_back(random.integer(-99'999, 99'999) / 1e3 + 0.5);
        const bool plus = rows.back().back() > 0 && random.integer(0, 3) == 0;
        text += (c == 0 ? "" : separator) + item((plus ? "+" : "") + exact(rows.back().back()));
      }
    }
    ASSERT_EQ(table_of(text).rows, rows) << text;
  }
}

TEST(PositionsOf, CaseCountsOnlyBetweenNamesThatDifferInIt) {
  using Positions = std::vector<std::size_t>;
  EXPECT_EQ(positions_of({"Y", "x"}, {"x", "y"}), (Positions{1, 0}));
  EXPECT_EQ(positions_of({"A", "a"}, {"a", "A"}), (Positions{1, 0}));
  EXPECT_FALSE(positions_of({"x", "X"}, {"x", "y"}));
  EXPECT_FALSE(positions_of({"x"}, {"x", "y"}));
  EXPECT_FALSE(positions_of({"AB", "Ab"}, {"ab", "aB"})) << "either";
}

}  // namespace
}  // namespace beeline::internal
