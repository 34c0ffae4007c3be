#include <algorithm>

#include <beeline/formula/internal/tree.h>

namespace beeline::internal {

Expression expression_of(const Tree& tree) {
  Expression result;
  switch (tree.kind) {
    case Tree::Kind::number:
      return tree.coefficient;
    case Tree::Kind::symbol:
      return Expression::symbol(tree.symbol);
    case Tree::Kind::trig:
      return tree.trig.sine ? Expression::sine(tree.trig.angle)
                            : Expression::cosine(tree.trig.angle);
    case Tree::Kind::sum:
      for (const Tree& part : tree.parts) result += expression_of(part);
      return result;
    case Tree::Kind::product:
      result = tree.coefficient;
      for (const Tree& part : tree.parts) result = result * expression_of(part);
      return result;
    case Tree::Kind::power:
      result = 1;
      for (int k = 0; k < tree.exponent; ++k) result = result * expression_of(tree.parts.front());
      return result;
    case Tree::Kind::quotient:
    case Tree::Kind::arctangent:
    case Tree::Kind::signed_root:
    case Tree::Kind::angle:
      break;
  }
  throw Error("a quotient or a function is no polynomial");
}

Operations operations(const Tree& tree) {
  Operations count;
  for (const Tree& part : tree.parts) {
    const Operations inner = operations(part);
    count.multiplications += inner.multiplications;
    count.additions += inner.additions;
  }
  const int parts = static_cast<int>(tree.parts.size());
  if (tree.kind == Tree::Kind::sum) count.additions += parts - 1;
  if (tree.kind == Tree::Kind::power) count.multiplications += tree.exponent - 1;
  if (tree.kind == Tree::Kind::quotient) ++count.multiplications;
  if (tree.kind == Tree::Kind::product) {
    const bool scaled =
        !(tree.coefficient == Coefficient(1)) && !(tree.coefficient == Coefficient(-1));
    count.multiplications += std::max(0, parts - 1 + (scaled ? 1 : 0));
  }
  return count;
}

}  // namespace beeline::internal
