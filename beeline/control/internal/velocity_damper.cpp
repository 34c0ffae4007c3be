#include <algorithm>
#include <cmath>

#include <beeline/control/internal/velocity_damper.h>
#include <beeline/error.h>
#include <beeline/model/internal/same_links.h>

namespace beeline::internal {
namespace {

constexpr int few_parts = 3;
constexpr double margin = 1e-7;  // m, that the linear inequalities add to the clearance
constexpr int max_rows = 24;

// Weight of the tool's rotation, so that a tool that is pushed against a wall does not tilt, and of
// the joint motion, relative to the tool's translation.
constexpr double rotation_weight = 100;
constexpr double joint_weight = 1e-4;

const CollisionBodies& bodies_for(const Arm& arm, const CollisionModel& model, double time_step,
                                  double gain) {
  if (!(gain > 0) || !(gain * time_step <= 1)) {
    throw Error("the damper gain must be above zero and at most 1 / time step = " +
                number(1 / time_step) + ", not " + number(gain));
  }
  if (!same_links(arm, model.arm())) {
    throw Error("the model has another arm than the loop: " + model.arm().name() +
                " with other links or another base than " + arm.name());
  }
  return model.bodies();
}

}  // namespace

VelocityDamper::VelocityDamper(const Arm& arm, const Task& task, const CollisionModel& model,
                               double time_step, double gain)
    : arm_(arm),
      time_step_(time_step),
      gain_(gain),
      positions_(bounds_of(arm)),
      task_(arm, task),
      proof_(bodies_for(arm, model, time_step, gain), gain),
      line_(arm.dof()),
      brake_(arm.dof()),
      trial_(arm.dof()),
      gradient_(arm.dof()),
      row_(arm.dof()),
      constrained_(arm.dof(), max_rows),
      row_pairs_(max_rows),
      weights_(arm.dof(), arm.dof()),
      scaled_{Eigen::VectorXd(arm.dof()), Eigen::VectorXd(arm.dof())} {}

/// Returns the fraction of the velocity by which all joints can slow down in one step.
double VelocityDamper::braking_fraction(const Eigen::VectorXd& velocity) const {
  double fraction = Limits::none;
  for (Eigen::Index k = 0; k < velocity.size(); ++k) {
    const double v = std::abs(velocity[k]), change = arm_.limits(k).acceleration * time_step_;
    if (change < fraction * v) fraction = change / v;
  }
  return fraction;
}

/// Returns σ: after a step with velocity v and a stop in proportion, the arm is at q + σ v. With
/// the fraction f of braking_fraction(), σ = h (1 + (1 - f) + (1 - 2 f) + ...).
double VelocityDamper::stopping_time(const Eigen::VectorXd& velocity) const {
  const double fraction = braking_fraction(velocity);
  const double steps = std::floor(1 / fraction);
  return time_step_ * (1 + steps - (steps > 0 ? fraction * steps * (steps + 1) / 2 : 0));
}

bool VelocityDamper::stops_within_limits(const ConfigurationRef& q,
                                         const Eigen::VectorXd& velocity) const {
  constexpr double rounding = 1e-12;
  const double time = stopping_time(velocity);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double v = velocity[k], end = q[k] + time * v;
    if (v > 0 ? end > positions_.upper[k] + rounding : end < positions_.lower[k] - rounding) {
      if (v != 0) return false;
    }
  }
  return true;
}

/// Mixes the velocity with the braking one until the line ends within the position limits: joints
/// that stop in proportion need more room than joints that stop on their own.
/// Returns the coordinate that needs it.
std::optional<int> VelocityDamper::stop_within_limits(const ConfigurationRef& q,
                                                      Eigen::VectorXd& velocity) const {
  if (stops_within_limits(q, velocity)) return std::nullopt;
  std::optional<int> joint;
  const double time = std::max(stopping_time(velocity), stopping_time(brake_));
  double part = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double v = velocity[k], from = brake_[k];
    const double least = std::min(0.0, (positions_.lower[k] - q[k]) / time);
    const double most = std::max(0.0, (positions_.upper[k] - q[k]) / time);
    const double end = v > 0 ? most : least;
    if ((v > 0 ? v <= std::max(end, from) : v >= std::min(end, from))) continue;
    const double allowed = std::max(0.0, (end - from) / (v - from));
    if (!(allowed < part)) continue;
    part = allowed;
    joint = static_cast<int>(k);
  }
  velocity = brake_ + part * (velocity - brake_);
  return joint;
}

DampedBy VelocityDamper::keep_clearance(const ConfigurationRef& q, const Eigen::VectorXd& last,
                                        const VelocityBox& box, const Eigen::VectorXd& wanted,
                                        Eigen::VectorXd& velocity) {
  proof_.begin_step(q);
  brake_ = std::max(0.0, 1 - braking_fraction(last)) * last;
  DampedBy by{.joint = stop_within_limits(q, velocity)};
  const bool is_admitted = prove(q, velocity, StopProof::Effort::all_pairs) && proof_.is_damped();
  held_ = !is_admitted || (held_ && !proof_.near().empty());
  if (!held_) return by;
  trial_ = velocity;
  if (!is_admitted) by = {.pair = proof_.closest_pair()};
  for (int pass = 0; pass < 2 && (pass == 0 || proof_.parts() < few_parts); ++pass) {
    project(q, box, wanted);
    const int leading = constrained_.leading_row();
    if (leading >= 0) by = {.pair = row_pairs_[static_cast<std::size_t>(leading)]};
    if (prove(q, trial_,
              pass == 0 ? StopProof::Effort::all_pairs : StopProof::Effort::first_violation)) {
      velocity = trial_;
      held_ = !is_reached(wanted);
      return by;
    }
  }
  if (is_admitted) return by;
  trial_ = brake_ + 0.5 * (trial_ - brake_);
  velocity = prove(q, trial_, StopProof::Effort::first_violation) ? trial_ : brake_;
  return by;
}

/// Whether the line of a velocity is proved and ends within the position limits.
bool VelocityDamper::prove(const ConfigurationRef& q, const Eigen::VectorXd& velocity,
                           StopProof::Effort effort) {
  const double time = stopping_time(velocity);
  line_ = time * velocity;
  return proof_.prove(q, line_, time, effort) && stops_within_limits(q, velocity);
}

/// Whether trial_ is the wanted velocity.
bool VelocityDamper::is_reached(const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd& weight = task_.weight();
  for (Eigen::Index k = 0; k < wanted.size(); ++k) {
    if (!(std::abs(trial_[k] - wanted[k]) <= 1e-6 * weight[k])) return false;
  }
  return true;
}

/// Adds the inequalities of near_, linear about the velocity `about`, whose line was proved last.
void VelocityDamper::fill_rows(const ConfigurationRef& q, const Eigen::VectorXd& about) {
  constrained_.clear();
  row_pairs_.clear();
  const auto add = [&](const StopProof::NearPair& near, double least) {
    if (row_pairs_.full()) return;
    row_ = gradient_.cwiseProduct(task_.weight());
    constrained_.add(row_, least);
    row_pairs_.push_back(near.pair);
  };
  for (int part = 0; part < proof_.parts(); ++part) {
    bool has_frames = false;
    for (const StopProof::NearPair& near : proof_.near()) {
      if (part != 0 && near.part != part) continue;
      if (!has_frames) proof_.set_frames(q, part, proof_.parts());
      has_frames = true;
      if (part == 0) {
        proof_.fill_gradient(near.pair, near.start_points, gradient_);
        // The braking velocity satisfies it, too.
        add(near, std::min(-gain_ * (near.gap - near.floor), gradient_.dot(brake_)));
      }
      if (near.part != part || !std::isfinite(near.least)) continue;
      proof_.fill_gradient(near.pair, near.least_points, gradient_);
      add(near, gradient_.dot(about) + (margin - near.least) / (near.least_at * proof_.time()));
    }
  }
}

/// Sets trial_ to the velocity nearest to the wanted one within the box and the inequalities of
/// the line of trial_, which was not proved.
void VelocityDamper::project(const ConfigurationRef& q, const VelocityBox& box,
                             const Eigen::VectorXd& wanted) {
  task_.set_configuration(q);
  fill_rows(q, trial_);
  const Eigen::VectorXd& weight = task_.weight();
  const Jacobian& a = task_.matrix();
  weights_.setZero();
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index k = 0; k < weights_.cols(); ++k) {
      const double entry = (i < 3 ? 1 : rotation_weight) * a(i, k);
      for (Eigen::Index j = 0; j < weights_.rows(); ++j) weights_(j, k) += a(i, j) * entry;
    }
  }
  weights_.diagonal().array() += joint_weight * a.squaredNorm() / static_cast<double>(a.cols());
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double least = std::min(0.0, (positions_.lower[k] - q[k]) / proof_.time());
    const double most = std::max(0.0, (positions_.upper[k] - q[k]) / proof_.time());
    scaled_.lower[k] = std::max(box.lower[k], std::min(least, brake_[k])) / weight[k];
    scaled_.upper[k] = std::min(box.upper[k], std::max(most, brake_[k])) / weight[k];
    row_[k] = wanted[k] / weight[k];
  }
  trial_ = weight.cwiseProduct(constrained_.solve(weights_, row_, scaled_.lower, scaled_.upper));
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    trial_[k] = std::clamp(trial_[k], std::min(box.lower[k], box.upper[k]),
                           std::max(box.lower[k], box.upper[k]));
  }
}

}  // namespace beeline::internal
