#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

enum class InverseMethod {
  automatic,    ///< closed form where the arm has one, else numerical
  closed_form,  ///< all solutions by formulas and polynomials; Error where the arm has none
  numerical,    ///< descents from the seed and from random configurations
};
InverseMethod inverse_method_named(std::string_view name);  ///< throws Error, naming the choices
std::string name(InverseMethod method);

/// Which of infinitely many, where the arm has more joints than the task has rows: over the whole
/// range of the joint to spare by a closed form, else as far as steps downhill from a solution go.
enum class Redundancy {
  any,      ///< the first that is met, going out from the seed
  nearest,  ///< the nearest to the seed
  centred,  ///< the farthest from the limits: the least share of a joint's range left is largest
};
Redundancy redundancy_named(std::string_view name);
std::string name(Redundancy redundancy);

struct InverseOptions {
  /// Solutions nearest to it come first; default: the middle of the limits.
  std::optional<Configuration> seed = std::nullopt;
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  InverseMethod method = InverseMethod::automatic;
  /// Closed form: all solutions there are, else the nearest only; with a joint to spare, all on a
  /// grid of values of that joint. Numerical: those that all restarts meet, of which some may be
  /// missing, else the first that is met.
  bool all = false;
  bool every_turn = false;     ///< with `all`: the same posture by every turn within limits
  bool ignore_limits = false;  ///< joint limits do not count
  std::optional<int> lock = std::nullopt;  ///< a coordinate that stays at the seed's value
  Redundancy redundancy = Redundancy::any;
  int grid = 32;  ///< values of the joint to spare that are tried first
  /// Largest error of a solution, metres and radians. Never taken below the rounding of forward
  /// kinematics, about 1e-14 of the arm's size: from a reach of 1e4 m on that is what counts.
  double tolerance = 1e-10;
  int iterations = 100;           ///< most steps of the numerical solver in one descent
  int restarts = 1000;            ///< most descents after the first, from random configurations
  std::uint64_t random_seed = 1;  ///< the same seed gives the same answer
  /// Seconds after which a numerical search ends with what it has; then the answer may depend on
  /// the machine. Formulas, and the reason where there is no solution, are not cut short: they may
  /// take milliseconds more, and a fine grid longer.
  std::optional<double> time_limit = std::nullopt;
};

enum class InverseStatus {
  solved,       ///< at least one solution, checked by forward kinematics
  unreachable,  ///< the tool cannot come to the position, limits or not: of 64 descents for the
                ///< position alone none does
  orientation_unreachable,  ///< it can come to the position, but not with the orientation that is
                            ///< asked for: by the closed form, or none of 64 descents and more came
                            ///< within 1e-3 rad
  outside_limits,  ///< it can come to the pose, but within the joint limits no solution was found,
                   ///< and none exists where a closed form says so: see the reason
  not_found,       ///< the search ended without a solution; that none exists is not shown
};
std::string name(InverseStatus status);

/// The configuration that comes nearest to what was asked.
struct NearestMiss {
  /// Outside_limits: a solution, and the least outside limits. Not_found: what came nearest. Else
  /// limits do not count: where the tool is nearest to the position, and of those, as far as a
  /// search from many places shows, to the orientation.
  Configuration q;
  Pose world_T_tool;  ///< what it reaches
  Deviation error;    ///< from the pose asked for
  int blocking = -1;  ///< outside_limits: the coordinate that is outside, by ...
  double excess = 0;  ///< ... this much (radians or metres)
};

struct InverseResult {
  InverseStatus status = InverseStatus::not_found;
  std::vector<Configuration> solutions;  ///< by distance from the seed; empty unless solved
  bool complete = false;                 ///< with `all`: these are all there are, of finitely many
  /// Solved by a closed form, but singular: the solutions given stand for infinitely many that are
  /// one motion of the arm with the tool at rest; those with the joints concerned nearest to the
  /// seed are given.
  bool singular = false;
  /// Metres or radians, whichever is larger. Solved: the largest error that forward kinematics
  /// shows. Unreachable: how far the position is out of reach. Orientation: the angle that the
  /// nearest miss is off by. Outside limits: the nearest miss's excess. Not found: the nearest
  /// miss's error.
  double residual = 0;
  std::optional<NearestMiss> nearest;  ///< unless solved
  std::string reason;                  ///< one sentence; empty when solved and not singular
  std::string method;                  ///< such as "closed form: three axes meet (joints 4, 5, 6)"
  int iterations = 0;                  ///< of the numerical solver, over all descents
  int restarts = 0;                    ///< descents from random configurations
};
/// Prints the status with the reason, or with the number of solutions and a line for each.
std::ostream& operator<<(std::ostream& out, const InverseResult& result);

/// The joint configurations that bring the tool to `world_T_tool`, as far as the task asks.
/// Chooses the method from the arm's geometry: see InverseSolver::method(). Every q returned has
/// been put through forward kinematics, and is finite and within limits. Angles are given by the
/// turn that is nearest to the seed within limits (to zero, where a joint without limits has a seed
/// beyond 1e3 rad); lengths, helical joints and joints whose
/// followers would not come round as well are never wrapped. Distances from the seed are
/// Euclidean, radians and metres weighing alike.
/// Throws Error when the pose, the seed or an option makes no sense.
InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options = {});

namespace internal {
struct InverseMethods;
}

/// inverse_kinematics() for many poses of one arm: what does not depend on the pose is done once.
/// Not for use by two threads at a time; copies are cheap enough to give one to each.
class InverseSolver {
 public:
  explicit InverseSolver(const Arm& arm, const InverseOptions& options = {});
  InverseSolver(const InverseSolver& other);
  ~InverseSolver();

  /// In words: the closed form that the arm has, or "numerical". With a joint locked that may be
  /// less than solve() finds for the arm that is left.
  std::string method() const;

  InverseResult solve(const Pose& world_T_tool);
  InverseResult solve(const Pose& world_T_tool, const ConfigurationRef& seed);

  /// For loops: writes the solutions nearest to `seed` first into the columns of `solutions`, as
  /// many as there is room for (one suffices unless options.all), and returns how many. No reason
  /// is looked for where there is none: the answer is then 0. What a closed form gives is checked
  /// by closing the loop, which is forward kinematics all around it. Does not allocate in the
  /// ordinary course; a lock at ever new values does, unless it is the first or last of seven
  /// joints. Throws Error when a size does not fit or a number is not finite.
  int solve(const Pose& world_T_tool, const ConfigurationRef& seed,
            Eigen::Ref<Eigen::MatrixXd> solutions);

 private:
  std::unique_ptr<internal::InverseMethods> methods_;
};

}  // namespace beeline
