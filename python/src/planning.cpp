#include "bindings.h"
#include "collision_fields.h"
#include "interruption.h"
#include "plane_poses.h"
#include "planning_fields.h"

namespace beeline::python {

BlockedMotions Value<BlockedMotions>::from(nb::handle value, const char* name) {
  if (value.is_none()) return {};
  return blocked_motions(shared_model(value, name));
}

Value<std::function<double(const ConfigurationRef&)>>::Function
Value<std::function<double(const ConfigurationRef&)>>::from(nb::handle value, const char* name) {
  if (value.is_none()) return {};
  return blocked_motions(shared_model(value, name)).spare_clearance;
}

std::function<Configuration(double)> Value<std::function<Configuration(double)>>::from(
    nb::handle value, const char* name) {
  if (value.is_none()) return {};
  if (!PyCallable_Check(value.ptr())) raise_type(name, "a callable", value);
  return [held = shared_object(nb::borrow(value)), name](double s) {
    nb::gil_scoped_acquire lock;
    return Value<Configuration>::from((*held)(s), name);
  };
}

namespace {

using Start = Value<std::optional<Configuration>>;

constexpr const char* start_doc =
    "Configuration (n,) whose tool is at the path's beginning; None: the best one there.";

std::string start_type() { return std::string(array_like) + " | None"; }

/// The options, whose guide returns configurations of the arm.
BranchOptions branch_options(const Arm& arm, const nb::kwargs& keywords) {
  auto asked = options<BranchOptions>(keywords);
  if (!asked.guide) return asked;
  asked.guide = [&arm, guide = std::move(asked.guide)](double s) {
    Configuration q = guide(s);
    check_configuration(arm, q);
    return q;
  };
  return asked;
}

void bind_moves(nb::module_& m) {
  Signature along("move_along", "PathMotion", comment("move_along"));
  along.takes_arm()
      .takes("start", start_type(), start_doc)
      .takes("route", "Route", "See route_of().")
      .options<PathMotionOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, const Route& route, const nb::kwargs& keywords) {
        const auto begin = Start::from(start, "start");
        check_options_of(arm, keywords);
        auto asked = options<PathMotionOptions>(keywords);
        return unlocked(asked.budget, [&] { return move_along(arm, begin, route, asked); });
      },
      along, nb::arg("arm"), nb::arg("start").none(), nb::arg("route"), nb::arg("keywords"));

  Signature lines(
      "move_in_lines", "PathMotion",
      "Moves the tool in straight lines from its pose at `start` through the waypoints, at rest at "
      "each; arrivals[i] belongs to waypoints[i]. Orientations follow the shortest rotation. "
      "Without a start, from the first waypoint. See move_along().");
  lines.takes_arm()
      .takes("start", start_type(),
             "Configuration (n,); None: the best one for the first waypoint.")
      .takes("waypoints", arm_poses_like, arm_poses_doc)
      .options<PathMotionOptions>();
  define_on_arm(
      m,
      [](const Arm& arm, nb::handle start, nb::handle waypoints, const nb::kwargs& keywords) {
        const auto begin = Start::from(start, "start");
        const std::vector<Pose> poses = PosePlane(arm).poses(waypoints, "waypoints");
        check_options_of(arm, keywords);
        auto asked = options<PathMotionOptions>(keywords);
        return unlocked(asked.budget, [&] {
          return begin ? move_in_lines(arm, *begin, poses, asked)
                       : move_in_lines(arm, poses, asked);
        });
      },
      lines, nb::arg("arm"), nb::arg("start").none(), nb::arg("waypoints"), nb::arg("keywords"));
}

void bind_branches(nb::module_& m) {
  Signature plan("plan_path", "Branch",
                 "Plans the arm's motion along a path, without times. An arm that is redundant for "
                 "the task follows the shortest path through a layered graph of configurations "
                 "(Ferrentino and Chiacchio 2020); any other arm the best of all branches. If none "
                 "is complete, returns the one that reaches farthest, with its reason.");
  plan.takes_arm()
      .takes("start", start_type(), start_doc)
      .takes("path", "ToolPath", "Path.")
      .options<BranchOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, const ToolPath& path, const nb::kwargs& keywords) {
        check_options_of(arm, keywords);
        const auto begin = Start::from(start, "start");
        BranchOptions asked = branch_options(arm, keywords);
        return unlocked(asked.budget, [&] { return plan_path(arm, begin, path, asked); });
      },
      plan, nb::arg("arm"), nb::arg("start").none(), nb::arg("path"), nb::arg("keywords"));

  Signature map("branch_map", "list[Branch]", comment("branch_map"));
  map.takes_arm().takes("path", "ToolPath", "Path.").options<BranchOptions>();
  define(
      m,
      [](const Arm& arm, const ToolPath& path, const nb::kwargs& keywords) {
        check_options_of(arm, keywords);
        BranchOptions asked = branch_options(arm, keywords);
        return Value<std::vector<Branch>>::to(
            unlocked(asked.budget, [&] { return branch_map(arm, path, asked); }));
      },
      map, nb::arg("arm"), nb::arg("path"), nb::arg("keywords"));

  Signature nearby("nearby_path", "NearbyPath | None", comment("nearby_path"));
  nearby.takes_arm()
      .takes("start", start_type(), start_doc)
      .takes("path", "ToolPath", "Path.")
      .takes("rotate", "bool", "Rotate the tool instead of moving the path.", "False")
      .options<BranchOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, const ToolPath& path, nb::handle rotate,
         const nb::kwargs& keywords) {
        check_options_of(arm, keywords);
        const auto begin = Start::from(start, "start");
        const bool rotated = Value<bool>::from(rotate, "rotate");
        BranchOptions asked = branch_options(arm, keywords);
        return Value<std::optional<NearbyPath>>::to(
            unlocked(asked.budget, [&] { return nearby_path(arm, begin, path, asked, rotated); }));
      },
      nearby, nb::arg("arm"), nb::arg("start").none(), nb::arg("path"), nb::arg("rotate") = false,
      nb::arg("keywords"));
}

}  // namespace

void bind_planning(nb::module_& m) {
  nb::class_<TrackedSegment> segment = bind_record<TrackedSegment>(m);
  segment.def_prop_ro("complete", &TrackedSegment::complete,
                      "Whether the samples reach the segment's end.");
  bind_record<Branch>(m);
  bind_record<NearbyPath>(m);
  bind_record<BlockedBranch>(m);
  bind_record<PathMotion>(m);
  bind_branches(m);
  bind_moves(m);
}

}  // namespace beeline::python
