#include <beeline/kinematics/task.h>

#include "formula_fields.h"
#include "interruption.h"

namespace beeline::python {
namespace {

/// A document, and what it was made of.
struct NamedDocument {
  SharedArm arm;
  FormulaContent content;
  FormulaStyle style;
  FormulaDocument text;

  FormulaDocument in_latex() const {
    FormulaStyle latex = style;
    latex.latex = true;
    return formula_document(arm->symbolic, content, latex);
  }
};

struct NamedDeterminant {
  SharedArm arm;
  Task task;
  DeterminantFormula value;
  WrittenSection text, latex;
};

constexpr const char* task_type = "str | None";
constexpr const char* task_rows_doc = "Its rows. Default: planar for planar arms, else spatial.";

NamedDocument document_of(nb::handle value, nb::handle task, const nb::kwargs& keywords) {
  const SharedArm arm = named_arm(value, "arm");
  auto [content, style] = options<FormulaContent, FormulaStyle>(keywords);
  content.task = task_of(arm->arm, task);
  const LockRelease release;
  return {arm, content, style, formula_document(arm->symbolic, content, style)};
}

nb::object document_again(const NamedDocument& self) {
  nb::dict keywords;
  const auto add = [&](const auto& record) {
    std::apply(
        [&](const auto&... field) {
          ((keywords[field.name] =
                Value<std::decay_t<decltype(record.*field.member)>>::to(record.*field.member)),
           ...);
        },
        Fields<std::decay_t<decltype(record)>>::all());
  };
  add(self.content);
  add(self.style);
  keywords["task"] = Value<Task>::to(self.content.task);
  return nb::make_tuple(nb::module_::import_("beeline._formulas").attr("document_again"),
                        nb::make_tuple(self.arm, keywords));
}

void bind_document(nb::module_& m) {
  nb::class_<NamedDocument> bound(m, "FormulaDocument",
                                  "Formulas of an arm, written as a textbook does.");
  bind_part<FormulaDocument>(
      bound, [](const NamedDocument& self) -> auto& { return self.text; });
  bound.def("__str__", [](const NamedDocument& self) { return text_of(self.text); });
  bound.def("__repr__", [](const NamedDocument& self) { return text_of(self.text); });
  Signature latex("latex", "str", "Returns the document as LaTeX that needs amsmath.");
  latex.takes("self").takes("standalone", "bool", "Add a preamble, so that it compiles by itself.",
                            "False");
  define(
      bound,
      [](const NamedDocument& self, nb::handle standalone) {
        return latex_of(self.in_latex(), Value<bool>::from(standalone, "standalone"));
      },
      latex, nb::arg("standalone") = false);
  bound.def(
      "_repr_markdown_",
      [](const NamedDocument& self) {
        const FormulaDocument document = self.in_latex();
        const auto value = [](const auto& member) {
          return Value<std::decay_t<decltype(member)>>::to(member);
        };
        return nb::module_::import_("beeline._formulas")
            .attr("markdown")(document.title, document.convention, value(document.sections),
                              value(document.symbols), value(document.abbreviations),
                              value(document.notes));
      },
      nb::sig("def _repr_markdown_(self) -> str"));
  bound.def("__reduce__", &document_again, nb::sig("def __reduce__(self) -> tuple[object, ...]"));
  bind_equality(bound, [](const NamedDocument& a, const NamedDocument& b) {
    return text_of(a.text) == text_of(b.text) && same_arm(*a.arm, *b.arm);
  });
  Signature made("formula_document", "FormulaDocument",
                 "Derives and writes formulas: by default the transform of each link and the pose "
                 "of the tool.");
  made.takes("arm", "SymbolicArm | Arm | str", "The arm; an Arm is named with default options.")
      .keywords()
      .takes("task", task_type, task_rows_doc, "None")
      .options<FormulaContent>()
      .options<FormulaStyle>();
  define(m, &document_of, made, nb::arg("arm"), nb::kw_only(), nb::arg("task") = nb::none(),
         nb::arg("options"));
  Signature inverse("has_inverse_formula", "bool",
                    "Whether formula_document(inverse=True) has a derivation for the arm: planar "
                    "arms of two and three joints.");
  inverse.takes("arm", "SymbolicArm | Arm | str", "The arm.");
  define(
      m, [](nb::handle arm) { return has_inverse_formula(named_arm(arm, "arm")->symbolic); },
      inverse, nb::arg("arm"));
}

void bind_code(nb::module_& m) {
  bind_record<GeneratedFunction>(m);
  auto code = bind_record<GeneratedCode>(m);
  code.def("__str__", [](const GeneratedCode& self) { return self.text; });
  Signature made("formula_code", "GeneratedCode",
                 "Generates code of an arm's formulas, each common subexpression computed once: "
                 "functions ARM_forward(q), ARM_jacobian(q), ARM_jacobian_derivative(q, dq) and "
                 "ARM_determinant(q). `code()` of an ExpressionMatrix writes any other.");
  made.takes("arm", "SymbolicArm | Arm | str", "The arm; an Arm is named with default options.")
      .takes("language", Value<CodeLanguage>::type(), "The language.", "'python'")
      .keywords()
      .takes("task", task_type, task_rows_doc, "None")
      .options<FormulaContent>()
      .takes("numbers", "bool", "Constants as numbers, not as names.", "False");
  define(
      m,
      [](nb::handle value, nb::handle language, nb::handle task, nb::handle numbers,
         const nb::kwargs& keywords) {
        const SharedArm arm = named_arm(value, "arm");
        auto content = options<FormulaContent>(keywords);
        content.task = task_of(arm->arm, task);
        const auto in = Value<CodeLanguage>::from(language, "language");
        const bool with_numbers = Value<bool>::from(numbers, "numbers");
        const LockRelease release;
        return formula_code(arm->symbolic, content, in, with_numbers);
      },
      made, nb::arg("arm"), nb::arg("language") = "python", nb::kw_only(),
      nb::arg("task") = nb::none(), nb::arg("numbers") = false, nb::arg("options"));
}

WrittenSection determinant_section(const NamedArm& arm, const Task& task, bool latex) {
  const FormulaContent content{.links = false, .tool = false, .determinant = true, .task = task};
  return formula_document(arm.symbolic, content, {.latex = latex}).sections.front();
}

NamedDeterminant determinant_of(nb::handle value, nb::handle rows) {
  const SharedArm arm = named_arm(value, "arm");
  const Task task = task_of(arm->arm, rows);
  const LockRelease release;
  return {arm, task, determinant_formula(arm->symbolic, task),
          determinant_section(*arm, task, false), determinant_section(*arm, task, true)};
}

std::string equation(const WrittenSection& section) {
  const WrittenFormula& formula = section.formulas.front();
  return formula.left + " = " + formula.cells.front().front();
}

Expression product_of(const DeterminantFormula& determinant) {
  Expression product = determinant.constant;
  for (const auto& [factor, exponent] : determinant.factors) {
    for (int k = 0; k < exponent; ++k) product = product * factor;
  }
  return product;
}

void bind_text(nb::class_<NamedDeterminant>& bound) {
  const auto printed = [](const NamedDeterminant& self) {
    std::string text = equation(self.text);
    for (const std::string& sentence : self.text.sentences) text += "\n" + sentence;
    return text;
  };
  bound.def("__str__", printed);
  bound.def("__repr__", printed);
  bound.def_prop_ro(
      "latex", [](const NamedDeterminant& self) { return equation(self.latex); },
      "The equation as LaTeX, for mathematics mode.");
  bound.def("_repr_latex_", [](const NamedDeterminant& self) {
    return "$\\displaystyle " + equation(self.latex) + "$";
  });
}

void bind_determinant(nb::module_& m) {
  nb::class_<NamedDeterminant> bound(
      m, "DeterminantFormula",
      "The determinant of a square Jacobian: a constant times powers of factors.");
  bound.def_prop_ro(
      "constant",
      [](const NamedDeterminant& self) {
        return NamedExpression{self.arm, self.value.constant};
      },
      "Without joint coordinates.");
  bound.def_prop_ro(
      "factors",
      [](const NamedDeterminant& self) {
        nb::list list;
        for (const auto& [factor, exponent] : self.value.factors) {
          list.append(nb::make_tuple(NamedExpression{self.arm, factor}, exponent));
        }
        return list;
      },
      getter("factors", "list[tuple[Expression, int]]"), "Factors with their exponents.");
  bound.def_prop_ro(
      "expression",
      [](const NamedDeterminant& self) {
        return NamedExpression{self.arm, product_of(self.value)};
      },
      "The product, multiplied out.");
  bound.def_prop_ro(
      "origin", [](const NamedDeterminant& self) { return self.value.origin; },
      "The frame of whose origin the Jacobian was expanded.");
  bound.def_prop_ro(
      "axes", [](const NamedDeterminant& self) { return self.value.axes; },
      "The frame in whose axes it was expanded. The determinant is the same for all.");
  bound.def_prop_ro(
      "singularities",
      [](const NamedDeterminant& self) {
        return Value<std::vector<std::string>>::to(self.text.sentences);
      },
      getter("singularities", "list[str]"), "Where it is zero, in sentences.");
  bind_text(bound);
  bound.def(
      "__reduce__",
      [](const NamedDeterminant& self) {
        return nb::make_tuple(nb::module_::import_("beeline._formulas").attr("determinant_again"),
                              nb::make_tuple(self.arm, Value<Task>::to(self.task)));
      },
      nb::sig("def __reduce__(self) -> tuple[object, ...]"));
  bind_equality(bound, [](const NamedDeterminant& a, const NamedDeterminant& b) {
    return a.value.constant == b.value.constant && a.value.factors == b.value.factors &&
           same_arm(*a.arm, *b.arm);
  });
  Signature made("determinant_formula", "DeterminantFormula",
                 "Returns the determinant of the task's Jacobian, which has as many rows as the "
                 "arm has joints.");
  made.takes("arm", "SymbolicArm | Arm | str", "The arm; an Arm is named with default options.")
      .takes("task", task_type, task_rows_doc, "None");
  define(m, &determinant_of, made, nb::arg("arm"), nb::arg("task") = nb::none());
}

}  // namespace

void bind_documents(nb::module_& m) {
  bind_record<WrittenSymbol>(m);
  bind_record<WrittenFormula>(m);
  bind_record<WrittenSection>(m);
  bind_document(m);
  bind_code(m);
  bind_determinant(m);
}

}  // namespace beeline::python
