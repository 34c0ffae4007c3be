#include <beeline/planning/internal/layered_graph.h>

#include <tests/planning/motion_promises.h>

namespace beeline::internal {
namespace {

using namespace testing;

struct Case {
  Arm arm;
  Configuration q;
  std::vector<Pose> poses;
  Task task;
};

/// Two lines of an arm that is redundant, of 10 to 30 cm.
Case spare_case(Random& random, const std::string& name, const std::string& task = "spatial") {
  const Arm arm = built_in(name);
  const Configuration q = inner_configuration(random, arm);
  const Pose from = forward_kinematics(arm, q), to = nearby_pose(random, arm, from);
  return {arm, q, {from, to, from}, task_named(task)};
}

TEST(KnotSequence, LeadsThroughPosesOnTheLinesWithinLimits) {
  Random random;
  int through = 0;
  for (int i = 0; i < 12; ++i) {
    const Case a = i % 3 == 2 ? spare_case(random, "ur5", "111110:tool")
                              : spare_case(random, i % 3 == 0 ? "panda" : "iiwa14");
    const KnotSequence sequence =
        search_layered_graph(a.arm, lines_through(a.poses), {.task = a.task});
    ASSERT_FALSE(sequence.knots.empty());
    EXPECT_EQ(sequence.knots.front().s, 0);
    EXPECT_EQ(sequence.complete, sequence.knots.back().s == 2);
    through += sequence.complete;
    double before = -1;
    for (const Knot& knot : sequence.knots) {
      ASSERT_GT(knot.s, before);
      before = knot.s;
      const auto line = std::min<std::size_t>(1, static_cast<std::size_t>(knot.s));
      const Pose target =
          interpolate(a.poses[line], a.poses[line + 1], knot.s - static_cast<double>(line));
      const Deviation off = task_deviation(a.task, target, forward_kinematics(a.arm, knot.q));
      ASSERT_LT(off.position, 1e-8) << a.arm.name();
      ASSERT_LT(off.orientation, 1e-8) << a.arm.name();
      ASSERT_TRUE(limit_violations(a.arm, knot.q).empty());
    }
    for (std::size_t k = 1; k < sequence.knots.size(); ++k) {
      ASSERT_LT((sequence.knots[k].q - sequence.knots[k - 1].q).lpNorm<Eigen::Infinity>(), 1.5);
    }
  }
  EXPECT_GE(through, 6);
}

TEST(KnotSequence, BeginsAtTheStart) {
  Random random;
  for (int i = 0; i < 6; ++i) {
    const Case a = spare_case(random, "panda");
    const KnotSequence sequence =
        search_layered_graph(a.arm, lines_through(a.poses), {.task = a.task, .start = a.q});
    ASSERT_FALSE(sequence.knots.empty());
    EXPECT_EQ(sequence.knots.front().q, a.q);
  }
}

TEST(KnotSequence, EndsWhereSolutionsDo) {
  const Arm arm = built_in("panda");
  const Pose from = forward_kinematics(arm, inner_configuration(*std::make_unique<Random>(), arm));
  Pose to = from;
  to.translation().z() += 3;
  const KnotSequence sequence =
      search_layered_graph(arm, lines_through(std::vector{from, to}), {.task = Task::spatial()});
  EXPECT_FALSE(sequence.complete);
  EXPECT_LT(sequence.knots.back().s, 0.7);
  EXPECT_TRUE(
      search_layered_graph(arm, lines_through(std::vector{to, from}), {.task = Task::spatial()})
          .knots.empty());
}

// Costs are seconds squared. With the smallest velocity limits that an arm can have they are 1e17
// and more, and still order the paths through the graph.
TEST(LayeredGraph, AcceptsTheSmallestVelocityLimits) {
  std::vector<Joint> joints = built_in("panda").joints();
  for (Joint& joint : joints) joint.limits.velocity = Limits::min_rate;
  const Arm arm("slow", joints, built_in("panda").tool());
  const Configuration q{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, q);
  Pose to = from;
  to.translation() += Vector3(0.1, 0.1, -0.1);
  const KnotSequence sequence =
      search_layered_graph(arm, lines_through(std::vector{from, to}), {.task = Task::spatial()});
  EXPECT_TRUE(sequence.complete);
  for (const Knot& knot : sequence.knots) EXPECT_TRUE(knot.q.allFinite());
}

TEST(KnotSpline, InterpolatesItsKnotsSmoothly) {
  Random random;
  std::vector<Knot> knots;
  double place = 0;
  for (int i = 0; i < 9; ++i) {
    knots.push_back({place, (Configuration(2) << random.uniform(-1, 1), 2 - 3 * place).finished()});
    place += random.uniform(0.1, 0.6);
  }
  std::vector<Pose> poses;  // on lines of one metre
  for (int i = 0; i < 7; ++i) poses.push_back(make_pose({double(i), 0, 0}));
  const ToolPath path = lines_through(poses);
  const KnotSpline spline(knots, path);
  constexpr double h = 1e-6;
  for (const Knot& knot : knots) {
    EXPECT_LT((spline.at(knot.s) - knot.q).norm(), 1e-14);
    if (knot.s == 0 || knot.s == knots.back().s) continue;
    const Configuration left = (knot.q - spline.at(knot.s - h)) / h;
    const Configuration right = (spline.at(knot.s + h) - knot.q) / h;
    EXPECT_LT((left - right).norm(), 1e-3) << "one slope on both sides";
  }
  for (double p = 0; p < knots.back().s; p += 0.01) {
    EXPECT_NEAR(spline.at(p)[1], 2 - 3 * p, 1e-12) << "straight knots make a straight line";
  }
  EXPECT_LT((spline.at(0) - knots.front().q).norm(), 1e-15);
  EXPECT_LT((spline.at(6) - knots.back().q).norm(), 1e-14);
  EXPECT_EQ(KnotSpline({knots.front()}, path).at(3), knots.front().q);
}

// The end of a short segment next to a long one does not cause a kink.
TEST(KnotSpline, IsSmoothWhereSegmentsOfDifferentLengthMeet) {
  const std::vector<Pose> poses{make_pose({0, 0, 0}), make_pose({1, 0, 0}), make_pose({1.1, 0, 0})};
  const ToolPath path = lines_through(poses);
  std::vector<Knot> knots;
  for (const double place : {0.0, 0.4, 0.8, 1.0, 1.4, 2.0}) {
    knots.push_back({place, Configuration::Constant(1, std::pow(span_to(path, place), 2))});
  }
  const KnotSpline spline(knots, path);
  constexpr double h = 1e-6;
  const double left = (spline.at(1)[0] - spline.at(1 - h)[0]) / h;
  const double right = (spline.at(1 + 10 * h)[0] - spline.at(1)[0]) / h;
  EXPECT_NEAR(left, right, 1e-3);
  for (double place = 0; place <= 2; place += 0.01) {  // the parabola itself
    EXPECT_NEAR(spline.at(place)[0], std::pow(span_to(path, place), 2), 1e-9);
  }
}

}  // namespace
}  // namespace beeline::internal
