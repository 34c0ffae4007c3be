#include <gtest/gtest.h>

#include <beeline/path/internal/joint_path_derivatives.h>

#include <tests/path/random_joint_path.h>

namespace beeline::internal {
namespace {

TEST(PathDerivatives, AreTheDerivativesOfThePath) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const int joints = random.integer(1, 9);
    const JointPath path = testing::random_path(random, joints, random.integer(2, 6));
    const PathDerivatives rates(path);
    ASSERT_EQ(rates.joints(), std::size_t(joints));
    ASSERT_EQ(rates.steps(), path.size() - 1);
    const auto step = std::size_t(random.integer(0, int(path.size()) - 2));
    const double share = random.uniform(0, 1);
    Configuration dq(joints), ddq(joints), dddq(joints);
    rates.at(step, share, dq.data(), ddq.data(), dddq.data());
    const PathPoint point = path_point(path, step, share);
    ASSERT_LT((dq - point.dq).norm(), 1e-10);
    ASSERT_LT((ddq - point.ddq).norm(), 1e-7);
    ASSERT_LT((dddq - point.dddq).norm(), 1e-3 * (1 + point.dddq.norm()));
  }
}

}  // namespace
}  // namespace beeline::internal
