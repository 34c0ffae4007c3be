#include "bindings.h"
#include "loop_arguments.h"
#include "loop_fields.h"

namespace beeline::python {
namespace {

constexpr const char* out_doc = "Array (n,) of float64 for the joint velocities.";

/// step(q, velocity), with the velocity in `out` too.
template <class Step>
ServoMotion stepped(nb::handle q, nb::handle out, const Step& step) {
  const Numbers from(q, "q");
  const Index shape[] = {from.size()};
  OutputArray velocity(out, "out", shape, Real::float64);
  ServoMotion motion{Configuration(from.size())};
  const ServoStep done = step(ConfigurationRef(from), motion.velocity);
  motion.scale = done.scale;
  motion.limit = done.limit;
  motion.joint = done.joint;
  motion.bodies = kept_names(done.bodies);
  motion.proved = done.proved;
  std::copy(motion.velocity.begin(), motion.velocity.end(), velocity.data());
  velocity.finish();
  return motion;
}

nb::class_<Described<Servo>> servo_class(nb::module_& m) {
  nb::class_<Described<Servo>> servo(m, "Servo", loop_class_doc("Servo"));
  Signature made("__init__", "None", "Starts a loop of an arm at rest.");
  made.takes("self").takes_arm().options<ServoOptions>();
  define(
      servo,
      [](Described<Servo>* self, const Arm& arm, const nb::kwargs& keywords) {
        new (self)
            Described<Servo>(described(arm.name(), keywords), arm, options<ServoOptions>(keywords));
        self->plane.emplace(arm);
        self->model = model_of(keywords);
      },
      made, nb::arg("arm"), nb::arg("keywords"));
  return servo;
}

void bind_steps(nb::class_<Described<Servo>>& servo) {
  const std::string out_type = std::string(array_type) + " | None";
  Signature step("step", "ServoStep", "Converts a tool velocity into joint velocities.");
  step.takes("self")
      .takes("q", array_like, configuration_doc)
      .takes("command", array_like,
             "Tool velocity [vx vy vz wx wy wz] in the task's frame (world or tool axes), m/s and "
             "rad/s, (6,); rows that the task excludes are ignored.")
      .keywords()
      .takes("out", out_type, out_doc, "None");
  define(
      servo,
      [](Described<Servo>& self, nb::handle q, nb::handle command, nb::handle out) {
        const Twist twist = Value<Twist>::from(command, "command");
        return stepped(q, out, [&](const ConfigurationRef& from, Configuration& velocity) {
          return self.step(from, twist, velocity);
        });
      },
      step, nb::arg("q"), nb::arg("command"), nb::kw_only(), nb::arg("out") = nb::none());
  Signature towards("step_towards", "ServoStep", comment("Servo::step_towards"));
  towards.takes("self")
      .takes("q", array_like, configuration_doc)
      .takes("world_T_tool", arm_pose_like, arm_pose_doc)
      .keywords()
      .takes("out", out_type, out_doc, "None");
  define(
      servo,
      [](Described<Servo>& self, nb::handle q, nb::handle world_T_tool, nb::handle out) {
        const Pose pose = self.plane->pose(world_T_tool, "world_T_tool");
        return stepped(q, out, [&](const ConfigurationRef& from, Configuration& velocity) {
          return self.step_towards(from, pose, velocity);
        });
      },
      towards, nb::arg("q"), nb::arg("world_T_tool"), nb::kw_only(), nb::arg("out") = nb::none());
}

void bind_velocity(nb::class_<Described<Servo>>& servo) {
  Signature velocity("set_velocity", "None", comment("Servo::set_velocity"));
  velocity.takes("self").takes("velocity", array_like, "rad/s or m/s, (n,).");
  define(
      servo,
      [](Described<Servo>& self, nb::handle values) {
        self.set_velocity(Numbers(values, "velocity"));
      },
      velocity, nb::arg("velocity"));
}

}  // namespace

void bind_servos(nb::module_& m) {
  bind_record<ServoMotion>(m);
  nb::class_<Described<Servo>> servo = servo_class(m);
  bind_steps(servo);
  bind_velocity(servo);
  bind_copies(servo, "Servo", "its arm and options");
}

}  // namespace beeline::python
