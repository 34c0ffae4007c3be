#include <algorithm>
#include <limits>

#include <beeline/batch/internal/copies.h>
#include <beeline/batch/internal/parallel.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/reach/internal/cell_expansion.h>
#include <beeline/reach/internal/positions.h>
#include <beeline/reach/internal/sampled_cells.h>
#include <beeline/reach/internal/solution_measures.h>
#include <beeline/reach/reach.h>

namespace beeline {
namespace {

struct CellSolver {
  internal::BranchSolver solver;
  internal::CellExpansion expansion;
};

}  // namespace

void ReachCells::resize(std::size_t cells) {
  branches.resize(cells);
  manipulability.resize(cells);
  margin.resize(cells);
}

ReachCells reach_cells(const Arm& arm, const ReachGrid& grid, Eigen::Index first, Eigen::Index last,
                       const ReachOptions& options) {
  internal::check_positions(grid, first, last);
  if (options.redundant_values < 1 || options.redundant_values > 1000) {
    throw Error("", "redundant_values",
                " is " + std::to_string(options.redundant_values) + "; it can be 1 to 1000");
  }
  if (options.samples < 0 || options.samples > max_samples) {
    throw Error("samples is " + std::to_string(options.samples) + "; it can be 0 to 1e12");
  }
  if (options.samples > 0) return internal::sampled_cells(arm, grid, first, last, options);
  const internal::FreeJoints free =
      internal::free_joints(arm, grid, static_cast<bool>(options.blocked_by));
  const Eigen::Index at_position = grid.directions() * grid.rolls(), azimuths = grid.azimuths();
  ReachCells cells;
  cells.resize(static_cast<std::size_t>((last - first) * at_position));
  internal::BudgetMeter budget(options.budget);
  internal::Copies<CellSolver> solvers(
      {internal::BranchSolver(arm, free, options.redundant_values, options.blocked_by),
       internal::CellExpansion(arm, grid, free, options.redundant_values)});
  internal::FinishedSteps computed(budget, last - first);
  // Positions counted without azimuths, which are solved together.
  const Eigen::Index begin = first / azimuths, end = (last + azimuths - 1) / azimuths;
  const Eigen::Index block = internal::block_of_positions(free.solved_orientations(grid));
  internal::in_parallel(end - begin, block, options.threads, [&](Eigen::Index a, Eigen::Index b) {
    const Eigen::Index from = std::max(first, (begin + a) * azimuths);
    const Eigen::Index to = std::min(last, (begin + b) * azimuths);
    if (budget.ended((to - from) * at_position)) return;
    const auto borrowed = solvers.borrow();
    borrowed->solver.solve(grid, begin + a, begin + b);
    borrowed->expansion.expand(borrowed->solver.take(), begin + a, from, to, first, cells);
    computed.add(to - from);
  });
  cells.ending = budget.ending();
  return cells;
}

ReachPositions reach_positions(const ReachGrid& grid, const ReachCells& cells) {
  const Eigen::Index at_position = grid.directions() * grid.rolls();
  const std::size_t positions = cells.branches.size() / static_cast<std::size_t>(at_position);
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  ReachPositions best{std::vector<float>(positions), std::vector<std::uint8_t>(positions),
                      std::vector<float>(positions, unknown),
                      std::vector<float>(positions, unknown)};
  for (std::size_t p = 0; p < positions; ++p) {
    double fraction = 0;
    std::size_t cell = p * static_cast<std::size_t>(at_position);
    for (Eigen::Index d = 0; d < grid.directions(); ++d) {
      bool reached = false;
      for (Eigen::Index r = 0; r < grid.rolls(); ++r, ++cell) {
        if (cells.branches[cell] == 0) continue;
        reached = true;
        best.branches[p] = std::max(best.branches[p], cells.branches[cell]);
        internal::keep_max(best.manipulability[p], cells.manipulability[cell]);
        internal::keep_max(best.margin[p], cells.margin[cell]);
      }
      if (reached) fraction += grid.fraction(d);
    }
    best.directions[p] = static_cast<float>(fraction);
  }
  return best;
}

}  // namespace beeline
