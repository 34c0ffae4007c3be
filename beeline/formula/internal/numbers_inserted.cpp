#include <cmath>

#include <beeline/formula/internal/numbers_inserted.h>

namespace beeline::internal {
namespace {

/// The cosine or sine with the values of constant angles: cos(a + k) = cos a cos k - sin a sin k.
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

}  // namespace beeline::internal
