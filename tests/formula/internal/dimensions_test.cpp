#include <gtest/gtest.h>
#include <numbers>

#include <beeline/formula/internal/dimensions.h>
#include <beeline/formula/internal/symbolic_determinant.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

TEST(AxisRotations, AreTheRotation) {
  testing::Random random;
  for (int k = 0; k < testing::cases(2000); ++k) {
    const Rotation rotation = random.rotation();
    const std::vector<AxisRotation> found =
        axis_rotations(rotation, random.integer(0, 2), random.integer(0, 2), 1e-9);
    EXPECT_LE(found.size(), 3U);
    EXPECT_LT((product(found) - rotation).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// Products of up to three rotations by multiples of 15 degrees, most of which are in gimbal lock
/// for some decomposition, with the rounding of a file: at most one angle needs a name.
TEST(AxisRotations, FindMultiplesOf15Degrees) {
  testing::Random random;
  for (int k = 0; k < testing::cases(2000); ++k) {
    std::vector<AxisRotation> rotations{{2, random.integer(-12, 12) * std::numbers::pi / 12},
                                        {1, random.integer(-6, 6) * std::numbers::pi / 12},
                                        {0, random.integer(-12, 12) * std::numbers::pi / 12}};
    const Rotation exact = product(rotations);
    for (AxisRotation& rotation : rotations) rotation.angle += random.uniform(-1e-11, 1e-11);
    const std::vector<AxisRotation> found = axis_rotations(product(rotations), 2, 2, 1e-9);
    for (const AxisRotation& rotation : found) {
      EXPECT_TRUE(multiple_of_15_degrees(rotation.angle, 1e-15)) << rotation.angle;
    }
    EXPECT_LT((product(found) - exact).cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// The determinants of the blocks multiply to the determinant of the matrix, for random patterns of
/// zeros.
TEST(BlockForm, HasTheDeterminantOfTheMatrix) {
  testing::Random random;
  int split = 0;
  for (int k = 0; k < testing::cases(3000); ++k) {
    const int n = random.integer(1, 6);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Pattern pattern(static_cast<std::size_t>(n), std::vector<bool>(static_cast<std::size_t>(n)));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        if (random.integer(0, 2) != 0) continue;
        matrix(i, j) = random.uniform(-1, 1);
        pattern[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = true;
      }
    }
    const BlockForm form = block_form(pattern);
    double determinant = form.blocks.empty() ? 0 : form.sign;
    for (const Block& block : form.blocks) {
      determinant *= Eigen::MatrixXd(matrix(block.rows, block.columns)).determinant();
    }
    EXPECT_NEAR(determinant, matrix.determinant(), 1e-13);
    split += form.blocks.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(split, testing::cases(3000) / 30);
}

}  // namespace
}  // namespace beeline::internal
