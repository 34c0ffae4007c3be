#pragma once

#include <vector>

#include <beeline/formula/expression.h>

#include <tests/random.h>

namespace beeline::testing {

/// Symbols 0 to 2 are lengths, 3 to 5 angles of one group (3), 6 an angle of another one.
inline constexpr int symbol_count = 7;

inline Angle random_angle(Random& random) {
  if (random.integer(0, 2) == 0) return random.integer(1, 2) * Angle{6, {{6, 1}}};
  Angle angle{3, {}};
  for (const int symbol : {3, 4, 5}) {
    angle = angle + random.integer(-2, 2) * Angle{3, {{symbol, 1}}};
  }
  return angle;
}

inline Coefficient random_coefficient(Random& random) {
  return Coefficient::exactly(
      {random.integer(-3, 3), random.integer(-1, 1), random.integer(-1, 1), random.integer(-1, 1)},
      random.integer(1, 4));
}

/// A sum of a few products of coefficients, lengths, cosines and sines.
inline Expression random_expression(Random& random, int terms = 3) {
  Expression sum;
  for (int k = 0; k < terms; ++k) {
    Expression product = random_coefficient(random);
    for (int i = random.integer(0, 2); i > 0; --i) {
      product = product * Expression::symbol(random.integer(0, 2));
    }
    for (int i = random.integer(0, 2); i > 0; --i) {
      const Angle angle = random_angle(random);
      product = product *
                (random.integer(0, 1) == 0 ? Expression::cosine(angle) : Expression::sine(angle));
    }
    sum += product;
  }
  return sum;
}

inline std::vector<double> random_values(Random& random) {
  std::vector<double> values(symbol_count);
  for (double& value : values) value = random.uniform(-2, 2);
  return values;
}

}  // namespace beeline::testing
