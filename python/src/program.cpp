#include <map>

#include <beeline/io/program.h>
#include <beeline/io/text/numbers.h>

#include "bindings.h"
#include "collision_fields.h"
#include "interruption.h"
#include "plane_poses.h"
#include "pose_list_fields.h"
#include "program_fields.h"

namespace beeline::python {
namespace {

using NamedStates = std::map<std::string, Configuration>;

NamedStates states_from(const Arm& arm, nb::handle states) {
  NamedStates named;
  if (states.is_none()) return named;
  if (!nb::isinstance<nb::dict>(states)) raise_type("states", "a dict", states);
  for (const auto& [name, q] : nb::borrow<nb::dict>(states)) {
    const Configuration state = Value<Configuration>::from(q, "states");
    check_configuration(arm, state);
    named[Value<std::string>::from(name, "states")] = state;
  }
  return named;
}

/// The configuration that an item of the column q means.
Configuration configuration_of(const Arm& arm, const std::string& item, const NamedStates& states,
                               AngleUnit unit) {
  const auto named = states.find(item);
  if (named != states.end()) return named->second;
  const std::vector<double> values = parse_numbers(item, "q");
  Configuration q = Eigen::Map<const Configuration>(values.data(), Index(values.size()));
  check_configuration(arm, q);
  for (Index k = 0; k < q.size(); ++k) {
    const bool prismatic = kind(arm.joint_of(k)) == JointKind::prismatic;
    if (!prismatic) q[k] = to_radians(q[k], unit);
  }
  return q;
}

/// Throws FileError for a row whose pose does not have what the arm needs.
void check_forms(const Arm& arm, const ProgramRows& program) {
  for (const ProgramRow& row : program.rows) {
    if (!row.pose) continue;
    if (row.pose->planar && !arm.planar()) {
      throw FileError(program.path, row.line,
                      "x,y,theta is for planar arms; " + arm.name() +
                          " needs x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz");
    }
    if (!row.pose->oriented && row.motion != "via") {
      throw FileError(program.path, row.line, "the pose has no orientation");
    }
  }
}

Program loaded(nb::handle path, const Arm& arm, nb::handle unit_name, nb::handle states,
               nb::handle start, nb::handle millimetres, nb::handle former_unit) {
  refuse_former(former_unit, "unit", "angle_unit");
  const auto unit = Value<AngleUnit>::from(unit_name, "angle_unit");
  const PoseFormat format{.angle_unit = unit,
                          .millimetres = Value<bool>::from(millimetres, "millimetres")};
  const NamedStates named = states_from(arm, states);
  const ProgramRows rows = read_program_rows(path_from(path, "path"), format);
  check_forms(arm, rows);
  return program_of(
      arm, rows, [&](const std::string& item) { return configuration_of(arm, item, named, unit); },
      start.is_none() ? std::nullopt : std::optional(PosePlane(arm).pose(start, "start")));
}

void bind_load(nb::class_<Program>& program) {
  Signature load(
      "load", "Program",
      "Reads a program file: a CSV file whose header names columns of poses and some of motion, "
      "relative, q, speed, blend, dwell, part, touch. Raises FileError for invalid lines, which it "
      "names.");
  load.takes("path", path_like, "Path.")
      .takes_arm()
      .keywords()
      .takes("angle_unit", Value<AngleUnit>::type(), "Of angles in the file.", "'radians'")
      .takes("states", std::string("dict[str, ") + array_like + "] | None",
             "Configurations by the names that the column q may have.", "None")
      .takes("start", std::string(arm_pose_like) + " | None",
             std::string("The tool's pose where the motion starts, to which the first pose may be "
                         "relative. ") +
                 arm_pose_doc,
             "None")
      .takes("millimetres", "bool",
             "Positions of poses in the file are in millimetres; speeds and blends are in metres.",
             "False");
  define_static(program, &loaded, load, nb::arg("path"), nb::arg("arm"), nb::kw_only(),
                nb::arg("angle_unit") = "radians", nb::arg("states") = nb::none(),
                nb::arg("start") = nb::none(), nb::arg("millimetres") = false,
                nb::arg("unit") = nb::none());
}

}  // namespace

void bind_programs(nb::module_& m) {
  bind_record<Move>(m);
  bind_record<Attachment>(m);
  bind_record<AttachedPart>(m);
  nb::class_<Program> program = bind_record<Program>(m);
  bind_load(program);
  bind_record<PlannedMove>(m);
  bind_record<ProgramMotion>(m);
  Signature planned(
      "move_program", "ProgramMotion",
      "Plans the moves of a program as one trajectory from rest to rest. A joint move to a pose "
      "ends at a configuration from which the moves up to the next joint move are possible; no "
      "other move changes the branch. A move 'around' is a motion of move_around() in the scene of "
      "the model, with the parts that the tool carries. verify() proves the deviation of all moves "
      "except joint motions, with all pauses. Raises Error for a program that makes no sense, "
      "whose move it names.");
  planned.takes_arm()
      .takes("start", std::string(array_like) + " | None",
             "Configuration (n,); None: the motion begins at the first move's waypoint, which must "
             "belong to a joint motion or a line.")
      .takes("program", "Program", "Program.")
      .takes("model", "CollisionModel | None",
             "The arm in its scene, for moves 'around'. prove_clearance() proves the other moves.",
             "None")
      .options<PathMotionOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, const Program& moves, nb::handle scene,
         const nb::kwargs& keywords) {
        const auto begin = Value<std::optional<Configuration>>::from(start, "start");
        const auto* const model = Value<const CollisionModel*>::from(scene, "model");
        check_options_of(arm, keywords);
        auto asked = options<PathMotionOptions>(keywords);
        return unlocked(asked.budget,
                        [&] { return move_program(arm, begin, moves, asked, model); });
      },
      planned, nb::arg("arm"), nb::arg("start").none(), nb::arg("program"),
      nb::arg("model") = nb::none(), nb::arg("keywords"));
}

}  // namespace beeline::python
