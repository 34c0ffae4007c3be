#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <beeline/formula/internal/program_chain.h>
#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_twists.h>

namespace beeline::internal {

ProgramChain::ProgramChain(const SymbolicArm& arm, bool numbers) : arm_(arm), numbers_(numbers) {
  const Program::Id zero = program_.number(0), one = program_.number(1);
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

Program::Id ProgramChain::constant(const std::string& name, double value) {
  if (numbers_) return program_.number(value);
  constants_[name] = value;
  return program_.variable(name);
}

Program::Id ProgramChain::symbol(int number) {
  const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
  if (symbol.coordinate < 0) {
    return constant(symbol.name(), symbol.value);
  }
  const std::string vector = symbol.kind == SymbolKind::rate ? "dq" : "q";
  const Program::Id coordinate =
      program_.variable(vector + '[' + std::to_string(symbol.coordinate) + ']');
  return program_.add(program_.multiply(program_.number(symbol.ratio), coordinate),
                      program_.number(symbol.value));
}

/// The sum of an angle's multiples. The previous sum is continued where it begins this one, as the
/// angles of parallel joints do.
Program::Id ProgramChain::sum(const Angle& angle) {
  const auto& last = last_angle_.multiples;
  const auto& multiples = angle.multiples;
  const bool continues =
      last.size() <= multiples.size() && std::equal(last.begin(), last.end(), multiples.begin());
  Program::Id result = continues ? last_sum_ : program_.number(0);
  for (std::size_t i = continues ? last.size() : 0; i < multiples.size(); ++i) {
    const auto& [number, multiple] = multiples[i];
    result = program_.add(result, program_.multiply(program_.number(multiple), symbol(number)));
  }
  last_angle_ = angle;
  last_sum_ = result;
  return result;
}

/// c12, c_theta3, or c_sum9 for the sum of many angles.
std::string ProgramChain::trig_name(const Trig& trig, Program::Id sum) const {
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
Program::Id ProgramChain::trig(const Trig& trig) {
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
  const Program::Id angle = sum(trig.angle);
  const std::string name = trig_name(trig, angle);
  return trig.sine ? program_.sine(angle, name) : program_.cosine(angle, name);
}

Program::Id ProgramChain::tree(const Tree& tree) {
  Program::Id result = program_.number(tree.coefficient.value());
  switch (tree.kind) {
    case Tree::Kind::symbol:
      return symbol(tree.symbol);
    case Tree::Kind::trig:
      return trig(tree.trig);
    case Tree::Kind::sum:
      result = program_.number(0);
      for (const Tree& part : tree.parts) result = program_.add(result, this->tree(part));
      return result;
    case Tree::Kind::product:
      for (const Tree& part : tree.parts) result = program_.multiply(result, this->tree(part));
      return result;
    case Tree::Kind::power:
      result = program_.number(1);
      for (int k = 0; k < tree.exponent; ++k) {
        result = program_.multiply(result, this->tree(tree.parts.front()));
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

Program::Id ProgramChain::expression(const Expression& expression) {
  return tree(factored(expression));
}

/// A column of the constant rotation behind the sum of rotations.
ProgramVector ProgramChain::constant_column(int axis) {
  ProgramVector column{};
  for (std::size_t row = 0; row < 3; ++row) {
    column[row] = expression(constant_[static_cast<std::size_t>(axis)][row]);
  }
  return column;
}

ProgramRotation ProgramChain::axis_rotation(int axis, const Angle& angle) {
  const Program::Id zero = program_.number(0), one = program_.number(1);
  // The angle's first multiple is positive in Expression::cosine() and sine().
  const Program::Id c = expression(Expression::cosine(angle));
  const Program::Id s = expression(Expression::sine(angle));
  const auto z = static_cast<std::size_t>(axis), x = (z + 1) % 3, y = (z + 2) % 3;
  ProgramRotation r{{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}}};
  r[z][z] = one;
  r[x][x] = c;
  r[x][y] = s;
  r[y][x] = program_.negate(s);
  r[y][y] = c;
  return r;
}

/// The rotation up to the end of the sum, in the world, without the constant one behind it.
ProgramRotation ProgramChain::turned() {
  if (axis_ < 0) return closed_;
  const ProgramRotation open = axis_rotation(axis_, angle_);
  return {rotate(program_, closed_, open[0]), rotate(program_, closed_, open[1]),
          rotate(program_, closed_, open[2])};
}

/// Translations at the end of a sum are along columns of the rotation, which are needed anyway;
/// those before are added up in the frame before the sum, where they are in a plane.
ProgramVector ProgramChain::current_position() {
  const ProgramVector inside = rotate(program_, closed_, open_position_);
  const ProgramVector end = rotate(program_, turned(), end_position_);
  return add(program_, add(program_, position_, inside), end);
}

void ProgramChain::close() {
  position_ = current_position();
  const ProgramRotation rotation = turned();
  for (int axis = 0; axis < 3; ++axis) {
    closed_[static_cast<std::size_t>(axis)] = rotate(program_, rotation, constant_column(axis));
  }
  const Program::Id zero = program_.number(0);
  open_position_ = end_position_ = {zero, zero, zero};
  constant_ = identity_rotation();
  axis_ = -1;
  angle_ = {};
}

/// Adds the translations at the end of the sum to those before, as the sum continues.
void ProgramChain::move_end() {
  const ProgramVector end =
      axis_ < 0 ? end_position_ : rotate(program_, axis_rotation(axis_, angle_), end_position_);
  const Program::Id zero = program_.number(0);
  open_position_ = add(program_, open_position_, end);
  end_position_ = {zero, zero, zero};
}

void ProgramChain::append_rotation(const ElementaryTransform& transform) {
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

void ProgramChain::append_translation(const ElementaryTransform& transform) {
  add_motions(transform);
  const ProgramVector step =
      scale(program_, expression(transform.distance), constant_column(transform.axis));
  end_position_ = add(program_, end_position_, step);
}

/// The motions of a transform for unit rates of the coordinates that it depends on.
void ProgramChain::add_motions(const ElementaryTransform& transform) {
  const auto add_motion = [&](const Symbol& symbol, Program::Id rate) {
    motions_.push_back({symbol.coordinate, transform.rotation, rate,
                        rotate(program_, turned(), constant_column(transform.axis)),
                        current_position()});
  };
  if (transform.rotation) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(transform.symbol)];
    if (symbol.coordinate >= 0) {
      add_motion(symbol, program_.number(transform.multiple * symbol.ratio));
    }
    return;
  }
  for (const int number : variables_of(arm_, transform.distance)) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
    add_motion(symbol, program_.multiply(program_.number(symbol.ratio),
                                         expression(transform.distance.derivative(number))));
  }
}

std::vector<Program::Id> ProgramChain::pose() {
  std::vector<Program::Id> entries;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) entries.push_back(rotation_[column][row]);
    entries.push_back(position_[row]);
  }
  for (const double last : {0, 0, 0, 1}) entries.push_back(program_.number(last));
  return entries;
}

}  // namespace beeline::internal
