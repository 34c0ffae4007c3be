#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/planning/internal/section_joint_path.h>

#include <tests/planning/random_branch.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::RandomBranch;

constexpr Deviation path_tolerance{1e-5, 1e-5};

/// The samples of a branch, a few for each segment, with their path parameters.
BranchSection few_samples(const Branch& branch, std::size_t most) {
  BranchSection section{{branch.start}, {0}};
  for (std::size_t i = 0; i < branch.segments.size(); ++i) {
    const TrackedSegment& segment = branch.segments[i];
    const std::size_t last = segment.samples.size() - 1, stride = 1 + last / most;
    for (std::size_t k = 1; k <= last; ++k) {
      if (k % stride != 0 && k < last) continue;
      section.samples.push_back(segment.samples[k]);
      section.path_parameters.push_back(double(i) + segment.fractions[k]);
    }
  }
  return section;
}

/// Calls check(random branch, its section path) for `count` branches, with at least so many samples
/// of each segment.
template <class Check>
void for_random_sections(int count, std::size_t samples, const Check& check) {
  Random random;
  constexpr const char* arms[] = {"puma560", "ur5", "panda", "rrr"};
  for (int found = 0, tried = 0; found < count; ++tried) {
    ASSERT_LT(tried, 50 * count) << "few paths are possible";
    const auto made = testing::random_branch(random, arms[tried % 4], {1e-3, 1e-3});
    if (!made) continue;
    Budget budget;
    BudgetMeter meter(budget);
    const MotionRequest request{made->arm,
                                std::nullopt,
                                made->route,
                                {.task = made->task},
                                {},
                                {.tolerance = 100 * path_tolerance.position,
                                 .orientation_tolerance = 100 * path_tolerance.orientation}};
    const SectionJointPath section(request, few_samples(made->branch, samples), meter);
    ++found;
    check(*made, section);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

Pose tool_at(const RandomBranch& made, const JointPath& path, std::size_t step, double u) {
  return forward_kinematics(made.arm, path_point(path, step, u).q);
}

/// Position and orientation errors from the tool path's pose at s.
Deviation error_at(const RandomBranch& made, const Pose& tool, double s) {
  return task_deviation(made.task, pose_at(made.route.path, s), tool);
}

TEST(SectionJointPath, StaysWithinTheToleranceAtThePathParameter) {
  Deviation worst;
  for_random_sections(testing::cases(40), 8,
                      [&](const RandomBranch& made, const SectionJointPath& section) {
                        const JointPath& path = section.joint_path();
                        double before = 0;
                        for (std::size_t step = 0; step + 1 < path.size(); ++step) {
                          for (double u = 0.05; u < 1; u += 0.1) {
                            const double s = std::lerp(path.s[step], path.s[step + 1], u);
                            const Configuration q = path_point(path, step, u).q;
                            const double parameter = section.path_parameter(q, s, 0);
                            ASSERT_GE(parameter, before - 1e-9);
                            before = parameter;
                            grow(worst, error_at(made, forward_kinematics(made.arm, q), parameter));
                          }
                        }
                        ASSERT_NEAR(before, double(made.route.path.segments.size()), 0.5);
                      });
  std::cout << "largest deviation " << worst << '\n';
  EXPECT_LE(worst.position, 1.5 * path_tolerance.position);
  EXPECT_LE(worst.orientation, 1.5 * path_tolerance.orientation);
}

TEST(SectionJointPath, PathParameterIsThatOfTheNearestPoint) {
  double worst = 0;
  for_random_sections(
      testing::cases(20), 8, [&](const RandomBranch& made, const SectionJointPath& section) {
        const JointPath& path = section.joint_path();
        for (std::size_t step = 0; step + 1 < path.size(); step += 3) {
          const double u = 0.37, s = std::lerp(path.s[step], path.s[step + 1], u);
          const Configuration q = path_point(path, step, u).q;
          const Pose tool = forward_kinematics(made.arm, q);
          const double parameter = section.path_parameter(q, s, 0);
          const auto distance = [&](double at) {
            const Pose pose = pose_at(made.route.path,
                                      std::clamp(at, 0.0, double(made.route.path.segments.size())));
            return (pose.translation() - tool.translation()).norm();
          };
          double nearest = distance(parameter);
          for (int i = -500; i <= 500; ++i) {
            nearest = std::min(nearest, distance(parameter + 1e-3 * std::pow(i / 500.0, 3)));
          }
          worst = std::max(worst, distance(parameter) - nearest);
        }
      });
  std::cout << "largest distance beyond the nearest point's " << worst << " m\n";
  EXPECT_LE(worst, path_tolerance.position);
}

// The tool's velocity and acceleration along the joint path equal those along the tool path for
// some rates of its parameter: first and second differences of forward kinematics, both sides.
TEST(SectionJointPath, FollowsTangentAndCurvatureOfTheToolPathAtTheSamples) {
  double worst_tangent = 0, worst_curvature = 0;
  for_random_sections(
      testing::cases(30), 8, [&](const RandomBranch& made, const SectionJointPath& section) {
        const JointPath& path = section.joint_path();
        const double end = double(made.route.path.segments.size());
        for (std::size_t k = 1; k + 1 < path.size(); ++k) {
          const double d = 1e-3 * std::min(path.s[k + 1] - path.s[k], path.s[k] - path.s[k - 1]);
          const Pose now = forward_kinematics(made.arm, path.q[k]);
          const Twist left =
              pose_difference(tool_at(made, path, k - 1, 1 - d / (path.s[k] - path.s[k - 1])), now);
          const Twist right =
              pose_difference(tool_at(made, path, k, d / (path.s[k + 1] - path.s[k])), now);
          const Twist first = (right - left) / (2 * d), second = (right + left) / (d * d);
          const double s = section.path_parameter(path.q[k], path.s[k], 0);
          if (s >= end) continue;
          const std::size_t i = segment_at(made.route.path, s);
          const PoseMotion motion = motion_at(made.route.path.segments[i], s - double(i));
          const Twist& along = motion.velocity;
          const double rate = first.dot(along) / along.squaredNorm();
          const Twist across = first - rate * along;
          const Twist curvature = second - rate * rate * motion.acceleration;
          const Twist rest = curvature - curvature.dot(along) / along.squaredNorm() * along;
          worst_tangent = std::max(worst_tangent, across.norm() / first.norm());
          worst_curvature = std::max(worst_curvature, rest.norm() / (1 + second.norm()));
        }
      });
  std::cout << "tangent " << worst_tangent << ", curvature " << worst_curvature << '\n';
  EXPECT_LE(worst_tangent, 1e-5);
  EXPECT_LE(worst_curvature, 1e-2);
}

/// The largest jump of the third derivative at grid points inside segments, relative to the largest
/// third derivative. Where segments meet, the third derivative of the tool path jumps too.
double largest_jump(const SectionJointPath& section) {
  const JointPath& path = section.joint_path();
  const std::vector<double> ends = section.segment_ends();
  double largest = 0, jump = 0;
  for (std::size_t k = 1; k + 1 < path.size(); ++k) {
    const Configuration left = path_point(path, k - 1, 1).dddq;
    const Configuration right = path_point(path, k, 0).dddq;
    largest = std::max({largest, left.norm(), right.norm()});
    const bool end = std::find(ends.begin(), ends.end(), path.s[k]) != ends.end();
    if (!end) jump = std::max(jump, (right - left).norm());
  }
  return largest > 0 ? jump / largest : 0;
}

TEST(SectionJointPath, ThirdDerivativesAreNearlyContinuousInsideMostSegments) {
  std::vector<double> jumps;
  for_random_sections(testing::cases(40), 32,
                      [&](const RandomBranch&, const SectionJointPath& section) {
                        jumps.push_back(largest_jump(section));
                      });
  std::sort(jumps.begin(), jumps.end());
  std::cout << "jumps of the third derivative, of the largest one: median "
            << jumps[jumps.size() / 2] << ", nine of ten " << jumps[jumps.size() * 9 / 10]
            << ", all " << jumps.back() << '\n';
  EXPECT_LE(jumps[jumps.size() / 2], 0.3);
}

}  // namespace
}  // namespace beeline::internal
