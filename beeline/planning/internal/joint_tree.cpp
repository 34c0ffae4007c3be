#include <algorithm>
#include <limits>

#include <beeline/planning/internal/joint_tree.h>

namespace beeline::internal {

std::size_t JointTree::add(const Configuration& q, std::size_t parent) {
  const auto i = static_cast<Eigen::Index>(size());
  if (i == nodes_.cols()) {
    const Eigen::Index room = std::max<Eigen::Index>(64, 2 * i);
    nodes_.conservativeResize(Eigen::NoChange, room);
    searched_.conservativeResize(Eigen::NoChange, room);
  }
  nodes_.col(i) = searched_.col(i) = q;
  parents_.push_back(parent);
  dead_ends_.push_back(0);
  return size() - 1;
}

std::size_t JointTree::nearest(const Configuration& q) const {
  Eigen::Index nearest = 0;
  (searched_.leftCols(static_cast<Eigen::Index>(size())).colwise() - q)
      .colwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return static_cast<std::size_t>(nearest);
}

void JointTree::add_dead_end(std::size_t i) {
  constexpr int most = 10;
  if (++dead_ends_[i] == most && parents_[i] != i) exclude(i);
}

void JointTree::exclude(std::size_t i) {
  searched_.col(static_cast<Eigen::Index>(i)).setConstant(std::numeric_limits<double>::infinity());
}

void JointTree::keep_roots(std::size_t count) {
  parents_.resize(count);
  dead_ends_.resize(count);
}

void JointTree::remove(std::size_t i) {
  std::vector<bool> removed(size());
  removed[i] = true;
  for (std::size_t k = i; k < size(); ++k) {  // a parent is before its children
    if (removed[parents_[k]]) removed[k] = true;
    if (!removed[k]) continue;
    exclude(k);
  }
}

std::vector<std::size_t> JointTree::path_to_root(std::size_t i) const {
  std::vector<std::size_t> path{i};
  for (; parents_[i] != i; i = parents_[i]) path.push_back(parents_[i]);
  return path;
}

}  // namespace beeline::internal
