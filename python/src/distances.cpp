#include "bindings.h"
#include "collision_fields.h"
#include "interruption.h"

namespace beeline::python {
namespace {

void bind_blocked_by(nb::module_& m) {
  Signature blocked("blocked_by", "Reason", comment("blocked_by"));
  blocked.takes("model", "CollisionModel", "The arm among obstacles.")
      .takes("q", array_like, "Configuration (n,).")
      .returns("Empty, which is false, if the configuration is free.");
  define(
      m,
      [](const CollisionModel& model, nb::handle q) {
        return Value<Reason>::to(blocked_by(model, Value<Configuration>::from(q, "q")));
      },
      blocked, nb::arg("model"), nb::arg("q"));
  Signature base("base_blocked_by", "Reason", comment("base_blocked_by"));
  base.takes("model", "CollisionModel", "The arm among obstacles.")
      .returns("Empty, which is false, if the arm can stand there.");
  define(
      m, [](const CollisionModel& model) { return Value<Reason>::to(base_blocked_by(model)); },
      base, nb::arg("model"));
}

void bind_nearest(nb::module_& m) {
  Signature nearest("nearest_pair", "BodyDistance",
                    "Returns the pair with the least distance beyond its clearance at a "
                    "configuration. Raises Error for a model without pairs.");
  nearest.takes("model", "CollisionModel", "The arm among obstacles.")
      .takes("q", array_like, "Configuration (n,).");
  define(
      m,
      [](const CollisionModel& model, nb::handle q) {
        return nearest_pair(model, Value<Configuration>::from(q, "q"));
      },
      nearest, nb::arg("model"), nb::arg("q"));

  Signature close("pairs_too_close", "list[BodyDistance]", comment("pairs_too_close"));
  close.takes("model", "CollisionModel", "The arm among obstacles.")
      .takes("q", array_like, "Configuration (n,).");
  define(
      m,
      [](const CollisionModel& model, nb::handle q) {
        return Value<std::vector<BodyDistance>>::to(
            pairs_too_close(model, Value<Configuration>::from(q, "q")));
      },
      close, nb::arg("model"), nb::arg("q"));

  Signature spare("spare_clearance", "float", comment("spare_clearance"));
  spare.takes("model", "CollisionModel", "The arm among obstacles.")
      .takes("q", array_like, "Configuration (n,).")
      .takes("most", "float | None",
             "Distance, m, beyond which distances are not computed; None: all are.", "None");
  define(
      m,
      [](const CollisionModel& model, nb::handle q, nb::handle most) {
        return spare_clearance(model, Value<Configuration>::from(q, "q"),
                               most.is_none() ? Limits::none : Value<double>::from(most, "most"));
      },
      spare, nb::arg("model"), nb::arg("q"), nb::arg("most") = nb::none());
}

}  // namespace

std::shared_ptr<const CollisionModel> shared_model(nb::handle value, const char* name) {
  if (!nb::isinstance<CollisionModel>(value)) raise_type(name, "CollisionModel | None", value);
  return {shared_object(nb::borrow(value)), &nb::cast<const CollisionModel&>(value)};
}

void check_options_of(const Arm& arm, const nb::dict& keywords) {
  for (const char* option : {"blocked_by", "spare_clearance"}) {
    if (!keywords.contains(option)) continue;
    const nb::object model = keywords[option];
    if (nb::isinstance<CollisionModel>(model) &&
        !same_links(nb::cast<const CollisionModel&>(model).arm(), arm)) {
      throw Error(std::string(option) + " is a model of another arm");
    }
  }
  if (keywords.contains("task")) task_of(arm, keywords["task"]);
}

void bind_distances(nb::module_& m) {
  bind_nearest(m);
  bind_blocked_by(m);
}

}  // namespace beeline::python
