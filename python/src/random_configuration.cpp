#include <algorithm>
#include <cstdint>
#include <random>

#include "bindings.h"
#include "signature.h"

namespace beeline::python {
namespace {

constexpr std::int64_t max_count = 10'000'000;

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
    const Configuration q = random_configuration(arm, random);
    value = std::copy(q.begin(), q.end(), value);
  }
  return array.release();
}

}  // namespace

void bind_random_configurations(nb::module_& m) {
  Signature drawn(
      "random_configuration", array_type,
      "Returns a configuration, or `count` of them, uniform within the position limits. A joint "
      "without limits turns within a revolution, from -pi to pi; a slide moves within 2 m, from -1 "
      "to 1; with one limit they are within one revolution or 2 m of it.");
  drawn.takes_arm()
      .takes("count", "int | None", "Number of rows; None: one configuration.", "None")
      .keywords()
      .takes("seed", "int | None",
             "The same seed gives the same numbers on every system; None: others each time.",
             "None")
      .returns("(n,), or (count, n).");
  define_on_arm(m, &random_configurations, drawn, nb::arg("arm"), nb::arg("count") = nb::none(),
                nb::kw_only(), nb::arg("seed") = nb::none());

  Signature brief("random", array_type, "Returns random_configuration(count, seed=seed).");
  brief.takes("self")
      .takes("count", "int | None", "Number of rows; None: one configuration.", "None")
      .takes("seed", "int | None", "The same seed gives the same numbers on every system.", "None");
  auto type = nb::borrow<nb::class_<Arm>>(m.attr("Arm"));
  define(type, &random_configurations, brief, nb::arg("count") = nb::none(),
         nb::arg("seed") = nb::none());
}

}  // namespace beeline::python
