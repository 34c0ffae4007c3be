#include <beeline/io/trajectory_file.h>

#include "bindings.h"
#include "interruption.h"
#include "recording_fields.h"

namespace beeline::python {

nb::object Value<StateColumn>::to(const StateColumn& value) {
  NewArray array(value.shape);
  std::copy(value.values.begin(), value.values.end(), array.data());
  return array.release_read_only();
}

StateColumn Value<StateColumn>::from(nb::handle value, const char* name) {
  const InputArray array(value, name);
  return {{array.shape().begin(), array.shape().end()},
          {array.data(), array.data() + array.size()}};
}

namespace {

void make_trajectory(Trajectory* self, nb::handle joint_names, nb::handle times,
                     nb::handle positions, nb::handle velocities, nb::handle accelerations) {
  const auto column = [](nb::handle value, const char* name) {
    using Column = std::vector<Configuration>;
    return value.is_none() ? Column() : Value<Column>::from(value, name);
  };
  Trajectory made{Value<std::vector<std::string>>::from(joint_names, "joint_names"),
                  Value<std::vector<double>>::from(times, "times"), column(positions, "positions"),
                  column(velocities, "velocities"), column(accelerations, "accelerations")};
  check_trajectory(made);
  new (self) Trajectory(std::move(made));
}

States sampled_states(const Trajectory& trajectory, nb::handle t, nb::handle side_name) {
  const InputArray times(t, "t");
  const Side side = Value<Side>::from(side_name, "side");
  States states;
  StateColumn* const columns[] = {&states.position, &states.velocity, &states.acceleration,
                                  &states.jerk};
  for (StateColumn* column : columns) {
    column->shape.assign(times.shape().begin(), times.shape().end());
    column->shape.push_back(static_cast<Index>(trajectory.joint_names.size()));
    column->values.reserve(static_cast<std::size_t>(times.size()) * trajectory.joint_names.size());
  }
  for (Index i = 0; i < times.size(); ++i) {
    const TrajectoryState state = sample(trajectory, times.data()[i], side);
    const Configuration* const parts[] = {&state.position, &state.velocity, &state.acceleration,
                                          &state.jerk};
    for (int k = 0; k < 4; ++k) {
      columns[k]->values.insert(columns[k]->values.end(), parts[k]->begin(), parts[k]->end());
    }
  }
  return states;
}

void bind_samples(nb::class_<Trajectory>& trajectory) {
  trajectory.def("__len__", &Trajectory::size, "Number of samples.");
  trajectory.def_prop_ro(
      "interpolation",
      [](const Trajectory& self) { return Value<Interpolation>::to(self.interpolation()); },
      getter("interpolation", Value<Interpolation>::type()),
      "The motion between the samples: polynomials of degree 1, 3 or 5 in time.");
  trajectory.def_prop_ro(
      "duration", [](const Trajectory& self) { return self.duration(); },
      "From the first sample to the last, s.");

  Signature states("sample", "TrajectoryState", comment("sample"));
  states.takes("self")
      .takes("t", array_like, "Time, s; or times of any shape.")
      .keywords()
      .takes("side", Value<Side>::type(),
             "The side of t at which derivatives are taken. They may differ at a sample.",
             "'after'");
  define(trajectory, &sampled_states, states, nb::arg("t"), nb::kw_only(),
         nb::arg("side") = "after");

  Signature matched("matched_to", "Trajectory", comment("matched_to"));
  matched.takes("self").takes_arm();
  takes_matching(matched);
  define(
      trajectory,
      [](const Trajectory& self, const Arm& arm, nb::handle joint_map, nb::handle angle_unit,
         nb::handle unit) {
        return matched_to(arm, self, matching(arm, joint_map, angle_unit, unit));
      },
      matched, nb::arg("arm"), nb::kw_only(), nb::arg("joint_map") = nb::none(),
      nb::arg("angle_unit") = nb::none(), nb::arg("unit") = nb::none());

  Signature turned("unwrapped", "Unwrapped",
                   "Returns the trajectory, matched to the arm, without the jumps of sensors whose "
                   "values wrap after a revolution. Whole revolutions are taken out of continuous "
                   "joints where only that keeps the velocity limits, known or assumed. Raises "
                   "Error for a trajectory that does not belong to the arm.");
  turned.takes("self").takes_arm();
  define(
      trajectory, [](const Trajectory& self, const Arm& arm) { return unwrapped(arm, self); },
      turned, nb::arg("arm"));
}

void bind_files(nb::class_<Trajectory>& trajectory) {
  Signature save("save", "None",
                 "Writes the trajectory to a .csv, .json or .yaml file, which is replaced as a "
                 "whole. Numbers read back exactly, times of the latter two to the nanosecond.");
  save.takes("self").takes("path", path_like, "Its ending determines the format.");
  define(
      trajectory,
      [](const Trajectory& self, nb::handle path) {
        const std::string file = path_from(path, "path");
        const LockRelease release;
        write_trajectory(file, self);
      },
      save, nb::arg("path"));
}

void bind_limit_usage(nb::module_& m) {
  Signature rest("at_rest", "Trajectory", comment("at_rest"));
  rest.takes_arm().takes("q", array_like, "Configuration (n,).");
  define(
      m,
      [](const Arm& arm, nb::handle q) { return at_rest(arm, Value<Configuration>::from(q, "q")); },
      rest, nb::arg("arm"), nb::arg("q"));

  Signature usage("limit_usage", "LimitUsage", comment("limit_usage"));
  usage.takes_arm()
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .options<BudgetOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, const nb::kwargs& keywords) {
        Budget budget = options<BudgetOptions>(keywords).budget;
        return unlocked(budget, [&] { return limit_usage(arm, trajectory, budget); });
      },
      usage, nb::arg("arm"), nb::arg("trajectory"), nb::arg("keywords"));
}

void bind_recoveries(nb::module_& m) {
  bind_record<Recovery>(m);
  Signature found("recovery_of", "Recovery | None", comment("recovery_of"));
  found.takes_arm().takes("trajectory", "Trajectory", "Its joints are matched by name.");
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory) {
        return Value<std::optional<Recovery>>::to(recovery_of(arm, trajectory));
      },
      found, nb::arg("arm"), nb::arg("trajectory"));
  Signature accepted("accepted_recovery", "Recovery | None", comment("accepted_recovery"));
  accepted.takes_arm().takes("trajectory", "Trajectory", "Its joints are matched by name.");
  accepted.takes("recover", "float", "Largest excess, rad or m.");
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle recover) {
        return Value<std::optional<Recovery>>::to(
            accepted_recovery(arm, trajectory, Value<double>::from(recover, "recover")));
      },
      accepted, nb::arg("arm"), nb::arg("trajectory"), nb::arg("recover"));
  Signature slight("slight_excess", "float", comment("slight_excess"));
  slight.takes_arm();
  define(
      m, [](const Arm& arm) { return slight_excess(arm); }, slight, nb::arg("arm"));
  Signature nearest("nearest_within_limits", array_type, comment("nearest_within_limits"));
  nearest.takes_arm().takes("q", array_like, "Configuration (n,).");
  define(
      m,
      [](const Arm& arm, nb::handle q) {
        return Value<Configuration>::to(
            nearest_within_limits(arm, Value<Configuration>::from(q, "q")));
      },
      nearest, nb::arg("arm"), nb::arg("q"));
}

void bind_slowdowns(nb::module_& m) {
  Signature slower("slow_down", "Trajectory",
                   "Returns the trajectory slowed down by k: times are multiplied by it, "
                   "velocities divided, accelerations divided by its square.");
  slower.takes("trajectory", "Trajectory", "The trajectory.")
      .takes("k", "float", "A factor of 1 or less changes nothing.");
  define(
      m,
      [](const Trajectory& trajectory, nb::handle k) {
        const double factor = Value<double>::from(k, "k");
        if (!std::isfinite(factor)) throw Error("k is not finite: " + number(factor));
        Trajectory result = trajectory;
        slow_down(result, factor);
        check_trajectory(result);
        return result;
      },
      slower, nb::arg("trajectory"), nb::arg("k"));
  Signature factor("slowdown_factor", "float", comment("slowdown_factor"));
  factor.takes("velocity", "float", "Fraction of the velocity limits.")
      .takes("acceleration", "float", "Fraction of the acceleration limits.")
      .takes("jerk", "float", "Fraction of the jerk limits.");
  define(
      m,
      [](nb::handle velocity, nb::handle acceleration, nb::handle jerk) {
        return slowdown_factor(Value<double>::from(velocity, "velocity"),
                               Value<double>::from(acceleration, "acceleration"),
                               Value<double>::from(jerk, "jerk"));
      },
      factor, nb::arg("velocity"), nb::arg("acceleration"), nb::arg("jerk"));
}

void bind_comparisons(nb::module_& m) {
  Signature compared("difference", "TrajectoryDifference", comment("difference"));
  compared.takes_arm()
      .takes("a", "Trajectory", "The first trajectory.")
      .takes("b", "Trajectory", "The second one.");
  define(
      m,
      [](const Arm& arm, const Trajectory& a, const Trajectory& b) {
        const LockRelease release;
        return difference(arm, a, b);
      },
      compared, nb::arg("arm"), nb::arg("a"), nb::arg("b"));
}

}  // namespace

void bind_trajectories(nb::module_& m) {
  bind_record<States>(m);
  bind_record<MappedJoint>(m);
  nb::class_<Trajectory> trajectory = bind_record<Trajectory>(m);
  Signature made("__init__", "None",
                 "Makes a trajectory of N samples. Raises Error for times that do not increase.");
  made.takes("self")
      .takes("joint_names", "list[str]", "Of n joints.")
      .takes("times", array_like, "Seconds, (N,).")
      .takes("positions", array_like, "rad or m, (N, n).")
      .takes("velocities", std::string(array_like) + " | None", "Per second, (N, n).", "None")
      .takes("accelerations", std::string(array_like) + " | None", "Likewise.", "None");
  define(trajectory, &make_trajectory, made, nb::arg("joint_names"), nb::arg("times"),
         nb::arg("positions"), nb::arg("velocities") = nb::none(),
         nb::arg("accelerations") = nb::none());
  bind_samples(trajectory);
  bind_loading(trajectory);
  bind_files(trajectory);
  bind_recordings(m);
  bind_record<UnwrappedJoint>(m);
  bind_record<Unwrapped>(m);
  bind_record<JointDifference>(m);
  bind_record<TrajectoryDifference>(m);
  bind_record<LimitFraction>(m);
  bind_record<LimitUsage>(m);
  bind_limit_usage(m);
  bind_recoveries(m);
  bind_slowdowns(m);
  bind_comparisons(m);
}

}  // namespace beeline::python
