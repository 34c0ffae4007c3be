#include <algorithm>
#include <cmath>

#include <beeline/control/player.h>
#include <beeline/error.h>
#include <beeline/math/hermite.h>

namespace beeline {
namespace {

void check_speed(double speed) {
  if (speed >= 0 && speed <= 1) return;
  throw Error("the speed of a player must be from 0 to 1, not " + number(speed));
}

void check(const PlayerOptions& options) {
  for (const double positive : {options.time_step, options.ramp}) {
    if (positive > 0 && std::isfinite(positive)) continue;
    throw Error("the time step and the ramp of a player must be above zero, not " +
                number(positive) + " s");
  }
  check_speed(options.speed);
}

/// How the way from sample k to the next leaves the arm's limits; empty when it does not.
std::string violation_after(const Arm& arm, const Trajectory& recording, std::size_t k) {
  const auto& [names, t, q, v, a] = recording;
  Configuration least = q[k], largest = q[k];
  for (int i = 0; i < arm.dof(); ++i) {
    const internal::Cubic cubic =
        internal::cubic_between(q[k][i], q[k + 1][i], v[k][i], v[k + 1][i], t[k + 1] - t[k]);
    least[i] = internal::extremes(cubic).least;
    largest[i] = internal::extremes(cubic).largest;
  }
  for (const Configuration& farthest : {least, largest}) {
    const auto outside = limit_violations(arm, farthest);
    if (!outside.empty()) return outside.front() + ", by the velocities of the recording";
  }
  return {};
}

}  // namespace

std::string first_violation(const Arm& arm, const Trajectory& recording) {
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const auto outside = limit_violations(arm, recording.positions[k]);
    if (!outside.empty()) return "at " + number(recording.times[k]) + " s " + outside.front();
    if (recording.velocities.empty() || k + 1 == recording.size()) continue;
    const std::string between = violation_after(arm, recording, k);
    if (!between.empty()) return "after " + number(recording.times[k]) + " s " + between;
  }
  return {};
}

Player::Player(const Arm& arm, const Trajectory& recording, const ConfigurationRef& start,
               const PlayerOptions& options)
    : arm_(arm),
      options_(options),
      recording_(matched_to(arm, recording)),
      wanted_(options.speed),
      slope_(Configuration::Zero(arm.dof())),
      acceleration_(Configuration::Zero(arm.dof())),
      largest_(Configuration::Zero(arm.dof())),
      squares_(Configuration::Zero(arm.dof())) {
  check(options);
  if (recording_.size() == 0) throw Error("the recording has no samples");
  const std::string violation = first_violation(arm, recording_);
  if (!violation.empty()) throw Error(violation);
  lead_ = point_to_point(arm, start, recording_.positions.front(),
                         {.synchronise = Synchronise::straight});
  time_ = recording_.times.front();
  command_ = {start, Configuration::Zero(arm.dof())};
}

void Player::set_speed(double speed) {
  check_speed(speed);
  wanted_ = speed;
}

bool Player::done() const { return !leading_in() && time_ >= recording_.times.back(); }

/// The place and its derivatives by the recording's own time.
void Player::read(double time) {
  const auto& t = recording_.times;
  while (segment_ + 2 < t.size() && t[segment_ + 1] <= time) ++segment_;
  const std::size_t a = segment_, b = std::min(segment_ + 1, t.size() - 1);
  if (a == b) {
    command_.q = recording_.positions[a];
    slope_.setZero();
    acceleration_.setZero();
    return;
  }
  const double h = t[b] - t[a], u = std::clamp((time - t[a]) / h, 0.0, 1.0);
  const Configuration &p = recording_.positions[a], &q = recording_.positions[b];
  if (recording_.velocities.empty()) {
    slope_ = (q - p) / h;
    acceleration_.setZero();
    command_.q = p + u * (q - p);
    return;
  }
  const Configuration &v = recording_.velocities[a], &w = recording_.velocities[b];
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    const internal::Cubic cubic = internal::cubic_between(p[k], q[k], v[k], w[k], h);
    command_.q[k] = cubic.value(u);
    slope_[k] = cubic.velocity(u);
    acceleration_[k] = cubic.acceleration(u);
  }
}

/// By how much the speed may change in a step: the joints' q'' = a speed^2 + v speed' must keep
/// their limits as far as the recording leaves room.
double Player::largest_change() const {
  constexpr double least = 0.05;  // of the ramp: a recording at its limits must be able to pause
  double rate = 1 / options_.ramp;
  for (Eigen::Index k = 0; k < slope_.size(); ++k) {
    const double limit = arm_.limits(k).acceleration;
    const double left = limit - std::abs(acceleration_[k]) * speed_ * speed_;
    if (std::abs(slope_[k]) * rate > left) rate = left / std::abs(slope_[k]);
  }
  return std::max(rate, least / options_.ramp) * options_.time_step;
}

const Command& Player::step() {
  const double dt = options_.time_step;
  const double before = speed_, change = largest_change();
  speed_ += std::clamp(wanted_ - speed_, -change, change);
  if (leading_in()) {
    lead_time_ += dt * (before + speed_) / 2;
    at(lead_, std::min(lead_time_, lead_.duration), command_.q, slope_, acceleration_);
    command_.velocity = speed_ * slope_;
    if (!leading_in()) speed_ = 0;  // at rest at the recording's begin
    return command_;
  }
  time_ = std::min(time_ + dt * (before + speed_) / 2, recording_.times.back());
  read(time_);
  const bool ended = time_ >= recording_.times.back();
  command_.velocity = (ended ? 0 : speed_) * slope_;
  return command_;
}

void Player::measured(const ConfigurationRef& q) {
  if (q.size() != command_.q.size()) {
    throw Error("what was measured has " + std::to_string(q.size()) + " values; the arm has " +
                std::to_string(command_.q.size()) + " coordinates");
  }
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double error = std::abs(q[k] - command_.q[k]);
    largest_[k] = std::max(largest_[k], error);
    squares_[k] += error * error;
  }
  ++steps_;
}

TrackingError Player::tracking() const {
  const double count = std::max(1.0, static_cast<double>(steps_));
  return {largest_, (squares_ / count).cwiseSqrt(), steps_};
}

}  // namespace beeline
