#include "bindings.h"
#include "collision_fields.h"
#include "followed_program.h"
#include "interruption.h"
#include "program_fields.h"
#include "warning_category.h"

namespace beeline::python {
namespace {

/// Adds the arguments of a motion among obstacles, and of the program that it follows.
Signature& takes_motion(Signature& signature) {
  return signature.takes("model", "CollisionModel", "The arm among obstacles.")
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .takes("program", "Program | None",
             "The program that the trajectory follows: the parts that it attaches are carried, and "
             "each section is proved against the scene that there is then.",
             "None")
      .takes("arrivals", "Sequence[int] | None", arrivals_doc, "None");
}

void bind_clearance(nb::module_& m) {
  Signature proof(
      "prove_clearance", "ClearanceProof",
      "Proves or refutes that each pair of the model keeps its clearance at all times of "
      "the motion that the trajectory's columns mean, also between the samples. Warns if no pair "
      "counts, as nothing is checked then.");
  takes_motion(proof).options<ClearanceOptions>();
  define(
      m,
      [](const CollisionModel& model, const Trajectory& trajectory, nb::handle program,
         nb::handle arrivals, const nb::kwargs& keywords) {
        auto asked = options<ClearanceOptions>(keywords);
        const std::optional<FollowedProgram> followed = followed_from(program, arrivals);
        ClearanceProof found = unlocked(asked.budget, [&] {
          return followed ? prove_clearance(model, trajectory, *followed->program,
                                            followed->arrivals, asked)
                          : prove_clearance(model, trajectory, asked);
        });
        if (found.pairs == 0 && model.apart_count() == 0) {
          warn_of_input("no pair of bodies counts: nothing was checked");
        }
        return found;
      },
      proof, nb::arg("model"), nb::arg("trajectory"), nb::arg("program") = nb::none(),
      nb::arg("arrivals") = nb::none(), nb::arg("keywords"));

  Signature over_time("clearance_over_time", "ClearanceOverTime", comment("clearance_over_time"));
  takes_motion(over_time).options<BudgetOptions>();
  define(
      m,
      [](const CollisionModel& model, const Trajectory& trajectory, nb::handle program,
         nb::handle arrivals, const nb::kwargs& keywords) {
        Budget budget = options<BudgetOptions>(keywords).budget;
        const std::optional<FollowedProgram> followed = followed_from(program, arrivals);
        return unlocked(budget, [&] {
          return followed ? clearance_over_time(model, trajectory, *followed->program,
                                                followed->arrivals, budget)
                          : clearance_over_time(model, trajectory, budget);
        });
      },
      over_time, nb::arg("model"), nb::arg("trajectory"), nb::arg("program") = nb::none(),
      nb::arg("arrivals") = nb::none(), nb::arg("keywords"));
}

void bind_attached_parts(nb::module_& m) {
  Signature parts("attached_parts", "list[AttachedPart]",
                  "Returns where a trajectory attaches the parts of a program, in the order of "
                  "Program.attachments. Raises Error as prove_clearance() with a program does.");
  parts.takes("model", "CollisionModel", "The arm in the scene before.")
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .takes("program", "Program", "Program.")
      .takes("arrivals", "Sequence[int]", "The sample at which each move ends.");
  define(
      m,
      [](const CollisionModel& model, const Trajectory& trajectory, const Program& program,
         nb::handle ends) {
        return Value<std::vector<AttachedPart>>::to(attached_parts(
            model, trajectory, program, Value<std::vector<std::size_t>>::from(ends, "arrivals")));
      },
      parts, nb::arg("model"), nb::arg("trajectory"), nb::arg("program"), nb::arg("arrivals"));
}

}  // namespace

void bind_clearances(nb::module_& m) {
  bind_clearance(m);
  bind_attached_parts(m);
}

}  // namespace beeline::python
