#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include <beeline/control/internal/command_interpolation.h>
#include <beeline/control/internal/goal_solver.h>
#include <beeline/control/internal/time_step.h>
#include <beeline/control/internal/velocity_bounds.h>
#include <beeline/control/internal/velocity_damper.h>
#include <beeline/control/tracker.h>
#include <beeline/internal/enum_names.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/damped_least_squares.h>
#include <beeline/model/internal/ranges.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {
namespace internal {
namespace {

/// Max distance of each coordinate from the arm to the goal, in units of the distance in which it
/// stops from its velocity limit.
constexpr double goal_distance = 4;

constexpr double aim_damping = 1e-4;  // fraction of the squared norm of A's columns

Task checked_task(const Arm& arm, const TrackerOptions& options) {
  check_time_step(options.time_step);
  if (!(options.command_period >= 0) || !std::isfinite(options.command_period)) {
    throw Error("the command period must be zero or above, not " + number(options.command_period) +
                " s");
  }
  const Deviation& tolerance = options.tolerance;
  if (!(tolerance.position > 0) || !(tolerance.orientation > 0)) {
    throw Error("the tolerance must be above zero, not " + deviation_text(tolerance));
  }
  if (options.task) check_task(*options.task);
  return options.task.value_or(default_task(arm));
}

/// Returns the arm with assumed limits of velocity and acceleration in place of unknown ones. The
/// acceleration assumed for a very large velocity limit is clamped to Limits::max_rate.
Arm with_motion_limits(const Arm& arm) {
  std::map<std::string, LimitOverrides> limits;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits motion = motion_limits(arm.limits(k));
    limits[arm.joint_of(k).name] = {
        .velocity = motion.velocity,
        .acceleration = std::min(motion.acceleration, Limits::max_rate)};
  }
  return with_limits(arm, limits);
}

}  // namespace

/// The state of a Tracker.
class TrackerLoop {
 public:
  TrackerLoop(const Arm& arm, const ConfigurationRef& start, const TrackerOptions& options);

  const TrackerStep& step(const Pose& world_T_tool);
  void reset(const ConfigurationRef& q);
  const TrackerStep& last() const { return step_; }

 private:
  void fill_goal_bounds();
  void fill_goal_velocity(bool at_bound);
  void aim_at_command(const Pose& world_T_tool);
  void fill_desired_velocity();
  void limit_velocity();
  double within_limits(Eigen::Index k, double velocity) const {
    const double change = arm_.limits(k).acceleration * options_.time_step;
    return velocity_within(bounds_[k], velocity, step_.velocity[k], change);
  }
  void keep_clearance();
  void move();
  void report(const Pose& world_T_tool, const GoalStatus& goal);

  Arm arm_;                    ///< with motion limits
  std::vector<Limits> known_;  ///< the limits before unknown ones were assumed
  Task task_;
  TrackerOptions options_;
  Bounds positions_;
  CommandInterpolation commands_;
  GoalSolver solver_;
  std::vector<VelocityBounds> bounds_;
  Eigen::VectorXd lower_, upper_;  ///< bounds of the goal
  Configuration last_goal_;
  Eigen::VectorXd estimated_velocity_;  ///< velocity of the goal within the acceleration limits
  Eigen::VectorXd goal_velocity_;  ///< velocity of the goal, limited as the joints are in this step
  Eigen::VectorXd desired_;        ///< joint velocities without the limits of this step
  Eigen::VectorXd next_;           ///< joint velocities within the limits of this step
  Configuration aim_;              ///< configuration that the arm moves towards
  WeightedTask task_at_arm_;
  std::optional<VelocityDamper> damper_;
  VelocityBox box_;
  TrackerStep step_;
};

TrackerLoop::TrackerLoop(const Arm& arm, const ConfigurationRef& start,
                         const TrackerOptions& options)
    : arm_(with_motion_limits(arm)),
      known_(arm.limits()),
      task_(checked_task(arm, options)),
      options_(options),
      positions_(bounds_of(arm_)),
      commands_(Pose::Identity(), options.time_step, options.command_period),
      solver_(arm_, task_),
      bounds_(static_cast<std::size_t>(arm.dof())),
      lower_(arm.dof()),
      upper_(arm.dof()),
      last_goal_(arm.dof()),
      estimated_velocity_(arm.dof()),
      goal_velocity_(arm.dof()),
      desired_(arm.dof()),
      next_(arm.dof()),
      aim_(arm.dof()),
      task_at_arm_(arm_, task_) {
  if (options.model != nullptr) {
    damper_.emplace(arm_, task_, *options.model, options.time_step, options.damper_gain);
    box_ = {desired_, desired_};
  }
  reset(start);
}

void TrackerLoop::reset(const ConfigurationRef& q) {
  const std::vector<Reason> violations = limit_violations(arm_, q);
  if (!violations.empty()) throw Error("the start of a tracker: " + sentence(violations.front()));
  const Configuration start = q.cwiseMax(positions_.lower).cwiseMin(positions_.upper);
  commands_ = {forward_kinematics(arm_, start), options_.time_step, options_.command_period};
  step_ = {.q = start, .velocity = Configuration::Zero(q.size()), .error = {}};
  estimated_velocity_.setZero();
  solver_.reset(start);
  if (damper_) damper_->reset();
}

/// Bounds the goal to stay near the arm. With a goal far away, all joints would wait for one that
/// has to rotate by half a turn where the command passes next to a singularity. With a nearer goal,
/// the joints would compensate for each other during a long motion and turn back at its end.
void TrackerLoop::fill_goal_bounds() {
  for (Eigen::Index k = 0; k < lower_.size(); ++k) {
    const Limits& limits = arm_.limits(k);
    const double v = limits.velocity;
    const double stop = v * options_.time_step + v * v / (2 * limits.acceleration);
    const double distance = goal_distance * stop;
    lower_[k] = std::max(positions_.lower[k], step_.q[k] - distance);
    upper_[k] = std::min(positions_.upper[k], step_.q[k] + distance);
  }
}

/// Estimates the velocity of the goal as the arm could have it: scaled to the velocity limits, and
/// changed within the acceleration limits, so that a jump or the noise of the command hardly
/// changes it. A goal that stops is at rest at once, and so is a goal that its bounds move along
/// with the arm.
void TrackerLoop::fill_goal_velocity(bool at_bound) {
  desired_ = (at_bound ? 0 : 1 / options_.time_step) * (solver_.goal() - last_goal_);
  double scale = 1;
  for (Eigen::Index k = 0; k < desired_.size(); ++k) {
    const double limit = arm_.limits(k).velocity;
    if (std::abs(desired_[k]) * scale > limit) scale = limit / std::abs(desired_[k]);
  }
  for (Eigen::Index k = 0; k < desired_.size(); ++k) {
    const double change = arm_.limits(k).acceleration * options_.time_step;
    const double v = scale * desired_[k], last = estimated_velocity_[k];
    estimated_velocity_[k] = std::clamp(v, last - change, last + change);
    goal_velocity_[k] = std::clamp(estimated_velocity_[k], -std::abs(v), std::abs(v));
  }
}

/// While a clearance holds the arm back, the arm does not move towards the goal but in the
/// direction of the tool's error. The goal is the nearest to the command within its bounds around
/// the arm, and the straight line to it may lead away from the pose that is nearest to the command
/// beside the body.
void TrackerLoop::aim_at_command(const Pose& world_T_tool) {
  const Pose tool = task_at_arm_.set_configuration(step_.q);
  task_at_arm_.set_command(masked(task_, pose_error(world_T_tool, tool, task_.frame)));
  const Jacobian& a = task_at_arm_.matrix();
  const WeightedTask::Rows y =
      damped_multipliers(a, task_at_arm_.command(), aim_damping * a.squaredNorm());
  for (Eigen::Index k = 0; k < aim_.size(); ++k) {
    aim_[k] = std::clamp(step_.q[k] + task_at_arm_.weight()[k] * a.col(k).dot(y),
                         positions_.lower[k], positions_.upper[k]);
  }
  goal_velocity_.setZero();
}

/// desired = goal velocity + α r / h. Here r is the remaining distance to the goal at the end of
/// the step if the arm had the goal's velocity, and α ≤ 1 is the largest fraction of it from which
/// every joint can stop relative to the goal. If α = 1, the arm is at the goal at the end of the
/// step.
void TrackerLoop::fill_desired_velocity() {
  const double h = options_.time_step;
  double fraction = 1;
  for (Eigen::Index k = 0; k < desired_.size(); ++k) {
    const double r = std::abs(aim_[k] - step_.q[k] - h * goal_velocity_[k]);
    if (!(r > 0)) continue;
    const double speed = max_stopping_speed(r, arm_.limits(k).acceleration, h);
    if (fraction * r <= speed * h) continue;
    fraction = speed * h / r;
    step_.limit = ServoLimit::acceleration;
    step_.joint = static_cast<int>(k);
  }
  desired_ = goal_velocity_ + fraction * ((aim_ - step_.q) / h - goal_velocity_);
  double scale = 1;
  for (Eigen::Index k = 0; k < desired_.size(); ++k) {
    const double limit = arm_.limits(k).velocity;
    if (!(std::abs(desired_[k]) * scale > limit)) continue;
    scale = limit / std::abs(desired_[k]);
    step_.limit = ServoLimit::velocity;
    step_.joint = static_cast<int>(k);
  }
  desired_ *= scale;
}

/// Sets next_ to the velocity within the limits of this step that is nearest to the desired one.
void TrackerLoop::limit_velocity() {
  fill_velocity_bounds(arm_, positions_, step_.q, options_.time_step, bounds_);
  double largest = 1e-9;  // largest difference relative to the velocity limit
  for (Eigen::Index k = 0; k < desired_.size(); ++k) {
    next_[k] = within_limits(k, desired_[k]);
    const double difference = std::abs(next_[k] - desired_[k]) / arm_.limits(k).velocity;
    if (!(difference > largest)) continue;
    largest = difference;
    const bool within_bounds =
        next_[k] == std::clamp(desired_[k], bounds_[k].lower, bounds_[k].upper);
    step_.limit = within_bounds ? bounds_[k].limit(desired_[k]) : ServoLimit::acceleration;
    step_.joint = static_cast<int>(k);
  }
}

/// Changes next_ so that the clearances are kept.
void TrackerLoop::keep_clearance() {
  fill_velocity_box(arm_, bounds_, step_.velocity, options_.time_step, box_);
  const VelocityChange change =
      damper_->keep_clearance(step_.q, step_.velocity, box_, desired_, next_);
  step_.proved = change.proved;
  if (change.pair) {
    step_.limit = ServoLimit::clearance;
    step_.joint = std::nullopt;
    step_.bodies = damper_->names(*change.pair);
  } else if (change.joint) {
    step_.limit = ServoLimit::position;
    step_.joint = change.joint;
  }
}

void TrackerLoop::move() {
  step_.velocity = next_;
  for (Eigen::Index k = 0; k < next_.size(); ++k) {
    step_.q[k] = std::clamp(step_.q[k] + options_.time_step * next_[k], positions_.lower[k],
                            positions_.upper[k]);
  }
}

void TrackerLoop::report(const Pose& world_T_tool, const GoalStatus& goal) {
  step_.error = task_deviation(task_, world_T_tool, forward_kinematics(arm_, step_.q));
  step_.status = TrackerStatus::limited;
  if (within(step_.error, options_.tolerance)) {
    step_.status = TrackerStatus::following;
  } else if (!within(goal.error, options_.tolerance)) {
    if (goal.blocking < 0) {
      step_.status = goal.stationary ? TrackerStatus::unreachable : TrackerStatus::singular;
    } else {
      const double end = (goal.upwards ? positions_.upper : positions_.lower)[goal.blocking];
      const bool at_limit = solver_.goal()[goal.blocking] == end;
      const bool is_held = step_.joint || step_.bodies;
      if (at_limit ||
          !is_held) {  // otherwise the joint limits the motion towards a goal farther away
        step_.limit = at_limit ? ServoLimit::position : ServoLimit::velocity;
        step_.joint = static_cast<int>(goal.blocking);
        step_.bodies = std::nullopt;
      }
    }
  }
  if (step_.status != TrackerStatus::limited) {
    step_.limit = ServoLimit::none;
    step_.joint = std::nullopt;
    step_.bodies = std::nullopt;
  }
  step_.assumed = false;
  if (!step_.joint) return;
  const Limits& known = known_[*step_.joint];
  step_.assumed = (step_.limit == ServoLimit::velocity && !std::isfinite(known.velocity)) ||
                  (step_.limit == ServoLimit::acceleration && !std::isfinite(known.acceleration));
}

const TrackerStep& TrackerLoop::step(const Pose& world_T_tool) {
  const Pose commanded = checked_pose(world_T_tool, "the commanded pose");
  CommandInterpolation commands = commands_;
  const Pose& command = commands.step(commanded);
  fill_goal_bounds();
  last_goal_ = solver_.goal();
  const GoalStatus goal = solver_.approach(command, lower_, upper_);
  commands_ = commands;  // no exceptions from here on
  step_.limit = ServoLimit::none;
  step_.joint = std::nullopt;
  step_.bodies = std::nullopt;
  fill_goal_velocity(goal.blocking >= 0);
  aim_ = solver_.goal();
  if (damper_ && damper_->is_changing()) aim_at_command(command);
  fill_desired_velocity();
  limit_velocity();
  if (damper_) keep_clearance();
  move();
  report(command, goal);
  return step_;
}

}  // namespace internal

std::string name(TrackerStatus status) {
  constexpr internal::EnumNames<TrackerStatus> names("status");
  return names.of(status);
}

std::ostream& operator<<(std::ostream& out, const TrackerStep& step) {
  out << name(step.status);
  if (step.limit != ServoLimit::none) out << ", limit " << name(step.limit);
  if (step.joint) out << " of joint " << *step.joint + 1;
  if (step.bodies) out << " of " << (*step.bodies)[0] << " and " << (*step.bodies)[1];
  if (step.assumed) out << " (assumed)";
  out << ", error " << number(step.error.position) << " m, " << number(step.error.orientation)
      << " rad";
  return step.proved ? out : out << ", not proved";
}

Tracker::Tracker(const Arm& arm, const ConfigurationRef& start, const TrackerOptions& options)
    : loop_(std::make_unique<internal::TrackerLoop>(arm, start, options)) {}

Tracker::Tracker(const Tracker& other)
    : loop_(std::make_unique<internal::TrackerLoop>(*other.loop_)) {}

Tracker::Tracker(Tracker&& other) noexcept = default;

Tracker& Tracker::operator=(Tracker other) noexcept {
  loop_.swap(other.loop_);
  return *this;
}

Tracker::~Tracker() = default;

const TrackerStep& Tracker::step(const Pose& world_T_tool) { return loop_->step(world_T_tool); }

void Tracker::reset(const ConfigurationRef& q) { loop_->reset(q); }

const Configuration& Tracker::configuration() const { return loop_->last().q; }

const Configuration& Tracker::velocity() const { return loop_->last().velocity; }

}  // namespace beeline
