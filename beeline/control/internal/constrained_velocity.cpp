#include <algorithm>
#include <cmath>

#include <beeline/control/internal/constrained_velocity.h>

namespace beeline::internal {
namespace {

constexpr double violated = 1e-10;        // smaller violations count as none
constexpr double dependent_rows = 1e-10;  // damping of inequalities that depend on each other

}  // namespace

ConstrainedVelocity::ConstrainedVelocity(int dof, int max_rows)
    : dof_(dof),
      max_rows_(max_rows),
      rows_(dof, max_rows),
      least_(max_rows),
      factor_(dof),
      x_(dof),
      active_(static_cast<std::size_t>(dof) + 1),
      directions_(dof, dof + 1),
      gram_(dof + 1, dof + 1),
      multipliers_(dof + 1),
      trial_(dof + 1) {}

void ConstrainedVelocity::add(const Eigen::VectorXd& row, double least) {
  const double size = row.norm();
  if (count_ == max_rows_) return;
  rows_.col(count_) = row / std::max(size, 1e-300);
  least_[count_] = size > 1e-12 ? least / size : -1e300;
  ++count_;
}

double ConstrainedVelocity::product(int i, const Eigen::Ref<const Eigen::VectorXd>& x) const {
  if (i < count_) return rows_.col(i).dot(x);
  return i < count_ + dof_ ? x[i - count_] : -x[i - count_ - dof_];
}

double ConstrainedVelocity::violation(int i, const Eigen::VectorXd& x, const Eigen::VectorXd& lower,
                                      const Eigen::VectorXd& upper) const {
  if (i < count_) return least_[i] - rows_.col(i).dot(x);
  const int k = (i - count_) % dof_;
  return i < count_ + dof_ ? lower[k] - x[k] : x[k] - upper[k];
}

/// Returns the inequality that x_ violates most; -1 if it satisfies all.
int ConstrainedVelocity::most_violated(const Eigen::VectorXd& lower,
                                       const Eigen::VectorXd& upper) const {
  double largest = violated;
  int worst = -1;
  for (int i = 0; i < count_ + 2 * dof_; ++i) {
    const double by = violation(i, x_, lower, upper);
    if (!(by > largest) || std::find(active_.begin(), active_.end(), i) != active_.end()) continue;
    largest = by;
    worst = i;
  }
  return worst;
}

bool ConstrainedVelocity::activate(int i) {
  const auto place = static_cast<Eigen::Index>(active_.size());
  if (active_.full()) return false;
  auto direction = directions_.col(place);
  if (i < count_) {
    direction = rows_.col(i);
  } else {
    direction.setZero();
    direction[(i - count_) % dof_] = i < count_ + dof_ ? 1 : -1;
  }
  factor_.solveInPlace(direction);
  active_.push_back(i);
  multipliers_[place] = 0;
  return true;
}

void ConstrainedVelocity::deactivate(int place) {
  active_.remove(static_cast<std::size_t>(place));
  for (auto k = static_cast<Eigen::Index>(place); k < static_cast<Eigen::Index>(active_.size());
       ++k) {
    directions_.col(k) = directions_.col(k + 1);
    multipliers_[k] = multipliers_[k + 1];
  }
}

/// Finds the multipliers with which the active inequalities hold as equations; deactivates those
/// whose multiplier would be negative. Returns false if none is left.
bool ConstrainedVelocity::solve_active(const Eigen::VectorXd& x0, const Eigen::VectorXd& lower,
                                       const Eigen::VectorXd& upper) {
  while (!active_.empty()) {
    const auto size = static_cast<Eigen::Index>(active_.size());
    // Cholesky factors of the Gram matrix in its lower half, and the solution of both triangles.
    for (Eigen::Index i = 0; i < size; ++i) {
      const int row = active_[static_cast<std::size_t>(i)];
      trial_[i] = violation(row, x0, lower, upper);
      for (Eigen::Index j = 0; j <= i; ++j) {
        double sum = product(row, directions_.col(j)) * (i == j ? 1 + dependent_rows : 1);
        for (Eigen::Index k = 0; k < j; ++k) sum -= gram_(i, k) * gram_(j, k);
        gram_(i, j) = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / gram_(j, j);
      }
      for (Eigen::Index k = 0; k < i; ++k) trial_[i] -= gram_(i, k) * trial_[k];
      trial_[i] /= gram_(i, i);
    }
    for (Eigen::Index i = size; i-- > 0;) {
      for (Eigen::Index k = i + 1; k < size; ++k) trial_[i] -= gram_(k, i) * trial_[k];
      trial_[i] /= gram_(i, i);
    }
    double fraction = 1;
    Eigen::Index first = -1;
    for (Eigen::Index i = 0; i < size; ++i) {
      if (trial_[i] > 0) continue;
      const double reached = multipliers_[i] / std::max(multipliers_[i] - trial_[i], 1e-300);
      if (first >= 0 && !(reached < fraction)) continue;
      fraction = reached;
      first = i;
    }
    multipliers_.head(size) += fraction * (trial_.head(size) - multipliers_.head(size));
    if (first < 0) return true;
    deactivate(static_cast<int>(first));
  }
  return false;
}

const Eigen::VectorXd& ConstrainedVelocity::solve(const Eigen::MatrixXd& h,
                                                  const Eigen::VectorXd& x0,
                                                  const Eigen::VectorXd& lower,
                                                  const Eigen::VectorXd& upper) {
  factor_.compute(h);
  x_ = x0;
  active_.clear();
  const int max_passes = 4 * dof_ + 8;
  for (int pass = 0; pass < max_passes; ++pass) {
    const int worst = most_violated(lower, upper);
    if (worst < 0 || !activate(worst)) break;
    solve_active(x0, lower, upper);
    x_ = x0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      x_ += multipliers_[static_cast<Eigen::Index>(i)] *
            directions_.col(static_cast<Eigen::Index>(i));
    }
  }
  leading_ = -1;
  double largest = 0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const double multiplier = multipliers_[static_cast<Eigen::Index>(i)];
    if (active_[i] >= count_ || !(multiplier > largest)) continue;
    largest = multiplier;
    leading_ = active_[i];
  }
  return x_;
}

}  // namespace beeline::internal
