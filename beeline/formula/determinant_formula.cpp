#include <algorithm>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/numeric_twists.h>
#include <beeline/formula/internal/symbolic_determinant.h>
#include <beeline/formula/internal/tree.h>

namespace beeline {
namespace {

using internal::BlockForm;
using internal::Pattern;
using internal::TransformList;
using internal::TwistFrame;

/// Returns the frames that leave the determinant unchanged: all frames for the six rows; other
/// points for the rows of the plane, if the arm is planar; other axes for the three rows of the
/// position.
std::vector<TwistFrame> equivalent_frames(const SymbolicArm& arm, const TransformList& list,
                                          const Task& task) {
  const std::size_t world = 0, tool = list.transforms.size();
  const bool spatial = task.rows == Task::spatial().rows;
  const bool any_axes = spatial || task.rows == Task::position().rows;
  const bool any_origin = spatial || (arm.planar && task.rows == Task::planar().rows);
  std::vector<TwistFrame> frames{{tool, task.frame == Frame::tool ? tool : world}};
  for (const std::size_t origin : list.frames) {
    if (!any_origin && origin != tool) continue;
    for (const std::size_t axes : list.frames) {
      if (!any_axes && axes != frames.front().axes) continue;
      frames.push_back({origin, axes});
    }
  }
  return frames;
}

std::vector<int> rows_of(const Task& task) {
  std::vector<int> rows;
  for (int row = 0; row < 6; ++row) {
    if (task.rows[static_cast<std::size_t>(row)]) rows.push_back(row);
  }
  return rows;
}

/// Returns the frame in which the numerical Jacobian has the smallest blocks and the most zeros.
TwistFrame best_frame(const SymbolicArm& arm, const TransformList& list, const Task& task) {
  const std::vector<int> rows = rows_of(task);
  const std::vector<TwistFrame> candidates = equivalent_frames(arm, list, task);
  const auto n = rows.size();
  std::vector<Pattern> patterns(candidates.size(), Pattern(n, std::vector<bool>(n, false)));
  for (const Configuration& q : internal::check_configurations(arm, 3)) {
    const std::vector<double> symbols = symbol_values(arm, q);
    const std::vector<Pose> places = internal::place_poses(list, symbols);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Jacobian columns = internal::numeric_twists(arm, list, places, symbols, candidates[i]);
      for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t k = 0; k < n; ++k) {
          const double entry = columns(rows[row], static_cast<Eigen::Index>(k));
          if (std::abs(entry) > 1e-9) patterns[i][row][k] = true;
        }
      }
    }
  }
  std::size_t best = 0;
  int least = -1;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    int entries = 0;
    for (const std::vector<bool>& row : patterns[i]) {
      entries += static_cast<int>(std::count(row.begin(), row.end(), true));
    }
    const int cost = 100 * internal::block_form(patterns[i]).cost() + entries;
    if (least >= 0 && cost >= least) continue;
    least = cost;
    best = i;
  }
  return candidates[best];
}

ExpressionMatrix square_matrix(const std::vector<internal::SymbolicTwist>& twists,
                               const std::vector<int>& rows) {
  ExpressionMatrix matrix{rows.size(), twists.size(), {}};
  for (const int row : rows) {
    for (const internal::SymbolicTwist& twist : twists) {
      const auto axis = static_cast<std::size_t>(row % 3);
      matrix.entries.push_back(row < 3 ? twist.linear[axis] : twist.angular[axis]);
    }
  }
  return matrix;
}

Pattern pattern_of(const ExpressionMatrix& matrix) {
  Pattern pattern(matrix.rows, std::vector<bool>(matrix.columns));
  for (std::size_t row = 0; row < matrix.rows; ++row) {
    for (std::size_t k = 0; k < matrix.columns; ++k) pattern[row][k] = !matrix(row, k).is_zero();
  }
  return pattern;
}

/// Whether an expression has no joint coordinates.
bool is_constant(const Expression& expression, const SymbolicArm& arm) {
  const auto varies = [&arm](const std::pair<int, int>& entry) {
    return arm.symbols[static_cast<std::size_t>(entry.first)].coordinate >= 0;
  };
  for (const auto& [monomial, coefficient] : expression.terms()) {
    if (std::any_of(monomial.powers.begin(), monomial.powers.end(), varies)) return false;
    for (const Trig& trig : monomial.trigs) {
      if (std::any_of(trig.angle.multiples.begin(), trig.angle.multiples.end(), varies)) {
        return false;
      }
    }
  }
  return true;
}

/// Whether all coefficients are negative.
bool is_negative(const Expression& expression) {
  return std::all_of(expression.terms().begin(), expression.terms().end(),
                     [](const auto& term) { return term.second.is_negative(); });
}

/// Multiplies the determinant by an expression, as a product of its factors.
void multiply(DeterminantFormula& determinant, const SymbolicArm& arm, const internal::Tree& tree) {
  using Kind = internal::Tree::Kind;
  if (tree.kind == Kind::product) {
    determinant.constant = determinant.constant * Expression(tree.coefficient);
    for (const internal::Tree& part : tree.parts) multiply(determinant, arm, part);
    return;
  }
  const bool power = tree.kind == Kind::power;
  Expression factor = internal::expression_of(power ? tree.parts.front() : tree);
  const int exponent = power ? tree.exponent : 1;
  if (is_negative(factor)) {
    factor = -factor;
    determinant.constant = determinant.constant * Expression(exponent % 2 == 0 ? 1 : -1);
  }
  for (int k = 0; k < exponent; ++k) {
    if (is_constant(factor, arm)) {
      determinant.constant = determinant.constant * factor;
      continue;
    }
    const auto known = std::find_if(determinant.factors.begin(), determinant.factors.end(),
                                    [&](const auto& entry) { return entry.first == factor; });
    if (known == determinant.factors.end()) {
      determinant.factors.emplace_back(factor, 1);
    } else {
      ++known->second;
    }
  }
}

/// Returns the number of the frame at this place, see pose_between().
std::size_t frame_number(const TransformList& list, std::size_t place) {
  const auto found = std::find(list.frames.rbegin(), list.frames.rend(), place);
  return static_cast<std::size_t>(list.frames.rend() - found) - 1;
}

std::string frame_name(const TransformList& list, std::size_t place) {
  const std::size_t number = frame_number(list, place);
  if (number + 1 == list.frames.size()) return "the tool";
  return number == 0 ? "the world" : "link " + std::to_string(number - 1);
}

/// Compares the determinant with the determinant of the numerical Jacobian.
void check_determinant(const SymbolicArm& arm, const TransformList& list, const Task& task,
                       const DeterminantFormula& determinant) {
  const TwistFrame frame = equivalent_frames(arm, list, task).front();
  for (const Configuration& q : internal::check_configurations(arm, 3)) {
    const std::vector<double> symbols = symbol_values(arm, q);
    const std::vector<Pose> places = internal::place_poses(list, symbols);
    const Jacobian columns = internal::numeric_twists(arm, list, places, symbols, frame);
    const Eigen::MatrixXd square = columns(rows_of(task), Eigen::seqN(0, columns.cols()));
    // Errors of entries are relative to the lengths: by Hadamard's inequality for columns and rows
    const double lengths = internal::length_scale(arm);
    double scale = 1 + lengths, row_scale = 1;
    for (const auto& column : square.colwise()) scale *= std::max(1.0, column.norm());
    for (const int row : rows_of(task)) {
      row_scale *= std::max(columns.row(row).norm(), row < 3 ? lengths : 1.0);
    }
    scale = std::min(scale, row_scale);
    internal::check_formula(arm, Eigen::MatrixXd::Constant(1, 1, determinant.value(symbols)),
                            Eigen::MatrixXd::Constant(1, 1, square.determinant()), scale,
                            "the determinant");
  }
}

}  // namespace

double DeterminantFormula::value(std::span<const double> symbols) const {
  double product = constant.value(symbols);
  for (const auto& [factor, exponent] : factors) {
    const double number = factor.value(symbols);
    for (int k = 0; k < exponent; ++k) product *= number;
  }
  return product;
}

DeterminantFormula determinant_formula(const SymbolicArm& arm, const Task& task) {
  check_task(task);
  if (task.size() != arm.dof) {
    throw Error("the determinant needs as many rows as joints: the task " + name(task) + " has " +
                std::to_string(task.size()) + ", arm " + arm.name + " " + std::to_string(arm.dof) +
                "; another task may fit");
  }
  const TransformList list = internal::transform_list(arm);
  const TwistFrame frame = best_frame(arm, list, task);
  const ExpressionMatrix matrix =
      square_matrix(internal::symbolic_twists(arm, list, frame), rows_of(task));
  const BlockForm form = internal::block_form(pattern_of(matrix));
  DeterminantFormula determinant{.origin = frame_name(list, frame.origin),
                                 .axes = frame_name(list, frame.axes),
                                 .origin_frame = frame_number(list, frame.origin)};
  determinant.constant = form.blocks.empty() ? 0 : form.sign;
  for (const internal::Block& block : form.blocks) {
    const Expression factor = internal::block_determinant(arm, matrix, block);
    if (factor.is_zero()) {
      determinant.constant = 0;
      determinant.factors.clear();
      return determinant;
    }
    multiply(determinant, arm, internal::factored(factor));
  }
  std::stable_sort(determinant.factors.begin(), determinant.factors.end(),
                   [](const auto& a, const auto& b) {
                     const auto rank = [](const Expression& e) {
                       return std::pair(e.terms().size(), e.terms().begin()->first);
                     };
                     return rank(a.first) < rank(b.first);
                   });
  check_determinant(arm, list, task, determinant);
  return determinant;
}

}  // namespace beeline
