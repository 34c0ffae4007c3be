#include <algorithm>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/numeric_twists.h>
#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_twists.h>

namespace beeline {

ExpressionMatrix jacobian_formula(const SymbolicArm& arm, Frame frame) {
  const internal::TransformList list = internal::transform_list(arm);
  const std::size_t world = 0, tool = list.transforms.size();
  const internal::TwistFrame place{frame == Frame::space ? world : tool,
                                   frame == Frame::tool ? tool : world};
  const std::vector<internal::SymbolicTwist> twists = internal::symbolic_twists(arm, list, place);
  ExpressionMatrix matrix{6, twists.size(), std::vector<Expression>(6 * twists.size())};
  for (std::size_t k = 0; k < twists.size(); ++k) {
    for (std::size_t row = 0; row < 3; ++row) {
      matrix(row, k) = twists[k].linear[row];
      matrix(row + 3, k) = twists[k].angular[row];
    }
  }
  for (const Configuration& q : internal::check_configurations(arm, 2)) {
    const std::vector<double> symbols = symbol_values(arm, q);
    const std::vector<Pose> places = internal::place_poses(list, symbols);
    const Eigen::MatrixXd numbers = matrix.value(symbols);
    const Jacobian expected = internal::numeric_twists(arm, list, places, symbols, place);
    const double ratio = std::max(1.0, expected.bottomRows(3).cwiseAbs().maxCoeff());
    internal::check_formula(arm, numbers.bottomRows(3), expected.bottomRows(3), ratio,
                            "the Jacobian");
    internal::check_formula(arm, numbers.topRows(3), expected.topRows(3),
                            ratio * internal::length_scale(arm), "the Jacobian");
  }
  return matrix;
}

ExpressionMatrix time_derivative(const SymbolicArm& arm, const ExpressionMatrix& matrix) {
  ExpressionMatrix result{matrix.rows, matrix.columns, {}};
  std::size_t size = 0;
  for (const Expression& entry : matrix.entries) {
    Expression sum;
    for (std::size_t i = 0; i < arm.symbols.size(); ++i) {
      const Symbol& symbol = arm.symbols[i];
      if (symbol.coordinate < 0 || symbol.kind == SymbolKind::rate) continue;
      const int rate = arm.rates[static_cast<std::size_t>(symbol.coordinate)];
      sum += Coefficient::plain(symbol.ratio) * Expression::symbol(rate) *
             entry.derivative(static_cast<int>(i));
    }
    size += sum.size();
    internal::check_size(arm, size, "the time derivative");
    result.entries.push_back(std::move(sum));
  }
  return result;
}

}  // namespace beeline
