#include "bindings.h"
#include "free_path_fields.h"
#include "interruption.h"

namespace beeline::python {
namespace {

/// The arguments of a search among obstacles.
Signature& takes_ends(Signature& signature) {
  return signature.takes("model", "CollisionModel", "The arm among obstacles.")
      .takes("start", array_like, "Configuration (n,).")
      .takes("goals", argument_type<std::vector<Configuration>>(),
             "Configurations (N, n), of which one is to be reached.");
}

}  // namespace

void bind_free_paths(nb::module_& m) {
  bind_record<FreePath>(m);
  bind_record<FreeMotion>(m);
  Signature path("find_free_path", "FreePath", comment("find_free_path"));
  takes_ends(path).options<FreePathOptions>();
  define(
      m,
      [](const CollisionModel& model, nb::handle start, nb::handle goals,
         const nb::kwargs& keywords) {
        const auto from = Value<Configuration>::from(start, "start");
        const auto to = Value<std::vector<Configuration>>::from(goals, "goals");
        auto asked = options<FreePathOptions>(keywords);
        return unlocked(asked.budget, [&] { return find_free_path(model, from, to, asked); });
      },
      path, nb::arg("model"), nb::arg("start"), nb::arg("goals"), nb::arg("keywords"));

  Signature motion("move_around", "FreeMotion", comment("move_around"));
  takes_ends(motion).options<FreeMotionOptions>();
  define(
      m,
      [](const CollisionModel& model, nb::handle start, nb::handle goals,
         const nb::kwargs& keywords) {
        const auto from = Value<Configuration>::from(start, "start");
        const auto to = Value<std::vector<Configuration>>::from(goals, "goals");
        auto asked = options<FreeMotionOptions>(keywords);
        return unlocked(asked.budget, [&] { return move_around(model, from, to, asked); });
      },
      motion, nb::arg("model"), nb::arg("start"), nb::arg("goals"), nb::arg("keywords"));
}

}  // namespace beeline::python
