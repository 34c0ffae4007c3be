#pragma once

#include <string>
#include <vector>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/computation_graph.h>
#include <beeline/formula/internal/symbolic_vector.h>
#include <beeline/formula/internal/tree.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// The kinematics of an arm as a graph. Its constants have the symbols' names.
class ChainGraph {
 public:
  /// With `numbers`, constants are numbers without names.
  ChainGraph(const SymbolicArm& arm, bool numbers);
  ChainGraph(const ChainGraph&) = delete;  // its numbers refer to its graph

  ComputationGraph& graph() { return graph_; }
  const ComputationGraph& graph() const { return graph_; }

  /// Returns the 16 entries of the tool's pose in the world, row by row.
  std::vector<ComputationGraph::Id> pose();

  /// Return the entries of the Jacobian and of its time derivative, 6 x dof, row by row.
  std::vector<ComputationGraph::Id> jacobian(Frame frame);
  std::vector<ComputationGraph::Id> derivative(Frame frame);

  GraphNumber expression(const Expression& expression);  ///< in the form that factored() writes

 private:
  /// The motion of a joint: its axis and a point of it in the world.
  struct Motion {
    int coordinate = 0;
    bool rotates = true;
    GraphNumber rate = {};  ///< rate of the motion for unit rate of the coordinate
    GraphVector axis = {}, point = {};
  };
  struct Twist {
    GraphVector linear = {}, angular = {};
  };

  GraphNumber constant(const std::string& name, double value) {
    return numbers_ ? number(value) : node(graph_.constant(name, value));
  }
  GraphNumber node(ComputationGraph::Id id) { return {&graph_, id}; }
  GraphNumber number(double value) { return node(graph_.number(value)); }
  GraphNumber symbol(int index);
  GraphNumber sum(const Angle& angle);
  std::string trig_name(const Trig& trig, ComputationGraph::Id sum) const;
  GraphNumber trig(const Trig& trig);
  GraphNumber rate(const Motion& motion) { return node(graph_.rate(motion.coordinate)); }
  GraphRotation axis_rotation(int axis, const Angle& angle);
  GraphVector constant_column(int axis);
  GraphRotation turned();
  GraphVector current_position();
  void close();
  void move_end();
  void append_rotation(const ElementaryTransform& transform);
  void append_translation(const ElementaryTransform& transform);
  void add_motions(const ElementaryTransform& transform);
  Twist twist(const Motion& motion, Frame frame);
  std::vector<Twist> rates_of_twists(Frame frame);
  std::vector<ComputationGraph::Id> matrix(const std::vector<Twist>& twists);
  Twist in_axes(const Twist& twist, Frame frame);

  const SymbolicArm& arm_;
  bool numbers_;
  ComputationGraph graph_;
  // These members are as in SymbolicPose. The position of a sum of rotations is added up in its own
  // frame.
  GraphRotation closed_{};
  GraphVector position_{}, open_position_{}, end_position_{};
  ExpressionRotation constant_ = identity_rotation();
  int axis_ = -1;
  Angle angle_ = {};
  Angle last_angle_ = {};  ///< the last sum that was formed
  GraphNumber last_sum_ = {};
  std::vector<Motion> motions_;
  GraphRotation rotation_{};  ///< rotation of the tool
};

}  // namespace beeline::internal
