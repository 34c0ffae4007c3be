#pragma once

#include "formula_fields.h"

namespace beeline::python {

/// What Python's classes Expression and ExpressionMatrix have in common.

/// The Python part: beeline._formulas.
inline nb::module_ formulas() { return nb::module_::import_("beeline._formulas"); }

/// The values of entries at one configuration (n,), or at each of (N, n): an array of the shape
/// `inner`, or (N, *inner).
nb::object values_of(const NamedArm& arm, const std::vector<const Expression*>& entries,
                     std::vector<Index> inner, nb::handle q, nb::handle dq);

void bind_matrices(nb::module_& module);

inline constexpr const char* q_doc = "Configuration (n,), or many (N, n).";
inline constexpr const char* dq_doc = "Joint velocities, of the shape of q; zero without.";

/// What expressions and matrices both have. `matrix_of` gives the entries.
template <class T, class MatrixOf>
void bind_common(nb::class_<T>& bound, const char* sympy_type, MatrixOf matrix_of) {
  bound.def_prop_ro(
      "arm", [](const T& self) { return self.arm; }, getter("arm", "SymbolicArm"),
      "The arm that it is of.");
  Signature code("code", "GeneratedCode",
                 "Returns a function ARM_name(q) as code, with the joint velocities ARM_name(q, "
                 "dq) where they occur.");
  code.takes("self")
      .takes("language", Value<CodeLanguage>::type(), "The language.", "'python'")
      .keywords()
      .takes("name", "str", "Last part of the function's name.", "'formula'")
      .takes("numbers", "bool", "Constants as numbers, not as names.", "False");
  define(
      bound,
      [matrix_of](const T& self, nb::handle language, nb::handle name, nb::handle numbers) {
        return formula_code(
            self.arm->symbolic, matrix_of(self), Value<std::string>::from(name, "name"),
            Value<CodeLanguage>::from(language, "language"), Value<bool>::from(numbers, "numbers"));
      },
      code, nb::arg("language") = "python", nb::kw_only(), nb::arg("name") = "formula",
      nb::arg("numbers") = false);
  Signature lambdify(
      "lambdify", "collections.abc.Callable[..., typing.Any]",
      "Returns a function of q, (n,) or (N, n), and of dq where joint velocities occur: a number, "
      "or an array; (N, ...) for many. It needs numpy alone, and pickles.");
  lambdify.takes("self");
  define(
      bound, [](nb::handle_t<T> self) { return formulas().attr("lambdified")(self); }, lambdify);
  Signature sympy("to_sympy", sympy_type,
                  "Returns it for SymPy, with the symbols' names: sympy.Symbol('q1').");
  sympy.takes("self");
  define(
      bound, [](nb::handle_t<T> self) { return formulas().attr("to_sympy")(self); }, sympy);
  bind_equality(bound, [matrix_of](const T& a, const T& b) {
    const ExpressionMatrix left = matrix_of(a), right = matrix_of(b);
    return left.rows == right.rows && left.columns == right.columns &&
           left.entries == right.entries && same_arm(*a.arm, *b.arm);
  });
}

}  // namespace beeline::python
