#include <algorithm>

#include <beeline/timing/internal/newton_equations.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/timing/internal/newton_equations.cpp"
#include <hwy/foreach_target.h>

#include <beeline/simd/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::DurationProblem;
using internal::MultiplierStep;

/// Derivatives with respect to b, b' and b'' at eight times, or b, b' and b'' themselves.
struct Row {
  Lanes b, db, ddb;
};

HWY_INLINE Lanes dot(const Row& row, const Row& x) {
  return fma(row.ddb, x.ddb, fma(row.db, x.db, row.b * x.b));
}

HWY_INLINE Row rate_at(const double* rows, const double* c) {
  const Lanes c0 = Lanes::load(c), c1 = Lanes::load(c + 1), c2 = Lanes::load(c + 2);
  const auto row = [&](int r) HWY_ATTR {
    const double* at = rows + 3 * r * lane_count;
    return fma(Lanes::load(at + 2 * lane_count), c2,
               fma(Lanes::load(at + lane_count), c1, Lanes::load(at) * c0));
  };
  return {row(0), row(1), row(2)};
}

/// A joint's acceleration and jerk as fractions of their limits, and their gradients.
struct Joint {
  Lanes acceleration, jerk;
  Row acceleration_by, jerk_by;

  HWY_INLINE Joint(const double* motion, const double* inverse_limits, const Row& rate, Lanes root,
                   Lanes half_inverse) {
    const Lanes v = Lanes::load(motion), a = Lanes::load(motion + lane_count),
                j = Lanes::load(motion + 2 * lane_count);
    const Lanes per_acceleration(inverse_limits[0]), scale = root * Lanes(inverse_limits[1]);
    acceleration_by = {a * per_acceleration, v * per_acceleration, Lanes(0)};
    acceleration = fma(acceleration_by.db, rate.db, acceleration_by.b * rate.b);
    jerk_by = {scale * j, scale * (a * Lanes(1.5)), scale * v};
    jerk = dot(jerk_by, rate);
    jerk_by.b = fma(jerk, half_inverse, jerk_by.b);
  }
};

/// The gradient and the Hessian with respect to b, b' and b'', at eight times.
struct Local {
  Row gradient;
  Lanes h00, h01, h02, h11, h12, h22;

  HWY_INLINE Local() { h01 = h02 = h11 = h12 = h22 = gradient.db = gradient.ddb = Lanes(0); }

  HWY_INLINE void add(Lanes force, Lanes weight, const Row& by) {
    gradient.b = fma(force, by.b, gradient.b);
    gradient.db = fma(force, by.db, gradient.db);
    gradient.ddb = fma(force, by.ddb, gradient.ddb);
    const Lanes first = weight * by.b, second = weight * by.db;
    h00 = fma(first, by.b, h00);
    h01 = fma(first, by.db, h01);
    h02 = fma(first, by.ddb, h02);
    h11 = fma(second, by.db, h11);
    h12 = fma(second, by.ddb, h12);
    h22 = fma(weight * by.ddb, by.ddb, h22);
  }

  /// Adds the limit |z| <= 1; `smallest` becomes at most the product of its two slacks.
  HWY_INLINE void add_limit(Lanes z, const Row& by, const double* multipliers, Lanes gap,
                            Lanes& smallest) {
    const Lanes above = Lanes(1) - z, below = Lanes(1) + z;
    const Lanes both = above * below;
    smallest = min(smallest, both);
    const Lanes inverse = Lanes(1) / both;
    const Lanes weight = inverse * fma(Lanes::load(multipliers), below,
                                       Lanes::load(multipliers + lane_count) * above);
    add(gap * (z + z) * inverse, weight, by);
  }

  HWY_INLINE void add_to(double* g, double* const* bands, const double* rows) const {
    Row columns[3];
    for (int k = 0; k < 3; ++k) {
      columns[k] = {Lanes::load(rows + k * lane_count), Lanes::load(rows + (3 + k) * lane_count),
                    Lanes::load(rows + (6 + k) * lane_count)};
    }
    const auto add = [](double* to, Lanes what) HWY_ATTR { (Lanes::load(to) + what).store(to); };
    for (int k = 0; k < 3; ++k) {
      const Row& by = columns[k];
      const Row image{dot({h00, h01, h02}, by), dot({h01, h11, h12}, by), dot({h02, h12, h22}, by)};
      add(g + k, dot(gradient, by));
      for (int row = k; row < 3; ++row) add(bands[row - k] + k, dot(columns[row], image));
    }
  }
};

bool equations(const DurationProblem& problem, const double* c, const double* multipliers,
               double gap, double* gradient, double* const* bands) {
  const double* inverse_limits = problem.inverse_limits();
  for (std::size_t block = 0; block < problem.blocks(); ++block) {
    const std::size_t first = problem.first_step(block);
    const double* numbers = problem.numbers(block);
    const Row rate = rate_at(numbers, c + first);
    const Lanes root = sqrt(rate.b), inverse = Lanes(1) / rate.b;
    const Lanes half_inverse = Lanes(0.5) * inverse;
    Local local;
    const Lanes seconds = Lanes::load(numbers + 9 * lane_count) * root * inverse;  // w / sqrt(b)
    const Lanes fastest = Lanes::load(numbers + 10 * lane_count);
    const Lanes left = fnma(rate.b, fastest, Lanes(1)), steep = fastest / left;
    Lanes smallest = min(left, rate.b);
    local.gradient.b = fma(Lanes(gap), steep, -seconds * half_inverse);
    local.h00 = fma(Lanes::load(multipliers) * fastest, steep,
                    Lanes(1.5) * seconds * half_inverse * inverse);
    multipliers += lane_count;
    const double* motion = numbers + 11 * lane_count;
    for (std::size_t i = 0; i < problem.joints(); ++i) {
      const Joint joint(motion, inverse_limits + 2 * i, rate, root, half_inverse);
      local.add_limit(joint.acceleration, joint.acceleration_by, multipliers, gap, smallest);
      local.add_limit(joint.jerk, joint.jerk_by, multipliers + 2 * lane_count, gap, smallest);
      motion += 3 * lane_count;
      multipliers += 4 * lane_count;
    }
    if (bits(smallest > Lanes(0)) != 0xff) return false;
    double* const at[3] = {bands[0] + first, bands[1] + first, bands[2] + first};
    local.add_to(gradient + first, at, numbers);
  }
  return true;
}

double largest(Lanes x) {
  double eight[lane_count];
  x.store(eight);
  return *std::max_element(eight, eight + lane_count);
}

double sum(Lanes x) {
  double eight[lane_count], sum = 0;
  x.store(eight);
  for (const double value : eight) sum += value;
  return sum;
}

/// MultiplierStep in lanes, with the inverses of its fractions.
struct Step {
  Lanes coefficients, multipliers, products, by_coefficients, by_multipliers, by_both;

  HWY_INLINE Step() {
    coefficients = multipliers = products = Lanes(0);
    by_coefficients = by_multipliers = by_both = Lanes(0);
  }

  /// Adds a limit: its slack, the change of the slack, its multiplier, and the inverse of the
  /// product of slack and multiplier.
  HWY_INLINE void take(Lanes left, Lanes dleft, Lanes multiplier, Lanes inverse, Lanes gap,
                       double* change) {
    const Lanes next = fnma(multiplier, dleft, gap) * (inverse * multiplier) - multiplier;
    next.store(change);
    products = fma(multiplier, left, products);
    by_coefficients = fma(multiplier, dleft, by_coefficients);
    by_multipliers = fma(next, left, by_multipliers);
    by_both = fma(next, dleft, by_both);
    coefficients = max(coefficients, -dleft * (inverse * multiplier));
    multipliers = max(multipliers, -next * (inverse * left));
  }

  /// Adds the limit |z| <= 1, where z changes by dz: one division for both sides.
  HWY_INLINE void take_both(Lanes z, Lanes dz, const double* multipliers_here, Lanes gap,
                            double* change) {
    const Lanes above = Lanes(1) - z, below = Lanes(1) + z;
    const Lanes m = Lanes::load(multipliers_here), n = Lanes::load(multipliers_here + lane_count);
    const Lanes of_m = above * m, of_n = below * n, inverse = Lanes(1) / (of_m * of_n);
    take(above, -dz, m, inverse * of_n, gap, change);
    take(below, dz, n, inverse * of_m, gap, change + lane_count);
  }
};

MultiplierStep step(const DurationProblem& problem, const double* c, const double* dc,
                    const double* multipliers, double gap, double* change) {
  const double* inverse_limits = problem.inverse_limits();
  Step step;
  for (std::size_t block = 0; block < problem.blocks(); ++block) {
    const std::size_t first = problem.first_step(block);
    const double* numbers = problem.numbers(block);
    const Row rate = rate_at(numbers, c + first), drate = rate_at(numbers, dc + first);
    const Lanes root = sqrt(rate.b), half_inverse = Lanes(0.5) / rate.b;
    step.coefficients = max(step.coefficients, Lanes(-2) * drate.b * half_inverse);
    const Lanes fastest = Lanes::load(numbers + 10 * lane_count);
    const Lanes left = fnma(rate.b, fastest, Lanes(1)), multiplier = Lanes::load(multipliers);
    step.take(left, -drate.b * fastest, multiplier, Lanes(1) / (left * multiplier), gap, change);
    multipliers += lane_count;
    change += lane_count;
    const double* motion = numbers + 11 * lane_count;
    for (std::size_t i = 0; i < problem.joints(); ++i) {
      const Joint joint(motion, inverse_limits + 2 * i, rate, root, half_inverse);
      step.take_both(joint.acceleration, dot(joint.acceleration_by, drate), multipliers, gap,
                     change);
      step.take_both(joint.jerk, dot(joint.jerk_by, drate), multipliers + 2 * lane_count, gap,
                     change + 2 * lane_count);
      motion += 3 * lane_count;
      multipliers += 4 * lane_count;
      change += 4 * lane_count;
    }
  }
  return {1 / largest(step.coefficients), 1 / largest(step.multipliers), sum(step.products),
          sum(step.by_coefficients),      sum(step.by_multipliers),      sum(step.by_both)};
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace beeline {

HWY_EXPORT(equations);
HWY_EXPORT(step);

namespace internal {

NewtonEquations::NewtonEquations(const DurationProblem& problem)
    : gradient(problem.coefficients()) {
  for (auto& band : bands) band.resize(gradient.size());
}

bool set_up(NewtonEquations& equations, const DurationProblem& problem, const double* c,
            const double* multipliers, double gap) {
  auto& [gradient, bands] = equations;
  for (auto* numbers : {&gradient, &bands[0], &bands[1], &bands[2]}) {
    std::fill(numbers->begin(), numbers->end(), 0);
  }
  double* const at[3] = {bands[0].data(), bands[1].data(), bands[2].data()};
  return HWY_DYNAMIC_DISPATCH(equations)(problem, c, multipliers, gap, gradient.data(), at);
}

MultiplierStep multiplier_step(const DurationProblem& problem, const double* c, const double* dc,
                               const double* multipliers, double gap, double* change) {
  return HWY_DYNAMIC_DISPATCH(step)(problem, c, dc, multipliers, gap, change);
}

}  // namespace internal
}  // namespace beeline

#endif
