#include <algorithm>
#include <cmath>

#include <beeline/control/servo.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/null_space.h>

namespace beeline {
namespace {

constexpr double urge = 0.5;    // of the step's speed goes into moving away from limits
constexpr double still = 1e-9;  // of the most that a velocity can change: counts as zero
constexpr double spared = 0.5;  // of an acceleration is for that
constexpr double bending =
    0.5;  // of an acceleration is for the bend of the way, the rest for slowing down

void check(const ServoOptions& options) {
  if (!(options.time_step > 0) || !std::isfinite(options.time_step)) {
    throw Error("the time step must be above zero, not " + number(options.time_step) + " s");
  }
  if (!(options.gain > 0) || !(options.gain * options.time_step <= 1)) {
    throw Error("the gain must be above zero and at most 1 / time step = " +
                number(1 / options.time_step) + ", not " + number(options.gain));
  }
  if (!(options.linear_speed > 0) || !(options.angular_speed > 0)) {
    throw Error("the speeds of a servo must be above zero, not " + number(options.linear_speed) +
                " m/s and " + number(options.angular_speed) + " rad/s");
  }
  if (options.task) check_task(*options.task);
}

}  // namespace

Servo::Servo(const Arm& arm, const ServoOptions& options)
    : arm_(arm),
      task_((check(options), options.task.value_or(default_task(arm)))),
      options_(options),
      bounds_(internal::bounds_of(arm)),
      solver_(arm, task_),
      rooms_(static_cast<std::size_t>(arm.dof())),
      spare_(Eigen::VectorXd::Zero(arm.dof())),
      drift_(arm.dof()),
      next_(arm.dof()),
      before_(Eigen::VectorXd::Zero(arm.dof())) {}

void Servo::set_velocity(const ConfigurationRef& velocity) {
  check_configuration(arm_, velocity);
  before_ = velocity;
}

/// How much a velocity may change in one step.
double Servo::max_change(Eigen::Index k) const {
  return arm_.limits(k).acceleration * options_.time_step;
}

/// The share of the rates that velocities and positions allow.
double Servo::share_in_rooms(const Rates& rates, ServoStep& result) const {
  double share = 1;
  for (Eigen::Index k = 0; k < rates.velocity.size(); ++k) {
    const Room& room = rooms_[k];
    const double v = rates.velocity[k];
    if (!(std::abs(v) * share > room.allowed(v))) continue;
    share = room.allowed(v) / std::abs(v);
    result.limit = room.kind(v);
    result.joint = static_cast<int>(k);
  }
  return share;
}

/// The share at which accelerations can do the bend of the way, and which does not lead in one step
/// beyond the singularity that is speed^2 / growth away.
double Servo::share_for_bend(const Rates& rates, double share, ServoStep& result) const {
  double speed = 0, growth = 0;
  for (Eigen::Index k = 0; k < rates.velocity.size(); ++k) {
    const double v = rates.velocity[k] / solver_.weight[k];
    const double bend = rates.bend[k] / solver_.weight[k];
    speed += v * v;
    growth += v * bend;
    const double most = bending * max_change(k) / options_.time_step;
    if (!(share * share * std::abs(rates.bend[k]) > most)) continue;
    share = std::sqrt(most / std::abs(rates.bend[k]));
    result.limit = v * bend > 0 ? ServoLimit::singular : ServoLimit::acceleration;
    result.joint = static_cast<int>(k);
  }
  if (2 * growth * options_.time_step * share > speed) {
    share = speed / (2 * growth * options_.time_step);
    result.limit = ServoLimit::singular;
    result.joint = -1;
  }
  return share;
}

/// The motion of the joints alone that goes with this share: from that of the last step towards one
/// that leads away from the limits, within the rooms.
void Servo::fill_spare_motion(const ConfigurationRef& q, const Rates& rates, double share) {
  const double pace =
      share * rates.velocity.cwiseQuotient(solver_.weight).lpNorm<Eigen::Infinity>();
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    spare_[k] = urge * pace * solver_.weight[k] *
                internal::push_from_limits(q[k], bounds_.lower[k], bounds_.upper[k]);
  }
  drift_ = before_;
  solver_.keep_tool(drift_);
  solver_.keep_tool(spare_);
  spare_ -= drift_;
  double part = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (std::abs(spare_[k]) * part > spared * max_change(k)) {
      part = spared * max_change(k) / std::abs(spare_[k]);
    }
  }
  spare_ = drift_ + part * spare_;
  part = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const Room& room = rooms_[k];
    const double v = share * rates.velocity[k];
    const double left = std::max(0.0, spare_[k] > 0 ? room.upper - v : v - room.lower);
    if (std::abs(spare_[k]) * part > left) part = left / std::abs(spare_[k]);
  }
  spare_ *= part;
  if (!spare_.allFinite()) spare_.setZero();
}

/// This share of the rates, or the nearest that accelerations can have from the last velocity.
/// Where they can have none, straight towards the nearest (up to `most`). A coordinate that has to
/// brake for its limit does so whatever the others do.
void Servo::keep_accelerations(const Rates& rates, double share, double most, ServoStep& result) {
  double least = -Limits::none, largest = Limits::none, near = 0, size = 0;
  int joint = -1;
  for (Eigen::Index k = 0; k < next_.size(); ++k) {
    const double change = max_change(k);
    if (!std::isfinite(change)) continue;
    const double v = rates.velocity[k] / change, from = (before_[k] - spare_[k]) / change;
    near += v * from;
    size += v * v;
    if (std::abs(v) < still) {
      if (std::abs(from) > 1 + still) least = Limits::none;
      continue;
    }
    least = std::max(least, from / v - 1 / std::abs(v));
    const double allowed = from / v + 1 / std::abs(v);
    if (allowed < largest) largest = allowed, joint = static_cast<int>(k);
  }
  if (least <= largest && least < Limits::none) {
    if (largest < share) result.limit = ServoLimit::acceleration, result.joint = joint;
    next_ = std::clamp(share, least, largest) * rates.velocity + spare_;
  } else {
    next_ = (size > 0 ? std::clamp(near / size, 0.0, most) : 0) * rates.velocity + spare_;
    double part = 1;
    for (Eigen::Index k = 0; k < next_.size(); ++k) {
      const double change = std::abs(next_[k] - before_[k]);
      if (!(change * part > max_change(k))) continue;
      part = max_change(k) / change;
      result.limit = ServoLimit::acceleration;
      result.joint = static_cast<int>(k);
    }
    if (part < 1) next_ = before_ + part * (next_ - before_);
  }
  for (Eigen::Index k = 0; k < next_.size(); ++k) {
    const Room& room = rooms_[k];
    const double change = max_change(k);
    next_[k] = std::clamp(std::clamp(next_[k], room.lower, room.upper), before_[k] - change,
                          before_[k] + change);
  }
}

ServoStep Servo::step(const ConfigurationRef& q, const Twist& command,
                      Eigen::Ref<Eigen::VectorXd> velocity) {
  check_configuration(arm_, q);
  if (velocity.size() != q.size()) {
    throw Error("the velocity has room for " + std::to_string(velocity.size()) + " of the arm's " +
                std::to_string(q.size()) + " coordinates");
  }
  const bool asked = solver_.take(q, command);
  fill_rooms(arm_, bounds_, q, options_.time_step, rooms_);
  const Rates& rates = solver_.solve(q, rooms_, before_, options_.time_step);

  ServoStep result;
  if (rates.share < 1) result.limit = ServoLimit::singular;
  const double most = share_in_rooms(rates, result);
  const double share = share_for_bend(rates, most, result);
  spare_.setZero();
  if (asked && rates.regular && q.size() > task_.size()) fill_spare_motion(q, rates, share);
  keep_accelerations(rates, share, most, result);
  if (asked) result.share = solver_.share_done(next_);
  before_ = next_;
  velocity = next_;
  return result;
}

ServoStep Servo::step_towards(const ConfigurationRef& q, const Pose& world_T_tool,
                              Eigen::Ref<Eigen::VectorXd> velocity) {  // NOLINT: a reference
  check_configuration(arm_, q);
  Twist command = masked(task_, pose_error(world_T_tool, forward_kinematics(arm_, q), task_.frame));
  command *= options_.gain;
  const double linear = command.head<3>().norm(), angular = command.tail<3>().norm();
  command *= std::min({1.0, linear > 0 ? options_.linear_speed / linear : 1,
                       angular > 0 ? options_.angular_speed / angular : 1});
  return step(q, command, velocity);
}

}  // namespace beeline
