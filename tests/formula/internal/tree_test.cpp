#include <gtest/gtest.h>

#include <beeline/formula/internal/numbers_inserted.h>
#include <beeline/formula/internal/tree.h>
#include <beeline/model/catalog.h>

#include <tests/formula/random_expression.h>
#include <tests/typical_arms.h>

namespace beeline::internal {
namespace {

using testing::cases;
using testing::Random;
using testing::random_expression;

TEST(Tree, OfFactorsIsTheExpression) {
  Random random;
  for (int k = 0; k < cases(2000); ++k) {
    const Expression a = random_expression(random, random.integer(0, 6));
    EXPECT_EQ(expression_of(factored(a)), a);
  }
}

TEST(Tree, FindsProducts) {
  const Angle one{3, {{3, 1}}}, two{3, {{4, 1}}}, other{6, {{6, 1}}};
  const Expression s1 = Expression::sine(one), s2 = Expression::sine(two);
  const Expression c6 = Expression::cosine(other), a = Expression::symbol(0);
  const Tree square = factored(s1 * s1);  // (1 - cos 2 q) / 2
  ASSERT_EQ(square.kind, Tree::Kind::product);
  ASSERT_EQ(square.parts.size(), 1U);
  EXPECT_EQ(square.parts[0].kind, Tree::Kind::power);
  const Tree product = factored(a * s1 * s2 * c6);
  EXPECT_EQ(product.kind, Tree::Kind::product);
  EXPECT_EQ(product.parts.size(), 4U);
  const Tree bracket = factored(a * s1 + a * c6);
  ASSERT_EQ(bracket.parts.size(), 2U);
  EXPECT_EQ(bracket.parts[1].kind, Tree::Kind::sum);
}

TEST(Numbers, ReplaceConstantsOnly) {
  Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const SymbolicArm symbolic = symbolic_arm(arm);
    for (const auto& transforms : symbolic.transforms) {
      for (const ElementaryTransform& transform : transforms) {
        const Configuration q = random.configuration(arm);
        const std::vector<double> values = symbol_values(symbolic, q);
        const Expression inserted = with_numbers(transform.distance, symbolic);
        EXPECT_NEAR(inserted.value(values), transform.distance.value(values), 1e-14);
        for (const auto& [monomial, coefficient] : inserted.terms()) {
          for (const auto& [symbol, exponent] : monomial.powers) {
            EXPECT_GE(symbolic.symbols[static_cast<std::size_t>(symbol)].coordinate, 0);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace beeline::internal
