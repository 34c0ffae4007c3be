#include <functional>
#include <gtest/gtest.h>
#include <string>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/srdf_file.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>
#include <beeline/model/catalog.h>

#include <tests/io/text/limits_samples.h>
#include <tests/io/text/mesh_samples.h>
#include <tests/io/text/mjcf_samples.h>
#include <tests/io/text/urdf_samples.h>
#include <tests/random.h>
#include <tests/refusal.h>

// Truncated and modified texts are read, or refused with a message of one line. The address and
// undefined-behaviour sanitizers detect everything else.

namespace beeline {
namespace {

using Reader = std::function<void(const std::string&)>;

struct Case {
  const char* name;
  std::string text;
  Reader read;
  std::string bytes;  // that matter to the format
};

Arm arm_with(const std::string& joint) {
  std::vector<Joint> joints = built_in("rrr").joints();
  joints[1].name = joint;
  return {"a", joints};
}

std::vector<Case> cases() {
  const std::string composite = R"({"name": "a", "joints": [
    {"name": "s", "type": "spherical", "origin": {"xyz": [1, 0, 0], "rpy": [0, 1, 0]}},
    {"name": "h", "type": "helical", "pitch": 0.1, "point": [1, 2, 3],
     "mimic": {"joint": "s_z", "multiplier": -1.5e-3}, "limits": {"lower": -1, "jerk": 2}}]})";
  const std::string dh = R"({"name": "a", "base": {"quaternion": {"qw": 1, "qx": 0, "qy": 0,
    "qz": 0}}, "dh": {"convention": "modified", "rows": [{"a": 1}, {"type": "prismatic"}]}})";
  const Reader json = [](const std::string& text) { arm_from_json(text, "a.json"); };
  return {
      {"urdf", testing::whole_urdf,
       [](const std::string& text) { arm_from_urdf(text, "a.urdf", {.base = "", .tip = "left"}); },
       "<>/\"'=&;!?-[] \n0.e"},
      {"mjcf", testing::whole_mjcf,
       [](const std::string& text) {
         arm_from_urdf(text, "a.xml", {.base = "", .tip = "left"});
         arm_shapes_from_text(text, "a.xml", {.tip = "hand"});
       },
       "<>/\"'=&;!?-[] \n0.e"},
      {"srdf", testing::whole_srdf,
       [](const std::string& text) {
         const Srdf srdf = srdf_from_text(text, "a.srdf");
         internal::group_ends(srdf, "small", testing::whole_urdf, "a.urdf");
         named_state(srdf, arm_from_urdf(testing::whole_urdf, "a.urdf", {.tip = "flange"}), "home");
       },
       "<>/\"'=&;!?-[] \n0.e"},
      {"stl", testing::ascii_stl({{{{1, 2, 3}, {-4, 5e-1, 6}, {0, 0, 0}}}}),
       [](const std::string& text) { internal::mesh_from_text(text, "a.stl"); }, " \n\rvsef0.-+"},
      {"binary stl", testing::binary_stl({{{{1, 2, 3}, {-4, 5e-1, 6}, {0, 0, 0}}}}),
       [](const std::string& text) { internal::mesh_from_text(text, "a.stl"); },
       std::string("\0\x01\xff\x7fs", 5)},
      {"obj", testing::obj({{{{1, 2, 3}, {-4, 5e-1, 6}, {0, 0, 0}}}}),
       [](const std::string& text) { internal::mesh_from_text(text, "a.obj"); }, " \n\rvf/#\\0.-1"},
      {"cell",
       "<robot name=\"c\"><link name=\"a\"><collision><origin xyz=\"1 0 0\"/><geometry><box "
       "size=\"1 2 3\"/></geometry></collision></link></robot>",
       [](const std::string& text) { scene_from_urdf(text, "c.urdf"); }, "<>/\"'=&;!?-[] \n0.e"},
      {"panda", arm_to_json(built_in("panda")), json, "{}[]\",:\\-+.e019 \n"},
      {"composite", composite, json, "{}[]\",:\\-+.e019 \n"},
      {"dh", dh, json, "{}[]\",:\\-+.e019 \n"},
      {"poses", "# c\nx,y,z,qw,qx,qy,qz\n1,2,3,1,0,0,0\n\"1\",2,-3e-1,0,1,0,0\n",
       [](const std::string& text) { poses_from_csv(text, "a.csv"); }, ",\"#\n\r-+.e01 "},
      {"program",
       "# c\nmotion,relative,q,x,y,z,roll,pitch,yaw,speed,blend,dwell\njoint,,\"1,2\",,,,,,,,,\n"
       "via,previous,,0,1,0,0,0,0,,,\narc,next,,1,0,0,0,0,0,0.1,,3\n,,,1,2,3,0,0,0,,1e-2,\n",
       [](const std::string& text) { program_rows_from_csv(text, "a.csv"); }, ",\"#\n\r-+.e01 "},
      {"limits", testing::ur_limits,
       [](const std::string& text) {
         joint_limits_from_text(text, "l.yaml", arm_with("elbow_joint"));
       },
       ":-[]{},#&*!'\"|> \n?~.e01"},
      {"joint string", "RPHSCEU:1,0@90,0.2p0.05,1,-1e-3@-45,2,3",
       [](const std::string& text) {
         if (is_joint_string(text)) arm_from_joint_string(text);
       },
       ":,@p-+.e019RPH"},
  };
}

/// True when the text was refused. Anything but beeline::Error ends the test.
bool is_refused(const Case& c, const std::string& text) {
  const std::string refused = testing::refusal([&] { c.read(text); });
  EXPECT_EQ(refused.find('\n'), std::string::npos) << c.name << ": " << refused;
  EXPECT_LT(refused.size(), 2000u) << c.name << ": " << refused;
  return refused != "accepted";
}

TEST(BrokenText, EveryTruncationIsReadOrRefused) {
  for (const Case& c : cases()) {
    ASSERT_FALSE(is_refused(c, c.text)) << c.name;
    std::size_t refused = 0;
    for (std::size_t length = 0; length < c.text.size(); ++length) {
      refused += is_refused(c, c.text.substr(0, length));
    }
    EXPECT_GT(refused, 0u) << c.name;
  }
}

TEST(BrokenText, TruncatedUrdfAndJsonAreAlwaysRefused) {
  for (const Case& c : cases()) {
    const std::size_t end = c.text.find_last_of(">}");
    if (end == std::string::npos) continue;
    for (std::size_t length = 0; length < end; ++length) {
      ASSERT_TRUE(is_refused(c, c.text.substr(0, length))) << c.name << " at byte " << length;
    }
  }
}

TEST(BrokenText, EveryMutationIsReadOrRefused) {
  testing::Random random;
  const auto place = [&random](const std::string& text) {
    return static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()) - 1));
  };
  for (const Case& c : cases()) {
    int refused = 0;
    const int mutations = testing::cases(12'000);
    for (int i = 0; i < mutations; ++i) {
      std::string text = c.text;
      for (int changes = random.integer(1, 4); changes > 0 && !text.empty(); --changes) {
        const std::size_t at = place(text);
        const char byte = random.integer(0, 1) == 0 ? static_cast<char>(random.integer(0, 255))
                                                    : c.bytes[place(c.bytes)];
        const std::size_t from = place(text);
        const auto length = static_cast<std::size_t>(random.integer(1, 40));
        switch (random.integer(0, 3)) {
          case 0:
            text[at] = byte;
            break;
          case 1:
            text.insert(at, 1, byte);
            break;
          case 2:
            text.erase(at, length);
            break;
          default:
            text.insert(at, text.substr(from, length));
            break;
        }
      }
      refused += is_refused(c, text);
    }
    EXPECT_GT(refused, mutations / 40) << c.name;
  }
}

}  // namespace
}  // namespace beeline
