#include <cmath>

#include <beeline/inverse/numerical/posture_index.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/math/revolution.h>

namespace beeline::internal {
namespace {

// Cells are wider than the tolerance of same_posture(), so that equal postures are in the same cell
// or in neighbouring cells. A whole number of cells makes a revolution.
constexpr double cells_in_a_revolution = 2'000'000;
constexpr double cell_width = revolution / cells_in_a_revolution;
constexpr std::size_t few = 16;  // this number is compared one by one

double cell_of(double coordinate, bool periodic) {
  const double cell = std::floor(coordinate / cell_width);
  if (!periodic) return cell;
  const double wrapped = std::fmod(cell, cells_in_a_revolution);
  return wrapped < 0 ? wrapped + cells_in_a_revolution : wrapped;
}

}  // namespace

bool PostureIndex::contains(const Arm& arm, std::size_t count, const Known& known,
                            const Configuration& q) {
  if (count < indexed_ || count <= few) {
    cells_.clear();
    indexed_ = 0;
  }
  if (count <= few) {
    for (std::size_t i = 0; i < count; ++i) {
      if (same_posture(arm, known(i), q)) return true;
    }
    return false;
  }
  const bool periodic = arm.periodic(0);
  for (; indexed_ < count; ++indexed_)
    cells_.emplace(cell_of(known(indexed_)[0], periodic), indexed_);
  // Rounding of many revolutions may move a value by one more cell.
  for (int beside = -2; beside <= 2; ++beside) {
    const auto [first, last] = cells_.equal_range(cell_of(q[0] + beside * cell_width, periodic));
    for (auto it = first; it != last; ++it) {
      if (same_posture(arm, known(it->second), q)) return true;
    }
  }
  return false;
}

}  // namespace beeline::internal
