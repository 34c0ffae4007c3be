#include <beeline/trajectory/limit_usage.h>

#include <tests/certificate/led_out.h>
#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

/// The straight joint motion through configurations, linear in one second each.
Trajectory straight(const Arm& arm, const std::vector<Configuration>& through) {
  Trajectory motion{arm.joint_names(), {}, through, {}, {}};
  for (std::size_t k = 0; k < through.size(); ++k) motion.times.push_back(static_cast<double>(k));
  return motion;
}

/// The straight joint motion from rest to rest, in some samples.
Trajectory from_rest_to_rest(const Arm& arm, const Configuration& a, const Configuration& b,
                             Interpolation interpolation, int samples) {
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  for (int i = 0; i < samples; ++i) {
    const double u = static_cast<double>(i) / (samples - 1), v = 1 - u;
    motion.times.push_back(u);
    motion.positions.push_back(a + u * u * u * (10 - 15 * u + 6 * u * u) * (b - a));
    if (interpolation == Interpolation::linear) continue;
    motion.velocities.push_back(30 * u * u * v * v * (b - a));
    if (interpolation == Interpolation::cubic) continue;
    motion.accelerations.push_back(60 * u * v * (v - u) * (b - a));
  }
  return motion;
}

/// A configuration to which the nearest pair leads away from each other, and some more.
Configuration way_out(Random& random, const CollisionModel& model, const Configuration& start) {
  const BodyDistance pair = nearest_pair(model, start);
  const double missing = random.uniform(1.5, 4) * pair.clearance - pair.lower;
  Configuration out = start + missing / pair.gradient.squaredNorm() * pair.gradient;
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] += random.uniform(-0.01, 0.01);
  return nearest_within_limits(model.arm(), out);
}

/// Expects that a refused motion is one: at the time of the proof the pair is closer than its
/// clearance and, before the recovery ends, closer than at the start or not among the pairs there.
void expect_refused_rightly(const CollisionModel& model, const Trajectory& motion,
                            const ClearanceProof& proof) {
  if (proof.status != ClearanceStatus::collides) return;
  EXPECT_LT(proof.pair.upper, proof.pair.clearance);
  if (proof.time == motion.times.back()) return;  // it does not lead out
  for (const LinkShapes& link : model.links()) {
    const bool is_of_pair = link.name == proof.pair.names[0] || link.name == proof.pair.names[1];
    if (is_of_pair && link.shapes.size() > 1) return;  // it may be another shape than at the start
  }
  const auto start = close_pairs(model, motion.positions.front());
  const auto found = start.find({proof.pair.names[0], proof.pair.names[1], proof.pair.point});
  if (found == start.end() || proof.time >= proof.recovery->time) return;
  double largest = found->second;  // so far
  for (int i = 0; i <= 1000; ++i) {
    const auto here = close_pairs(model, sample(motion, proof.time * i / 1000).position);
    const auto at = here.find(found->first);
    largest = at == here.end() ? proof.pair.clearance : std::max(largest, at->second);
    if (at == here.end()) break;
  }
  EXPECT_LT(proof.pair.lower, largest) << names_text(proof.pair) << " at " << proof.time;
}

TEST(ClearanceRecovery, PairsThatStartTooCloseComeNoCloser) {
  Random random;
  int accepted = 0, refused = 0, in_contact = 0, several = 0;
  const int count = cases(900);
  for (int i = 0; i < count; ++i) {
    const Arm arm = random_arm(random, random.integer(2, 6));
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.2),
                               random_scene(random, arm, 4, 0.5, 2),
                               {.clearance = random.uniform(0.005, 0.05)});
    if (model.pair_count() == 0) continue;
    const double depth = std::min(0.0999, random.uniform(0.2, 2.5) * model.clearance());
    const auto start = start_too_close(random, model, depth);
    if (!start) continue;
    const Trajectory motion =
        from_rest_to_rest(arm, *start, way_out(random, model, *start), random_interpolation(random),
                          random.integer(2, 20));
    const ClearanceProof proof = prove_clearance(
        model, motion, {.closest = random.integer(0, 1) == 0, .recover_clearance = 1.001 * depth});
    if (!proof) {
      ++refused;
      expect_refused_rightly(model, motion, proof);
      continue;
    }
    ++accepted;
    in_contact += proof.recovery->distance < 0;
    several += proof.recovery->pairs > 1;
    expect_leads_out(model, motion, proof);
    if (HasFailure()) return;
  }
  std::cout << accepted << " accepted, " << in_contact << " of them in contact and " << several
            << " of several pairs, " << refused << " refused, of " << count << '\n';
  EXPECT_GE(accepted, count / 5);
  EXPECT_TRUE(in_contact > 0 || count < 100);
  EXPECT_TRUE(several > 0 || count < 900);
}

/// A disc of radius 0.2 m on two slides above a table whose top is at y = 0.
struct Above {
  explicit Above(double clearance = 0.005)
      : arm("disc", slides()),
        model(arm, {{"disc", 2, {{Sphere{0.2}}}}},
              {.obstacles = {{.name = "table",
                              .shapes = {{Box{Vector3(4, 1, 4)},
                                          make_pose({0, -0.5, 0}, Rotation::Identity())}}}}},
              {.clearance = clearance}) {}

  static std::vector<Joint> slides() {
    std::vector<Joint> joints;
    for (int i = 0; i < 2; ++i) {
      joints.push_back(composite_joint('P', std::string(1, "xy"[i])).front());
      joints.back().screw = translation_screw(Vector3::Unit(i));
      joints.back().limits = {.lower = -1, .upper = 1, .velocity = 1, .acceleration = 4};
    }
    return joints;
  }

  /// The configuration with the disc at a distance from the table.
  static Configuration at(double x, double distance) { return Eigen::Vector2d(x, 0.2 + distance); }

  ClearanceProof proof(const std::vector<Configuration>& through, double recover) const {
    return prove_clearance(model, straight(arm, through), {.recover_clearance = recover});
  }

  Arm arm;
  CollisionModel model;
};

TEST(ClearanceRecovery, OfADiscAboveATable) {
  const Above above;
  for (const double distance : {0.003, 0.0, -0.001, -0.02}) {
    const ClearanceProof proof =
        above.proof({above.at(0, distance), above.at(0.3, 0.02), above.at(-0.3, 0.1)}, 0.025);
    ASSERT_TRUE(proof) << distance << ": " << proof.reason;
    ASSERT_TRUE(proof.recovery);
    EXPECT_NEAR(proof.recovery->depth, 0.005 - distance, 1e-12);
    EXPECT_NEAR(proof.recovery->distance, distance, 1e-12);
    EXPECT_EQ(proof.recovery->names, (NamedPair{"disc", "table"}));
    EXPECT_EQ(proof.recovery->pairs, 1U);
    EXPECT_EQ(proof.recovery->sample, 1U);
    EXPECT_EQ(proof.recovery->time, 1);
    EXPECT_NEAR(proof.least_distance, 0.02, 1e-3);
    EXPECT_FALSE(above.proof({above.at(0, distance), above.at(0.3, 0.02)}, 0.0049 - distance));
    EXPECT_FALSE(above.proof({above.at(0, distance), above.at(0.3, 0.02)}, 0));
  }
}

TEST(ClearanceRecovery, RefusesAMotionThatComesCloserAgain) {
  const Above above;
  const auto refuses = [&](const std::vector<Configuration>& through, double from, double to) {
    const ClearanceProof proof = above.proof(through, 0.01);
    EXPECT_EQ(proof.status, ClearanceStatus::collides);
    EXPECT_GE(proof.time, from);
    EXPECT_LE(proof.time, to);
    EXPECT_EQ(proof.reason.code, ReasonCode::bodies_too_close);
  };
  // Closer at once, after it rose, after it was clear between two samples, and after the recovery.
  refuses({above.at(0, 0.003), above.at(0, 0.0029), above.at(0, 0.1)}, 0, 0.1);
  refuses({above.at(0, 0.003), above.at(0, 0.0035), above.at(0, 0.0034), above.at(0, 0.1)}, 1, 1.1);
  refuses({above.at(0, 0.003), above.at(0, 0.1), above.at(0, 0.003), above.at(0, 0.1)}, 1.9, 2.1);
  refuses({above.at(0, 0.003), above.at(0, 0.0045)}, 1, 1);
  refuses({above.at(0, 0.003), above.at(0, 0.003)}, 1, 1);
  refuses({above.at(0, 0.003)}, 0, 0);
  // A cubic that rises, falls again within an interval, and ends clear.
  Trajectory wave = straight(above.arm, {above.at(0, 0.003), above.at(0, 0.01)});
  wave.velocities = {Eigen::Vector2d(0, 0.1), Eigen::Vector2d(0, 0.1)};
  const ClearanceProof proof = prove_clearance(above.model, wave, {.recover_clearance = 0.01});
  EXPECT_EQ(proof.status, ClearanceStatus::collides);
}

TEST(ClearanceRecovery, SlidesAlongBeforeItLeadsOut) {
  const Above above;
  const ClearanceProof proof =
      above.proof({above.at(0, 0.003), above.at(0.5, 0.003), above.at(0.5, 0.02)}, 0.002);
  ASSERT_TRUE(proof) << proof.reason;
  EXPECT_EQ(proof.recovery->sample, 2U);
}

TEST(ClearanceRecovery, IsNoneWhereTheMotionStartsClear) {
  const Above above;
  const std::vector<Configuration> through{above.at(0, 0.006), above.at(0.5, 0.01)};
  const ClearanceProof with = above.proof(through, 0.1), without = above.proof(through, 0);
  ASSERT_TRUE(with);
  EXPECT_FALSE(with.recovery);
  EXPECT_EQ(with.least_distance, without.least_distance);
}

TEST(ClearanceRecovery, EndsWithItsBudget) {
  const Above above;
  const Trajectory motion = straight(above.arm, {above.at(0, 0.003), above.at(0, 0.1)});
  int complete = 0;
  for (std::int64_t work = 0; work < 3000; work += 37) {
    const ClearanceProof proof = prove_clearance(
        above.model, motion, {.recover_clearance = 0.01, .budget = {.max_work = work}});
    EXPECT_TRUE(proof || proof.status == ClearanceStatus::work_limit) << proof;
    complete += bool(proof);
    // The closest approach is examined after the proof, with what is left.
    const ClearanceProof closest =
        prove_clearance(above.model, motion,
                        {.closest = true, .recover_clearance = 0.01, .budget = {.max_work = work}});
    EXPECT_EQ(closest.status, proof.status) << work;
  }
  EXPECT_GT(complete, 0);
}

TEST(ClearanceRecovery, RefusesDepthsOutOfRange) {
  const Above above;
  for (const double depth : {-1e-9, 0.11, 1e9, std::nan(""), -Limits::none, Limits::none}) {
    EXPECT_REFUSED(above.proof({above.at(0, 1)}, depth), "recover_clearance must be from 0 to 0.1");
  }
}

}  // namespace
}  // namespace beeline
