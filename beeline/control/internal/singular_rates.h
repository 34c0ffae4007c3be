#pragma once

#include <beeline/control/internal/weighted_task.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {

/// Joint velocities for a command, without the limits on velocity and acceleration.
struct Rates {
  Eigen::VectorXd velocity;      ///< q̇ with J q̇ = scale * v
  Eigen::VectorXd acceleration;  ///< q̈ that continuing at this q̇ requires
  double scale = 1;              ///< below 1 only if `regular` is false
  bool regular = true;           ///< whether A x = c has a solution
};

/// Fraction of a command; a smaller remainder counts as achieved.
constexpr double negligible_command = 1e-6;

/// Joint velocities at and next to a singularity, where A loses rank: a direction u of the tool's
/// motion has a singular value near zero.
///
/// Along the null motion n (unit length) at speed s the tool moves along u by second order only:
/// u^T ẍ = κ s² with the curvature κ = u^T Ȧ n.
///   κ has the sign of the command along u: n achieves the command, from rest ever faster.
///   κ has the other sign: the arm is at the boundary of its workspace, the velocity is zero.
///   κ = 0, as for a wrist: n does not move the tool, but rotates u until the command has no
///   component along it.
class SingularRates {
 public:
  explicit SingularRates(int dof);

  /// Computes rates.velocity, rates.acceleration and rates.scale at q; see ResolvedRates::solve().
  void solve(WeightedTask& task, const ConfigurationRef& q, const Eigen::VectorXd& last,
             double time_step, Rates& rates);

  /// Forgets the singular vectors of the last solve().
  void reset() { svd_.left.setIdentity(); }

 private:
  /// The direction u of the command that is lost.
  struct LostDirection {
    Eigen::Index index = -1;         ///< index of the singular value
    WeightedTask::Rows u, second;    ///< u, and the second-order motion Ȧ n
    double value = 0;                ///< singular value
    double command = 0;              ///< u^T c
    double curvature = 0, rate = 0;  ///< κ, and u̇^T A x for x of the other directions
    bool curved = false;             ///< whether κ is not zero
    bool achievable = false;         ///< whether κ has the sign of the command
  };

  Eigen::Index solve_other_directions(const WeightedTask& task);
  bool fill_null_motion(Eigen::Index index);
  LostDirection describe(WeightedTask& task, const ConfigurationRef& q, Eigen::Index index,
                         Rates& rates);
  double max_null_speed(const LostDirection& lost, double sign, const WeightedTask& task,
                        const Rates& rates, double time_step) const;
  double solve_lost_direction(const LostDirection& lost, const WeightedTask& task,
                              const Eigen::VectorXd& last, double time_step, Rates& rates);
  bool is_zero(const LostDirection& lost) const;

  SixRowSvd svd_;
  Eigen::VectorXd x_;          ///< weighted velocity
  Eigen::VectorXd null_;       ///< the null motion n
  Eigen::VectorXd candidate_;  ///< candidate for null_
  double largest_ = 0;         ///< largest singular value
};

}  // namespace beeline::internal
