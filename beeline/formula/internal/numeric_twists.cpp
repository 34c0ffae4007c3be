#include <cmath>
#include <numbers>
#include <random>

#include <beeline/formula/internal/numeric_twists.h>

namespace beeline::internal {
namespace {

Pose numeric(const ElementaryTransform& transform, std::span<const double> symbols) {
  Pose pose = Pose::Identity();
  const Vector3 axis = Vector3::Unit(transform.axis);
  if (!transform.rotation) {
    pose.translation() = transform.distance.value(symbols) * axis;
    return pose;
  }
  const double angle =
      transform.symbol < 0
          ? transform.multiple_of_15_degrees * std::numbers::pi / 12
          : transform.multiple * symbols[static_cast<std::size_t>(transform.symbol)];
  pose.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return pose;
}

Vector3 numeric(const ExpressionVector& vector, std::span<const double> symbols) {
  return {vector[0].value(symbols), vector[1].value(symbols), vector[2].value(symbols)};
}

}  // namespace

std::vector<Pose> place_poses(const TransformList& list, std::span<const double> symbols) {
  std::vector<Pose> poses{Pose::Identity()};
  for (const ElementaryTransform& transform : list.transforms) {
    poses.push_back(poses.back() * numeric(transform, symbols));
  }
  return poses;
}

Pose numeric_pose(const SymbolicArm& arm, std::size_t from, std::size_t to,
                  std::span<const double> symbols) {
  Pose pose = Pose::Identity();
  for (std::size_t i = from; i < to; ++i) {
    for (const ElementaryTransform& transform : arm.transforms[i]) {
      pose = pose * numeric(transform, symbols);
    }
  }
  return pose;
}

Jacobian numeric_twists(const SymbolicArm& arm, const TransformList& list,
                        const std::vector<Pose>& places, std::span<const double> symbols,
                        const TwistFrame& frame) {
  const Rotation world_to_axes = places[frame.axes].linear().transpose();
  Jacobian columns = Jacobian::Zero(6, arm.dof);
  for (std::size_t place = 0; place < list.transforms.size(); ++place) {
    for (const auto& [k, own] : own_twists(arm, list.transforms[place])) {
      const Pose& pose = places[place];
      const Vector3 w = pose.linear() * numeric(own.angular, symbols);
      const Vector3 offset = places[frame.origin].translation() - pose.translation();
      const Vector3 v = pose.linear() * numeric(own.linear, symbols) + w.cross(offset);
      columns.col(k).head<3>() += world_to_axes * v;
      columns.col(k).tail<3>() += world_to_axes * w;
    }
  }
  return columns;
}

double length_scale(const SymbolicArm& arm) {
  double sum = 0;
  for (const Symbol& symbol : arm.symbols) {
    const bool length = symbol.kind == SymbolKind::length || symbol.kind == SymbolKind::pitch;
    if (length) sum += std::abs(symbol.value);
    if (symbol.kind == SymbolKind::displacement) sum += 1 + std::abs(symbol.value);
  }
  return sum;
}

void check_formula(const SymbolicArm& arm, const Eigen::MatrixXd& formula,
                   const Eigen::MatrixXd& expected, double scale, const std::string& what) {
  const double difference = (formula - expected).cwiseAbs().maxCoeff();
  if (difference <= 1e-9 * scale || !std::isfinite(expected.sum())) return;
  throw Error("the formula of " + what + " of arm " + arm.name + " deviates by " +
              number(difference) + "; please report this");
}

std::vector<Configuration> check_configurations(const SymbolicArm& arm, int count) {
  std::mt19937_64 engine(20240229);
  const auto uniform =
      [&engine](double size) {  // the numbers are the same with each standard library
        return size * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1);
      };
  std::vector<Configuration> configurations;
  for (int i = 0; i < count; ++i) {
    Configuration q(arm.dof);
    for (int k = 0; k < arm.dof; ++k) {
      const auto number = static_cast<std::size_t>(arm.coordinates[static_cast<std::size_t>(k)]);
      q[k] = uniform(arm.symbols[number].kind == SymbolKind::displacement ? 1 : 3);
    }
    configurations.push_back(std::move(q));
  }
  return configurations;
}

}  // namespace beeline::internal
