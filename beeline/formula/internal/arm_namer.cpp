#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/formula/internal/arm_namer.h>
#include <beeline/formula/internal/dimensions.h>

namespace beeline::internal {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// Returns a letter for a rotation. Consecutive rotations have different letters: of roll, pitch
/// and yaw, or of Euler angles.
std::string letter_of(const std::vector<AxisRotation>& rotations, std::size_t i) {
  constexpr const char* letters[] = {"alpha", "beta", "gamma"};
  const bool again = i == 2 && rotations[0].axis == rotations[2].axis;
  return again ? "theta" : letters[rotations[i].axis];
}

bool is_small_integer(double value) {
  return value == std::round(value) && value != 0 && std::abs(value) <= 9;
}

/// Returns the axis of the frame along a unit vector, with its sign; -1 for another vector.
std::pair<int, int> frame_axis(const Vector3& direction, double tolerance) {
  Eigen::Index index = 0;
  direction.cwiseAbs().maxCoeff(&index);
  const int axis = static_cast<int>(index);
  const int sign = direction[axis] < 0 ? -1 : 1;
  const bool along = (direction - sign * Vector3::Unit(axis)).isZero(tolerance);
  return along ? std::pair(axis, sign) : std::pair(-1, 1);
}

Vector3 direction_of(const Joint& joint) {
  return kind(joint) == JointKind::prismatic ? joint.screw.head<3>() : joint.screw.tail<3>();
}

}  // namespace

ArmNamer::ArmNamer(const Arm& arm, const SymbolicOptions& options)
    : source_(arm), unit_(length_unit(arm)) {
  named_.name = arm.name();
  named_.planar = arm.planar();
  named_.dof = arm.dof();
  named_.options = options;
  named_.joint_names = arm.joint_names();
  named_.coordinates.assign(static_cast<std::size_t>(arm.dof()), -1);
}

void ArmNamer::add(ElementaryTransform transform) {
  named_.transforms.back().push_back(std::move(transform));
}

int ArmNamer::symbol(Symbol symbol) {
  while (!names_.insert(symbol.name()).second) symbol.subscript += "_";
  named_.symbols.push_back(std::move(symbol));
  return static_cast<int>(named_.symbols.size()) - 1;
}

int ArmNamer::coordinate_symbol(int coordinate) {
  int& number = named_.coordinates[static_cast<std::size_t>(coordinate)];
  if (number >= 0) return number;
  const Joint& joint = source_.joint_of(coordinate);
  const bool slides = kind(joint) == JointKind::prismatic;
  number = symbol({.kind = slides ? SymbolKind::displacement : SymbolKind::joint_angle,
                   .letter = "q",
                   .subscript = std::to_string(coordinate + 1),
                   .coordinate = coordinate,
                   .meaning = "joint " + joint.name});
  return number;
}

int ArmNamer::mimic_symbol(std::size_t i) {
  const Arm::JointCoupling& coupling = source_.couplings()[i];
  const bool slides = kind(source_.joints()[i]) == JointKind::prismatic;
  coordinate_symbol(coupling.coordinate);
  return symbol({.kind = slides ? SymbolKind::displacement : SymbolKind::joint_angle,
                 .letter = "u",
                 .subscript = std::to_string(i + 1),
                 .value = coupling.shift,
                 .coordinate = coupling.coordinate,
                 .ratio = coupling.ratio,
                 .meaning = "mimic joint " + source_.joints()[i].name});
}

void ArmNamer::rotate(int axis, double angle, const std::string& letter,
                      const std::string& subscript, const std::string& meaning) {
  if (const std::optional<int> exact =
          multiple_of_15_degrees(angle, named_.options.angle_tolerance)) {
    named_.rounding = std::max(named_.rounding, std::abs(angle - *exact * std::numbers::pi / 12));
    if (*exact % 24 != 0) add({.axis = axis, .multiple_of_15_degrees = *exact % 24});
    return;
  }
  add({.axis = axis,
       .symbol = symbol({SymbolKind::angle, letter, subscript, angle, -1, 1, meaning})});
}

Expression ArmNamer::shared_constant(SymbolKind kind, double value, const std::string& letter,
                                     const std::string& subscript, const std::string& meaning) {
  for (std::size_t i = 0; shares_lengths_ && i < named_.symbols.size(); ++i) {
    const Symbol& other = named_.symbols[i];
    if (other.kind != kind || std::abs(other.value) != std::abs(value)) continue;
    return Expression(other.value == value ? 1 : -1) * Expression::symbol(static_cast<int>(i));
  }
  return Expression::symbol(symbol({kind, letter, subscript, value, -1, 1, meaning}));
}

void ArmNamer::translate(int axis, double length, const std::string& letter,
                         const std::string& subscript, const std::string& meaning) {
  if (std::abs(length) <= zero_length * unit_) {
    named_.dropped_length = std::max(named_.dropped_length, std::abs(length));
    return;
  }
  add({.rotation = false,
       .axis = axis,
       .distance = shared_constant(SymbolKind::length, length, letter, subscript, meaning)});
}

void ArmNamer::place(const Pose& pose, const std::string& subscript, int before, int after) {
  for (int axis = 0; axis < 3; ++axis) {
    translate(axis, pose.translation()[axis], axis_names[axis], subscript,
              std::string("offset along ") + axis_names[axis]);
  }
  const std::vector<AxisRotation> rotations =
      axis_rotations(pose.linear(), before, after, named_.options.angle_tolerance);
  const double difference = (product(rotations) - pose.linear()).cwiseAbs().maxCoeff();
  named_.rounding = std::max(named_.rounding, difference);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const int axis = rotations[i].axis;
    rotate(axis, rotations[i].angle, letter_of(rotations, i), subscript,
           std::string("fixed rotation about ") + axis_names[axis]);
  }
}

void ArmNamer::move(std::size_t i, int axis, int sign) {
  const Joint& joint = source_.joints()[i];
  const Arm::JointCoupling& coupling = source_.couplings()[i];
  const std::string index = std::to_string(i + 1);
  const bool plain = is_small_integer(coupling.ratio) && coupling.shift == 0;
  const int variable = plain ? coordinate_symbol(coupling.coordinate) : mimic_symbol(i);
  const int multiple = sign * (plain ? static_cast<int>(coupling.ratio) : 1);
  const Expression coordinate = Expression(multiple) * Expression::symbol(variable);
  if (kind(joint) == JointKind::prismatic) {
    add({.rotation = false, .axis = axis, .distance = coordinate});
    return;
  }
  add({.axis = axis, .symbol = variable, .multiple = multiple});
  if (kind(joint) == JointKind::revolute) return;
  const Expression travel =
      shared_constant(SymbolKind::pitch, pitch(joint), "h", index, "pitch, metres per radian");
  add({.rotation = false, .axis = axis, .distance = travel * coordinate});
}

void ArmNamer::move_about_screw(std::size_t i) {
  const Joint& joint = source_.joints()[i];
  const std::string index = std::to_string(i + 1);
  const Vector3 direction = direction_of(joint);
  const bool slides = kind(joint) == JointKind::prismatic;
  const Vector3 point =
      slides ? Vector3(Vector3::Zero()) : Vector3(direction.cross(joint.screw.head<3>()));
  const auto shift = [&](double factor) {
    for (int axis = 0; axis < 3; ++axis) {
      translate(axis, factor * point[axis], axis_names[axis], index + "a", "point of the axis");
    }
  };
  const bool shared = std::exchange(shares_lengths_, true);
  shift(1);
  const auto [axis, sign] = frame_axis(direction, named_.options.angle_tolerance);
  if (axis >= 0) {
    named_.rounding =
        std::max(named_.rounding, (direction - sign * Vector3::Unit(axis)).cwiseAbs().maxCoeff());
    move(i, axis, sign);
  } else {
    const double yaw = std::atan2(direction.y(), direction.x());
    const double tilt = std::atan2(direction.head<2>().norm(), direction.z());
    const std::size_t begin = named_.transforms.back().size();
    rotate(2, yaw, "psi", index, "azimuth of the joint's axis");
    rotate(1, tilt, "phi", index, "inclination of the joint's axis to z");
    const std::size_t end = named_.transforms.back().size();
    move(i, 2);
    for (std::size_t k = end; k-- > begin;) {  // the inverse of the two transforms
      ElementaryTransform inverse = named_.transforms.back()[k];
      inverse.multiple_of_15_degrees *= -1;
      inverse.multiple *= -1;
      add(inverse);
    }
  }
  shift(-1);
  shares_lengths_ = shared;
}

int ArmNamer::axis_of(std::size_t i) const {
  if (i == 0 || i > source_.joints().size()) return 2;
  const int axis =
      frame_axis(direction_of(source_.joints()[i - 1]), named_.options.angle_tolerance).first;
  return axis < 0 ? 2 : axis;
}

SymbolicArm ArmNamer::finish() {
  for (int k = 0; k < named_.dof; ++k) {
    coordinate_symbol(k);
    named_.rates.push_back(symbol({.kind = SymbolKind::rate,
                                   .letter = "dq",
                                   .subscript = std::to_string(k + 1),
                                   .coordinate = k,
                                   .meaning = "velocity of joint " + source_.joint_of(k).name}));
  }
  return std::move(named_);
}

}  // namespace beeline::internal
