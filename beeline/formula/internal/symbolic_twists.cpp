#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_twists.h>

namespace beeline::internal {
namespace {

/// Ad(transform) or, if `inverse`, its inverse; translations are left out unless `moves_origin`.
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
  Expression c = Coefficient::cosine(transform.fifteenths);
  Expression s = Coefficient::sine(transform.fifteenths);
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
  for (std::size_t place = from; place > to; --place) {
    carry(twist, arm, list.transforms[place - 1], false, moves_origin);
  }
  for (std::size_t place = from; place < to; ++place) {
    carry(twist, arm, list.transforms[place], true, moves_origin);
  }
  check_size(arm, size_of(twist.linear) + size_of(twist.angular), "a column of the Jacobian");
}

}  // namespace

SymbolicTwist own_twist(const SymbolicArm& arm, const ElementaryTransform& transform,
                        int coordinate) {
  SymbolicTwist twist;
  const auto axis = static_cast<std::size_t>(transform.axis);
  const auto ratio = [&](const Symbol& symbol) { return Coefficient::plain(symbol.ratio); };
  if (transform.rotation && transform.symbol >= 0) {
    const Symbol& symbol = arm.symbols[static_cast<std::size_t>(transform.symbol)];
    if (symbol.coordinate == coordinate) {
      twist.angular[axis] = Coefficient(transform.multiple) * ratio(symbol);
    }
  }
  for (std::size_t i = 0; i < arm.symbols.size() && !transform.rotation; ++i) {
    const Symbol& symbol = arm.symbols[i];
    if (symbol.coordinate != coordinate || symbol.kind == SymbolKind::rate) continue;
    twist.linear[axis] +=
        Expression(ratio(symbol)) * transform.distance.derivative(static_cast<int>(i));
  }
  return twist;
}

namespace {

bool is_zero(const SymbolicTwist& twist) {
  return size_of(twist.linear) + size_of(twist.angular) == 0;
}

}  // namespace

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
  for (std::size_t k = 0; k < twists.size(); ++k) {
    for (std::size_t place = 0; place < list.transforms.size(); ++place) {
      SymbolicTwist twist = own_twist(arm, list.transforms[place], static_cast<int>(k));
      if (is_zero(twist)) continue;
      carry(twist, arm, list, place, frame.origin, true);
      carry(twist, arm, list, frame.origin, frame.axes, false);
      twists[k].linear = twists[k].linear + twist.linear;
      twists[k].angular = twists[k].angular + twist.angular;
      total += size_of(twist.linear) + size_of(twist.angular);
      check_size(arm, total, "the Jacobian");
    }
  }
  return twists;
}

}  // namespace beeline::internal
