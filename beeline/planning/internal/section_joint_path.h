#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/math/polynomial.h>
#include <beeline/path/internal/following.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/tool_path.h>
#include <beeline/planning/internal/motion_request.h>

namespace beeline::internal {

/// A section of a branch, from one stop to the next: configurations with their path parameters.
struct BranchSection {
  std::vector<Configuration> samples;
  std::vector<double> path_parameters;
};

/// The joint path of a section, which makes the tool follow the tool path: quintics between samples
/// of the branch, at which the tool has the path's position, tangent and curvature. If the tool
/// deviates from the path by more than a hundredth of the tolerance between two samples, samples
/// are added there.
class SectionJointPath {
 public:
  /// Keeps references to the request's arm, path and task.
  SectionJointPath(const MotionRequest& request, BranchSection samples, BudgetMeter& budget);

  const JointPath& joint_path() const { return joint_path_; }

  /// The parameters of the joint path at the ends of segments, except the section's own.
  std::vector<double> segment_ends() const;

  /// The parameter of the joint path at the first sample from this path parameter on.
  double parameter_at(double path_parameter) const;

  /// Returns the path parameter of the tool at a configuration of the joint path with parameter s,
  /// or the path parameter of the nearest sample if it is at most `rounding` away.
  double path_parameter(const Configuration& q, double s, double rounding) const;

 private:
  /// A point of a segment.
  struct SegmentPoint {
    std::size_t index = 0;
    double fraction = 0;  ///< the segment parameter
  };

  SegmentPoint at(double s, double end) const;
  Polynomial segment_parameter(std::size_t j) const;
  SegmentPoint between(std::size_t j, const Polynomial& p, double u) const;
  ParameterRates rates_of(const SegmentPoint& place, std::size_t k) const;
  void interpolate();
  Deviation deviation(std::size_t k, const Polynomial& p, double u) const;
  bool add_samples(const Deviation& tolerance, BudgetMeter& budget);
  bool rests_at_limit(std::size_t k, Eigen::Index i) const;
  void follow(std::size_t k, const SegmentPoint& place);

  const Arm& arm_;
  const ToolPath& path_;
  const Task& task_;
  Bounds bounds_;
  BranchSection samples_;
  JointPath joint_path_;
};

}  // namespace beeline::internal
