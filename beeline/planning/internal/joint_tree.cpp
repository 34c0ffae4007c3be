#include <algorithm>

#include <beeline/planning/internal/joint_tree.h>

namespace beeline::internal {

std::size_t JointTree::add(const Configuration& q, std::size_t parent) {
  const auto i = static_cast<Eigen::Index>(size());
  if (i == nodes_.cols()) {
    nodes_.conservativeResize(Eigen::NoChange, std::max<Eigen::Index>(64, 2 * i));
  }
  nodes_.col(i) = q;
  parents_.push_back(parent);
  return size() - 1;
}

std::size_t JointTree::nearest(const Configuration& q) const {
  Eigen::Index nearest = 0;
  (nodes_.leftCols(static_cast<Eigen::Index>(size())).colwise() - q)
      .colwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return static_cast<std::size_t>(nearest);
}

std::vector<Configuration> JointTree::way_to_root(std::size_t i) const {
  std::vector<Configuration> way{node(i)};
  for (; parents_[i] != i; i = parents_[i]) way.push_back(node(parents_[i]));
  return way;
}

std::size_t JointTree::root_of(std::size_t i) const {
  while (parents_[i] != i) i = parents_[i];
  return i;
}

}  // namespace beeline::internal
