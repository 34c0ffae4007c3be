#include <gtest/gtest.h>
#include <map>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::Random;

std::string coordinates_of(const Vector3& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

Vector3 six_digits(const Vector3& v) { return (1e6 * v).array().round().matrix() / 1e6; }

/// A random tree of links, each with a sphere, and its own forward kinematics.
struct ShapedTree {
  struct Link {
    int parent = -1;
    std::string type;  ///< of the joint above it
    Vector3 xyz, rpy, axis, centre;
  };
  std::vector<Link> links;

  explicit ShapedTree(Random& random) {
    const char* const types[] = {"fixed", "revolute", "prismatic"};
    for (int i = random.integer(2, 9); i >= 0; --i) {
      const int index = static_cast<int>(links.size());
      links.push_back({index == 0 ? -1 : random.integer(std::max(0, index - 3), index - 1),
                       types[random.integer(0, 2)], six_digits(random.vector()),
                       six_digits(random.vector(1.4)), six_digits(random.direction()),
                       six_digits(random.vector())});
    }
  }

  std::string text() const {
    std::string text = "<robot name=\"tree\">";
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Link& link = links[i];
      text += "<link name=\"l" + std::to_string(i) + "\"><collision><origin xyz=\"" +
              coordinates_of(link.centre) + "\"/><geometry><sphere radius=\"0.1\"/></geometry>" +
              "</collision></link>";
      if (i == 0) continue;
      text += "<joint name=\"j" + std::to_string(i) + "\" type=\"" + link.type +
              "\"><parent link=\"l" + std::to_string(link.parent) + "\"/><child link=\"l" +
              std::to_string(i) + "\"/><origin xyz=\"" + coordinates_of(link.xyz) + "\" rpy=\"" +
              coordinates_of(link.rpy) + "\"/><axis xyz=\"" + coordinates_of(link.axis) +
              "\"/><limit lower=\"-2\" upper=\"2\"/></joint>";
    }
    return text + "</robot>";
  }

  /// Pose of a link in the root, with the joints at these values, otherwise at 0.
  Pose pose(int i, const std::map<std::string, double>& q) const {
    if (i == 0) return Pose::Identity();
    const Link& link = links[static_cast<std::size_t>(i)];
    using Eigen::AngleAxisd;
    Pose joint = Pose::Identity();
    joint.translation() = link.xyz;
    joint.linear() =
        (AngleAxisd(link.rpy.z(), Vector3::UnitZ()) * AngleAxisd(link.rpy.y(), Vector3::UnitY()) *
         AngleAxisd(link.rpy.x(), Vector3::UnitX()))
            .toRotationMatrix();
    const auto found = q.find("j" + std::to_string(i));
    const double value = found == q.end() ? 0 : found->second;
    const Vector3 axis = link.axis.normalized();
    if (link.type == "revolute") joint.rotate(AngleAxisd(value, axis));
    if (link.type == "prismatic") joint.translate(value * axis);
    return pose(link.parent, q) * joint;
  }
};

TEST(ArmShapes, AreWhereTheTreeHasThem) {
  Random random;
  int read = 0;
  for (int i = 0; i < testing::cases(600); ++i) {
    const ShapedTree tree(random);
    const int last = static_cast<int>(tree.links.size()) - 1;
    const int base = random.integer(0, last), tip = random.integer(0, last);
    const ChainEnds ends{"l" + std::to_string(base), "l" + std::to_string(tip)};
    const std::string text = tree.text();
    std::optional<Arm> arm;
    try {
      arm = arm_from_text(text, "tree.urdf", ends);
    } catch (const Error&) {
      continue;  // no joint moves between the two
    }
    ++read;
    const Configuration q = random.configuration(*arm);
    std::map<std::string, double> values, hold;
    for (Eigen::Index k = 0; k < q.size(); ++k) values[arm->joint_of(k).name] = q[k];
    for (int k = 1; k <= last; ++k) {
      const std::string name = "j" + std::to_string(k);
      const bool moves = tree.links[static_cast<std::size_t>(k)].type != "fixed";
      if (moves && !values.contains(name) && random.integer(0, 1) == 0) {
        hold[name] = values[name] = random.uniform(-2, 2);
      }
    }
    const ArmShapes shapes = arm_shapes_from_text(text, "tree.urdf", ends, {.hold = hold});
    ASSERT_EQ(shapes.links.size(), tree.links.size());
    const std::vector<Pose> frames = link_poses(*arm, q);
    const Pose base_T_root = tree.pose(base, values).inverse();
    for (int k = 0; k <= last; ++k) {
      const LinkShapes& body = shapes.links[static_cast<std::size_t>(k)];
      EXPECT_EQ(body.name, "l" + std::to_string(k));
      const Vector3 expected =
          base_T_root * (tree.pose(k, values) * tree.links[static_cast<std::size_t>(k)].centre);
      const Vector3 found = frames[body.link] * body.shapes.at(0).pose.translation();
      EXPECT_LT((expected - found).norm(), 1e-9) << body.name;
      if (k == 0) continue;
      // The two links of a joint share it, if it is one of the arm.
      const LinkShapes& parent =
          shapes.links[static_cast<std::size_t>(tree.links[static_cast<std::size_t>(k)].parent)];
      const std::size_t distance =
          std::max(body.link, parent.link) - std::min(body.link, parent.link);
      const LinkShapes& later = body.link > parent.link ? body : parent;
      const LinkShapes& earlier = body.link > parent.link ? parent : body;
      EXPECT_TRUE(distance == 0 || (later.at_proximal_joint && earlier.at_distal_joint));
    }
    std::size_t proximal = 0, distal = 0;
    for (const LinkShapes& body : shapes.links) {
      proximal += body.at_proximal_joint ? 1 : 0;
      distal += body.at_distal_joint ? 1 : 0;
    }
    EXPECT_EQ(proximal, arm->joints().size()) << "one link behind each joint";
    EXPECT_EQ(distal, arm->joints().size()) << "one link in front of each joint";
  }
  EXPECT_GT(read, testing::cases(600) / 4);
}

std::string shaped_link(const std::string& name, const std::string& collision = "") {
  return "<link name=\"" + name + "\">" +
         (collision.empty() ? ""
                            : "<collision><geometry>" + collision + "</geometry></collision>") +
         "</link>\n";
}

std::string plain_joint(const std::string& name, const std::string& type, const std::string& parent,
                        const std::string& child, const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><axis xyz=\"0 0 1\"/>" + more + "</joint>\n";
}

const std::string ball_geometry = "<sphere radius=\"0.1\"/>";

ArmShapes robot_shapes(const std::string& robot, const ChainEnds& ends = {},
                       const std::map<std::string, double>& hold = {}) {
  return arm_shapes_from_text("<robot name=\"r\">\n" + robot + "</robot>", "r.urdf", ends,
                              {.hold = hold});
}

const std::string shaped_chain =
    shaped_link("a", ball_geometry) + shaped_link("b") + plain_joint("j", "continuous", "a", "b");

TEST(ArmShapes, HaveEveryKindOfUrdf) {
  const auto shape = [](const std::string& body) {
    return robot_shapes(shaped_link("a", body) + shaped_link("b") +
                        plain_joint("j", "continuous", "a", "b"))
        .links.at(0)
        .shapes.at(0);
  };
  EXPECT_EQ(std::get<Box>(shape("<box size=\"1 2 3\"/>").body).size.z(), 3);
  EXPECT_EQ(std::get<Cylinder>(shape("<cylinder radius=\"1\" length=\"2\"/>").body).length, 2);
  EXPECT_EQ(std::get<Capsule>(shape("<capsule radius=\"1\" length=\"2\"/>").body).length, 2);
  EXPECT_EQ(std::get<Sphere>(shape(ball_geometry).body).radius, 0.1);
  EXPECT_REFUSED(shape("<cone radius=\"1\"/>"), "r.urdf:2");
  EXPECT_REFUSED(shape("<cone radius=\"1\"/>"), "<cone>");
  EXPECT_REFUSED(shape("<sphere radius=\"-1\"/>"), "-1 m");
  EXPECT_REFUSED(shape("<sphere/>"), "radius");
  EXPECT_REFUSED(shape("<box size=\"1 2\"/>"), "size");
  EXPECT_REFUSED(robot_shapes("<link name=\"a\"><collision/></link>" + shaped_link("b") +
                              plain_joint("j", "continuous", "a", "b")),
                 "without geometry");
}

TEST(ArmShapes, AreHeldBesideTheChain) {
  const std::string limit = "<limit lower=\"0.2\" upper=\"0.9\"/>";
  const std::string finger =
      shaped_link("f", ball_geometry) + shaped_link("g", ball_geometry) +
      plain_joint("slide", "prismatic", "b", "f", limit) +
      plain_joint("other", "prismatic", "b", "g",
                  "<mimic joint=\"slide\" multiplier=\"-1\" offset=\"0.1\"/>");
  const ChainEnds to_b{.base = "a", .tip = "b"};
  ArmShapes shapes = robot_shapes(shaped_chain + finger, to_b);
  EXPECT_EQ(shapes.held, (std::map<std::string, double>{{"other", -0.1}, {"slide", 0.2}}));
  EXPECT_NEAR(shapes.links.at(2).shapes.at(0).pose.translation().z(), -0.1, 1e-12);
  // Of each body the joints that can be held: not the one that follows.
  EXPECT_TRUE(shapes.links.at(0).held.empty());
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(shapes.links.at(i).held, (std::map<std::string, double>{{"slide", 0.2}}));
  }
  shapes = robot_shapes(shaped_chain + finger, to_b, {{"slide", 0.5}});
  EXPECT_NEAR(shapes.held.at("other"), -0.4, 1e-12);
  EXPECT_REFUSED(robot_shapes(shaped_chain + finger, to_b, {{"slide", 1}}), "outside its limits");
  EXPECT_REFUSED(robot_shapes(shaped_chain + finger, to_b, {{"other", 0}}), "slide");
  EXPECT_REFUSED(robot_shapes(shaped_chain + finger, to_b, {{"slidd", 0}}), "slide");
  EXPECT_REFUSED(robot_shapes(shaped_chain, to_b, {{"j", 0}}), "cannot be held");
  EXPECT_TRUE(
      robot_shapes(shaped_chain + shaped_link("f") + plain_joint("slide", "prismatic", "b", "f"),
                   to_b)
          .held.empty())
      << "it carries no shape";
}

TEST(ArmShapes, AreRefusedWhereTheyCannotBePlaced) {
  const ChainEnds to_b{.base = "a", .tip = "b"};
  EXPECT_REFUSED(robot_shapes(shaped_chain + shaped_link("f", ball_geometry), to_b),
                 "no joint connects it");
  const std::string follower =
      plain_joint("m", "continuous", "a", "f", "<mimic joint=\"j\" multiplier=\"2\"/>");
  EXPECT_REFUSED(robot_shapes(shaped_chain + shaped_link("f", ball_geometry) + follower, to_b),
                 "moves with it");
  EXPECT_NO_THROW(robot_shapes(shaped_chain + shaped_link("f") + follower, to_b));
}

TEST(ArmShapes, AreReadInTheFormatOfTheEnding) {
  EXPECT_REFUSED(arm_shapes_from_text("{}", "arm.txt"),
                 "arm.txt: is not a known kind of arm file; known are .urdf, .xml, "
                 ".mjcf, .xacro, .json");
  const std::string json = arm_to_json(built_in("rrr"));
  EXPECT_TRUE(arm_shapes_from_text(json, "arm.JSON").links.empty());
  EXPECT_REFUSED(arm_shapes_from_text(json, "arm.xml"), "arm.xml:");
  EXPECT_REFUSED(arm_shapes_from_text(json, "arm.json", {.base = "", .tip = "hand"}),
                 "\"arm.json\" is not one");
}

TEST(ArmShapes, AreASectionOfArmFiles) {
  const auto read = [](const std::string& shapes) {
    return arm_shapes_from_text(
               "{\"name\": \"a\", \"joint_string\": \"RRR\", \"shapes\": " + shapes + "}", "a.json")
        .links;
  };
  const auto links = read(R"([{"shapes": [{"sphere": {"radius": 1}}]},
      {"joint": "joint2", "shapes": []},
      {"joint": "joint3", "name": "camera", "attached": true, "shapes": []}])");
  ASSERT_EQ(links.size(), 3);
  EXPECT_EQ(links[0].name, "base");
  EXPECT_EQ(links[0].link, 0);
  EXPECT_EQ(links[1].name, "joint2");
  EXPECT_EQ(links[1].link, 2);
  EXPECT_TRUE(links[1].at_proximal_joint && links[1].at_distal_joint);
  EXPECT_EQ(links[2].name, "camera");
  EXPECT_FALSE(links[2].at_proximal_joint || links[2].at_distal_joint);
  EXPECT_REFUSED(read(R"([{"joint": "joint4", "shapes": []}])"), "shapes[0].joint");
  EXPECT_REFUSED(read(R"([{"joint": "joint2"}])"), "shapes");
  EXPECT_REFUSED(read(R"([{"link": "joint2", "shapes": []}])"), "link");
  EXPECT_REFUSED(read(R"([{"shapes": []}, {"shapes": []}])"), "base");
  EXPECT_REFUSED(read(R"([{"shapes": [{"sphere": {"radius": -1}}]}])"), "shapes[0].shapes[0]");
  EXPECT_TRUE(read_arm_shapes("fr3").links.empty());
  EXPECT_TRUE(read_arm_shapes("RRR").links.empty());
  EXPECT_REFUSED(read_arm_shapes("pandda"), "panda");
  EXPECT_REFUSED(read_arm_shapes("panda", {}, {.hold = {{"finger", 0}}}), "URDF");
}

/// The leader of the fingers is held at the value of a state; --hold and limits come first.
TEST(ArmShapes, HoldJointsAtTheFirstNamedStateWithinTheLimits) {
  const testing::TemporaryFolder folder;
  const std::string robot =
      shaped_chain + shaped_link("left", ball_geometry) + shaped_link("right", ball_geometry) +
      plain_joint("l", "prismatic", "b", "left", "<limit lower=\"0.01\" upper=\"0.04\"/>") +
      plain_joint("r", "prismatic", "b", "right",
                  "<limit lower=\"-1\" upper=\"1\"/><mimic joint=\"l\" multiplier=\"-2\"/>");
  const auto shapes = [&](const std::string& states,
                          const std::map<std::string, double>& hold = {}) {
    const std::string srdf = folder.write("r.srdf", "<robot name=\"r\">" + states + "</robot>");
    return arm_shapes_from_text("<robot name=\"r\">\n" + robot + "</robot>", "r.urdf", {.tip = "b"},
                                {.hold = hold, .srdf = srdf});
  };
  const auto state = [](const std::string& name, const std::string& joint, const char* value) {
    return "<group_state name=\"" + name + "\" group=\"g\"><joint name=\"" + joint + "\" value=\"" +
           value + "\"/></group_state>";
  };
  using Values = std::map<std::string, double>;
  using States = std::map<std::string, std::string>;
  const std::string states = state("home", "j", "1") + state("beyond", "l", "0.05") +
                             state("several", "l", "0.03 0.03") + state("open", "l", "0.03") +
                             state("close", "l", "0.01") + state("other", "r", "0.5");
  EXPECT_EQ(shapes(states).held, (Values{{"l", 0.03}, {"r", -0.06}}));
  EXPECT_EQ(shapes(states).held_by_state, (States{{"l", "open"}, {"r", "open"}}));
  EXPECT_EQ(shapes(states, {{"l", 0.02}}).held, (Values{{"l", 0.02}, {"r", -0.04}}));
  EXPECT_TRUE(shapes(states, {{"l", 0.02}}).held_by_state.empty());
  EXPECT_EQ(shapes(state("home", "j", "1")).held, (Values{{"l", 0.01}, {"r", -0.02}}));
  EXPECT_TRUE(shapes(state("home", "j", "1")).held_by_state.empty());
}

TEST(ArmShapes, OfAToolAreInItsFrame) {
  const testing::TemporaryFolder folder;
  const Arm arm = with_tool(arm_from_joint_string("RR"), make_pose({0, 0, 0.5}));
  const std::string path = folder.file("tool.json");
  folder.write("tool.json", R"({"name": "gripper", "shapes": [{"sphere": {"radius": 0.1},
                       "pose": {"xyz": [0, 0, 0.25]}}]})");
  const LinkShapes tool = read_tool_shapes(path, arm);
  EXPECT_EQ(tool.name, "gripper");
  EXPECT_EQ(tool.link, 2);
  EXPECT_FALSE(tool.at_proximal_joint);
  EXPECT_EQ(tool.shapes.at(0).pose.translation().z(), 0.75);
  folder.write("tool.json", R"({"shapes": [{"cube": {}}]})");
  EXPECT_REFUSED(read_tool_shapes(path, arm), "cube");
  folder.write("tool.json", R"({"shapes": []})");
  EXPECT_REFUSED(read_tool_shapes(path, arm), "has no shape");
}

/// The page makes the model again of its files.
TEST(ArmShapes, FilesOfAModelHaveItsPairs) {
  const Arm arm = built_in("ur5");
  std::vector<LinkShapes> links = read_arm_shapes("ur5").links;
  links.push_back({"finger", 3, {{Sphere{0.1}}}, true, false});
  const Scene scene{.obstacles = {{.name = "ball",
                                   .shapes = {{Sphere{0.1}, Pose(Eigen::Translation3d(1, 0, 0))}}},
                                  {.name = "box", .shapes = {{Box{Vector3::Ones()}}}}},
                    .allowed_pairs = {{"box", links[2].name}}};
  const std::vector<NamedPair> allowed{{"ball", "finger"}, {links[1].name, links[4].name}};
  for (const bool self : {true, false}) {
    const CollisionOptions options{
        .self_collision = self, .allowed_pairs = allowed, .budget = {.max_work = 0}};
    const CollisionModel model(arm, links, scene, options);
    const auto [arm_text, scene_text] = collision_files(model);
    const CollisionModel again(arm_from_json(arm_text, "a.json"),
                               arm_shapes_from_text(arm_text, "a.json").links,
                               scene_from_json(scene_text, "s.json"), {.budget = {.max_work = 0}});
    EXPECT_EQ(again.pair_count(), model.pair_count());
    EXPECT_EQ(digest(again), digest(model));
  }
}

/// A body that is fixed to a link elsewhere than at its joints counts with the neighbouring links.
TEST(ArmShapes, AttachedBodiesCountWithTheirNeighbours) {
  const Arm arm = arm_from_joint_string("RR");
  std::vector<LinkShapes> links{{"upper", 1, {{Sphere{0.1}}}}, {"lower", 2, {{Sphere{0.1}}}}};
  const CollisionOptions all_pairs{.budget = {.max_work = 0}};
  EXPECT_EQ(CollisionModel(arm, links, {}, all_pairs).pair_count(), 0);
  links.push_back({"camera", 2, {{Sphere{0.1}}}, false, false});
  EXPECT_EQ(CollisionModel(arm, links, {}, all_pairs).pair_count(), 1);
}

TEST(ArmShapes, AreWrittenInArmFiles) {
  int shaped = 0;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    std::vector<LinkShapes> links = read_arm_shapes(name).links;
    if (links.empty()) {
      EXPECT_EQ(arm_to_json(arm, links), arm_to_json(arm));
      continue;
    }
    ++shaped;
    links.push_back({"camera", 2, {{Sphere{0.1}}}, false, false});
    const std::string text = arm_to_json(arm, links);
    const auto read = arm_shapes_from_text(text, "a.json").links;
    ASSERT_EQ(read.size(), links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      EXPECT_EQ(read[i].name, links[i].name);
      EXPECT_EQ(read[i].at_distal_joint, links[i].at_distal_joint);
    }
    const CollisionOptions all_pairs{.budget = {.max_work = 0}};
    EXPECT_EQ(digest(CollisionModel(arm_from_json(text, "a.json"), read, {}, all_pairs)),
              digest(CollisionModel(arm, links, {}, all_pairs)))
        << name;
  }
  EXPECT_GE(shaped, 8);
  const Arm ur5 = built_in("ur5");
  const std::vector<LinkShapes> half{{"base", 0, {{Sphere{0.1}}}, false, true},
                                     {"finger", 1, {{Sphere{0.1}}}, true, false},
                                     {"hand", 6, {{Sphere{0.1}}}, true, false}};
  const auto read = arm_shapes_from_text(arm_to_json(ur5, half), "a.json").links;
  EXPECT_TRUE(read.at(0).at_distal_joint && read.at(2).at_proximal_joint);
  EXPECT_FALSE(read.at(1).at_proximal_joint || read.at(1).at_distal_joint);
  EXPECT_REFUSED(arm_to_json(ur5, {{"hand", 7, {{Sphere{0.1}}}}}), "links 0 to 6");
  EXPECT_REFUSED(arm_to_json(ur5, {half[0], half[0]}), "\"base\"");
}

}  // namespace
}  // namespace beeline
