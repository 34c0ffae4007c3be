#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

enum class InverseMethod {
  automatic,    ///< closed form where the arm has one, else numerical
  closed_form,  ///< all solutions by formulas and polynomials; Error where the arm has none
  numerical,    ///< damped least squares from the seed and from random configurations
};
InverseMethod inverse_method_named(std::string_view name);  ///< throws Error, naming the choices
std::string name(InverseMethod method);

/// Selects one of infinitely many solutions if the arm has more joints than the task has rows. With
/// a closed form it is the best over the whole range of the redundant joint, otherwise a local
/// optimum in the null space.
enum class Redundancy {
  any,      ///< the first that is found, searching outwards from the seed
  nearest,  ///< minimise the distance from the seed
  centred,  ///< maximise the least margin of a joint to its limits, relative to its range
};
Redundancy redundancy_named(std::string_view name);
std::string name(Redundancy redundancy);

struct InverseOptions {
  /// Solutions are sorted by their distance from it; default: middle_configuration(), the middle of
  /// the limits. It may be outside the limits.
  std::optional<Configuration> seed = std::nullopt;
  /// Components of the pose: spatial, position, planar, or a mask such as 111110, with :tool in the
  /// tool's axes; default: planar for a planar arm, else spatial.
  std::optional<Task> task = std::nullopt;
  InverseMethod method = InverseMethod::automatic;  ///< how solutions are computed
  /// All solutions instead of one. Closed form: all that exist; of a redundant arm, all on a grid
  /// of values of the redundant joint. Numerical: those found in all restarts, some may be missing.
  /// Arms of seven revolute joints without a closed form have one with a joint locked, for this and
  /// a `grid` up to 256.
  bool all = false;
  bool every_turn = false;     ///< with `all`: also solutions that differ by multiples of 2 pi
  bool ignore_limits = false;  ///< ignore the joint limits
  /// A coordinate, from 0 to dof - 1, that keeps the seed's value; default: none.
  std::optional<int> lock = std::nullopt;
  Redundancy redundancy = Redundancy::any;  ///< which one of infinitely many solutions
  /// How far the tool may deviate from the pose if that itself has no solution within limits, in
  /// the pose's axes: x, y, z (m) and roll, pitch, yaw (rad) as in URDF; x, y, theta for a planar
  /// arm. Each 0 or more, angles at most pi. One solution is given, of locally least deviation (the
  /// sum of squares, relative to these): see InverseResult::deviation. Default: none.
  std::optional<Eigen::VectorXd> pose_tolerance = std::nullopt;
  /// Weight of each coordinate in distances from the seed, sqrt(sum w_k (q_k - seed_k)^2), (n,),
  /// 1e-6 to 1e6; default: 1 each. Redundancy::nearest with a posture of rest as the seed prefers
  /// that posture.
  std::optional<Eigen::VectorXd> weights = std::nullopt;
  int grid = 32;  ///< number of values of the redundant joint tried first, 2 to 10000
  /// Max error of a solution, metres and radians, above 0. Raised to the rounding error of forward
  /// kinematics, about 1e-14 of the arm's size, where that is larger (a reach above 1e4 m).
  double tolerance = 1e-10;
  int max_iterations = 100;       ///< max steps of the numerical solver from one start, 0 or more
  int max_restarts = 1000;        ///< max random starts after the first, 0 or more
  std::uint64_t random_seed = 1;  ///< the same value gives the same result
  /// Of one call. Closed forms for one value of a redundant joint are not interrupted: they take
  /// microseconds.
  Budget budget = {};
};

enum class InverseStatus {
  solved,       ///< at least one solution, checked by forward kinematics
  unreachable,  ///< no configuration brings the tool to the position, with or without limits:
                ///< proved by geometry, or none of 64 searches for the position alone does
  orientation_unreachable,  ///< the position is reached, but not with this orientation: by the
                            ///< closed form, or none of at least 64 searches comes within 1e-3 rad
  outside_limits,  ///< the pose is reached, but no solution within the joint limits was found; none
                   ///< exists where `reason` says that every solution is outside
  not_found,       ///< the search ended without a solution, which proves nothing
  time_limit,      ///< the budget's time ended the search; `solutions` are those found so far
  cancelled,       ///< the search was cancelled; as for `time_limit`
  work_limit,      ///< the budget's work ended the search; as for `time_limit`
};
std::string name(InverseStatus status);

/// The configuration nearest to the requested pose.
struct NearestMiss {
  /// outside_limits: the solution that is least outside the limits. not_found, or ended by the
  /// budget: the configuration of least error that was found. Otherwise a configuration of least
  /// position error and, among those, of least orientation error, limits ignored, found by a search
  /// from many starts.
  Configuration q;
  Pose world_T_tool;  ///< the tool pose at q
  Deviation error;    ///< of that pose from the requested one
  int blocking = -1;  ///< outside_limits: the coordinate that is farthest outside; else -1
  double excess = 0;  ///< outside_limits: how far it is outside, radians or metres
};

/// The values of the redundant joint at which all solutions were sought.
struct SolutionGrid {
  int joint = 0;                      ///< the coordinate, from 0 to dof - 1
  std::vector<double> values = {};    ///< ascending, radians or metres
  std::vector<double> complete = {};  ///< those of the values at which no solution is missing
};

/// Solutions of inverse kinematics, or why there are none.
struct InverseResult {
  InverseStatus status = InverseStatus::not_found;
  /// By distance from the seed: a seed that is a solution comes first, (S, n). Empty unless solved,
  /// or ended by the budget where all solutions are requested or the best one: then some may be
  /// missing, or a better one.
  std::vector<Configuration> solutions;
  bool complete = false;  ///< with `all`: these are all solutions, which are finitely many
  /// With `all`: every branch is represented. True where `complete` is, and at singular poses where
  /// the closed form was evaluated over the whole range of its free joints: of each connected set
  /// of infinitely many solutions within limits the one nearest to the seed is given.
  bool branches_complete = false;
  /// With `all`: the dimension of the set of solutions, limits ignored. 0: each solution is
  /// isolated. 1 or more: there are infinitely many, connected by self-motions of the arm, of which
  /// `solutions` are samples: a redundant arm has as many dimensions as redundant joints; `lock`
  /// keeps a joint, `redundancy` selects one solution. At a singular configuration 1 stands for 1
  /// or more.
  int self_motion_dimension = 0;
  /// With `all`, for a redundant arm that has a closed form once one joint is locked.
  std::optional<SolutionGrid> grid;
  /// Solved at a singular configuration: a solution is one of infinitely many, connected by
  /// self-motions; by a closed form the nearest of them to the seed. With `all`, every solution is
  /// examined; otherwise only a closed form reports it.
  bool singular = false;
  /// Metres or radians, the larger of both. solved: the largest error of a solution.
  /// unreachable: the least position error. orientation_unreachable: the nearest miss's angle.
  /// outside_limits: the nearest miss's excess. Otherwise: that of solutions, or of the nearest
  /// miss.
  double residual = 0;
  /// With options.pose_tolerance, of the solution: the tool's deviation from the pose, in the order
  /// of that option, and within it. `residual` is then what exceeds this deviation.
  std::optional<Eigen::VectorXd> deviation;
  std::optional<NearestMiss> nearest;  ///< the nearest miss, if there are no solutions
  Reason reason = {};                  ///< one sentence; none when solved and not singular
  std::string method;                  ///< such as `closed form: three axes meet (joints 4, 5, 6)`
  int iterations = 0;                  ///< of the numerical solver, over all starts
  int restarts = 0;                    ///< number of random starts

  /// Whether there is a solution.
  explicit operator bool() const { return status == InverseStatus::solved; }
};
/// Prints the status with the reason, or with the number of solutions and a line for each.
std::ostream& operator<<(std::ostream& out, const InverseResult& result);

/// Computes joint configurations that bring the tool to `world_T_tool`, in the components of the
/// task. The method follows from the arm's geometry: see InverseSolver::method(). Every q returned
/// is checked by forward kinematics, finite and within limits. Angles are given as the equivalent
/// value nearest to the seed within limits (nearest to zero if a joint without limits has a seed
/// beyond 1e3 rad); prismatic and helical joints, and joints with a mimic joint of another ratio
/// than a whole one, are not wrapped. Distances from the seed are Euclidean; radians and metres
/// weigh alike unless options.weights differ. Throws Error when the pose, the seed or an option is
/// not valid.
InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options = {});

namespace internal {
struct SolverState;
}

/// inverse_kinematics() for many poses of one arm: what does not depend on the pose is computed
/// once. Not thread-safe; give each thread a copy.
class InverseSolver {
 public:
  explicit InverseSolver(const Arm& arm, const InverseOptions& options = {});
  InverseSolver(const InverseSolver& other);
  ~InverseSolver();

  /// Returns the name of the closed form that the arm has, or "numerical". With options.lock,
  /// solve() may use a closed form of the remaining joints instead: see InverseResult::method.
  std::string method() const;
  /// Returns closed_form where the arm has one, else numerical.
  InverseMethod chosen_method() const;

  InverseResult solve(const Pose& world_T_tool);
  InverseResult solve(const Pose& world_T_tool, const ConfigurationRef& seed);

  /// For control loops: writes the solutions, nearest to `seed` first, into the columns of
  /// `solutions`, as many as fit (one suffices unless options.all), and returns their number; 0 if
  /// there is none, or the budget ended before one was found, without a diagnosis. Solutions of a
  /// closed form are checked by closing the loop. Does not allocate in the ordinary case; a lock
  /// with a new value in each call does, unless it is the first or last of seven joints. Throws
  /// Error when a size does not fit or a number is not finite.
  int solve(const Pose& world_T_tool, const ConfigurationRef& seed,
            Eigen::Ref<Eigen::MatrixXd> solutions);

 private:
  std::unique_ptr<internal::SolverState> state_;
};

}  // namespace beeline
