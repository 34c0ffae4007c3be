#pragma once

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Gains of a discrete PID controller: each step is kp e + ki Σe + kd (e − last e) with the error
/// e = goal − q. With ki = kd = 0 this is eq. 1.3 of Dellaert, *Serial Link Manipulators*: it
/// approaches the goal monotonically for kp < 1, overshoots and oscillates for 1 < kp < 2, and does
/// not converge for kp ≥ 2.
struct PidGains {
  double kp = 0.1;
  double ki = 0;
  double kd = 0;
};

/// A PID controller in joint space, with its state: the sum of the errors and the last error.
/// Joint values are plain numbers; angles are not wrapped. No step allocates.
class Pid {
 public:
  /// Throws Error unless kp > 0, ki >= 0, kd >= 0 and all are finite, as the goal is.
  Pid(const PidGains& gains, const ConfigurationRef& goal);

  /// Resets the state to q: the sum is zero, and q is the reference of the next difference.
  /// Throws Error when the size of q is not the goal's or a value is not finite.
  void start(const ConfigurationRef& q);

  /// Changes the goal and keeps the state. The change of the goal does not enter the difference of
  /// the error. Throws Error when its size is not the old goal's or a value is
  /// not finite.
  void set_goal(const ConfigurationRef& goal);

  /// Returns the change of q, valid until the next step. A first step without start() starts at q.
  /// Throws Error when the size of q is not the goal's or a value is not finite; the state stays.
  const Configuration& step(const ConfigurationRef& q);

 private:
  void check(const ConfigurationRef& q) const;

  PidGains gains_;
  Configuration goal_, sum_, last_error_, change_;
  bool started_ = false;
};

}  // namespace beeline
