#pragma once

#include <string>
#include <vector>

#include "screws.h"
#include "timing.h"

namespace beeline::bench {

/// Results over all poses, checked by forward kinematics.
class Check {
 public:
  /// `limits`: a solution outside the limits counts as wrong.
  Check(const Screws& screws, bool limits) : screws_(screws), limits_(limits) {}

  void begin_pose();
  void add(const Pose& goal, const Configuration& q);
  void end_pose();

  int poses() const { return poses_; }
  double solved() const;     ///< fraction of poses with a solution within 1e-6
  double solutions() const;  ///< mean number of correct solutions that differ by more than 1e-4
  int wrong() const {
    return wrong_;
  }  ///< number of returned configurations that are not solutions
  double worst_error() const { return worst_; }

 private:
  static constexpr double tolerance = 1e-6;  // metres and radians

  Screws screws_;
  bool limits_;
  int poses_ = 0, solved_ = 0, right_ = 0, wrong_ = 0;
  std::vector<Configuration> here_;  ///< of the current pose
  double worst_ = 0;
};

/// Returns one line of results as a JSON object.
std::string record(const std::string& arm, const std::string& question, const std::string& solver,
                   const Timing& timing, const Check& check);

}  // namespace beeline::bench
