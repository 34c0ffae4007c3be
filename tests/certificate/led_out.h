#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <tuple>

#include <beeline/certificate/clearance.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::testing {

/// Two bodies, and the point of a cloud.
using BodyPair = std::tuple<std::string, std::string, std::optional<std::size_t>>;

/// The least signed distance of each two bodies that are too close at a configuration.
inline std::map<BodyPair, double> close_pairs(const CollisionModel& model, const Configuration& q) {
  std::map<BodyPair, double> least;
  for (const BodyDistance& pair : pairs_too_close(model, q)) {
    const BodyPair bodies{pair.names[0], pair.names[1], pair.point};
    const auto [found, is_new] = least.emplace(bodies, pair.lower);
    if (!is_new) found->second = std::min(found->second, pair.lower);
  }
  return least;
}

/// Expects, of dense samples of a motion that was proved with a recovery, that the pairs that are
/// too close at the start come no closer and no others are, and that none is after the recovery;
/// and that the proof needs the depth as the option.
inline void expect_leads_out(const CollisionModel& model, const Trajectory& motion,
                             const ClearanceProof& proof) {
  constexpr double slack = 2e-9;  // of the proof, and of the distances, m
  ASSERT_TRUE(proof) << proof.reason;
  ASSERT_TRUE(proof.recovery);
  const ClearanceRecovery& recovery = *proof.recovery;
  const std::map<BodyPair, double> start = close_pairs(model, motion.positions.front());
  const std::vector<BodyDistance> pairs = pairs_too_close(model, motion.positions.front());
  ASSERT_FALSE(start.empty());
  EXPECT_NEAR(recovery.depth, pairs.front().clearance - pairs.front().lower, 1e-12);
  EXPECT_NEAR(recovery.distance, pairs.front().lower, 1e-12);
  EXPECT_EQ(recovery.pairs, pairs.size());
  ASSERT_LT(recovery.sample, motion.size());
  EXPECT_EQ(recovery.time, motion.times[recovery.sample]);
  constexpr int times = 1000;
  for (int i = 0; i <= 2 * times; ++i) {
    const double end = i <= times ? recovery.time : motion.times.back();
    const double begin = i <= times ? motion.times.front() : recovery.time;
    const double t = begin + (end - begin) * (i <= times ? i : i - times) / times;
    for (const BodyDistance& pair : pairs_too_close(model, sample(motion, t).position)) {
      if (pair.lower >= pair.clearance - slack) continue;
      ASSERT_LT(t, recovery.time) << names_text(pair);
      const auto at_start = start.find({pair.names[0], pair.names[1], pair.point});
      ASSERT_NE(at_start, start.end()) << names_text(pair) << " at " << t;
      ASSERT_GE(pair.lower, at_start->second - slack) << names_text(pair) << " at " << t;
    }
  }
  if (recovery.pairs == 1 && recovery.distance > 0) {
    double largest = recovery.distance;
    for (std::size_t k = 0; k <= recovery.sample; ++k) {
      const std::map<BodyPair, double> here = close_pairs(model, motion.positions[k]);
      const double distance = here.empty() ? pairs.front().clearance : here.begin()->second;
      ASSERT_GE(distance, largest - slack) << "sample " << k;
      largest = std::max(largest, distance);
    }
  }
  EXPECT_FALSE(prove_clearance(model, motion));
  EXPECT_TRUE(prove_clearance(model, motion, {.recover_clearance = recovery.depth}));
  const ClearanceProof refused =
      prove_clearance(model, motion, {.recover_clearance = 0.9 * recovery.depth});
  EXPECT_FALSE(refused);
  ASSERT_TRUE(refused.recovery);
  EXPECT_EQ(refused.recovery->depth, recovery.depth);
}

/// A configuration at which the arm is closer than the clearance by at most `depth`; nothing if
/// none is found. The nearest pair is brought to a random depth along its gradient.
template <class Random>
std::optional<Configuration> start_too_close(Random& random, const CollisionModel& model,
                                             double depth) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    Configuration q = random.configuration(model.arm());
    const double wanted = random.uniform(0.05, 0.9) * depth;
    for (int i = 0; i < 30; ++i) {
      const BodyDistance pair = nearest_pair(model, q);
      const double excess = pair.clearance - pair.lower - wanted;
      const double slope = pair.gradient.squaredNorm();
      if (std::abs(excess) < 0.05 * depth || !(slope > 1e-6)) break;
      const Configuration step = excess / slope * pair.gradient;
      q += step * std::min(1.0, 0.3 / step.norm());
      q = nearest_within_limits(model.arm(), q);
    }
    const BodyDistance pair = nearest_pair(model, q);
    const double found = pair.clearance - pair.lower;
    if (found > 1e-6 && found <= depth) return q;
  }
  return std::nullopt;
}

}  // namespace beeline::testing
