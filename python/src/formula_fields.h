#pragma once

#include <memory>

#include <beeline/formula/document.h>

#include "kinematics_fields.h"

#include <nanobind/stl/shared_ptr.h>

namespace beeline::python {

/// An arm with the names of its dimensions, shared by the formulas that were derived from it.
struct NamedArm {
  Arm arm;
  SymbolicOptions options;
  SymbolicArm symbolic;
};
using SharedArm = std::shared_ptr<NamedArm>;

/// The arm of a SymbolicArm, or of an Arm: then its dimensions are named with default options.
SharedArm named_arm(nb::handle value, const char* name);

/// What Python's classes of these names hold.
struct NamedExpression {
  SharedArm arm;
  Expression value;
};
struct NamedMatrix {
  SharedArm arm;
  ExpressionMatrix value;
};

/// Whether formulas of one are formulas of the other.
bool same_arm(const NamedArm& a, const NamedArm& b);

/// The terms as tuples: (coefficient, powers, trigs), for SymPy and for pickles; and back.
nb::tuple terms_of(const Expression& expression);
Expression expression_from(const NamedArm& arm, nb::handle terms);

/// A tuple of a pickled state. Throws Error unless it is one of at least `count` values.
nb::tuple state_tuple(nb::handle state, std::size_t count = 0);

void bind_expressions(nb::module_& module);
void bind_documents(nb::module_& module);

template <>
inline std::string spelling(CodeLanguage language) {
  constexpr const char* names[] = {"python", "c++", "c"};
  return names[static_cast<int>(language)];
}

template <>
struct Value<std::pair<std::string, std::string>> {
  using Pair = std::pair<std::string, std::string>;
  static std::string type() { return "tuple[str, str]"; }
  static nb::object to(const Pair& value) {
    return nb::make_tuple(Value<std::string>::to(value.first),
                          Value<std::string>::to(value.second));
  }
  static Pair from(nb::handle value, const char* name) {
    if (!nb::isinstance<nb::tuple>(value) || nb::len(value) != 2) {
      raise_type(name, "a tuple of two texts", value);
    }
    return {Value<std::string>::from(value[0], name), Value<std::string>::from(value[1], name)};
  }
  static bool same(const Pair& a, const Pair& b) { return a == b; }
};

template <>
struct Fields<Symbol> : Members<&Symbol::kind, &Symbol::letter, &Symbol::subscript, &Symbol::value,
                                &Symbol::coordinate, &Symbol::ratio, &Symbol::meaning> {};

template <>
struct Fields<SymbolicArm>
    : Members<&SymbolicArm::name, &SymbolicArm::convention, &SymbolicArm::planar, &SymbolicArm::dof,
              &SymbolicArm::symbols, &SymbolicArm::joint_names, &SymbolicArm::rounding,
              &SymbolicArm::deviation, &SymbolicArm::dropped_length> {};

template <>
struct Fields<SymbolicOptions>
    : Members<&SymbolicOptions::angle_tolerance, &SymbolicOptions::max_symbols> {};

template <>
struct Fields<FormulaContent>
    : Members<&FormulaContent::links, &FormulaContent::products, &FormulaContent::tool,
              &FormulaContent::jacobian, &FormulaContent::derivative, &FormulaContent::determinant,
              &FormulaContent::inverse, &FormulaContent::frame> {};

template <>
struct Fields<FormulaStyle> : Members<&FormulaStyle::numbers, &FormulaStyle::degrees> {};

template <>
struct Fields<FormulaDocument> : Members<&FormulaDocument::title, &FormulaDocument::convention,
                                         &FormulaDocument::symbols, &FormulaDocument::abbreviations,
                                         &FormulaDocument::notes, &FormulaDocument::sections> {};

template <>
struct Fields<WrittenFormula>
    : Members<&WrittenFormula::left, &WrittenFormula::cells, &WrittenFormula::row_names,
              &WrittenFormula::cell_names, &WrittenFormula::explanation> {};

template <>
struct Fields<WrittenSection>
    : Members<&WrittenSection::key, &WrittenSection::title, &WrittenSection::remarks,
              &WrittenSection::formulas, &WrittenSection::sentences> {};

template <>
struct Fields<WrittenSymbol>
    : Members<&WrittenSymbol::name, &WrittenSymbol::code_name, &WrittenSymbol::value,
              &WrittenSymbol::unit, &WrittenSymbol::meaning, &WrittenSymbol::formula,
              &WrittenSymbol::joint, &WrittenSymbol::multiplier, &WrittenSymbol::offset> {};

template <>
struct Fields<GeneratedFunction>
    : Members<&GeneratedFunction::name, &GeneratedFunction::purpose,
              &GeneratedFunction::multiplications, &GeneratedFunction::additions,
              &GeneratedFunction::trigonometric> {};

template <>
struct Fields<GeneratedCode> : Members<&GeneratedCode::text, &GeneratedCode::functions> {};

}  // namespace beeline::python
