#include <cmath>
#include <numbers>
#include <optional>

#include <beeline/formula/internal/document_writer.h>
#include <beeline/formula/internal/numbers_inserted.h>
#include <beeline/formula/internal/numeric_twists.h>
#include <beeline/formula/internal/singularity.h>

namespace beeline::internal {
namespace {

/// The zeros of a factor: `angle` has one of the values, which are pi apart, or a displacement has
/// the first value.
struct Zeros {
  Angle angle = {};
  int displacement = -1;
  std::vector<double> values = {};
  std::string text = {};
};

bool is_displacement(const SymbolicArm& arm, int symbol) {
  return arm.symbols[static_cast<std::size_t>(symbol)].kind == SymbolKind::displacement;
}

bool is_joint_angle(const SymbolicArm& arm, const Angle& angle) {
  for (const auto& [symbol, multiple] : angle.multiples) {
    if (arm.symbols[static_cast<std::size_t>(symbol)].coordinate >= 0) return true;
  }
  return false;
}

/// The value of a constant expression.
double constant_value(const SymbolicArm& arm, const Expression& constant) {
  return constant.value(symbol_values(arm, Configuration::Zero(arm.dof)));
}

/// The function A cos + B sin of one angle, with constant A and B.
std::optional<Zeros> trigonometric_zeros(const SymbolicArm& arm, const Expression& factor,
                                         const Notation& notation, bool degrees) {
  Zeros zeros;
  Expression c, s;
  for (const auto& [monomial, coefficient] : factor.terms()) {
    Monomial constant{.powers = monomial.powers};
    const Trig* moving = nullptr;
    for (const auto& [symbol, exponent] : monomial.powers) {
      if (arm.symbols[static_cast<std::size_t>(symbol)].coordinate >= 0) return std::nullopt;
    }
    for (const Trig& trig : monomial.trigs) {
      if (!is_joint_angle(arm, trig.angle)) {
        constant.trigs.push_back(trig);
      } else if (moving != nullptr) {
        return std::nullopt;
      } else {
        moving = &trig;
      }
    }
    if (moving == nullptr || (!zeros.angle.is_zero() && !(zeros.angle == moving->angle))) {
      return std::nullopt;
    }
    zeros.angle = moving->angle;
    (moving->sine ? s : c).add(constant, coefficient);
  }
  const std::string plus_minus = notation.latex() ? "\\pm" : "±";
  const std::string either = notation.latex() ? "\\text{ or }" : " or ";
  const std::string pi = notation.latex() ? "\\pi" : "π";
  const std::string degree = notation.latex() ? "^{\\circ}" : "°";
  const std::string left = notation.angle(zeros.angle) + " = ";
  if (c.is_zero()) {
    zeros.values = {0, std::numbers::pi};
    zeros.text = left + "0" + either + plus_minus + (degrees ? "180" + degree : pi);
  } else if (s.is_zero()) {
    zeros.values = {std::numbers::pi / 2, -std::numbers::pi / 2};
    zeros.text = left + plus_minus + (degrees ? "90" + degree : pi + "/2");
  } else {
    const double angle = std::atan2(-constant_value(arm, c), constant_value(arm, s));
    const double other = angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
    zeros.values = {angle, other};
    const auto rounded = [&](double value) {
      const double shown = std::round((degrees ? in_degrees(value) : value) * 1e6) / 1e6;
      return notation.text(Expression(Coefficient::plain(shown))) + (degrees ? degree : "");
    };
    const std::string rad = notation.latex() ? "\\text{ rad}" : " rad";
    zeros.text = left + rounded(angle) + either + rounded(other) + (degrees ? "" : rad);
  }
  return zeros;
}

/// The function displacement plus constant.
std::optional<Zeros> linear_zeros(const SymbolicArm& arm, const Expression& factor,
                                  const Notation& notation) {
  Zeros zeros;
  Coefficient slope = 0;
  Expression constant;
  for (const auto& [monomial, coefficient] : factor.terms()) {
    const bool single = monomial.trigs.empty() && monomial.powers.size() == 1 &&
                        monomial.powers.front().second == 1;
    if (single && is_displacement(arm, monomial.powers.front().first)) {
      if (zeros.displacement >= 0) return std::nullopt;
      zeros.displacement = monomial.powers.front().first;
      slope = coefficient;
      continue;
    }
    for (const auto& [symbol, exponent] : monomial.powers) {
      if (arm.symbols[static_cast<std::size_t>(symbol)].coordinate >= 0) return std::nullopt;
    }
    for (const Trig& trig : monomial.trigs) {
      if (is_joint_angle(arm, trig.angle)) return std::nullopt;
    }
    constant.add(monomial, coefficient);
  }
  if (zeros.displacement < 0 || !(slope == Coefficient(1) || slope == Coefficient(-1))) {
    return std::nullopt;
  }
  const Expression zero = slope == Coefficient(1) ? -constant : constant;
  zeros.values = {constant_value(arm, zero)};
  zeros.text = notation.symbol(zeros.displacement) + " = " + notation.text(zero);
  return zeros;
}

/// Returns the configuration whose last joint in the angle, or whose displacement, is changed so
/// that the factor is zero.
Configuration at_zero(const SymbolicArm& arm, const Zeros& zeros, double value, Configuration q) {
  if (zeros.displacement >= 0) {
    q[arm.symbols[static_cast<std::size_t>(zeros.displacement)].coordinate] = value;
    return q;
  }
  const std::vector<double> symbols = symbol_values(arm, q);
  double sum = 0;
  int last = -1, last_multiple = 1;
  for (const auto& [symbol, multiple] : zeros.angle.multiples) {
    sum += multiple * symbols[static_cast<std::size_t>(symbol)];
    if (arm.symbols[static_cast<std::size_t>(symbol)].coordinate < 0) continue;
    last = arm.symbols[static_cast<std::size_t>(symbol)].coordinate;
    last_multiple = multiple;
  }
  q[last] += (value - sum) / last_multiple;
  return q;
}

/// The axes of the revolute joints at a configuration, and a point.
struct Axes {
  std::vector<Vector3> directions, points;
  Vector3 origin;

  Axes(const SymbolicArm& arm, const TransformList& list, std::size_t origin_frame,
       const Configuration& q) {
    const std::vector<double> symbols = symbol_values(arm, q);
    const std::vector<Pose> places = place_poses(list, symbols);
    origin = places[list.frames[origin_frame]].translation();
    const Jacobian twists = numeric_twists(arm, list, places, symbols, {});
    for (Eigen::Index k = 0; k < arm.dof; ++k) {
      const Vector3 v = twists.col(k).head<3>(), w = twists.col(k).tail<3>();
      const bool turns = w.norm() > 0.5;
      directions.push_back(turns ? w : Vector3(Vector3::Zero()));
      points.push_back(turns ? w.cross(v) : Vector3(Vector3::Zero()));
    }
  }

  bool parallel(std::size_t i, std::size_t k) const {
    return !directions[i].isZero() && !directions[k].isZero() &&
           directions[i].cross(directions[k]).norm() < 1e-7;
  }
  bool in_line(std::size_t i, std::size_t k) const {
    return parallel(i, k) && (points[k] - points[i]).cross(directions[i]).norm() < 1e-7;
  }
  bool in_plane(std::size_t i, std::size_t j, const Vector3& point) const {
    return parallel(i, j) &&
           std::abs((points[j] - points[i]).cross(point - points[i]).dot(directions[i])) < 1e-7;
  }
  bool in_plane(std::size_t i, std::size_t j, std::size_t k) const {
    return parallel(j, k) && in_plane(i, j, points[k]);
  }
};

/// The relation of axes that holds at all the given configurations, and at none of the others.
template <class Holds>
bool holds_only(const std::vector<Axes>& singular, const std::vector<Axes>& regular, Holds holds) {
  for (const Axes& axes : singular) {
    if (!holds(axes)) return false;
  }
  for (const Axes& axes : regular) {
    if (holds(axes)) return false;
  }
  return true;
}

std::string geometry(const SymbolicArm& arm, const Zeros& zeros,
                     const DeterminantFormula& determinant) {
  const TransformList list = transform_list(arm);
  std::vector<Axes> singular, regular;
  for (const Configuration& q : check_configurations(arm, 4)) {
    regular.emplace_back(arm, list, determinant.origin_frame, q);
    for (const double value : zeros.values) {
      singular.emplace_back(arm, list, determinant.origin_frame, at_zero(arm, zeros, value, q));
    }
  }
  const auto n = static_cast<std::size_t>(arm.dof);
  const auto two = [&](std::size_t i, std::size_t k) {
    return "the axes of joints " + std::to_string(i + 1) + " and " + std::to_string(k + 1);
  };
  const auto pair = [&](auto holds, const auto& sentence) -> std::string {
    for (std::size_t apart = 1; apart < n; ++apart) {
      for (std::size_t i = 0; i + apart < n; ++i) {
        const std::size_t k = i + apart;
        const auto of_pair = [&](const Axes& axes) { return holds(axes, i, k); };
        if (holds_only(singular, regular, of_pair)) return sentence(i, k);
      }
    }
    return "";
  };
  std::string found =
      pair([](const Axes& axes, std::size_t i, std::size_t k) { return axes.in_line(i, k); },
           [&](std::size_t i, std::size_t k) { return two(i, k) + " are in line"; });
  if (!found.empty()) return found;
  found = pair([n](const Axes& axes, std::size_t i,
                   std::size_t k) { return k == i + 1 && k + 1 < n && axes.in_plane(i, k, k + 1); },
               [&](std::size_t i, std::size_t k) {
                 return "the axes of joints " + std::to_string(i + 1) + ", " +
                        std::to_string(k + 1) + " and " + std::to_string(k + 2) +
                        " are in one plane, stretched or folded";
               });
  if (!found.empty()) return found;
  found = pair([](const Axes& axes, std::size_t i,
                  std::size_t k) { return k == i + 1 && axes.in_plane(i, k, axes.origin); },
               [&](std::size_t i, std::size_t k) {
                 return "the origin of " + determinant.origin + " is in the plane of " + two(i, k) +
                        ", stretched or folded";
               });
  if (!found.empty()) return found;
  return pair([](const Axes& axes, std::size_t i, std::size_t k) { return axes.parallel(i, k); },
              [&](std::size_t i, std::size_t k) { return two(i, k) + " are parallel"; });
}

/// A formula between dollar signs, or as it is.
std::string in_text(const std::string& formula, const Notation& notation) {
  return notation.latex() ? '$' + formula + '$' : formula;
}

}  // namespace

std::vector<std::string> singularities(const SymbolicArm& arm,
                                       const DeterminantFormula& determinant,
                                       const FormulaStyle& style) {
  const Notation notation(arm.symbols, style.latex);
  std::vector<std::string> sentences;
  for (const auto& [named, exponent] : determinant.factors) {
    const Expression factor = style.numbers ? with_numbers(named, arm) : named;
    std::optional<Zeros> zeros = trigonometric_zeros(arm, factor, notation, style.degrees);
    if (!zeros || zeros->angle.is_zero()) zeros = linear_zeros(arm, factor, notation);
    std::string sentence = "Singular where " + in_text(notation.text(factor) + " = 0", notation);
    if (zeros) {
      const std::string meaning = geometry(arm, *zeros, determinant);
      if (factor.terms().size() > 1 || zeros->displacement < 0) {
        sentence += ": " + in_text(zeros->text, notation);
      }
      sentence += meaning.empty() ? "" : "; " + meaning;
    }
    sentences.push_back(sentence + ".");
  }
  if (determinant.constant.is_zero()) sentences.emplace_back("Singular at each configuration.");
  if (sentences.empty()) sentences.emplace_back("Singular nowhere.");
  return sentences;
}

}  // namespace beeline::internal
