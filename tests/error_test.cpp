#include <clocale>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/error.h>

namespace beeline {
namespace {

TEST(Error, IsOneLineForAnyQuotedText) {
  const std::string hostile = "a\nb\rc\td\x1b[2Je\x7f";
  EXPECT_STREQ(Error(hostile).what(), "a b c d [2Je ");
  EXPECT_STREQ(FileError("dir\n/arm.urdf", 3, "no\nlink").what(), "dir /arm.urdf:3: no link");
  EXPECT_STREQ(unknown_name("link", "x\ny", {"base\n"}).what(),
               "unknown link \"x y\" (known: base )");
}

TEST(Error, IsShortAndUtf8ForAnyBytes) {
  EXPECT_STREQ(Error("a\xff\xc3|\xc3\xa9\xed\xa0\x80").what(), "a??|\xc3\xa9???");
  const std::string said = FileError("a.csv", 1, std::string(100'000, 'x')).what();
  EXPECT_LT(said.size(), 1000u);
  EXPECT_TRUE(said.ends_with("x..."));
}

TEST(Error, OfAnArgumentIsWordedForItsNameElsewhere) {
  const Error named("the ", "joint_map", " has 2 names");
  EXPECT_STREQ(named.what(), "the joint_map has 2 names");
  EXPECT_EQ(named.argument(), "joint_map");
  EXPECT_EQ(named.message_for("--joint-map"), "the --joint-map has 2 names");
  const Error behind = named.behind("a\n.csv: ");
  EXPECT_STREQ(behind.what(), "a .csv: the joint_map has 2 names");
  EXPECT_EQ(behind.argument(), "joint_map");
  EXPECT_EQ(behind.message_for("-m"), "a .csv: the -m has 2 names");
  const Error other = Error::of("rate", "5 samples per second are too few");
  EXPECT_STREQ(other.what(), "5 samples per second are too few");
  EXPECT_EQ(other.argument(), "rate");
  EXPECT_EQ(other.message_for("--rate"), "--rate: 5 samples per second are too few");
  EXPECT_EQ(other.behind("a: ").message_for("--rate"),
            "--rate: a: 5 samples per second are too few");
  EXPECT_EQ(Error("bad").argument(), "");
  EXPECT_FALSE(Error("bad").behind("a: ").names_argument());
}

TEST(Error, OfAnArgumentInALongMessageIsWorded) {
  const Error cut(std::string(100'000, 'x'), "rate", " is bad");
  EXPECT_LT(cut.message_for("--rate").size(), 1000u);
}

// A name at the end of what a message keeps is replaced as a whole, or not at all.
TEST(Error, OfAnArgumentThatIsCutOffDoesNotNameIt) {
  int named = 0, cut = 0;
  for (std::size_t before = 880; before < 910; ++before) {
    const std::string text(before, 'x');
    const Error error(text, "rate", " is bad");
    const Error behind = Error("", "rate", " is bad").behind(text);
    for (const Error& each : {error, behind}) {
      const bool is_whole = std::string_view(each.what()).starts_with(text + "rate");
      EXPECT_EQ(each.names_argument(), is_whole) << before;
      ++(is_whole ? named : cut);
      const std::string begin = is_whole ? text + "--rate" : "--rate: xxx";
      EXPECT_TRUE(each.message_for("--rate").starts_with(begin)) << before;
    }
  }
  EXPECT_GT(named, 0);
  EXPECT_GT(cut, 0);
}

TEST(FileError, BeginsWithPathAndLineAsCompilersDo) {
  EXPECT_STREQ(FileError("a.urdf", 12, "bad").what(), "a.urdf:12: bad");
  EXPECT_STREQ(FileError("a.urdf", 0, "bad").what(), "a.urdf: bad");
  EXPECT_THROW(throw FileError("a", 1, "b"), Error);
}

TEST(FileError, HasPathLineAndFault) {
  const FileError error("dir: 1/a.csv:7", 12, "no: 3\nnumbers");
  EXPECT_EQ(error.path(), "dir: 1/a.csv:7");
  EXPECT_EQ(error.line(), 12);
  EXPECT_EQ(error.fault(), "no: 3 numbers");
}

TEST(FileError, BehindATextKeepsPathAndLine) {
  for (const int line : {0, 12}) {
    const FileError error("a.csv", line, "no number");
    const FileError behind = error.behind("column t:\n");
    EXPECT_EQ(behind.path(), "a.csv");
    EXPECT_EQ(behind.line(), line);
    EXPECT_EQ(behind.fault(), "column t: no number");
    EXPECT_EQ(std::string(behind.what()),
              std::string(line > 0 ? "a.csv:12" : "a.csv") + ": column t: no number");
  }
}

TEST(UnknownName, OfEquallyNearOnesSuggestsTheOneThatBeginsAlike) {
  const std::string said = unknown_name("arm", "ur55", {"ur15", "ur5", "ur5e"}).what();
  EXPECT_EQ(said, "unknown arm \"ur55\"; did you mean \"ur5\"? (known: ur15, ur5, ur5e)");
}

TEST(UnknownName, SuggestsTheNearestIgnoringCaseAndListsAll) {
  const std::vector<std::string> arms{"rrr", "puma560", "ur5", "ur5e", "panda"};
  const auto says = [&](std::string_view name) {
    return std::string(unknown_name("arm", name, arms).what());
  };
  const std::string known = " (known: rrr, puma560, ur5, ur5e, panda)";
  EXPECT_EQ(says("pandda"), "unknown arm \"pandda\"; did you mean \"panda\"?" + known);
  EXPECT_EQ(says("PANDA"), "unknown arm \"PANDA\"; did you mean \"panda\"?" + known);
  EXPECT_EQ(says("puma"), "unknown arm \"puma\"; did you mean \"puma560\"?" + known);
  EXPECT_EQ(says("UR5"), "unknown arm \"UR5\"; did you mean \"ur5\"?" + known);
  EXPECT_EQ(says("pnada"), "unknown arm \"pnada\"; did you mean \"panda\"?" + known);
  EXPECT_EQ(says("iiwa"), "unknown arm \"iiwa\"" + known);
  EXPECT_EQ(says("puma56"), "unknown arm \"puma56\"; did you mean \"puma560\"?" + known);
  EXPECT_EQ(says("panda_arm"), "unknown arm \"panda_arm\"; did you mean \"panda\"?" + known);
  EXPECT_EQ(says("ur5_e"), "unknown arm \"ur5_e\"; did you mean \"ur5e\"?" + known);
  EXPECT_EQ(says(""), "unknown arm \"\"" + known);
  EXPECT_EQ(std::string(unknown_name("arm", "x", {}).what()), "unknown arm \"x\"");
}

TEST(UnknownName, SuggestsNoNameWithoutACommonLetter) {
  EXPECT_STREQ(unknown_name("joint type", "Q", {"R", "P"}).what(),
               "unknown joint type \"Q\" (known: R, P)");
  EXPECT_STREQ(unknown_name("joint type", "p", {"R", "P"}).what(),
               "unknown joint type \"p\"; did you mean \"P\"? (known: R, P)");
}

TEST(UnknownName, PrefersTheNameThatWasAbbreviated) {
  const auto suggested = [](std::string_view name, const std::vector<std::string>& choices) {
    const std::string said = unknown_name("option", name, choices).what();
    const std::size_t at = said.find("did you mean \"");
    return at == std::string::npos ? "" : said.substr(at + 14, said.find("\"?") - at - 14);
  };
  EXPECT_EQ(suggested("--tol", {"--all", "--tolerance"}), "--tolerance");
  EXPECT_EQ(suggested("--deg", {"--seed", "--degrees"}), "--degrees");
  EXPECT_EQ(suggested("-q", {"--to", "--q"}), "--q");
  EXPECT_EQ(suggested("fkin", {"arms", "fk", "ik"}), "fk");
  EXPECT_EQ(suggested("figures", {"fk", "figure"}), "figure");
  EXPECT_EQ(suggested("--inertia", {"--in"}), "");
  EXPECT_EQ(suggested("--seed", {"--help"}), "");
  EXPECT_EQ(suggested("--frame", {"--base"}), "");
  EXPECT_EQ(suggested("--speed", {"--blend"}), "");
  EXPECT_EQ(suggested("--law", {"--draw"}), "");
  EXPECT_EQ(suggested("--version", {"--json"}), "");
}

TEST(UnknownName, CutsLongNamesBetweenCharactersAndStaysShort) {
  const std::string long_name(1 << 20, 'x');
  EXPECT_LT(std::string(unknown_name("link", long_name, {"a"}).what()).size(), 200);
  std::string umlauts = "x";
  for (int i = 0; i < 100; ++i) umlauts += "\xc3\xa4";
  const std::string said = unknown_name("link", umlauts, {"a"}).what();
  EXPECT_NE(said.find("\xc3\xa4\" (known"), std::string::npos) << said;
}

TEST(Listed, JoinsAndCountsWhatItLeavesOut) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a"}), "a");
  EXPECT_EQ(listed({"a", "b", "c"}), "a, b, c");
  const std::string all = listed(std::vector<std::string>(30, "n"));
  EXPECT_TRUE(all.ends_with("n, n and 6 more")) << all;
}

TEST(Number, HasSixDigitsAndNoLocale) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(-2.8973), "-2.8973");
  EXPECT_EQ(number(1.0 / 3), "0.333333");
  EXPECT_EQ(number(1e-9), "1e-09");
  EXPECT_EQ(number(-1.7976931348623157e308), "-1.79769e+308");
  EXPECT_EQ(number(INFINITY), "inf");
  EXPECT_EQ(number(NAN), "nan");
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // if installed
  EXPECT_EQ(number(0.5), "0.5");
  std::setlocale(LC_ALL, "C");
}

TEST(Angle, HasBothUnits) {
  EXPECT_EQ(angle(std::acos(0.0)), "1.5708 rad (90 deg)");
  EXPECT_EQ(angle(0), "0 rad (0 deg)");
}

}  // namespace
}  // namespace beeline
