#pragma once

#include <array>
#include <vector>

#include <beeline/inverse/analytic/raghavan_roth_elimination.h>
#include <beeline/model/internal/kept.h>

namespace beeline::internal {

/// The eliminations that suit an arm of six revolute joints best, by trial on random
/// configurations. The first is used; the others confirm or complete its result.
struct EliminationChoice {
  struct Chosen {
    int index = 0;  ///< see make_elimination()
    int degree = 8;
    bool double_zeros = false;
  };
  int count = 0;
  std::array<Chosen, 4> chosen{};
  /// Whether at least 99 % of the random configurations were found. Some of them may be singular.
  bool reliable = false;

  // As an arm keeps it: see Kept. `similar`: the choice for an arm of similar geometry, or null.
  using Key = OnlyKey;
  static constexpr SharedBy shared_by = SharedBy::limits_and_tools;
  static EliminationChoice make(const Arm& arm, const Key&, const EliminationChoice* similar);
  std::size_t heap_bytes() const { return 0; }
};

/// Takes milliseconds. Throws Error unless the chain has six revolute links, link i with
/// coordinate i.
EliminationChoice choose_eliminations(const Chain& chain);

/// Tries the eliminations chosen for an arm of similar geometry, in a fraction of the time.
EliminationChoice choose_eliminations(const Chain& chain, const EliminationChoice& similar);

/// Computes all solutions of an arm with six revolute joints of general geometry, up to 16, joint
/// limits ignored (see Elimination). If three consecutive axes intersect or are parallel, the zeros
/// of every determinant are double: use PieperSolver.
class RaghavanRothSolver {
 public:
  static constexpr int max_solutions = 16;

  /// Throws Error as choose_eliminations() does.
  RaghavanRothSolver(const Chain& chain, const EliminationChoice& choice);

  struct Result {
    int count = 0;  ///< number of solutions
    /// Whether there are no others: every zero of the determinant led to a solution, or four
    /// eliminations agree and at each of their other zeros there is clearly none. This is evidence,
    /// not a proof: within about 1e-3 rad of a singular pose, one in some thousand is missed.
    bool complete = false;
  };

  /// Computes the solutions, one column each, in [-pi, pi]. Their errors by forward kinematics are
  /// below 1e-12 (of the arm's size, and radians). Solutions closer than 1e-6 rad count as one.
  /// Does not allocate. Throws Error when q has fewer than 16 columns or the pose is not finite.
  Result solve(const Pose& world_T_tool,
               Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> q) const;

  // As an arm keeps it: see Kept. It takes too much memory for what arms share.
  using Key = OnlyKey;
  static constexpr SharedBy shared_by = SharedBy::copies;
  static RaghavanRothSolver make(const Arm& arm, const Key&, const EliminationChoice& choice) {
    return {chain_of(arm), choice};
  }
  std::size_t heap_bytes() const { return internal::heap_bytes(eliminations_); }

 private:
  Pose base_inverse_, tool_inverse_;
  Pose last_T_first_at_zero_;  ///< the inverse of the product of all links at q = 0
  RevoluteLinks links_;
  std::vector<Elimination> eliminations_;  ///< in the order of the choice
};

}  // namespace beeline::internal
