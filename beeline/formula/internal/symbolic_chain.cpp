#include <algorithm>
#include <numeric>

#include <beeline/formula/internal/symbolic_chain.h>

namespace beeline::internal {
namespace {

/// Disjoint sets of symbols.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
    return i;
  }
  void unite(int i, int k) {
    const auto [first, second] = std::minmax({find(i), find(k)});
    parent_[static_cast<std::size_t>(second)] = first;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

ExpressionRotation exact_rotation(int axis, int k) {
  return axis_rotation<Expression>(axis, Coefficient::cosine_of_multiple_of_15_degrees(k),
                                   Coefficient::sine_of_multiple_of_15_degrees(k));
}

int sign_along(const ExpressionVector& v, int axis) {
  const auto along = static_cast<std::size_t>(axis);
  if (!v[(along + 1) % 3].is_zero() || !v[(along + 2) % 3].is_zero()) return 0;
  return v[along] == Expression(1) ? 1 : v[along] == Expression(-1) ? -1 : 0;
}

void SymbolicPose::append(const ElementaryTransform& transform) {
  if (!transform.rotation) {
    ExpressionVector step =
        transform.distance * constant_[static_cast<std::size_t>(transform.axis)];
    if (axis_ >= 0) {
      step = axis_rotation(axis_, Expression::cosine(angle_), Expression::sine(angle_)) * step;
    }
    position_ = position_ + closed_ * step;
  } else if (transform.symbol < 0) {
    constant_ = constant_ * exact_rotation(transform.axis, transform.multiple_of_15_degrees);
  } else {
    rotate(transform.axis, transform.symbol, transform.multiple);
  }
}

void SymbolicPose::rotate(int axis, int symbol, int multiple) {
  const Angle angle{arm_->groups[static_cast<std::size_t>(symbol)], {{symbol, multiple}}};
  const int sign = axis_ < 0 ? 0 : sign_along(constant_[static_cast<std::size_t>(axis)], axis_);
  if (sign != 0) {
    angle_ = angle_ + sign * angle;
    return;
  }
  closed_ = rotation();
  constant_ = identity_rotation();
  axis_ = axis;
  angle_ = angle;
}

ExpressionRotation SymbolicPose::rotation() const {
  if (axis_ < 0) return closed_ * constant_;
  const ExpressionRotation open =
      axis_rotation(axis_, Expression::cosine(angle_), Expression::sine(angle_));
  return closed_ * (open * constant_);
}

SymbolicPose pose_between(const SymbolicArm& arm, std::size_t from, std::size_t to) {
  SymbolicPose pose(arm);
  for (std::size_t i = from; i < to; ++i) {
    const std::string rotation =
        "the rotation up to joint " + std::to_string(i) + " of " + std::to_string(arm.links());
    for (const ElementaryTransform& transform : arm.transforms[i]) {
      pose.append(transform);
      check_size(arm, size_of(pose.position()), "the position");
      check_size(arm, size_of(pose.closed()), rotation);
    }
    check_size(arm, size_of(pose.rotation()), rotation);
  }
  return pose;
}

void assign_groups(SymbolicArm& arm) {
  const std::size_t count = arm.symbols.size();
  Sets sets(count);
  ExpressionRotation constant = identity_rotation();
  int axis = -1, last = -1;
  for (const auto& transforms : arm.transforms) {
    for (const ElementaryTransform& transform : transforms) {
      if (!transform.rotation) continue;
      if (transform.symbol < 0) {
        constant = constant * exact_rotation(transform.axis, transform.multiple_of_15_degrees);
        continue;
      }
      const auto about = static_cast<std::size_t>(transform.axis);
      if (last >= 0 && sign_along(constant[about], axis) != 0) {
        sets.unite(last, transform.symbol);
      } else {
        constant = identity_rotation();
        axis = transform.axis;
      }
      last = transform.symbol;
    }
  }
  arm.groups.clear();
  for (std::size_t i = 0; i < count; ++i) arm.groups.push_back(sets.find(static_cast<int>(i)));
}

std::size_t size_of(const ExpressionVector& vector) {
  return vector[0].size() + vector[1].size() + vector[2].size();
}

std::size_t size_of(const ExpressionRotation& rotation) {
  return size_of(rotation[0]) + size_of(rotation[1]) + size_of(rotation[2]);
}

void check_size(const SymbolicArm& arm, std::size_t symbols, const std::string& what) {
  if (symbols <= arm.options.max_symbols) return;
  throw Error(
      "the formula of arm " + arm.name + " is too large: " + what + " has " +
      std::to_string(symbols) + " symbols, more than " + std::to_string(arm.options.max_symbols) +
      "; the transforms of the links are shorter (links, --of links), generated code grows with "
      "the "
      "number of joints only (code, --as python), and a larger angle tolerance (angle_tolerance, "
      "--angle-tolerance) takes more angles as exact");
}

}  // namespace beeline::internal
