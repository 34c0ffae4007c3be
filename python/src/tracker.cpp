#include <set>

#include "bindings.h"
#include "collision_fields.h"
#include "loop_arguments.h"
#include "loop_fields.h"

namespace beeline::python {

std::string_view kept_name(std::string_view text) {
  static std::set<std::string, std::less<>> names;
  const auto found = names.find(text);
  return found != names.end() ? *found : *names.emplace(text).first;
}

namespace {

nb::class_<Described<Tracker>> tracker_class(nb::module_& m) {
  nb::class_<Described<Tracker>> tracker(m, "Tracker", loop_class_doc("Tracker"));
  Signature made("__init__", "None",
                 "Starts at rest at `start`. Raises Error for a start outside the arm's limits.");
  made.takes("self")
      .takes_arm()
      .takes("start", array_like, configuration_doc)
      .options<TrackerOptions>();
  define(
      tracker,
      [](Described<Tracker>* self, const Arm& arm, nb::handle start, const nb::kwargs& keywords) {
        const Numbers from(start, "start");
        check_options_of(arm, keywords);
        new (self) Described<Tracker>(described(arm.name(), keywords), arm, from,
                                      options<TrackerOptions>(keywords));
        self->plane.emplace(arm);
        self->model = model_of(keywords);
      },
      made, nb::arg("arm"), nb::arg("start"), nb::arg("keywords"));
  return tracker;
}

}  // namespace

void bind_trackers(nb::module_& m) {
  bind_record<TrackerStep>(m);
  nb::class_<Described<Tracker>> tracker = tracker_class(m);
  Signature step("step", "TrackerStep",
                 "Advances by one time step towards the commanded pose of the tool. Raises Error "
                 "for a pose that is not a rigid motion, which changes nothing.");
  step.takes("self")
      .takes("world_T_tool", arm_pose_like, arm_pose_doc)
      .keywords()
      .takes("out", outputs_type(), "Array (n,) of float64 for q, or two for q and velocity.",
             "None");
  define(
      tracker,
      [](Described<Tracker>& self, nb::handle world_T_tool, nb::handle out) {
        const Pose pose = self.plane->pose(world_T_tool, "world_T_tool");
        Outputs outputs(out, self.configuration().size());
        const TrackerStep& made_step = self.step(pose);
        outputs.write(made_step.q, made_step.velocity);
        TrackerStep result = made_step;
        result.bodies = kept_names(made_step.bodies);
        return result;
      },
      step, nb::arg("world_T_tool"), nb::kw_only(), nb::arg("out") = nb::none());
  Signature reset("reset", "None", comment("Tracker::reset"));
  reset.takes("self").takes("q", array_like, configuration_doc);
  define(
      tracker, [](Described<Tracker>& self, nb::handle q) { self.reset(Numbers(q, "q")); }, reset,
      nb::arg("q"));
  const auto property = [&tracker](const char* name, auto get, const char* doc) {
    tracker.def_prop_ro(
        name, [get](const Described<Tracker>& self) { return Value<Configuration>::to(get(self)); },
        getter(name, array_type), doc);
  };
  property(
      "configuration", [](const Described<Tracker>& self) { return self.configuration(); },
      "q of the last step, (n,).");
  property(
      "velocity", [](const Described<Tracker>& self) { return self.velocity(); },
      "Of the last step, zero at first, rad/s or m/s, (n,).");
  bind_copies(tracker, "Tracker", "its arm, configuration and options");
}

}  // namespace beeline::python
