#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/inverse_steps.h>
#include <beeline/formula/internal/numeric_twists.h>

namespace beeline::internal {
namespace {

/// Adds one elementary transform to a link; returns false if a planar link has no such transform.
bool add_to(PlanarLink& link, const SymbolicArm& arm, const ElementaryTransform& transform) {
  const auto coordinate = [&](int symbol) {
    return arm.symbols[static_cast<std::size_t>(symbol)].coordinate;
  };
  if (!transform.rotation) {
    if (transform.axis != 0) return false;
    const std::vector<int> variables = variables_of(arm, transform.distance);
    if (variables.empty()) {
      link.length += transform.distance;
      return true;
    }
    link.symbol = variables.front();
    link.revolute = false;
    return transform.distance == Expression::symbol(link.symbol);
  }
  if (transform.axis != 2) return false;
  if (transform.symbol < 0) {
    link.multiple_of_15_degrees += transform.multiple_of_15_degrees;
  } else if (coordinate(transform.symbol) < 0) {
    const int group = arm.groups[static_cast<std::size_t>(transform.symbol)];
    link.bend = link.bend + Angle{group, {{transform.symbol, transform.multiple}}};
  } else {
    link.symbol = transform.symbol;
    return transform.multiple == 1;
  }
  return true;
}

double value_of(const Tree& tree, const std::vector<double>& symbols, double branch_sign) {
  const auto number = [](const Coefficient& coefficient) { return coefficient.value(); };
  return evaluated<double>(tree, number, [&](const Tree& leaf) {
    const auto part = [&](std::size_t i) { return value_of(leaf.parts[i], symbols, branch_sign); };
    if (leaf.kind == Tree::Kind::quotient) return part(0) / part(1);
    if (leaf.kind == Tree::Kind::angle) return number(leaf.coefficient) * std::numbers::pi / 12;
    if (leaf.kind == Tree::Kind::arctangent) return std::atan2(part(0), part(1));
    if (leaf.kind == Tree::Kind::signed_root) return branch_sign * std::sqrt(part(0));
    return expression_of(leaf).value(symbols);
  });
}

}  // namespace

Expression PlanarLink::bend_cosine() const {
  return Expression::cosine(bend) *
             Coefficient::cosine_of_multiple_of_15_degrees(multiple_of_15_degrees) -
         Expression::sine(bend) *
             Coefficient::sine_of_multiple_of_15_degrees(multiple_of_15_degrees);
}

Expression PlanarLink::bend_sine() const {
  return Expression::sine(bend) *
             Coefficient::cosine_of_multiple_of_15_degrees(multiple_of_15_degrees) +
         Expression::cosine(bend) *
             Coefficient::sine_of_multiple_of_15_degrees(multiple_of_15_degrees);
}

std::vector<PlanarLink> planar_links(const SymbolicArm& arm) {
  if (arm.convention != NamingConvention::planar || !arm.transforms.front().empty()) return {};
  if (static_cast<std::size_t>(arm.dof) != arm.links()) return {};
  std::vector<PlanarLink> links(arm.links());
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (const ElementaryTransform& transform : arm.transforms[i + 1]) {
      if (!add_to(links[i], arm, transform)) return {};
    }
  }
  for (const ElementaryTransform& transform : arm.transforms.back()) {
    if (transform.rotation || transform.axis != 0) return {};
    links.back().length += transform.distance;
  }
  return links;
}

Tree atan2(Tree y, Tree x) {
  return {.kind = Tree::Kind::arctangent, .parts = {std::move(y), std::move(x)}};
}

Tree positive_first(const Expression& expression) {
  Tree tree = factored(expression);
  if (tree.kind != Tree::Kind::sum) return tree;
  std::stable_partition(tree.parts.begin(), tree.parts.end(),
                        [](const Tree& part) { return !part.coefficient.is_negative(); });
  return tree;
}

Tree branch(const Expression& square) {
  return {.kind = Tree::Kind::signed_root, .parts = {positive_first(square)}};
}

Tree over(const Expression& numerator, const Expression& denominator) {
  const auto& [monomial, coefficient] = *denominator.terms().begin();
  const bool number = denominator.terms().size() == 1 && monomial == Monomial{};
  if (number && coefficient.exact()) {
    for (std::size_t i = 0; i < 4; ++i) {  // the inverse of n sqrt(r) / d is d sqrt(r) / (n r)
      constexpr std::int64_t roots[] = {1, 2, 3, 6};
      const std::int64_t n = coefficient.parts()[i];
      std::array<std::int64_t, 4> parts{};
      parts[i] = n < 0 ? -coefficient.denominator() : coefficient.denominator();
      const Coefficient inverse = Coefficient::exactly(parts, n == 0 ? 1 : std::abs(n) * roots[i]);
      if (coefficient * inverse == Coefficient(1)) return factored(numerator * inverse);
    }
  }
  return {.kind = Tree::Kind::quotient,
          .parts = {positive_first(numerator), factored(denominator)}};
}

Tree sum(std::vector<Tree> parts) {
  std::vector<Tree> flat;
  for (Tree& part : parts) {
    if (part.is_zero()) continue;
    if (part.kind == Tree::Kind::sum) {
      flat.insert(flat.end(), part.parts.begin(), part.parts.end());
    } else {
      flat.push_back(std::move(part));
    }
  }
  parts = std::move(flat);
  if (parts.empty()) return {.coefficient = 0};
  if (parts.size() == 1) return std::move(parts.front());
  return {.kind = Tree::Kind::sum, .parts = std::move(parts)};
}

Tree difference(Tree a, Tree b) {
  if (b.is_zero()) return a;
  if (b.kind == Tree::Kind::product) {
    b.coefficient = -b.coefficient;
  } else {
    b = {.kind = Tree::Kind::product, .coefficient = -1, .parts = {std::move(b)}};
  }
  return sum({std::move(a), std::move(b)});
}

InverseSteps::InverseSteps(const SymbolicArm& arm, bool orientation)
    : derivation_{.symbols = arm.symbols} {
  derivation_.x = add_symbol("x", "");
  derivation_.y = add_symbol("y", "");
  if (orientation) derivation_.theta = add_symbol("theta", "");
}

int InverseSteps::add_symbol(const std::string& letter, const std::string& subscript) {
  derivation_.symbols.push_back({.letter = letter, .subscript = subscript});
  return static_cast<int>(derivation_.symbols.size()) - 1;
}

std::pair<Expression, Expression> InverseSteps::turned(const PlanarLink& link, int sign) const {
  const Expression c = theta_cosine(), s = theta_sine();
  const Expression cb = link.bend_cosine(), sb = Expression(sign) * link.bend_sine();
  return {c * cb - s * sb, s * cb + c * sb};
}

std::pair<Expression, Expression> InverseSteps::in_slide_axes(const PlanarLink& link,
                                                              const Expression& u,
                                                              const Expression& v) {
  const Expression c = link.bend_cosine(), s = link.bend_sine();
  if (c == Expression(1)) return {u, v};
  const Expression along = define("m", "", factored(u * c + v * s),
                                  "Along the first slide and across it the point is at:");
  return {along, define("n", "", factored(v * c - u * s))};
}

Expression InverseSteps::define(const std::string& letter, const std::string& subscript, Tree right,
                                const std::string& explanation) {
  const int symbol = add_symbol(letter, subscript);
  derivation_.steps.push_back({explanation, symbol, std::move(right)});
  return Expression::symbol(symbol);
}

/// Returns the bend of a link, times a sign, in rad.
Tree InverseSteps::bend_of(const PlanarLink& link, int sign) const {
  std::vector<Tree> parts;
  for (const auto& [symbol, multiple] : link.bend.multiples) {
    parts.push_back(factored(Expression(sign * multiple) * Expression::symbol(symbol)));
  }
  if (link.multiple_of_15_degrees != 0) {
    parts.push_back({.kind = Tree::Kind::angle,
                     .coefficient = Coefficient(sign * link.multiple_of_15_degrees)});
  }
  return sum(std::move(parts));
}

void InverseSteps::remark(const std::string& sentence, const std::vector<Expression>& symbols) {
  InverseRemark remark{sentence};
  for (const Expression& symbol : symbols) {
    remark.symbols.push_back(symbol.terms().begin()->first.powers.front().first);
  }
  derivation_.remarks.push_back(std::move(remark));
}

void InverseSteps::define_angle(const PlanarLink& link, Tree right,
                                const std::string& explanation) {
  const Tree bend = bend_of(link, -1);
  derivation_.steps.push_back({explanation, link.symbol, sum({std::move(right), bend})});
}

void InverseSteps::define_slide(const PlanarLink& link, Tree right,
                                const std::string& explanation) {
  derivation_.steps.push_back({explanation, link.symbol, std::move(right)});
}

void InverseSteps::define_last_angle(const std::vector<PlanarLink>& links, std::size_t last,
                                     const std::string& explanation) {
  Expression angle = Expression::symbol(derivation_.theta);
  PlanarLink bends;
  for (std::size_t i = 0; i < links.size(); ++i) {
    bends.multiple_of_15_degrees += links[i].multiple_of_15_degrees;
    bends.bend = bends.bend + links[i].bend;
    if (links[i].revolute && i != last) angle += -Expression::symbol(links[i].symbol);
  }
  std::vector<Tree> parts;
  for (const auto& [monomial, coefficient] : angle.terms()) {
    Expression term;
    term.add(monomial, coefficient);
    const bool is_theta = monomial.powers.front().first == derivation_.theta;
    parts.insert(is_theta ? parts.begin() : parts.end(), factored(term));
  }
  parts.push_back(bend_of(bends, -1));
  derivation_.steps.push_back({explanation, links[last].symbol, sum(std::move(parts))});
}

namespace {

/// Returns the values with lengths near 1 m. The steps hold for any lengths, but rounding is large
/// if they differ by orders of magnitude.
std::vector<double> with_plain_lengths(const SymbolicArm& arm, std::vector<double> values) {
  for (std::size_t i = 0; i < arm.symbols.size(); ++i) {
    if (arm.symbols[i].kind != SymbolKind::length) continue;
    values[i] = std::copysign(0.7 + 0.1 * static_cast<double>(i % 7), values[i]);
  }
  return values;
}

}  // namespace

void check_derivation(const SymbolicArm& arm, const InverseDerivation& derivation) {
  const ExpressionMatrix pose = tool_formula(arm);
  for (const Configuration& q : check_configurations(arm, 8)) {
    const std::vector<double> given = with_plain_lengths(arm, symbol_values(arm, q));
    const Eigen::MatrixXd wanted = pose.value(given);
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> values = given;
      values.resize(derivation.symbols.size());
      values[static_cast<std::size_t>(derivation.x)] = wanted(0, 3);
      values[static_cast<std::size_t>(derivation.y)] = wanted(1, 3);
      if (derivation.theta >= 0) {
        values[static_cast<std::size_t>(derivation.theta)] = std::atan2(wanted(1, 0), wanted(0, 0));
      }
      for (const InverseStep& step : derivation.steps) {
        values[static_cast<std::size_t>(step.symbol)] = value_of(step.right, values, sign);
      }
      values.resize(arm.symbols.size());
      const Eigen::MatrixXd reached = pose.value(values);
      const Eigen::Index first = derivation.theta >= 0 ? 0 : 3;
      const double error =
          (reached - wanted).rightCols(4 - first).cwiseAbs().maxCoeff() / (1 + wanted.norm());
      if (!(error < 1e-7)) {
        throw Error("the derived inverse kinematics of arm " + arm.name +
                    " does not reach the pose it is for; please report this");
      }
    }
  }
}

}  // namespace beeline::internal
