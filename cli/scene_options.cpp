#include <beeline/error.h>

#include "scene_argument.h"

namespace beeline::command {

std::vector<Option> SceneArgument::options() {
  return joined(
      {distance_options(),
       {Option("--resolution FRACTION",
               "The clearance is proved at all times, also between the samples. Distances that "
               "differ from it by less than this fraction of it are not decided. Default: " +
                   number(ClearanceOptions().resolution) + ".",
               &resolution, {.range = {1e-6, 1}}),
        Option("--recover-clearance METRES",
               "Accept a motion that starts closer than the clearance, or in contact, by at most "
               "this much, and leads out of it: until then, no pair of bodies that is too close "
               "at the start comes closer, and all others keep the clearance; all keep it "
               "afterwards. A contact counts with the clearance and its depth, and may become "
               "deeper down to the depth that is reported. A program must lead out before it "
               "attaches or detaches a part at a later waypoint. `beeline line` needs --from then.",
               &recover_clearance, {.range = {0, max_recover_clearance}})}});
}

std::vector<Option> SceneArgument::obstacle_options() {
  return {
      Option(
          "--scene FILE",
          "Obstacles that the arm must keep the clearance from: JSON, see docs/scene.schema.json; "
          "the URDF file of a cell, whose links with <collision> "
          "are obstacles; a scene of MoveIt: .scene, or PlanningScene as YAML or JSON; or a point "
          "cloud, .ply or .npy, with --radius. Several times for several files.",
          &scenes),
      Option("--radius METRES",
             "The radius of the spheres around the points of the point clouds among the scenes.",
             &radius, {.range = {0, max_shape_size}})};
}

std::vector<Option> SceneArgument::shape_options() {
  return {
      Option("--tool-shape FILE",
             "Shapes of the tool: JSON {\"name\": NAME, \"shapes\": [SHAPE, ...]} as in scenes, "
             "posed in the arm's own tool frame as --tcp.",
             &tool_shape),
      Option("--hold JOINT=VALUE",
             "The value, rad or m, of a joint that carries shapes and is beside the chain of the "
             "arm's URDF file, such as a finger of a gripper, or in a scene. Default: of the arm's "
             "joints the first named state of --srdf that has a value within the limits; else 0, "
             "or the limit next to it. Several times for several joints.",
             &hold),
      Option("--package NAME=FOLDER",
             "The folder of a package of ROS, for meshes package://NAME/... of URDF files. Without "
             "it they are looked for in ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and the folders above "
             "the file, also by their package.xml. Meshes are taken as their convex hulls. Several "
             "times for "
             "several packages.",
             &package)};
}

std::vector<Option> SceneArgument::body_options() {
  return joined({obstacle_options(), shape_options()});
}

std::vector<Option> SceneArgument::distance_options() {
  std::vector<Option> options{
      Option("--self",
             "The links must keep the clearance from each other, also without --scene. Links that "
             "share a joint may touch.",
             &self, {.excludes = "--no-self"}),
      Option("--no-self", "The links need not keep it from each other.", &no_self,
             {.needs = "--scene"}),
      Option("--clearance METRES",
             "The distance to be kept, except from obstacles with their own. Default: " +
                 number(CollisionOptions().clearance) + ".",
             &clearance,
             {.range = {.lowest = 0, .highest = max_shape_size, .excludes_lowest = true}}),
      Option("--allow A,B",
             "Two links or obstacles that may touch, in addition to \"allowed_pairs\" of the "
             "scenes. Several times for several pairs.",
             &allow)};
  return joined({obstacle_options(), std::move(options), shape_options()});
}

}  // namespace beeline::command
