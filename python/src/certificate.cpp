#include "bindings.h"
#include "collision_fields.h"
#include "interruption.h"
#include "plane_poses.h"
#include "program_fields.h"

namespace beeline::python {
namespace {

Verification verified(const Arm& arm, const Trajectory& trajectory, nb::handle along,
                      const nb::kwargs& keywords) {
  check_options_of(arm, keywords);
  auto asked = options<VerifyOptions>(keywords);
  if (along.is_none()) {
    return unlocked(asked.budget, [&] { return verify(arm, trajectory, asked); });
  }
  const Route* route = nullptr;
  if (nb::try_cast<const Route*>(along, route) && route) {
    return unlocked(asked.budget, [&] { return verify(arm, trajectory, *route, asked); });
  }
  const Program* program = nullptr;
  if (nb::try_cast<const Program*>(along, program) && program) {
    return unlocked(asked.budget, [&] { return verify(arm, trajectory, *program, asked); });
  }
  const std::vector<Pose> waypoints = PosePlane(arm).poses(along, "along");
  return unlocked(asked.budget, [&] { return verify(arm, trajectory, waypoints, asked); });
}

void bind_verify(nb::module_& m) {
  Signature proof(
      "verify", "Verification",
      "Proves or refutes, from the columns alone, that a trajectory moves the tool along the whole "
      "route within the arm's limits, whichever program computed it: its deviation from the path "
      "at all times, its direction along it, and the limits of position, velocity, acceleration "
      "and jerk between the samples too. Limits of velocity and acceleration that are not known "
      "count as assumed; a jerk limit that is not known is not checked. Of a program also its "
      "waypoints, dwells and tool speeds.");
  proof.takes_arm()
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .takes("along", std::string("Route | Program | ") + arm_poses_like + " | None",
             "A route; a program; or waypoints (N, 4, 4), world_T_tool, of straight lines from the "
             "trajectory's first pose; of a planar arm also (N, 3), x, y, theta each. None: the "
             "limits of the joints only.",
             "None")
      .options<VerifyOptions>();
  define(m, &verified, proof, nb::arg("arm"), nb::arg("trajectory"), nb::arg("along") = nb::none(),
         nb::arg("keywords"));

  Signature fault("first_joint_fault", "JointFault | None",
                  "Returns the first fault in time of a trajectory's joints: limits, flip, "
                  "velocity, acceleration, jerk or moving; None if there is none, or where the "
                  "budget ends the search before it.");
  fault.takes_arm()
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .takes("moving", argument_type<MovingEnds>(), "The ends at which the joints may move.",
             "(False, False)")
      .options<BudgetOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle moving,
         const nb::kwargs& keywords) {
        const auto ends = Value<MovingEnds>::from(moving, "moving");
        Budget budget = options<BudgetOptions>(keywords).budget;
        return Value<std::optional<JointFault>>::to(unlocked(budget, [&] {
          return first_joint_fault(arm, matched_to(arm, trajectory), ends, budget);
        }));
      },
      fault, nb::arg("arm"), nb::arg("trajectory"),
      nb::arg("moving") = nb::make_tuple(false, false), nb::arg("keywords"));
}

void bind_path_deviation(nb::module_& m) {
  Signature bound("path_deviation", "PathDeviation", comment("path_deviation"));
  bound.takes_arm()
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .takes("path_parameters", array_like, "Path parameter of each sample, (N,).")
      .takes("path", "ToolPath", "Path.")
      .takes("task", "str", "Rows that matter.", "'spatial'")
      .options<BudgetOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle path_parameters,
         const ToolPath& path, nb::handle task, const nb::kwargs& keywords) {
        const auto parameters =
            Value<std::vector<double>>::from(path_parameters, "path_parameters");
        const Task rows = Value<Task>::from(task, "task");
        Budget budget = options<BudgetOptions>(keywords).budget;
        return unlocked(budget, [&] {
          return path_deviation(arm, matched_to(arm, trajectory), parameters, path, rows, budget);
        });
      },
      bound, nb::arg("arm"), nb::arg("trajectory"), nb::arg("path_parameters"), nb::arg("path"),
      nb::arg("task") = "spatial", nb::arg("keywords"));
}

void bind_path_parameters(nb::module_& m) {
  Signature parameters("path_parameters_along", array_type, comment("path_parameters_along"));
  parameters.takes_arm()
      .takes("samples", array_like, "Configurations (N, n).")
      .takes("path", "ToolPath", "Path.")
      .takes("arrivals", array_like, "The sample at the end of each segment.")
      .takes("task", "str", "Rows that matter.", "'spatial'");
  define(
      m,
      [](const Arm& arm, nb::handle samples, const ToolPath& path, nb::handle at_ends,
         nb::handle task) {
        const auto configurations = Value<std::vector<Configuration>>::from(samples, "samples");
        for (const Configuration& q : configurations) check_configuration(arm, q);
        return Value<std::vector<double>>::to(path_parameters_along(
            arm, configurations, path, Value<std::vector<std::size_t>>::from(at_ends, "arrivals"),
            Value<Task>::from(task, "task")));
      },
      parameters, nb::arg("arm"), nb::arg("samples"), nb::arg("path"), nb::arg("arrivals"),
      nb::arg("task") = "spatial");

  Signature ends("arrivals", Value<std::vector<std::size_t>>::type(), comment("arrivals"));
  ends.takes("path_parameters", array_like, "Path parameter of each sample, (N,).");
  define(
      m,
      [](nb::handle path_parameters) {
        const auto given = Value<std::vector<double>>::from(path_parameters, "path_parameters");
        const double most = static_cast<double>(given.size()) + 1e6;
        for (double parameter : given) {
          if (parameter >= 0 && parameter <= most) continue;
          throw Error("path_parameters: " + number(parameter) + " is not a path parameter");
        }
        return Value<std::vector<std::size_t>>::to(arrivals(given));
      },
      ends, nb::arg("path_parameters"));
}

}  // namespace

void bind_certificates(nb::module_& m) {
  bind_record<MovingEnds>(m);
  bind_record<JointFault>(m);
  bind_record<FaultsOfKind>(m);
  bind_record<PathDeviation>(m);
  bind_record<Verification>(m);
  bind_path_deviation(m);
  bind_path_parameters(m);
  bind_verify(m);
}

}  // namespace beeline::python
