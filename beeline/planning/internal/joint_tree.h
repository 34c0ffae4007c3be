#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// A tree of configurations whose edges are straight joint motions; with several roots, a forest.
class JointTree {
 public:
  explicit JointTree(int dof) : nodes_(dof, 0) {}

  std::size_t size() const { return parents_.size(); }
  Configuration node(std::size_t i) const { return nodes_.col(static_cast<Eigen::Index>(i)); }

  /// Adds a root. Returns its index.
  std::size_t add(const Configuration& q) { return add(q, size()); }
  /// Adds a node below another one. Returns its index.
  std::size_t add(const Configuration& q, std::size_t parent);

  /// Returns the nearest node to q. Requires one.
  std::size_t nearest(const Configuration& q) const;

  /// Returns the nodes from node i to its root.
  std::vector<Configuration> way_to_root(std::size_t i) const;
  /// Returns the index of the root above node i.
  std::size_t root_of(std::size_t i) const;

 private:
  Eigen::MatrixXd nodes_;                  ///< a column for each node, and more
  std::vector<std::size_t> parents_ = {};  ///< of a root: itself
};

}  // namespace beeline::internal
