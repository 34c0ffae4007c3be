#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// A tree of configurations whose edges are straight joint motions; with several roots, a forest.
class JointTree {
 public:
  explicit JointTree(int dof) : nodes_(dof, 0), searched_(dof, 0) {}

  std::size_t size() const { return parents_.size(); }
  Configuration node(std::size_t i) const { return nodes_.col(static_cast<Eigen::Index>(i)); }

  /// Adds a root. Returns its index.
  std::size_t add(const Configuration& q) { return add(q, size()); }
  /// Adds a node below another one. Returns its index.
  std::size_t add(const Configuration& q, std::size_t parent);

  /// Counts an attempt to grow from a node that led nowhere. nearest() leaves out nodes, except
  /// roots, with ten of them: in a narrow place the nodes at its ends are nearest to almost all
  /// configurations.
  void add_dead_end(std::size_t i);

  /// Removes all nodes but the first `count`, which are roots.
  void keep_roots(std::size_t count);

  /// Removes a node that is no root, and those below it.
  void remove(std::size_t i);

  /// Returns the nearest node to q. Requires one.
  std::size_t nearest(const Configuration& q) const;

  /// Returns the indices of the nodes from node i to its root.
  std::vector<std::size_t> path_to_root(std::size_t i) const;

 private:
  void exclude(std::size_t i);

  Eigen::MatrixXd nodes_;  ///< a column for each node, and more
  /// The same for nearest(): infinite for nodes that it leaves out.
  Eigen::MatrixXd searched_;
  std::vector<int> dead_ends_ = {};        ///< of each node
  std::vector<std::size_t> parents_ = {};  ///< of a root: itself
};

}  // namespace beeline::internal
