#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string q;
  bool all = false;
  bool json = false;
};

std::string link_label(const Arm& arm, std::size_t i) {
  if (i == 0) return "base";
  const std::string& link = arm.joints()[i - 1].link;
  return link.empty() ? fmt::format("link{}", i) : link;
}

Exit forward(const Arguments& arguments) {
  const Arm arm = arguments.arm.read();
  const Configuration q = arguments.unit.configuration(arm, arguments.q, "--q");
  warn_outside_limits(arm, q);
  const Pose tool = forward_kinematics(arm, q);
  if (!tool.matrix().allFinite())
    throw Error("--q: the tool is farther away than a number can tell");
  const std::vector<Pose> links = arguments.all ? link_poses(arm, q) : std::vector<Pose>{};
  if (arguments.json) {
    OrderedJson document{{"pose", json_pose(tool, arm.planar(), arguments.unit)}};
    for (std::size_t i = 0; i < links.size(); ++i) {
      OrderedJson pose = json_pose(links[i], arm.planar(), arguments.unit);
      pose["link"] = link_label(arm, i);
      document["links"].push_back(pose);
    }
    print_json(document);
    return Exit::yes;
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    fmt::print("{} in the world\n", link_label(arm, i));
    print_pose(links[i], arm.planar(), arguments.unit);
  }
  fmt::print("tool in the world\n");
  print_pose(tool, arm.planar(), arguments.unit);
  return Exit::yes;
}

}  // namespace

Run declare_fk(CLI::App& verb) {
  static Arguments arguments;
  arguments.arm.declare(verb);
  verb.add_option("--q", arguments.q, "Joint values, comma-separated; metres where a joint slides")
      ->required();
  arguments.unit.declare(verb);
  verb.add_flag("--all", arguments.all, "Every link's pose as well, the base first");
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline fk rrr --q 112,-52,-60 --degrees\n"
      "  beeline fk panda --q 0,-0.785,0,-2.356,0,1.571,0.785 --json\n"
      "  beeline fk robot.urdf --tip tool0 --q 0,0,0,0,0,0 --all");
  return [] { return forward(arguments); };
}
