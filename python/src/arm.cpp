#include <cmath>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/pose_list.h>

#include "arm_fields.h"
#include "bindings.h"
#include "plane_poses.h"
#include "reason.h"
#include "warning_category.h"

namespace beeline::python {
namespace {

/// Records, or the rows of an array.
std::vector<DhRow> dh_rows(nb::handle value) {
  const bool records = is_list(value);
  if (records && (nb::len(value) == 0 || nb::isinstance<DhRow>(value[0]))) {
    return Value<std::vector<DhRow>>::from(value, "rows");
  }
  const auto table = finite_from<Eigen::Matrix<double, Eigen::Dynamic, 4>>(value, "rows");
  std::vector<DhRow> rows;
  for (const auto& row : table.rowwise()) {
    rows.push_back({row[0], row[1], row[2], row[3], JointKind::revolute});
  }
  return rows;
}

/// Issues a warning for an angle that is more than a revolution.
void warn_of_degrees(const std::vector<DhRow>& rows) {
  for (const DhRow& row : rows) {
    const double angle = std::max(std::abs(row.alpha), std::abs(row.theta));
    if (angle <= plausible_angle) continue;
    return warn_of_input("rows: an angle of " + number(angle) +
                         " rad is more than a revolution; alpha and theta are in radians");
  }
}

Arm arm_of_table(nb::handle rows, const std::string& convention, const std::string& name,
                 nb::handle limits) {
  const auto named = Value<DhConvention>::from(nb::str(convention.c_str()), "convention");
  const std::vector<DhRow> table = dh_rows(rows);
  const auto list = Value<std::optional<std::vector<Limits>>>::from(limits, "limits");
  if (list && list->empty() && !table.empty()) throw Error("limits is empty; omit it");
  warn_of_degrees(table);
  return arm_from_dh(name, table, named, list.value_or(std::vector<Limits>()));
}

/// One limit of all coordinates.
nb::object limits_of(const Arm& arm, double Limits::*limit) {
  Configuration values(arm.dof());
  for (Index k = 0; k < values.size(); ++k) values[k] = arm.limits(k).*limit;
  return Value<Configuration>::to(values);
}

/// Limits by joint name: a dict of LimitOverrides or of dicts of their members, or the path of a
/// file.
Arm arm_with_limits(const Arm& arm, nb::handle limits) {
  if (!nb::isinstance<nb::dict>(limits)) {
    const JointLimits file = read_joint_limits(path_from(limits, "limits"), arm);
    for (const std::string& note : file.notes) warn_of_input(note);
    return with_limits(arm, file.joints);
  }
  std::map<std::string, LimitOverrides> named;
  for (const auto& [joint, overrides] : nb::borrow<nb::dict>(limits)) {
    LimitOverrides& own = named[Value<std::string>::from(joint, "joint")];
    own = nb::isinstance<nb::dict>(overrides)
              ? options<LimitOverrides>(nb::borrow<nb::kwargs>(overrides))
              : Value<LimitOverrides>::from(overrides, "limits");
  }
  return with_limits(arm, named);
}

std::string printed(const Arm& arm) {
  std::string table = arm_table(arm);
  table.pop_back();  // the end of its last line
  return table;
}

/// Arms of other descriptions.
void bind_descriptions(nb::class_<Arm>& arm) {
  Signature dh("from_dh", "Arm", "Returns the arm of a Denavit-Hartenberg table.");
  dh.takes("rows", std::string("collections.abc.Sequence[DhRow] | ") + array_like,
           "One row for each joint; or an array (n, 4) with the columns a, alpha, d, theta, m and "
           "rad, of revolute joints.")
      .keywords()
      .choice<DhConvention>("convention", "A table does not show which one it uses.")
      .takes("name", "str", "Name of the arm.", "'arm'")
      .takes("limits", "list[Limits] | None", "One for each joint.", "None");
  define_static(
      arm,
      [](nb::handle rows, nb::handle convention, nb::handle name, nb::handle limits) {
        return arm_of_table(rows, Value<std::string>::from(convention, "convention"),
                            Value<std::string>::from(name, "name"), limits);
      },
      dh, nb::arg("rows"), nb::kw_only(), nb::arg("convention"), nb::arg("name") = "arm",
      nb::arg("limits") = nb::none());

  Signature string("from_string", "Arm",
                   "Returns the arm of a joint string, such as `RRR:3.5,3.5,2` or `RRRRRR`.");
  string.takes("text", "str", "Letters R P H S C E U, then a length in m for each.");
  define_static(
      arm,
      [](nb::handle text) { return arm_from_joint_string(Value<std::string>::from(text, "text")); },
      string, nb::arg("text"));

  Signature json("from_json", "Arm", "Returns the arm of a text that to_json() returned.");
  json.takes("text", "str", "JSON.");
  define_static(
      arm,
      [](nb::handle text) {
        std::vector<ReadWarning> warnings;
        Arm read = arm_from_json(Value<std::string>::from(text, "text"), "JSON", &warnings);
        for (const ReadWarning& warning : warnings) warn_of_input(sentence(warning));
        return read;
      },
      json, nb::arg("text"));
}

template <class Get>
void property(nb::class_<Arm>& arm, const char* name, const std::string& type, Get get,
              const char* doc) {
  arm.def_prop_ro(name, get, getter(name, type), doc);
}

template <class M>
void limit_property(nb::class_<Arm>& arm, const char* name, M Limits::*limit, const char* doc) {
  property(
      arm, name, array_type, [limit](const Arm& self) { return read_only(limits_of(self, limit)); },
      doc);
}

void bind_frames(nb::class_<Arm>& arm) {
  property(
      arm, "base", array_type,
      [](const Arm& self) { return read_only(Value<Pose>::to(self.base())); },
      "Pose of link 0 in the world (4, 4).");
  property(
      arm, "tool", array_type,
      [](const Arm& self) { return read_only(Value<Pose>::to(self.tool())); },
      "Pose of the tool in the last link (4, 4).");
  property(
      arm, "home", array_type,
      [](const Arm& self) { return read_only(Value<Pose>::to(home_pose(self))); },
      "Pose of the tool in the world at zero joint values (4, 4).");
  property(
      arm, "controller_base", array_type,
      [](const Arm& self) { return read_only(Value<Pose>::to(self.controller().base)); },
      "Pose in the world of the controller's root frame (4, 4): $ROBROOT of KUKA, the base frame "
      "of ABB and of Universal Robots.");
  property(
      arm, "controller_base_assumed", "bool",
      [](const Arm& self) { return self.controller().base_assumed; },
      "Whether no description states `controller_base`.");
  property(
      arm, "flange", array_type,
      [](const Arm& self) { return read_only(Value<Pose>::to(self.controller().flange)); },
      "Pose in the last link of the robot's mounting flange, the frame that controllers take tools "
      "in (4, 4).");
  property(
      arm, "flange_assumed", "bool",
      [](const Arm& self) { return self.controller().flange_assumed; },
      "Whether no description states `flange`.");
}

void bind_properties(nb::class_<Arm>& arm) {
  property(
      arm, "name", "str", [](const Arm& self) { return self.name(); }, "Name of the arm.");
  property(
      arm, "dof", "int", [](const Arm& self) { return self.dof(); },
      "Number of coordinates. Every joint except the mimic joints has one.");
  property(
      arm, "joints", "list[Joint]",
      [](const Arm& self) { return Value<std::vector<Joint>>::to(self.joints()); },
      "All joints, mimic joints included.");
  property(
      arm, "joint_names", "list[str]",
      [](const Arm& self) { return Value<std::vector<std::string>>::to(self.joint_names()); },
      "Name of the joint of each coordinate.");
  property(
      arm, "limits", "list[Limits]",
      [](const Arm& self) { return Value<std::vector<Limits>>::to(self.limits()); },
      "Limits of each coordinate, tightened so that mimic joints stay within theirs.");
  limit_property(arm, "lower", &Limits::lower, "Lower position limits, rad or m, (n,).");
  limit_property(arm, "upper", &Limits::upper, "Upper position limits, rad or m, (n,).");
  limit_property(arm, "velocity", &Limits::velocity, "Velocity limits; inf where unknown, (n,).");
  limit_property(arm, "acceleration", &Limits::acceleration,
                 "Acceleration limits; inf where unknown, (n,).");
  limit_property(arm, "jerk", &Limits::jerk, "Jerk limits; inf where unknown, (n,).");
  property(
      arm, "middle", array_type,
      [](const Arm& self) {
        return read_only(Value<Configuration>::to(middle_configuration(self)));
      },
      "Middle of each coordinate's limits, or the value nearest to zero where one is infinite, "
      "(n,).");
  property(
      arm, "planar", "bool", [](const Arm& self) { return self.planar(); },
      "Whether all motion is in one plane z = constant.");
  property(
      arm, "reach", "tuple[numpy.typing.NDArray[numpy.float64], float]",
      [](const Arm& self) {
        return nb::make_tuple(Value<Vector3>::to(self.reach().centre), self.reach().radius);
      },
      "Centre (3,) and radius of a sphere in the world that contains the tool's origin in every "
      "configuration within the limits.");
}

void bind_copies(nb::class_<Arm>& arm) {
  Signature tool("with_tool", "Arm", comment("with_tool"));
  tool.takes("self").takes("tool", arm_pose_like,
                           std::string("In the last link. ") + arm_frame_doc);
  define(
      arm,
      [](const Arm& self, nb::handle pose) {
        return with_tool(self, PosePlane::frame(self, pose, "tool"));
      },
      tool, nb::arg("tool"));
  Signature tcp("with_tcp", "Arm",
                "Returns a copy with a tool centre point (TCP), given in the frame that has been "
                "the tool's: the flange of an arm described without a tool.");
  tcp.takes("self").takes("tool_T_tcp", arm_pose_like,
                          std::string("Of the new tool in it. ") + arm_frame_doc);
  define(
      arm,
      [](const Arm& self, nb::handle pose) {
        return with_tcp(self, PosePlane::frame(self, pose, "tool_T_tcp"));
      },
      tcp, nb::arg("tool_T_tcp"));
  Signature mount("with_mount", "Arm",
                  "Returns a copy that stands in the world: at this pose of the frame that has "
                  "been the world.");
  mount.takes("self").takes("world_T_mount", arm_pose_like,
                            std::string("Of the former world. ") + arm_frame_doc);
  define(
      arm,
      [](const Arm& self, nb::handle pose) {
        return with_mount(self, PosePlane::frame(self, pose, "world_T_mount"));
      },
      mount, nb::arg("world_T_mount"));
  Signature limits("with_limits", "Arm", "Returns a copy in which joints have other limits.");
  limits.takes("self").takes(
      "limits",
      std::string("collections.abc.Mapping[str, LimitOverrides | dict[str, float]] | ") + path_like,
      "By joint name, such as `{\"joint1\": {\"lower\": -1, \"upper\": 1}}`; "
      "or a file: MoveIt's joint_limits.yaml, or JSON.");
  define(arm, &arm_with_limits, limits, nb::arg("limits"));
  Signature scale("with_speed_scale", "Arm",
                  "Returns a copy whose velocity limits are multiplied by k, acceleration limits "
                  "by k^2, jerk limits by k^3.");
  scale.takes("self").takes("k", "float", "From 1e-6 to 1.");
  define(
      arm,
      [](const Arm& self, nb::handle k) {
        return with_speed_scale(self, Value<double>::from(k, "k"));
      },
      scale, nb::arg("k"));
  Signature outside("limit_violations", "list[Reason]",
                    "Returns a reason for each joint that is outside its position limits.");
  outside.takes("self").takes("q", array_like, "Configuration (n,).");
  define(
      arm,
      [](const Arm& self, nb::handle q) {
        return Value<std::vector<Reason>>::to(
            limit_violations(self, Value<Configuration>::from(q, "q")));
      },
      outside, nb::arg("q"));
}

/// Throws the error of Arm("panda"), Arm("RRR:1,1,1") and Arm(path), which says what reads them.
[[noreturn]] void refuse_without_joints(nb::handle name) {
  const bool path = nb::isinstance<nb::str>(name) || nb::hasattr(name, "__fspath__");
  const std::string source = path ? nb::repr(nb::str(name)).c_str() : "\"panda\"";
  throw nb::type_error(("Arm() needs the argument joints; Arm.load(" + source +
                        ") reads a built-in arm, a joint string or a file")
                           .c_str());
}

void bind_constructor(nb::class_<Arm>& arm) {
  Signature made("__init__", "None",
                 "Makes an arm of its joints. Raises Error for joints or names that no arm has.");
  made.takes("self")
      .takes("name", "str", "Name of the arm.")
      .takes("joints", "list[Joint]", "From the base to the tool.")
      .keywords()
      .takes("tool", std::string(array_like) + " | None",
             "Pose of the tool in the last link (4, 4).", "None")
      .takes("base", std::string(array_like) + " | None", "Pose of link 0 in the world (4, 4).",
             "None")
      .takes("controller_base", std::string(array_like) + " | None",
             "Pose in the world of the controller's root frame (4, 4). Default: the world.", "None")
      .takes("flange", std::string(array_like) + " | None",
             "Pose in the last link of the mounting flange, the frame that tools are given in (4, "
             "4). Default: the tool.",
             "None");
  define(
      arm,
      [](Arm* self, nb::handle name, nb::handle joints, nb::handle tool, nb::handle base,
         nb::handle controller_base, nb::handle flange) {
        if (joints.is_none()) refuse_without_joints(name);
        const auto pose = [](nb::handle value, const char* what) {
          return Value<std::optional<Pose>>::from(value, what);
        };
        const Pose own_tool = pose(tool, "tool").value_or(Pose::Identity());
        const std::optional<Pose> root = pose(controller_base, "controller_base");
        const std::optional<Pose> mounting = pose(flange, "flange");
        const ControllerFrames controller{.base = root.value_or(Pose::Identity()),
                                          .base_assumed = !root,
                                          .flange = mounting.value_or(own_tool),
                                          .flange_assumed = !mounting};
        Arm result(Value<std::string>::from(name, "name"),
                   Value<std::vector<Joint>>::from(joints, "joints"), own_tool,
                   pose(base, "base").value_or(Pose::Identity()), controller);
        check_names(result);
        new (self) Arm(std::move(result));
      },
      made, nb::arg("name"), nb::arg("joints") = nb::none(), nb::kw_only(),
      nb::arg("tool") = nb::none(), nb::arg("base") = nb::none(),
      nb::arg("controller_base") = nb::none(), nb::arg("flange") = nb::none());
}

}  // namespace

void bind_arms(nb::module_& m) {
  bind_record<Limits>(m);
  bind_record<LimitOverrides>(m);
  bind_record<Mimic>(m);
  bind_record<Joint>(m);
  bind_record<DhRow>(m);
  bind_record<BuiltInArm>(m);
  nb::class_<Arm> arm(m, "Arm", comment("Arm"));
  bind_constructor(arm);
  bind_arm_files(arm);
  bind_written_arms(m, arm);
  bind_descriptions(arm);
  bind_screws(arm);
  bind_properties(arm);
  bind_frames(arm);
  bind_copies(arm);
  bind_moving_bases(arm);
  Signature json("to_json", "str", "Returns the arm as JSON, which reads back exactly.");
  define(
      arm, [](const Arm& self) { return arm_to_json(self); }, json.takes("self"));
  arm.def("__repr__", &printed);
  arm.def("__getstate__", [](const Arm& self) { return arm_to_json(self); });
  arm.def("__setstate__", [](Arm& self, const std::string& text) {
    new (&self) Arm(arm_from_json(text, "pickle"));
  });
  bind_equality(arm, [](const Arm& a, const Arm& b) { return arm_to_json(a) == arm_to_json(b); });
  arm.def("__hash__", [](const Arm& self) { return std::hash<std::string>()(arm_to_json(self)); });
  m.def(
      "_arm_of",
      [](nb::handle value) {
        const Arm& found = object_of<Arm>(value, "arm");
        return nb::isinstance<Arm>(value) ? nb::borrow(value) : nb::cast(found);
      },
      nb::arg().none(), nb::sig("def _arm_of(value: object, /) -> Arm"),
      "Returns the arm that the value is or names. Raises TypeError where it is none.");
  const Signature built_in("built_in_arms", "list[BuiltInArm]", "The built-in arms, by name.");
  define(
      m, [] { return Value<std::vector<BuiltInArm>>::to(built_in_arms()); }, built_in);
}

}  // namespace beeline::python
