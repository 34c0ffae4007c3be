#include <cstring>
#include <gtest/gtest.h>

#include <beeline/io/text/internal/npy.h>

#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::TemporaryFolder;

/// A file with this dictionary, in this version of the format.
std::string file_of(const std::string& dictionary, const std::string& data, int version = 1) {
  std::string text = "\x93NUMPY";
  text += static_cast<char>(version);
  text += '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) {
    text += static_cast<char>(dictionary.size() >> (8 * i) & 0xff);
  }
  return text + dictionary + data;
}

std::string bytes_of(const std::vector<double>& numbers) {
  const auto* first = reinterpret_cast<const char*>(numbers.data());
  return numbers.empty() ? std::string() : std::string(first, 8 * numbers.size());
}

/// All rows of a file, read in blocks of `most`.
Eigen::MatrixXd read_all(const std::string& path, Eigen::Index most = 3) {
  NpyReader reader(path);
  Eigen::MatrixXd block(reader.header().width, most), all(reader.header().width, 0);
  while (const Eigen::Index count = reader.read(block)) {
    all.conservativeResize(Eigen::NoChange, all.cols() + count);
    all.rightCols(count) = block.leftCols(count);
  }
  return all;
}

TEST(Npy, ReadsBackWhatWasWritten) {
  Random random;
  const TemporaryFolder folder;
  for (int i = 0; i < 100; ++i) {
    const bool single = i % 2 == 0;
    Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(random.integer(1, 8), random.integer(0, 20),
                                                        [&] { return random.uniform(-1e3, 1e3); });
    if (single) rows = rows.cast<float>().cast<double>();
    NpyWriter writer(folder.file("a.npy"), rows.rows(), single);
    const Eigen::Index half = rows.cols() / 2;
    writer.write(rows.leftCols(half));
    writer.write(rows.rightCols(rows.cols() - half));
    writer.commit();
    ASSERT_EQ(read_all(folder.file("a.npy"), random.integer(1, 25)), rows) << i;
    ASSERT_EQ(folder.content("a.npy").size(), 128 + (single ? 4U : 8U) * rows.size());
  }
}

TEST(Npy, NothingIsWrittenBeforeCommit) {
  const TemporaryFolder folder;
  {
    NpyWriter writer(folder.file("a.npy"), 2, false);
    writer.write(Eigen::MatrixXd::Zero(2, 1000));
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.npy")));
  }
  EXPECT_EQ(folder.count(), 0U);
}

TEST(Npy, TheFrontIsAsLongForAnyNumberOfRows) {
  for (const std::int64_t rows : {std::int64_t{0}, std::int64_t{7}, std::int64_t{1} << 48}) {
    const std::string front = npy_front({true, rows, 600'000});
    EXPECT_EQ(front.size(), 128U);
    const NpyHeader header = parse_npy_header(front.substr(10));
    EXPECT_TRUE(header.single);
    EXPECT_EQ(header.rows, rows);
    EXPECT_EQ(header.width, 600'000);
  }
}

TEST(Npy, HeadersOfSeveralWritersAreRead) {
  const auto shape = [](const std::string& dictionary) {
    const NpyHeader header = parse_npy_header(dictionary);
    return std::pair<std::int64_t, std::int64_t>(header.rows, header.width);
  };
  using Shape = std::pair<std::int64_t, std::int64_t>;
  EXPECT_EQ(shape("{'descr':'<f8','fortran_order':False,'shape':(3,2)}"), Shape(3, 2));
  EXPECT_EQ(
      shape("  {\"shape\" : ( 3L , 2L , ) ,\n \"fortran_order\": False, \"descr\": \"<f4\", } "),
      Shape(3, 2));
  EXPECT_EQ(shape("{'descr': '<f8', 'fortran_order': False, 'shape': (5,), }"), Shape(5, 1));
  EXPECT_EQ(shape("{'descr': '<f8', 'fortran_order': False, 'shape': (5, 4, 4), }"), Shape(5, 16));
  EXPECT_EQ(shape("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 7), }"), Shape(0, 7));
  EXPECT_EQ(shape("{'descr': '<f8', 'fortran_order': True, 'shape': (1, 7), }"), Shape(1, 7));
  EXPECT_EQ(shape("{'descr': '<f8', 'fortran_order': True, 'shape': (7, 1), }"), Shape(7, 1));
  EXPECT_EQ(shape("{'descr': '<f8', 'fortran_order': True, 'shape': (7,), }"), Shape(7, 1));
}

TEST(Npy, OtherArraysAreRefused) {
  const auto header = [](const std::string& type, const std::string& order,
                         const std::string& shape) {
    return "{'descr': " + type + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }";
  };
  const auto parse = [](const std::string& dictionary) { return parse_npy_header(dictionary); };
  EXPECT_REFUSED(parse(header("'>f8'", "False", "(3, 2)")), "\">f8\"; it needs '<f8' or '<f4'");
  EXPECT_REFUSED(parse(header("'<i8'", "False", "(3, 2)")), "array.astype('<f8')");
  EXPECT_REFUSED(parse(header("'|O'", "False", "(3, 2)")), "|O");
  EXPECT_REFUSED(parse(header("[('x', '<f8')]", "False", "(3,)")), "records");
  EXPECT_REFUSED(parse(header("'<f8'", "True", "(3, 2)")), "(3, 2) is in column-major order");
  EXPECT_REFUSED(parse(header("'<f8'", "Maybe", "(3, 2)")), "lacks \"False\"");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "()")), "a single number");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "(-1, 7)")), "whole numbers");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "(3.5, 7)")), "lacks \")\" before \".5");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "(99999999999999999999, 7)")), "too large");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "(2, 1000000000000, 1000000000000)")), "too large");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "(3, 2")), "whole numbers");
  EXPECT_REFUSED(parse("{'descr': '<f8', 'fortran_order': False}"), "needs descr, fortran_order");
  EXPECT_REFUSED(parse("{'descr': '<f8', 'descr': '<f8'}"), "twice");
  EXPECT_REFUSED(parse("{'colour': 'red'}"), "unknown key \"colour\"");
  EXPECT_REFUSED(parse(header("'<f8'", "False", "(3, 2)") + "x"),
                 "has text after its end before \"x\"");
  EXPECT_REFUSED(parse("{'descr"), "unclosed");
  EXPECT_REFUSED(parse(""), "lacks \"{\"");
}

TEST(Npy, VersionsOneToThreeAreRead) {
  const TemporaryFolder folder;
  const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }\n";
  for (const int version : {1, 2, 3}) {
    folder.write("a.npy", file_of(dictionary, bytes_of({1, 2}), version));
    EXPECT_EQ(read_all(folder.file("a.npy")), Eigen::Vector2d(1, 2)) << version;
  }
  folder.write("a.npy", file_of(dictionary, bytes_of({1, 2}), 4));
  EXPECT_REFUSED(NpyReader(folder.file("a.npy")), "version 4");
}

TEST(Npy, AFileOfAnotherSizeThanItSaysIsRefusedWithBothNumbers) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& shape, std::size_t numbers, const std::string& more) {
    const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape;
    folder.write("a.npy", file_of(dictionary + "}", bytes_of(std::vector<double>(numbers)) + more));
    return testing::refusal([&] { NpyReader reader(folder.file("a.npy")); });
  };
  EXPECT_NE(refused("(10, 7)", 69, "").find("declares 10 rows of 7 numbers and has 9"),
            std::string::npos);
  EXPECT_NE(refused("(281474976710656, 281474976710656)", 0, "").find("and has 0"),
            std::string::npos);
  EXPECT_NE(refused("(10, 7)", 70, "abc").find("3 bytes after its 10 rows"), std::string::npos);
  EXPECT_NE(refused("(10, 0)", 1, "").find("8 bytes after"), std::string::npos);
  EXPECT_EQ(refused("(10, 7)", 70, ""), "accepted");
}

TEST(Npy, AFileCutOffAnywhereIsRefused) {
  const TemporaryFolder folder;
  const std::string whole = npy_front({false, 2, 3}) + bytes_of({1, 2, 3, 4, 5, 6});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    folder.write("a.npy", whole.substr(0, size));
    ASSERT_NE(testing::refusal([&] { read_all(folder.file("a.npy")); }), "accepted") << size;
  }
}

TEST(Npy, AChangedFileIsReadOrRefused) {
  Random random;
  const TemporaryFolder folder;
  const std::string whole = npy_front({false, 2, 3}) + bytes_of({1, 2, 3, 4, 5, 6});
  for (int i = 0; i < 5000; ++i) {
    std::string changed = whole;
    for (int k = random.integer(1, 4); k > 0; --k) {
      changed[random.integer(0, 90)] = static_cast<char>(random.integer(0, 255));
    }
    folder.write("a.npy", changed);
    testing::refusal([&] { read_all(folder.file("a.npy")); });
  }
}

TEST(Npy, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_REFUSED(NpyReader(folder.file("none.npy")), "none.npy: cannot be read: No such file");
  EXPECT_REFUSED(NpyReader(folder.write("a.npy", "PK\x03\x04 an archive")), "is not an .npy file");
  EXPECT_REFUSED(NpyReader(folder.write(
                     "a.npy", file_of("", "", 2).substr(0, 8) + "\xff\xff\xff\x7f{'descr'")),
                 "a header of 2147483647 bytes");
  EXPECT_REFUSED(NpyWriter("/dev/null", 2, false), "a pipe or a device");
  EXPECT_REFUSED(NpyWriter(folder.file("no/a.npy"), 2, false), "cannot be written");
  NpyWriter writer(folder.file("a.npy"), 2, true);
  EXPECT_REFUSED(writer.write(Eigen::Vector2d(0, 1e300)), "too large for 32 bits");
  EXPECT_REFUSED(writer.write(Eigen::Vector3d(0, 1, 2)), "rows of 2 numbers");
}

}  // namespace
}  // namespace beeline::internal
