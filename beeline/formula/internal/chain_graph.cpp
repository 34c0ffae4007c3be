#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <beeline/formula/internal/chain_graph.h>
#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_twists.h>

namespace beeline::internal {

ChainGraph::ChainGraph(const SymbolicArm& arm, bool numbers) : arm_(arm), numbers_(numbers) {
  const ComputationGraph::Id zero = graph_.number(0), one = graph_.number(1);
  closed_ = {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
  position_ = open_position_ = end_position_ = {zero, zero, zero};
  for (const auto& transforms : arm.transforms) {
    for (const ElementaryTransform& transform : transforms) {
      if (transform.rotation) {
        append_rotation(transform);
      } else {
        append_translation(transform);
      }
    }
  }
  close();
  rotation_ = closed_;
}

ComputationGraph::Id ChainGraph::constant(const std::string& name, double value) {
  if (numbers_) return graph_.number(value);
  constants_[name] = value;
  return graph_.variable(name);
}

ComputationGraph::Id ChainGraph::symbol(int number) {
  const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
  if (symbol.coordinate < 0) {
    return constant(symbol.name(), symbol.value);
  }
  const std::string vector = symbol.kind == SymbolKind::rate ? "dq" : "q";
  const ComputationGraph::Id coordinate =
      graph_.variable(vector + '[' + std::to_string(symbol.coordinate) + ']');
  return graph_.add(graph_.multiply(graph_.number(symbol.ratio), coordinate),
                    graph_.number(symbol.value));
}

/// The sum of an angle's multiples. The previous sum is continued where it begins this one, as the
/// angles of parallel joints do.
ComputationGraph::Id ChainGraph::sum(const Angle& angle) {
  const auto& last = last_angle_.multiples;
  const auto& multiples = angle.multiples;
  const bool continues =
      last.size() <= multiples.size() && std::equal(last.begin(), last.end(), multiples.begin());
  ComputationGraph::Id result = continues ? last_sum_ : graph_.number(0);
  for (std::size_t i = continues ? last.size() : 0; i < multiples.size(); ++i) {
    const auto& [number, multiple] = multiples[i];
    result = graph_.add(result, graph_.multiply(graph_.number(multiple), symbol(number)));
  }
  last_angle_ = angle;
  last_sum_ = result;
  return result;
}

/// c12, c_theta3, or c_sum9 for the sum of many angles.
std::string ChainGraph::trig_name(const Trig& trig, ComputationGraph::Id sum) const {
  constexpr std::size_t most = 9;
  const std::string letter = trig.sine ? "s" : "c";
  if (trig.angle.multiples.size() > most) return letter + "_sum" + std::to_string(sum);
  std::string name = letter;
  for (const auto& [number, multiple] : trig.angle.multiples) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
    const int times = std::abs(multiple);
    const bool joint = symbol.letter == "q";
    name += multiple < 0 ? "_m" : joint && arm_.dof < 10 ? "" : "_";
    name += (times == 1 ? "" : std::to_string(times) + "x") +
            (joint ? symbol.subscript : symbol.name());
  }
  return name;
}

/// The cosine or sine of an angle. That of constants is a constant.
ComputationGraph::Id ChainGraph::trig(const Trig& trig) {
  bool varies = false;
  double constant_angle = 0;
  for (const auto& [number, multiple] : trig.angle.multiples) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
    varies = varies || symbol.coordinate >= 0;
    constant_angle += multiple * symbol.value;
  }
  if (!varies) {
    const double value = trig.sine ? std::sin(constant_angle) : std::cos(constant_angle);
    return constant(trig_name(trig, 0), value);
  }
  const ComputationGraph::Id angle = sum(trig.angle);
  const std::string name = trig_name(trig, angle);
  return trig.sine ? graph_.sine(angle, name) : graph_.cosine(angle, name);
}

ComputationGraph::Id ChainGraph::tree(const Tree& tree) {
  ComputationGraph::Id result = graph_.number(tree.coefficient.value());
  switch (tree.kind) {
    case Tree::Kind::symbol:
      return symbol(tree.symbol);
    case Tree::Kind::trig:
      return trig(tree.trig);
    case Tree::Kind::sum:
      result = graph_.number(0);
      for (const Tree& part : tree.parts) result = graph_.add(result, this->tree(part));
      return result;
    case Tree::Kind::product:
      for (const Tree& part : tree.parts) result = graph_.multiply(result, this->tree(part));
      return result;
    case Tree::Kind::power:
      result = graph_.number(1);
      for (int k = 0; k < tree.exponent; ++k) {
        result = graph_.multiply(result, this->tree(tree.parts.front()));
      }
      return result;
    case Tree::Kind::number:
    case Tree::Kind::quotient:
    case Tree::Kind::arctangent:
    case Tree::Kind::signed_root:
    case Tree::Kind::angle:
      break;
  }
  return result;
}

ComputationGraph::Id ChainGraph::expression(const Expression& expression) {
  return tree(factored(expression));
}

/// A column of the constant rotation behind the sum of rotations.
GraphVector ChainGraph::constant_column(int axis) {
  GraphVector column{};
  for (std::size_t row = 0; row < 3; ++row) {
    column[row] = expression(constant_[static_cast<std::size_t>(axis)][row]);
  }
  return column;
}

GraphRotation ChainGraph::axis_rotation(int axis, const Angle& angle) {
  const ComputationGraph::Id zero = graph_.number(0), one = graph_.number(1);
  // The angle's first multiple is positive in Expression::cosine() and sine().
  const ComputationGraph::Id c = expression(Expression::cosine(angle));
  const ComputationGraph::Id s = expression(Expression::sine(angle));
  const auto z = static_cast<std::size_t>(axis), x = (z + 1) % 3, y = (z + 2) % 3;
  GraphRotation r{{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}}};
  r[z][z] = one;
  r[x][x] = c;
  r[x][y] = s;
  r[y][x] = graph_.negate(s);
  r[y][y] = c;
  return r;
}

/// The rotation up to the end of the sum, in the world, without the constant one behind it.
GraphRotation ChainGraph::turned() {
  if (axis_ < 0) return closed_;
  const GraphRotation open = axis_rotation(axis_, angle_);
  return {rotate(graph_, closed_, open[0]), rotate(graph_, closed_, open[1]),
          rotate(graph_, closed_, open[2])};
}

/// Translations at the end of a sum are along columns of the rotation, which are needed anyway;
/// those before are added up in the frame before the sum, where they are in a plane.
GraphVector ChainGraph::current_position() {
  const GraphVector inside = rotate(graph_, closed_, open_position_);
  const GraphVector end = rotate(graph_, turned(), end_position_);
  return add(graph_, add(graph_, position_, inside), end);
}

void ChainGraph::close() {
  position_ = current_position();
  const GraphRotation rotation = turned();
  for (int axis = 0; axis < 3; ++axis) {
    closed_[static_cast<std::size_t>(axis)] = rotate(graph_, rotation, constant_column(axis));
  }
  const ComputationGraph::Id zero = graph_.number(0);
  open_position_ = end_position_ = {zero, zero, zero};
  constant_ = identity_rotation();
  axis_ = -1;
  angle_ = {};
}

/// Adds the translations at the end of the sum to those before, as the sum continues.
void ChainGraph::move_end() {
  const GraphVector end =
      axis_ < 0 ? end_position_ : rotate(graph_, axis_rotation(axis_, angle_), end_position_);
  const ComputationGraph::Id zero = graph_.number(0);
  open_position_ = add(graph_, open_position_, end);
  end_position_ = {zero, zero, zero};
}

void ChainGraph::append_rotation(const ElementaryTransform& transform) {
  if (transform.symbol < 0) {
    const ExpressionRotation exact = exact_rotation(transform.axis, transform.fifteenths);
    constant_ = constant_ * exact;
    return;
  }
  const Angle angle{arm_.groups[static_cast<std::size_t>(transform.symbol)],
                    {{transform.symbol, transform.multiple}}};
  const int sign =
      axis_ < 0 ? 0 : sign_along(constant_[static_cast<std::size_t>(transform.axis)], axis_);
  if (sign != 0) {
    move_end();
    add_motions(transform);
    angle_ = angle_ + sign * angle;
    return;
  }
  close();
  add_motions(transform);
  axis_ = transform.axis;
  angle_ = angle;
}

void ChainGraph::append_translation(const ElementaryTransform& transform) {
  add_motions(transform);
  const GraphVector step =
      scale(graph_, expression(transform.distance), constant_column(transform.axis));
  end_position_ = add(graph_, end_position_, step);
}

/// The motions of a transform for unit rates of the coordinates that it depends on.
void ChainGraph::add_motions(const ElementaryTransform& transform) {
  const auto add_motion = [&](const Symbol& symbol, ComputationGraph::Id rate) {
    motions_.push_back({symbol.coordinate, transform.rotation, rate,
                        rotate(graph_, turned(), constant_column(transform.axis)),
                        current_position()});
  };
  if (transform.rotation) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(transform.symbol)];
    if (symbol.coordinate >= 0) {
      add_motion(symbol, graph_.number(transform.multiple * symbol.ratio));
    }
    return;
  }
  for (const int number : variables_of(arm_, transform.distance)) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
    add_motion(symbol, graph_.multiply(graph_.number(symbol.ratio),
                                       expression(transform.distance.derivative(number))));
  }
}

std::vector<ComputationGraph::Id> ChainGraph::pose() {
  std::vector<ComputationGraph::Id> entries;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) entries.push_back(rotation_[column][row]);
    entries.push_back(position_[row]);
  }
  for (const double last : {0, 0, 0, 1}) entries.push_back(graph_.number(last));
  return entries;
}

}  // namespace beeline::internal
