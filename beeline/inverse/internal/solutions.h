#pragma once

#include <limits>
#include <optional>

#include <beeline/internal/thread_scratch.h>
#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/numerical/posture_index.h>

namespace beeline::internal {

/// A solution within limits.
struct Solution {
  Configuration q;
  double error = 0;      ///< larger of the position and orientation error, metres or radians
  bool regular = false;  ///< whether it is known to be far from singular ones
  /// Distance from the seed; NaN: sort_solutions() computes it.
  double distance = std::numeric_limits<double>::quiet_NaN();
};

/// The solutions of a request, in memory that the thread uses again.
class Solutions {
 public:
  /// Appends a solution with values of an earlier request, but its distance is not known.
  Solution& add() {
    if (count_ == kept_.size()) kept_.emplace_back();
    Solution& added = kept_[count_++];
    added.distance = std::numeric_limits<double>::quiet_NaN();
    return added;
  }
  void resize(std::size_t fewer) { count_ = fewer; }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  Solution* begin() { return kept_.data(); }
  Solution* end() { return kept_.data() + count_; }
  bool is_small() const { return kept_.capacity() <= 256; }

  Configuration candidate;  ///< memory for the one that is computed next

 private:
  std::vector<Solution> kept_;
  std::size_t count_ = 0;
};

/// The stages' evidence about solutions when joint limits are ignored. diagnose() derives the
/// status of a request without solutions from it.
struct UnconstrainedResult {
  bool complete = false;           ///< whether all solutions that exist have been examined
  bool branches_complete = false;  ///< the same, or a solution of every branch of infinitely many
  bool doubtful = false;           ///< whether rounding may have hidden a solution
  bool continuum = false;          ///< whether some solutions represent infinitely many
  /// Every branch was followed over the range of the redundant joint and is outside the limits.
  bool range_examined = false;
  bool far = false;             ///< whether the searches without limits all ended far from the pose
  bool solved_outside = false;  ///< whether a solution outside the limits was found
  std::optional<Infeasibility> violation;  ///< a proof that there are no solutions
  /// The solution with the smallest excess() over the limits.
  std::optional<Configuration> least_outside;
  double excess = 0;  ///< excess of `least_outside`

  /// Replaces `least_outside` by q's representative nearest to the seed if its excess over the
  /// limits is less.
  void consider(const Request& request, const Configuration& q);
};

/// The solutions and evidence that the stages have found so far.
struct StageResult {
  StageResult() { solutions->resize(0); }

  ThreadScratch<Solutions> solutions;  ///< within limits
  PostureIndex postures;               ///< index of the solutions
  InverseResult result;                ///< everything else
  UnconstrainedResult unconstrained;
  bool near_seed = false;  ///< whether the solutions are local minima of the distance
};

/// Returns the larger of the task's position and orientation error at q, by forward kinematics.
double error_at(const Request& request, const ConfigurationRef& q);

/// Whether the least singular value of the task's Jacobian at q is below a fraction of the largest.
bool nearly_singular(const Request& request, const Configuration& q, double fraction);

/// Properties of a configuration that its method of computation knows.
struct Knowledge {
  bool continuum = false;  ///< whether it represents infinitely many solutions
  bool regular = false;    ///< see Solution
  bool within = false;     ///< whether it is within limits, and none of its turns is nearer
  double error = std::numeric_limits<double>::quiet_NaN();  ///< see Solution; NaN: not known
};

/// Adds the representative of q nearest to the seed to the solutions if it is within limits,
/// forward kinematics confirms it, and it is new. Levenberg-Marquardt steps correct its last
/// digits. Returns whether it is added.
bool add_solution(const Request& request, const ConfigurationRef& q, StageResult& found,
                  const Knowledge& known = {});

/// Takes a candidate of a closed form, limits ignored, and corrects it if forward kinematics does
/// not confirm it. It then counts as evidence and, within limits, as a solution.
void add_candidate(const Request& request, Configuration& q, StageResult& found,
                   const Knowledge& known = {});

/// Sorts the solutions by their distance from the seed and keeps the first of those that coincide.
/// Adds the representatives with other multiples of 2 pi if they are requested, and keeps the first
/// solution unless all are requested.
void sort_solutions(const Request& request, Solutions& solutions);

/// Fills in status, residual and solutions of a result that has some.
void set_solved(const Request& request, StageResult& found);

}  // namespace beeline::internal
