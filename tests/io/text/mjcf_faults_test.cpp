#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>

#include <tests/io/text/mjcf_samples.h>
#include <tests/refusal.h>

// Broken MJCF files: each is refused in one line that names its own line.

namespace beeline {
namespace {

using testing::mujoco;

struct BrokenMjcf {
  std::string text, message;
};

/// A body on line 3 with one joint on line 4.
std::string jointed(const std::string& joint, const std::string& body = "") {
  return mujoco("<body name=\"a\" " + body + ">\n<joint name=\"j\" " + joint +
                "/>\n<geom size=\"0.1\"/></body>\n");
}

std::string with_section(const std::string& section) {
  return mujoco(
      "<body name=\"a\"><joint name=\"j\"/><body name=\"b\"><joint name=\"k\"/></body>"
      "</body>\n",
      "\n" + section);
}

std::vector<BrokenMjcf> broken_joints() {
  return {
      {jointed("type=\"hing\""), "a.xml:4: <joint>: type is \"hing\"; known are free, ball"},
      {jointed("axis=\"0 0 0\""), "a.xml:4: joint j: axis 0 0 0 has no direction"},
      {jointed("axis=\"0 0\""), "a.xml:4: <joint>: axis has 2 numbers; it must have three"},
      {jointed("pos=\"0 0 x\""), "a.xml:4: <joint>: pos: \"x\" is not a number"},
      {jointed("pos=\"0 0 nan\""), "a.xml:4: <joint>: pos: \"nan\" must be finite"},
      {jointed("pos=\"0 0 1e999\""), "a.xml:4: <joint>: pos"},
      {jointed("range=\"1 -1\" limited=\"true\""), "a.xml:4: <joint>: range must have a lower"},
      {jointed("range=\"1\""), "a.xml:4: <joint>: range has 1 numbers; it must have 2"},
      {jointed("range=\"1 1\" limited=\"true\""), "a.xml:4: <joint>: range must have a lower"},
      {jointed("limited=\"yes\""), "a.xml:4: <joint>: limited is \"yes\"; known are true"},
      {jointed("rnage=\"0 1\""),
       "a.xml:4: <joint> has an unknown attribute rnage; range may be meant"},
      {jointed("class=\"x\""), "a.xml:4: <joint> has an unknown class of defaults \"x\""},
  };
}

std::vector<BrokenMjcf> broken_bodies() {
  return {
      {jointed("", "pos=\"1 2\""), "a.xml:3: <body>: pos has 2 numbers"},
      {jointed("", "fromto=\"0 0 0 0 0 1\""), "a.xml:3: <body> has no attribute fromto"},
      {jointed("", "quat=\"0 0 0 0\""), "a.xml:3: <body>: quat has length 0"},
      {jointed("", "quat=\"1 0 0\""), "a.xml:3: <body>: quat has 3 numbers; it must have 4"},
      {jointed("", "euler=\"1 2 3\" quat=\"1 0 0 0\""), "a.xml:3: <body>: euler is given beside"},
      {jointed("", "xyaxes=\"1 0 0 2 0 0\""), "a.xml:3: <body>: xyaxes has no direction"},
      {jointed("", "zaxis=\"0 0 0\""), "a.xml:3: <body>: zaxis has no direction"},
      {jointed("", "zaxis=\"1e308 0 -1e308\" "), "accepted"},
      {jointed("", "axisangle=\"0 0 0 90\""), "a.xml:3: <body>: axisangle has no direction"},
      {jointed("", "childclass=\"x\""), "a.xml:3: <body> has an unknown childclass of defaults"},
      {jointed("", "childclas=\"x\""), "a.xml:3: <body> has an unknown attribute childclas"},
      {mujoco("<body name=\"a\"><joint/></body>\n<body name=\"a\"><joint/></body>\n"),
       "a.xml:4: two bodies have the name a"},
      {mujoco("<body name=\"world\"><joint/></body>\n"), "a.xml:3: two bodies have the name world"},
      {mujoco("<body><joint name=\"a\"/>\n<joint name=\"a\"/></body>\n"),
       "a.xml:4: two joints have the name a"},
      {mujoco("<body name=\"a\nb\"><joint/></body>\n"), "a.xml:3: <body>: name"},
      {mujoco("<body><joint/><site name=\"s\"/>\n<site name=\"s\"/></body>\n"),
       "a.xml:4: two sites have the name s"},
      {mujoco("<joint/>\n"), "a.xml:3: <joint> is in the world, which has no joints"},
      {mujoco("<body>\n<jiont/></body>\n"),
       "a.xml:4: has an unknown element <jiont>; <joint> may be meant"},
      {mujoco("<replicate count=\"2\"><body/></replicate>\n"),
       "a.xml:3: <replicate> is not supported"},
      {mujoco("<attach model=\"x\"/>\n"), "a.xml:3: <attach> is not supported"},
      {mujoco("<body/>\n"), "a.xml: has no moving joints between its base and its tip"},
  };
}

std::vector<BrokenMjcf> broken_sections() {
  return {
      {"<mujoco/>", "a.xml:1: has no <worldbody>"},
      {with_section("<compiler angle=\"deg\"/>"), "a.xml:2: <compiler>: angle is \"deg\""},
      {with_section("<compiler eulerseq=\"xyw\"/>"), "a.xml:2: <compiler>: eulerseq is \"xyw\""},
      {with_section("<compiler coordinate=\"global\"/>"),
       "a.xml:2: <compiler>: coordinate is global, which is not supported"},
      {with_section("<compiler anlge=\"radian\"/>"),
       "a.xml:2: <compiler> has an unknown attribute anlge; angle may be meant"},
      {with_section("<wordbody/>"),
       "a.xml:2: has an unknown element <wordbody>; <worldbody> may be meant"},
      {with_section("<default class=\"x\"/>"), "a.xml:2: the outermost <default> has the class"},
      {with_section("<default><default/></default>"), "a.xml:2: <default> needs the attribute"},
      {with_section("<default><default class=\"x\"/>\n<default class=\"x\"/></default>"),
       "a.xml:3: two classes of defaults have the name x"},
      {with_section("<default><joint axis=\"0 0 y\"/></default>"),
       "a.xml:2: <joint>: axis: \"y\" is not a number"},
      {with_section("<equality><joint joint2=\"j\"/></equality>"),
       "a.xml:2: <joint> needs the attribute joint1; it has joint2"},
      {with_section("<equality><joint joint1=\"jj\"/></equality>"),
       "a.xml:2: joint1: unknown joint \"jj\""},
      {with_section("<equality><joint joint1=\"j\" joint2=\"j\"/></equality>"),
       "a.xml:2: <joint>: joint2 is \"j\", as joint1 is"},
      {with_section("<equality><joint joint1=\"j\" joint2=\"k\"/><joint joint1=\"k\" "
                    "joint2=\"j\"/></equality>"),
       "a.xml:2: joint j follows leaders that mimic each other"},
      {with_section("<equality><joint joint1=\"j\" joint2=\"k\"/>\n<joint joint1=\"j\" "
                    "joint2=\"k\"/></equality>"),
       "a.xml:3: <joint>: joint1 is \"j\", which follows another joint"},
      {with_section("<equality><joint joint1=\"j\" joint2=\"k\" polycoef=\"0 1 0 0 0 0\"/>"
                    "</equality>"),
       "a.xml:2: <joint>: polycoef has 6 numbers; it has at most 5"},
      {with_section("<include/>"), "a.xml:2: <include> needs the attribute file"},
      {with_section("<include file=\"none.xml\"/>"),
       "a.xml:2: the included file \"none.xml\" is not found in the folder of the model"},
      {"<mujoco>\n<worldbody>\n</mujoco>", "a.xml"},
  };
}

TEST(MjcfFaults, EachIsOneLineWithItsLine) {
  for (const auto& files : {broken_joints(), broken_bodies(), broken_sections()}) {
    for (const BrokenMjcf& broken : files) {
      const std::string found =
          testing::refusal([&] { (void)arm_from_urdf(broken.text, "a.xml"); });
      EXPECT_EQ(found.rfind(broken.message, 0), 0u) << broken.text << "\n" << found;
      EXPECT_EQ(found.find('\n'), std::string::npos) << found;
    }
  }
}

TEST(MjcfFaults, GeomsAreNamedWithTheirLine) {
  const auto refused = [](const std::string& geom, const std::string& message,
                          const std::string& sections = "") {
    const std::string text = mujoco("<body name=\"a\"><joint/>\n" + geom + "</body>\n", sections);
    EXPECT_EQ(arm_from_urdf(text, "a.xml").dof(), 1) << geom;
    EXPECT_REFUSED(arm_shapes_from_text(text, "a.xml"), message);
  };
  refused("<geom type=\"ellipsoid\" size=\"1 2 3\"/>",
          "a.xml:4: <geom>: type is ellipsoid, in body a, which is not supported for collisions");
  refused("<geom type=\"plane\" size=\"1 2 3\"/>", "a.xml:4: <geom>: type is plane, in body a");
  refused("<geom type=\"hfield\" hfield=\"h\"/>", "a.xml:4: <geom>: type is hfield, in body a");
  refused("<geom type=\"ball\"/>", "a.xml:4: <geom>: type is \"ball\"; known are plane");
  refused("<geom/>", "a.xml:4: <geom>: size needs 1 positive numbers of a sphere");
  refused("<geom type=\"box\" size=\"1 1\"/>", "a.xml:4: <geom>: size needs 3 positive numbers");
  refused("<geom size=\"-1\"/>", "a.xml:4: <geom>: size needs 1 positive numbers of a sphere");
  refused("<geom size=\"1e9\"/>", "a.xml:4: the <geom> of body a: a sphere has a radius");
  refused("<geom size=\"1 2 3 4\"/>", "a.xml:4: <geom>: size has 4 numbers; it has at most 3");
  refused("<geom fromto=\"0 0 0 1 0 0\" size=\"1\"/>",
          "a.xml:4: <geom>: fromto is given of a sphere");
  refused("<geom type=\"capsule\" fromto=\"1 2 3 1 2 3\" size=\"1\"/>",
          "a.xml:4: <geom>: fromto has two ends at one place");
  refused("<geom type=\"mesh\"/>", "a.xml:4: <geom>: mesh unknown mesh \"\"");
  refused("<geom type=\"mesh\" mesh=\"m\"/>",
          "a.xml:1: the mesh \"none.stl\" is not found; looked for at none.stl",
          "<asset><mesh name=\"m\" file=\"none.stl\"/></asset>");
  refused("<geom type=\"mesh\" mesh=\"m\"/>", "a.xml:1: the mesh \"m.msh\" is not of a format",
          "<asset><mesh file=\"m.msh\"/></asset>");
  refused("<geom mesh=\"m\"/>", "a.xml:4: <geom>: mesh is given beside type sphere",
          "<asset><mesh file=\"m.stl\"/></asset>");
  refused("<geom type=\"mesh\" mesh=\"m\"/>", "a.xml:1: <mesh>: vertex has 4 numbers",
          "<asset><mesh name=\"m\" vertex=\"1 2 3 4\"/></asset>");
  refused("<geom szie=\"1\"/>", "a.xml:4: <geom> has an unknown attribute szie; size may be meant");
  refused("<geom size=\"1\"/>", "a.xml:1: <exclude>: body2 \"b\" is no body of the file",
          "<contact><exclude body1=\"a\" body2=\"b\"/></contact>");
}

TEST(MjcfFaults, LargeFilesAreRefusedInBoundedTime) {
  std::string many;
  for (int i = 0; i < 50'100; ++i) many += "<body/>";
  EXPECT_REFUSED(arm_from_urdf(mujoco(many), "a.xml"), "has more than 50000 elements");
  std::string classes;
  for (int i = 0; i < 30; ++i) classes += "<default class=\"c" + std::to_string(i) + "\">";
  for (int i = 0; i < 30; ++i) classes += "</default>";
  EXPECT_REFUSED(arm_from_urdf(mujoco("", "<default>" + classes + "</default>"), "a.xml"),
                 "classes of defaults are nested deeper than 20");
  std::string row;
  for (int i = 0; i < 10'100; ++i) row += "<default class=\"c" + std::to_string(i) + "\"/>";
  EXPECT_REFUSED(arm_from_urdf(mujoco("", "<default>" + row + "</default>"), "a.xml"),
                 "has more than 10000 classes of defaults");
}

}  // namespace
}  // namespace beeline
