#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/notation.h>
#include <beeline/formula/internal/planar_inverse.h>

namespace beeline::internal {

/// Returns an angle in degrees, without visible rounding of the conversion.
double in_degrees(double radians);

/// Writes expressions, and records the symbols and abbreviations that occur.
class DocumentWriter {
 public:
  DocumentWriter(const SymbolicArm& arm, const FormulaStyle& style)
      : arm_(arm), style_(style), notation_(arm.symbols, style.latex) {}

  const Notation& notation() const { return notation_; }
  std::string text(const Expression& expression);
  std::string text(const DeterminantFormula& determinant);
  std::string angle(const PlanarAngle& angle);
  std::string theta() const { return subscripted("theta", "", style_.latex); }

  /// Writes the name of a transform: T with indices below and above.
  std::string transform(const std::string& below, const std::string& above) const;

  /// Writes the matrix of a pose; for planar arms the 3 x 3 matrix.
  WrittenFormula pose(const std::string& left, const ExpressionMatrix& pose);

  /// Writes rows of a Jacobian, or of its time derivative.
  WrittenFormula jacobian(const ExpressionMatrix& rows, const std::vector<std::string>& names,
                          bool derivative);

  /// Writes the steps of a derivation, with its explanations.
  std::vector<WrittenFormula> derivation(const InverseDerivation& derivation);

  std::vector<std::string> remarks(const InverseDerivation& derivation) const;

  /// Returns the constants that have occurred, and the variables of mimic joints.
  std::vector<WrittenSymbol> symbols() const;
  /// Returns the abbreviations that have occurred, with their meanings.
  std::vector<std::pair<std::string, std::string>> abbreviations() const;

 private:
  WrittenFormula matrix(const std::string& left, const ExpressionMatrix& matrix);
  bool in_plane(const ExpressionMatrix& pose) const;
  void name_cells(WrittenFormula& written) const;
  std::string row_name(const std::string& name) const;
  Tree tree(const Expression& expression);
  WrittenSymbol written_symbol(int number) const;

  const SymbolicArm& arm_;
  FormulaStyle style_;
  Notation notation_;
  std::set<int> symbols_;
  std::set<Trig> trigs_;
};

}  // namespace beeline::internal
