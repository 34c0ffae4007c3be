// Formulas: eq. 1.2 and 1.7 of the chapter in symbols, the determinant of a UR5, and code for it.
#include <iostream>

#include <beeline/formula/document.h>
#include <beeline/model/catalog.h>

int main() {
  const beeline::SymbolicArm rrr = beeline::symbolic_arm(beeline::built_in("rrr"));
  const beeline::ExpressionMatrix tool = tool_formula(rrr);
  const beeline::ExpressionMatrix columns = jacobian_formula(rrr);
  std::cout << "x       = " << written(tool(0, 3), rrr) << '\n'
            << "dx/dq1  = " << written(columns(0, 0), rrr) << '\n';

  // Expressions are polynomials: they can be differentiated, compared and evaluated.
  const beeline::Expression derivative = tool(0, 3).derivative(rrr.coordinates[0]);
  std::cout << "equal   : " << std::boolalpha << (derivative == columns(0, 0)) << '\n'
            << "at 0    : " << tool(0, 3).value(symbol_values(rrr, {0, 0, 0})) << " m\n\n";

  const beeline::SymbolicArm ur5 = beeline::symbolic_arm(beeline::built_in("ur5"));
  std::cout << text_of(formula_document(ur5, {.links = false, .tool = false, .determinant = true}));

  const beeline::GeneratedCode code =
      formula_code(ur5, {.jacobian = true}, beeline::CodeLanguage::cpp);
  for (const beeline::GeneratedFunction& function : code.functions) {
    std::cout << '\n'
              << function.name << ": " << function.multiplications << " multiplications, "
              << function.additions << " additions, " << function.trigonometric
              << " cosines and sines\n";
  }
}
