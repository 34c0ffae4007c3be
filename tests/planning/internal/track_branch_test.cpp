#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/internal/track_branch.h>

#include <tests/planning/dense_search.h>
#include <tests/planning/motion_promises.h>

namespace beeline::internal {
namespace {

using namespace testing;

Configuration joints(std::initializer_list<double> values) {
  Configuration q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.begin());
  return q;
}

std::vector<Branch> branches(const Arm& arm, const std::vector<Pose>& poses, bool reasons = false) {
  return track_branches(
      arm, lines_through(poses),
      {.task = default_task(arm),
       .reasons = reasons ? BranchOptions::Reasons::all : BranchOptions::Reasons::best});
}

Arm with_limits(const char* name, double lower, double upper) {
  std::vector<Joint> links = built_in(name).joints();
  for (Joint& joint : links) joint.limits = {.lower = lower, .upper = upper};
  return {name, links};
}

TEST(TrackBranches, GivesOneForEachSolutionOfTheFirstPoseTheBestFirst) {
  const Arm arm = built_in("ur5");
  const Pose from = forward_kinematics(arm, joints({0.2, -1.2, 1.5, -0.5, 1.2, 0}));
  Pose to = from;
  to.translation() += Vector3(0.05, 0.1, -0.08);
  const std::vector<Branch> all = branches(arm, {from, to, from}, true);
  const auto starts = inverse_kinematics(arm, from, {.all = true, .ignore_limits = true});
  ASSERT_EQ(all.size(), starts.solutions.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Branch& branch = all[i];
    EXPECT_EQ(!branch.reason, branch.status == MotionStatus::reached);
    EXPECT_LE(branch.path_parameter, all.front().path_parameter);
    if (branch.status != MotionStatus::reached) continue;
    EXPECT_EQ(branch.path_parameter, 2);
    ASSERT_EQ(branch.segments.size(), 2);
    EXPECT_EQ(branch.segments[0].samples.back(), branch.segments[1].samples.front());
    const Configuration& end = branch.segments[1].samples.back();
    EXPECT_LT((end - branch.start).lpNorm<Eigen::Infinity>(), 1e-7) << "there and back again";
  }
}

TEST(TrackBranches, ComesToAnEndWithoutLimitsAndWithFarOnes) {
  const double none = Limits::none;
  for (const auto& [lower, upper] :
       {std::pair{-none, none}, {-3.0, none}, {-none, 3.0}, {-1e6, 1e6}, {20.0, none}}) {
    const Arm arm = with_limits("ur5", lower, upper);
    const double turns = lower > 0 ? 8 * pi : 0;
    const Configuration q =
        joints({0.2, -1.2, 1.5, -0.5, 1.2, 0}) + Configuration::Constant(6, turns);
    const Pose from = forward_kinematics(arm, q);
    Pose to = from;
    to.translation().z() += 0.1;
    const std::vector<Branch> all = branches(arm, {from, to});
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.front().status, MotionStatus::reached) << all.front().reason;
  }
}

// A joint that rotates by 400 degrees along the path must start from the right multiple of 2 pi.
TEST(TrackBranches, BeginsAJointAtTheMultipleThatLastsLongest) {
  const Arm arm = built_in("ur5");  // +- 360 degrees
  const Pose first = forward_kinematics(arm, joints({0.2, -1.2, 1.5, -0.5, 1.2, 3.0}));
  std::vector<Pose> poses{first};
  for (int i = 1; i <= 4; ++i) {
    poses.push_back(first);
    poses.back().linear() = first.linear() * so3_exp(Vector3(0, 0, i * 100 * deg));
  }
  const std::vector<Branch> all = branches(arm, poses);
  ASSERT_EQ(all.front().status, MotionStatus::reached) << all.front().reason;
  const double turned = all.front().segments.back().samples.back()[5] - all.front().start[5];
  EXPECT_NEAR(turned, 400 * deg, 1e-6);
  EXPECT_LT(all.front().start[5], 0);
  EXPECT_GT(all.front().limit_margin, 0);
}

struct Singular {
  const char* name;
  std::vector<double> q;
};

// Through and past the straight wrist, with a rotation for which joint 5 changes its sign.
TEST(TrackBranches, PassesTheWristsSingularity) {
  const std::vector<Singular> places{{"puma560", {0.2, -0.6, 0.3, 0, 0, 0}},
                                     {"ur5", {0.3, -1.2, 1.5, -0.5, 0, 0.4}}};
  for (const auto& [name, values] : places) {
    const Arm arm = built_in(name);
    for (const double off : {0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
      const Configuration q = Eigen::Map<const Configuration>(values.data(), 6);
      Pose middle = forward_kinematics(arm, q);
      middle.linear() = so3_exp(off * middle.linear().col(0)) * middle.linear();
      Line line{middle, middle};
      const Vector3 turn(0.2, 0.3, 0.1), way(0.03, -0.05, 0.04);
      line.from.translation() -= way;
      line.from.linear() = so3_exp(turn) * middle.linear();
      line.to.translation() += way;
      line.to.linear() = so3_exp(-turn) * middle.linear();
      const PathMotion motion = move_in_lines(arm, std::vector<Pose>{line.from, line.to});
      ASSERT_EQ(motion.status, MotionStatus::reached) << name << ' ' << off << motion.reason;
      expect_straight(arm, motion.trajectory.positions.front(), {line.to}, [&] {
        PathMotion one = motion;
        one.arrivals = {one.arrivals.back()};
        return one;
      }());
      EXPECT_LT(motion.trajectory.times.back(), 60);
    }
  }
}

// At a singular beginning one solution represents infinitely many; the right one is found
// backwards.
TEST(TrackBranches, LeavesASingularBeginning) {
  Random random;
  for (const auto& [name, values] : std::vector<Singular>{
           {"puma560", {0.2, -0.6, 0.3, 0, 0, 0}}, {"ur5", {0.3, -1.2, 1.5, -0.5, 0, 0.4}}}) {
    const Arm arm = built_in(name);
    const Pose from = forward_kinematics(arm, Eigen::Map<const Configuration>(values.data(), 6));
    int solved = 0, possible = 0;
    for (int i = 0; i < 20; ++i) {
      Pose to = nearby_pose(random, arm, from);
      const PathMotion motion = move_in_lines(arm, std::vector<Pose>{from, to});
      solved += motion.status == MotionStatus::reached;
      possible += dense_branches(arm, to, from).feasible();
    }
    EXPECT_GE(solved, possible) << name;
    EXPECT_GT(solved, 0) << name;
  }
}

// The wrist's centre comes no nearer to axis 1 of ur5 than the shoulder's offset: a line that
// passes it at that distance is tracked, a nearer one is refused.
TEST(TrackBranches, PassesTheShoulderButNotThroughIt) {
  const Arm arm = built_in("ur5");
  const double offset = 0.10915, hand = 0.0823;
  for (const double off : {0.0, 1e-6, 1e-4, 1e-3, 1e-2, -1e-3, -0.1}) {
    Pose from = Pose::Identity();
    from.linear() = so3_exp(Vector3(0, pi, 0)) * so3_exp(Vector3(0.2, 0.1, 0));
    from.translation() = Vector3(offset + off, -0.15, 0.4) + hand * from.linear().col(2);
    Pose to = from;
    to.translation().y() += 0.3;
    const PathMotion motion = move_in_lines(arm, std::vector<Pose>{from, to});
    const auto expected = off >= 0 ? MotionStatus::reached : MotionStatus::unreachable;
    EXPECT_EQ(motion.status, expected) << off << ' ' << motion.reason;
    if (off >= 0) expect_within_limits(arm, motion.trajectory);
  }
}

}  // namespace
}  // namespace beeline::internal
