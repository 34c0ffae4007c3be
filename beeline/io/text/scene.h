#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/urdf.h>
#include <beeline/model/arm.h>

namespace beeline {

class CollisionModel;

/// Options of the functions that read shapes.
struct ShapeOptions {
  /// Values, rad or m, of joints of a URDF file that do not belong to the arm, by name.
  std::map<std::string, double> hold = {};
  /// Folders of packages of ROS, by name, for meshes `package://NAME/...`.
  std::map<std::string, std::string> package = {};
  /// Poses in the world of the frames that a scene of MoveIt may name, such as the arm's base link.
  /// "" is MoveIt's planning frame, and "world" where no other pose is given for it. Without any
  /// frame, the planning frame is the world.
  std::map<std::string, Pose> frames = {};
  /// Frames that move with the arm's base: an object of a scene of MoveIt in one of them is
  /// refused.
  std::vector<std::string> moving_frames = {};
  /// Path of an SRDF file, whose exempted pairs of links may touch, and whose named states give
  /// the values of joints that `hold` does not; empty: none. Of arms only.
  std::string srdf = {};
  /// Radius, m, of the spheres around the points of a scene that is a point cloud, `.ply` or
  /// `.npy`. Such a scene needs it, another one has none.
  std::optional<double> radius = std::nullopt;
};

/// Whether a path ends in .ply or .npy, the formats of point clouds.
bool is_cloud_path(const std::string& path);

/// Reads a scene: a JSON file, a URDF file of a cell, a file of MoveIt, or a point cloud, by the
/// ending of `path`.
///
/// A JSON file is in metres and radians:
///     {"obstacles": [{"name": "table",
///                     "clearance": 0.01,                         optional
///                     "shapes": [{"box": {"size": [1, 2, 0.05]},
///                                 "pose": {"xyz": [0.5, 0, 0], "rpy": [0, 0, 0]},    optional
///                                 "padding": 0.002}]}],          optional
///      "allowed_pairs": [["table", "link0"]],                    optional
///      "exempted_pairs": [["table", "link0"]]}                   optional, Scene::exempted_pairs
/// A shape has one of
///     "sphere": {"radius"}, "capsule": {"radius", "length"}, "box": {"size": [x, y, z]},
///     "cylinder": {"radius", "length"}, "half_space": {}, "convex_hull": {"vertices": [[x, y, z]]}
/// and a pose as in arm files. A hull may have "hull_of", the path of its mesh. Instead of shapes,
/// or beside them, an obstacle may have a cloud of at most 1,000,000 points, each grown to a
/// sphere:
///     "point_cloud": {"radius": 0.01, "file": "scan.ply",
///                     "pose": {"xyz": [0, 0, 1]}}            optional, of the points in the world
/// or "points": [[x, y, z], ...] instead of "file", which is relative to the folder of the scene.
///
/// A file of points, m, is `.ply` (ASCII or binary, of either byte order; the properties x, y and
/// z, float or double, of its element vertex; all else is skipped) or `.npy` (N x 3, '<f4' or
/// '<f8'). As a scene it is one obstacle, which has the name of the file without its ending. A
/// coordinate that is not a finite number is refused: leave out points that a camera did not
/// measure.
///
/// In a URDF file of a cell each link with `<collision>` elements, in an MJCF file each body with
/// geoms that collide, is an obstacle of this name, and its root link is the world. Joints are held
/// at `options.hold` or, without a value, at 0 or the limit next to 0; mimic joints follow. Shapes
/// and meshes are read as in read_arm_shapes(). Links that are only visible are no obstacles:
/// Scene::links_without_shapes.
///
/// A file `.scene` is the text that MoveIt's RViz panel exports, of either version, posed in the
/// planning frame. A file `.yaml` or a JSON file with a `world` is a message
/// moveit_msgs/PlanningScene of a whole scene: `world.collision_objects` are obstacles, each in a
/// frame of `options.frames` or of `fixed_frame_transforms`, and `allowed_collision_matrix` gives
/// Scene::exempted_pairs. Points and quaternions are maps of x, y, z, w or lists in this order. In
/// both, a cone is the pyramid of 64 sides around it, a plane is a box without thickness, 1000 km
/// long, and a mesh, also of `resource` and `dimensions` as Robowflex writes, is its convex hull.
/// Colours, types, subframes and the robot's state are ignored.
///
/// Throws FileError for anything else, with the line and the value, such as
/// `obstacles[2].shapes[0].box.size`; in a URDF file for a link that is not connected to the root,
/// a joint that cannot be read, and a file without `<collision>`; in a message for an unknown
/// frame, a change of another scene, attached objects, an octree, and padding of links, and in both
/// for an object without shapes; Error for a name in `options.hold` that is not a joint of the
/// file, a value outside its limits, and `options.srdf`.
Scene read_scene(const std::string& path, const ShapeOptions& options = {});
/// The same from the text of a file; the ending of `path` gives its format.
Scene scene_from_text(std::string_view text, const std::string& path,
                      const ShapeOptions& options = {});
/// The same from a JSON text; `path` names it in messages.
Scene scene_from_json(std::string_view text, const std::string& path);
/// The same from the text of a URDF file; meshes are found from its `path`.
Scene scene_from_urdf(std::string_view text, const std::string& path,
                      const ShapeOptions& options = {});

/// Returns a sentence without a full stop about Scene::links_without_shapes of a file.
std::string visual_links_note(const std::string& path, const std::vector<std::string>& links);
/// The same about far_obstacles(), which are probably in millimetres.
std::string far_obstacles_note(const std::vector<std::string>& names);

/// Returns the scene as JSON, which reads back exactly. Throws Error for an obstacle without
/// shapes, and a name that is empty, not UTF-8, longer than 1000 bytes, or has control characters.
std::string scene_to_json(const Scene& scene);

/// The shapes of an arm's links, as the file of the arm describes them.
struct ArmShapes {
  std::vector<LinkShapes> links = {};  ///< the bodies that have shapes
  /// The joints beside the chain that carry shapes, with the values at which they are held, rad or
  /// m. Floating and planar joints are at 0.
  std::map<std::string, double> held = {};
  /// The named state of the SRDF file from which a joint of `held` has its value, by joint.
  std::map<std::string, std::string> held_by_state = {};
  /// The pairs of these bodies that the SRDF file exempts, or `<exclude>` of an MJCF file, and
  /// those that several joints of one MJCF body connect: they may touch.
  std::vector<NamedPair> allowed_pairs = {};
  /// Links of a URDF file with `<visual>` and without `<collision>`: they are not checked.
  std::vector<std::string> links_without_shapes = {};
  /// Links of an MJCF file with a plane, which is an obstacle: it is no shape of the arm.
  std::vector<std::string> links_with_planes = {};
  /// The links of a URDF file that only fixed joints connect to link 0, the base, with their poses
  /// in its frame, for ShapeOptions::frames; "" is the root link, MoveIt's planning frame.
  std::map<std::string, Pose> base_links = {};
  /// The bodies on link 0 that stand in the world beside the arm: the body of a root link `world`,
  /// and the bodies of its branches without a link of the chain. A rail or a mobile base does not
  /// carry them.
  std::vector<std::string> standing = {};
};

/// Reads the shapes of the links of the arm that `text` names, see read_arm(). Joint strings have
/// none; built-in arms have them if BuiltInArm::shapes_source says where they are from. An arm file
/// has them as
///     "shapes": [{"joint": "shoulder", "name": "upper arm", "shapes": [SHAPE, ...],
///                 "attached": true}, ...]
/// where SHAPE is as in read_scene(), posed in the frame of the link that the joint moves, without
/// `joint` in the frame of the base (link 0). The default of `name` is the name of the link, of its
/// joint, or "base". An attached body is fixed to the link, not at its joints: it must keep its
/// clearance from the neighbouring links.
///
/// The shapes of a URDF file are the `<collision>` elements of all its links: boxes, cylinders,
/// spheres, capsules and meshes. A link beside the chain is carried by the link of the chain to
/// which it is connected. Joints in between are held at the values of `options.hold` (rad or m) or,
/// without one, of the first named state of `options.srdf` that has a value for the joint within
/// its limits, or else at 0 or the limit next to 0; mimic joints follow. Bodies are at a joint of
/// the arm only if it connects them.
///
/// The shapes of an MJCF file are the geoms that can collide, whose contype or conaffinity is not
/// 0: spheres, capsules, cylinders, boxes and meshes, which are files in `meshdir` or lists of
/// vertices. Planes that do not move are obstacles: they are left out, see
/// ArmShapes::links_with_planes, and in a scene are half spaces without bounds. Geoms of other
/// types are refused.
///
/// A mesh is taken as its convex hull, Shape::hull_of, which contains it; `scale` is honoured. STL
/// (binary or ASCII) and OBJ files are read and, by builds with BEELINE_ASSIMP, Collada (its
/// `<unit>` applies, its `<up_axis>` is ignored) and glTF. If the hull has many vertices, some are
/// dropped, and the body is grown (Shape::padding) by the largest distance of a dropped one,
/// proved, at most 0.1 mm or 0.1 % of its size unless that takes more than 2,000 vertices. The mesh
/// is looked for
///   - package://NAME/PATH: in the folder that `options.package` gives for NAME or, if it has none,
///     in folders of the environment variables ROS_PACKAGE_PATH that are called NAME or contain
///     NAME, in share/NAME of the folders of AMENT_PREFIX_PATH, and in the folders above the file
///     that are called NAME or contain NAME; if none of these exists, in a folder whose package.xml
///     has the name NAME: above the file, or beside its package. model://NAME/PATH likewise
///   - file://PATH, and PATH relative to the folder of the file.
///
/// Throws FileError for a mesh that is not found, not read or malformed, any other shape that is
/// not read, a `<collision>` with several geometries, a link with shapes that is not connected to
/// the arm or is moved by a joint of the arm beside the chain, a loop of links, and, in an arm
/// file, an unknown joint and a repeated name; Error for a name in `options.hold` that is not a
/// joint beside the chain, or a value outside its limits.
ArmShapes read_arm_shapes(const std::string& text, const ChainEnds& ends = {},
                          const ShapeOptions& options = {});
/// The same from the text of a file; the ending of `path` gives its format.
ArmShapes arm_shapes_from_text(std::string_view text, const std::string& path,
                               const ChainEnds& ends = {}, const ShapeOptions& options = {});

/// Returns a sentence without a full stop about ArmShapes::links_with_planes of a file.
std::string planes_note(const std::string& path, const std::vector<std::string>& links);

/// Returns the shapes of the links of an arm as shapes of the arm with `joints` more joints before
/// its own: one after with_rail(), three after with_mobile_base(). The last of these joints carries
/// what was fixed to the base, except the bodies of the names `standing`, see ArmShapes::standing,
/// which stay on link 0. Throws Error for more than 100 joints.
std::vector<LinkShapes> behind_joints(std::vector<LinkShapes> links, std::size_t joints,
                                      const std::vector<std::string>& standing = {});

/// Returns the arm as JSON with the list `shapes` of its bodies; it reads back exactly, except that
/// a body at only one of its link's joints is written as attached: it must then keep its clearance
/// from both neighbours. Bodies without shapes are left out. Throws Error as arm_to_json(arm) does,
/// for a link that the arm does not have, and for two bodies of one name.
std::string arm_to_json(const Arm& arm, const std::vector<LinkShapes>& links);

/// The texts of an arm file and of a scene file, of JSON.
struct CollisionFiles {
  std::string arm, scene;
};

/// Returns the files of which a model is made that checks the same pairs, with the clearance of
/// `model`. Pairs that options of the model allow are pairs of the scene; an arm file cannot say
/// that a body is at one joint of its link alone, whose pairs are exempted instead. Throws Error as
/// arm_to_json().
CollisionFiles collision_files(const CollisionModel& model);

/// Reads the shapes of a tool, which link n of the arm carries:
///     {"name": "gripper", "shapes": [SHAPE, ...]}
/// posed in the arm's tool frame. The default name is "tool". Throws FileError, also if there is no
/// shape.
LinkShapes read_tool_shapes(const std::string& path, const Arm& arm);

/// Returns the pairs of two of these links that an SRDF file exempts, each once: the pairs of
/// `<disable_collisions>` and, for a link of `<disable_default_collisions>`, its pairs with all
/// others except the pairs of `<enable_collisions>`. Names that are not among `links` are ignored:
/// the file describes all links of a robot.
std::vector<NamedPair> exempted_pairs(const Srdf& srdf, const std::vector<LinkShapes>& links);

}  // namespace beeline
