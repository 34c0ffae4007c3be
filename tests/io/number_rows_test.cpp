#include <cmath>
#include <gtest/gtest.h>

#include <beeline/io/number_rows.h>
#include <beeline/io/text/internal/npy.h>

#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::Random;
using testing::TemporaryFolder;

const RowForms ab{{"a", "b"}};

/// All rows, each a column, read in blocks of `most`.
Eigen::MatrixXd read_all(const std::string& path, const RowForms& forms, BadRows& bad,
                         Eigen::Index most = 3) {
  RowReader reader(path, forms);
  RowBlock block;
  block.numbers.resize(static_cast<Eigen::Index>(forms[reader.form()].size()), most);
  Eigen::MatrixXd all(block.numbers.rows(), 0);
  for (;;) {
    reader.read(block, bad);
    if (block.count() == 0) return all;
    all.conservativeResize(Eigen::NoChange, all.cols() + block.count());
    all.rightCols(block.count()) = block.numbers.leftCols(block.count());
  }
}

struct Sample {
  TemporaryFolder folder;
  BadRows bad;

  Eigen::MatrixXd parse(const std::string& text, const RowForms& forms = ab) {
    return read_all(folder.write("a.csv", text), forms, bad);
  }
};

TEST(NumberRows, AnyNumbersReadBackToTheLastBit) {
  Random random;
  const TemporaryFolder folder;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Index width = random.integer(1, 5);
    const Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(
        width, i == 0 ? 50'000 : random.integer(0, 50),
        [&] { return random.uniform(-10, 10) * std::pow(10, random.integer(-300, 300)); });
    std::vector<std::string> names{"a", "b,c", "d \"e\"", "#f", "g"};
    names.resize(static_cast<std::size_t>(width));
    for (const char* name : {"a.csv", "a.npy"}) {
      RowWriter writer(folder.file(name), names, false, 1 + i % 3);
      writer.write(rows);
      writer.commit();
      BadRows bad;
      ASSERT_EQ(read_all(folder.file(name), {names}, bad, random.integer(1, 60)), rows) << name;
    }
  }
}

TEST(NumberRows, TheTextIsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const Eigen::MatrixXd rows = Eigen::MatrixXd::Random(2, 20'000);
  for (const int threads : {1, 2, 7}) {
    RowWriter writer(folder.file(std::to_string(threads) + ".csv"), ab[0], false, threads);
    writer.write(rows);
    writer.commit();
  }
  EXPECT_EQ(folder.content("1.csv"), folder.content("2.csv"));
  EXPECT_EQ(folder.content("1.csv"), folder.content("7.csv"));
}

TEST(NumberRows, ColumnsGoByTheirNamesAndTheHeaderMayBeLeftOut) {
  Sample sample;
  const Eigen::Matrix2d both{{1, 3}, {2, 4}};  // a row in each column
  EXPECT_EQ(sample.parse("a,b\n1,2\n3,4\n"), both);
  EXPECT_EQ(sample.parse("b,a\n2,1\n4,3"), both);
  EXPECT_EQ(sample.parse("1,2\n3,4\n"), both);
  EXPECT_EQ(sample.parse("\xef\xbb\xbf# by hand\r\n\r\n \"b\" , a\r\n +2, \"1\" \r\n\n#\n4e0\t,3"),
            both);
  EXPECT_EQ(sample.parse("1,2\n3,4\n", {{"1", "2"}}), Eigen::Vector2d(3, 4));
  EXPECT_EQ(sample.parse("a,b\n").cols(), 0);
}

TEST(NumberRows, TheHeaderOrTheCountSelectsTheForm) {
  Sample sample;
  const RowForms forms{{"a", "b"}, {"x", "y", "z"}};
  EXPECT_EQ(sample.parse("1,2,3\n", forms), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(sample.parse("z,y,x\n1,2,3\n", forms), Eigen::Vector3d(3, 2, 1));
  EXPECT_REFUSED(sample.parse("1,2,3,4\n", forms),
                 "a.csv:1: the first line must be a header of names; it has 4 numbers, and a row "
                 "without a header has one of 2 (a, b), 3 (x, y, z)");
  EXPECT_REFUSED(sample.parse("# a\nx,y\n1,2\n", forms),
                 "a.csv:2: the header has the columns x, y; rows are a, b or x, y, z");
}

TEST(NumberRows, DialectsAreThoseOfPoses) {
  Sample sample;
  const Eigen::Matrix2d both{{1.5, 3}, {2, 4}};
  for (const char* text :
       {"A,B\n1.5,2\n3,4\n", "B;A\n2;1,5\n4;3\n", "a b\n1.5   2\n3 4\n", "a\tb\n1,5\t2\n3\t4\n",
        "# b a\n2 1.5\n4 3\n", "1,5;2\n3;4\n", "a,b\r1.5,2\r3,4\r"}) {
    EXPECT_EQ(sample.parse(text), both) << text;
  }
  EXPECT_REFUSED(sample.parse("a;b\n1,5;2.5\n"), "a.csv:2: row 1: this row has decimal commas");
  EXPECT_EQ(sample.parse("a,A\n1,2\n", {{"A", "a"}}), Eigen::Vector2d(2, 1));
}

TEST(NumberRows, ABadRowIsNamedByLineAndRow) {
  Sample sample;
  const std::string start = "a,b\n1,2\n# remark\n\n";
  EXPECT_REFUSED(sample.parse(start + "3\n"),
                 "a.csv:5: row 2: this row has 1 items; the header has 2");
  EXPECT_REFUSED(sample.parse(start + "3,4,5\n"), "a.csv:5: row 2: this row has 3 items");
  EXPECT_REFUSED(sample.parse(start + "3,\n"), "a.csv:5: row 2: column b: a number is missing");
  EXPECT_REFUSED(sample.parse(start + "x,4\n"), "a.csv:5: row 2: column a: \"x\" is not a number");
  EXPECT_REFUSED(sample.parse(start + "3,nan\n"), "column b: \"nan\" must be finite");
  EXPECT_REFUSED(sample.parse(start + "-inf,3\n"), "column a: \"-inf\" must be finite");
  EXPECT_REFUSED(sample.parse(start + "1e999,3\n"), "out of the range");
  EXPECT_REFUSED(sample.parse(start + "1;2\n"),
                 "row 2: this row has 1 items; the header has 2; write the same separator in");
  EXPECT_REFUSED(sample.parse(start + "\"1,2\n"), "row 2: a quotation mark is not closed");
  EXPECT_REFUSED(sample.parse("x,2\n3,4\n"), "a.csv:1: row 1: column a: \"x\" is not a number");
  EXPECT_REFUSED(sample.parse("nan,2\n"), "row 1: column a: \"nan\" must be finite");
  EXPECT_REFUSED(sample.parse(""), "a.csv: is empty");
}

TEST(NumberRows, BadRowsAreLeftOutAndCounted) {
  Sample sample;
  sample.bad.skip = true;
  const Eigen::MatrixXd rows = sample.parse("x,1\n1,2\n3\n\n4,nan\n5,6\n7,8\n9,\n,\n");
  EXPECT_EQ(rows, (Eigen::MatrixXd(2, 3) << 1, 5, 7, 2, 6, 8).finished());
  EXPECT_EQ(sample.bad.count, 4);
  EXPECT_EQ(sample.parse("1\n5,6\n").cols(), 1) << "a bad row in the place of a header";
  EXPECT_NE(sample.bad.first.find("a.csv:1: row 1: column a"), std::string::npos);
}

TEST(NumberRows, BadRowsOfNpyToo) {
  const TemporaryFolder folder;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Random(2, 9);
  for (const int k : {0, 3, 4, 5}) rows(k % 2, k) = k == 3 ? INFINITY : NAN;
  internal::NpyWriter writer(folder.file("a.npy"), 2, false);
  writer.write(rows);
  writer.commit();
  BadRows bad;
  EXPECT_REFUSED(read_all(folder.file("a.npy"), ab, bad),
                 "a.npy: row 1: column a is nan; it must be finite");
  bad.skip = true;
  const Eigen::MatrixXd kept = read_all(folder.file("a.npy"), ab, bad);
  EXPECT_EQ(kept, rows(Eigen::seqN(0, rows.rows()), std::vector<int>{1, 2, 6, 7, 8}));
  EXPECT_EQ(bad.count, 4);
}

TEST(NumberRows, RowsOfAnotherLengthAreRefused) {
  const TemporaryFolder folder;
  internal::NpyWriter writer(folder.file("a.npy"), 1, false);
  writer.write(Eigen::MatrixXd::Zero(1, 2));
  writer.commit();
  BadRows bad;
  EXPECT_REFUSED(read_all(folder.file("a.npy"), ab, bad),
                 "a.npy: has rows of 1 number; rows are a, b: one row is array.reshape(1, -1)");
}

TEST(NumberRows, ATransposedTableIsRefused) {
  const TemporaryFolder folder;
  internal::NpyWriter writer(folder.file("a.npy"), 5, false);
  writer.write(Eigen::MatrixXd::Zero(5, 2));
  writer.commit();
  BadRows bad;
  EXPECT_REFUSED(read_all(folder.file("a.npy"), ab, bad),
                 "a.npy: has rows of 5 numbers; rows are a, b; if each column is a row, write "
                 "array.T");
}

TEST(NumberRows, ALineWithoutEndIsRefused) {
  Sample sample;
  EXPECT_REFUSED(sample.parse("a,b\n1,2\n" + std::string(3 << 20, '1')),
                 "a.csv: line 3 is longer than 10");
}

TEST(NumberRows, LinesAcrossTheEndOfTheBufferAreWhole) {
  Sample sample;
  std::string text = "a,b\n";
  for (int i = 0; i < 300'000; ++i) text += std::to_string(i) + "," + std::to_string(-i) + "\n";
  const TemporaryFolder folder;
  BadRows bad;
  const Eigen::MatrixXd rows = read_all(folder.write("a.csv", text), ab, bad, 300'000);
  ASSERT_EQ(rows.cols(), 300'000);
  for (int i = 0; i < 300'000; ++i) ASSERT_EQ(rows.col(i), Eigen::Vector2d(i, -i));
}

TEST(NumberRows, FormatsGoByTheEnding) {
  EXPECT_EQ(row_format("x/A.NPY"), RowFormat::npy);
  EXPECT_EQ(row_format("-"), RowFormat::csv);
  EXPECT_REFUSED(row_format("a.txt"), ".csv or .npy files, not \"a.txt\"");
  EXPECT_REFUSED(RowWriter("a.csv", ab[0], true, 1), "32-bit numbers are for .npy");
}

}  // namespace
}  // namespace beeline
