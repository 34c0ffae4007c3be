#include <gtest/gtest.h>

#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/random.h>
#include <tests/refusal.h>

// The ends of the chain that the reader selects or names: below a free joint, before a gripper.

namespace beeline {
namespace {

using testing::arm;
using testing::joint;
using testing::Kinds;
using testing::link;
using testing::Read;
using testing::read;

TEST(UrdfBase, LiesBelowAFloatingOrPlanarJoint) {
  for (const std::string type : {"floating", "planar"}) {
    for (const std::string& above :
         {link("world") + joint("free", type, "world", "a"),
          link("world") + link("foot") + joint("free", type, "world", "foot") +
              joint("fix", "fixed", "foot", "a"),
          link("world") + link("foot") + joint("fix", "fixed", "world", "foot") +
              joint("free", type, "foot", "a")}) {
      const Read result = read(above + arm);
      EXPECT_EQ(result.dof, 2);
      ASSERT_EQ(result.kinds, Kinds{ReadWarningKind::below_free_joint});
      EXPECT_EQ(result.warnings.front().joint, "free");
      EXPECT_EQ(read(above + arm, {.base = "a"}).kinds, Kinds{});
      EXPECT_REFUSED(read(above + arm, {.base = "world"}),
                     "joint free is \"" + type + "\"; a chain has revolute");
      EXPECT_REFUSED(read(above + arm, {.base = "world"}),
                     "(--base " + result.warnings.front().link + ") selects a chain without it");
    }
  }
}

/// The arm of two joints with joints behind it, each with a link of its own: names of both.
std::string with_joints(const std::vector<std::pair<std::string, std::string>>& joints) {
  std::string text = arm, last = "c";
  for (const auto& [name, child] : joints) {
    text += link(child) + joint(name, "prismatic", last, child);
    last = child;
  }
  return text;
}

TEST(UrdfTip, LiesBeforeTheJointsOfAGripper) {
  for (const auto& [name, child] :
       std::vector<std::pair<std::string, std::string>>{{"jointGripper", "gripperMover"},
                                                        {"gripper", "moving_jaw"},
                                                        {"6", "moving_jaw_so101"},
                                                        {"left_finger_joint", "l1"},
                                                        {"j7", "rightfinger"},
                                                        {"robotiq_85_left_knuckle_joint", "k"},
                                                        {"GRIPPER_JOINT", "part"},
                                                        {"thumb", "x"},
                                                        {"claw", "x"}}) {
    const std::string text = with_joints({{name, child}});
    const Read result = read(text);
    EXPECT_EQ(result.dof, 2) << name;
    ASSERT_EQ(result.kinds, Kinds{ReadWarningKind::before_gripper}) << name;
    const ReadWarning& warning = result.warnings.front();
    EXPECT_EQ(warning.joint, name);
    EXPECT_EQ(warning.link, "c");
    EXPECT_EQ(warning.others, std::vector<std::string>{child});
    const std::string choice = "the tip is c, before joint " + name + ", which moves a gripper; ";
    EXPECT_EQ(sentence(warning), choice + "tip=\"" + child + "\" includes it");
    EXPECT_EQ(sentence(warning, OptionStyle::command), choice + "--tip " + child + " includes it");
    EXPECT_EQ(read(text, {.tip = child}).dof, 3);
    EXPECT_EQ(read(text, {.tip = child}).kinds, Kinds{});
    EXPECT_EQ(read(text, {.tip = "c"}).kinds, Kinds{});
  }
  const std::string palm = link("palm") + joint("palm", "fixed", "c", "palm") + link("pad") +
                           joint("finger", "prismatic", "palm", "tip_link") + link("tip_link") +
                           joint("pad", "fixed", "tip_link", "pad");
  const Read result = read(arm + palm);
  EXPECT_EQ(result.kinds, Kinds{ReadWarningKind::before_gripper});
  EXPECT_EQ(result.warnings.front().link, "palm");
  EXPECT_EQ(result.warnings.front().others, std::vector<std::string>{"pad"});
  EXPECT_EQ(read(with_joints({{"finger_1", "p"}, {"finger_2", "q"}})).dof, 2);
}

TEST(UrdfTip, BeforeAGripperIsNamedAmongItsFingers) {
  const std::string hand = link("hand") + joint("hand_joint", "fixed", "c", "hand") + link("left") +
                           joint("finger_1", "prismatic", "hand", "left");
  const std::string right = link("right") + joint("finger_2", "prismatic", "hand", "right");
  EXPECT_REFUSED(
      read(arm + hand + right),
      "has 2 tips below a; choose one as the tip: left, right; tip=\"hand\" (--tip hand) ends "
      "before the gripper");
  EXPECT_EQ(read(arm + hand + right, {.tip = "hand"}).dof, 2);

  const std::string camera = link("camera") + joint("tilt", "revolute", "b", "camera");
  const std::string refused = testing::refusal([&] { read(arm + hand + camera); });
  EXPECT_TRUE(refused.ends_with("left, camera; tip=\"hand\" (--tip hand) ends before the gripper"))
      << refused;
  const std::string alone = testing::refusal([&] { read(arm + hand + right, {.base = "hand"}); });
  EXPECT_TRUE(alone.ends_with("choose one as the tip: left, right")) << alone;
}

/// The text in front of ` ends before the gripper`, as a shell reads it.
std::string named_tip(const std::string& message) {
  const std::string front = " (--tip ", back = ") ends before the gripper";
  const std::size_t begin = message.find(front), end = message.find(back);
  if (begin == std::string::npos || end == std::string::npos) return "";
  const std::string word = message.substr(begin + front.size(), end - begin - front.size());
  std::string name;
  bool quoted = false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] == '\'') {
      quoted = !quoted;
    } else {
      if (word[i] == '\\' && !quoted) ++i;
      name += word[i];
    }
  }
  return name;
}

/// Random arms with a gripper of two or three fingers, mimic joints or not, and frames beside them:
/// the tip that the refusal names selects all joints in front of the gripper, and no other.
TEST(UrdfTip, ThatARefusalNamesIsTheLinkBeforeTheGripper) {
  testing::Random random;
  const std::vector<std::string> hands{"hand", "the hand", "it's", "-palm", "palm;ls", "$HOME"};
  int named = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const int joints = random.integer(1, 7), fingers = random.integer(2, 3);
    const std::string hand = hands[static_cast<std::size_t>(random.integer(0, 5))];
    std::vector<std::string> elements{link("l0")};
    for (int k = 1; k <= joints; ++k) {
      const std::string n = std::to_string(k), above = std::to_string(k - 1);
      elements.push_back(link("l" + n) + joint("j" + n, "revolute", "l" + above, "l" + n));
    }
    elements.push_back(link(hand) + joint("mount", "fixed", "l" + std::to_string(joints), hand));
    for (int f = 0; f < fingers; ++f) {
      const std::string n = std::to_string(f);
      const bool follows = f > 0 && random.integer(0, 1) == 1;
      elements.push_back(link("finger" + n) + joint("f" + n, "prismatic", hand, "finger" + n,
                                                    follows ? "<mimic joint=\"f0\"/>" : ""));
      if (random.integer(0, 1) == 1) {
        const std::string type = random.integer(0, 1) == 1 ? "fixed" : "revolute";
        elements.push_back(link("pad" + n) + joint("fingertip" + n, type, "finger" + n, "pad" + n));
      }
    }
    if (random.integer(0, 1) == 1) {
      const std::string at = "l" + std::to_string(random.integer(0, joints));
      elements.push_back(link("camera") + joint("camera", "fixed", at, "camera"));
    }
    std::string text;
    while (!elements.empty()) {
      const auto at = elements.begin() + random.integer(0, static_cast<int>(elements.size()) - 1);
      text += *at;
      elements.erase(at);
    }
    const std::string refused = testing::refusal([&] { read(text); });
    ASSERT_EQ(named_tip(refused), hand) << refused;
    const Read result = read(text, {.tip = named_tip(refused)});
    EXPECT_EQ(result.dof, joints) << text;
    EXPECT_EQ(result.kinds, Kinds{}) << text;
    ++named;
  }
  EXPECT_GT(named, 0);
}

TEST(UrdfTip, StaysWhereNothingButAGripperOrItsMountMoves) {
  for (const auto& [name, child] :
       std::vector<std::pair<std::string, std::string>>{{"wrist", "gripper_link"},
                                                        {"gripper_roll_joint", "x"},
                                                        {"flange", "hand"},
                                                        {"tool", "tool"}}) {
    EXPECT_EQ(read(with_joints({{name, child}})).kinds, Kinds{}) << name;
    EXPECT_EQ(read(with_joints({{name, child}})).dof, 3) << name;
  }
  // A finger alone is an arm.
  const std::string finger = link("a") + link("b") + link("c") +
                             joint("finger_1", "revolute", "a", "b") +
                             joint("finger_2", "revolute", "b", "c");
  EXPECT_EQ(read(finger).dof, 2);
  EXPECT_EQ(read(finger).kinds, Kinds{});
}

}  // namespace
}  // namespace beeline
