#include "bindings.h"
#include "loop_arguments.h"
#include "loop_fields.h"

namespace beeline::python {
namespace {

nb::class_<Described<Player>> player_class(nb::module_& m) {
  nb::class_<Described<Player>> player(m, "Player", loop_class_doc("Player"));
  Signature made("__init__", "None",
                 "Starts at rest at `start`. Raises Error for a recording that does not fit the "
                 "arm or leaves its position limits, and a start outside them.");
  made.summary_has_motions()
      .takes("self")
      .takes_arm()
      .takes("recording", "Trajectory", "Its joints are matched by name.")
      .takes("start", array_like, configuration_doc)
      .options<PlayerOptions>();
  define(
      player,
      [](Described<Player>* self, const Arm& arm, const Trajectory& recording, nb::handle start,
         const nb::kwargs& keywords) {
        const Numbers from(start, "start");
        new (self) Described<Player>(described(arm.name(), keywords), arm, recording, from,
                                     options<PlayerOptions>(keywords));
      },
      made, nb::arg("arm"), nb::arg("recording"), nb::arg("start"), nb::arg("keywords"));
  return player;
}

void bind_loop(nb::class_<Described<Player>>& player) {
  Signature step("step", "Command", comment("Player::step"));
  step.takes("self").keywords().takes(
      "out", outputs_type(), "Array (n,) of float64 for q, or two for q and velocity.", "None");
  define(
      player,
      [](Described<Player>& self, nb::handle out) {
        Outputs outputs(out, out.is_none() ? 0 : self.tracking().largest.size());
        Command command = self.step();
        outputs.write(command.q, command.velocity);
        return command;
      },
      step, nb::kw_only(), nb::arg("out") = nb::none());
  Signature speed("set_speed", "None", comment("Player::set_speed"));
  speed.takes("self").takes("speed", "float", "From 0, a pause, to 1.");
  define(
      player,
      [](Described<Player>& self, nb::handle value) {
        self.set_speed(Value<double>::from(value, "speed"));
      },
      speed, nb::arg("speed"));
  Signature measured("measured", "None", comment("Player::measured"));
  measured.takes("self").takes("q", array_like, configuration_doc);
  define(
      player, [](Described<Player>& self, nb::handle q) { self.measured(Numbers(q, "q")); },
      measured, nb::arg("q"));
}

void bind_state(nb::class_<Described<Player>>& player) {
  player.def_prop_ro("leading_in", &Player::leading_in,
                     "Whether it is on the motion to the recording's first sample.");
  player.def_prop_ro("done", &Player::done, "Whether it is at the recording's end.");
  player.def_prop_ro("speed", &Player::speed, "Current speed.");
  player.def_prop_ro("recording_time", &Player::recording_time,
                     "Current time of the recording, s.");
  player.def_prop_ro("tracking", &Player::tracking,
                     "The difference between measured and commanded positions.");
}

}  // namespace

void bind_players(nb::module_& m) {
  bind_record<Command>(m);
  bind_record<TrackingError>(m);
  nb::class_<Described<Player>> player = player_class(m);
  bind_loop(player);
  bind_state(player);
  bind_copies(player, "Player", "its arm, recording and options");
}

}  // namespace beeline::python
