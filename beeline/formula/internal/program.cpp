#include <algorithm>
#include <utility>

#include <beeline/formula/internal/program.h>

namespace beeline::internal {
namespace {

bool is_operation(Program::Operation operation) {
  return operation == Program::Operation::add || operation == Program::Operation::subtract ||
         operation == Program::Operation::multiply;
}

}  // namespace

Program::Id Program::node(Operation operation, double number, const std::string& name, int a,
                          int b) {
  const auto [place, is_new] =
      known_.try_emplace({operation, number, name, a, b}, static_cast<int>(nodes_.size()));
  if (is_new) nodes_.push_back({operation, number, name, a, b});
  return place->second;
}

bool Program::is(Id id, double value) const {
  const Node& node = nodes_[static_cast<std::size_t>(id)];
  return node.operation == Operation::number && node.number == value;
}

Program::Id Program::number(double value) {
  if (value < 0) return negate(number(-value));
  return node(Operation::number, value + 0.0, "", -1, -1);
}

Program::Id Program::variable(const std::string& name) {
  return node(Operation::variable, 0, name, -1, -1);
}

Program::Id Program::trig(Operation operation, Id angle, const std::string& name) {
  if (is(angle, 0)) return number(operation == Operation::cosine ? 1 : 0);
  if (is_negation(angle)) {
    const Id positive = trig(operation, operand(angle), name);
    return operation == Operation::sine ? negate(positive) : positive;
  }
  return node(operation, 0, name, angle, -1);
}

Program::Id Program::negate(Id a) {
  if (is(a, 0)) return a;
  if (is_negation(a)) return operand(a);
  return node(Operation::negate, 0, "", a, -1);
}

std::optional<Program::Id> Program::without(Id sum, Id part) const {
  const Node& node = nodes_[static_cast<std::size_t>(sum)];
  if (node.operation != Operation::add || (node.a != part && node.b != part)) return std::nullopt;
  return node.a == part ? node.b : node.a;
}

Program::Id Program::add(Id a, Id b) {
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

Program::Id Program::multiply(Id a, Id b) {
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

std::vector<int> Program::uses(const std::vector<Id>& outputs) const {
  std::vector<int> count(nodes_.size(), 0);
  for (const Id output : outputs) ++count[static_cast<std::size_t>(output)];
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // operands come before
    if (count[i] == 0) continue;
    const int times = nodes_[i].operation == Operation::negate ? count[i] : 1;  // signs get no name
    if (nodes_[i].a >= 0) count[static_cast<std::size_t>(nodes_[i].a)] += times;
    if (nodes_[i].b >= 0) ++count[static_cast<std::size_t>(nodes_[i].b)];
  }
  return count;
}

ProgramCount count_operations(const Program& program, const std::vector<Program::Id>& outputs) {
  ProgramCount count;
  const std::vector<int> uses = program.uses(outputs);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] == 0) continue;
    const Program::Operation operation = program.nodes()[i].operation;
    if (operation == Program::Operation::multiply) {
      ++count.multiplications;
    } else if (is_operation(operation)) {
      ++count.additions;
    } else if (operation == Program::Operation::cosine || operation == Program::Operation::sine) {
      ++count.trigonometric;
    }
  }
  return count;
}

ProgramVector add(Program& program, const ProgramVector& a, const ProgramVector& b) {
  return {program.add(a[0], b[0]), program.add(a[1], b[1]), program.add(a[2], b[2])};
}

ProgramVector subtract(Program& program, const ProgramVector& a, const ProgramVector& b) {
  return {program.subtract(a[0], b[0]), program.subtract(a[1], b[1]), program.subtract(a[2], b[2])};
}

ProgramVector scale(Program& program, Program::Id factor, const ProgramVector& v) {
  return {program.multiply(factor, v[0]), program.multiply(factor, v[1]),
          program.multiply(factor, v[2])};
}

ProgramVector cross(Program& program, const ProgramVector& a, const ProgramVector& b) {
  ProgramVector result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result[i] = program.subtract(program.multiply(a[j], b[k]), program.multiply(a[k], b[j]));
  }
  return result;
}

ProgramVector rotate(Program& program, const ProgramRotation& r, const ProgramVector& v) {
  ProgramVector sum = scale(program, v[0], r[0]);
  sum = add(program, sum, scale(program, v[1], r[1]));
  return add(program, sum, scale(program, v[2], r[2]));
}

ProgramVector rotate_back(Program& program, const ProgramRotation& r, const ProgramVector& v) {
  ProgramVector result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Program::Id first =
        program.add(program.multiply(r[i][0], v[0]), program.multiply(r[i][1], v[1]));
    result[i] = program.add(first, program.multiply(r[i][2], v[2]));
  }
  return result;
}

}  // namespace beeline::internal
