#include <algorithm>
#include <cmath>

#include <beeline/formula/expression.h>

namespace beeline {
namespace {

using Multiples = std::vector<std::pair<int, int>>;

/// Adds factor * b to the sorted list a, without entries that cancel.
Multiples sum_of(const Multiples& a, const Multiples& b, int factor) {
  Multiples sum;
  auto left = a.begin();
  auto right = b.begin();
  while (left != a.end() || right != b.end()) {
    if (right == b.end() || (left != a.end() && left->first < right->first)) {
      sum.push_back(*left++);
    } else if (left == a.end() || right->first < left->first) {
      sum.emplace_back(right->first, factor * right->second);
      ++right;
    } else {
      const int multiple = left->second + factor * right->second;
      if (multiple != 0) sum.emplace_back(left->first, multiple);
      ++left;
      ++right;
    }
  }
  return sum;
}

/// A sum of at most two terms, coefficient * trig; the trig of a zero angle is a number.
struct TrigSum {
  std::vector<std::pair<Trig, Coefficient>> terms;

  void add(Angle angle, bool sine, Coefficient coefficient) {
    if (!angle.is_zero() && angle.multiples.front().second < 0) {
      angle = -1 * angle;
      if (sine) coefficient = -coefficient;
    }
    if (angle.is_zero() && sine) return;
    terms.emplace_back(Trig{std::move(angle), sine}, coefficient);
  }
};

/// The product of two cosines or sines of one group as a sum.
TrigSum product(const Trig& a, const Trig& b) {
  const Coefficient half = Coefficient::exactly({1, 0, 0, 0}, 2);
  const Angle sum = a.angle + b.angle, difference = a.angle + -1 * b.angle;
  TrigSum terms;
  if (a.sine == b.sine) {
    terms.add(difference, false, half);
    terms.add(sum, false, a.sine ? -half : half);
  } else {
    terms.add(sum, true, half);
    terms.add(difference, true, a.sine ? half : -half);
  }
  return terms;
}

struct Term {
  Monomial monomial;
  Coefficient coefficient;
};

/// Multiplies each of the terms by a cosine or sine.
std::vector<Term> times(const std::vector<Term>& terms, const Trig& trig) {
  std::vector<Term> products;
  for (const Term& term : terms) {
    const std::vector<Trig>& trigs = term.monomial.trigs;
    const auto place =
        std::lower_bound(trigs.begin(), trigs.end(), trig.angle.group,
                         [](const Trig& other, int group) { return other.angle.group < group; });
    const auto index = place - trigs.begin();
    if (place == trigs.end() || place->angle.group != trig.angle.group) {
      Term grown = term;
      grown.monomial.trigs.insert(grown.monomial.trigs.begin() + index, trig);
      products.push_back(std::move(grown));
      continue;
    }
    for (const auto& [replacement, factor] : product(*place, trig).terms) {
      Term changed = term;
      changed.coefficient = changed.coefficient * factor;
      if (replacement.angle.is_zero()) {
        changed.monomial.trigs.erase(changed.monomial.trigs.begin() + index);
      } else {
        changed.monomial.trigs[static_cast<std::size_t>(index)] = replacement;
      }
      products.push_back(std::move(changed));
    }
  }
  return products;
}

}  // namespace

Angle operator+(const Angle& a, const Angle& b) {
  return {a.is_zero() ? b.group : a.group, sum_of(a.multiples, b.multiples, 1)};
}

Angle operator*(int factor, const Angle& a) {
  Angle product = a;
  for (auto& multiple : product.multiples) multiple.second *= factor;
  if (factor == 0) product.multiples.clear();
  return product;
}

Expression::Expression(const Coefficient& coefficient) { add({}, coefficient); }

Expression Expression::symbol(int number) {
  Expression expression;
  expression.add({.powers = {{number, 1}}}, 1);
  return expression;
}

Expression Expression::cosine(const Angle& angle) {
  if (angle.is_zero()) return 1;
  TrigSum trig;
  trig.add(angle, false, 1);
  Expression expression;
  expression.add({.trigs = {trig.terms.front().first}}, trig.terms.front().second);
  return expression;
}

Expression Expression::sine(const Angle& angle) {
  if (angle.is_zero()) return {};
  TrigSum trig;
  trig.add(angle, true, 1);
  Expression expression;
  expression.add({.trigs = {trig.terms.front().first}}, trig.terms.front().second);
  return expression;
}

void Expression::add(const Monomial& monomial, const Coefficient& coefficient) {
  if (coefficient.is_zero()) return;
  const auto [place, is_new] = terms_.try_emplace(monomial, coefficient);
  if (is_new) return;
  place->second = place->second + coefficient;
  if (place->second.is_zero()) terms_.erase(place);
}

std::size_t Expression::size() const {
  std::size_t symbols = 0;
  for (const auto& [monomial, coefficient] : terms_) {
    std::size_t factors = monomial.powers.size();
    for (const Trig& trig : monomial.trigs) factors += trig.angle.multiples.size();
    symbols += std::max<std::size_t>(factors, 1);
  }
  return symbols;
}

Expression& Expression::operator+=(const Expression& other) {
  if (this == &other) return *this = Expression(2) * *this;
  for (const auto& [monomial, coefficient] : other.terms_) add(monomial, coefficient);
  return *this;
}

Expression operator*(const Expression& a, const Expression& b) {
  Expression result;
  for (const auto& [left, left_coefficient] : a.terms_) {
    for (const auto& [right, right_coefficient] : b.terms_) {
      Term start{left, left_coefficient * right_coefficient};
      start.monomial.powers = sum_of(left.powers, right.powers, 1);
      std::vector<Term> terms{std::move(start)};
      for (const Trig& trig : right.trigs) terms = times(terms, trig);
      for (const Term& term : terms) result.add(term.monomial, term.coefficient);
    }
  }
  return result;
}

Expression Expression::derivative(int symbol) const {
  const auto of_symbol = [symbol](const std::pair<int, int>& entry) {
    return entry.first == symbol;
  };
  Expression result;
  for (const auto& [monomial, coefficient] : terms_) {
    const auto power = std::find_if(monomial.powers.begin(), monomial.powers.end(), of_symbol);
    if (power != monomial.powers.end()) {
      Monomial lower = monomial;
      auto& entry = lower.powers[static_cast<std::size_t>(power - monomial.powers.begin())];
      const Coefficient factor(entry.second);
      if (--entry.second == 0)
        lower.powers.erase(lower.powers.begin() + (power - monomial.powers.begin()));
      result.add(lower, coefficient * factor);
    }
    for (std::size_t i = 0; i < monomial.trigs.size(); ++i) {
      const Multiples& multiples = monomial.trigs[i].angle.multiples;
      const auto multiple = std::find_if(multiples.begin(), multiples.end(), of_symbol);
      if (multiple == multiples.end()) continue;
      Monomial turned = monomial;
      turned.trigs[i].sine = !turned.trigs[i].sine;
      const int sign = monomial.trigs[i].sine ? 1 : -1;
      result.add(turned, coefficient * Coefficient(sign * multiple->second));
    }
  }
  return result;
}

double Expression::value(std::span<const double> symbols) const {
  double sum = 0;
  for (const auto& [monomial, coefficient] : terms_) {
    double term = coefficient.value();
    for (const auto& [symbol, exponent] : monomial.powers) {
      for (int k = 0; k < exponent; ++k) term *= symbols[static_cast<std::size_t>(symbol)];
    }
    for (const Trig& trig : monomial.trigs) {
      double angle = 0;
      for (const auto& [symbol, multiple] : trig.angle.multiples) {
        angle += multiple * symbols[static_cast<std::size_t>(symbol)];
      }
      term *= trig.sine ? std::sin(angle) : std::cos(angle);
    }
    sum += term;
  }
  return sum;
}

}  // namespace beeline
