#include <algorithm>

#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_twists.h>

namespace beeline::internal {
namespace {

/// Returns Ad(transform) or, if `inverse`, its inverse; translations are omitted unless
/// `moves_origin`.
void carry(SymbolicTwist& twist, const SymbolicArm& arm, const ElementaryTransform& transform,
           bool inverse, bool moves_origin) {
  if (!transform.rotation) {
    if (!moves_origin) return;
    ExpressionVector step{};
    step[static_cast<std::size_t>(transform.axis)] =
        inverse ? -transform.distance : transform.distance;
    twist.linear = twist.linear + cross(step, twist.angular);
    return;
  }
  Expression c = Coefficient::cosine_of_multiple_of_15_degrees(transform.multiple_of_15_degrees);
  Expression s = Coefficient::sine_of_multiple_of_15_degrees(transform.multiple_of_15_degrees);
  if (transform.symbol >= 0) {
    const int group = arm.groups[static_cast<std::size_t>(transform.symbol)];
    const Angle angle{group, {{transform.symbol, transform.multiple}}};
    c = Expression::cosine(angle);
    s = Expression::sine(angle);
  }
  const ExpressionRotation rotation = axis_rotation(transform.axis, c, inverse ? -s : s);
  twist.linear = rotation * twist.linear;
  twist.angular = rotation * twist.angular;
}

void carry(SymbolicTwist& twist, const SymbolicArm& arm, const TransformList& list,
           std::size_t from, std::size_t to, bool moves_origin) {
  const auto step = [&](std::size_t place, bool inverse) {
    carry(twist, arm, list.transforms[place], inverse, moves_origin);
    check_size(arm, size_of(twist.linear) + size_of(twist.angular), "a column of the Jacobian");
  };
  for (std::size_t place = from; place > to; --place) step(place - 1, false);
  for (std::size_t place = from; place < to; ++place) step(place, true);
}

}  // namespace

std::vector<int> variables_of(const SymbolicArm& arm, const Expression& distance) {
  std::vector<int> variables;
  for (const auto& [monomial, coefficient] : distance.terms()) {
    for (const auto& [symbol, exponent] : monomial.powers) {
      const bool varies = arm.symbols[static_cast<std::size_t>(symbol)].coordinate >= 0;
      const bool known = std::find(variables.begin(), variables.end(), symbol) != variables.end();
      if (varies && !known) variables.push_back(symbol);
    }
  }
  return variables;
}

std::vector<OwnTwist> own_twists(const SymbolicArm& arm, const ElementaryTransform& transform) {
  std::vector<OwnTwist> twists;
  const auto axis = static_cast<std::size_t>(transform.axis);
  if (!transform.rotation) {
    for (const int number : variables_of(arm, transform.distance)) {
      const Symbol& symbol = arm.symbols[static_cast<std::size_t>(number)];
      twists.push_back({.coordinate = symbol.coordinate});
      twists.back().twist.linear[axis] =
          Expression(Coefficient::plain(symbol.ratio)) * transform.distance.derivative(number);
    }
  } else if (transform.symbol >= 0) {
    const Symbol& symbol = arm.symbols[static_cast<std::size_t>(transform.symbol)];
    if (symbol.coordinate < 0) return {};
    twists.push_back({.coordinate = symbol.coordinate});
    twists.back().twist.angular[axis] =
        Coefficient(transform.multiple) * Coefficient::plain(symbol.ratio);
  }
  return twists;
}

TransformList transform_list(const SymbolicArm& arm) {
  TransformList list;
  for (const auto& transforms : arm.transforms) {
    list.frames.push_back(list.transforms.size());
    list.transforms.insert(list.transforms.end(), transforms.begin(), transforms.end());
  }
  list.frames.push_back(list.transforms.size());
  return list;
}

std::vector<SymbolicTwist> symbolic_twists(const SymbolicArm& arm, const TransformList& list,
                                           const TwistFrame& frame) {
  std::vector<SymbolicTwist> twists(static_cast<std::size_t>(arm.dof));
  std::size_t total = 0;
  for (std::size_t place = 0; place < list.transforms.size(); ++place) {
    for (OwnTwist& own : own_twists(arm, list.transforms[place])) {
      carry(own.twist, arm, list, place, frame.origin, true);
      carry(own.twist, arm, list, frame.origin, frame.axes, false);
      SymbolicTwist& sum = twists[static_cast<std::size_t>(own.coordinate)];
      sum.linear = sum.linear + own.twist.linear;
      sum.angular = sum.angular + own.twist.angular;
      total += size_of(own.twist.linear) + size_of(own.twist.angular);
      check_size(arm, total, "the Jacobian");
    }
  }
  return twists;
}

}  // namespace beeline::internal
