#include "reach_map.h"

#include <fmt/format.h>
#include <memory>
#include <numbers>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>

#include "arm_argument.h"
#include "blocked_solutions.h"
#include "budget_argument.h"
#include "command/progress.h"
#include "format.h"
#include "pose_argument.h"
#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

/// The number of configurations of a map by sampling, unless --samples gives it.
constexpr std::int64_t samples_in_cell = 50, min_default_samples = 1'000'000;
constexpr std::int64_t max_default_samples = 1'000'000'000;

struct MapArguments {
  ArmArgument arm;
  UnitArgument unit;
  BudgetArgument budget;
  SceneArgument scene;
  std::string out, lower, upper, orientation, shard, by = "inverse-kinematics";
  bool any_orientation = false;
  std::optional<double> resolution, azimuths, directions, rolls;
  std::optional<std::int64_t> samples;
  ReachOptions reach;
};

Vector3 corner(const std::string& text, const char* option, bool cylindrical) {
  const std::vector<double> numbers = parse_numbers(text, option);
  if (cylindrical && numbers.size() == 2) return {numbers[0], numbers[1], 0};
  if (!cylindrical && numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  throw Error(fmt::format("{}: {} given, a corner has {}", option,
                          counted(static_cast<std::int64_t>(numbers.size()), "number"),
                          cylindrical ? "two with --azimuths, radius,height" : "three, x,y,z"));
}

ReachGrid grid_of(const Arm& arm, const MapArguments& arguments) {
  const UnitArgument& unit = arguments.unit;
  const auto radians = [&unit](const std::optional<double>& angle) {
    return angle && unit.degrees ? *angle * std::numbers::pi / 180 : angle;
  };
  ReachGridOptions options{.resolution = arguments.resolution,
                           .azimuths = radians(arguments.azimuths),
                           .any_orientation = arguments.any_orientation,
                           .directions = radians(arguments.directions),
                           .rolls = radians(arguments.rolls)};
  if (!arguments.lower.empty())
    options.lower = corner(arguments.lower, "--lower", options.azimuths.has_value());
  if (!arguments.upper.empty())
    options.upper = corner(arguments.upper, "--upper", options.azimuths.has_value());
  if (!arguments.orientation.empty()) {
    const auto count = parse_numbers(arguments.orientation, "--orientation").size();
    if (count != 3 && count != 4) {
      throw Error(fmt::format(
          "--orientation: {} given, an orientation has three, roll,pitch,yaw, or four, qw,qx,qy,qz",
          counted(static_cast<std::int64_t>(count), "number")));
    }
    UnitArgument form = unit;
    const bool quaternion = count == 4;
    if (quaternion || unit.pose_form == name(PoseForm::quaternion) ||
        unit.pose_form == name(PoseForm::matrix)) {
      form.pose_form = name(quaternion ? PoseForm::quaternion : PoseForm::rpy);
    }
    options.orientation =
        parse_pose_option(arm, "--orientation", "0,0,0," + arguments.orientation, form)
            .pose.linear();
  }
  return ReachGrid(arm, options);
}

/// 0 for a map by inverse kinematics.
std::int64_t samples_of(const MapArguments& arguments, const ReachGrid& grid) {
  const bool sampling = arguments.by == "sampling";
  if (!sampling && arguments.samples) throw Error("--samples is for --by sampling");
  if (!sampling && arguments.any_orientation) {
    throw Error(
        "--any-orientation is for --by sampling: by inverse kinematics a position is reached in "
        "--directions");
  }
  if (!sampling) return 0;
  const std::int64_t cells = std::min<std::int64_t>(grid.cells(), max_default_samples);
  return arguments.samples.value_or(
      std::clamp<std::int64_t>(samples_in_cell * cells, min_default_samples, max_default_samples));
}

ReachShard shard_of(const std::string& text) {
  if (text.empty()) return {};
  ReachShard shard;
  int end = 0;
  const int read = std::sscanf(text.c_str(), "%9d/%9d%n", &shard.number, &shard.count, &end);
  if (read == 2 && static_cast<std::size_t>(end) == text.size()) return shard;
  throw Error("--shard: \"" + text + "\" is no share of a map, such as 1/4");
}

Answer compute(const MakeReachMapJob& make_job) {
  ReachMapJob job = make_job();
  Ending ending = Ending::complete;
  {
    Progress progress;
    job.options.reach.budget = progress.of(job.options.reach.budget);
    ending = compute_reach_map(job.arm, job.grid, job.out, job.options);
  }
  return ending == Ending::complete ? computed_map(job) : interrupted_map(job.out, ending);
}

std::vector<Option> grid_options(MapArguments& arguments) {
  return {
      Option("--resolution M",
             "Edge of the cells, m. Default: a twentieth of the radius of the reach.",
             &arguments.resolution, {.range = {1e-9, 1e6}}),
      Option("--lower X,Y,Z",
             "Corner of the box of positions, m, in the world, where the cells begin. Default: "
             "the corner of the box around the reach. With --azimuths: RADIUS,HEIGHT.",
             &arguments.lower),
      Option("--upper X,Y,Z", "The opposite corner, which the cells cover.", &arguments.upper),
      Option("--azimuths ANGLE",
             "Positions by radius, height and azimuth about the axis of the first joint, with this "
             "angle between azimuths; tool directions turn with the azimuth. The inverse "
             "kinematics is solved and stored once for all azimuths, and for all rolls where the "
             "last joint rolls the tool: a map of a dimension or two less, with the same answers. "
             "Default: positions by x, y and z. From 0.01 to 6.2832 rad (360 degrees).",
             &arguments.azimuths, {.excludes = "--orientation"}),
      Option("--orientation R,P,Y",
             "One orientation of the tool in the world for all cells: roll,pitch,yaw, with "
             "--pose-form also rx,ry,rz or A,B,C, or qw,qx,qy,qz. Default: tool directions "
             "(headings, for a planar arm).",
             &arguments.orientation),
      Option("--directions ANGLE",
             "Angle between neighbouring directions of the tool's z axis, which cover the sphere "
             "evenly, or between headings of a planar arm. Default: " +
                 number(default_direction_spacing * 180 / std::numbers::pi) +
                 " degrees. From 0.01 to 1.5708 rad (90 degrees), headings to 6.2832 (360).",
             &arguments.directions, {.excludes = "--orientation"}),
      Option("--rolls ANGLE",
             "Angle between rolls about the tool's z axis. Default: a direction is reached if it "
             "is with any roll. From 0.01 to 6.2832 rad (360 degrees).",
             &arguments.rolls, {.excludes = "--orientation"})};
}

/// How the cells are computed, and which of them.
std::vector<Option> method_options(MapArguments& arguments) {
  return {
      Option("--by METHOD",
             "inverse-kinematics: what the arm can do at the centre of each cell; sampling: "
             "anywhere in a cell, from the forward kinematics of configurations that fill the "
             "joint ranges, also of arms that reach almost no pose exactly.",
             &arguments.by, {.choices = {"inverse-kinematics", "sampling"}}),
      Option("--samples N",
             fmt::format("Configurations of a map by sampling. Default: {} times the cells, at "
                         "least {}, at most {}.",
                         samples_in_cell, number(min_default_samples), number(max_default_samples)),
             &arguments.samples, {.range = {1, 1e12}}),
      Option("--any-orientation", "A map by sampling of positions alone, in any orientation.",
             &arguments.any_orientation),
      Option("--redundant-values N",
             "Values of the redundant joint of an arm of seven joints at which all solutions are "
             "computed. Where there is none, the range between them is searched.",
             &arguments.reach.redundant_values, {.range = {1, 1000}}),
      Option("--shard K/N", "Compute share K of N of the map, K from 1 to N.", &arguments.shard),
      threads_option(&arguments.reach.threads)};
}

/// Only solutions that are free in the scene, if there is one, count.
void add_scene(const MapArguments& arguments, ReachMapJob& job) {
  std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, job.arm);
  if (!scene) return;
  warn_if_unchecked(*scene);
  job.scene = std::make_shared<const CheckedScene>(std::move(*scene));
  job.options.reach.scene = ReachScene{.digest = digest(job.scene->model),
                                       .clearance = job.scene->clearance,
                                       .files = arguments.scene.scenes};
  job.options.reach.blocked_by = blocked_in(*job.scene);
}

ReachMapJob job_of(const MapArguments& arguments) {
  refuse_overwriting(arguments.out, arguments.arm.inputs(arguments.scene.inputs()));
  const ReachShard shard = shard_of(arguments.shard);
  const Arm arm = arguments.arm.read(arguments.unit);
  ReachMapJob job{.arm = arm, .grid = grid_of(arm, arguments), .out = arguments.out};
  job.options = {.reach = arguments.reach, .shard = shard};
  job.options.reach.samples = samples_of(arguments, job.grid);
  job.options.reach.budget = arguments.budget.next();
  add_scene(arguments, job);
  return job;
}

}  // namespace

Answer computed_map(const ReachMapJob& job) {
  Answer answer = map_totals(ReachMap(job.out, job.options.reach.threads));
  if (!job.scene) return answer;
  answer.text += scene_text(*job.scene);
  answer.document.add("scene", scene_document(*job.scene));
  return answer;
}

Verb reach_map_verb() { return reach_map_verb(compute); }

Verb reach_map_verb(const std::function<Answer(const MakeReachMapJob&)>& compute) {
  const auto arguments = std::make_shared<MapArguments>();
  return {
      .name = "map",
      .summary = "Compute what an arm can do at the centre of each cell of a grid",
      .description =
          "Solves the inverse kinematics at the centre of each cell of a grid of positions, tool "
          "directions and rolls: the number of solutions within the limits, their largest "
          "manipulability and their largest margin to the limits. The map is an HDF5 file, which "
          "h5py, MATLAB and others read. It is computed in slabs, each of which is written to the "
          "folder FILE.parts when it is complete; after an interruption the same command "
          "continues. With --shard, several machines compute a part each, and `beeline reach "
          "merge` joins the parts; the result is the same. --by sampling marks the cells that the "
          "tool of sampled configurations is in, and says so in the file. With --scene or --self a "
          "solution or a sample counts only if each pair of bodies is proved to keep its clearance "
          "there, as in `beeline ik`; such a map has --rolls, --orientation or headings and no "
          "--azimuths, and its file says which scene it is of.",
      .arguments = {arguments->arm.argument()},
      .options = joined(
          {{Option("--out FILE", "The map, an HDF5 file.", &arguments->out, {.required = true})},
           grid_options(*arguments),
           method_options(*arguments),
           arguments->scene.distance_options(),
           arguments->unit.options(),
           arguments->budget.options(),
           arguments->arm.options()}),
      .examples =
          {{"Positions and tool directions of an arm, 12 cm apart",
            "beeline reach map puma560 --resolution 0.12 --out puma560.h5"},
           {"Where it can point straight down",
            "beeline reach map puma560 --orientation 180,0,0 --degrees --out down.h5"},
           {"A map of six dimensions, of which two are not stored",
            "beeline reach map puma560 --azimuths 10 --rolls 30 --degrees --out turned.h5"},
           {"The positions that an arm of five joints reaches in any orientation",
            "beeline reach map px150 --by sampling --any-orientation --out px150.h5"},
           {"What an arm with shapes of its links can do beside a post",
            "printf '{\"name\": \"mine\", \"joint_string\": \"RRR:3.5,3.5,2\", "
            "\"shapes\": [{\"joint\": \"joint1\", \"shapes\": [{\"capsule\": {\"radius\": "
            "0.1, \"length\": 3.5}, \"pose\": {\"xyz\": [-1.75, 0, 0], \"rpy\": [0, 1.5708, "
            "0]}}]}]}' > arm.json\n"
            "printf '{\"obstacles\": [{\"name\": \"post\", \"shapes\": [{\"cylinder\": "
            "{\"radius\": 0.1, \"length\": 2}, \"pose\": {\"xyz\": [2.1, 1.3, 0]}}]}]}' > "
            "scene.json\n"
            "beeline reach map arm.json --scene scene.json --resolution 1 --out free.h5"},
           {"The first in two parts, which two machines may compute",
            "beeline reach map puma560 --resolution 0.12 --shard 1/2 --out part1.h5\n"
            "beeline reach map puma560 --resolution 0.12 --shard 2/2 --out part2.h5\n"
            "beeline reach merge part1.h5 part2.h5 --out puma560.h5"}},
      .run = [arguments, compute] { return compute([&] { return job_of(*arguments); }); }};
}

}  // namespace beeline::command
