#pragma once

#include <beeline/path/joint_path.h>

namespace beeline::internal {

/// Evaluates the derivatives of a joint path at many path parameters: computes the polynomial of
/// each step once and does not allocate. Agrees with path_point().
class PathDerivatives {
 public:
  explicit PathDerivatives(const JointPath& path);

  std::size_t joints() const { return joints_; }
  std::size_t steps() const { return lengths_.size(); }

  /// Writes dq/ds, d2q/ds2 and d3q/ds3 at the fraction u (0 to 1) of a step, `joints()` numbers
  /// each.
  void at(std::size_t step, double u, double* dq, double* ddq, double* dddq) const;

 private:
  std::size_t joints_;
  std::vector<double> lengths_;       ///< of the steps
  std::vector<double> coefficients_;  ///< of dq/ds in u: for each step five rows of all joints
};

}  // namespace beeline::internal
