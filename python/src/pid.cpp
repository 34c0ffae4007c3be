#include <beeline/control/joint.h>

#include "bindings.h"
#include "control_fields.h"
#include "loop_arguments.h"

namespace beeline::python {

void bind_pids(nb::module_& m) {
  nb::class_<Described<Pid>> pid(
      m, "Pid",
      "A PID controller in joint space, with its state: each step is kp e + ki sum e + kd (e - "
      "last e) with the error e = goal - q (Dellaert, *Serial Link Manipulators*, eq. 1.3). Angles "
      "are not wrapped. A copy is independent, in the same state. It equals only itself, and has "
      "no pickle: pickle what it is made of.");
  Signature made("__init__", "None", "Starts a controller.");
  made.takes("self").takes("goal", array_like, configuration_doc).options<PidGains>();
  define(
      pid,
      [](Described<Pid>* self, nb::handle goal, const nb::kwargs& keywords) {
        const Numbers to(goal, "goal");
        new (self) Described<Pid>(described(std::to_string(to.size()) + " joints", keywords),
                                  options<PidGains>(keywords), to);
      },
      made, nb::arg("goal"), nb::arg("keywords"));
  Signature start("start", "None", comment("Pid::start"));
  start.takes("self").takes("q", array_like, configuration_doc);
  define(
      pid, [](Described<Pid>& self, nb::handle q) { self.start(Numbers(q, "q")); }, start,
      nb::arg("q"));
  Signature goal("set_goal", "None", comment("Pid::set_goal"));
  goal.takes("self").takes("goal", array_like, configuration_doc);
  define(
      pid, [](Described<Pid>& self, nb::handle q) { self.set_goal(Numbers(q, "goal")); }, goal,
      nb::arg("goal"));
  Signature step("step", array_type, "Returns the change of q, (n,).");
  step.takes("self").takes("q", array_like, configuration_doc);
  define(
      pid,
      [](Described<Pid>& self, nb::handle q) {
        return Value<Configuration>::to(self.step(Numbers(q, "q")));
      },
      step, nb::arg("q"));
  bind_copies(pid, "Pid", "its goal and gains");
}

}  // namespace beeline::python
