#include <gtest/gtest.h>

#include <beeline/control/internal/stop_proof.h>

#include <tests/control/servo_cell.h>

namespace beeline::internal {
namespace {

using testing::excess_at;
using testing::LoopLimits;

/// Lines of all lengths from configurations near the bodies. The distances on a proved line are
/// computed without the proof's memory.
void expect_proved_lines_to_keep(const std::string& name, const std::string& cell) {
  testing::Random random;
  const Arm arm = testing::loop_arm(name, LoopLimits::accelerations);
  const CollisionModel model = testing::loop_model(arm, name, testing::loop_scene(cell));
  StopProof proof(model.bodies(), 10);
  int proved = 0, in_parts = 0;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const Configuration q = random.configuration(arm);
    const double start = excess_at(model, q);
    if (!(start < 0.1)) continue;
    const Eigen::VectorXd line = random.uniform(0, 0.5) * (random.configuration(arm) - q);
    proof.begin_step(q);
    if (!proof.prove(q, line, 0.1, StopProof::Effort::all_pairs)) continue;
    ++proved;
    if (start < 0) continue;
    if (proof.parts() > 1) ++in_parts;
    for (double s = 0.05; s <= 1; s += 0.05) {
      ASSERT_GE(excess_at(model, q + s * line), -testing::distance_rounding) << i << ' ' << s;
    }
  }
  EXPECT_GT(proved, 0);
  EXPECT_GT(in_parts, 0);
}

TEST(StopProof, ProvedLinesKeepTheClearanceFromObstacles) {
  expect_proved_lines_to_keep("panda", "corner");
}

TEST(StopProof, ProvedLinesKeepTheClearanceOfLinks) {
  expect_proved_lines_to_keep("ur5e", "itself");
}

/// Bodies exactly at their clearance are not undecided: the arm can leave.
TEST(StopProof, ProvesTheWayOutFromTheClearance) {
  const Arm arm = testing::loop_arm("panda", LoopLimits::accelerations);
  Configuration q(7);
  q << 0, -0.3, 0, -2.2, 0, 2.0, 0.785;
  Scene scene = testing::loop_scene("wall");
  const double gap = nearest_pair(testing::loop_model(arm, "panda", scene), q).lower;
  Eigen::VectorXd line = Eigen::VectorXd::Zero(7);
  line[3] = -0.01;  // folds the elbow: away from the wall
  for (const double beyond : {-1e-3, -1e-9, -1e-12, 0.0, 1e-12, 1e-10, 1e-9, 1e-2}) {
    scene.obstacles[0].clearance = gap - beyond;
    const CollisionModel model = testing::loop_model(arm, "panda", scene);
    StopProof proof(model.bodies(), 10);
    proof.begin_step(q);
    EXPECT_TRUE(proof.prove(q, line, 0.01, StopProof::Effort::all_pairs)) << beyond;
    EXPECT_EQ(proof.prove(q, -line, 0.01, StopProof::Effort::all_pairs), beyond > 5e-3) << beyond;
  }
}

/// The nearest of more pairs than a line may have, the last of which by index are nearest.
TEST(StopProof, HoldsTheNearestOfTooManyPairs) {
  const Arm arm = testing::loop_arm("panda", LoopLimits::accelerations);
  Configuration q(7);
  q << 0, -0.3, 0, -2.2, 0, 2.0, 0.785;
  Scene scene;
  for (int i = 0; i < 400; ++i) {
    const std::string name = std::to_string(i);
    scene.obstacles.push_back(testing::box_at(name, {0.1, 4, 4}, {0.8 - 5e-4 * i, 0, 0}));
  }
  const CollisionModel model = testing::loop_model(arm, "panda", scene);
  StopProof proof(model.bodies(), 10);
  proof.begin_step(q);
  Eigen::VectorXd line = Eigen::VectorXd::Zero(7);
  line[3] = 0.3;
  EXPECT_FALSE(proof.prove(q, line, 0.01, StopProof::Effort::all_pairs));
  ASSERT_EQ(proof.near().size(), 256U);
  const double nearest = nearest_pair(model, q).lower - 0.01;
  EXPECT_NEAR(proof.near()[0].excess, nearest, 1e-6);
  EXPECT_EQ(proof.violated_pair(), proof.near()[0].pair);
  EXPECT_EQ(proof.names(proof.near()[0].pair)[1], "399");
  for (std::size_t i = 1; i < 256; ++i) {
    ASSERT_LE(proof.near()[i - 1].excess, proof.near()[i].excess);
  }
}

}  // namespace
}  // namespace beeline::internal
