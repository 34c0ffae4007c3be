#pragma once

#include <beeline/path/joint_path.h>

namespace beeline {

/// A path's derivatives by s anywhere, as path_point() has them, for many places: each step's
/// polynomial is set up once, and nothing allocates.
class PathRates {
 public:
  explicit PathRates(const JointPath& path);

  std::size_t joints() const { return joints_; }
  std::size_t steps() const { return lengths_.size(); }

  /// At the fraction `share` (0 to 1) of a step: q', q'' and q''', `joints()` numbers each.
  void at(std::size_t step, double share, double* dq, double* ddq, double* dddq) const;

 private:
  std::size_t joints_;
  std::vector<double> lengths_;  ///< of the steps
  std::vector<double> terms_;    ///< of q' by the share: for each step five rows, of all joints
};

}  // namespace beeline
