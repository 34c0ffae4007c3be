#include <gtest/gtest.h>

#include <beeline/internal/utf8.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/io/text/urdf.h>
#include <beeline/model/catalog.h>

#include <tests/io/text/limits_samples.h>
#include <tests/io/text/urdf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

/// ASCII text in an encoding with units of several bytes.
std::string widened(const std::string& text, std::size_t bytes, bool big_end) {
  std::string wide;
  for (const char c : text) {
    std::string unit(bytes, '\0');
    unit[big_end ? bytes - 1 : 0] = c;
    wide += unit;
  }
  return wide;
}

struct Encoded {
  std::string bytes, name;
};

std::vector<Encoded> in_other_encodings(const std::string& text) {
  using namespace std::string_literals;
  return {{"\xff\xfe"s + widened(text, 2, false), "UTF-16"},
          {"\xfe\xff"s + widened(text, 2, true), "UTF-16"},
          {widened(text, 2, false), "UTF-16"},
          {widened(text, 2, true), "UTF-16"},
          {"\xff\xfe\0\0"s + widened(text, 4, false), "UTF-32"},
          {"\0\0\xfe\xff"s + widened(text, 4, true), "UTF-32"},
          {widened(text, 4, false), "UTF-32"},
          {widened(text, 4, true), "UTF-32"}};
}

struct Format {
  std::string ending, text;
  void (*read)(std::string_view text, const std::string& path);
};

const std::string mark = "\xef\xbb\xbf";
const std::string pointer =
    "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";

std::vector<Format> formats() {
  return {
      {"urdf", testing::whole_urdf,
       [](std::string_view text, const std::string& path) {
         arm_from_urdf(text, path, {.tip = "left"});
       }},
      {"srdf", testing::whole_srdf,
       [](std::string_view text, const std::string& path) { srdf_from_text(text, path); }},
      {"json", arm_to_json(built_in("panda")),
       [](std::string_view text, const std::string& path) { arm_from_json(text, path); }},
      {"csv", "x,y,theta\n1,2,3\n",
       [](std::string_view text, const std::string& path) { poses_from_csv(text, path); }},
      {"csv", "motion,x,y,theta\nline,1,2,3\n",
       [](std::string_view text, const std::string& path) { program_rows_from_csv(text, path); }},
      {"yaml", testing::panda_limits,
       [](std::string_view text, const std::string& path) {
         joint_limits_from_text(text, path, built_in("panda"));
       }},
      {"", R"({"joint1": {"velocity": 1}})",
       [](std::string_view text, const std::string& path) {
         joint_limits_from_text(text, path, built_in("panda"));
       }},
  };
}

TEST(TextEncoding, EveryReaderAcceptsAByteOrderMark) {
  for (const Format& format : formats()) {
    const std::string path = "a." + format.ending;
    EXPECT_NO_THROW(format.read(format.text, path)) << path;
    EXPECT_NO_THROW(format.read(mark + format.text, path)) << path;
  }
}

TEST(TextEncoding, EveryReaderNamesAnotherEncoding) {
  for (const Format& format : formats()) {
    const std::string path = "a." + format.ending;
    for (const Encoded& encoded : in_other_encodings(format.text)) {
      EXPECT_REFUSED(format.read(encoded.bytes, path),
                     path + ": is " + encoded.name + "; save it as UTF-8");
    }
  }
}

TEST(TextEncoding, EveryReaderNamesAPointerOfGitLfs) {
  for (const Format& format : formats()) {
    const std::string path = "a." + format.ending;
    EXPECT_REFUSED(format.read(pointer, path), path + ": is a pointer of Git LFS");
    EXPECT_REFUSED(format.read(pointer, path), "git lfs pull");
  }
}

TEST(TextEncoding, EveryReaderNamesAByteOfZero) {
  for (const Format& format : formats()) {
    const std::string path = "a." + format.ending;
    EXPECT_REFUSED(format.read(std::string(100, '\0'), path), path + ":1: has a byte of 0");
    for (std::size_t i = 0; i <= format.text.size(); i += 7) {
      std::string text = format.text;
      text.insert(i, 1, '\0');
      if (i > 1) EXPECT_REFUSED(format.read(text, path), "has a byte of 0");
    }
  }
}

TEST(TextEncoding, Latin1IsNamedWhereItMatters) {
  EXPECT_REFUSED(
      arm_from_json("{\"name\":\n\"gr\xf6\xdf"
                    "e\"}",
                    "a.json"),
      "a.json:2: is not UTF-8 text (byte 0xf6), perhaps Latin-1; save the file as UTF-8");
  EXPECT_REFUSED(poses_from_csv("# \xb0\nx,y,gr\xf6\xdf"
                                "e\n1,2,3\n",
                                "a.csv"),
                 "a.csv:2: the header is not UTF-8 text (byte 0xf6), perhaps Latin-1");
  EXPECT_REFUSED(joint_limits_from_text("joint_limits:\n  j\xf6int1:\n    max_velocity: 1\n",
                                        "a.yaml", built_in("panda")),
                 "a.yaml:2: the key \"j?int1\" is not UTF-8 text (byte 0xf6)");
  EXPECT_EQ(poses_from_csv("# 90 \xb0\nx,y,theta\n1,2,3\n", "a.csv").poses.size(), 1u);
  EXPECT_EQ(joint_limits_from_text("# Gr\xf6\xdf"
                                   "e\n" +
                                       std::string(testing::panda_limits),
                                   "a.yaml", built_in("panda"))
                .joints.size(),
            3u);
}

TEST(TextEncoding, FilesThatAreReadInBlocksBeginAlike) {
  const testing::TemporaryFolder folder;
  const auto begin = [&](const std::string& bytes) {
    InputFile file(folder.write("a", bytes));
    internal::begin_text(file);
    std::string text(64, '\0');
    text.resize(file.read(text.data(), text.size()));
    return text;
  };
  for (const std::string text : {"", "t", "t,joint1\n0,1\n"}) {
    EXPECT_EQ(begin(text), text);
    EXPECT_EQ(begin(mark + text), text);
  }
  EXPECT_REFUSED(begin(pointer), "git lfs pull");
  for (const Encoded& encoded : in_other_encodings("t,joint1\n0,1\n")) {
    EXPECT_REFUSED(begin(encoded.bytes), "is " + encoded.name + "; save it as UTF-8");
  }
}

TEST(TextEncoding, EveryByteOfLatin1BecomesOneCharacter) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  const std::string text = internal::utf8_of_latin1(bytes);
  EXPECT_TRUE(internal::is_utf8(text));
  EXPECT_EQ(text.size(), 128u + 2 * 128u);
  EXPECT_EQ(internal::utf8_of_latin1("\xe4\xf6\xfc"), "\u00e4\u00f6\u00fc");
}

TEST(TextEncoding, FormatsAreRecognisedBehindAMark) {
  EXPECT_EQ(internal::first_character(mark + " \n{"), '{');
  EXPECT_EQ(internal::first_character("<robot>"), '<');
  EXPECT_EQ(internal::first_character(mark), '\0');
  EXPECT_EQ(internal::first_character(" \n"), '\0');
}

}  // namespace
}  // namespace beeline
