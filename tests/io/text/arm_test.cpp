#include <gtest/gtest.h>

#include <beeline/io/text/arm.h>
#include <beeline/model/catalog.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

TEST(ReadArm, NamesStringsAndFilesAllGiveArms) {
  const testing::TemporaryFolder folder;
  for (const std::string& name : built_in_names()) EXPECT_EQ(read_arm(name).name(), name);
  EXPECT_EQ(read_arm("RRR:3.5,3.5,2").dof(), 3);
  EXPECT_EQ(read_arm("RP").dof(), 2);
  EXPECT_EQ(read_arm(folder.write("a.json", arm_to_json(built_in("ur5")))).dof(), 6);
  EXPECT_EQ(
      read_arm(folder.write("a.urdf", testing::whole_urdf), {.base = "", .tip = "left"}).dof(), 3);
  EXPECT_EQ(
      read_arm(folder.write("a.XML", testing::whole_urdf), {.base = "", .tip = "flange"}).dof(), 2);
  EXPECT_EQ(
      read_arm(folder.write("RRR.urdf", testing::whole_urdf), {.base = "shoulder", .tip = "elbow"})
          .dof(),
      1);
}

TEST(ReadArm, BuiltInNamesAreFoundInAnyCase) {
  for (const char* name : {"Panda", "PANDA", "pAndA"}) EXPECT_EQ(read_arm(name).name(), "panda");
  EXPECT_EQ(read_arm("UR5").name(), "ur5");
  EXPECT_EQ(read_arm("Rrr").name(), "rrr");
  EXPECT_EQ(read_arm("RRR").name(), "RRR");  // a joint string
}

TEST(ReadArm, UnknownNamesGetTheNearestOne) {
  EXPECT_REFUSED(read_arm("pnda"), "unknown arm \"pnda\"; did you mean \"panda\"? (known: cr5, ");
  EXPECT_REFUSED(read_arm("pnda"),
                 "or give a joint string such as RRR:3.5,3.5,2, or a file (.urdf, .xml, .mjcf, "
                 ".xacro, .json)");
  EXPECT_REFUSED(read_arm(""), "unknown arm \"\"");
  EXPECT_REFUSED(read_arm("rrr:1,2,3"), "unknown arm \"rrr:1,2,3\"");
  EXPECT_REFUSED(read_arm("RRR:1"), "3 letters but 1 items");
}

TEST(ReadArm, FilesThatAreNoArmsAreNamed) {
  const testing::TemporaryFolder folder;
  EXPECT_REFUSED(read_arm(folder.file("none.urdf")), "none.urdf: cannot be read: No such file");
  EXPECT_REFUSED(read_arm(folder.file("none.json")), "none.json: cannot be read: No such file");
  EXPECT_REFUSED(read_arm("arm.txt"),
                 "arm.txt: is not a known kind of arm file; known are .urdf, .xml, .mjcf, "
                 ".xacro, .json");
  EXPECT_REFUSED(read_arm("folder/arm"), "folder/arm: is not a known kind of arm file");
  EXPECT_REFUSED(read_arm("arm.urdf.xacro"), "arm.urdf.xacro: cannot be read: No such file");
  EXPECT_REFUSED(read_arm(folder.write("a.urdf", testing::whole_urdf)),
                 "a.urdf: has 2 tips below base; choose one as the tip: left, right");
}

TEST(ReadArm, EndsGoWithUrdfOnly) {
  const testing::TemporaryFolder folder;
  const std::string json = folder.write("a.json", arm_to_json(built_in("rrr")));
  for (const std::string& text : {std::string("panda"), std::string("RRR"), json}) {
    EXPECT_REFUSED(read_arm(text, {.base = "", .tip = "x"}),
                   "base and tip select a chain of a file that describes a tree of links (.urdf, "
                   ".xml, .mjcf, .xacro); \"");
    EXPECT_REFUSED(read_arm(text, {.base = "x", .tip = ""}), "is not one");
  }
}

}  // namespace
}  // namespace beeline
