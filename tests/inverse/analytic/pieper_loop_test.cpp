#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/analytic/pieper_branches.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/pose/so3.h>

#include <tests/inverse/families.h>

namespace beeline::internal {
namespace {

using testing::axes_with;
using testing::Axis;
using testing::example_size;
using testing::holds;
using testing::Random;
using Family = PieperLoop::Family;

using std::numbers::pi;

/// Joint types with a prismatic joint d or f (see PieperLoop); d follows the three special axes,
/// which start at `first`.
std::string with_prismatic(std::size_t first, bool d, bool f) {
  std::string letters = "RRRRRR";
  if (d) letters[(first + 3) % 6] = 'P';
  if (f) letters[(first + 5) % 6] = 'P';
  return letters;
}

std::string words(Family family, std::size_t first) {
  std::string text = family == Family::intersecting ? "three axes meet" : "three parallel axes";
  for (std::size_t i = 0; i < 3; ++i) {
    text += (i == 0 ? " (joints " : ", ") + std::to_string(first + i + 1);
  }
  return text + ")";
}

InverseResult all_solutions(const Arm& arm, const Pose& pose) {
  return inverse_kinematics(
      arm, pose, {.method = InverseMethod::closed_form, .all = true, .ignore_limits = true});
}

double largest_error(const Arm& arm, const Pose& pose, const InverseResult& result) {
  double largest = 0;
  for (const Configuration& q : result.solutions) {
    const Deviation left = task_deviation(Task::spatial(), pose, forward_kinematics(arm, q));
    largest = std::max({largest, left.position, left.orientation});
  }
  return largest;
}

/// Checks that random configurations are among the solutions of their poses, and that solutions are
/// exact, even in number and at most eight.
void expect_found(const Arm& arm, int poses, Random& random) {
  for (int i = 0; i < poses; ++i) {
    const Configuration from = random.configuration(arm);
    const Pose pose = forward_kinematics(arm, from);
    const InverseResult result = all_solutions(arm, pose);
    ASSERT_EQ(result.status, InverseStatus::solved) << result.method << ": " << result.reason;
    EXPECT_TRUE(holds(arm, result.solutions, from, 1e-4))
        << result.method << ' ' << from.transpose();
    EXPECT_EQ(result.solutions.size() % 2, 0U) << result.method << ' ' << from.transpose();
    EXPECT_LE(result.solutions.size(), 8U) << result.method;
    EXPECT_LE(largest_error(arm, pose, result), 1e-10) << result.method;
    EXPECT_FALSE(result.singular) << result.method;
  }
}

template <class Visit>
void for_each_family(Visit&& visit) {
  for (const Family family : {Family::intersecting, Family::parallel}) {
    for (std::size_t first = 0; first < 4; ++first) visit(family, first);
  }
}

TEST(PieperLoop, IsRecognisedWhateverTheLinkFrames) {
  Random random;
  for_each_family([&](Family family, std::size_t first) {
    for (int i = 0; i < example_size(100); ++i) {
      for (const double size : {1e-3, 1.0, 1e3}) {
        const auto axes = axes_with(family, first, "RRRRRR", random, size);
        const auto loop = pieper_loop(chain_of(arm_through(axes, random, size)));
        ASSERT_TRUE(loop) << words(family, first) << " of size " << size;
        EXPECT_EQ(loop->family, family);
        EXPECT_EQ(description(*loop), words(family, first));
      }
    }
  });
}

TEST(PieperLoop, IsRecognisedWithPrismaticJoints) {
  Random random;
  for_each_family([&](Family family, std::size_t first) {
    for (int slides = 1; slides < 3; ++slides) {
      const auto letters = with_prismatic(first, slides == 1, slides == 2);
      const auto axes = axes_with(family, first, letters, random);
      const auto loop = pieper_loop(chain_of(arm_through(axes, random)));
      ASSERT_TRUE(loop) << words(family, first) << ' ' << letters;
      EXPECT_EQ(description(*loop), words(family, first));
      EXPECT_EQ(loop->prismatic[0], slides == 1);
      EXPECT_EQ(loop->prismatic[2], slides == 2);
    }
  });
}

TEST(PieperLoop, RequiresThreeAxesThatIntersectOrAreParallel) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    std::vector<Axis> axes(6);
    for (Axis& axis : axes) axis = testing::random_axis(random);
    EXPECT_FALSE(pieper_loop(chain_of(arm_through(axes, random))));
  }
  for_each_family([&](Family family, std::size_t first) {
    for (int i = 0; i < 30; ++i) {  // an error of 1e-6 is too large
      auto axes = axes_with(family, first, "RRRRRR", random);
      axes[first + 1].point += 1e-6 * random.direction();
      axes[first + 1].direction = (axes[first + 1].direction + 1e-6 * random.direction());
      axes[first + 1].direction.normalize();
      EXPECT_FALSE(pieper_loop(chain_of(arm_through(axes, random)))) << words(family, first);
    }
  });
}

TEST(PieperLoop, FindsTheConfigurationOfAPose) {
  Random random;
  for_each_family([&](Family family, std::size_t first) {
    SCOPED_TRACE(words(family, first));
    for (int i = 0; i < example_size(40); ++i) {
      expect_found(arm_through(axes_with(family, first, "RRRRRR", random), random), 10, random);
    }
  });
}

TEST(PieperLoop, FindsItWithPrismaticJoints) {
  Random random;
  for_each_family([&](Family family, std::size_t first) {
    for (int slides = 1; slides < 3; ++slides) {
      const auto letters = with_prismatic(first, slides == 1, slides == 2);
      SCOPED_TRACE(words(family, first) + ' ' + letters);
      for (int i = 0; i < example_size(20); ++i) {
        expect_found(arm_through(axes_with(family, first, letters, random), random), 10, random);
      }
    }
  });
}

/// Most industrial arms have right angles and pairs of intersecting axes.
TEST(PieperLoop, FindsItForRightAngledArms) {
  Random random;
  int arms = 0;
  for_each_family([&](Family family, std::size_t first) {
    for (int i = 0; i < example_size(150); ++i) {
      std::vector<Axis> axes;
      const Vector3 centre(0.5, -0.25, 1);
      const int along = random.integer(0, 2);
      for (std::size_t k = 0; k < 6; ++k) {
        Axis axis{Vector3::Unit(random.integer(0, 2)), Vector3::Zero()};
        for (double& x : axis.point) x = 0.25 * random.integer(-3, 3);
        const bool special = k >= first && k < first + 3;
        if (special && family == Family::intersecting) axis.point = centre;
        if (special && family == Family::parallel) axis.direction = Vector3::Unit(along);
        axes.push_back(axis);
      }
      const Arm arm = arm_through(axes, random);
      // Some random arms are singular everywhere, and some have two coincident axes of the three.
      double determinant = 0;
      for (int k = 0; k < 5; ++k) {
        const auto j = jacobian(arm, random.configuration(arm), Frame::base);
        determinant = std::max(determinant, std::abs(j.determinant()));
      }
      const auto loop = pieper_loop(chain_of(arm));
      if (determinant < 1e-3 || !loop) continue;
      ++arms;
      SCOPED_TRACE(description(*loop));
      expect_found(arm, 3, random);
    }
  });
  EXPECT_GT(arms, example_size(200));
}

TEST(PieperLoop, FindsEverySolutionThatASearchFinds) {
  Random random;
  int equal = 0, poses = 0;
  for_each_family([&](Family family, std::size_t first) {
    for (int i = 0; i < 8; ++i) {
      const auto letters = with_prismatic(first, i == 0, i == 1);
      const Arm arm = arm_through(axes_with(family, first, letters, random), random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const InverseResult result = all_solutions(arm, pose);
      const auto found =
          search_all(arm, pose, Task::spatial(), result.solutions.size(), 1000, random);
      ++poses;
      equal += found.size() == result.solutions.size();
      for (const Configuration& q : found) {
        EXPECT_TRUE(holds(arm, result.solutions, q, 1e-4))
            << words(family, first) << ' ' << letters << ' ' << q.transpose();
      }
    }
  });
  EXPECT_GE(equal, 0.95 * poses) << "of " << poses;
}

TEST(PieperBranches, ReportLimitsAndDistanceFromTheSeed) {
  Random random;
  int branch_count = 0, exact = 0;
  for_each_family([&](Family family, std::size_t first) {
    for (int i = 0; i < 100; ++i) {
      const auto letters = with_prismatic(first, i % 3 == 1, i % 3 == 2);
      const Arm arm = arm_through(axes_with(family, first, letters, random), random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      PieperRequest question{};
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
          question.world_T_tool[4 * row + column] = pose(row, column);
        }
      }
      for (int k = 0; k < 6; ++k) {
        question.seed[k] = random.uniform(-8, 8);
        question.weight[k] = random.uniform(0.1, 2);
        question.lower[k] = random.uniform(-6, 0);
        question.upper[k] = random.uniform(0, 6);
        question.wraps[k] = kind(arm.joint_of(k)) == JointKind::revolute;
      }
      const auto loop = pieper_loop(chain_of(arm));
      PieperBranches branches;
      pieper_branches(*loop, question, branches);
      EXPECT_NE(branches.found, 0U);
      EXPECT_EQ(branches.within & ~branches.found, 0U);
      for (int lane = 0; lane < 8; ++lane) {
        if ((branches.found >> lane & 1) == 0) continue;
        Configuration q(6);
        double distance = 0, excess = 0;
        for (int k = 0; k < 6; ++k) {
          q[k] = branches.q[k][lane];
          distance += question.weight[k] * std::pow(q[k] - question.seed[k], 2);
          excess += std::max({question.lower[k] - q[k], q[k] - question.upper[k], 0.0});
          const bool inside = q[k] >= question.lower[k] && q[k] <= question.upper[k];
          if (!question.wraps[k]) continue;
          // No other multiple of 2 pi within limits is nearer.
          for (const double turns : {-3, -2, -1, 1, 2, 3}) {
            const double other = q[k] + 2 * pi * turns;
            if (other < question.lower[k] || other > question.upper[k]) continue;
            EXPECT_TRUE(inside);
            EXPECT_GE(std::abs(other - question.seed[k]), std::abs(q[k] - question.seed[k]) - 1e-9);
          }
        }
        EXPECT_EQ((branches.within >> lane & 1) != 0, excess == 0) << excess;
        EXPECT_NEAR(branches.excess[lane], excess, 1e-9);
        EXPECT_NEAR(branches.distance[lane], distance, 1e-9 * (1 + distance));
        ++branch_count;
        if (!(branches.residual[lane] < 1e-8)) continue;
        ++exact;
        const Deviation left = task_deviation(Task::spatial(), pose, forward_kinematics(arm, q));
        EXPECT_LE(left.position, 1e-7);
        EXPECT_LE(left.orientation, 1e-7);
      }
    }
  });
  EXPECT_GT(exact, 0.99 * branch_count) << "of " << branch_count;
}

}  // namespace
}  // namespace beeline::internal
