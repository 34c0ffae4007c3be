#include "guarded_motion.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <beeline/certificate/clearance.h>
#include <beeline/kinematics/forward.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::web {
namespace {

/// The distance that is kept, as a multiple of the clearance. Where the arm stops, the start of a
/// planned motion is decided, and no rounding of the page's numbers is below the clearance.
constexpr double kept = 1.05;

/// Motion of each joint in one step along the bodies, rad or m.
constexpr double sliding_step = 0.04;

/// Bounds of one call, some milliseconds each: steps along the bodies, and units of work of a
/// proof.
constexpr int max_sliding_steps = 40;
constexpr int max_proof_work = 2000;
/// Motion of the joints in one step apart, rad or m.
constexpr double parting_step = 5e-3;

/// Steps along the bodies, rad or m, below which the arm is at rest, and above which it is seen to
/// move.
constexpr double at_rest_below = 1e-5, seen_above = 1e-3;
constexpr double at_pose_below = 1e-5;  // m or rad

CollisionOptions kept_by(CollisionOptions options) {
  options.clearance *= kept;
  // Pairs of links that are not proved to stay apart count like others, which takes less time than
  // the search for them.
  options.budget.max_work = 1;
  return options;
}

Scene kept_by(Scene scene) {
  for (Obstacle& body : scene.obstacles) {
    if (body.clearance) *body.clearance *= kept;
  }
  return scene;
}

/// Limits for a servo whose step is a step along the bodies: it may stop at once.
Arm with_sliding_steps(const Arm& arm) {
  std::map<std::string, LimitOverrides> limits;
  for (const std::string& name : arm.joint_names()) {
    limits[name] = {.velocity = sliding_step, .acceleration = Limits::none, .jerk = Limits::none};
  }
  return with_limits(arm, limits);
}

/// The straight joint motion from time 0 to 1.
Trajectory straight(const Arm& arm, const Configuration& from, const Configuration& to) {
  Trajectory motion;
  motion.joint_names = arm.joint_names();
  motion.times = {0, 1};
  motion.positions = {from, to};
  return motion;
}

/// The least distance of each pair of bodies that is too close, m.
std::map<NamedPair, double> close_pairs(const CollisionModel& model, const Configuration& q) {
  std::map<NamedPair, double> pairs;
  for (const BodyDistance& pair : pairs_too_close(model, q)) {
    const auto [at, is_new] = pairs.emplace(pair.names, pair.lower);
    if (!is_new) at->second = std::min(at->second, pair.lower);
  }
  return pairs;
}

/// The first pair that is closer than before; none if all come apart.
std::optional<NamedPair> closer_pair(const std::map<NamedPair, double>& before,
                                     const std::map<NamedPair, double>& after) {
  constexpr double rounding = 1e-9;  // m
  for (const auto& pair : after) {
    const auto known = before.find(pair.first);
    if (known == before.end() || pair.second < known->second - rounding) return pair.first;
  }
  return std::nullopt;
}

bool is_at(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm() < at_pose_below &&
         (a.linear() - b.linear()).norm() < at_pose_below;
}

}  // namespace

GuardedMotion::GuardedMotion(const Arm& arm, const std::vector<LinkShapes>& links,
                             const Scene& scene, const CollisionOptions& options)
    : arm_(arm),
      model_(arm, links, kept_by(scene), kept_by(options)),
      servo_(with_sliding_steps(arm),
             {.time_step = 1, .gain = 1, .model = &model_, .damper_gain = 1}) {}

GuardedStep GuardedMotion::towards(const Configuration& from, const Configuration& to,
                                   bool slides) {
  GuardedStep step{.q = from};
  if (model_.pair_count() == 0) return {.q = to, .is_goal_free = true};
  step.is_goal_free = spare_clearance(model_, to, 0) >= 0;
  bool is_there = false;
  if (slides) {
    is_there = (step.is_goal_free && go_straight(to, step)) || slide(from, to, step);
  } else if (spare_clearance(model_, from, 0) >= 0) {
    is_there = go_straight(to, step);
  } else {
    is_there = come_apart(to, step);
  }
  if (is_there) step.is_on_its_way = false;
  if (is_there || step.is_on_its_way) {
    step.held_by.reset();
  } else if (!step.held_by) {
    step.held_by = nearest_pair(model_, step.q).names;
  }
  return step;
}

/// Moves the arm along the straight joint motion up to the first pair that is too close. Returns
/// whether there is none.
bool GuardedMotion::go_straight(const Configuration& to, GuardedStep& step) {
  const Configuration from = step.q;
  const ClearanceProof proof =
      prove_clearance(model_, straight(arm_, from, to), {.budget = {.max_work = max_proof_work}});
  if (proof) {
    step.q = to;
    return true;
  }
  const bool has_pair =
      proof.status == ClearanceStatus::collides || proof.status == ClearanceStatus::not_decided;
  if (has_pair) step.held_by = proof.pair.names;
  step.is_on_its_way = !has_pair && proof.begin > 0;
  step.q = from + std::clamp(proof.begin, 0.0, 1.0) * (to - from);
  return false;
}

/// Moves the tool towards its pose at the goal. Each step is proved up to its end. Returns whether
/// the tool has come there.
bool GuardedMotion::slide(const Configuration& from, const Configuration& to, GuardedStep& step) {
  step.q = from;
  const Pose goal = forward_kinematics(arm_, to);
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(arm_.dof());
  servo_.set_velocity(velocity);
  for (int i = 0; i < max_sliding_steps; ++i) {
    const ServoStep motion = servo_.step_towards(step.q, goal, velocity);
    if (motion.bodies) {
      step.held_by = {std::string((*motion.bodies)[0]), std::string((*motion.bodies)[1])};
    }
    const double size = motion.proved ? velocity.lpNorm<Eigen::Infinity>() : 0;
    step.is_on_its_way = size > seen_above;
    if (size < at_rest_below) break;
    step.q += velocity;
  }
  return is_at(forward_kinematics(arm_, step.q), goal);
}

/// Moves the arm on the straight motion as long as all pairs that are too close come apart. Returns
/// whether they do up to the goal.
bool GuardedMotion::come_apart(const Configuration& to, GuardedStep& step) const {
  const Configuration from = step.q;
  const double length = (to - from).lpNorm<Eigen::Infinity>();
  const int count = static_cast<int>(std::clamp(std::ceil(length / parting_step), 1.0, 1000.0));
  std::map<NamedPair, double> close = close_pairs(model_, from);
  for (int i = 1; i <= count; ++i) {
    const Configuration next = i == count ? to : Configuration(from + i * (to - from) / count);
    std::map<NamedPair, double> now = close_pairs(model_, next);
    step.held_by = closer_pair(close, now);
    if (step.held_by) return false;
    step.q = next;
    close = std::move(now);
    step.is_on_its_way = close.empty() && i < count;
    if (step.is_on_its_way) return false;  // the proof leads on
  }
  return true;
}

}  // namespace beeline::web
