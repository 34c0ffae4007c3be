#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <beeline/formula/internal/chain_graph.h>
#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_twists.h>

namespace beeline::internal {

ChainGraph::ChainGraph(const SymbolicArm& arm, bool numbers) : arm_(arm), numbers_(numbers) {
  const GraphNumber zero = number(0), one = number(1);
  closed_ = internal::axis_rotation(2, one, zero, zero, one);
  last_sum_ = zero;
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

GraphNumber ChainGraph::symbol(int index) {
  const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(index)];
  if (symbol.coordinate < 0) return constant(symbol.name(), symbol.value);
  const GraphNumber coordinate =
      node(symbol.kind == SymbolKind::rate ? graph_.rate(symbol.coordinate)
                                           : graph_.coordinate(symbol.coordinate));
  const GraphNumber product = number(symbol.ratio) * coordinate;
  return product + number(symbol.value);
}

/// Returns the sum of an angle's multiples. If the previous sum is the beginning of this one, it is
/// continued, as for the angles of parallel joints.
GraphNumber ChainGraph::sum(const Angle& angle) {
  const auto& last = last_angle_.multiples;
  const auto& multiples = angle.multiples;
  const bool continues =
      last.size() <= multiples.size() && std::equal(last.begin(), last.end(), multiples.begin());
  GraphNumber result = continues ? last_sum_ : number(0);
  for (std::size_t i = continues ? last.size() : 0; i < multiples.size(); ++i) {
    const auto& [index, multiple] = multiples[i];
    const GraphNumber value = symbol(index);
    result = result + number(multiple) * value;
  }
  last_angle_ = angle;
  last_sum_ = result;
  return result;
}

/// Returns c12, c_theta3, or c_sum9 for the sum of many angles.
std::string ChainGraph::trig_name(const Trig& trig, ComputationGraph::Id sum) const {
  constexpr std::size_t most = 9;
  const std::string letter = trig.sine ? "s" : "c";
  if (trig.angle.multiples.size() > most) return letter + "_sum" + std::to_string(sum);
  std::string name = letter;
  for (const auto& [number, multiple] : trig.angle.multiples) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
    const int times = std::abs(multiple);
    const bool joint = symbol.is_coordinate();
    name += multiple < 0 ? "_m" : joint && arm_.dof < 10 ? "" : "_";
    name += (times == 1 ? "" : std::to_string(times) + "x") +
            (joint ? symbol.subscript : symbol.name());
  }
  return name;
}

/// Returns the cosine or sine of an angle. For constant angles it is a constant.
GraphNumber ChainGraph::trig(const Trig& trig) {
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
  const ComputationGraph::Id angle = sum(trig.angle).id;
  const std::string name = trig_name(trig, angle);
  return node(trig.sine ? graph_.sine(angle, name) : graph_.cosine(angle, name));
}

GraphNumber ChainGraph::expression(const Expression& expression) {
  const auto value = [this](const Coefficient& coefficient) { return number(coefficient.value()); };
  return evaluated<GraphNumber>(factored(expression), value, [this](const Tree& leaf) {
    return leaf.kind == Tree::Kind::symbol ? symbol(leaf.symbol) : trig(leaf.trig);
  });
}

/// Returns a column of the constant rotation after the sum of rotations.
GraphVector ChainGraph::constant_column(int axis) {
  GraphVector column{};
  for (std::size_t row = 0; row < 3; ++row) {
    column[row] = expression(constant_[static_cast<std::size_t>(axis)][row]);
  }
  return column;
}

GraphRotation ChainGraph::axis_rotation(int axis, const Angle& angle) {
  // The angle's first multiple is positive in Expression::cosine() and sine().
  const GraphNumber c = expression(Expression::cosine(angle));
  const GraphNumber s = expression(Expression::sine(angle));
  return internal::axis_rotation(axis, c, s, number(0), number(1));
}

/// Returns the rotation up to the end of the sum, in the world, without the constant rotation after
/// it.
GraphRotation ChainGraph::turned() {
  if (axis_ < 0) return closed_;
  return closed_ * axis_rotation(axis_, angle_);
}

/// Returns the current position. Translations at the end of a sum are along columns of the
/// rotation, which are needed anyway. Translations before it are added up in the frame before the
/// sum, in which they are planar.
GraphVector ChainGraph::current_position() {
  const GraphVector inside = closed_ * open_position_;
  const GraphVector end = turned() * end_position_;
  return position_ + inside + end;
}

void ChainGraph::close() {
  position_ = current_position();
  const GraphRotation rotation = turned();
  for (int axis = 0; axis < 3; ++axis) {
    closed_[static_cast<std::size_t>(axis)] = rotation * constant_column(axis);
  }
  const GraphNumber zero = number(0);
  open_position_ = end_position_ = {zero, zero, zero};
  constant_ = identity_rotation();
  axis_ = -1;
  angle_ = {};
}

/// Adds the translations at the end of the sum to the translations before it, when the sum
/// continues.
void ChainGraph::move_end() {
  const GraphVector end = axis_ < 0 ? end_position_ : axis_rotation(axis_, angle_) * end_position_;
  const GraphNumber zero = number(0);
  open_position_ = open_position_ + end;
  end_position_ = {zero, zero, zero};
}

void ChainGraph::append_rotation(const ElementaryTransform& transform) {
  if (transform.symbol < 0) {
    const ExpressionRotation exact =
        exact_rotation(transform.axis, transform.multiple_of_15_degrees);
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
  const GraphVector column = constant_column(transform.axis);
  end_position_ = end_position_ + expression(transform.distance) * column;
}

/// Adds the motions of a transform for unit rates of its coordinates.
void ChainGraph::add_motions(const ElementaryTransform& transform) {
  const auto add_motion = [&](const Symbol& symbol, GraphNumber rate) {
    motions_.push_back({symbol.coordinate, transform.rotation, rate,
                        turned() * constant_column(transform.axis), current_position()});
  };
  if (transform.rotation) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(transform.symbol)];
    if (symbol.coordinate >= 0) {
      add_motion(symbol, number(transform.multiple * symbol.ratio));
    }
    return;
  }
  for (const int index : variables_of(arm_, transform.distance)) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(index)];
    const GraphNumber slope = expression(transform.distance.derivative(index));
    add_motion(symbol, number(symbol.ratio) * slope);
  }
}

std::vector<ComputationGraph::Id> ChainGraph::pose() {
  std::vector<ComputationGraph::Id> entries;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      entries.push_back(rotation_[column][row].id);
    }
    entries.push_back(position_[row].id);
  }
  for (const double last : {0, 0, 0, 1}) entries.push_back(graph_.number(last));
  return entries;
}

}  // namespace beeline::internal
