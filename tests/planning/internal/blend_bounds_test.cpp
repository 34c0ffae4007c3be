#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/line_blends.h>
#include <beeline/planning/internal/motion_along.h>
#include <beeline/planning/internal/program_completion.h>
#include <beeline/planning/internal/waypoint_passages.h>

#include <tests/planning/joint_blend_promises.h>

namespace beeline::internal {
namespace {

using namespace beeline::testing;

/// Joint moves of a ur5 with blends, each of another joint.
Program joint_moves(Random& random, Configuration q, int count) {
  Program program;
  for (int k = 0; k < count; ++k) {
    q[k % 3] += (random.integer(0, 1) == 0 ? 1 : -1) * random.uniform(0.5, 0.9);
    program.moves.push_back({.kind = MoveKind::joint, .q = q, .blend = 0.05});
  }
  program.moves.back().blend = 0;
  return program;
}

// Each chain is tried, also after the refusals of others.
TEST(BlendBounds, EveryChainIsTriedOnce) {
  Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < cases(4); ++i) {
    const Configuration start = near_middle(random, arm, 0.2);
    const Program program = joint_moves(random, start, 3);
    PathMotionOptions options;
    options.task = default_task(arm);
    const ProgramMotion stops = move_program(arm, start, beeline::testing::with_stops(program));
    ASSERT_TRUE(stops) << stops;
    const std::vector<ProgramPart> parts =
        program_parts(arm, program, 0, forward_kinematics(arm, start), Limits::none);
    const std::vector<PlannedPart> paths;
    const PlannedProgram planned{arm,   program, stops.trajectory, stops.moves,
                                 parts, paths,   options};
    std::vector<ChainPart> chain;
    for (std::size_t k = 0; k < 3; ++k) {
      std::optional<ChainPart> part = chain_part(planned, {k, k}, unlimited());
      ASSERT_TRUE(part);
      chain.push_back(std::move(*part));
    }
    const std::vector<double> largest{largest_radius(planned, chain[0], chain[1]),
                                      largest_radius(planned, chain[1], chain[2])};
    BlendRefusals refusals;
    while (refusals.any_left()) refusals.count();
    BlendChain last(planned, chain, largest, nullptr, refusals, unlimited());
    const std::optional<BlendedMotion> motion = last.motion();
    ASSERT_TRUE(motion);
    EXPECT_GT(motion->radii[0], 0);
  }
}

// The blends before the one that is refused stay, also where the search for a part ends.
TEST(BlendBounds, TheBlendsBeforeARefusedOneStay) {
  const Arm arm = built_in("scara");
  Program program;
  for (const auto& [x, y] : {std::pair(0.3, 0.1), {0.4, 0.1}, {0.4, 0.2}, {0.3, 0.2}, {0.3, 0.3}}) {
    program.moves.push_back(
        {.target = make_pose(Vector3(x, y, 0), Rotation::Identity()), .blend = 0.01});
  }
  program.moves.back().blend = 0;
  std::vector<ProgramPart> parts =
      program_parts(arm, program, 1, program.moves[0].target, Limits::none);
  LineBlends blends;
  int times = 0;
  for (;; ++times) {
    blends.refuse(0, {2});
    if (!blends.make_smaller(program, Limits::none, parts)) break;
  }
  EXPECT_GE(times, 10);
  EXPECT_EQ(parts[0].blend_scales, (std::vector<double>{1, 0, 0, 0}));
}

// With smaller blends there would be no fewer samples.
TEST(BlendBounds, NoBlendIsRefusedForTheNumberOfSamples) {
  const Arm arm = built_in("scara");
  Configuration q = middle_configuration(arm);
  q[1] += 1.5;  // bent
  const Pose here = forward_kinematics(arm, q);
  Program program;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {-0.05, 0.0}, {-0.05, 0.05}}) {
    Pose target = here;
    target.translation() += Vector3(x, y, 0);
    program.moves.push_back({.target = target, .blend = 0.01});
  }
  program.moves.back().blend = 0;
  const ProgramPart part = program_parts(arm, program, 1, here, Limits::none)[0];
  PathMotionOptions few, fast;
  few.max_samples = 10;
  fast.max_samples = 80;
  fast.rate = 1000;
  for (const PathMotionOptions& options : {few, fast}) {
    const PathMotion refused = motion_along(arm, q, part.route, options);
    EXPECT_EQ(refused.status, MotionStatus::too_many_samples) << refused;
    EXPECT_TRUE(refused_blends(arm, part, refused, {1e-4, 1e-3}).empty()) << refused;
  }
}

// Before the search for blends has ended, the motion with stops that is not proved refuses nothing.
TEST(BlendBounds, AnEndedSearchRefusesNoProgram) {
  Random random;
  const Arm arm = built_in("ur5");
  const Configuration start = near_middle(random, arm, 0.2);
  Program program = joint_moves(random, start, 4);
  const ProgramMotion stops = move_program(arm, start, beeline::testing::with_stops(program));
  ASSERT_TRUE(stops) << stops;
  program.moves[1].speed = 0.5 * stops.moves[1].tool_speed;  // which the motion exceeds
  PathMotionOptions options;
  options.task = default_task(arm);
  const std::vector<ProgramPart> parts =
      program_parts(arm, program, 0, forward_kinematics(arm, start), Limits::none);
  const DividedProgram divided{arm, program, options, parts, nullptr};
  int ended = 0;
  const auto completed = [&](std::int64_t work, Ending& ending) {
    Budget limits;
    limits.max_work = work;
    BudgetMeter budget(limits);
    ProgramMotion motion = stops;
    const Completion completion = complete_program(divided, {}, budget, motion);
    ending = budget.complete() ? motion.search_ending : budget.ending();
    ended += budget.complete() && ending != Ending::complete;
    return completion;
  };
  Ending ending = Ending::complete;
  const Completion whole = completed(std::int64_t{1} << 40, ending);
  EXPECT_EQ(ending, Ending::complete);
  for (std::int64_t work = 64; work < (1 << 22); work += work / 8) {
    const Completion found = completed(work, ending);
    if (ending == Ending::complete) break;
    EXPECT_FALSE(found.refusal) << work;
  }
  EXPECT_TRUE(whole.proved || whole.refusal);
  EXPECT_GE(ended, 1);
}

TEST(WaypointPassages, TheNearestSampleOfAStayIsNotARestBeforeIt) {
  const Arm arm = built_in("scara");
  Configuration q = middle_configuration(arm);
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  const auto append = [&](double angle) {
    motion.times.push_back(static_cast<double>(motion.size()));
    Configuration at = q;
    at[0] += angle;
    motion.positions.push_back(at);
  };
  for (const double angle : {-0.05, -0.05, -0.03, -0.01, 0.02, 0.05}) append(angle);
  std::vector<Pose> tool;
  for (const Configuration& at : motion.positions) tool.push_back(forward_kinematics(arm, at));
  const Task task = default_task(arm);
  const WaypointPassages passages(arm, motion, task, tool, unlimited());
  const Move move{.target = forward_kinematics(arm, q), .blend = 0.2};
  const std::optional<NearestSample> nearest = passages.nearest(move, 0);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->sample, 3u);
  EXPECT_LE(nearest->distance, 1e-3);
}

// One sample near a waypoint is a trajectory, too.
TEST(WaypointPassages, OfOneSample) {
  const Arm arm = built_in("scara");
  const Pose here = forward_kinematics(arm, middle_configuration(arm));
  const auto at = [&](double x, double y) {
    return make_pose(here.translation() + Vector3(x, y, 0), here.linear());
  };
  Program program;
  program.moves = {
      {.target = at(-0.1, 0)}, {.target = at(0, 0.01), .blend = 0.05}, {.target = at(0.1, 0)}};
  for (const bool moving : {false, true}) {
    Trajectory one{arm.joint_names(), {0}, {middle_configuration(arm)}, {}, {}};
    if (moving) one.velocities.push_back(Configuration::Ones(arm.dof()));
    EXPECT_FALSE(verify(arm, one, program));
    for (Move& move : program.moves) move.blend *= 1e306;  // still finite
    EXPECT_FALSE(verify(arm, one, program));
    program.moves[1].blend = 0.05;
  }
}

// The tool follows a line, but not as far as a large blend after it allows it to leave.
TEST(VerifyProgram, ALineThatIsNotFollowedFarEnoughIsNotReached) {
  const Arm arm = built_in("scara");
  Configuration q = middle_configuration(arm);
  q[1] += 1.5;  // bent
  const Pose here = forward_kinematics(arm, q);
  const auto at = [&](double y) {
    return make_pose(here.translation() + Vector3(0, y, 0), here.linear());
  };
  Program part;
  part.moves = {{.target = at(0)}, {.target = at(0.03)}};
  const ProgramMotion motion = move_program(arm, std::nullopt, part);
  ASSERT_TRUE(motion) << motion;
  Program program;
  program.moves = {
      {.target = at(0)}, {.target = at(0.1), .blend = 0.2}, {.kind = MoveKind::joint, .q = q}};
  const Verification found = verify(arm, motion.trajectory, program);
  EXPECT_EQ(found.fault, Fault::not_through) << found;
  EXPECT_EQ(found.reason.find(ReasonField::limit), nullptr);
  const ReasonValue* const distance = found.reason.find(ReasonField::distance);
  ASSERT_NE(distance, nullptr) << found;
  EXPECT_NEAR(std::get<double>(*distance), 0.07, 1e-3);
}

}  // namespace
}  // namespace beeline::internal
