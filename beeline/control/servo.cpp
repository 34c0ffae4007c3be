#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include <beeline/control/internal/resolved_rates.h>
#include <beeline/control/internal/time_step.h>
#include <beeline/control/internal/velocity_bounds.h>
#include <beeline/control/internal/velocity_damper.h>
#include <beeline/control/servo.h>
#include <beeline/internal/enum_names.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/planning/internal/null_space.h>

namespace beeline {
namespace internal {
namespace {

// Speed of the null-space motion away from limits, relative to the largest joint speed of the
// command. The arm reconfigures while it moves, and stops with the command.
constexpr double null_space_speed = 0.5;

// The acceleration limits are divided: J̇ q̇ may use half of them, the other half is available for
// slowing down, and the null-space motion may change by half of them in a step.
constexpr double path_acceleration = 0.5;
constexpr double null_space_acceleration = 0.5;

/// Fraction of the largest change of a velocity; smaller changes count as zero.
constexpr double still = 1e-9;

/// Change of the scale by a clearance that is not reported.
constexpr double negligible_scale = 1e-6;

void check_servo(const ServoOptions& options) {
  check_time_step(options.time_step);
  if (!(options.gain > 0) || !(options.gain * options.time_step <= 1)) {
    throw Error(
        "the gain must be above zero and at most 1 / time step = " + number(1 / options.time_step) +
        ", not " + number(options.gain) + " (" + number(ServoOptions{}.gain) + " unless given)");
  }
  if (!(options.linear_speed > 0) || !(options.angular_speed > 0)) {
    throw Error("the speeds of a servo must be above zero, not " + number(options.linear_speed) +
                " m/s and " + number(options.angular_speed) + " rad/s");
  }
  if (options.task) check_task(*options.task);
}

Task checked_task(const Arm& arm, const ServoOptions& options) {
  check_servo(options);
  return options.task.value_or(default_task(arm));
}

}  // namespace

/// The state of a Servo.
class ServoLoop {
 public:
  ServoLoop(const Arm& arm, const ServoOptions& options);

  ServoStep step(const ConfigurationRef& q, const Twist& command,
                 Eigen::Ref<Eigen::VectorXd> velocity);
  Twist command_towards(const ConfigurationRef& q, const Pose& world_T_tool) const;
  void set_velocity(const ConfigurationRef& velocity);

 private:
  double max_change(Eigen::Index k) const;
  double scale_within_bounds(const Rates& rates, ServoStep& result) const;
  double scale_for_acceleration(const Rates& rates, double scale, ServoStep& result) const;
  void fill_null_velocity(const ConfigurationRef& q, const Rates& rates, double scale);
  void bound_null_velocity(const Rates& rates, double scale);
  void apply_acceleration_limits(const Rates& rates, double scale, double max_scale,
                                 ServoStep& result);
  void approach(const Rates& rates, double scale, ServoStep& result);
  double within_limits(Eigen::Index k, double velocity) const {
    return velocity_within(bounds_[k], velocity, last_[k], max_change(k));
  }
  void keep_clearance(const ConfigurationRef& q, bool commanded, ServoStep& result);

  Arm arm_;
  Task task_;
  ServoOptions options_;
  Bounds positions_;
  ResolvedRates solver_;
  std::vector<VelocityBounds> bounds_;
  Eigen::VectorXd null_, last_null_;  ///< null-space velocities of this step and the last
  Eigen::VectorXd next_, last_;       ///< joint velocities of this step and the last
  std::optional<VelocityDamper> damper_;
  VelocityBox box_;
  Eigen::VectorXd desired_;  ///< joint velocities without acceleration limits, for the damper
};

ServoLoop::ServoLoop(const Arm& arm, const ServoOptions& options)
    : arm_(arm),
      task_(checked_task(arm, options)),
      options_(options),
      positions_(bounds_of(arm)),
      solver_(arm, task_),
      bounds_(static_cast<std::size_t>(arm.dof())),
      null_(Eigen::VectorXd::Zero(arm.dof())),
      last_null_(arm.dof()),
      next_(arm.dof()),
      last_(Eigen::VectorXd::Zero(arm.dof())) {
  if (options.model == nullptr) return;
  damper_.emplace(arm, task_, *options.model, options.time_step, options.damper_gain);
  box_ = {last_, last_};
  desired_ = last_;
}

void ServoLoop::set_velocity(const ConfigurationRef& velocity) {
  constexpr double rounding = 1e-6;  // fraction of the limit
  check_configuration(arm_, velocity);
  for (int k = 0; k < arm_.dof(); ++k) {
    const double limit = arm_.limits(k).velocity;
    if (!(std::abs(velocity[k]) > limit * (1 + rounding))) continue;
    throw Error::of("velocity", "the velocity of joint " + arm_.joint_of(k).name + " is " +
                                    number(velocity[k]) + ", above its limit of " + number(limit));
  }
  last_ = velocity;
}

/// Returns the largest change of a joint velocity in one step.
double ServoLoop::max_change(Eigen::Index k) const {
  return arm_.limits(k).acceleration * options_.time_step;
}

/// Returns the largest scale of the rates within the velocity bounds.
double ServoLoop::scale_within_bounds(const Rates& rates, ServoStep& result) const {
  double scale = 1;
  for (Eigen::Index k = 0; k < rates.velocity.size(); ++k) {
    const double v = rates.velocity[k];
    const double allowed = bounds_[k].max_speed(v);
    if (!(std::abs(v) * scale > allowed)) continue;
    scale = allowed / std::abs(v);
    result.limit = bounds_[k].limit(v);
    result.joint = static_cast<int>(k);
  }
  return scale;
}

/// Reduces the scale until the joint acceleration of the motion, scale^2 q̈, is within the
/// acceleration limits and one step does not pass the singularity. The distance to the singularity
/// is |x|^2 / (x . ẍ) if x . ẍ > 0.
double ServoLoop::scale_for_acceleration(const Rates& rates, double scale,
                                         ServoStep& result) const {
  const Eigen::VectorXd& weight = solver_.task().weight();
  double speed = 0, growth = 0;  // |x|^2 and x . ẍ
  for (Eigen::Index k = 0; k < rates.velocity.size(); ++k) {
    const double v = rates.velocity[k] / weight[k];
    const double a = rates.acceleration[k] / weight[k];
    speed += v * v;
    growth += v * a;
    const double allowed = path_acceleration * max_change(k) / options_.time_step;
    if (!(scale * scale * std::abs(rates.acceleration[k]) > allowed)) continue;
    scale = std::sqrt(allowed / std::abs(rates.acceleration[k]));
    result.limit = v * a > 0 ? ServoLimit::singular : ServoLimit::acceleration;
    result.joint = static_cast<int>(k);
  }
  if (2 * growth * options_.time_step * scale > speed) {
    scale = speed / (2 * growth * options_.time_step);
    result.limit = ServoLimit::singular;
    result.joint = std::nullopt;
  }
  return scale;
}

/// Computes the null-space velocity for this scale. It changes from the last step's null-space
/// velocity towards the gradient that leads away from the position limits.
void ServoLoop::fill_null_velocity(const ConfigurationRef& q, const Rates& rates, double scale) {
  const Eigen::VectorXd& weight = solver_.task().weight();
  const double speed = scale * rates.velocity.cwiseQuotient(weight).lpNorm<Eigen::Infinity>();
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    null_[k] = null_space_speed * speed * weight[k] *
               push_from_limits(q[k], positions_.lower[k], positions_.upper[k]);
  }
  last_null_ = last_;
  solver_.project_to_null_space(last_null_);
  solver_.project_to_null_space(null_);
  null_ -= last_null_;
  double part = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double allowed = null_space_acceleration * max_change(k);
    if (std::abs(null_[k]) * part > allowed) part = allowed / std::abs(null_[k]);
  }
  null_ = last_null_ + part * null_;
  bound_null_velocity(rates, scale);
}

/// Scales the null-space velocity so that its sum with the scaled rates is within the bounds.
void ServoLoop::bound_null_velocity(const Rates& rates, double scale) {
  double part = 1;
  for (Eigen::Index k = 0; k < null_.size(); ++k) {
    const VelocityBounds& bounds = bounds_[k];
    const double v = scale * rates.velocity[k];
    const double allowed = std::max(0.0, null_[k] > 0 ? bounds.upper - v : v - bounds.lower);
    if (std::abs(null_[k]) * part > allowed) part = allowed / std::abs(null_[k]);
  }
  null_ *= part;
  if (!null_.allFinite()) null_.setZero();
}

/// Sets next_ to the scaled rates. The scale is the one nearest to `scale` that acceleration limits
/// allow after the last velocity. If they allow none, approach() changes the direction. A
/// coordinate that must brake for its position limit does so independently of the others.
void ServoLoop::apply_acceleration_limits(const Rates& rates, double scale, double max_scale,
                                          ServoStep& result) {
  double lower = -Limits::none, upper = Limits::none;  // bounds of the scale
  double near = 0, size = 0;  // products of the rates with the last velocity and with themselves
  std::optional<int> joint;   // coordinate that determines `upper`
  for (Eigen::Index k = 0; k < next_.size(); ++k) {
    const double change = max_change(k);
    if (!std::isfinite(change)) continue;
    const double v = rates.velocity[k] / change, from = (last_[k] - null_[k]) / change;
    near += v * from;
    size += v * v;
    if (std::abs(v) < still) {
      if (std::abs(from) > 1 + still) lower = Limits::none;
      continue;
    }
    lower = std::max(lower, from / v - 1 / std::abs(v));
    const double allowed = from / v + 1 / std::abs(v);
    if (allowed < upper) {
      upper = allowed;
      joint = static_cast<int>(k);
    }
  }
  if (lower <= upper && lower < Limits::none) {
    if (upper < scale) {
      result.limit = ServoLimit::acceleration;
      result.joint = joint;
    }
    next_ = std::clamp(scale, lower, upper) * rates.velocity + null_;
  } else {
    approach(rates, size > 0 ? std::clamp(near / size, 0.0, max_scale) : 0, result);
  }
  for (Eigen::Index k = 0; k < next_.size(); ++k) next_[k] = within_limits(k, next_[k]);
}

/// Changes next_ so that the clearances are kept.
void ServoLoop::keep_clearance(const ConfigurationRef& q, bool commanded, ServoStep& result) {
  fill_velocity_box(arm_, bounds_, last_, options_.time_step, box_);
  const double scale = commanded ? solver_.task().achieved_scale(desired_) : 1;
  const VelocityChange change = damper_->keep_clearance(q, last_, box_, desired_, next_);
  result.proved = change.proved;
  if (!commanded || !(change.pair || change.joint)) return;
  if (solver_.task().achieved_scale(next_) >= scale - negligible_scale) return;
  result.joint = change.joint;
  result.limit = change.pair ? ServoLimit::clearance : ServoLimit::position;
  if (change.pair) result.bodies = damper_->names(*change.pair);
}

/// Sets next_ on the straight line from the last velocity to the rates at this scale, as near to
/// them as the acceleration limits allow.
void ServoLoop::approach(const Rates& rates, double scale, ServoStep& result) {
  next_ = scale * rates.velocity + null_;
  double part = 1;
  for (Eigen::Index k = 0; k < next_.size(); ++k) {
    const double change = std::abs(next_[k] - last_[k]);
    if (!(change * part > max_change(k))) continue;
    part = max_change(k) / change;
    result.limit = ServoLimit::acceleration;
    result.joint = static_cast<int>(k);
  }
  if (part < 1) next_ = last_ + part * (next_ - last_);
}

ServoStep ServoLoop::step(const ConfigurationRef& q, const Twist& command,
                          Eigen::Ref<Eigen::VectorXd> velocity) {
  check_configuration(arm_, q);
  if (velocity.size() != q.size()) {
    throw Error("`velocity` has " + std::to_string(velocity.size()) + " elements; the arm has " +
                std::to_string(q.size()) + " coordinates");
  }
  const bool commanded = solver_.set(q, command);
  fill_velocity_bounds(arm_, positions_, q, options_.time_step, bounds_);
  const Rates& rates = solver_.solve(q, bounds_, last_, options_.time_step);

  ServoStep result;
  if (rates.scale < 1) result.limit = ServoLimit::singular;
  const double max_scale = scale_within_bounds(rates, result);
  const double scale = scale_for_acceleration(rates, max_scale, result);
  null_.setZero();
  if (commanded && rates.regular && q.size() > task_.size()) fill_null_velocity(q, rates, scale);
  if (damper_) desired_ = scale * rates.velocity + null_;
  apply_acceleration_limits(rates, scale, max_scale, result);
  if (damper_) keep_clearance(q, commanded, result);
  if (commanded) result.scale = solver_.task().achieved_scale(next_);
  last_ = next_;
  velocity = next_;
  return result;
}

Twist ServoLoop::command_towards(const ConfigurationRef& q, const Pose& world_T_tool) const {
  check_configuration(arm_, q);
  Twist command = masked(task_, pose_error(world_T_tool, forward_kinematics(arm_, q), task_.frame));
  command *= options_.gain;
  const double linear = command.head<3>().norm(), angular = command.tail<3>().norm();
  command *= std::min({1.0, linear > 0 ? options_.linear_speed / linear : 1,
                       angular > 0 ? options_.angular_speed / angular : 1});
  return command;
}

}  // namespace internal

std::string name(ServoLimit limit) {
  constexpr internal::EnumNames<ServoLimit> names("limit");
  return names.of(limit);
}

std::ostream& operator<<(std::ostream& out, const ServoStep& step) {
  out << "scale " << number(step.scale) << ", limit " << name(step.limit);
  if (step.joint) out << " of joint " << *step.joint + 1;
  if (step.bodies) out << " of " << (*step.bodies)[0] << " and " << (*step.bodies)[1];
  return step.proved ? out : out << ", not proved";
}

Servo::Servo(const Arm& arm, const ServoOptions& options)
    : loop_(std::make_unique<internal::ServoLoop>(arm, options)) {}

Servo::Servo(const Servo& other) : loop_(std::make_unique<internal::ServoLoop>(*other.loop_)) {}

Servo::Servo(Servo&& other) noexcept = default;

Servo& Servo::operator=(Servo other) noexcept {
  loop_.swap(other.loop_);
  return *this;
}

Servo::~Servo() = default;

ServoStep Servo::step(const ConfigurationRef& q, const Twist& command,
                      Eigen::Ref<Eigen::VectorXd> velocity) {  // NOLINT: a reference
  return loop_->step(q, command, velocity);
}

ServoStep Servo::step_towards(const ConfigurationRef& q, const Pose& world_T_tool,
                              Eigen::Ref<Eigen::VectorXd> velocity) {  // NOLINT: a reference
  return loop_->step(q, loop_->command_towards(q, world_T_tool), velocity);
}

void Servo::set_velocity(const ConfigurationRef& velocity) { loop_->set_velocity(velocity); }

}  // namespace beeline
