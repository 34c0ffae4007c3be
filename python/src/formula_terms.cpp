#include "formula_fields.h"

namespace beeline::python {
namespace {

Coefficient coefficient_from(nb::handle state) {
  if (nb::len(state) == 1) {
    return Coefficient::plain(Value<double>::from(state[0], "coefficient"));
  }
  std::int64_t parts[5];
  for (int i = 0; i < 5; ++i) parts[i] = Value<std::int64_t>::from(state[i], "coefficient");
  if (parts[4] <= 0) throw Error("the pickled state has a denominator that is not positive");
  return Coefficient::exactly({parts[0], parts[1], parts[2], parts[3]}, parts[4]);
}

std::vector<std::pair<int, int>> pairs_from(const NamedArm& arm, nb::handle state) {
  std::vector<std::pair<int, int>> pairs;
  const auto count = static_cast<std::int64_t>(arm.symbolic.symbols.size());
  for (nb::handle pair : state_tuple(state)) {
    pairs.emplace_back(integer_from(pair[0], "symbol", 0, count - 1),
                       integer_from(pair[1], "exponent", -1'000'000, 1'000'000));
  }
  return pairs;
}

}  // namespace

nb::tuple state_tuple(nb::handle state, std::size_t count) {
  if (!nb::isinstance<nb::tuple>(state) || nb::len(state) < count) {
    throw Error("the pickled state does not belong to a formula");
  }
  return nb::borrow<nb::tuple>(state);
}

nb::tuple terms_of(const Expression& expression) {
  const auto pairs = [](const std::vector<std::pair<int, int>>& given) {
    nb::list list;
    for (const auto& [a, b] : given) list.append(nb::make_tuple(a, b));
    return nb::tuple(list);
  };
  nb::list terms;
  for (const auto& [monomial, coefficient] : expression.terms()) {
    const auto& [a, b, c, d] = coefficient.parts();
    const nb::tuple number = coefficient.exact()
                                 ? nb::make_tuple(a, b, c, d, coefficient.denominator())
                                 : nb::make_tuple(coefficient.value());
    nb::list trigs;
    for (const Trig& trig : monomial.trigs) {
      trigs.append(nb::make_tuple(trig.sine, trig.angle.group, pairs(trig.angle.multiples)));
    }
    terms.append(nb::make_tuple(number, pairs(monomial.powers), nb::tuple(trigs)));
  }
  return nb::tuple(terms);
}

Expression expression_from(const NamedArm& arm, nb::handle terms) {
  Expression expression;
  for (nb::handle item : state_tuple(terms)) {
    const nb::tuple term = state_tuple(item, 3);
    Monomial monomial{.powers = pairs_from(arm, term[1])};
    for (nb::handle trig : state_tuple(nb::object(term[2]))) {
      monomial.trigs.push_back({{Value<int>::from(trig[1], "group"), pairs_from(arm, trig[2])},
                                Value<bool>::from(trig[0], "sine")});
    }
    expression.add(monomial, coefficient_from(term[0]));
  }
  return expression;
}

}  // namespace beeline::python
