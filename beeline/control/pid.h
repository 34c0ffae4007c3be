#pragma once

#include <beeline/model/arm.h>

namespace beeline {

/// Each step is kp e + ki sum(e) + kd (e - e_before), with e = goal - q. With ki = kd = 0 this is
/// the chapter's eq. 1.3: below kp = 1 it approaches the goal from one side, slowly when kp is
/// small; from 1 to 2 it overshoots and swings; from 2 on it never arrives.
struct PidGains {
  double kp = 0.1;
  double ki = 0;
  double kd = 0;
};

/// One loop's law with its memory, the sum of the errors and the error before. Joint values are
/// plain numbers: no turn is taken the short way round. No step allocates.
class Pid {
 public:
  /// Throws Error for a gain that is not finite or negative, or kp not above zero.
  Pid(const PidGains& gains, const ConfigurationRef& goal);

  /// Forgets the errors met; the next step counts its change from this place.
  /// Throws Error when q does not fit the goal.
  void start(const ConfigurationRef& q);

  /// A new goal, with the memory kept: its jump is not taken for a change of the error.
  /// Throws Error when it does not fit the old one.
  void set_goal(const ConfigurationRef& goal);

  /// How much q is to be changed, valid until the next step. The first step without start() counts
  /// no change. Throws Error when q does not fit the goal.
  const Configuration& step(const ConfigurationRef& q);

 private:
  void check_size(const ConfigurationRef& q) const;

  PidGains gains_;
  Configuration goal_, sum_, before_, change_;
  bool started_ = false;
};

}  // namespace beeline
