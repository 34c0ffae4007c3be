#include <filesystem>
#include <gtest/gtest.h>

#include <beeline/io/text/urdf.h>

#include <tests/io/text/mjcf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

// Included MJCF files, which a model of a stranger must not use to read other files.

namespace beeline {
namespace {

using testing::mujoco;
using testing::TemporaryFolder;

const std::string moving_body =
    "<x>\n<body name=\"b\"><joint name=\"b\" axis=\"0 0 0\"/></body></x>";

std::string including(const std::string& file) {
  return mujoco("<body name=\"a\"><joint name=\"a\"/><include file=\"" + file + "\"/></body>\n");
}

TEST(MjcfInclude, StandsForTheChildrenOfTheRoot) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("parts"));
  folder.write("parts/b.xml",
               "<x><body name=\"b\"><joint name=\"b\"/><include file=\"c.xml\"/>"
               "<include file=\"parts/d.xml\"/></body></x>");
  folder.write("parts/c.xml", "<x><body name=\"c\"><joint name=\"c\"/></body></x>");
  folder.write("parts/d.xml", "<x><site name=\"d\"/></x>");
  const std::string path = folder.write("a.xml", including("parts/b.xml"));
  EXPECT_EQ(read_arm(path).joint_names(), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(read_arm(path, {.tip = "d"}).dof(), 2);
}

TEST(MjcfInclude, ErrorsNameTheIncludedFile) {
  const TemporaryFolder folder;
  folder.write("b.xml", moving_body);
  const std::string path = folder.write("a.xml", including("b.xml"));
  EXPECT_REFUSED(read_arm(path), "/b.xml:2: joint b: axis 0 0 0 has no direction");
  folder.write("b.xml", "<x>\n<body pos=\"1\"/></x>");
  EXPECT_REFUSED(read_arm(path), "/b.xml:2: <body>: pos has 1 numbers");
  folder.write("b.xml", "<x>\n<body name=\"b\"><joint name=\"b\" type=\"ball\"/></body></x>");
  EXPECT_REFUSED(read_arm(path, {.tip = "b"}), "/b.xml:2: joint b is \"ball\"");
  folder.write("b.xml", "<x>\n<body></x>");
  EXPECT_REFUSED(read_arm(path), "/b.xml:");
}

// As in MuJoCo, which its documents write with the root <mujocoinclude>.
TEST(MjcfInclude, AnyRootIsReadAndAnEmptyOneRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xml", including("b.xml"));
  for (const std::string root : {"mujocoinclude", "mujoco", "x"}) {
    folder.write("b.xml", "<" + root + "><body name=\"b\"><joint/></body></" + root + ">");
    EXPECT_EQ(read_arm(path).dof(), 2);
    folder.write("b.xml", "<" + root + "/>");
    EXPECT_REFUSED(read_arm(path), "/b.xml: has no element to include");
  }
}

TEST(MjcfInclude, StaysInTheFolderOfTheModel) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("model"));
  std::filesystem::create_directory(folder.file("model2"));
  const std::string secret = folder.write("secret.xml", moving_body);
  folder.write("model2/secret.xml", moving_body);
  std::filesystem::create_symlink(secret, folder.file("model/link.xml"));
  std::filesystem::create_directory_symlink(folder.file("."), folder.file("model/up"));
  for (const std::string& file :
       {std::string("../secret.xml"), secret, std::string("link.xml"), std::string("up/secret.xml"),
        std::string("../model2/secret.xml")}) {
    EXPECT_REFUSED(read_arm(folder.write("model/a.xml", including(file))),
                   "a.xml:3: the included file");
    EXPECT_REFUSED(read_arm(folder.file("model/a.xml")), "is outside of the folder of the model");
  }
  EXPECT_REFUSED(read_arm(folder.write("model/a.xml", including("up"))), "is not found");
  folder.write("model/inside.xml", "<x><body name=\"b\"><joint/></body></x>");
  std::filesystem::create_symlink(folder.file("model/inside.xml"), folder.file("model/good.xml"));
  EXPECT_EQ(read_arm(folder.write("model/a.xml", including("good.xml"))).dof(), 2);
  EXPECT_EQ(read_arm(folder.write("model/a.xml", including("../model/good.xml"))).dof(), 2);
}

TEST(MjcfInclude, EachFileOnceAndNotEndlessly) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xml", including("a.xml"));
  EXPECT_REFUSED(read_arm(path), "a.xml:3: \"a.xml\" is included twice");
  folder.write("b.xml", "<x><include file=\"b.xml\"/></x>");
  EXPECT_REFUSED(read_arm(folder.write("a.xml", including("b.xml"))), "is included twice");
  for (int i = 0; i < 12; ++i) {
    folder.write("n" + std::to_string(i) + ".xml",
                 "<x><include file=\"n" + std::to_string(i + 1) + ".xml\"/></x>");
  }
  EXPECT_REFUSED(read_arm(folder.write("a.xml", including("n0.xml"))), "nested deeper than 10");
  folder.write("b.xml", "<x><site/></x>" + std::string(std::size_t{5} << 20, ' '));
  folder.write("c.xml", "<x><site/></x>" + std::string(std::size_t{5} << 20, ' '));
  EXPECT_REFUSED(read_arm(folder.write("a.xml", mujoco("<include file=\"b.xml\"/>"
                                                       "<include file=\"c.xml\"/>"))),
                 "a.xml: is larger than 8 MiB, with the files that it includes");
  EXPECT_REFUSED(read_arm(folder.write("a.xml", mujoco("<include file=\"b.xml\"><x/></include>"))),
                 "a.xml:3: <include> has children");
}

}  // namespace
}  // namespace beeline
