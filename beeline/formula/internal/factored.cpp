#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include <beeline/formula/internal/tree.h>

namespace beeline::internal {
namespace {

/// A symbol, or a cosine or sine.
struct Factor {
  int symbol = -1;  ///< -1: trig
  Trig trig = {};

  bool operator==(const Factor&) const = default;
  friend bool operator<(const Factor& a, const Factor& b) {
    return std::tie(a.symbol, a.trig) < std::tie(b.symbol, b.trig);
  }
};

/// A product of powers with a coefficient. Unlike in a Monomial, several cosines and sines may
/// belong to one group.
struct Product {
  Coefficient coefficient;
  std::map<Factor, int> factors = {};
  std::size_t place = 0;  ///< position among the terms of the expression
};
using Products = std::vector<Product>;

Products products_of(const Expression& expression) {
  Products products;
  for (const auto& [monomial, coefficient] : expression.terms()) {
    Product product{.coefficient = coefficient, .place = products.size()};
    for (const auto& [symbol, exponent] : monomial.powers) {
      product.factors[{.symbol = symbol}] = exponent;
    }
    for (const Trig& trig : monomial.trigs) product.factors[{.trig = trig}] = 1;
    products.push_back(std::move(product));
  }
  return products;
}

/// Returns half of an angle, if its multiples are even.
std::optional<Angle> half(Angle angle) {
  for (auto& multiple : angle.multiples) {
    if (multiple.second % 2 != 0) return std::nullopt;
    multiple.second /= 2;
  }
  return angle;
}

/// A product as a cosine or sine times the rest; a zero angle stands for cos 0 = 1.
struct Split {
  std::size_t product = 0;  ///< number of the product
  Trig trig = {};
  Coefficient coefficient;
};
using Splits =
    std::map<std::map<Factor, int>, std::vector<Split>>;  ///< keys are the factors of the remainder

void multiply(Product& product, Trig trig) {
  if (trig.angle.is_zero()) return;  // cos 0; sin 0 does not arise
  if (trig.angle.multiples.front().second < 0) {
    trig.angle = -1 * trig.angle;
    if (trig.sine) product.coefficient = -product.coefficient;
  }
  ++product.factors[{.trig = trig}];
}

/// Returns the product form of rest * (cos u + sign cos v) or rest * (sin u + sign sin v), if the
/// half sum and half difference of the angles are integer combinations.
std::optional<Product> as_product(const Split& a, const Split& b,
                                  const std::map<Factor, int>& rest) {
  const Trig &u = a.trig, &v = b.trig;
  const bool zero = u.angle.is_zero() || v.angle.is_zero();
  if (u.sine != v.sine || (!zero && u.angle.group != v.angle.group)) return std::nullopt;
  const bool same = a.coefficient == b.coefficient;
  if (!same && !(a.coefficient == -b.coefficient)) return std::nullopt;
  const std::optional<Angle> mean = half(u.angle + v.angle);
  const std::optional<Angle> offset = half(u.angle + -1 * v.angle);
  if (!mean || !offset) return std::nullopt;
  // cos u + cos v = 2 cos m cos d, cos u - cos v = -2 sin m sin d,
  // sin u + sin v = 2 sin m cos d, sin u - sin v = 2 cos m sin d.
  Product product{Coefficient(!u.sine && !same ? -2 : 2) * a.coefficient, rest, a.product};
  multiply(product, {*mean, u.sine == same});
  multiply(product, {*offset, !same});
  return product;
}

/// Adds each split that takes one cosine or sine out of a product, and the product itself as 1
/// times it.
void add_splits(Splits& splits, const Product& product, std::size_t number) {
  for (const auto& [factor, exponent] : product.factors) {
    if (factor.symbol >= 0) continue;
    std::map<Factor, int> rest = product.factors;
    rest.erase(factor);
    splits[std::move(rest)].push_back({number, factor.trig, product.coefficient});
  }
  splits[product.factors].push_back({number, Trig{}, product.coefficient});
}

/// Whether two angles of one group have an integer half sum: otherwise no two terms combine.
bool may_combine(const Products& products) {
  std::map<int, std::vector<Angle>> of_group;
  for (const Product& product : products) {
    for (const auto& [factor, exponent] : product.factors) {
      if (factor.symbol >= 0) continue;
      std::vector<Angle>& angles = of_group[factor.trig.angle.group];
      const bool known = std::find(angles.begin(), angles.end(), factor.trig.angle) != angles.end();
      if (!known) angles.push_back(factor.trig.angle);
    }
  }
  for (const auto& [group, angles] : of_group) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (half(angles[i])) return true;
      for (std::size_t k = i + 1; k < angles.size(); ++k) {
        if (half(angles[i] + angles[k])) return true;
      }
    }
  }
  return false;
}

/// Replaces pairs of terms by products. Each term of a linearised expression has at most one cosine
/// or sine of a group, and the products that replace pairs have two, so no product is replaced
/// again; each shortens the expression by one term.
void combine_pairs(Products& products) {
  if (!may_combine(products)) return;
  Splits splits;
  for (std::size_t i = 0; i < products.size(); ++i) add_splits(splits, products[i], i);
  constexpr std::size_t most = 64;  // max terms with a common remainder whose pairs are compared
  std::vector<bool> used(products.size(), false);
  Products combined;
  for (const auto& [rest, terms] : splits) {
    for (std::size_t i = 0; i < std::min(terms.size(), most); ++i) {
      for (std::size_t k = i + 1; k < std::min(terms.size(), most); ++k) {
        if (used[terms[i].product] || used[terms[k].product]) continue;
        std::optional<Product> product = as_product(terms[i], terms[k], rest);
        if (!product) continue;
        used[terms[i].product] = used[terms[k].product] = true;
        combined.push_back(std::move(*product));
      }
    }
  }
  for (std::size_t i = 0; i < products.size(); ++i) {
    if (!used[i]) combined.push_back(std::move(products[i]));
  }
  std::sort(combined.begin(), combined.end(),
            [](const Product& a, const Product& b) { return a.place < b.place; });
  products = std::move(combined);
}

Tree tree_of(const Factor& factor, int exponent) {
  Tree tree;
  tree.kind = factor.symbol >= 0 ? Tree::Kind::symbol : Tree::Kind::trig;
  tree.symbol = factor.symbol;
  tree.trig = factor.trig;
  if (exponent == 1) return tree;
  return {.kind = Tree::Kind::power, .exponent = exponent, .parts = {tree}};
}

Tree tree_of(const Product& product) {
  Tree tree{.kind = Tree::Kind::product, .coefficient = product.coefficient};
  for (const auto& [factor, exponent] : product.factors) {
    if (factor.symbol >= 0) tree.parts.push_back(tree_of(factor, exponent));
  }
  for (const auto& [factor, exponent] : product.factors) {
    if (factor.symbol < 0) tree.parts.push_back(tree_of(factor, exponent));
  }
  return tree;
}

/// Returns the factor that the most terms have, at least two; the first of several.
std::optional<Factor> most_common(const Products& products) {
  std::map<Factor, int> count;
  for (const Product& product : products) {
    for (const auto& [factor, exponent] : product.factors) ++count[factor];
  }
  const auto more = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto most = std::max_element(count.begin(), count.end(), more);
  if (most == count.end() || most->second < 2) return std::nullopt;
  return most->first;
}

Tree sum_of(Products products, bool is_factor);

bool is_power_of(const Tree& tree, const Factor& factor) {
  const Tree& base = tree.kind == Tree::Kind::power ? tree.parts.front() : tree;
  if (base.kind == Tree::Kind::symbol) return base.symbol == factor.symbol;
  return base.kind == Tree::Kind::trig && factor.symbol < 0 && base.trig == factor.trig;
}

/// Returns factor * (sum of the quotients), with factors of the sum's own product before its
/// bracket.
Tree with_factor(const Factor& factor, const Products& quotients) {
  Tree inner = sum_of(quotients, true);
  Tree product{.kind = Tree::Kind::product, .parts = {tree_of(factor, 1)}};
  if (inner.kind == Tree::Kind::product) {
    product.coefficient = inner.coefficient;
    for (Tree& part : inner.parts) {
      if (is_power_of(part, factor)) {
        const int exponent = part.kind == Tree::Kind::power ? part.exponent : 1;
        product.parts.front() = tree_of(factor, exponent + 1);
      } else {
        product.parts.push_back(std::move(part));
      }
    }
  } else {
    product.parts.push_back(std::move(inner));
  }
  return product;
}

/// Returns the coefficient that all terms share up to its sign. For a sum that is a factor it has
/// the sign of the first term, so that equal brackets look equal.
Coefficient content(const Products& products, bool is_factor) {
  const Coefficient& first = products.front().coefficient;
  bool all_equal = true, all_negative = true;
  for (const Product& product : products) {
    const Coefficient& other = product.coefficient;
    all_negative = all_negative && other.is_negative();
    all_equal = all_equal && (other == first || other == -first);
  }
  const bool negative = is_factor ? first.is_negative() : all_negative;
  if (all_equal && !(first == Coefficient(1)) && !(first == Coefficient(-1))) {
    return first.is_negative() != negative ? -first : first;
  }
  return negative && is_factor ? -1 : 1;
}

Products divided(Products products, const Coefficient& coefficient) {
  for (Product& product : products) {
    product.coefficient =
        coefficient == Coefficient(-1)
            ? -product.coefficient
            : Coefficient(product.coefficient.is_negative() == coefficient.is_negative() ? 1 : -1);
  }
  return products;
}

/// Returns a sum that begins with a positive term, if there is one.
Tree sum_tree(std::vector<Tree> parts) {
  const auto negative = [](const Tree& part) {
    return part.kind == Tree::Kind::product && part.coefficient.is_negative();
  };
  const auto positive = std::find_if_not(parts.begin(), parts.end(), negative);
  if (positive != parts.end()) std::rotate(parts.begin(), positive, positive + 1);
  return {.kind = Tree::Kind::sum, .parts = std::move(parts)};
}

Tree sum_of(Products products, bool is_factor) {
  if (products.empty()) return {.coefficient = 0};
  if (products.size() == 1) return tree_of(products.front());
  if (const Coefficient common = content(products, is_factor); !(common == Coefficient(1))) {
    Tree inner = sum_of(divided(std::move(products), common), true);
    if (inner.kind != Tree::Kind::product) inner = {.kind = Tree::Kind::product, .parts = {inner}};
    inner.coefficient = inner.coefficient * common;
    return inner;
  }
  std::map<std::size_t, Tree> parts;  // keys are the positions of their first terms
  while (const std::optional<Factor> factor = most_common(products)) {
    Products with, without;
    for (Product& product : products) {
      const auto place = product.factors.find(*factor);
      if (place == product.factors.end()) {
        without.push_back(std::move(product));
        continue;
      }
      if (--place->second == 0) product.factors.erase(place);
      with.push_back(std::move(product));
    }
    const std::size_t place = with.front().place;
    parts.emplace(place, with_factor(*factor, with));
    products = std::move(without);
  }
  for (const Product& product : products) parts.emplace(product.place, tree_of(product));
  if (parts.size() == 1) return std::move(parts.begin()->second);
  std::vector<Tree> in_order;
  for (auto& [place, part] : parts) in_order.push_back(std::move(part));
  return sum_tree(std::move(in_order));
}

}  // namespace

Tree factored(const Expression& expression) {
  Products products = products_of(expression);
  combine_pairs(products);
  return sum_of(std::move(products), false);
}

}  // namespace beeline::internal
