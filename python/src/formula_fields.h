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
inline std::vector<SymbolKind> choices() {
  return {SymbolKind::length, SymbolKind::angle, SymbolKind::joint_angle, SymbolKind::displacement,
          SymbolKind::rate};
}
template <>
inline std::string spelling(SymbolKind kind) {
  constexpr const char* names[] = {"length", "angle", "joint_angle", "displacement", "rate"};
  return names[static_cast<int>(kind)];
}

template <>
inline std::vector<NamingConvention> choices() {
  return {NamingConvention::planar, NamingConvention::standard, NamingConvention::modified,
          NamingConvention::offsets};
}
template <>
inline std::string spelling(NamingConvention convention) {
  constexpr const char* names[] = {"planar", "standard", "modified", "offsets"};
  return names[static_cast<int>(convention)];
}

template <>
inline std::vector<CodeLanguage> choices() {
  return {CodeLanguage::python, CodeLanguage::cpp, CodeLanguage::c};
}
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
struct Fields<Symbol> {
  static constexpr const char* name = "Symbol";
  static constexpr const char* doc = "A named quantity of a formula, such as the length a2.";
  static constexpr auto all() {
    return std::tuple(
        field("kind", &Symbol::kind, "What it is."),
        field("letter", &Symbol::letter, "Such as a, alpha, q."),
        field("subscript", &Symbol::subscript, "Such as 2, t."),
        field("value", &Symbol::value, "Of a constant, m or rad; of a variable the shift."),
        field("coordinate", &Symbol::coordinate,
              "Of a variable: index in the configuration; -1 of a constant."),
        field("ratio", &Symbol::ratio,
              "A variable is ratio * q[coordinate] + value: 1 and 0 except for mimic joints."),
        field("meaning", &Symbol::meaning, "In words."));
  }
};

template <>
struct Fields<SymbolicOptions> {
  static constexpr auto all() {
    return std::tuple(
        field("angle_tolerance", &SymbolicOptions::angle_tolerance,
              "Constant angles within this distance (rad) of a multiple of 15 degrees are exact."),
        field("max_symbols", &SymbolicOptions::max_symbols,
              "Error is raised for a matrix with more symbols in total."));
  }
};

template <>
struct Fields<FormulaContent> {
  static constexpr auto all() {
    using Content = FormulaContent;
    return std::tuple(
        field("links", &Content::links, "The transform of each link."),
        field("products", &Content::products, "The pose of each link in the base."),
        field("tool", &Content::tool, "The pose of the tool."),
        field("jacobian", &Content::jacobian, "The rows of the task, in its frame."),
        field("derivative", &Content::derivative, "The time derivative of the Jacobian."),
        field("determinant", &Content::determinant,
              "Of the rows of the task, with the singularities that it shows."),
        field("inverse", &Content::inverse, "Inverse kinematics of a planar arm in steps."),
        field("frame", &Content::frame, "Of the Jacobian."));
  }
};

template <>
struct Fields<FormulaStyle> {
  static constexpr auto all() {
    return std::tuple(
        field("numbers", &FormulaStyle::numbers, "Constants as numbers, not as symbols."),
        field("degrees", &FormulaStyle::degrees, "Values of angles in degrees."));
  }
};

template <>
struct Fields<WrittenFormula> {
  static constexpr const char* name = "WrittenFormula";
  static constexpr const char* doc = "A written formula: `left` equals a matrix of cells, or one.";
  static constexpr auto all() {
    using Formula = WrittenFormula;
    return std::tuple(field("left", &Formula::left, "Left of the equals sign."),
                      field("cells", &Formula::cells, "Rows of cells."),
                      field("row_names", &Formula::row_names, "Of the rows of a Jacobian."),
                      field("cell_names", &Formula::cell_names,
                            "Of the cells of a matrix that is too wide to be printed as such."),
                      field("explanation", &Formula::explanation, "A sentence in front of it."));
  }
};

template <>
struct Fields<WrittenSection> {
  static constexpr const char* name = "WrittenSection";
  static constexpr const char* doc = "A part of a FormulaDocument.";
  static constexpr auto all() {
    using Written = WrittenSection;
    return std::tuple(field("key", &Written::key, "Such as jacobian."),
                      field("title", &Written::title, "Title."),
                      field("remarks", &Written::remarks, "Sentences below the title."),
                      field("formulas", &Written::formulas, "Formulas."),
                      field("sentences", &Written::sentences, "Sentences behind the formulas."));
  }
};

template <>
struct Fields<WrittenSymbol> {
  static constexpr const char* name = "WrittenSymbol";
  static constexpr const char* doc = "A symbol that occurs in a FormulaDocument.";
  static constexpr auto all() {
    using Written = WrittenSymbol;
    return std::tuple(field("name", &Written::name, "As it is written."),
                      field("code_name", &Written::code_name, "In generated code."),
                      field("value", &Written::value, "Of a constant."),
                      field("unit", &Written::unit, "Unit."),
                      field("meaning", &Written::meaning, "In words."),
                      field("formula", &Written::formula, "Of the variable of a mimic joint."),
                      field("joint", &Written::joint, "That it follows,"),
                      field("multiplier", &Written::multiplier, "with this factor,"),
                      field("offset", &Written::offset, "and this offset."));
  }
};

template <>
struct Fields<GeneratedFunction> {
  static constexpr const char* name = "GeneratedFunction";
  static constexpr const char* doc = "A function of generated code and its operations.";
  static constexpr auto all() {
    using Function = GeneratedFunction;
    return std::tuple(field("name", &Function::name, "Name."),
                      field("purpose", &Function::purpose, "What it computes."),
                      field("multiplications", &Function::multiplications, "Their number."),
                      field("additions", &Function::additions, "Their number."),
                      field("trigonometric", &Function::trigonometric, "Cosines and sines."));
  }
};

template <>
struct Fields<GeneratedCode> {
  static constexpr const char* name = "GeneratedCode";
  static constexpr const char* doc =
      "A file of code, which needs the language's mathematics alone.";
  static constexpr auto all() {
    return std::tuple(field("text", &GeneratedCode::text, "The file."),
                      field("functions", &GeneratedCode::functions, "Its functions."));
  }
};

}  // namespace beeline::python
