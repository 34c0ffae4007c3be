#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <beeline/formula/internal/symbolic_vector.h>

namespace beeline::internal {

/// A computation without branches as a graph that computes each value once. Sums and products with
/// 0, 1 and -1 are simplified. Signs move outwards, so that a - b and b - a share a node.
class ComputationGraph {
 public:
  enum class Operation {
    number,
    constant,    ///< a named number
    coordinate,  ///< of the configuration
    rate,        ///< time derivative of a coordinate
    cosine,
    sine,
    negate,
    add,
    subtract,
    multiply
  };
  struct Node {
    Operation operation = Operation::number;
    double number = 0;      ///< value of a number or constant, index of a coordinate or rate
    std::string name = {};  ///< name of a constant, or of a cosine or sine, such as c12
    int a = -1, b = -1;     ///< operands

    bool has_operands() const { return a >= 0; }
  };
  using Id = int;

  Id number(double value);
  Id constant(const std::string& name, double value);
  Id coordinate(int index);
  Id rate(int index);
  Id cosine(Id angle, const std::string& name) { return trig(Operation::cosine, angle, name); }
  Id sine(Id angle, const std::string& name) { return trig(Operation::sine, angle, name); }
  Id negate(Id a);
  Id add(Id a, Id b);
  Id subtract(Id a, Id b) { return add(a, negate(b)); }
  Id multiply(Id a, Id b);

  const std::vector<Node>& nodes() const { return nodes_; }

  /// Returns how often each node is an operand or an output; 0 for nodes that no output depends on.
  /// A node behind a sign is used as often as the sign.
  std::vector<int> uses(const std::vector<Id>& outputs) const;

 private:
  using Key = std::tuple<Operation, double, std::string, int, int>;

  Id node(Operation operation, double number, const std::string& name, int a, int b);
  Id trig(Operation operation, Id angle, const std::string& name);
  bool is(Id id, double value) const;
  bool is_negation(Id id) const {
    return nodes_[static_cast<std::size_t>(id)].operation == Operation::negate;
  }
  /// Returns the other operand, if `part` is an operand of the sum.
  std::optional<Id> without(Id sum, Id part) const;
  int operand(Id id) const { return nodes_[static_cast<std::size_t>(id)].a; }

  std::vector<Node> nodes_;
  std::map<Key, Id> known_;
};

/// The number of operations. A sign is not an operation.
struct OperationCount {
  int multiplications = 0, additions = 0, trigonometric = 0;
};
OperationCount count_operations(const ComputationGraph& graph,
                                const std::vector<ComputationGraph::Id>& outputs);

/// A node of a graph with the arithmetic of a number.
struct GraphNumber {
  ComputationGraph* graph = nullptr;
  ComputationGraph::Id id = 0;

  friend GraphNumber operator+(GraphNumber a, GraphNumber b) {
    return {a.graph, a.graph->add(a.id, b.id)};
  }
  friend GraphNumber operator-(GraphNumber a, GraphNumber b) {
    return {a.graph, a.graph->subtract(a.id, b.id)};
  }
  friend GraphNumber operator-(GraphNumber a) { return {a.graph, a.graph->negate(a.id)}; }
  friend GraphNumber operator*(GraphNumber a, GraphNumber b) {
    return {a.graph, a.graph->multiply(a.id, b.id)};
  }
};

using GraphVector = VectorIn<GraphNumber>;
using GraphRotation = RotationIn<GraphNumber>;

}  // namespace beeline::internal
