#include <cmath>
#include <optional>

#include <beeline/formula/internal/numbers_inserted.h>

namespace beeline::internal {
namespace {

/// Returns the cosine or sine with the values of constant angles: cos(a + k) = cos a cos k - sin a
/// sin k.
Expression inserted(const Trig& trig, const SymbolicArm& arm) {
  Angle variable{trig.angle.group, {}};
  double constant = 0;
  for (const auto& [number, multiple] : trig.angle.multiples) {
    const Symbol& symbol = arm.symbols[static_cast<std::size_t>(number)];
    if (symbol.kind == SymbolKind::angle) {
      constant += multiple * symbol.value;
    } else {
      variable.multiples.emplace_back(number, multiple);
    }
  }
  const Expression c = Expression::cosine(variable), s = Expression::sine(variable);
  if (variable.multiples.size() == trig.angle.multiples.size()) return trig.sine ? s : c;
  const Expression ck = Coefficient::plain(std::cos(constant));
  const Expression sk = Coefficient::plain(std::sin(constant));
  return trig.sine ? s * ck + c * sk : c * ck - s * sk;
}

Expression inserted(const Monomial& monomial, const SymbolicArm& arm) {
  Expression product = 1;
  for (const auto& [number, exponent] : monomial.powers) {
    const Symbol& symbol = arm.symbols[static_cast<std::size_t>(number)];
    const Expression factor = symbol.coordinate >= 0 ? Expression::symbol(number)
                                                     : Expression(Coefficient::plain(symbol.value));
    for (int k = 0; k < exponent; ++k) product = product * factor;
  }
  for (const Trig& trig : monomial.trigs) product = product * inserted(trig, arm);
  return product;
}

}  // namespace

Expression with_numbers(const Expression& expression, const SymbolicArm& arm) {
  constexpr double rounding = 1e-15;
  Expression sum, magnitude;
  for (const auto& [monomial, coefficient] : expression.terms()) {
    const Expression term = Expression(coefficient) * inserted(monomial, arm);
    sum += term;
    for (const auto& [factors, number] : term.terms()) {
      magnitude.add(factors, Coefficient::plain(std::abs(number.value())));
    }
  }
  Expression result;
  for (const auto& [factors, number] : sum.terms()) {
    const auto largest = magnitude.terms().find(factors);
    const bool cancels = largest != magnitude.terms().end() &&
                         std::abs(number.value()) < rounding * largest->second.value();
    if (!cancels) result.add(factors, number);
  }
  return result;
}

namespace {

Tree number_tree(double value) { return {.coefficient = Coefficient::plain(value)}; }

/// Returns a product whose numbers are in its coefficient, or a sum whose numbers are one number.
Tree collected(Tree tree) {
  const bool is_sum = tree.kind == Tree::Kind::sum;
  if (!is_sum && tree.kind != Tree::Kind::product) return tree;
  Coefficient number = is_sum ? Coefficient(0) : tree.coefficient;
  std::vector<Tree> rest;
  std::optional<std::size_t> place;  // position of the first number
  for (Tree& part : tree.parts) {
    if (part.kind != Tree::Kind::number) {
      rest.push_back(std::move(part));
      continue;
    }
    number = is_sum ? number + part.coefficient : number * part.coefficient;
    if (!place) place = rest.size();
  }
  if (rest.empty()) return {.coefficient = number};
  if (is_sum && !number.is_zero()) {
    rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(*place), {.coefficient = number});
  }
  if (!is_sum) tree.coefficient = number;
  tree.parts = std::move(rest);
  return tree;
}

}  // namespace

Tree with_numbers(const Tree& tree, const std::vector<Symbol>& symbols) {
  const auto constant = [&symbols](int number) {
    const Symbol& symbol = symbols[static_cast<std::size_t>(number)];
    return symbol.coordinate < 0 && !symbol.meaning.empty();
  };
  if (tree.kind == Tree::Kind::symbol && constant(tree.symbol)) {
    return number_tree(symbols[static_cast<std::size_t>(tree.symbol)].value);
  }
  if (tree.kind == Tree::Kind::trig) {
    double angle = 0;
    for (const auto& [number, multiple] : tree.trig.angle.multiples) {
      if (!constant(number)) return tree;
      angle += multiple * symbols[static_cast<std::size_t>(number)].value;
    }
    return number_tree(tree.trig.sine ? std::sin(angle) : std::cos(angle));
  }
  Tree result = tree;
  for (Tree& part : result.parts) part = with_numbers(part, symbols);
  if (result.kind == Tree::Kind::power && result.parts[0].kind == Tree::Kind::number) {
    return number_tree(std::pow(result.parts[0].coefficient.value(), result.exponent));
  }
  if (result.kind == Tree::Kind::quotient && result.parts[1].kind == Tree::Kind::number) {
    const double factor = 1 / result.parts[1].coefficient.value();
    if (factor == 1) return Tree(result.parts[0]);
  }
  return collected(std::move(result));
}

}  // namespace beeline::internal
