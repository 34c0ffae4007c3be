#include <beeline/kinematics/forward.h>
#include <beeline/planning/program.h>

#include <tests/collision/random_model.h>
#include <tests/planning/gantry.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

/// The motion of a program and the samples at which its moves end.
struct Moved {
  Trajectory trajectory;
  std::vector<std::size_t> arrivals = {};
};

Moved moved(const Arm& arm, const Configuration& start, const Program& program) {
  const ProgramMotion motion = move_program(arm, start, program);
  EXPECT_TRUE(motion) << motion.reason;
  Moved result{motion.trajectory};
  for (const PlannedMove& move : motion.moves) result.arrivals.push_back(move.end);
  return result;
}

ClearanceProof proof_of(const CollisionModel& model, const Moved& motion, const Program& program,
                        bool closest = false) {
  return prove_clearance(model, motion.trajectory, program, motion.arrivals, {.closest = closest});
}

TEST(Attachments, ThePartIsSweptAndNamedByTheRefusal) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const auto answer = [&](double lift, bool attaches) {
    const Program program = gantry.pick(lift, {"table"}, attaches);
    return proof_of(model, moved(gantry.arm, gantry.above, program), program);
  };
  EXPECT_TRUE(answer(0.45, true));
  // The gripper passes 0.01 m above the wall's top, the part 0.2 m below.
  const ClearanceProof refused = answer(0.2, true);
  ASSERT_EQ(refused.status, ClearanceStatus::collides);
  EXPECT_EQ(refused.pair.names, (NamedPair{"part", "wall"}));
  EXPECT_EQ(field<std::size_t>(refused.reason, ReasonField::move), 3u);
  EXPECT_EQ(field<std::string>(refused.reason, ReasonField::move_name), "move 3 (joint)");
  EXPECT_TRUE(answer(0.2, false)) << "the same program without its attachment";
}

TEST(Attachments, TheScenesOfAProgramHaveThePartWhereItIs) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const Program program = gantry.pick(0.45, {"table"});
  const Moved motion = moved(gantry.arm, gantry.above, program);
  const auto scenes = program_scenes(model, motion.trajectory, program, motion.arrivals);
  ASSERT_EQ(scenes.size(), 3U);
  EXPECT_EQ(scenes[0].begin, 0);
  EXPECT_EQ(scenes[1].begin, motion.trajectory.times[motion.arrivals[0]]);
  EXPECT_EQ(scenes[2].begin, motion.trajectory.times[motion.arrivals[3]]);
  EXPECT_EQ(digest(scenes[0].model), digest(model));
  const auto part_in = [](const CollisionModel& at) -> Vector3 {
    for (const Obstacle& one : at.scene().obstacles) {
      if (one.name == "part") return one.shapes.front().pose.translation();
    }
    return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  };
  EXPECT_EQ(part_in(scenes[0].model), Vector3(0, 0, 0.1));
  EXPECT_TRUE(part_in(scenes[1].model).hasNaN());
  ASSERT_EQ(scenes[1].model.links().size(), 2U);
  EXPECT_EQ(scenes[1].model.links()[1].name, "part");
  EXPECT_LT((part_in(scenes[2].model) - Vector3(1, 0, 0.1)).norm(), 1e-12);
  EXPECT_REFUSED(program_scenes(model, motion.trajectory, program, {}), "arrivals");
}

TEST(Attachments, TouchExemptsOnlyWhatItNames) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const auto answer = [&](const std::vector<std::string>& touch) {
    const Program program = gantry.pick(0.45, touch);
    return proof_of(model, moved(gantry.arm, gantry.above, program), program);
  };
  EXPECT_TRUE(answer({"table"}));
  EXPECT_TRUE(answer({"wall", "table"}));
  for (const auto& touch : std::vector<std::vector<std::string>>{{}, {"wall"}, {"gripper"}}) {
    const ClearanceProof refused = answer(touch);
    ASSERT_EQ(refused.status, ClearanceStatus::collides);
    EXPECT_EQ(refused.pair.names, (NamedPair{"part", "table"}));
    EXPECT_EQ(field<std::string>(refused.reason, ReasonField::move_name), "attach part");
  }
  const Program low = gantry.pick(0.2, {"wall", "table"});
  EXPECT_TRUE(proof_of(model, moved(gantry.arm, gantry.above, low), low));
  Gantry allowed = gantry;
  allowed.scene.allowed_pairs = {{"part", "table"}};
  const Program program = gantry.pick(0.45, {});
  EXPECT_TRUE(proof_of(allowed.model(), moved(gantry.arm, gantry.above, program), program));
}

TEST(Attachments, ThePartIsAnObstacleWhereItWasLeft) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const auto answer = [&](double x) {
    Program program = gantry.pick(0.45, {"table"});
    program.moves.push_back(joint_move(Configuration{{x, 0, 1}}));
    program.moves.push_back(joint_move(Configuration{{x, 0, 0.1}}));
    return proof_of(model, moved(gantry.arm, gantry.above, program), program);
  };
  EXPECT_TRUE(answer(0)) << "where the part was";
  const ClearanceProof refused = answer(1);
  ASSERT_EQ(refused.status, ClearanceStatus::collides);
  EXPECT_EQ(refused.pair.names, (NamedPair{"gripper", "part"}));
  EXPECT_EQ(field<std::size_t>(refused.reason, ReasonField::move), 7u);
  // Without the attachment it is the other way round.
  Program program = gantry.pick(0.45, {}, false);
  program.moves.push_back(joint_move(Configuration{{1, 0, 0.1}}));
  EXPECT_TRUE(proof_of(model, moved(gantry.arm, gantry.above, program), program));
}

TEST(Attachments, APartThatIsLeftInTheGripperIsRefusedThere) {
  const Gantry gantry;
  Program program = gantry.pick(0.45, {"table"});
  program.attachments[0].until = 5;  // the gripper is 0.01 m above the part
  const CollisionModel wide(gantry.arm, gantry.links, gantry.scene, {.clearance = 5e-3});
  EXPECT_TRUE(proof_of(wide, moved(gantry.arm, gantry.above, program), program));
  Scene scene = gantry.scene;
  program.moves.erase(program.moves.begin(), program.moves.begin() + 1);
  program.attachments[0] = {.part = "part", .until = 4};
  scene.obstacles.erase(scene.obstacles.begin() + 1, scene.obstacles.end());
  const CollisionModel model(gantry.arm, gantry.links, scene, {.clearance = 0.02});
  const ClearanceProof refused =
      proof_of(model, moved(gantry.arm, Configuration{{0, 0, 0.21}}, program), program);
  ASSERT_EQ(refused.status, ClearanceStatus::collides);
  EXPECT_EQ(field<std::string>(refused.reason, ReasonField::move_name), "detach part");
  EXPECT_EQ(refused.time, refused.begin);
}

TEST(Attachments, APartAtTheEndIsProvedThere) {
  const Gantry gantry;
  Program program;
  program.moves = {joint_move(Configuration{{0, 0, 0.21}})};
  program.attachments = {{.part = "part", .after = 1}};
  const Moved motion = moved(gantry.arm, gantry.above, program);
  const ClearanceProof refused = proof_of(gantry.model(), motion, program);
  EXPECT_EQ(refused.status, ClearanceStatus::collides);
  EXPECT_EQ(refused.time, motion.trajectory.times.back());
  program.attachments[0].touch = {"table"};
  EXPECT_TRUE(proof_of(gantry.model(), motion, program));
}

/// Moves of a random arm between random configurations.
Program random_moves(Random& random, const Arm& arm, int count) {
  Program program;
  for (int i = 0; i < count; ++i) {
    const Configuration middle = middle_configuration(arm);
    program.moves.push_back(joint_move(middle + 0.3 * (random.configuration(arm) - middle)));
  }
  return program;
}

TEST(Attachments, AProofWithAPartIsThatOfAnArmWhoseToolHasItsShapes) {
  Random random;
  // Else it depends on the budget which pairs are found to keep their clearance.
  const CollisionOptions options{.budget = {}};
  int clear = 0, colliding = 0;
  for (int i = 0; i < testing::cases(100); ++i) {
    const Arm arm = random_arm(random, random.integer(2, 5));
    const auto links = random_link_shapes(random, arm, 0.05);
    Scene scene = random_scene(random, arm, 8, 0.4, 4);
    const Program moves = random_moves(random, arm, 3);
    const Configuration start = middle_configuration(arm);
    const Moved motion = moved(arm, start, moves);
    const Pose world_T_tool = forward_kinematics(arm, start);
    for (Obstacle& obstacle : scene.obstacles) {  // beside the tool
      const auto at = static_cast<std::size_t>(random.integer(0, 2));
      const Pose tool = forward_kinematics(arm, motion.trajectory.positions[motion.arrivals[at]]);
      const Vector3 beside = 0.3 * random.vector();
      for (Shape& shape : obstacle.shapes) {
        const Vector3 offset = shape.pose.translation() - arm.base().translation();
        shape.pose.translation() = tool.translation() + beside + 0.2 * offset;
      }
    }
    LinkShapes tool{.name = "part", .link = arm.joints().size(), .shapes = {}};
    tool.at_proximal_joint = tool.at_distal_joint = false;
    Obstacle part{.name = "part"};
    for (int k = 0; k < 2; ++k) {
      Shape shape = random_shape(random, place_of<Box>(), 0.1, 0.3);
      const Pose tool_T_shape = shape.pose;
      shape.pose = arm.tool() * tool_T_shape;
      tool.shapes.push_back(shape);
      shape.pose = world_T_tool * tool_T_shape;
      part.shapes.push_back(shape);
    }
    std::vector<LinkShapes> with_tool = links;
    with_tool.push_back(tool);
    const ClearanceProof expected = prove_clearance(CollisionModel(arm, with_tool, scene, options),
                                                    motion.trajectory, {.closest = true});
    scene.obstacles.insert(scene.obstacles.begin() + random.integer(0, 8), part);
    Program program = moves;
    program.attachments = {{.part = "part"}};
    const ClearanceProof found =
        proof_of(CollisionModel(arm, links, scene, options), motion, program, true);
    EXPECT_EQ(found.status, expected.status) << i << ": " << found << " " << expected;
    EXPECT_EQ(found.pairs, expected.pairs);
    (expected ? clear : colliding) += 1;
    if (!expected || !found) continue;
    EXPECT_NEAR(found.pair.upper, expected.pair.upper, 1e-6);
    // Both are raised in steps, which rounding may change.
    EXPECT_NEAR(found.least_distance, expected.least_distance, 0.03 * expected.pair.upper);
  }
  EXPECT_GT(clear, testing::cases(100) / 20);
  EXPECT_GT(colliding, testing::cases(100) / 20);
}

TEST(Attachments, ThePoseInTheWorldIsKeptByAttachingAndDetaching) {
  Random random;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Arm arm = random_arm(random, random.integer(1, 6));
    Scene scene;
    scene.obstacles = {{.name = "part", .shapes = {random_shape(random, place_of<Box>(), 0.1, 2)}}};
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.05), scene);
    Program program = random_moves(random, arm, 5);
    program.attachments = {{.part = "part", .after = 4},  // in any order
                           {.part = "part", .after = 1, .until = 3}};
    const Moved motion = moved(arm, middle_configuration(arm), program);
    const auto attached = attached_parts(model, motion.trajectory, program, motion.arrivals);
    ASSERT_EQ(attached.size(), 2u);
    const auto tool_after = [&](std::size_t moves) {
      return forward_kinematics(arm, motion.trajectory.positions[motion.arrivals[moves - 1]]);
    };
    const Pose before = tool_after(1) * attached[1].tool_T_part;
    EXPECT_LT((before.matrix() - scene.obstacles[0].shapes[0].pose.matrix()).norm(), 1e-12);
    const Pose left = tool_after(3) * attached[1].tool_T_part;
    EXPECT_LT(((tool_after(4) * attached[0].tool_T_part).matrix() - left.matrix()).norm(), 1e-12);
    EXPECT_EQ(attached[1].attached, motion.trajectory.times[motion.arrivals[0]]);
    EXPECT_EQ(attached[1].detached, motion.trajectory.times[motion.arrivals[2]]);
    EXPECT_FALSE(attached[0].detached);
  }
}

TEST(Attachments, TheDistanceOverTimeIsThatOfTheSections) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const Program program = gantry.pick(0.45, {"table"});
  const Moved motion = moved(gantry.arm, gantry.above, program);
  const ClearanceOverTime found =
      clearance_over_time(model, motion.trajectory, program, motion.arrivals);
  ASSERT_EQ(found.times.size(), found.proved.size() + 1);
  EXPECT_EQ(found.times.front(), motion.trajectory.times.front());
  EXPECT_EQ(found.times.back(), motion.trajectory.times.back());
  EXPECT_TRUE(std::is_sorted(found.times.begin(), found.times.end()));
  const ClearanceProof proof = proof_of(model, motion, program, true);
  const double least = *std::min_element(found.sampled.begin(), found.sampled.end());
  EXPECT_NEAR(least, proof.pair.upper - proof.pair.clearance, 2e-3);
  EXPECT_GT(*std::min_element(found.proved.begin(), found.proved.end()), 0);
}

TEST(Attachments, ProofsOfProgramsWithoutThemAreThoseOfTheTrajectory) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  for (const double lift : {0.45, -0.1}) {
    const Program program = gantry.pick(lift, {}, false);
    const Moved motion = moved(gantry.arm, gantry.above, program);
    const ClearanceProof found = proof_of(model, motion, program, true);
    const ClearanceProof expected = prove_clearance(model, motion.trajectory, {.closest = true});
    EXPECT_EQ(found.status, expected.status);
    EXPECT_EQ(found.least_distance, expected.least_distance);
    EXPECT_EQ(found.time, expected.time);
    EXPECT_EQ(found.parts, expected.parts);
    EXPECT_EQ(found.reason.has(ReasonField::move), !expected);
  }
}

TEST(Attachments, ABudgetEndsTheProof) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const Program program = gantry.pick(0.45, {"table"});
  const Moved motion = moved(gantry.arm, gantry.above, program);
  const ClearanceProof ended = prove_clearance(model, motion.trajectory, program, motion.arrivals,
                                               {.budget = {.max_work = 3}});
  EXPECT_EQ(ended.status, ClearanceStatus::work_limit);
  EXPECT_EQ(ended.reason.code, ReasonCode::ended_before_check);
}

TEST(Attachments, AreRefusedWithTheirName) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const Program valid = gantry.pick(0.45, {"table"});
  const Moved motion = moved(gantry.arm, gantry.above, valid);
  const auto planned = [&](const std::vector<Attachment>& attachments) {
    Program program = valid;
    program.attachments = attachments;
    return refusal([&] { move_program(gantry.arm, gantry.above, program); });
  };
  const auto proved = [&](const Attachment& attachment) {
    Program program = valid;
    program.attachments = {attachment};
    return refusal([&] { proof_of(model, motion, program); });
  };
  using List = std::vector<Attachment>;
  EXPECT_EQ(planned({{.part = "part", .after = 5}}), "accepted");
  EXPECT_EQ(planned({{.part = "part", .after = 0, .until = 2}, {.part = "part", .after = 2}}),
            "accepted");
  const std::pair<List, const char*> cases[] = {
      {{{.part = ""}}, "attach : a part has no name"},
      {{{.part = "part", .after = 6}}, "attach part: the program has 5 moves, not 6"},
      {{{.part = "part", .after = 1, .until = 6, .place = "p.csv:3"}},
       "attach part (p.csv:3): the program has 5 moves, not 6"},
      {{{.part = "part", .after = 2, .until = 2}}, "detached before a move carries it"},
      {{{.part = "part"}, {.part = "part", .after = 3}}, "attached already, by attach part"},
      {{{.part = "part", .after = 3}, {.part = "part", .until = 4}}, "attached already"}};
  for (const auto& [attachments, culprit] : cases) {
    EXPECT_NE(planned(attachments).find(culprit), std::string::npos) << planned(attachments);
  }
  const std::pair<Attachment, const char*> in_scene[] = {
      {{.part = "prt"}, "attach prt: unknown obstacle \"prt\"; did you mean \"part\"?"},
      {{.part = "gripper"}, "unknown obstacle \"gripper\""},
      {{.part = "part", .touch = {"tabel"}}, "unknown link or obstacle \"tabel\""},
      {{.part = "part", .touch = {"part"}}, "the part itself"}};
  for (const auto& [attachment, culprit] : in_scene) {
    EXPECT_NE(proved(attachment).find(culprit), std::string::npos) << proved(attachment);
  }
  Gantry floor = gantry;
  floor.scene.obstacles = {{.name = "floor", .shapes = {{HalfSpace()}}}};
  Program program = valid;
  program.attachments = {{.part = "floor"}};
  EXPECT_REFUSED(proof_of(floor.model(), motion, program), "a half_space cannot be carried");
  floor.scene.obstacles.clear();
  EXPECT_REFUSED(proof_of(floor.model(), motion, program), "no obstacle that could be attached");
  Moved wrong = motion;
  wrong.arrivals.pop_back();
  EXPECT_REFUSED(proof_of(model, wrong, valid), "arrivals must be a sample for each of the 5");
  wrong.arrivals.push_back(wrong.trajectory.size());
  EXPECT_REFUSED(proof_of(model, wrong, valid), "arrivals must be");
}

TEST(Attachments, NeedAStop) {
  const Gantry gantry;
  const auto line = [](double x, double z) {
    return Move{.target = make_pose({x, 0, z}, Rotation::Identity())};
  };
  Program program;
  program.moves = {line(0, 0.3), line(1, 0.3), line(1, 1)};
  program.moves[1].blend = 0.05;
  program.attachments = {{.part = "part", .after = 2}};
  EXPECT_REFUSED(move_program(gantry.arm, gantry.above, program, {.task = Task::position()}),
                 "attach part: the tool passes move 2 (line) without a stop; attaching a part");
  program.attachments = {{.part = "part", .after = 1, .until = 2}};
  EXPECT_REFUSED(move_program(gantry.arm, gantry.above, program, {.task = Task::position()}),
                 "detaching a part needs one");
}

}  // namespace
}  // namespace beeline
