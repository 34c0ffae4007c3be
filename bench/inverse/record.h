#pragma once

#include <string>
#include <vector>

#include "screws.h"
#include "timing.h"

namespace beeline::bench {

/// What came back over all poses, put through forward kinematics.
class Check {
 public:
  /// `limits`: a solution outside them counts as wrong.
  Check(const Screws& screws, bool limits) : screws_(screws), limits_(limits) {}

  void begin_pose();
  void add(const Pose& goal, const Configuration& q);
  void end_pose();

  int poses() const { return poses_; }
  double solved() const;     ///< share of poses with a solution that reaches them to 1e-6
  double solutions() const;  ///< right ones a pose that differ by more than 1e-4, mean
  int wrong() const { return wrong_; }  ///< solutions returned that are none
  double worst_error() const { return worst_; }

 private:
  static constexpr double tolerance = 1e-6;  // metres and radians

  Screws screws_;
  bool limits_;
  int poses_ = 0, solved_ = 0, right_ = 0, wrong_ = 0;
  std::vector<Configuration> here_;  ///< the pose's
  double worst_ = 0;
};

/// One line of results, as a JSON object.
std::string record(const std::string& arm, const std::string& question, const std::string& solver,
                   const Timing& timing, const Check& check);

}  // namespace beeline::bench
