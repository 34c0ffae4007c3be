#include "formula_entries.h"

namespace beeline::python {
namespace {

int symbol_number(const NamedArm& arm, nb::handle value) {
  const std::string name = Value<std::string>::from(value, "symbol");
  std::vector<std::string> names;
  for (const Symbol& symbol : arm.symbolic.symbols) {
    names.push_back(symbol.name());
    if (names.back() == name) return static_cast<int>(names.size()) - 1;
  }
  throw unknown_name("symbol", name, names);
}

/// An operand: an expression of the same arm, or a number.
Expression operand(const NamedExpression& self, nb::handle value) {
  const NamedExpression* other = nullptr;
  if (nb::try_cast<const NamedExpression*>(value, other) && other) {
    if (!same_arm(*self.arm, *other->arm)) {
      throw Error("the expressions are of different arms: " + self.arm->symbolic.name + " and " +
                  other->arm->symbolic.name);
    }
    return other->value;
  }
  if (PyLong_Check(value.ptr()))
    return Expression(Coefficient(Value<std::int64_t>::from(value, "operand")));
  const double number = Value<double>::from(value, "operand");
  if (!std::isfinite(number)) throw Error("an operand is not finite");
  return Expression(Coefficient::plain(number));
}

ExpressionMatrix matrix_of_one(const NamedExpression& self) { return {1, 1, {self.value}}; }

std::string latex_of(const NamedArm& arm, const Expression& expression) {
  return written(expression, arm.symbolic, {.latex = true});
}

void bind_arithmetic(nb::class_<NamedExpression>& bound) {
  const auto operation = [&](const char* name, auto compute) {
    bound.def(
        name,
        [compute](const NamedExpression& self, nb::handle other) {
          return NamedExpression{self.arm, compute(self.value, operand(self, other))};
        },
        nb::sig(kept_text("def " + std::string(name) +
                          "(self, other: Expression | float, /) -> Expression")));
  };
  using E = Expression;
  operation("__add__", [](const E& a, const E& b) { return a + b; });
  operation("__radd__", [](const E& a, const E& b) { return a + b; });
  operation("__sub__", [](const E& a, const E& b) { return a - b; });
  operation("__rsub__", [](const E& a, const E& b) { return b - a; });
  operation("__mul__", [](const E& a, const E& b) { return a * b; });
  operation("__rmul__", [](const E& a, const E& b) { return a * b; });
  bound.def("__neg__", [](const NamedExpression& self) {
    return NamedExpression{self.arm, -self.value};
  });
  bound.def(
      "__bool__", [](const NamedExpression& self) { return !self.value.is_zero(); },
      "False for zero.");
}

void bind_expression(nb::module_& m) {
  nb::class_<NamedExpression> bound(
      m, "Expression",
      "A polynomial in the symbols of an arm and in cosines and sines of their sums. Two "
      "expressions are equal exactly if they are the same function.");
  bind_common(bound, "typing.Any", &matrix_of_one);
  bind_arithmetic(bound);
  bound.def("__str__",
            [](const NamedExpression& self) { return written(self.value, self.arm->symbolic); });
  bound.def("__repr__",
            [](const NamedExpression& self) { return written(self.value, self.arm->symbolic); });
  bound.def_prop_ro(
      "latex", [](const NamedExpression& self) { return latex_of(*self.arm, self.value); },
      "The expression as LaTeX, for mathematics mode.");
  bound.def("_repr_latex_", [](const NamedExpression& self) {
    return "$\\displaystyle " + latex_of(*self.arm, self.value) + "$";
  });
  bound.def(
      "terms", [](const NamedExpression& self) { return terms_of(self.value); },
      nb::sig("def terms(self) -> tuple[typing.Any, ...]"),
      "Returns the terms, for other libraries: tuples (coefficient, powers, trigs). A coefficient "
      "is (a, b, c, d, e) for (a + b sqrt(2) + c sqrt(3) + d sqrt(6)) / e, or (number,); powers "
      "are (symbol, exponent); trigs (is_sine, group, ((symbol, multiple), ...)), the sine or "
      "cosine of the sum of multiples. Symbols are indices of `arm.symbols`.");
  Signature derivative("derivative", "Expression", "Returns the partial derivative.");
  derivative.takes("self").takes("symbol", "str", "Name of a symbol, such as q1 or a2.");
  define(
      bound,
      [](const NamedExpression& self, nb::handle symbol) {
        return NamedExpression{self.arm, self.value.derivative(symbol_number(*self.arm, symbol))};
      },
      derivative, nb::arg("symbol"));
  Signature value("value", std::string(array_type) + " | float", "Returns the value, or (N,).");
  value.takes("self")
      .takes("q", array_like, q_doc)
      .takes("dq", std::string(array_like) + " | None", dq_doc, "None");
  define(
      bound,
      [](const NamedExpression& self, nb::handle q, nb::handle dq) {
        nb::object values = values_of(*self.arm, {&self.value}, {}, q, dq);
        return values.attr("shape").equal(nb::make_tuple()) ? nb::object(values.attr("item")())
                                                            : values;
      },
      value, nb::arg("q"), nb::arg("dq") = nb::none());
  bound.def(
      "__getstate__",
      [](const NamedExpression& self) { return nb::make_tuple(self.arm, terms_of(self.value)); },
      nb::sig("def __getstate__(self) -> tuple[object, ...]"));
  bound.def(
      "__setstate__",
      [](NamedExpression& self, const nb::tuple& given) {
        const nb::tuple state = state_tuple(given, 2);
        const SharedArm arm = named_arm(state[0], "pickle");
        new (&self) NamedExpression{arm, expression_from(*arm, state[1])};
      },
      nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
}

}  // namespace

void bind_expressions(nb::module_& m) {
  bind_expression(m);
  bind_matrices(m);
}

}  // namespace beeline::python
