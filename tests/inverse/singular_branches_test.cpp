#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/decompositions.h>
#include <beeline/model/catalog.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/families.h>

// At a singular pose solutions are infinitely many or coincide. `all` gives one of every branch: a
// search from many random starts finds none from which the arm could not move to one of those
// given, with the tool at rest and within limits.

namespace beeline {
namespace {

using std::numbers::pi;
using testing::Random;

enum class Singularity { one, wrist, wrist_and_another };

double determinant(const Arm& arm, Configuration q, int k, double value) {
  q[k] = value;
  return jacobian(arm, q).determinant();
}

/// A configuration within limits with another value of coordinate k, at which the determinant of
/// the Jacobian changes its sign; nothing if none is found.
std::optional<Configuration> singular_in(const Arm& arm, Configuration q, int k, Random& random) {
  constexpr int intervals = 24;
  const double lower = std::max(arm.limits(k).lower, -pi),
               upper = std::min(arm.limits(k).upper, pi);
  std::vector<double> roots;
  for (int i = 0; i < intervals; ++i) {
    double a = lower + (upper - lower) * i / intervals;
    double b = lower + (upper - lower) * (i + 1) / intervals;
    if (determinant(arm, q, k, a) * determinant(arm, q, k, b) >= 0) continue;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (a + b) / 2;
      (determinant(arm, q, k, a) * determinant(arm, q, k, middle) > 0 ? a : b) = middle;
    }
    roots.push_back((a + b) / 2);
  }
  if (roots.empty()) return std::nullopt;
  q[k] = roots[static_cast<std::size_t>(random.integer(0, static_cast<int>(roots.size()) - 1))];
  return q;
}

/// A random singular configuration within limits.
std::optional<Configuration> singular(const Arm& arm, Singularity wanted, Random& random) {
  Configuration q = random.configuration(arm);
  if (wanted != Singularity::wrist) {
    const auto found = singular_in(arm, q, random.integer(1, 2), random);
    if (!found) return std::nullopt;
    q = *found;
  }
  if (wanted != Singularity::one) {
    const Limits& limits = arm.limits(4);
    const double straight[] = {0, pi, -pi};
    const double value = straight[random.integer(0, 2)];
    q[4] = value >= limits.lower && value <= limits.upper ? value : 0;
  }
  return q;
}

/// The directions in which the joints can move with the tool at rest, to first order.
Eigen::MatrixXd null_space(const Arm& arm, const Configuration& q) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian(arm, q), Eigen::ComputeFullV);
  int rank = 0;
  while (rank < q.size() && svd.singularValues()[rank] > 1e-5 * svd.singularValues()[0]) ++rank;
  return svd.matrixV().rightCols(q.size() - rank);
}

class SelfMotion {
 public:
  SelfMotion(const Arm& arm, const Pose& pose, const std::vector<Configuration>& given)
      : arm_(arm), pose_(pose), given_(given), bounds_(internal::bounds_of(arm)) {}

  /// Whether the arm can move from q to a solution that is given, by postures that have a
  /// representative within limits.
  bool reaches_given(const Configuration& q) const {
    constexpr double merged = 2e-3;  // solutions that coincide are found to the root of rounding
    if (testing::holds(arm_, given_, q, merged) || reaches(q)) return true;
    return std::any_of(given_.begin(), given_.end(), [&](const Configuration& each) {
      const auto exact = corrected(with_coordinates_of(each, q));
      return exact && reaches(*exact);
    });
  }

 private:
  /// q with the coordinates of a solution given that differ from it by the root of rounding.
  static Configuration with_coordinates_of(const Configuration& given, Configuration q) {
    constexpr double root_of_rounding = 1e-4;
    for (int k = 0; k < q.size(); ++k) {
      const double difference = std::remainder(given[k] - q[k], 2 * pi);
      if (std::abs(difference) < root_of_rounding) q[k] += difference;
    }
    return q;
  }

  bool reaches(const Configuration& q) const {
    const Eigen::MatrixXd free = null_space(arm_, q);
    if (free.cols() == 0) return false;
    // The last direction has the least singular value.
    return follows(q, free.rightCols(1)) || follows(q, -free.rightCols(1)) || homes(q);
  }

  std::optional<Configuration> corrected(const Configuration& q) const {
    const internal::NumericalResult run =
        internal::levenberg_marquardt(arm_, pose_, Task::spatial(), internal::no_bounds(arm_), q,
                                      {.tolerance = 1e-12, .max_iterations = 300});
    if (!run.converged || (run.q - q).norm() > 0.05) return std::nullopt;
    const Configuration shown = internal::nearest_representative(arm_, run.q, run.q, bounds_);
    if (internal::excess(bounds_, shown) > 1e-6) return std::nullopt;
    return run.q;
  }

  /// Follows the curve of solutions in a direction.
  bool follows(Configuration q, Configuration direction) const {
    constexpr double step = 0.02;
    const Configuration start = q;
    for (int i = 0; i < 1500; ++i) {
      const auto next = corrected(q + step * direction);
      if (!next || (*next - q).norm() < step / 4) return false;
      const Eigen::MatrixXd free = null_space(arm_, *next);
      if (free.cols() == 0) return false;
      const Configuration along = free.rightCols(1);
      direction = along.dot(*next - q) > 0 ? along : -along;
      q = *next;
      if (testing::holds(arm_, given_, q, 2 * step)) return true;
      if (i > 5 && (q - start).norm() < step) return false;  // closed
    }
    return false;
  }

  /// Moves towards each of the solutions that are given, as far as the tool remains at rest.
  bool homes(const Configuration& from) const {
    return std::any_of(given_.begin(), given_.end(), [&](const Configuration& to) {
      Configuration q = from;
      double last = Limits::none;
      for (int i = 0; i < 600; ++i) {
        Configuration difference = to - q;
        for (int k = 0; k < q.size(); ++k) {
          if (!arm_.periodic(k)) continue;
          difference[k] -= 2 * pi * std::round(difference[k] / (2 * pi));
        }
        const double distance = difference.cwiseAbs().maxCoeff();
        if (distance < 0.04) return true;
        if (i % 50 == 0) {
          if (distance > last - 1e-3) return false;
          last = distance;
        }
        const Eigen::MatrixXd free = null_space(arm_, q);
        Configuration move = free * (free.transpose() * difference);
        move *= std::min(1.0, 0.03 / std::max(move.norm(), 1e-12));
        const auto next = corrected(q + move);
        if (!next) return false;
        q = *next;
      }
      return false;
    });
  }

  const Arm& arm_;
  const Pose& pose_;
  const std::vector<Configuration>& given_;
  internal::Bounds bounds_;
};

struct Count {
  int poses = 0, complete = 0, missing = 0;
};

/// Whether `all` represents the branch of q and, with a number of random starts, those that a
/// search finds. At poses with two singularities a search converges to 1e-6 rad only, too far from
/// the solutions to follow them.
void compare(const Arm& arm, const Configuration& q, int starts, Random& random, Count& count) {
  const Pose pose = forward_kinematics(arm, q);
  InverseOptions options{.all = true};
  if (random.integer(0, 1)) options.seed = random.configuration(arm);
  const InverseResult result = inverse_kinematics(arm, pose, options);
  testing::expect_solved(arm, pose, Task::spatial(), result);
  const SelfMotion motion(arm, pose, result.solutions);
  ++count.poses;
  count.complete += result.branches_complete;
  bool missing = !motion.reaches_given(q);
  Configuration lost = q;
  for (int start = 0; start < starts && !missing; ++start) {
    const internal::NumericalResult run = internal::levenberg_marquardt(
        arm, pose, Task::spatial(), internal::bounds_of(arm), random.configuration(arm),
        {.tolerance = 1e-13, .max_iterations = 200});
    if (!run.converged) continue;
    missing = !motion.reaches_given(run.q);
    lost = run.q;
  }
  count.missing += missing;
  EXPECT_FALSE(missing && result.branches_complete)
      << arm.name() << " pose of " << q.transpose() << " lacks " << lost.transpose();
}

class SingularBranches : public ::testing::TestWithParam<const char*> {};

TEST_P(SingularBranches, AreAllRepresented) {
  const Arm arm = built_in(GetParam());
  Random random;
  for (const Singularity wanted :
       {Singularity::one, Singularity::wrist, Singularity::wrist_and_another}) {
    Count count;
    for (int i = 0; i < testing::cases(testing::example_size(30)); ++i) {
      const auto q = singular(arm, wanted, random);
      const int starts = wanted == Singularity::wrist_and_another ? 0 : testing::example_size(60);
      if (q) compare(arm, *q, starts, random, count);
    }
    std::cout << arm.name() << ": " << count.poses << " poses, " << count.complete
              << " with branches_complete, " << count.missing << " with a branch missing\n";
    EXPECT_LE(count.missing, count.poses / 50);
  }
}

INSTANTIATE_TEST_SUITE_P(, SingularBranches,
                         ::testing::Values("puma560", "kr6_r900", "irb120", "stanford", "ur5",
                                           "cr5", "crx10ia", "xarm6", "hc10"));

/// Away from singularities the closed forms of three axes that meet or are parallel have all
/// solutions, among them the configuration of the pose.
TEST(RegularPoses, AreCompleteWithTheirConfiguration) {
  Random random;
  for (const char* name : {"puma560", "kr6_r900", "irb120", "stanford", "ur5", "cr5"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(300); ++i) {
      const Configuration q = random.configuration(arm);
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian(arm, q));
      if (svd.singularValues()[5] < 0.01 * svd.singularValues()[0]) continue;
      const InverseResult result =
          inverse_kinematics(arm, forward_kinematics(arm, q), {.all = true});
      ASSERT_TRUE(result.complete && result.branches_complete) << name << ' ' << q.transpose();
      ASSERT_TRUE(testing::holds(arm, result.solutions, q)) << name << ' ' << q.transpose();
    }
  }
}

/// Angles of 0 and of a quarter or half turn, which people choose, often make zeros of the closed
/// form multiple. `complete` is never true without the configuration of the pose.
TEST(RightAngles, AreAmongCompleteSolutions) {
  Random random;
  for (const char* name : {"hc10", "crx10ia", "jaco2"}) {
    const Arm arm = built_in(name);
    int complete = 0;
    for (int i = 0; i < testing::cases(testing::example_size(9000)); ++i) {
      Configuration q = random.configuration(arm);
      for (double& each : q) {
        if (random.integer(0, 3) > 0) each = pi / 2 * std::round(2 * each / pi);
      }
      if (!within(internal::bounds_of(arm), q)) continue;
      const InverseResult result =
          inverse_kinematics(arm, forward_kinematics(arm, q), {.all = true, .max_restarts = 0});
      complete += result.complete;
      constexpr double merged = 2e-3;
      EXPECT_TRUE(!result.complete || testing::holds(arm, result.solutions, q, merged))
          << name << ' ' << q.transpose();
    }
    EXPECT_GT(complete, 0) << name;
  }
}

/// Where several solutions coincide, all configurations within the root of rounding solve the pose.
TEST(CoincidingSolutions, AreGivenOnce) {
  for (const char* name : {"gen3_lite", "crx10ia"}) {
    const Arm arm = built_in(name);
    const Configuration zero = Configuration::Zero(arm.dof());
    const InverseResult result =
        inverse_kinematics(arm, forward_kinematics(arm, zero), {.all = true});
    const auto near_zero = [](const Configuration& q) { return q.cwiseAbs().maxCoeff() < 1e-3; };
    EXPECT_EQ(std::count_if(result.solutions.begin(), result.solutions.end(), near_zero), 1)
        << name;
  }
}

/// The seed solves the pose, and the closed form loses it to rounding next to a singularity.
TEST(SeedThatIsASolution, ComesFirst) {
  Random random;
  for (const char* name : {"puma560", "ur5", "crx10ia", "panda"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(testing::slow_build ? 20 : 60); ++i) {
      Configuration q = random.configuration(arm);
      for (double& each : q) {
        if (random.integer(0, 1)) each = pi / 2 * std::round(2 * each / pi);
      }
      if (!within(internal::bounds_of(arm), q)) continue;
      for (const bool all : {false, true}) {
        if (all && arm.dof() > 6) continue;
        const InverseResult result =
            inverse_kinematics(arm, forward_kinematics(arm, q), {.seed = q, .all = all});
        ASSERT_TRUE(result) << name << ' ' << q.transpose();
        EXPECT_LE((result.solutions[0] - q).cwiseAbs().maxCoeff(), 1e-12) << name;
      }
    }
  }
}

}  // namespace
}  // namespace beeline
