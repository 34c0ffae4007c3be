#include <cmath>

#include <beeline/control/joint.h>
#include <beeline/error.h>

namespace beeline {
namespace {

void check_gains(const PidGains& gains) {
  if (!(gains.kp > 0) || !std::isfinite(gains.kp)) {
    throw Error("the gain kp must be above zero, not " + number(gains.kp));
  }
  for (const double gain : {gains.ki, gains.kd}) {
    if (!(gain >= 0) || !std::isfinite(gain)) {
      throw Error("the gains ki and kd must be zero or more, not " + number(gain));
    }
  }
}

}  // namespace

Pid::Pid(const PidGains& gains, const ConfigurationRef& goal)
    : gains_((check_gains(gains), gains)),
      goal_(goal),
      sum_(Configuration::Zero(goal.size())),
      last_error_(Configuration::Zero(goal.size())),
      change_(Configuration::Zero(goal.size())) {
  check(goal);
}

void Pid::check(const ConfigurationRef& q) const {
  if (q.size() != goal_.size()) {
    throw Error("the goal of the controller has " + std::to_string(goal_.size()) +
                " joint values, the configuration " + std::to_string(q.size()));
  }
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (std::isfinite(q[k])) continue;
    throw Error("the value of joint " + std::to_string(k + 1) + " is " + number(q[k]) +
                "; it must be a finite number");
  }
}

void Pid::start(const ConfigurationRef& q) {
  check(q);
  sum_.setZero();
  last_error_ = goal_ - q;
  started_ = true;
}

void Pid::set_goal(const ConfigurationRef& goal) {
  check(goal);
  last_error_ += goal - goal_;
  goal_ = goal;
}

const Configuration& Pid::step(const ConfigurationRef& q) {
  if (!started_) start(q);
  check(q);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double e = goal_[k] - q[k];
    sum_[k] += e;
    change_[k] = gains_.kp * e + gains_.ki * sum_[k] + gains_.kd * (e - last_error_[k]);
    last_error_[k] = e;
  }
  return change_;
}

}  // namespace beeline
