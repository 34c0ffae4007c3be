#pragma once

#include <string>
#include <vector>

#include <beeline/formula/internal/tree.h>

namespace beeline::internal {

/// How formulas are written: as text with Unicode subscripts, or as LaTeX.
class Notation {
 public:
  /// `symbols` must outlive the object.
  Notation(const std::vector<Symbol>& symbols, bool latex);

  bool latex() const { return latex_; }

  std::string text(const Tree& tree) const;
  std::string text(const Expression& expression) const { return text(factored(expression)); }
  std::string symbol(int number) const;
  std::string angle(const Angle& angle) const;  ///< q1 + q2
  std::string trig(const Trig& trig) const;     ///< c12, or cos(2 q1 + q2)

  /// Returns the expression that c12 stands for, `cos(q1 + q2)`; empty if trig() writes it in full.
  std::string meaning(const Trig& trig) const;

 private:
  bool abbreviates(const Trig& trig) const;
  std::string number(const Coefficient& coefficient, bool before_factors) const;
  int rank(const Tree& factor) const;
  std::string product(const Tree& tree) const;
  std::string bracketed(const Tree& tree) const;
  std::string arctangent(const Tree& tree) const;
  std::string root(const Tree& tree) const;
  std::string sum(const Tree& tree) const;
  std::string factor(const Tree& tree) const;

  const std::vector<Symbol>& symbols_;
  bool latex_;
  bool many_joints_;  ///< whether indices may have two digits, so that c12 would be ambiguous
};

/// A decimal number with up to 15 significant digits.
std::string decimal(double value);

/// Escapes text for LaTeX. Letters outside of ASCII, which need fonts that not every system has,
/// become question marks.
std::string escaped_latex(const std::string& text);

/// A name with its subscript: a2 as text with Unicode subscripts, or as LaTeX.
std::string subscripted(const std::string& letter, const std::string& subscript, bool latex);

}  // namespace beeline::internal
