#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/math/hermite.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// s and its time derivatives at one time.
struct ParameterState {
  double s = 0, speed = 0, acceleration = 0;
};

/// The moving average of a time scaling from rest to rest over `width` seconds. Its duration is
/// longer by `width`, and each jump of d2s/dt2 of the given scaling, at both ends too, becomes a
/// ramp of this width. A width of zero does not change the time scaling.
class AveragedScaling {
 public:
  /// Keeps a reference to the time scaling.
  AveragedScaling(const TimeScaling& scaling, double width);

  double duration() const { return scaling_.duration() + width_; }

  /// Returns the state at a time from 0 to the duration.
  ParameterState at(double t) const;

  /// Returns the time at which s is reached, by bisection; inaccurate if the budget ends it.
  double time_of(double s, BudgetMeter& budget = unlimited()) const;

  /// Returns the times, in order and inside the duration, at which d2s/dt2 of the given scaling, or
  /// d3s/dt3 if TimeScaling::smooth, jumps by more than `fraction` of its largest magnitude, and
  /// the times `width` later.
  std::vector<double> kinks(double fraction) const;

 private:
  /// s and its derivatives `x` seconds after point k of the given scaling, relative to s there, and
  /// the integral of that change from 0 to x.
  struct Change {
    ParameterState change;
    double integral = 0;
  };
  Change after(std::size_t k, double x) const;
  double highest(std::size_t k, double x) const;    ///< see kinks()
  Quintic<double> polynomial(std::size_t k) const;  ///< where TimeScaling::smooth
  ParameterState given(double t) const;
  std::size_t step_at(double t) const;

  const TimeScaling& scaling_;
  double width_;
};

}  // namespace beeline::internal
