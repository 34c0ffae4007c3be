#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include <beeline/certificate/internal/interval_deviation.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/path/random_segment.h>
#include <tests/random.h>
#include <tests/random_arm.h>

namespace beeline::internal {
namespace {

constexpr int evaluations = 50;  // at which a motion is evaluated

Configuration at(const Interval& interval, double u) {
  Configuration q(static_cast<Eigen::Index>(interval.coordinates.size()));
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    q[k] = interval.coordinates[static_cast<std::size_t>(k)](u);
  }
  return q;
}

/// A motion of the joints by about `size` from a random configuration, along the whole segment.
Interval moving_interval(testing::Random& random, const Arm& arm, double size) {
  Interval interval;
  for (const double q : random.configuration(arm)) {
    Polynomial& p = interval.coordinates.emplace_back();
    p.c[0] = q;
    for (std::size_t k = 1; k < Polynomial::terms; ++k) p.c[k] = random.uniform(-size, size);
  }
  interval.s = quintic_between(0, 1, random.uniform(0, 2), random.uniform(0, 2), 0, 0);
  if (random.integer(0, 1) == 0) interval.s = interval.s.part(0.25, 0.75);
  return interval;
}

Deviation measured(const Arm& arm, const Segment& segment, const Task& task,
                   const Interval& interval, double u) {
  const double s = std::clamp(interval.s(u), 0.0, 1.0);
  return deviation_from(segment, s, forward_kinematics(arm, at(interval, u)), task);
}

/// Returns the ratio of bound to the largest deviation, and expects the bound to hold.
double expect_bound(const Arm& arm, const Segment& segment, const Task& task,
                    const Interval& interval) {
  const IntervalDeviation proved = interval_deviation(arm, segment, task, interval);
  Deviation largest;
  for (int i = 0; i <= evaluations; ++i) {
    grow(largest, measured(arm, segment, task, interval, double(i) / evaluations));
  }
  // A thousand times the rounding error, because log's derivative or a search magnifies it.
  EXPECT_LE(largest.position, proved.bound.position + 1e-9)
      << name(task) << " along a " << testing::kind_of(segment);
  EXPECT_LE(largest.orientation, proved.bound.orientation + 1e-9)
      << name(task) << " along a " << testing::kind_of(segment);
  EXPECT_LE(proved.measured.position, proved.bound.position);
  EXPECT_LE(proved.measured.orientation, proved.bound.orientation);
  return proved.bound.position / largest.position;
}

TEST(IntervalDeviation, HoldsForEverySegment) {
  testing::Random random;
  std::vector<double> ratios;
  for (int i = 0; i < 1000 && !::testing::Test::HasFailure(); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), random.integer(0, 3));
    const Segment segment = testing::random_segment(random);
    const Interval interval = moving_interval(random, arm, std::pow(10, random.uniform(-3, -0.5)));
    ratios.push_back(expect_bound(arm, segment, Task::spatial(), interval));
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 1.3);
  EXPECT_LT(ratios[ratios.size() * 9 / 10], 2);
}

const std::vector<std::string> task_names = {
    "spatial",     "position", "planar",      "111110:tool", "001000", "110001",
    "000111",      "000001",   "110111:tool", "001000:tool", "111001", "111110",
    "100100:tool", "000110",   "110110:tool", "101011:tool"};

TEST(IntervalDeviation, HoldsForEveryTaskOnLines) {
  testing::Random random;
  for (int i = 0; i < 1600 && !::testing::Test::HasFailure(); ++i) {
    const bool scara = random.integer(0, 3) == 0;
    const Arm arm = scara ? built_in("scara") : testing::random_arm(random, random.integer(1, 7));
    const double size = std::pow(10, random.uniform(-3, -0.5));
    const Interval interval = moving_interval(random, arm, size);
    const Pose from = forward_kinematics(arm, at(interval, 0));
    const Pose to = forward_kinematics(arm, at(interval, 1));
    Line line{from, to};
    if (random.integer(0, 2) == 0) {
      line.to.translation() = from.translation() + random.vector(1e-3);
      line.to.linear() = random.rotation(1) * from.linear();
    }
    const Task task = task_named(task_names[static_cast<std::size_t>(i) % task_names.size()]);
    expect_bound(arm, line, task, interval);
  }
}

// A planar arm's tool on a circle: a joint moves at constant velocity, and so does s.
TEST(IntervalDeviation, IsRoundingForAnExactMotion) {
  const Arm arm = built_in("rrr");
  const Configuration from{{0.3, 0.4, 0.5}}, to{{1.5, 0.4, 0.5}};
  const auto position = [&](const Configuration& q) {
    return Vector3(forward_kinematics(arm, q).translation());
  };
  const Arc arc = arc_through(forward_kinematics(arm, from), position((from + to) / 2),
                              forward_kinematics(arm, to));
  Interval interval{{}, line_between(0, 1)};
  for (int k = 0; k < 3; ++k) interval.coordinates.push_back(line_between(from[k], to[k]));
  const Deviation bound = interval_deviation(arm, arc, Task::planar(), interval).bound;
  EXPECT_LT(bound.position, 1e-11);
  EXPECT_LT(bound.orientation, 1e-11);
}

}  // namespace
}  // namespace beeline::internal
