#include <cmath>
#include <gtest/gtest.h>

#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/numbers.h>

#include <tests/io/text/internal/csv_table.h>
#include <tests/random.h>
#include <tests/refusal.h>

// What Markdown, MATLAB, Excel and other programs have in a table besides its numbers.

namespace beeline::internal {
namespace {

using testing::Names;
using testing::Random;
using testing::Rows;
using testing::Table;
using testing::table_of;

/// How a program writes the lines of a table.
struct Habit {
  std::string begin, between, end;     ///< of a line of items
  std::string rule;                    ///< below the header
  std::vector<std::string> others;     ///< lines without data, anywhere below the header
  std::vector<std::string> last = {};  ///< lines without data at the end
};

const std::vector<Habit>& habits() {
  static const std::vector<Habit> all{
      {"| ", " | ", " |", "|---|:--:|--:|", {"+----+----+", "|---|---|"}},
      {"|", "|", "|", "|--|--|--|", {"", "# a | b"}},
      {"", " | ", "", "----+----+----", {}},
      {"", "|", "", "", {"// a remark"}, {"|||"}},
      {"  ", "   ", "", "=== === ===", {"% a remark", "# /a/remark"}},
      {"", " ", ";", "", {"% one", "//two"}},
      {"", "\t", ";", "", {"%"}},
      {"", ",", ";", "", {"// one, two"}, {",,,", ","}},
      {"", ", ", ",", "", {" "}, {", , ,"}},
      {"", ",", ",,,", "", {}, {";;", ",,,,,"}},
      {"", ";", ";", "", {"#;"}, {";;;"}},
      {"", ";", ";;", "", {}, {"; ;"}}};
  return all;
}

TEST(CsvHabits, RandomTablesReadBackExactly) {
  Random random;
  for (int i = 0; i < 100 * testing::cases(3); ++i) {
    const Habit& habit = habits()[static_cast<std::size_t>(i) % habits().size()];
    const auto line = [&](const Names& items, bool ends) {
      std::string text = habit.begin;
      for (std::size_t k = 0; k < items.size(); ++k)
        text += (k == 0 ? "" : habit.between) + items[k];
      return text + (ends ? habit.end : "") + '\n';
    };
    const auto other = [&] {
      const auto k = static_cast<std::size_t>(random.integer(0, 9));
      return k < habit.others.size() ? habit.others[k] + '\n' : std::string();
    };
    // All lines of a frame end in it; the ends of others may be missing.
    const auto ends = [&] { return habit.begin.starts_with('|') || random.integer(0, 3) > 0; };
    Names names;
    for (int c = random.integer(2, 6); c > 0; --c) names.push_back("c" + std::to_string(c));
    std::string text = random.integer(0, 1) ? "// a remark\n" : ";a remark\n";
    text += line(names, ends());
    if (!habit.rule.empty()) text += habit.rule + '\n';
    Rows rows;
    for (int r = random.integer(1, 5); r > 0; --r) {
      text += other();
      rows.emplace_back();
      Names items;
      for (std::size_t c = 0; c < names.size(); ++c) {
        rows.back().push_back(random.uniform(-1, 1) * std::pow(10, random.integer(-9, 9)));
        items.push_back(exact(rows.back().back()));
      }
      text += line(items, ends());
    }
    for (int k = random.integer(0, 3); k > 0; --k) {
      text += other();
      const auto l = static_cast<std::size_t>(random.integer(0, 2));
      if (l < habit.last.size()) text += habit.last[l] + '\n';
    }
    const Table table = table_of(text);
    EXPECT_EQ(table.columns, names) << text;
    EXPECT_EQ(table.rows, rows) << text;
  }
}

TEST(CsvHabits, ItemsThatAreMissingAreNotAnEnd) {
  EXPECT_REFUSED(table_of("x,y,z\n1,2,\n"), "a.csv:2: column z: a number is missing");
  EXPECT_REFUSED(table_of("x,y\n1,2,,3\n"), "a.csv:2: this row has 4 items; the header has 2");
  EXPECT_REFUSED(table_of("x,y,\n1,2,3\n"), "a.csv:2: this row has 3 items; the header has 2");
  EXPECT_REFUSED(table_of("x;y\n;2\n"), "a.csv:2: column x: a number is missing");
  EXPECT_REFUSED(table_of("x|y\n-|-\n"), "a.csv:2: column x: \"-\" is not a number");
  EXPECT_REFUSED(table_of(",x,y\n1,2,3\n"), "the name of column 1 is empty, as of an index");
}

TEST(CsvHabits, NamesLikeTheseSurviveTheirQuotes) {
  for (const char* name : {"a|b", "|a|", "//a", "---", "=+=", ";", "a;"}) {
    for (const std::string& text : {csv_name(name) + "\n1\n", csv_name(name) + ",t\n1,2\n",
                                    "t|" + csv_name(name) + "\n1|2\n"}) {
      const Names columns = table_of(text).columns;
      EXPECT_TRUE(columns.front() == name || columns.back() == name) << text;
    }
  }
}

TEST(CsvHabits, NumbersMayHaveTheMinusOfUnicode) {
  EXPECT_EQ(table_of("x,y\n\xe2\x88\x92"
                     "1.5,2\n")
                .rows,
            (Rows{{-1.5, 2}}));
  EXPECT_REFUSED(table_of("x,y\n1,\xc2\xa0"
                          "2\n"),
                 "it has a no-break space");
}

TEST(CsvHabits, RefusalsSayWhatToDo) {
  EXPECT_REFUSED(table_of("x,y\n1,2 # first\n"), "write a comment in a line of its own");
  EXPECT_REFUSED(table_of("x y\n1 2 // first\n"),
                 "this row has 4 items; the header has 2; write a");
  EXPECT_REFUSED(table_of("x,y\n1,#N/A\n"), "a.csv:2: column y: \"#N/A\" is not a number");
  for (const char* text :
       {"q = [\n1 2\n];\n", "[[1, 2],\n[3, 4]]\n", "{X 1,Y 2}\n", "[\n{\"x\": 1}]"}) {
    EXPECT_REFUSED(table_of(text), "write rows of numbers without brackets or words");
  }
  const CsvForms forms{{{"x", "y"}}, [](const Names& names) { return names == Names{"x", "y"}; }};
  EXPECT_REFUSED(table_of("Robot seven\nDate, place\n\nx,y\n1,2\n", forms),
                 "a.csv:1: this line is not the header, as line 4 is; begin the lines above");
  EXPECT_REFUSED(table_of("# time u v\n1 2 3\n", {{{"x"}, {"x", "y"}}, forms.accepts}),
                 "the comment \"time u v\" is none, as not all of its names are known");
}

/// The header is in a comment, in a sentence about its units or in none, before a row of numbers.
TEST(CsvHabits, CommentsOnColumnsAreHeadersOrRefused) {
  const auto known = [](const Names& names) {
    return names.size() == 2 && names[0] + names[1] != names[0] + names[0] &&
           (names[0] == "t" || names[0] == "q") && (names[1] == "t" || names[1] == "q");
  };
  const CsvForms forms{{{"t", "q"}}, known};
  for (const char* comment : {"%  q t in s", "% q [rad] t [s]", "// columns: q, t",
                              "# q in rad, t in s.", "%q | t", "# q t in ms"}) {
    const Table table = table_of(std::string(comment) + "\n1 2\n", forms);
    EXPECT_EQ(table.columns.front().front(), 'q') << comment;
    EXPECT_EQ(table.columns.back().front(), 't') << comment;
  }
  EXPECT_EQ(table_of("# t in s and then q in rad\n1 2\n", forms).columns.front(), "t [s]");
  EXPECT_REFUSED(
      table_of("# by hand\n# the angle q over the time t\n1 2\n", forms),
      "a.csv:2: rows without a header are read as t, q; the comment \"the angle q over the time "
      "t\" names them in another order");
  const CsvForms three{{{"x", "y", "z"}}, [](const Names& names) { return names.front() == "x"; }};
  for (const char* names : {"y x w", "time x y", "y [m], x [m], name", "y;x;q1"}) {
    EXPECT_REFUSED(table_of("# " + std::string(names) + "\n1 2 3\n", three),
                   "a.csv:1: rows without a header are read as x, y, z; the comment \"" +
                       std::string(names) + "\" names other columns; write a header");
  }
  for (const char* prose :
       {"some more words on x and y", "x and y", "measured x, y", "Y over X", "x, y and more"}) {
    EXPECT_EQ(table_of("# " + std::string(prose) + "\n1 2 3\n", three).rows, (Rows{{1, 2, 3}}))
        << prose;
  }
}

}  // namespace
}  // namespace beeline::internal
