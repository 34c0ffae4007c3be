#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/control/internal/velocity_damper.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

/// Parts of a line from which a second projection is left out, which would take too long.
constexpr int few_parts = 3;

/// Distance that the linear inequalities add to the clearance, m, for the curvature of the line
/// about which they are linear.
constexpr double margin = 1e-7;

/// Largest number of inequalities. A pair adds one or two.
constexpr int max_rows = 24;

/// Weight of the tool's rotation relative to its translation, each in the units of the task, so
/// that a tool that is pushed against a wall does not tilt.
constexpr double rotation_weight = 100;

/// Weight of the joint motion, as a fraction of the mean square of the task's columns. It makes the
/// velocity unique, and is too small to lead the tool aside.
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
      expected_(arm.dof()),
      stepped_(arm.dof()),
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

/// Returns a coordinate that would stop beyond its position limits.
std::optional<int> VelocityDamper::joint_beyond_limits(const ConfigurationRef& q,
                                                       const Eigen::VectorXd& velocity) const {
  constexpr double rounding = 1e-12;  // rad or m
  const double time = stopping_time(velocity);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double v = velocity[k], end = q[k] + time * v;
    if (v > 0 ? end > positions_.upper[k] + rounding : end < positions_.lower[k] - rounding) {
      if (v != 0) return static_cast<int>(k);
    }
  }
  return std::nullopt;
}

/// Mixes the velocity with the braking one until the line ends within the position limits: joints
/// that stop in proportion need more room than joints that stop on their own.
/// Returns the coordinate that needs it.
std::optional<int> VelocityDamper::stop_within_limits(const ConfigurationRef& q,
                                                      Eigen::VectorXd& velocity) const {
  if (!joint_beyond_limits(q, velocity)) return std::nullopt;
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

void VelocityDamper::reset() {
  proof_.reset();
  is_changing_ = last_proved_ = false;
}

VelocityChange VelocityDamper::keep_clearance(const ConfigurationRef& q,
                                              const Eigen::VectorXd& last, const VelocityBox& box,
                                              const Eigen::VectorXd& wanted,
                                              Eigen::VectorXd& velocity) {
  proof_.begin_step(q);
  brake_ = std::max(0.0, 1 - braking_fraction(last)) * last;
  VelocityChange change = admit(q, box, wanted, velocity);
  if (!change.proved) change.proved = is_brake_proved(q, last);
  last_proved_ = change.proved;
  expected_ = q + time_step_ * velocity;
  stepped_ = velocity;
  return change;
}

/// Changes the velocity of this step. The result says that it is not proved if the velocity becomes
/// the braking one.
VelocityChange VelocityDamper::admit(const ConfigurationRef& q, const VelocityBox& box,
                                     const Eigen::VectorXd& wanted, Eigen::VectorXd& velocity) {
  VelocityChange change{.joint = stop_within_limits(q, velocity)};
  const bool is_admitted = prove(q, velocity, StopProof::Effort::all_pairs) && proof_.is_damped();
  is_changing_ = !is_admitted || (is_changing_ && !proof_.near().empty());
  if (!is_changing_) return change;
  trial_ = velocity;
  if (!is_admitted) {
    if (const auto pair = proof_.violated_pair()) {
      change = {.pair = pair};
    } else if (const auto joint = joint_beyond_limits(q, velocity)) {
      change = {.joint = joint};
    }
  }
  for (int pass = 0; pass < 2 && (pass == 0 || proof_.parts() < few_parts); ++pass) {
    project(q, box, wanted);
    const int leading = constrained_.leading_row();
    if (leading >= 0) change = {.pair = row_pairs_[static_cast<std::size_t>(leading)]};
    if (prove(q, trial_,
              pass == 0 ? StopProof::Effort::all_pairs : StopProof::Effort::first_violation)) {
      velocity = trial_;
      is_changing_ = !is_reached(wanted);
      return change;
    }
  }
  if (is_admitted) return change;
  trial_ = brake_ + 0.5 * (trial_ - brake_);
  change.proved = prove(q, trial_, StopProof::Effort::first_violation);
  velocity = change.proved ? trial_ : brake_;
  return change;
}

/// Whether the braking velocity keeps the clearances: by the proof of the last step, whose line it
/// continues if the arm is where that step led, to the rounding of the sum, or by its own.
bool VelocityDamper::is_brake_proved(const ConfigurationRef& q, const Eigen::VectorXd& last) {
  bool continues = last_proved_ && last == stepped_;
  for (Eigen::Index k = 0; continues && k < q.size(); ++k) {
    const double rounding =
        4 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(q[k]));
    continues = std::abs(q[k] - expected_[k]) <= rounding;
  }
  return continues || prove(q, brake_, StopProof::Effort::first_violation);
}

/// Whether the line of a velocity is proved and ends within the position limits.
bool VelocityDamper::prove(const ConfigurationRef& q, const Eigen::VectorXd& velocity,
                           StopProof::Effort effort) {
  const double time = stopping_time(velocity);
  line_ = time * velocity;
  return proof_.prove(q, line_, time, effort) && !joint_beyond_limits(q, velocity);
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
