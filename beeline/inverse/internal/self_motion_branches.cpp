#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/internal/self_motion_branches.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/math/minimise.h>
#include <beeline/math/revolution.h>

namespace beeline::internal {
namespace {

/// Returns the number of values of each free coordinate: 256 for one, 24 for two, 8 for three and
/// more.
std::size_t grid_of(std::size_t free_coordinates) {
  constexpr std::size_t values[] = {256, 24, 8};
  return values[std::min(free_coordinates - 1, std::size_t{2})];
}

class SelfMotionBranches {
 public:
  SelfMotionBranches(const Request& request, const std::vector<double>& seed_values,
                     const SolutionsAt& solutions_at)
      : request_(request),
        seed_values_(seed_values),
        solutions_at_(solutions_at),
        per_axis_(grid_of(seed_values.size())) {
    std::size_t points = 1;
    for (std::size_t axis = 0; axis < seed_values.size(); ++axis) points *= per_axis_;
    points_.resize(points);
  }

  std::vector<Configuration> run() {
    for (std::size_t point = 0; point < points_.size() && !request_.budget.ended(); ++point) {
      solutions_at_(values_of(point), points_[point]);
    }
    if (request_.budget.ended()) return {};
    for (std::size_t lane = 0; lane < points_.front().size(); ++lane) {
      visited_.assign(points_.size(), false);
      for (std::size_t point = 0; point < points_.size(); ++point) {
        if (!visited_[point] && at(point, lane).miss == 0) add_branch(point, lane);
      }
      if (seed_values_.size() == 1) add_narrow_branches(lane);
    }
    return std::move(found_);
  }

 private:
  const FreeSolution& at(std::size_t point, std::size_t lane) const { return points_[point][lane]; }

  double step() const { return revolution / static_cast<double>(per_axis_); }

  std::vector<double> values_of(std::size_t point) const {
    std::vector<double> values = seed_values_;
    for (double& value : values) {
      value += step() * static_cast<double>(point % per_axis_);
      point /= per_axis_;
    }
    return values;
  }

  /// Returns the next point along an axis of the grid, which is closed, or the previous one.
  std::size_t neighbour(std::size_t point, std::size_t axis, bool next) const {
    std::size_t stride = 1;
    for (std::size_t i = 0; i < axis; ++i) stride *= per_axis_;
    const std::size_t index = point / stride % per_axis_;
    const std::size_t other = (index + (next ? 1 : per_axis_ - 1)) % per_axis_;
    return point + other * stride - index * stride;
  }

  /// Whether the arm can move from a to b, which are solutions at neighbours on the grid: no joint
  /// moves far, or passes a limit on the way to an equivalent angle.
  bool continuous(const Configuration& a, const Configuration& b) const {
    constexpr double far = std::numbers::pi / 2;
    for (int k = 0; k < a.size(); ++k) {
      const double revolutions =
          request_.arm.periodic(k) ? std::round((b[k] - a[k]) / revolution) : 0;
      const double next = b[k] - revolution * revolutions;
      if (std::abs(next - a[k]) > far) return false;
      if (next < request_.bounds.lower[k] || next > request_.bounds.upper[k]) return false;
    }
    return true;
  }

  /// Visits the branch of a solution, and adds the one nearest to the seed.
  void add_branch(std::size_t point, std::size_t lane) {
    std::vector<std::size_t> open{point};
    visited_[point] = true;
    std::size_t best = point;
    while (!open.empty()) {
      const std::size_t here = open.back();
      open.pop_back();
      if (distance(at(here, lane)) < distance(at(best, lane))) best = here;
      for (std::size_t axis = 0; axis < seed_values_.size(); ++axis) {
        for (const bool next : {true, false}) {
          const std::size_t other = neighbour(here, axis, next);
          if (visited_[other] || at(other, lane).miss != 0) continue;
          if (!continuous(at(here, lane).q, at(other, lane).q)) continue;
          visited_[other] = true;
          open.push_back(other);
        }
      }
    }
    if (seed_values_.size() > 1) {
      found_.push_back(at(best, lane).q);
    } else {
      found_.push_back(nearest_near(best, lane));
    }
  }

  /// Returns the solution nearest to the seed between the neighbours of a point of the grid. If the
  /// solutions of two signs end in one, that solution belongs to both, and the point's own is
  /// returned.
  Configuration nearest_near(std::size_t point, std::size_t lane) {
    constexpr double end = 1e-5;  // radians
    const Configuration start = at(point, lane).q;
    const Refined refined = refine(values_of(point)[0], lane, [&](const FreeSolution& solution) {
      if (solution.miss > 0) return no_solution + solution.miss;
      return continuous(start, solution.q) ? distance(solution) : no_solution;
    });
    if (refined.q.size() == 0) return start;  // the budget has ended
    std::vector<FreeSolution> beside;
    for (const double value : {refined.value - end, refined.value + end}) {
      solutions_at_({value}, beside);
      if (beside[lane].miss >= no_solution) return start;
    }
    return refined.q;
  }

  double distance(const FreeSolution& solution) const {
    return distance_from_seed(
        request_, nearest_representative(request_.arm, solution.q, request_.seed, request_.bounds));
  }

  struct Refined {
    double value = 0;  ///< value of the free coordinate
    Configuration q;   ///< empty if there is no solution within limits
  };

  /// Minimises a cost of solutions within limits between the neighbours of a value of the grid.
  template <class Cost>
  Refined refine(double value, std::size_t lane, Cost&& cost) {
    if (request_.budget.ended()) return {};
    constexpr int sections = 40;  // 0.618^40 = 4e-9 of the interval
    std::vector<FreeSolution> solutions;
    double least = no_solution;
    Refined best;
    const auto cost_at = [&](double x) {
      solutions_at_({x}, solutions);
      const double here = cost(solutions[lane]);
      if (solutions[lane].miss == 0 && here < least) {
        least = here;
        best = {x, solutions[lane].q};
      }
      return here;
    };
    cost_at(value);
    golden_section(value - step(), value + step(), sections, cost_at);
    return best;
  }

  /// Adds branches that are shorter than the step of the grid: local minima of `miss` that are
  /// zero.
  void add_narrow_branches(std::size_t lane) {
    for (std::size_t point = 0; point < points_.size(); ++point) {
      const double here = at(point, lane).miss;
      const double before = at(neighbour(point, 0, false), lane).miss;
      const double after = at(neighbour(point, 0, true), lane).miss;
      const bool minimum = here > 0 && here <= before && here < after;
      if (!minimum || !may_reach_zero(here, before, after)) continue;
      const Refined narrow = refine(values_of(point)[0], lane,
                                    [](const FreeSolution& solution) { return solution.miss; });
      if (narrow.q.size() > 0) found_.push_back(narrow.q);
    }
  }

  const Request& request_;
  const std::vector<double>& seed_values_;
  const SolutionsAt& solutions_at_;
  std::size_t per_axis_;
  std::vector<std::vector<FreeSolution>> points_;
  std::vector<bool> visited_;
  std::vector<Configuration> found_;
};

}  // namespace

bool may_reach_zero(double here, double before, double after) {
  const double floor = here < no_solution ? 0 : no_solution;
  double rise = 0;
  for (const double next : {before, after}) {
    if ((next < no_solution) == (here < no_solution)) rise = std::max(rise, next - here);
  }
  return here - floor < 2 * rise;
}

std::vector<Configuration> self_motion_branches(const Request& request,
                                                const std::vector<double>& seed_values,
                                                const SolutionsAt& solutions_at) {
  return SelfMotionBranches(request, seed_values, solutions_at).run();
}

}  // namespace beeline::internal
