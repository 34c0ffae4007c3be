#include <gtest/gtest.h>

#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/refusal.h>

// Names of a URDF file in another encoding.

namespace beeline {
namespace {

using testing::arm;
using testing::joint;
using testing::Kinds;
using testing::link;
using testing::Read;
using testing::read;
using testing::robot;

TEST(UrdfEncoding, Latin1IsReadWhereItIsDeclaredOrHarmless) {
  const std::string text = robot(
      "<!-- gr\xf6\xdf"
      "e -->\n" +
      arm);
  EXPECT_EQ(arm_from_urdf(text, "a.urdf").dof(), 2);
  const std::string named = robot(link("a") +
                                  link("gr\xf6\xdf"
                                       "e") +
                                  joint("j", "revolute", "a",
                                        "gr\xf6\xdf"
                                        "e"));
  EXPECT_REFUSED(arm_from_urdf(named, "a.urdf"),
                 "a.urdf:3: <link>: name \"gr\\xf6\\xdf"
                 "e\" is not UTF-8 text, perhaps Latin-1; save the file as UTF-8");
  for (const std::string name : {"ISO-8859-1", "iso-8859-1", "latin1"}) {
    const std::string declared = "<?xml version=\"1.0\" encoding=\"" + name + "\"?>\n" + named;
    EXPECT_EQ(arm_from_urdf(declared, "a.urdf").joints().front().link, "gr\u00f6\u00dfe") << name;
  }
}

/// A name that is not UTF-8 is the reason for a refusal wherever it is on the chain, also of a file
/// that declares UTF-8; beside the chain it is a warning.
TEST(UrdfEncoding, NamesInAnotherEncodingAreTheReasonOnTheChain) {
  const std::vector<std::string> names{"a", "b", "c", "ab", "bc"};
  const auto text = [](const std::vector<std::string>& n) {
    return link(n[0]) + link(n[1]) + link(n[2]) + joint(n[3], "revolute", n[0], n[1]) +
           joint(n[4], "revolute", n[1], n[2]);
  };
  for (const std::string byte : {"\xfc", "\x81", "\xff", "\xc3", "\xed\xa0\x80"}) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::vector<std::string> wrong = names;
      wrong[i] = "n" + byte + "m";
      const std::string tag = i < 3 ? "<link>" : "<joint>";
      const std::string line = "a.urdf:" + std::to_string(2 + i) + ": ";
      for (const std::string tip : {"", i == 2 ? "" : "c"}) {
        EXPECT_REFUSED(read(text(wrong), {.tip = tip}), line + tag + ": name \"n\\x");
        EXPECT_REFUSED(read(text(wrong), {.tip = tip}), "is not UTF-8 text");
      }
      for (std::string& name : wrong) name += "_";  // another arm, beside the one that is read
      const std::string beside = arm + text(wrong) + joint("f", "fixed", "a", wrong[0]);
      const Read result = read(beside, {.tip = "c"});
      EXPECT_EQ(result.dof, 2);
      ASSERT_EQ(result.kinds, Kinds{ReadWarningKind::malformed});
      EXPECT_EQ(result.warnings.front().element_fault, ElementFault::not_utf8);
    }
  }
}

}  // namespace
}  // namespace beeline
