#include <beeline/formula/internal/tree.h>

namespace beeline::internal {

Expression expression_of(const Tree& tree) {
  const auto number = [](const Coefficient& coefficient) { return Expression(coefficient); };
  return evaluated<Expression>(tree, number, [](const Tree& leaf) {
    if (leaf.kind == Tree::Kind::symbol) return Expression::symbol(leaf.symbol);
    if (leaf.kind != Tree::Kind::trig) throw Error("a quotient or a function is no polynomial");
    return leaf.trig.sine ? Expression::sine(leaf.trig.angle) : Expression::cosine(leaf.trig.angle);
  });
}

}  // namespace beeline::internal
