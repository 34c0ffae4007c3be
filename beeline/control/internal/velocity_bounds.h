#pragma once

#include <string>
#include <vector>

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// What kept a servo's step from doing all of what was asked for.
enum class ServoLimit { none, velocity, acceleration, position, singular };
std::string name(ServoLimit limit);

/// What limits leave of a coordinate's velocity in one step; 0 is always in it.
struct Room {
  double lower = 0, upper = 0;
  /// What bounds each side: the position where a stop before that end asks for less.
  ServoLimit lower_kind = ServoLimit::velocity, upper_kind = ServoLimit::velocity;

  /// The side that a velocity leads to.
  double allowed(double velocity) const { return velocity > 0 ? upper : -lower; }
  ServoLimit kind(double velocity) const { return velocity > 0 ? upper_kind : lower_kind; }
};

/// How fast a coordinate may go towards a place that is `way` off and still stop there, when it
/// goes on for one time step and then brakes; as fast as gets there in one step where the
/// acceleration has no limit.
double fast_to_stop(double way, double acceleration, double time_step);

/// One room for each coordinate of q; a q outside the bounds may only come back.
void fill_rooms(const Arm& arm, const internal::Bounds& bounds, const ConfigurationRef& q,
                double time_step, std::vector<Room>& rooms);

}  // namespace beeline::internal
