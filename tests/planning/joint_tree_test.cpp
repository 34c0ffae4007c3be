#include <gtest/gtest.h>

#include <beeline/planning/internal/joint_tree.h>

namespace beeline::internal {
namespace {

Configuration at(double x) { return Configuration::Constant(1, x); }

TEST(JointTree, FindsTheNearestNodeThatIsNotRemoved) {
  JointTree tree(1);
  const std::size_t root = tree.add(at(0)), near = tree.add(at(1), root),
                    behind = tree.add(at(2), near), other = tree.add(at(-1), root);
  EXPECT_EQ(tree.nearest(at(5)), behind);
  EXPECT_EQ(tree.path_to_root(behind), (std::vector{behind, near, root}));
  tree.remove(near);
  EXPECT_EQ(tree.nearest(at(5)), root) << "what is behind a removed node is removed, too";
  EXPECT_EQ(tree.nearest(at(-5)), other);
}

TEST(JointTree, LeavesOutDeadEnds) {
  JointTree tree(1);
  const std::size_t root = tree.add(at(0)), end = tree.add(at(1), root);
  for (int i = 0; i < 9; ++i) tree.add_dead_end(end);
  EXPECT_EQ(tree.nearest(at(5)), end);
  tree.add_dead_end(end);
  EXPECT_EQ(tree.nearest(at(5)), root);
  for (int i = 0; i < 20; ++i) tree.add_dead_end(root);
  EXPECT_EQ(tree.nearest(at(5)), root) << "roots stay";
  EXPECT_EQ(tree.node(end), at(1)) << "the node is still on paths";
}

TEST(JointTree, BeginsAgainFromItsRoots) {
  JointTree tree(1);
  tree.add(at(0));
  const std::size_t second = tree.add(at(3));
  for (int i = 0; i < 200; ++i) tree.add(at(4 + i), second);
  tree.keep_roots(2);
  EXPECT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree.nearest(at(500)), second);
  EXPECT_EQ(tree.nearest(at(1)), 0U);
}

}  // namespace
}  // namespace beeline::internal
