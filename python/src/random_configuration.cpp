#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "bindings.h"
#include "signature.h"

namespace beeline::python {
namespace {

constexpr std::int64_t max_count = 10'000'000;

/// The bounds within which a coordinate is drawn. Beyond a limit that is infinite a revolution, or
/// 2 metres, are left.
std::pair<double, double> range_of(const Arm& arm, int k) {
  const Limits& limits = arm.limits(k);
  const double half = kind(arm.joint_of(k)) == JointKind::prismatic ? 1 : std::numbers::pi;
  const bool below = std::isfinite(limits.lower), above = std::isfinite(limits.upper);
  if (below && above) return {limits.lower, limits.upper};
  if (below) return {limits.lower, limits.lower + 2 * half};
  if (above) return {limits.upper - 2 * half, limits.upper};
  return {-half, half};
}

/// Uniform in [0, 1): of the same numbers on every machine.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

nb::object random_configurations(const Arm& arm, nb::handle count, nb::handle seed) {
  const bool one = count.is_none();
  const std::int64_t rows = one ? 1 : Value<std::int64_t>::from(count, "count");
  if (rows < 0 || rows > max_count) {
    throw Error("count must be from 0 to " + std::to_string(max_count) + ", not " +
                std::to_string(rows));
  }
  std::mt19937_64 random(seed.is_none() ? std::random_device()()
                                        : Value<std::uint64_t>::from(seed, "seed"));
  NewArray array(one ? std::vector<Index>{arm.dof()} : std::vector<Index>{rows, arm.dof()});
  double* value = array.data();
  for (std::int64_t row = 0; row < rows; ++row) {
    for (int k = 0; k < arm.dof(); ++k, ++value) {
      const auto [lower, upper] = range_of(arm, k);
      *value = std::min(upper, lower + (upper - lower) * uniform(random));
    }
  }
  return array.release();
}

}  // namespace

void bind_random_configurations(nb::module_& m) {
  Signature drawn(
      "random_configuration", array_type,
      "Returns a configuration, or `count` of them, uniform within the position limits. "
      "A joint without limits turns within a revolution, from -pi to pi; a slide moves "
      "within 2 m.");
  drawn.takes("arm", "Arm", "The arm.")
      .takes("count", "int | None", "Number of rows; None: one configuration.", "None")
      .keywords()
      .takes("seed", "int | None", "The same seed gives the same numbers; None: others each time.",
             "None")
      .returns("(n,), or (count, n).");
  define_on_arm(m, &random_configurations, drawn, nb::arg("arm"), nb::arg("count") = nb::none(),
                nb::kw_only(), nb::arg("seed") = nb::none());
}

}  // namespace beeline::python
