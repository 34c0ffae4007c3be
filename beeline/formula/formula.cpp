#include <beeline/formula/formula.h>
#include <beeline/formula/internal/numeric_twists.h>
#include <beeline/formula/internal/symbolic_chain.h>

namespace beeline {
namespace {

/// Returns the pose of frame `to` in frame `from`, see pose_between(), after a comparison with
/// numbers.
ExpressionMatrix pose_matrix(const SymbolicArm& arm, std::size_t from, std::size_t to) {
  const internal::SymbolicPose pose = internal::pose_between(arm, from, to);
  const internal::ExpressionRotation rotation = pose.rotation();
  ExpressionMatrix matrix{4, 4, std::vector<Expression>(16)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      matrix(row, column) = rotation[column][row];
    }
    matrix(row, 3) = pose.position()[row];
  }
  matrix(3, 3) = 1;
  for (const Configuration& q : internal::check_configurations(arm, 2)) {
    const std::vector<double> symbols = symbol_values(arm, q);
    const Pose expected = internal::numeric_pose(arm, from, to, symbols);
    const Eigen::MatrixXd numbers = matrix.value(symbols);
    internal::check_formula(arm, numbers.leftCols(3), expected.matrix().leftCols(3), 1, "a pose");
    internal::check_formula(arm, numbers.rightCols(1), expected.matrix().rightCols(1),
                            internal::length_scale(arm), "a position");
  }
  return matrix;
}

/// Returns cos(sign * angle + k * 15 degrees), or the sine.
Expression turned(const Angle& angle, int sign, int k, bool sine) {
  const Expression c = Expression::cosine(angle), s = Expression(sign) * Expression::sine(angle);
  const Expression c0 = Coefficient::cosine_of_multiple_of_15_degrees(k),
                   s0 = Coefficient::sine_of_multiple_of_15_degrees(k);
  return sine ? s * c0 + c * s0 : c * c0 - s * s0;
}

}  // namespace

Eigen::MatrixXd ExpressionMatrix::value(std::span<const double> symbols) const {
  Eigen::MatrixXd numbers(rows, columns);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      numbers(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          (*this)(row, column).value(symbols);
    }
  }
  return numbers;
}

ExpressionMatrix link_formula(const SymbolicArm& arm, std::size_t i, std::size_t k) {
  if (k > i || i > arm.links()) {
    throw Error("link " + std::to_string(i) + " in link " + std::to_string(k) + " of arm " +
                arm.name + ": links are numbered from 0 to " + std::to_string(arm.links()) +
                ", the second is not above the first");
  }
  return pose_matrix(arm, k + 1, i + 1);
}

ExpressionMatrix tool_formula(const SymbolicArm& arm) {
  return pose_matrix(arm, 0, arm.transforms.size());
}

ExpressionMatrix base_formula(const SymbolicArm& arm) { return pose_matrix(arm, 0, 1); }

ExpressionMatrix tool_offset_formula(const SymbolicArm& arm) {
  return pose_matrix(arm, arm.transforms.size() - 1, arm.transforms.size());
}

std::optional<PlanarAngle> planar_angle(const SymbolicArm& arm) {
  if (!arm.planar) return std::nullopt;
  const internal::ExpressionVector x =
      internal::pose_between(arm, 0, arm.transforms.size()).rotation()[0];
  Angle angle;
  for (const auto& [monomial, coefficient] : x[0].terms()) {
    if (!monomial.trigs.empty()) angle = monomial.trigs.front().angle;
  }
  for (const int sign : {1, -1}) {
    for (int m = -11; m <= 12; ++m) {
      const bool same =
          x[0] == turned(angle, sign, m, false) && x[1] == turned(angle, sign, m, true);
      if (same) return PlanarAngle{sign * angle, m};
    }
  }
  return std::nullopt;
}

}  // namespace beeline
