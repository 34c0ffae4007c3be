#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

enum class InverseMethod {
  automatic,    ///< closed form if the arm has one, else numerical; for one solution of a redundant
                ///< arm also a search from a seed near the pose, to stay near it
  closed_form,  ///< all solutions by formulas and polynomials; Error if the arm has no closed form
  numerical,    ///< damped least squares from the seed and from random configurations
};
InverseMethod inverse_method_named(
    std::string_view name);  ///< throws Error, with the choices, for another name
std::string name(InverseMethod method);

/// Selection of one of infinitely many solutions, if the arm has more joints than the task has
/// rows. With a closed form the optimum is the best of all branches on a grid over the range of the
/// redundant joint, refined; otherwise it is local in the null space.
enum class Redundancy {
  any,      ///< the first solution found, searching outwards from the seed; near the seed if the
            ///< tool is near the pose there
  nearest,  ///< minimise the distance from the seed
  centred,  ///< maximise the least margin of a joint to its limits, relative to its range
};
Redundancy redundancy_named(std::string_view name);
std::string name(Redundancy redundancy);

struct InverseOptions {
  /// Configuration from which the distances of solutions are measured, (n,); default:
  /// middle_configuration(), the middle of the limits. It may be outside the limits.
  std::optional<Configuration> seed = std::nullopt;
  /// Components of the pose: spatial, position, planar, direction or approach:xy (arms of five
  /// joints), or a mask such as 111010, with :tool for the tool's axes; default: planar for a
  /// planar arm, whose poses must then be in its plane, else spatial.
  std::optional<Task> task = std::nullopt;
  InverseMethod method = InverseMethod::automatic;  ///< method of computation
  /// Whether all solutions are computed, instead of one. A closed form finds all solutions; for a
  /// redundant arm, all solutions on a grid of values of the redundant joint. The numerical method
  /// finds solutions in all restarts, and some may be missing. Arms of seven revolute joints
  /// without a closed form have one with a joint locked, for this option and a `grid` up to 256.
  bool all = false;
  /// With `all`, whether to include solutions that differ by multiples of 2 pi. Of a joint without
  /// a lower or an upper limit, which has infinitely many, only the value nearest to the seed is.
  bool every_turn = false;
  bool ignore_limits = false;  ///< whether to ignore the joint limits
  /// Reason why a configuration must not be given as a solution, none if it may; usually
  /// blocked_by() of a CollisionModel of the same arm (in Python the model). Solutions with a
  /// reason are in InverseResult::blocked. If the one that was requested has a reason, all are
  /// computed as with `all`, and the first without a reason is given: the nearest to the seed or,
  /// of a redundant arm, the best on the grid as `redundancy` says. Called by several threads in
  /// batches. Default: every solution is given.
  std::function<Reason(const ConfigurationRef&)> blocked_by = {};
  /// Index of a coordinate, from 0 to dof - 1, that keeps the seed's value; default: none.
  std::optional<int> lock = std::nullopt;
  /// Selection of one of infinitely many solutions. Default: with a seed the nearest one that a
  /// search from it finds, near a local minimum of the distance, if the arm has a closed form for
  /// each value of its redundant joint, such as panda, and `method` is automatic; otherwise `any`.
  /// The search takes about 3 us from a seed near the pose and 7 us from another seed. `nearest`,
  /// which compares all branches over the range of the redundant joint, takes 150 us or more.
  std::optional<Redundancy> redundancy = std::nullopt;
  /// Max deviation of the tool from the pose if the pose itself has no solution within limits, in
  /// the pose's axes: x, y, z (m) and roll, pitch, yaw (rad) as in URDF; x, y, theta for a planar
  /// arm. Each is 0 or more, and angles are at most pi. One solution is returned, whose deviation
  /// is a local minimum of the sum of squares relative to these values: see
  /// InverseResult::deviation. Default: none.
  std::optional<Eigen::VectorXd> pose_tolerance = std::nullopt;
  /// Weight of each coordinate in distances from the seed, sqrt(sum w_k (q_k - seed_k)^2), (n,),
  /// 1e-6 to 1e6; default: 1 each. Redundancy::nearest with a rest posture as the seed prefers that
  /// posture.
  std::optional<Eigen::VectorXd> weights = std::nullopt;
  int grid = 32;  ///< number of values of the redundant joint tried first, 2 to 10000
  /// Max error of a solution, metres and radians, above 0 and at most 0.1. It is raised to the
  /// rounding error of forward kinematics, about 1e-14 of the arm's size, if that is larger (a
  /// reach above 1e4 m).
  double tolerance = 1e-10;
  int max_iterations = 100;  ///< max steps of the numerical solver from one start, 0 or more
  /// Max random starts after the first, 0 or more. Without a solution, a search for the nearest
  /// pose follows, which neither bounds: a solution that it finds is given, and
  /// InverseResult::restarts counts its starts.
  int max_restarts = 1000;
  /// Seed of the random numbers; the same value gives the same result.
  std::uint64_t random_seed = 1;
  /// Budget of one call. Closed forms for one value of a redundant joint are not interrupted: they
  /// take microseconds.
  Budget budget = {};
};

enum class InverseStatus {
  solved,       ///< at least one solution was found and checked by forward kinematics
  unreachable,  ///< no configuration brings the tool to the position, with or without limits:
                ///< proved by geometry, or none of 64 searches for the position alone succeeds
  orientation_unreachable,  ///< the position is reached, but not with this orientation: by the
                            ///< closed form, or none of at least 32 searches comes within 1e-3 rad
  outside_limits,  ///< the pose is reached, but no solution within the joint limits was found; none
                   ///< exists if `reason` is ReasonCode::all_solutions_outside_limits
  not_found,   ///< the search ended without a solution, which proves nothing; searches say no more
               ///< of arms with helical joints
  time_limit,  ///< the budget's time ended the search; `solutions` has the solutions found so far
  cancelled,   ///< the search was cancelled; as for `time_limit`
  work_limit,  ///< the budget's work ended the search; as for `time_limit`
  blocked,     ///< no solution may be given: each that was found has a reason by
               ///< InverseOptions::blocked_by, see InverseResult::blocked
};
std::string name(InverseStatus status);
std::vector<std::string> inverse_status_names();  ///< in the order of their numbers

/// The configuration nearest to the requested pose.
struct NearestMiss {
  /// Configuration, (n,). With outside_limits: the solution that is least outside the limits. With
  /// not_found, or ended by the budget: the configuration of least error that was found. Otherwise:
  /// a configuration of least position error and, among those, of least orientation error, limits
  /// ignored, found by a search from many starts.
  Configuration q;
  Pose world_T_tool;  ///< tool pose at q
  Deviation error;    ///< error of that pose relative to the requested one
  int blocking = -1;  ///< with outside_limits, the coordinate that is farthest outside; else -1
  double excess = 0;  ///< with outside_limits, the distance beyond the limit, radians or metres
};

/// A solution that must not be given.
struct BlockedSolution {
  Configuration q;     ///< configuration, (n,)
  Reason reason = {};  ///< why, by InverseOptions::blocked_by
};

/// The values of the redundant joint for which all solutions were computed.
struct SolutionGrid {
  int joint = 0;                    ///< index of the coordinate, from 0 to dof - 1
  std::vector<double> values = {};  ///< values of the joint, ascending, radians or metres
  /// Values for which no solution is missing, ascending, radians or metres.
  std::vector<double> complete = {};
};

/// A request for inverse kinematics: the arguments of inverse_kinematics().
struct InverseRequest {
  Arm arm;
  Pose world_T_tool;
  InverseOptions options = {};  ///< without `blocked_by` and `budget`
};

/// The solutions of inverse kinematics, or the reason why there are none.
struct InverseResult {
  InverseStatus status = InverseStatus::not_found;
  /// Solutions by distance from the seed, (S, n), which options.blocked_by allows. A seed that is a
  /// solution comes first. They are empty unless the status is solved, or the budget ended the
  /// search for all solutions or for the best one. Then some solutions, or a better one, may be
  /// missing.
  std::vector<Configuration> solutions;
  /// Solutions that must not be given, with options.blocked_by, in the order of `solutions`. For
  /// one solution: those that come before it.
  std::vector<BlockedSolution> blocked = {};
  /// With `all`, whether `solutions` and `blocked` are all that exist, which are finitely many. Of
  /// six general joints this is evidence, not a proof: nearly singular poses may have others, close
  /// to one of these.
  bool complete = false;
  /// Whether every branch is represented, with `all`. It is true if `complete` is. It is also true
  /// at singular poses if the closed form was evaluated over the whole range of its free joints:
  /// each connected set of infinitely many solutions within limits is then represented by its
  /// solution nearest to the seed.
  bool branches_complete = false;
  /// Dimension of the set of solutions, limits ignored, with `all`. 0: each solution is isolated. 1
  /// or more: there are infinitely many solutions, connected by self-motions of the arm, and
  /// `solutions` has samples of them. A redundant arm has as many dimensions as redundant joints;
  /// `lock` keeps a joint, and `redundancy` selects one solution. If every solution is singular, it
  /// is estimated from solutions found beside them.
  int self_motion_dimension = 0;
  /// Values of the redundant joint, with `all`, for a redundant arm that has a closed form once one
  /// joint is locked.
  std::optional<SolutionGrid> grid;
  /// Whether the pose was solved at a singular configuration: a solution is one of infinitely many,
  /// connected by self-motions, and with a closed form it is the nearest of them to the seed. With
  /// `all`, every solution is examined; otherwise only a closed form reports it.
  bool singular = false;
  /// Larger of the position and orientation errors, metres or radians. With solved: the largest
  /// error of a solution. With unreachable: the least position error. With orientation_unreachable:
  /// the angle of the nearest miss. With outside_limits: the excess of the nearest miss. Otherwise:
  /// the error of the solutions, or of the nearest miss, which it is found with: NaN before.
  double residual = 0;
  /// Deviation of the tool from the pose, with options.pose_tolerance, in the order of that option
  /// and within it. `residual` is then the error beyond this deviation.
  std::optional<Eigen::VectorXd> deviation;
  /// Configuration nearest to the pose, if there are no solutions, which may exceed the limits: see
  /// NearestMiss. The status is often known without it; then it is searched for when it is asked
  /// for: in Python by the first use of `nearest`, `residual` or `reason`, or by a pickle, a copy
  /// or a comparison; in C++ see `unexplained`. That takes 1 to 20 ms for seven joints.
  std::optional<NearestMiss> nearest;
  /// Why; none if solved and not singular. Its values are found with the nearest miss.
  Reason reason = {};
  /// The request, while the configuration nearest to the pose was not searched for: see explain().
  std::optional<InverseRequest> unexplained;
  std::string
      method;  ///< name of the method, such as `closed form: three axes meet (joints 4, 5, 6)`
  int iterations = 0;  ///< number of iterations of the numerical solver, over all starts
  int restarts = 0;    ///< number of random starts

  /// Returns whether there is a solution.
  explicit operator bool() const { return status == InverseStatus::solved; }
};
/// Prints the status with the reason, or with the number of solutions and a line for each. Takes as
/// long as explain() for an unexplained result.
std::ostream& operator<<(std::ostream& out, const InverseResult& result);

/// Computes joint configurations that bring the tool to `world_T_tool`, in the components of the
/// task. The method follows from the arm's geometry: see inverse_method(). What depends on the arm
/// alone is computed by its first call and kept as long as a copy of the arm exists: at most 64 kB,
/// for all threads. Every q returned is finite, within limits, and checked by forward kinematics.
/// Angles are the equivalent values
/// nearest to the seed within limits (nearest to zero if a joint without limits has a seed beyond
/// 1e3 rad). Prismatic and helical joints are not wrapped, and neither are joints with a mimic
/// joint whose ratio is not an integer. Distances from the seed are Euclidean; radians and metres
/// have equal weight unless options.weights differ. Throws Error when the pose, the seed or an
/// option is not valid.
InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options = {});

/// Searches for the configuration nearest to the pose, if result.unexplained has a value: sets
/// `nearest`, `residual` and the values in `reason`, and removes the request. Takes 1 to 20 ms for
/// seven joints, a hundred times as long as the status. If the budget ends it, the nearest
/// configuration that was found so far is given. The status does not change, unless the search
/// finds a solution that closed form and range examination missed: the result is then that
/// solution, or `outside_limits` if it exceeds the limits.
void explain(InverseResult& result, const Budget& budget = {});

/// Writes the solutions for control loops, nearest to `seed` first, into the columns of
/// `solutions`, as many as fit (one suffices unless options.all), and returns their number. `seed`
/// takes the place of options.seed, also for the default of options.redundancy. Returns 0, without
/// a diagnosis, if there is none, or if the budget ended before one was found. Solutions of a
/// closed form are checked by closing the loop. Does not allocate in the ordinary case;
/// `blocked_by` does, approach:xy and its kind, and a lock, unless it is the first or last of seven
/// joints. Throws Error as inverse_kinematics() does, and for `solutions` of another size.
int inverse_kinematics(const Arm& arm, const Pose& world_T_tool, const ConfigurationRef& seed,
                       Eigen::Ref<Eigen::MatrixXd> solutions, const InverseOptions& options = {});

/// Returns whether the arm has a closed form for these options, and the method is not numerical.
bool has_closed_form(const Arm& arm, const InverseOptions& options = {});

/// Returns the name of the closed form that the arm has for these options, such as `closed form:
/// planar`, or `numerical`. With options.lock, a closed form of the remaining joints may be used
/// instead: see InverseResult::method.
std::string inverse_method(const Arm& arm, const InverseOptions& options = {});

}  // namespace beeline
