#include <gtest/gtest.h>

#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/numbers.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using Rows = std::vector<std::vector<double>>;

TEST(Csv, RowsKeepTheirLines) {
  const CsvTable table = parse_csv("# a comment\nx, y\n1,2\n\n  # another\n3 , -4e-1\n", "a.csv");
  EXPECT_EQ(table.path, "a.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(table.rows, (Rows{{1, 2}, {3, -0.4}}));
  EXPECT_EQ(table.lines, (std::vector<int>{3, 6}));
}

TEST(Csv, OtherProgramsHabitsAreUnderstood) {
  const Rows rows{{1, 2}};
  for (const char* text : {"x,y\r\n1,2\r\n", "\xef\xbb\xbfx,y\n1,2", "\"x\",\"y\"\n\"1\",\"2\"\n",
                           "x,y\n\t1 , 2 \n\n\n", " \"x\" , \"y\" \n1,2\n"}) {
    const CsvTable table = parse_csv(text, "a.csv");
    EXPECT_EQ(table.rows, rows) << text;
    EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"})) << text;
  }
}

TEST(Csv, AnyNameSurvivesItsQuotes) {
  for (const char* name : {"a", "a,b", "say \"hi\"", " blank ", "#1", "\"", "gr\xc3\xbc\xc3\x9f"}) {
    const CsvTable table = parse_csv("t," + csv_name(name) + "\n1,2\n", "a.csv");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"t", name}));
  }
  EXPECT_EQ(csv_name("joint1"), "joint1");
}

TEST(Csv, RandomTablesReadBackExactly) {
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
    EXPECT_EQ(parse_csv(text, "a.csv").rows, rows);
  }
}

TEST(Csv, MistakesAreNamedWithTheirLine) {
  EXPECT_REFUSED(parse_csv("", "a.csv"), "a.csv: is empty; it needs a header and rows");
  EXPECT_REFUSED(parse_csv("\n# only this\n", "a.csv"), "a.csv: is empty");
  EXPECT_REFUSED(parse_csv("x,y\n", "a.csv"), "a.csv: has a header but no rows");
  EXPECT_REFUSED(parse_csv("x,y\n1,2\n1\n", "a.csv"),
                 "a.csv:3: this row has 1 items; the header has 2");
  EXPECT_REFUSED(parse_csv("x,y\n1,2,3\n", "a.csv"), "a.csv:2: this row has 3 items");
  EXPECT_REFUSED(parse_csv("x,y\n1,two\n", "a.csv"), "a.csv:2: column y: \"two\" is not a number");
  EXPECT_REFUSED(parse_csv("x,y\n1,\n", "a.csv"), "a.csv:2: column y: a number is missing");
  EXPECT_REFUSED(parse_csv("x,y\n1,nan\n", "a.csv"), "a.csv:2: column y: \"nan\" must be finite");
  EXPECT_REFUSED(parse_csv("x,y\n\n1,inf\n", "a.csv"), "a.csv:3: column y: \"inf\" must be finite");
  EXPECT_REFUSED(parse_csv("x,x\n1,2\n", "a.csv"), "a.csv:1: column \"x\" is given twice");
  EXPECT_REFUSED(parse_csv("x,,y\n1,2,3\n", "a.csv"), "a.csv:1: the name of column 2 is empty");
  EXPECT_REFUSED(parse_csv("1,2\n3,4\n", "a.csv"), "a.csv:1: the first line must be a header");
  EXPECT_REFUSED(parse_csv("\"x,y\n1,2\n", "a.csv"), "a.csv:1: a quotation mark is not closed");
  EXPECT_REFUSED(parse_csv("\"x\"y\n1\n", "a.csv"), "a.csv:1: \"y\" follows a closing");
  EXPECT_REFUSED(parse_csv(std::string("x\n1\0\n", 5), "a.csv"), "is not a number");
}

TEST(Csv, SemicolonsSeparateWhereTheFirstLineHasNoComma) {
  const CsvTable table = parse_csv("x;\"y,;\"\n1;2\n", "a.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y,;"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<double>>{{1, 2}}));
  EXPECT_EQ(csv_separator("a,b;c"), ',');
  EXPECT_EQ(csv_separator("a"), ',');
  EXPECT_EQ(csv_name("a;b"), "\"a;b\"");
  EXPECT_EQ(parse_csv("a;b,c\n1,2\n", "a.csv").columns.front(), "a;b");
}

TEST(Csv, TabsAndBlanksSeparateToo) {
  const Rows rows{{1, -2.5}, {3, 4}};
  for (const char* text : {"x y\n1 -2.5\n3 4\n", "x   y\n 1  -2,5\n3\t4\n", "x\ty\n1\t-2,5\n3\t4\n",
                           "x\ty\n 1 \t -2.5\n3\t4\n", "\"x\" \"y\"\n\"1\" \"-2.5\"\n3 4\n"}) {
    const CsvTable table = parse_csv(text, "a.csv");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"})) << text;
    EXPECT_EQ(table.rows, rows) << text;
  }
  EXPECT_EQ(parse_csv("joint 1\tjoint 2\n1\t2\n", "a.csv").columns.front(), "joint 1");
  EXPECT_EQ(csv_separator("1,5 2"), ' ');
  EXPECT_EQ(csv_separator("1, 5, 2"), ',');
  EXPECT_EQ(csv_separator("1,5;2"), ';');
  EXPECT_EQ(csv_separator("1,2,3"), ',');
  EXPECT_EQ(csv_name("a b"), "\"a b\"");
  EXPECT_EQ(parse_csv(csv_name("a b") + "\n1\n", "a.csv").columns, std::vector<std::string>{"a b"});
  EXPECT_REFUSED(parse_csv("x\ty\n1\t\t2\n", "a.csv"), "a.csv:2: ");
}

TEST(Csv, DifferencesFromTheFirstRowAreExact) {
  const std::string path = "a.csv";
  CsvLines lines("t,x\n1700000000123456789,1\n\"1700000000123456790\",2\n1.5,3\n", path);
  CsvRows rows(lines, path);
  rows.count_from_first(0);
  std::vector<double> row, differences;
  while (rows.next(row)) differences.push_back(rows.from_first());
  EXPECT_EQ(differences, (std::vector<double>{0, 1, 1.5 - 1700000000123456789.0}));
}

TEST(Csv, EndlessTablesAreRefused) {
  std::string many = "c0";
  for (int i = 1; i <= 100'000; ++i) many += ",c" + std::to_string(i);
  EXPECT_REFUSED(parse_csv(many + "\n1\n", "a.csv"), "more than 100000 columns");
  std::string rows = "x\n";
  for (int i = 0; i <= 4'000'000; ++i) rows += "1\n";
  EXPECT_REFUSED(parse_csv(rows, "a.csv"), "more than 4000000 rows");
}

}  // namespace
}  // namespace beeline::internal
