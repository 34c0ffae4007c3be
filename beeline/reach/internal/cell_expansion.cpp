#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <beeline/model/internal/dh_row.h>
#include <beeline/reach/internal/cell_expansion.h>
#include <beeline/reach/internal/solution_measures.h>

namespace beeline::internal {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Returns the joints that remain free when each azimuth and roll is solved: the last joint if any
/// roll is accepted.
FreeJoints any_angle(const FreeJoints& free) {
  return {.roll = free.any_roll ? free.roll : std::nullopt, .any_roll = free.any_roll};
}

/// The margin of a joint's value turned by each of the angles from `begin` to `end`; -1 where that
/// is outside its limits.
void margins_of(const TurningJoint& joint, const Limits& limits, double value,
                const std::vector<double>& angles, Eigen::Index begin, Eigen::Index end,
                std::vector<float>& margins) {
  for (Eigen::Index k = begin; k < end; ++k) {
    const std::optional<double> turned = joint.turned(limits, value, angles[k]);
    margins[k] = -1;
    if (!turned) continue;
    const double margin = limit_margin(*turned, limits.lower, limits.upper);
    margins[k] = static_cast<float>(std::clamp(margin, 0.0, 1.0));
  }
}

}  // namespace

CellExpansion::CellExpansion(const Arm& arm, const ReachGrid& grid, const FreeJoints& free,
                             int redundant_values)
    : arm_(arm),
      grid_(grid),
      free_(free),
      singular_(static_cast<float>(1e-7 * std::pow(length_unit(arm), 3))),
      redundant_values_(redundant_values),
      azimuth_margins_(static_cast<std::size_t>(grid.azimuths()), 1.0F) {
  for (Eigen::Index a = 0; a < grid.azimuths(); ++a) {
    azimuths_.push_back(grid.cylindrical() ? grid.axes()[2].centre(a) : 0);
  }
  const Eigen::Index rolls = free.roll ? grid.rolls() : 1;
  for (Eigen::Index r = 0; r < rolls; ++r) rolls_.push_back(grid.roll(r));
  roll_margins_.assign(rolls_.size(), 1.0F);
}

bool CellExpansion::singular(const ReachBranches& branches, std::size_t cell) const {
  if (!free_.base && (!free_.roll || free_.any_roll)) return false;
  // There are infinitely many solutions; a file stores the first ones.
  if (branches.counts[cell] > branches.ends[cell] - branches.begin(cell)) return true;
  const auto begin = static_cast<std::ptrdiff_t>(branches.begin(cell));
  const auto end = static_cast<std::ptrdiff_t>(branches.ends[cell]);
  const auto& of = branches.manipulability;
  return std::any_of(of.begin() + begin, of.begin() + end,
                     [this](float value) { return value < singular_; });
}

void CellExpansion::turn(const ReachBranches& branches, std::size_t branch, Eigen::Index begin,
                         Eigen::Index end) {
  if (free_.base) {
    margins_of(*free_.base, arm_.limits(0), branches.first_joint[branch], azimuths_, begin, end,
               azimuth_margins_);
  }
  if (free_.roll && !free_.any_roll) {
    margins_of(*free_.roll, arm_.limits(arm_.dof() - 1), branches.last_joint[branch], rolls_, 0,
               std::ssize(rolls_), roll_margins_);
  }
}

ReachBranches CellExpansion::solve_once(Eigen::Index cell) {
  if (!one_by_one_) one_by_one_.emplace(arm_, any_angle(free_), redundant_values_);
  one_by_one_->solve(grid_.pose(cell));
  return one_by_one_->take();
}

void CellExpansion::solve_cell(Eigen::Index cell, Eigen::Index target, ReachCells& cells) {
  const ReachBranches found = solve_once(cell);
  cells.branches[target] = found.counts[0];
  for (const float value : found.manipulability) keep_max(cells.manipulability[target], value);
  for (const float value : found.margin) keep_max(cells.margin[target], value);
}

void CellExpansion::expand(const ReachBranches& branches, Eigen::Index solved, Eigen::Index first,
                           Eigen::Index last, Eigen::Index origin, ReachCells& cells) {
  const Eigen::Index at_position = grid_.directions() * grid_.rolls();
  const auto from = (first - origin) * at_position, to = (last - origin) * at_position;
  std::fill(cells.branches.begin() + from, cells.branches.begin() + to, std::uint8_t{0});
  std::fill(cells.manipulability.begin() + from, cells.manipulability.begin() + to, unknown);
  std::fill(cells.margin.begin() + from, cells.margin.begin() + to, unknown);
  constexpr auto most = std::numeric_limits<std::uint8_t>::max();
  const Eigen::Index azimuths = grid_.azimuths(), rolls = std::ssize(rolls_);
  const Eigen::Index orientations = free_.solved_orientations(grid_);
  const auto begin_of = [&](Eigen::Index s) {
    return std::max<Eigen::Index>(0, first - s * azimuths);
  };
  const auto end_of = [&](Eigen::Index s) { return std::min(azimuths, last - s * azimuths); };
  const auto each_cell = [&](Eigen::Index s, Eigen::Index o, const auto& use) {
    for (Eigen::Index a = begin_of(s); a < end_of(s); ++a) {
      const Eigen::Index cell = (s * azimuths + a) * at_position + o * rolls;
      for (Eigen::Index r = 0; r < rolls; ++r) use(a, r, cell + r, cell + r - origin * at_position);
    }
  };
  const Eigen::Index begin = (first / azimuths - solved) * orientations;
  const Eigen::Index end = ((last + azimuths - 1) / azimuths - solved) * orientations;
  for (Eigen::Index index = begin; index < end; ++index) {
    const auto i = static_cast<std::size_t>(index);
    const Eigen::Index s = solved + index / orientations, o = index % orientations;
    if (singular(branches, i)) {
      each_cell(s, o, [&](auto, auto, Eigen::Index cell, Eigen::Index target) {
        solve_cell(cell, target, cells);
      });
      continue;
    }
    const std::size_t count = branches.ends[i] - branches.begin(i);
    for (std::size_t b = branches.begin(i); b < branches.ends[i]; ++b) {
      turn(branches, b, begin_of(s), end_of(s));
      each_cell(s, o, [&](Eigen::Index a, Eigen::Index r, auto, Eigen::Index target) {
        const float margin = std::min({branches.margin[b], azimuth_margins_[a], roll_margins_[r]});
        if (margin < 0) return;
        if (cells.branches[target] < most) ++cells.branches[target];
        keep_max(cells.manipulability[target], branches.manipulability[b]);
        keep_max(cells.margin[target], margin);
      });
    }
    // At several values of a redundant joint, not all solutions are branches.
    if (count == branches.counts[i]) continue;
    each_cell(s, o, [&](auto, auto, auto, Eigen::Index target) {
      cells.branches[target] = std::min(cells.branches[target], branches.counts[i]);
    });
  }
}

void CellExpansion::count_reached(const ReachBranches& branches, Eigen::Index solved,
                                  Eigen::Index first, Eigen::Index last,
                                  std::vector<Eigen::Index>& counts) {
  const Eigen::Index azimuths = grid_.azimuths(), rolls = std::ssize(rolls_);
  const Eigen::Index orientations = free_.solved_orientations(grid_);
  const Eigen::Index at_position = grid_.directions() * grid_.rolls();
  constexpr Eigen::Index bits = 64;
  const Eigen::Index words = (rolls + bits - 1) / bits;
  std::vector<std::uint64_t> masks, of_rolls;  // a bit for each roll: of each azimuth, of a branch
  for (Eigen::Index i = first * orientations; i < last * orientations; ++i) {
    const auto cell = static_cast<std::size_t>(i);
    const Eigen::Index s = i / orientations;
    masks.assign(static_cast<std::size_t>(azimuths * words), 0);
    if (singular(branches, cell)) {
      for (Eigen::Index a = 0; a < azimuths; ++a) {
        for (Eigen::Index r = 0; r < rolls; ++r) {
          const Eigen::Index p = (solved + s) * azimuths + a;
          const Eigen::Index at = p * at_position + i % orientations * rolls + r;
          if (solve_once(at).counts[0] > 0) ++counts[s * azimuths + a];
        }
      }
      continue;
    }
    for (std::size_t b = branches.begin(cell); b < branches.ends[cell]; ++b) {
      turn(branches, b, 0, azimuths);
      of_rolls.assign(static_cast<std::size_t>(words), 0);
      for (Eigen::Index r = 0; r < rolls; ++r) {
        if (roll_margins_[r] >= 0) of_rolls[r / bits] |= std::uint64_t{1} << (r % bits);
      }
      for (Eigen::Index a = 0; a < azimuths; ++a) {
        if (azimuth_margins_[a] < 0) continue;
        for (Eigen::Index w = 0; w < words; ++w) masks[a * words + w] |= of_rolls[w];
      }
    }
    for (Eigen::Index k = 0; k < azimuths * words; ++k) {
      counts[s * azimuths + k / words] += std::popcount(masks[k]);
    }
  }
}

}  // namespace beeline::internal
