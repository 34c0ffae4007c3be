#pragma once

#include <vector>

#include <beeline/path/joint_path.h>
#include <beeline/timing/internal/averaged_scaling.h>
#include <beeline/timing/internal/sampled_section.h>

namespace beeline::internal {

/// The motion of the joints along a path by a time scaling. Keeps references to both.
class JointMotion {
 public:
  JointMotion(const JointPath& path, const AveragedScaling& scaling)
      : path_(path), scaling_(scaling) {}

  const AveragedScaling& scaling() const { return scaling_; }

  struct State {
    Configuration q, v, a;
    ParameterState progress;
  };

  State at(double t) const { return at(scaling_.at(t)); }
  State at(const ParameterState& now) const;

 private:
  PathPoint point_at(std::size_t step, double s) const;

  const JointPath& path_;
  const AveragedScaling& scaling_;
};

/// A sample of the motion: its time and state.
struct Sample {
  double t = 0;
  JointMotion::State state;
};

/// The samples with the columns of the interpolation.
SampledSection with_columns(const Arm& arm, const std::vector<Sample>& samples,
                            Interpolation interpolation);

}  // namespace beeline::internal
