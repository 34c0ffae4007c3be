#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/certificate/random_motion.h>
#include <tests/collision/closed_forms.h>
#include <tests/random_arm.h>

namespace beeline {
namespace {

using testing::Random;
using testing::random_interpolation;
using testing::random_motion;
using testing::RoundedBox;

Shape random_rounded(Random& random, double size, double spread) {
  Shape shape;
  const auto length = [&] { return random.uniform(0, size); };
  switch (random.integer(0, 2)) {
    case 0:
      shape.body = Sphere{length()};
      break;
    case 1:
      shape.body = Capsule{length() / 4, 2 * length()};
      break;
    default:
      shape.body = Box{{length(), length(), length()}};
  }
  shape.pose = random.pose(spread);
  return shape;
}

/// An arm with a body on some of its links, which moves among obstacles.
struct RoundedCell {
  Arm arm;
  std::vector<LinkShapes> links = {};
  Scene scene = {};
  bool self_collision = false;
  Trajectory motion = {};

  RoundedCell(Random& random, double size)
      : arm(testing::random_arm(random, random.integer(1, 6), 4)) {
    const auto last = static_cast<int>(arm.joints().size());
    for (int i = 0; i <= last; ++i) {
      if (i < last && random.integer(0, 1) == 0) continue;
      links.push_back({"link" + std::to_string(i),
                       static_cast<std::size_t>(i),
                       {random_rounded(random, size, 0.3)}});
    }
    motion = random_motion(random, arm, random_interpolation(random), random.integer(2, 6),
                           random.uniform(0.02, 0.5));
    const int obstacles = random.integer(1, 4);
    for (int i = 0; i < obstacles; ++i) {
      Shape shape = random_rounded(random, 2 * size, 0.3 + size);
      const double time = random.uniform(motion.times.front(), motion.times.back());
      const std::vector<Pose> near = link_poses(arm, sample(motion, time).position);
      shape.pose.translation() +=
          near[static_cast<std::size_t>(random.integer(0, last))].translation();
      scene.obstacles.push_back({"obstacle" + std::to_string(i), {shape}});
    }
    self_collision = random.integer(0, 2) == 0;
  }

  CollisionModel model(double clearance) const {
    return {arm, links, scene, {.clearance = clearance, .self_collision = self_collision}};
  }

  /// The least distance of the pairs that count, or anything above `limit` if it is above that.
  double distance(const Configuration& q, double limit) const {
    const std::vector<Pose> poses = link_poses(arm, q);
    std::vector<RoundedBox> bodies;
    for (const LinkShapes& link : links) {
      bodies.push_back(testing::rounded_box(link.shapes.front(), poses[link.link]));
    }
    double least = limit;
    const auto compare = [&](const RoundedBox& a, const RoundedBox& b) {
      least = std::min(least, testing::closed_form_distance(a, b, least));
    };
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (std::size_t k = 0; self_collision && k < i; ++k) {
        if (links[i].link - links[k].link >= 2) compare(bodies[i], bodies[k]);
      }
      for (const Obstacle& obstacle : scene.obstacles) {
        if (links[i].link == 0) continue;
        compare(bodies[i], testing::rounded_box(obstacle.shapes.front(), Pose::Identity()));
      }
    }
    return least;
  }

  /// The least distance at 500 times, refined around the ten least by golden sections.
  double least_distance() const {
    constexpr int times = 500, refined = 10, sections = 40;
    constexpr double golden = 0.6180339887498949;
    const double begin = motion.times.front(), step = (motion.times.back() - begin) / (times - 1);
    const auto at = [&](double time, double limit) {
      return distance(sample(motion, std::min(time, motion.times.back())).position, limit);
    };
    std::vector<std::pair<double, double>> found;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < times; ++i) {
      // Distances that are far above the least are not among the ten.
      found.emplace_back(at(begin + i * step, 2 * least + 0.1), begin + i * step);
      least = std::min(least, found.back().first);
    }
    std::partial_sort(found.begin(), found.begin() + refined, found.end());
    for (int k = 0; k < refined; ++k) {
      double low = std::max(begin, found[k].second - step), high = found[k].second + step;
      high = std::min(high, motion.times.back());
      for (int i = 0; i < sections; ++i) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        const double at_a = at(a, 1e9), at_b = at(b, 1e9);
        least = std::min({least, at_a, at_b});
        (at_a < at_b ? high : low) = at_a < at_b ? b : a;
      }
    }
    return least;
  }
};

/// The clearance is near the least distance: a little above it, so that a proof would be false, or
/// a little below.
TEST(ClearanceByClosedForms, IsNeverProvedAboveTheLeastDistance) {
  Random random;
  const int cases = testing::cases(600);
  int answers[3] = {}, above = 0;
  for (int i = 0; i < cases; ++i) {
    const RoundedCell cell(random, random.uniform(0.05, 0.5));
    const double least = cell.least_distance();
    if (!(least > 1e-5 && least < 1e3)) continue;
    const double beside = std::pow(10, random.uniform(-7, -1));
    const bool is_above = random.integer(0, 1) == 0;
    const double clearance = least * (is_above ? 1 + beside : 1 - beside);
    const ClearanceProof proof = prove_clearance(cell.model(clearance), cell.motion);
    ++answers[static_cast<int>(proof.status)];
    above += is_above ? 1 : 0;
    if (proof) {
      EXPECT_GE(least, clearance) << "case " << i;
      EXPECT_LE(proof.least_distance, least + 1e-12) << "case " << i;
    } else if (proof.status == ClearanceStatus::collides) {
      EXPECT_LT(cell.distance(sample(cell.motion, proof.time).position, 1e9), clearance + 1e-12)
          << "case " << i;
    } else {
      EXPECT_LE(beside, 0.05) << "case " << i;
    }
  }
  EXPECT_GT(answers[0], cases / 20);
  EXPECT_GT(above, cases / 5);
  std::cout << above << " clearances above the least distance; " << answers[0] << " clear, "
            << answers[1] << " collide, " << answers[2] << " not decided\n";
}

TEST(ClearanceByClosedForms, OfFiveMillimetresIsNearlyAlwaysDecided) {
  Random random;
  const int cases = testing::cases(600);
  int answers[3] = {};
  for (int i = 0; i < cases; ++i) {
    const RoundedCell cell(random, random.uniform(0.05, 0.5));
    constexpr double clearance = 5e-3;
    const ClearanceProof proof = prove_clearance(cell.model(clearance), cell.motion);
    ++answers[static_cast<int>(proof.status)];
    if (proof) {
      EXPECT_GE(cell.least_distance(), clearance) << "case " << i;
    } else if (proof.status == ClearanceStatus::collides) {
      EXPECT_LT(cell.distance(sample(cell.motion, proof.time).position, 1e9), clearance)
          << "case " << i;
    }
  }
  EXPECT_LE(answers[2], 1 + cases / 100);
  EXPECT_GT(answers[0], cases / 5);
  EXPECT_GT(answers[1], cases / 20);
  std::cout << answers[0] << " clear, " << answers[1] << " collide, " << answers[2]
            << " not decided\n";
}

/// Whether samples find a collision: each 1/32 rad of the joint that moves most.
bool is_found_by_samples(const CollisionModel& model, const Trajectory& motion) {
  for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
    const double farthest = (motion.positions[k + 1] - motion.positions[k]).cwiseAbs().maxCoeff();
    const int steps = std::max(1, static_cast<int>(std::ceil(32 * farthest)));
    for (int i = 0; i <= steps; ++i) {
      const Configuration q =
          motion.positions[k] + (motion.positions[k + 1] - motion.positions[k]) * i / steps;
      if (nearest_pair(model, q).lower <= 0) return true;
    }
  }
  return false;
}

TEST(ClearanceByClosedForms, FindsWiresAndPlatesThatSamplesMiss) {
  Random random;
  const Arm arm = built_in("panda");
  const std::vector<LinkShapes> links{{"tip", 7, {{Sphere{0.005}, make_pose({0, 0, 0.1})}}}};
  const int cases = testing::cases(300);
  int missed = 0;
  for (int i = 0; i < cases; ++i) {
    const Trajectory motion = random_motion(random, arm, Interpolation::linear, 3, 0.5);
    const double share = random.uniform(0, 1);
    const double time = motion.times.front() + share * (motion.times.back() - motion.times.front());
    Shape shape;
    shape.pose = link_poses(arm, sample(motion, time).position)[7] * links[0].shapes[0].pose;
    shape.pose.linear() = random.rotation();
    const Vector3 place = shape.pose.translation();
    if (random.integer(0, 1) == 0) {
      shape.body = Capsule{5e-4, 0.2};
    } else {
      shape.body = Box{{0.01, 0.01, 1e-3}};
    }
    const CollisionModel model(arm, links, {.obstacles = {{"thin", {shape}}}});
    const ClearanceProof proof = prove_clearance(model, motion);
    EXPECT_EQ(proof.status, ClearanceStatus::collides) << place.transpose();
    EXPECT_LE(proof.time, time + 1e-6);
    missed += is_found_by_samples(model, motion) ? 0 : 1;
  }
  std::cout << "samples each 1/32 rad miss " << missed << " of " << cases << ", the proof none\n";
  EXPECT_GT(missed, 0);
}

}  // namespace
}  // namespace beeline
