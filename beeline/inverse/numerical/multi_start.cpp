#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/numerical/multi_start.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/pose/angle.h>

namespace beeline::internal {
namespace {

constexpr int steps_a_look = 16;     // at the clock
constexpr int tries_for_fine = 256;  // descents after one that stuck within the tolerance

/// One call.
class Run {
 public:
  Run(const NumericalProblem& problem, const SeedTable& seeds, const Pose& world_T_tool,
      const ConfigurationRef& start, const MultiStartOptions& options, MultiStartBuffers& buffers,
      SearchResult& result)
      : problem_(problem),
        seeds_(seeds),
        world_T_tool_(world_T_tool),
        start_(start),
        options_(options),
        near_(buffers.near),
        lanes_(buffers.lanes),
        q_(buffers.q),
        result_(result),
        random_(options.random_seed) {}

  void go() {
    q_.resize(problem_.coordinates.size());
    result_.iterations = result_.restarts = 0;
    result_.nearest.converged = false;
    if (!options_.all && arrives_nearby()) {
      result_.solutions.resize(1);
      result_.solutions[0] = result_.nearest.q;
      return;
    }
    lanes_.active = lanes_.arrived = lanes_.coarse = 0;
    start_lane(problem_, start_.data(), 0, lanes_);
    held_ = 1;
    while (true) {
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        if (holds(lane) && (lanes_.active >> lane & 1) == 0) collect(lane);
      }
      if (found_ > 0 && !options_.all && result_.restarts >= last_restart_) break;
      fill();
      if (held_ == 0 || (ran_ && late())) break;
      ran_ = true;
      run_lanes(problem_, world_T_tool_, descent(), steps_a_look, lanes_);
    }
    for (int lane = 0; lane < solver_lane_count; ++lane) {
      if (holds(lane)) collect(lane);  // on the way still
    }
    result_.solutions.resize(found_);
  }

 private:
  /// Whether the lane has a descent that is not collected yet.
  bool holds(int lane) const { return (held_ >> lane & 1) != 0; }

  bool late() const {
    return options_.deadline != std::chrono::steady_clock::time_point::max() &&
           std::chrono::steady_clock::now() >= options_.deadline;
  }

  LaneOptions descent() const {
    return {.tolerance = options_.tolerance,
            .iterations = options_.iterations,
            .first_is_enough = !options_.all};
  }

  bool arrives_nearby() {
    if (!gauss_newton(problem_, world_T_tool_, start_.data(), descent(), near_)) return false;
    for (std::size_t k = 0; k < q_.size(); ++k) q_[k] = near_.q[k] * problem_.coordinates[k].unit;
    turn_to_start();
    result_.nearest.q = Eigen::Map<const Configuration>(q_.data(), start_.size());
    const double* e = near_.error;
    result_.nearest.error = {std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) * problem_.length,
                             std::sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5])};
    result_.nearest.converged = true;
    result_.iterations = result_.nearest.iterations = near_.iterations;
    return true;
  }

  /// Gives every empty lane a start, as long as there are restarts.
  void fill() {
    int block[solver_lane_count];
    const bool from_table = result_.restarts == 0 && seeds_.blocks > 0;
    if (from_table) nearest_seeds(problem_, seeds_, world_T_tool_, block);
    for (int lane = 0; lane < solver_lane_count; ++lane) {
      if (holds(lane) || result_.restarts >= options_.restarts) continue;
      if (from_table) {
        const std::size_t dof = q_.size(), first = static_cast<std::size_t>(block[lane]) * dof;
        for (std::size_t k = 0; k < dof; ++k) {
          q_[k] = seeds_.q[first + k].lane[lane] * problem_.coordinates[k].unit;
        }
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

  /// The coordinate's turn nearest to the start's, within the bounds as `angle` is.
  static double nearest_turn_within(double angle, double start,
                                    const NumericalProblem::Coordinate& within) {
    if (std::abs(angle - start) <= std::numbers::pi) return angle;
    const double turn = nearest_turn(angle, std::clamp(start, within.lower, within.upper));
    if (turn > within.upper) return std::max(turn - 2 * std::numbers::pi, within.lower);
    if (turn < within.lower) return std::min(turn + 2 * std::numbers::pi, within.upper);
    return turn;
  }

  /// Brings q_ to the turns nearest to the start, and says how far from it that is, squared.
  double turn_to_start() {
    double square = 0;
    for (std::size_t k = 0; k < q_.size(); ++k) {
      const NumericalProblem::Coordinate& coordinate = problem_.coordinates[k];
      const double start = start_[static_cast<Eigen::Index>(k)];
      if (coordinate.turns_around) q_[k] = nearest_turn_within(q_[k], start, coordinate);
      const double away = (q_[k] - start) / coordinate.unit;
      square += away * away;
    }
    return square;
  }

  bool known(const Configuration& q) const {
    return std::any_of(
        result_.solutions.begin(), result_.solutions.begin() + static_cast<std::ptrdiff_t>(found_),
        [&](const Configuration& solution) { return same_posture(problem_.arm, solution, q); });
  }

  void collect(int lane) {
    held_ &= ~(1u << lane);
    lane_configuration(problem_, lanes_, lane, q_.data());
    const double cost = lanes_.cost.lane[lane], away = turn_to_start();
    const bool arrived = (lanes_.arrived >> lane & 1) != 0;
    const int grade = !arrived ? 0 : (lanes_.coarse >> lane & 1) != 0 ? 1 : 2;
    const Eigen::Map<const Configuration> q(q_.data(), start_.size());
    result_.iterations += std::max(0, static_cast<int>(lanes_.iterations.lane[lane]));
    // Of those that arrived the one nearest to the start, of others that nearest to the pose.
    const double rank = arrived ? away : cost;
    if (grade > grade_ || (grade == grade_ && rank < rank_)) {
      if (grade == 1 && grade_ < 1) last_restart_ = result_.restarts + tries_for_fine;
      if (grade == 2) last_restart_ = 0;
      grade_ = grade;
      rank_ = rank;
      result_.nearest.q = q;
      result_.nearest.error = lane_deviation(problem_, lanes_, lane);
      result_.nearest.iterations = static_cast<int>(lanes_.iterations.lane[lane]);
      result_.nearest.converged = arrived;
      if (arrived && !options_.all) {
        result_.solutions.resize(1);
        result_.solutions[0] = q;
        found_ = 1;
      }
    }
    if (!arrived || !options_.all || known(q)) return;
    result_.solutions.resize(found_);
    result_.solutions.emplace_back(q);
    ++found_;
  }

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
  bool ran_ = false;  ///< the lanes, for a while
  std::size_t found_ = 0;
  int grade_ = -1;  ///< of the nearest: nothing yet, not arrived, stuck within tolerance, arrived
  double rank_ = 0;
  int last_restart_ = 0;
};

}  // namespace

void multi_start(const NumericalProblem& problem, const SeedTable& seeds, const Pose& world_T_tool,
                 const ConfigurationRef& start, const MultiStartOptions& options,
                 MultiStartBuffers& buffers, SearchResult& result) {
  check_lane_options(world_T_tool,
                     {.tolerance = options.tolerance, .iterations = options.iterations});
  if (start.size() != static_cast<Eigen::Index>(problem.coordinates.size()) || !start.allFinite()) {
    check_configuration(problem.arm, start);
  }
  if (options.restarts < 0) {
    throw Error("restarts must be zero or more, not " + std::to_string(options.restarts));
  }
  if (seeds.q.size() != static_cast<std::size_t>(seeds.blocks) * problem.coordinates.size()) {
    throw Error("the seed table is not one for arm " + problem.arm.name());
  }
  Run(problem, seeds, world_T_tool, start, options, buffers, result).go();
}

}  // namespace beeline::internal
