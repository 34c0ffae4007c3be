#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/numerical/error_minimum.h>
#include <beeline/inverse/numerical/multi_start.h>
#include <beeline/inverse/numerical/posture_index.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/inverse/numerical/singular_solution.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

// Steps between two checks of the budget, which may be exceeded by this number. Most runs end
// within it, so the clock is rarely read.
constexpr int steps_per_check = 16;
// Max restarts after a lane has stagnated within the tolerance, in search of one that converges to
// rounding. Bounds the time that a nearly singular pose takes.
constexpr int restarts_for_fine = 256;
// A lane that ends with an error below this, radians or units of length, has stagnated next to a
// solution or a minimum just above zero; few of the latter should take time.
constexpr double next_to_a_solution = 1e-3;
constexpr int max_continued = 16;
constexpr int restarts_before = 64;  // nearly all other poses are solved by then
constexpr int slow_convergence = 3;  // steps at a singularity for each step elsewhere
constexpr std::size_t max_nearest = 16;

/// Outcomes of a lane, worst first.
enum class Grade { none, not_converged, coarse, converged };

/// One call of multi_start().
class Run {
 public:
  Run(const Search& search, const Pose& world_T_tool, const ConfigurationRef& start,
      const MultiStartOptions& options, MultiStartBuffers& buffers, SearchResult& result)
      : arm_(search.arm),
        problem_(search.problem),
        seeds_(search.seeds),
        world_T_tool_(world_T_tool),
        start_(start),
        options_(options),
        near_(buffers.near),
        lanes_(buffers.lanes),
        q_(buffers.q),
        result_(result),
        random_(options.random_seed) {}

  void solve() {
    q_.resize(problem_.coordinates.size());
    result_.iterations = result_.restarts = 0;
    result_.nearest.converged = false;
    if (!options_.all && (converges_nearby() || (is_near_pose() && converges_from_start()))) {
      result_.solutions.resize(1);
      result_.solutions[0] = result_.nearest.q;
      return;
    }
    lanes_.active = lanes_.converged = lanes_.coarse = 0;
    start_lane(problem_, start_.data(), 0, lanes_);
    held_ = 1;
    while (true) {
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        if (holds(lane) && (lanes_.active >> lane & 1) == 0) collect(lane);
      }
      if (found_ > 0 && !options_.all && result_.restarts >= last_restart_) break;
      fill();
      if (held_ == 0 || (ran_ && ended())) break;
      ran_ = true;
      run_lanes(problem_, world_T_tool_, lane_options(), steps_per_check, lanes_);
    }
    for (int lane = 0; lane < solver_lane_count; ++lane) {
      if (holds(lane)) collect(lane);  // not ended
    }
    if (found_ == 0 && options_.continue_nearest) continue_nearest();
    result_.solutions.resize(found_);
  }

  bool solve_from_start() {
    q_.resize(problem_.coordinates.size());
    result_.iterations = result_.restarts = 0;
    return is_near_pose() && converges_nearby();
  }

 private:
  /// Whether the lane has a run that is not collected yet.
  bool holds(int lane) const { return (held_ >> lane & 1) != 0; }

  bool ended() const { return options_.budget.ended(steps_per_check); }

  LaneOptions lane_options() const {
    return {.tolerance = options_.tolerance,
            .max_iterations = options_.max_iterations,
            .first_is_enough = !options_.all};
  }

  bool converges_nearby() {
    if (!gauss_newton(problem_, world_T_tool_, start_.data(), lane_options(), near_)) return false;
    for (std::size_t k = 0; k < q_.size(); ++k) q_[k] = near_.q[k] * problem_.coordinates[k].unit;
    wrap_to_start();
    result_.nearest.q = Eigen::Map<const Configuration>(q_.data(), start_.size());
    const double* e = near_.error;
    result_.nearest.error = {std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) * problem_.length,
                             std::sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5])};
    result_.nearest.converged = true;
    result_.iterations = result_.nearest.iterations = near_.iterations;
    return true;
  }

  /// Whether the tool is near the pose at the start, so that the start's branch is wanted.
  bool is_near_pose() const {
    constexpr double near = 0.25, near_angle = 1;  // units of length, radians
    const Deviation off =
        task_deviation(problem_.task, world_T_tool_, forward_kinematics(arm_, start_));
    return off.position < near * problem_.length && off.orientation < near_angle;
  }

  /// Tries the branch of the start, before lanes find another branch.
  bool converges_from_start() {
    result_.nearest =
        levenberg_marquardt(arm_, world_T_tool_, problem_.task, problem_.bounds, start_,
                            {.tolerance = options_.tolerance,
                             .max_iterations = options_.max_iterations,
                             .budget = options_.budget});
    result_.iterations = result_.nearest.iterations;
    return result_.nearest.converged;
  }

  /// Starts a new run in every empty lane, as long as there are restarts.
  void fill() {
    int block[solver_lane_count];
    const bool from_table = result_.restarts == 0 && seeds_.blocks > 0;
    if (from_table) nearest_seeds(problem_, seeds_, world_T_tool_, block);
    for (int lane = 0; lane < solver_lane_count; ++lane) {
      if (holds(lane) || result_.restarts >= options_.max_restarts) continue;
      if (from_table) {
        draw_seed(problem_, seeds_, block[lane], lane, q_.data());
      } else {
        const double away =
            (world_T_tool_.translation() / problem_.length - problem_.chain.base.translation())
                .norm();
        draw_configuration(problem_, std::max(1.0, away), random_, q_.data());
      }
      start_lane(problem_, q_.data(), lane, lanes_);
      held_ |= 1u << lane;
      ++result_.restarts;
    }
  }

  /// Replaces q_ by its representative nearest to the start; returns their squared distance.
  double wrap_to_start() {
    double square = 0;
    for (std::size_t k = 0; k < q_.size(); ++k) {
      const NumericalProblem::Coordinate& coordinate = problem_.coordinates[k];
      const double start = start_[static_cast<Eigen::Index>(k)];
      const double lower = coordinate.lower, upper = coordinate.upper;
      if (coordinate.periodic && std::abs(q_[k] - start) > std::numbers::pi) {
        q_[k] = std::clamp(nearest_angle_within(q_[k], start, lower, upper), lower, upper);
      }
      const double away = (q_[k] - start) / coordinate.unit;
      square += away * away;
    }
    return square;
  }

  bool known(const Configuration& q) {
    const auto solution = [&](std::size_t i) -> const Configuration& {
      return result_.solutions[i];
    };
    return postures_.contains(arm_, found_, solution, q);
  }

  /// A lane that has stagnated, with its error squared.
  struct Stagnated {
    double cost;
    Configuration q;
    bool operator<(const Stagnated& other) const { return cost < other.cost; }
  };

  /// Keeps the lane in q_, if its error is among the least.
  void keep(double cost) {
    if (!options_.continue_nearest || !(cost < near_a_solution * near_a_solution)) return;
    if (stagnated_.size() == max_nearest) {
      if (!(cost < stagnated_.front().cost)) return;
      std::pop_heap(stagnated_.begin(), stagnated_.end());
      stagnated_.pop_back();
    }
    stagnated_.push_back({cost, Eigen::Map<const Configuration>(q_.data(), start_.size())});
    std::push_heap(stagnated_.begin(), stagnated_.end());
  }

  /// Continues the lanes of least error until one converges.
  void continue_nearest() {
    std::sort_heap(stagnated_.begin(), stagnated_.end());
    for (const Stagnated& lane : stagnated_) {
      if (ended()) return;
      std::copy(lane.q.begin(), lane.q.end(), q_.begin());
      if (!converges_at_singularity()) continue;
      wrap_to_start();
      result_.solutions.resize(1);
      result_.solutions[0] = Eigen::Map<const Configuration>(q_.data(), start_.size());
      result_.nearest.q = result_.solutions[0];
      result_.nearest.error = continued_error_;
      result_.nearest.converged = true;
      found_ = 1;
      if (options_.found) options_.found(result_.solutions[0]);
      return;
    }
  }

  int restarts_before_continuing() const {
    return options_.continue_nearest ? std::min(restarts_before, options_.max_restarts)
                                     : restarts_before;
  }

  /// Continues a lane that has stagnated next to a solution, as lanes do near singularities, from
  /// q_. Writes the solution into q_ and returns whether there is one.
  bool continues(double cost) {
    if (!(cost < next_to_a_solution * next_to_a_solution) ||
        result_.restarts < restarts_before_continuing() || continued_ == max_continued || ended()) {
      return false;
    }
    ++continued_;
    return converges_at_singularity();
  }

  /// Continues any lane from q_ in the same way, unless a minimum of the error is near it; that is
  /// looked for up to max_refined joints.
  bool converges_at_singularity() {
    const NumericalOptions options{.tolerance = options_.tolerance,
                                   .max_iterations = slow_convergence * options_.max_iterations,
                                   .budget = options_.budget};
    const Eigen::Map<const Configuration> start(q_.data(), start_.size());
    constexpr double clear = 1e-5;  // units of length and radians
    Configuration minimum = start;
    if (arm_.dof() <= max_refined &&
        minimise_error(arm_, world_T_tool_, problem_.task, problem_.bounds, clear, options_.budget,
                       minimum)) {
      return false;
    }
    const NumericalResult run =
        singular_solution(arm_, world_T_tool_, problem_.task, problem_.bounds, start, options);
    result_.iterations += run.iterations;
    if (!run.converged) return false;
    std::copy(run.q.begin(), run.q.end(), q_.begin());
    continued_error_ = run.error;
    return true;
  }

  void collect(int lane) {
    held_ &= ~(1u << lane);
    lane_configuration(problem_, lanes_, lane, q_.data());
    const double cost = lanes_.cost.lane[lane];
    const bool lane_converged = (lanes_.converged >> lane & 1) != 0;
    const bool continued = !lane_converged && continues(cost);
    if (!lane_converged && !continued) keep(cost);
    const bool converged = lane_converged || continued;
    const double away = wrap_to_start();
    const bool coarse = continued || (lanes_.coarse >> lane & 1) != 0;
    const Grade grade = !converged ? Grade::not_converged
                        : coarse   ? Grade::coarse
                                   : Grade::converged;
    const Eigen::Map<const Configuration> q(q_.data(), start_.size());
    result_.iterations += std::max(0, static_cast<int>(lanes_.iterations.lane[lane]));
    // Converged lanes are compared by their distance from the start, others by their error.
    const double rank = converged ? away : cost;
    if (grade > grade_ || (grade == grade_ && rank < rank_)) {
      if (grade == Grade::coarse && grade_ < Grade::coarse)
        last_restart_ = result_.restarts + restarts_for_fine;
      if (grade == Grade::converged) last_restart_ = 0;
      grade_ = grade;
      rank_ = rank;
      result_.nearest.q = q;
      result_.nearest.error = continued ? continued_error_ : lane_deviation(problem_, lanes_, lane);
      result_.nearest.iterations = static_cast<int>(lanes_.iterations.lane[lane]);
      result_.nearest.converged = converged;
      if (converged && !options_.all) {
        result_.solutions.resize(1);
        result_.solutions[0] = q;
        found_ = 1;
      }
    }
    if (!converged || !options_.all || known(q)) return;
    result_.solutions.resize(found_);
    result_.solutions.emplace_back(q);
    ++found_;
    if (options_.found) options_.found(result_.solutions.back());
  }

  const Arm& arm_;
  const NumericalProblem& problem_;
  const SeedTable& seeds_;
  const Pose& world_T_tool_;
  const ConfigurationRef& start_;
  const MultiStartOptions& options_;
  GaussNewtonState& near_;
  LevenbergMarquardtLanes& lanes_;
  std::vector<double>& q_;
  SearchResult& result_;
  Splitmix random_;
  unsigned held_ = 0;
  bool ran_ = false;  ///< whether the lanes have stepped at all
  std::size_t found_ = 0;
  Grade grade_ = Grade::none;  ///< grade of result_.nearest
  double rank_ = 0;
  int last_restart_ = 0;
  int continued_ = 0;                 ///< number of lanes that were continued at once
  Deviation continued_error_;         ///< error of the last of these lanes
  std::vector<Stagnated> stagnated_;  ///< the lanes of least error, a heap
  PostureIndex postures_;             ///< index of result_.solutions
};

}  // namespace

void multi_start(const Search& search, const Pose& world_T_tool, const ConfigurationRef& start,
                 const MultiStartOptions& options, MultiStartBuffers& buffers,
                 SearchResult& result) {
  check_lane_options(world_T_tool,
                     {.tolerance = options.tolerance, .max_iterations = options.max_iterations});
  if (start.size() != search.arm.dof() || !start.allFinite()) {
    check_configuration(search.arm, start);
  }
  if (options.max_restarts < 0) {
    throw Error("", "max_restarts",
                " must be zero or more, not " + std::to_string(options.max_restarts));
  }
  if (search.seeds.tool.size() != 12 * static_cast<std::size_t>(search.seeds.blocks)) {
    throw Error("the seed table needs 12 rows for each block");
  }
  Run(search, world_T_tool, start, options, buffers, result).solve();
}

bool search_from_start(const Search& search, const Pose& world_T_tool,
                       const ConfigurationRef& start, const MultiStartOptions& options,
                       MultiStartBuffers& buffers, SearchResult& result) {
  return Run(search, world_T_tool, start, options, buffers, result).solve_from_start();
}

}  // namespace beeline::internal
