#include <algorithm>
#include <utility>

#include <beeline/formula/internal/computation_graph.h>

namespace beeline::internal {
namespace {

bool is_operation(ComputationGraph::Operation operation) {
  return operation == ComputationGraph::Operation::add ||
         operation == ComputationGraph::Operation::subtract ||
         operation == ComputationGraph::Operation::multiply;
}

}  // namespace

ComputationGraph::Id ComputationGraph::node(Operation operation, double number,
                                            const std::string& name, int a, int b) {
  const auto [place, is_new] =
      known_.try_emplace({operation, number, name, a, b}, static_cast<int>(nodes_.size()));
  if (is_new) nodes_.push_back({operation, number, name, a, b});
  return place->second;
}

bool ComputationGraph::is(Id id, double value) const {
  const Node& node = nodes_[static_cast<std::size_t>(id)];
  return node.operation == Operation::number && node.number == value;
}

ComputationGraph::Id ComputationGraph::number(double value) {
  if (value < 0) return negate(number(-value));
  return node(Operation::number, value + 0.0, "", -1, -1);
}

ComputationGraph::Id ComputationGraph::constant(const std::string& name, double value) {
  return node(Operation::constant, value, name, -1, -1);
}

ComputationGraph::Id ComputationGraph::coordinate(int index) {
  return node(Operation::coordinate, index, "", -1, -1);
}

ComputationGraph::Id ComputationGraph::rate(int index) {
  return node(Operation::rate, index, "", -1, -1);
}

ComputationGraph::Id ComputationGraph::trig(Operation operation, Id angle,
                                            const std::string& name) {
  if (is(angle, 0)) return number(operation == Operation::cosine ? 1 : 0);
  if (is_negation(angle)) {
    const Id positive = trig(operation, operand(angle), name);
    return operation == Operation::sine ? negate(positive) : positive;
  }
  return node(operation, 0, name, angle, -1);
}

ComputationGraph::Id ComputationGraph::negate(Id a) {
  if (is(a, 0)) return a;
  if (is_negation(a)) return operand(a);
  return node(Operation::negate, 0, "", a, -1);
}

std::optional<ComputationGraph::Id> ComputationGraph::without(Id sum, Id part) const {
  const Node& node = nodes_[static_cast<std::size_t>(sum)];
  if (node.operation != Operation::add || (node.a != part && node.b != part)) return std::nullopt;
  return node.a == part ? node.b : node.a;
}

ComputationGraph::Id ComputationGraph::add(Id a, Id b) {
  if (is(a, 0)) return b;
  if (is(b, 0)) return a;
  if (is_negation(a) && is_negation(b)) return negate(add(operand(a), operand(b)));
  if (is_negation(a)) std::swap(a, b);
  if (!is_negation(b)) return node(Operation::add, 0, "", std::min(a, b), std::max(a, b));
  b = operand(b);
  if (a == b) return number(0);
  if (const std::optional<Id> rest = without(a, b)) return *rest;          // (x + b) - b
  if (const std::optional<Id> rest = without(b, a)) return negate(*rest);  // a - (x + a)
  if (known_.count({Operation::subtract, 0, "", b, a}) > 0) {
    return negate(node(Operation::subtract, 0, "", b, a));
  }
  return node(Operation::subtract, 0, "", a, b);
}

ComputationGraph::Id ComputationGraph::multiply(Id a, Id b) {
  if (is(a, 0) || is(b, 1)) return a;
  if (is(b, 0) || is(a, 1)) return b;
  if (is_negation(a)) return negate(multiply(operand(a), b));
  if (is_negation(b)) return negate(multiply(a, operand(b)));
  const Node& left = nodes_[static_cast<std::size_t>(a)];
  const Node& right = nodes_[static_cast<std::size_t>(b)];
  if (left.operation == Operation::number && right.operation == Operation::number) {
    return number(left.number * right.number);
  }
  return node(Operation::multiply, 0, "", std::min(a, b), std::max(a, b));
}

std::vector<int> ComputationGraph::uses(const std::vector<Id>& outputs) const {
  std::vector<int> count(nodes_.size(), 0);
  for (const Id output : outputs) ++count[static_cast<std::size_t>(output)];
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // operands precede their operation
    if (count[i] == 0) continue;
    const int times =
        nodes_[i].operation == Operation::negate ? count[i] : 1;  // signs have no name
    if (nodes_[i].a >= 0) count[static_cast<std::size_t>(nodes_[i].a)] += times;
    if (nodes_[i].b >= 0) ++count[static_cast<std::size_t>(nodes_[i].b)];
  }
  return count;
}

OperationCount count_operations(const ComputationGraph& graph,
                                const std::vector<ComputationGraph::Id>& outputs) {
  OperationCount count;
  const std::vector<int> uses = graph.uses(outputs);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] == 0) continue;
    const ComputationGraph::Operation operation = graph.nodes()[i].operation;
    if (operation == ComputationGraph::Operation::multiply) {
      ++count.multiplications;
    } else if (is_operation(operation)) {
      ++count.additions;
    } else if (operation == ComputationGraph::Operation::cosine ||
               operation == ComputationGraph::Operation::sine) {
      ++count.trigonometric;
    }
  }
  return count;
}

}  // namespace beeline::internal
