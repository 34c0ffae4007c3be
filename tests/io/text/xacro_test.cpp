#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

// Files of xacro, with scripts in the place of the programs.

namespace beeline {
namespace {

using testing::TemporaryFolder;

/// Programs in a folder that is the whole PATH.
class Programs {
 public:
  Programs() : before_(std::getenv("PATH")) { ::setenv("PATH", folder_.file(".").c_str(), 1); }
  ~Programs() { ::setenv("PATH", before_.c_str(), 1); }

  void add(const std::string& name, const std::string& script) const {
    const std::string path = folder_.write(name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }

 private:
  TemporaryFolder folder_;
  std::string before_;
};

const std::string expanded =
    testing::link("a") + testing::link("b") + testing::joint("j", "continuous", "a", "b");
const std::string macro =
    "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:arm/></robot>";

/// Writes a text from a script.
std::string printing(const std::string& text) { return "/bin/cat <<'END'\n" + text + "END\n"; }

/// Ends a script unless its arguments contain a text.
std::string expecting(const std::string& text) {
  return "case \"$*\" in *\"" + text + "\"*) ;; *) echo 'Package not found' >&2; exit 1 ;; esac\n";
}

TEST(Xacro, TheProgramsOutputIsTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a b.xacro", macro);
  const Programs programs;
  programs.add("xacro", "[ \"$1\" = '" + path + "' ] && [ $# = 1 ] && " +
                            printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);
  EXPECT_EQ(read_arm_shapes(path).links.size(), 0u);
  EXPECT_EQ(read_arm(folder.write("a.urdf.xacro", testing::robot(expanded))).dof(), 1);
}

// xacro executes expressions, which only the ending of its files allows.
TEST(Xacro, FilesWithOtherEndingsAreNotExpanded) {
  const TemporaryFolder folder;
  const Programs programs;
  programs.add("xacro", printing(testing::robot(expanded)));
  EXPECT_REFUSED(read_arm(folder.write("a.urdf", macro)),
                 "a.urdf:1: is a xacro file (it contains <xacro:arm>)");
  programs.add("xacro", "exit 1\n");
  EXPECT_EQ(read_arm(folder.write("b.xacro", testing::robot(expanded))).dof(), 1);  // as it is
}

TEST(Xacro, XacrodocIsPreferred) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  programs.add("xacro", "exit 1\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacro fails");
  programs.add("xacrodoc", printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);
}

// Most models outside of ROS have no package.xml, by which xacrodoc finds packages.
TEST(Xacro, PackagesAboveTheFileAreFoundWithoutPackageXml) {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  for (const char* const each : {"arms/my_arm/urdf", "arms/gripper"}) {
    fs::create_directories(folder.file(each));
  }
  const std::string finds =
      "$(find my_arm)$(find my_arm) package://gripper/a.stl $(find none) $(find ../up";
  const std::string path = folder.write("arms/my_arm/urdf/a.xacro", macro + finds);
  const Programs programs;
  programs.add("xacrodoc", "[ $# -gt 1 ] || exit 1\n" +
                               expecting("-p gripper:=" + folder.file("arms/gripper")) +
                               expecting("-p my_arm:=" + folder.file("arms/my_arm")) +
                               printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);
  programs.add("xacrodoc", "[ $# = 1 ] && " + printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);  // it has found them itself
  programs.add("xacrodoc", "echo 'no package' >&2\nexit 1\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacrodoc fails: no package");
}

// An included file may name packages that the file itself does not name.
TEST(Xacro, PackagesBesideTheFilesOwnAreFoundByPackageXml) {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  fs::create_directories(folder.file("src/arm-main/urdf"));
  fs::create_directories(folder.file("src/gripper-2.0"));
  const auto package = [](const std::string& name) {
    return "<package><name>" + name + "</name></package>";
  };
  folder.write("src/arm-main/package.xml", package("arm"));
  folder.write("src/gripper-2.0/package.xml", package("gripper"));
  const std::string path = folder.write("src/arm-main/urdf/a.xacro", macro + "$(find gripper)");
  const Programs programs;
  programs.add("xacrodoc", "[ $# -gt 1 ] || exit 1\n" +
                               expecting("-p gripper:=" + folder.file("src/gripper-2.0")) +
                               expecting("-d " + folder.file("src") + " " + path) +
                               printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);
}

TEST(Xacro, PackagesOfIncludedFilesAreFoundByFoldersAndLinks) {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  fs::create_directories(folder.file("my_arm/urdf"));
  fs::create_directories(folder.file("packages"));
  fs::create_directory_symlink(folder.file("my_arm"), folder.file("packages/arm_support"));
  const std::string path = folder.write("my_arm/urdf/a.xacro", macro);
  const Programs programs;
  programs.add("xacrodoc", "[ $# -gt 1 ] || exit 1\n" +
                               expecting("-p my_arm:=" + folder.file("my_arm")) +
                               expecting("-p arm_support:=" + folder.file("packages/arm_support")) +
                               printing(testing::robot(expanded)));
  EXPECT_REFUSED(read_arm(path), "ROS_PACKAGE_PATH");
  ::setenv("ROS_PACKAGE_PATH", folder.file("packages").c_str(), 1);
  EXPECT_EQ(read_arm(path).dof(), 1);
  ::unsetenv("ROS_PACKAGE_PATH");
}

TEST(Xacro, RunsInTheFolderOfTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  programs.add("xacrodoc", "[ -e a.xacro ] && " + printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);
}

TEST(Xacro, WithoutAProgramTheErrorNamesIt) {
  const TemporaryFolder folder;
  const Programs programs;
  EXPECT_REFUSED(read_arm(folder.write("a.xacro", macro)),
                 "a.xacro: is a xacro file, which needs the program xacrodoc or xacro; install");
  EXPECT_REFUSED(arm_from_text(macro, "nowhere/a.xacro"), "needs the program xacrodoc or xacro");
}

TEST(Xacro, ItsMessageIsPassedOn) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  programs.add("xacro",
               "echo 'name x is not defined' >&2\necho 'line 5, \033[0mcolumn 3' >&2\nexit 2\n");
  EXPECT_REFUSED(read_arm(path),
                 "a.xacro: xacro fails: name x is not defined; line 5,  [0mcolumn 3");
  programs.add("xacro",
               "printf 'warning: redefining a\\nwhen instantiating macro: b\\nin file: c\\n' >&2\n"
               "echo 'error: x is missing' >&2\nexit 2\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacro fails: error: x is missing");
  programs.add("xacro", "kill -9 $$\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacro fails");
  programs.add("xacro", "exit 0\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacro fails");
}

TEST(Xacro, LinesOfErrorsAreOfTheOutput) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  programs.add("xacro", printing(testing::robot(testing::link("a") + testing::link("b") +
                                                testing::joint("j", "twisted", "a", "b"))));
  EXPECT_REFUSED(read_arm(path),
                 "a.xacro: line 4 of the text that xacro makes of it: joint j has an unknown type");
}

TEST(Xacro, LinesOfWarningsAreOfTheOutput) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  programs.add("xacro", printing(testing::robot(expanded + testing::link("alone"))));
  std::vector<ReadWarning> warnings;
  read_arm(path, {}, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].program, "xacro");
  EXPECT_NE(sentence(warnings[0])
                .find("a.xacro: line 5 of the text that xacro makes of it: link "
                      "alone is not connected"),
            std::string::npos)
      << sentence(warnings[0]);
}

TEST(Xacro, RunsOnceWhileExpansionsAreKept) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro), runs = folder.file("runs");
  const Programs programs;
  programs.add("xacro", "echo run >> '" + runs + "'\n" + printing(testing::robot(expanded)));
  const auto count = [&] { return folder.content("runs").size() / 4; };
  {
    const KeptExpansions kept;
    for (int i = 0; i < 3; ++i) {
      const KeptExpansions inner;
      EXPECT_EQ(read_arm(path).dof(), 1);
      read_arm_shapes(path);
    }
    EXPECT_EQ(count(), 1u);
    folder.write("a.xacro", macro + "<!-- changed -->");
    read_arm(path);
    EXPECT_EQ(count(), 2u);
  }
  read_arm(path);
  read_arm(path);
  EXPECT_EQ(count(), 4u);
}

TEST(Xacro, TheProgramGetsTheArgumentsOfTheInnermost) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  const auto arguments = [&] { return read_arm(path).joint_of(0).name; };
  programs.add("xacrodoc",
               "[ $# = 3 ] || { echo 'Package not found' >&2; exit 1; }\n"
               "/bin/cat <<END\n" +
                   testing::robot(testing::link("a") + testing::link("b") +
                                  testing::joint("$2.$3", "continuous", "a", "b")) +
                   "END\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacrodoc fails: Package not found");
  const KeptExpansions outer({{"name", "x y"}, {"b-c", ""}});
  EXPECT_EQ(arguments(), "b-c:=.name:=x y");
  {
    const KeptExpansions same;
    EXPECT_EQ(arguments(), "b-c:=.name:=x y");
    const KeptExpansions inner({{"d", "1"}, {"e", "2"}});
    EXPECT_EQ(arguments(), "d:=1.e:=2");
  }
  EXPECT_EQ(arguments(), "b-c:=.name:=x y");
  for (const std::string name : {"-p", "a b", "", "a:"}) {
    EXPECT_REFUSED(KeptExpansions({{name, "1"}}),
                   "\"" + name + "\" is no name of an argument of xacro");
  }
}

TEST(Xacro, OutputIsBounded) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xacro", macro);
  const Programs programs;
  programs.add("xacro",
               "while :; do echo aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
               "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
               "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa; done\n");
  EXPECT_REFUSED(read_arm(path), "a.xacro: xacro writes more than 8 MiB");
  programs.add("xacro",
               "i=0; while [ $i -lt 3000 ]; do echo bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb "
               ">&2; i=$((i+1)); done\n" +
                   printing(testing::robot(expanded)));
  EXPECT_EQ(read_arm(path).dof(), 1);
}

}  // namespace
}  // namespace beeline
