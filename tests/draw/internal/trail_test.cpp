#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/draw/internal/trail.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline {
using namespace internal;
namespace {

Trajectory random_motion(testing::Random& random, const Arm& arm, int samples) {
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k < samples; ++k) {
    motion.times.push_back(0.1 * k);
    motion.positions.push_back(random.configuration(arm));
    motion.velocities.push_back(random.configuration(arm));
    motion.accelerations.push_back(random.configuration(arm));
  }
  return motion;
}

std::vector<Polyline> lines_of(const Drawing& drawing) {
  std::vector<Polyline> lines;
  for (const Item& item : drawing.items) {
    if (const auto* line = std::get_if<Polyline>(&item.shape)) lines.push_back(*line);
  }
  return lines;
}

double distance_to(const std::vector<Vector3>& line, const Vector3& p) {
  double nearest = (p - line.front()).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector3 chord = line[i] - line[i - 1];
    const double square = chord.squaredNorm();
    const double t = square > 0 ? std::clamp(chord.dot(p - line[i - 1]) / square, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (p - line[i - 1] - t * chord).norm());
  }
  return nearest;
}

TEST(Trail, FollowsTheTrajectorysOwnPolynomials) {
  testing::Random random;
  for (int trial = 0; trial < 20; ++trial) {
    const Arm arm = built_in(trial % 2 == 0 ? "ur5" : "rrr");
    const Trajectory motion = random_motion(random, arm, random.integer(1, 12));
    Drawing drawing;
    add_trail(drawing, arm, motion);
    const std::vector<Vector3> line = lines_of(drawing).front().points;
    for (int k = 0; k < 200; ++k) {
      const Configuration q = sample(motion, random.uniform(0, motion.times.back())).position;
      EXPECT_LT(distance_to(line, forward_kinematics(arm, q).translation()),
                arm.planar() ? 0.03 : 0.005);
    }
  }
}

TEST(Trail, GrowsPieceByPieceToTheSameLine) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  const Trajectory motion = random_motion(random, arm, 6);
  Drawing still, growing;
  add_trail(still, arm, motion);
  add_trail(growing, arm, motion, {.growing = true});
  double before = 0;
  for (const Item& item : growing.items) {
    EXPECT_GE(item.appears, before);
    EXPECT_LE(item.appears, motion.times.back() + 1e-12);
    before = item.appears;
    const auto* line = std::get_if<Polyline>(&item.shape);
    if (line == nullptr) continue;
    const Vector3 at = forward_kinematics(arm, sample(motion, item.appears).position).translation();
    EXPECT_LT((line->points.back() - at).norm(), 1e-9);
    for (const Vector3& p : line->points) {
      EXPECT_LT(distance_to(lines_of(still).front().points, p), 0.01);
    }
  }
}

TEST(Trail, OfAMillionSamplesIsShortButKeepsASpike) {
  const Arm arm = built_in("gantry");
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  constexpr int side = 250'000;
  for (int k = 0; k <= 4 * side; ++k) {
    const Eigen::Vector2d corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {0, 0}};
    const double s = (k % side) / double(side);
    motion.times.push_back(1e-3 * k);
    motion.positions.emplace_back(corners[k / side] +
                                  s * (corners[k / side + 1] - corners[k / side]));
  }
  motion.positions[123'456].y() = -0.5;  // one sample wide
  Drawing drawing;
  add_trail(drawing, arm, motion);
  const std::vector<Vector3> line = lines_of(drawing).front().points;
  EXPECT_LT(line.size(), 100u);
  for (const Configuration& q : {motion.positions[123'456], motion.positions[side]}) {
    EXPECT_LT(distance_to(line, forward_kinematics(arm, q).translation()), 1e-3);
  }
}

TEST(Trail, MarksWhatIsBelowTheFloor) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int trial = 0; trial < 20; ++trial) {
    const Trajectory motion = random_motion(random, arm, 5);
    Drawing drawing;
    drawing.floor = random.uniform(-0.5, 0.5);
    add_trail(drawing, arm, motion);
    const std::vector<Polyline> lines = lines_of(drawing);
    double below = 0, marked = 0;
    for (std::size_t i = 1; i < lines[0].points.size(); ++i) {
      const Vector3 &a = lines[0].points[i - 1], &b = lines[0].points[i];
      const double low = std::min(a.z(), b.z()), high = std::max(a.z(), b.z());
      const double part = high > low ? std::clamp((*drawing.floor - low) / (high - low), 0.0, 1.0)
                                     : (low < *drawing.floor ? 1 : 0);
      below += part * (b - a).norm();
    }
    for (std::size_t n = 1; n < lines.size(); ++n) {
      EXPECT_EQ(lines[n].colour, below_ground);
      for (std::size_t i = 0; i < lines[n].points.size(); ++i) {
        EXPECT_LT(lines[n].points[i].z(), *drawing.floor + 1e-8);
        if (i > 0) marked += (lines[n].points[i] - lines[n].points[i - 1]).norm();
      }
    }
    EXPECT_NEAR(marked, below, 1e-5);
  }
}

TEST(Trail, ShowsGhostsAtEqualLengths) {
  ToolTrail trail;
  for (int k = 0; k <= 900; ++k) {
    trail.times.push_back(k);
    trail.points.emplace_back(std::pow(k / 900.0, 3), 0, 0);
  }
  const std::vector<double> at = times_evenly_along(trail, 4);
  ASSERT_EQ(at.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(std::pow(at[k] / 900, 3), 0.25 * static_cast<double>(k), 0.004);
  }
  EXPECT_EQ(times_evenly_along({{0, 1}, {Vector3::Zero(), Vector3::Zero()}}, 3).size(), 1u);
  EXPECT_TRUE(times_evenly_along({}, 3).empty());
}

}  // namespace
}  // namespace beeline
