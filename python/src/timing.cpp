#include <cmath>

#include "bindings.h"
#include "interruption.h"
#include "timing_fields.h"

namespace beeline::python {

void Fields<PointToPoint>::check(const PointToPoint& motion) {
  const auto joints = static_cast<Index>(motion.curves.size());
  if (motion.from.size() == joints && motion.to.size() == joints) return;
  throw Error("a motion of " + std::to_string(joints) + " curves has configurations of " +
              std::to_string(motion.from.size()) + " and " + std::to_string(motion.to.size()));
}

namespace {

States states_of(const PointToPoint& motion, nb::handle t) {
  const InputArray times(t, "t");
  const auto joints = static_cast<Index>(motion.curves.size());
  States states;
  StateColumn* const columns[] = {&states.position, &states.velocity, &states.acceleration,
                                  &states.jerk};
  for (StateColumn* column : columns) {
    column->shape.assign(times.shape().begin(), times.shape().end());
    column->shape.push_back(joints);
    column->values.resize(static_cast<std::size_t>(times.size() * joints));
  }
  for (Index i = 0; i < times.size(); ++i) {
    const auto row = [&](int k) {
      return Eigen::Map<Configuration>(columns[k]->values.data() + i * joints, joints);
    };
    at(motion, times.data()[i], row(0), row(1), row(2));
    for (Index j = 0; j < joints; ++j) row(3)[j] = at(motion.curves[j], times.data()[i]).jerk;
  }
  return states;
}

PointToPoint planned(nb::handle arm, nb::handle from, nb::handle to, nb::handle synchronise,
                     nb::handle from_outside) {
  const Configuration begin = Value<Configuration>::from(from, "from_");
  const Configuration end = Value<Configuration>::from(to, "to");
  const PointToPointOptions options{Value<Synchronise>::from(synchronise, "synchronise"),
                                    Value<bool>::from(from_outside, "from_outside")};
  if (const Arm* given = arm_of(arm)) return point_to_point(*given, begin, end, options);
  PointToPoint motion;
  point_to_point(Value<std::vector<Limits>>::from(arm, "arm"), begin, end, motion, options);
  return motion;
}

void bind_curves(nb::module_& m) {
  nb::class_<SCurve> curve = bind_record<SCurve>(m);
  bind_record<JointState>(m);
  Signature made("s_curve", "SCurve", comment("s_curve"));
  made.takes("distance", "float", "rad or m.")
      .takes("limits", "Limits", "Position limits are ignored; at least one other is finite.");
  define(
      m,
      [](nb::handle distance, const Limits& limits) {
        return s_curve(Value<double>::from(distance, "distance"), limits);
      },
      made, nb::arg("distance"), nb::arg("limits"));
  Signature longer("stretched", "SCurve", comment("stretched"));
  longer.takes("self").takes("duration", "float", "s, not shorter than the curve's own.");
  define(
      curve,
      [](const SCurve& self, nb::handle duration) {
        return stretched(self, Value<double>::from(duration, "duration"));
      },
      longer, nb::arg("duration"));
  Signature state("at", "JointState",
                  "Returns the state at time t. At rest until 0 and from the duration on.");
  state.takes("self").takes("t", "float", "s.");
  define(
      curve, [](const SCurve& self, nb::handle t) { return at(self, Value<double>::from(t, "t")); },
      state, nb::arg("t"));
}

void bind_point_to_point(nb::module_& m) {
  nb::class_<PointToPoint> motion = bind_record<PointToPoint>(m);
  Signature state(
      "sample", "TrajectoryState",
      "Returns the state at time t. It is exactly `from_` until 0, and `to` from the duration on.");
  state.takes("self").takes("t", array_like, "Time, s; or times of any shape.");
  define(motion, &states_of, state, nb::arg("t"));

  Signature made("point_to_point", "PointToPoint",
                 "Minimises the duration of a motion from rest to rest subject to the joints' "
                 "limits on velocity, acceleration and jerk. Unknown limits of an arm are assumed; "
                 "of a list of limits, infinite limits of acceleration and jerk do not bind.");
  made.takes("arm", "Arm | str | collections.abc.Sequence[Limits]",
             "The arm, or the limits of each coordinate.")
      .takes("from_", array_like, "Configuration (n,).")
      .takes("to", array_like, "Configuration (n,).")
      .keywords()
      .member<&PointToPointOptions::synchronise>()
      .member<&PointToPointOptions::from_outside>();
  define(m, &planned, made, nb::arg("arm"), nb::arg("from_"), nb::arg("to"), nb::kw_only(),
         nb::arg("synchronise") = "time", nb::arg("from_outside") = false);

  Signature samples("sampled", "Trajectory",
                    "Samples the motion at times k / rate, slowed down to whole periods and one "
                    "more: the quintics between the samples are within the arm's limits at all "
                    "times. The first sample is exactly `from_`, the last `to`; one sample where "
                    "nothing moves; none where the budget ends it.");
  samples.takes_arm()
      .takes("motion", "PointToPoint", "Of the arm.")
      .takes("rate", "float", "Samples per second, above 0.")
      .options<BudgetOptions>();
  define(
      m,
      [](const Arm& arm, const PointToPoint& planned, nb::handle rate, const nb::kwargs& keywords) {
        const double per_second = Value<double>::from(rate, "rate");
        Budget budget = options<BudgetOptions>(keywords).budget;
        return unlocked(budget, [&] { return sampled(arm, planned, per_second, budget); });
      },
      samples, nb::arg("arm"), nb::arg("motion"), nb::arg("rate"), nb::arg("keywords"));
}

void bind_time_scaling(nb::module_& m) {
  bind_record<PathLimits>(m);
  nb::class_<TimeScaling> scaling = bind_record<TimeScaling>(m);
  scaling.def_prop_ro("duration", &TimeScaling::duration, "s.");
  Signature of_arm("path_limits", "PathLimits", comment("path_limits"));
  of_arm.takes_arm().member<&RetimeOptions::speed_scale>();
  define(
      m,
      [](const Arm& arm, nb::handle speed_scale) {
        return path_limits(arm, Value<double>::from(speed_scale, "speed_scale"));
      },
      of_arm, nb::arg("arm"), nb::arg("speed_scale") = 1.0);
  Signature scaled("time_scaling", "TimeScaling", comment("time_scaling"));
  scaled.takes("path", "JointPath", "Path.")
      .takes("limits", "PathLimits", "Limits.")
      .choice<Profile>("profile", "Form of s(t).", "'jerk'")
      .options<BudgetOptions>();
  define(
      m,
      [](const JointPath& path, const PathLimits& limits, nb::handle profile,
         const nb::kwargs& keywords) {
        const Profile form = Value<Profile>::from(profile, "profile");
        Budget budget = options<BudgetOptions>(keywords).budget;
        return unlocked(budget, [&] { return time_scaling(path, limits, form, budget); });
      },
      scaled, nb::arg("path"), nb::arg("limits"), nb::arg("profile") = "jerk", nb::arg("keywords"));
}

}  // namespace

void bind_timing(nb::module_& m) {
  bind_curves(m);
  bind_point_to_point(m);
  bind_time_scaling(m);
  bind_record<Retimed>(m);
  Signature retimed("retime", "Retimed", comment("retime"));
  retimed.summary_has_motions()
      .takes_arm()
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .options<RetimeOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, const nb::kwargs& keywords) {
        auto asked = options<RetimeOptions>(keywords);
        return unlocked(asked.budget, [&] { return retime(arm, trajectory, asked); });
      },
      retimed, nb::arg("arm"), nb::arg("trajectory"), nb::arg("keywords"));
  Signature through("move_through", "Retimed", comment("move_through"));
  through.summary_has_motions()
      .takes_arm()
      .takes("waypoints", argument_type<std::vector<Configuration>>(), "Configurations (N, n).")
      .options<RetimeOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle waypoints, const nb::kwargs& keywords) {
        const auto given = Value<std::vector<Configuration>>::from(waypoints, "waypoints");
        auto asked = options<RetimeOptions>(keywords);
        return unlocked(asked.budget, [&] { return move_through(arm, given, asked); });
      },
      through, nb::arg("arm"), nb::arg("waypoints"), nb::arg("keywords"));
  Signature assumed(
      "motion_limits", "Limits",
      "Returns the limits that motions keep: the joint's own where they are known, else the "
      "assumed ones: 1 rad/s or m/s, reached in 0.25 s, and full acceleration in 0.1 s.");
  assumed.takes("limits", "Limits", "Of one joint.");
  define(
      m, [](const Limits& limits) { return motion_limits(limits); }, assumed, nb::arg("limits"));
}

}  // namespace beeline::python
