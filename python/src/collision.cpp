#include <beeline/io/text/urdf.h>

#include "arm_fields.h"
#include "bindings.h"
#include "collision_fields.h"
#include "interruption.h"
#include "plane_poses.h"
#include "warning_category.h"

namespace beeline::python {
namespace {

void bind_half_space(nb::module_& m) {
  nb::class_<HalfSpace> bound(m, "HalfSpace",
                              docstring(header_text("HalfSpace", ""), "HalfSpace", ""));
  Signature made("__init__", "None", "Makes one.");
  made.takes("self");
  define(
      bound, [](HalfSpace* self) { new (self) HalfSpace(); }, made);
  bound.def("__repr__", [](const HalfSpace&) { return "HalfSpace()"; })
      .def(
          "__getstate__", [](const HalfSpace&) { return nb::tuple(); },
          nb::sig("def __getstate__(self) -> tuple[object, ...]"))
      .def(
          "__setstate__", [](HalfSpace& self, const nb::tuple&) { new (&self) HalfSpace(); },
          nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
  bind_equality(bound, [](const HalfSpace&, const HalfSpace&) { return true; });
}

ShapeOptions shape_options(nb::handle hold, nb::handle package) {
  return {.hold = Value<std::map<std::string, double>>::from(hold, "hold"),
          .package = Value<std::map<std::string, std::string>>::from(package, "package")};
}

constexpr const char* package_text =
    "The folder of each package of ROS, by name, in which meshes `package://NAME/...` are looked "
    "for; of others in ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and the folders above the file.";

void bind_scene(nb::module_& m) {
  Signature scene(
      "read_scene", "Scene",
      "Reads a scene from a JSON file, see docs/scene.schema.json, from the URDF file of a cell, "
      "in "
      "which each link with `<collision>` elements is an obstacle and the root link is the world, "
      "from a file of MoveIt: `.scene`, or a message PlanningScene as YAML or JSON, or from a "
      "point cloud, `.ply` or `.npy`, which is one obstacle of the file's name. Raises "
      "FileError for an invalid file, whose line it names.");
  scene.takes("path", path_like, "The file.")
      .keywords()
      .takes("hold", argument_type<std::map<std::string, double>>(),
             "Values, rad or m, of joints of a URDF file. The others are held at 0, or at the "
             "limit next to it.",
             "{}")
      .takes("package", argument_type<std::map<std::string, std::string>>(), package_text, "{}")
      .takes("frames", argument_type<std::map<std::string, Pose>>(),
             "Poses (4, 4) in the world of frames that a PlanningScene names, such as "
             "`ArmShapes.base_links`.",
             "{}")
      .takes("moving_frames", argument_type<std::vector<std::string>>(),
             "Frames that move with the arm's base: an object in one of them is refused.", "()")
      .takes("radius", "float | None",
             "Radius, m, of the spheres around the points of a point cloud, which needs it.",
             "None")
      .takes("xacro", xacro_type, xacro_text, "{}");
  define(
      m,
      [](nb::handle path, nb::handle hold, nb::handle package, nb::handle frames,
         nb::handle moving_frames, nb::handle radius, nb::handle xacro) {
        const KeptExpansions expansions(xacro_arguments(xacro));
        const std::string file = path_from(path, "path");
        ShapeOptions options = shape_options(hold, package);
        options.radius = Value<std::optional<double>>::from(radius, "radius");
        options.frames = Value<std::map<std::string, Pose>>::from(frames, "frames");
        options.moving_frames =
            Value<std::vector<std::string>>::from(moving_frames, "moving_frames");
        Scene cell = read_scene(file, options);
        if (!cell.links_without_shapes.empty()) {
          warn_of_input(visual_links_note(file, cell.links_without_shapes));
        }
        return cell;
      },
      scene, nb::arg("path"), nb::kw_only(), nb::arg("hold") = nb::dict(),
      nb::arg("package") = nb::dict(), nb::arg("frames") = nb::dict(),
      nb::arg("moving_frames") = nb::tuple(), nb::arg("radius") = nb::none(),
      nb::arg("xacro") = nb::dict());

  Signature text("scene_to_json", "str", comment("scene_to_json"));
  text.takes("scene", "Scene", "The scene.");
  define(
      m, [](const Scene& given) { return Value<std::string>::to(scene_to_json(given)); }, text,
      nb::arg("scene"));
}

void bind_shape_files(nb::module_& m) {
  Signature shapes(
      "read_arm_shapes", "ArmShapes",
      "Reads the shapes of the links of the arm that `source` names: the `<collision>` "
      "elements of a URDF file, or the list `shapes` of an arm file. Joint strings have none; "
      "built-in arms have them if BuiltInArm.shapes_source is not empty. Meshes are "
      "taken as their convex hulls "
      "(Shape.hull_of). Raises FileError for a shape or a mesh that is not read, and for "
      "a link with shapes that cannot be placed on a link of the arm.");
  shapes.takes("source", path_like, "Name, joint string or path, as of Arm.load().")
      .keywords()
      .takes("base", "str | None", "Name of the link that the chain begins at.", "None")
      .takes("tip", "str | None", "Name of the link that it ends at.", "None")
      .takes("hold", argument_type<std::map<std::string, double>>(),
             "Values, rad or m, of joints beside the chain that carry shapes.", "{}")
      .takes("package", argument_type<std::map<std::string, std::string>>(), package_text, "{}")
      .takes(
          "srdf", "str | os.PathLike[str] | None",
          "SRDF file, whose exempted pairs of links are `allowed_pairs` of the result, and whose "
          "named states give the values of joints that `hold` does not.",
          "None")
      .takes("xacro", xacro_type, xacro_text, "{}");
  define(
      m,
      [](nb::handle source, nb::handle base, nb::handle tip, nb::handle hold, nb::handle package,
         nb::handle srdf, nb::handle xacro) {
        const KeptExpansions expansions(xacro_arguments(xacro));
        const auto end = [](nb::handle name, const char* what) {
          return Value<std::optional<std::string>>::from(name, what).value_or("");
        };
        ShapeOptions options = shape_options(hold, package);
        if (!srdf.is_none()) options.srdf = path_from(srdf, "srdf");
        const std::string path = path_from(source, "source");
        ArmShapes read = read_arm_shapes(path, {end(base, "base"), end(tip, "tip")}, options);
        if (!read.links_with_planes.empty()) {
          warn_of_input(planes_note(path, read.links_with_planes));
        }
        return read;
      },
      shapes, nb::arg("source"), nb::kw_only(), nb::arg("base") = nb::none(),
      nb::arg("tip") = nb::none(), nb::arg("hold") = nb::dict(), nb::arg("package") = nb::dict(),
      nb::arg("srdf") = nb::none(), nb::arg("xacro") = nb::dict());
}

void bind_other_shape_files(nb::module_& m) {
  Signature written(
      "arm_to_json", "str",
      "Returns an arm with the shapes of its links as JSON, which Arm.load() and "
      "read_arm_shapes() read from a file. A body at only one of its link's joints "
      "is written as attached: it must then keep its clearance from both neighbours. Raises Error "
      "for a link that the arm does not have, and for two bodies of one name.");
  written.takes_arm().takes("links", argument_type<std::vector<LinkShapes>>(),
                            "Shapes of its links.");
  define(
      m,
      [](const Arm& arm, nb::handle links) {
        return Value<std::string>::to(
            arm_to_json(arm, Value<std::vector<LinkShapes>>::from(links, "links")));
      },
      written, nb::arg("arm"), nb::arg("links"));

  Signature behind(
      "behind_joints", argument_type<std::vector<LinkShapes>>(),
      "Returns the shapes of the links of an arm as shapes of the arm with more joints before its "
      "own: one after with_rail(), three after with_mobile_base(). The last of these joints "
      "carries "
      "what was fixed to the base, except the bodies named in `standing`. Raises Error for more "
      "than 100 joints.");
  behind.takes("links", argument_type<std::vector<LinkShapes>>(), "Shapes of the arm without them.")
      .takes("joints", "int", "Number of joints, 0 to 100.")
      .takes("standing", argument_type<std::vector<std::string>>(),
             "Names of bodies that stay on link 0: `ArmShapes.standing`.", "()");
  define(
      m,
      [](nb::handle links, nb::handle joints, nb::handle standing) {
        return Value<std::vector<LinkShapes>>::to(
            behind_joints(Value<std::vector<LinkShapes>>::from(links, "links"),
                          Value<std::size_t>::from(joints, "joints"),
                          Value<std::vector<std::string>>::from(standing, "standing")));
      },
      behind, nb::arg("links"), nb::arg("joints"), nb::arg("standing") = nb::tuple());

  Signature tool(
      "read_tool_shapes", "LinkShapes",
      "Reads the shapes of a tool from a JSON file, posed in the arm's tool frame. Raises "
      "FileError for an invalid file.");
  tool.takes("path", path_like, "The file.")
      .takes("arm", arm_like, "The arm that carries the tool.");
  define(
      m,
      [](nb::handle path, const Arm& arm) {
        return read_tool_shapes(path_from(path, "path"), arm);
      },
      tool, nb::arg("path"), nb::arg("arm"));
}

void warn_of_far_obstacles(const Arm& arm, const Scene& scene) {
  const std::vector<std::string> far = far_obstacles(arm, scene);
  if (!far.empty()) warn_of_input(far_obstacles_note(far));
}

void bind_bodies_of_model(nb::class_<CollisionModel>& model) {
  model
      .def_prop_ro(
          "links",
          [](const CollisionModel& self) {
            return Value<std::vector<LinkShapes>>::to(self.links());
          },
          getter("links", Value<std::vector<LinkShapes>>::type()),
          "The bodies of the arm, as they were given.")
      .def_prop_ro("scene", &CollisionModel::scene, getter("scene", "Scene"),
                   "The obstacles with the pairs that may touch, as they were given.");
}

void bind_model(nb::module_& m) {
  nb::class_<CollisionModel> model(
      m, "CollisionModel", docstring(header_text("CollisionModel", ""), "CollisionModel", ""));
  Signature made(
      "__init__", "None",
      "Prepares an arm with the shapes of its links in a scene. Raises Error for a shape, "
      "a name or a clearance that is not valid.");
  made.takes("self")
      .takes_arm()
      .takes("links", argument_type<std::vector<LinkShapes>>(), "Shapes of its links.")
      .takes("scene", "Scene | None", "The obstacles.", "None")
      .options<CollisionOptions>();
  define(
      model,
      [](CollisionModel* self, const Arm& arm, nb::handle links, nb::handle scene,
         const nb::kwargs& keywords) {
        auto asked = options<CollisionOptions>(keywords);
        const auto shapes = Value<std::vector<LinkShapes>>::from(links, "links");
        const auto around = Value<std::optional<Scene>>::from(scene, "scene").value_or(Scene());
        CollisionModel prepared =
            unlocked(asked.budget, [&] { return CollisionModel(arm, shapes, around, asked); });
        warn_of_far_obstacles(arm, around);
        new (self) CollisionModel(std::move(prepared));
      },
      made, nb::arg("arm"), nb::arg("links"), nb::arg("scene") = nb::none(), nb::arg("keywords"));
  bind_copy(model, "CollisionModel", itself);
  bind_bodies_of_model(model);
  model.def_prop_ro("arm", &CollisionModel::arm, getter("arm", "Arm"), "The arm.")
      .def_prop_ro("pair_count", &CollisionModel::pair_count, getter("pair_count", "int"),
                   "Number of pairs that count: of a link's shape and an obstacle's shape or "
                   "point, or of two links' shapes.")
      .def_prop_ro("apart_count", &CollisionModel::apart_count, getter("apart_count", "int"),
                   "Number of pairs of two links' shapes that count only outside the position "
                   "limits.")
      .def_prop_ro("clearance", &CollisionModel::clearance, getter("clearance", "float"),
                   "Distance that is kept, m, except from obstacles with their own.")
      .def_prop_ro(
          "digest", [](const CollisionModel& self) { return digest(self); },
          getter("digest", "str"),
          "A fingerprint of what the model checks: shapes, poses, clearances and pairs, but "
          "neither "
          "names nor the arm.")
      .def_prop_ro(
          "neighbour_pairs",
          [](const CollisionModel& self) {
            return Value<std::vector<NamedPair>>::to(self.neighbour_pairs());
          },
          getter("neighbour_pairs", Value<std::vector<NamedPair>>::type()),
          "Pairs of bodies of the arm that share a joint and, for this reason, do not count.");
  Signature mounted("with_mount", "CollisionModel",
                    "Returns the model of the arm mounted in the world, as Arm.with_mount(); "
                    "obstacles stay where they are.");
  mounted.takes("self").takes("world_T_mount", array_like, pose_doc);
  define(
      model,
      [](const CollisionModel& self, nb::handle pose) {
        return with_mount(self, PosePlane::frame(self.arm(), pose, "world_T_mount"));
      },
      mounted, nb::arg("world_T_mount"));
}

}  // namespace

nb::object Value<ShapeBody>::to(const ShapeBody& value) {
  return std::visit([](const auto& body) { return nb::object(nb::cast(body)); }, value);
}

ShapeBody Value<ShapeBody>::from(nb::handle value, const char* name) {
  if (nb::isinstance<Sphere>(value)) return nb::cast<Sphere>(value);
  if (nb::isinstance<Capsule>(value)) return nb::cast<Capsule>(value);
  if (nb::isinstance<Box>(value)) return nb::cast<Box>(value);
  if (nb::isinstance<Cylinder>(value)) return nb::cast<Cylinder>(value);
  if (nb::isinstance<HalfSpace>(value)) return nb::cast<HalfSpace>(value);
  if (nb::isinstance<ConvexHull>(value)) return nb::cast<ConvexHull>(value);
  raise_type(name, type(), value);
}

bool Value<ShapeBody>::same(const ShapeBody& a, const ShapeBody& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&b](const auto& body) {
        using T = std::decay_t<decltype(body)>;
        return Value<T>::same(body, std::get<T>(b));
      },
      a);
}

nb::object Value<std::vector<Vector3>>::to(const std::vector<Vector3>& value) {
  NewArray array({static_cast<Index>(value.size()), 3});
  double* next = array.data();
  for (const Vector3& point : value) {
    for (const double coordinate : point) *next++ = coordinate;
  }
  return array.release_read_only();
}

std::vector<Vector3> Value<std::vector<Vector3>>::from(nb::handle value, const char* name) {
  std::vector<Vector3> points;
  for (const Configuration& row : Value<std::vector<Configuration>>::from(value, name)) {
    if (row.size() != 3) throw Error(std::string(name) + ": expected rows of 3 coordinates");
    points.emplace_back(row);
  }
  return points;
}

nb::object Value<std::map<std::string, std::string>>::to(
    const std::map<std::string, std::string>& value) {
  nb::dict texts;
  for (const auto& [name, text] : value) {
    texts[Value<std::string>::to(name)] = Value<std::string>::to(text);
  }
  return texts;
}

std::map<std::string, std::string> Value<std::map<std::string, std::string>>::from(
    nb::handle value, const char* name) {
  if (!nb::isinstance<nb::dict>(value)) raise_type(name, "a dict", value);
  std::map<std::string, std::string> folders;
  for (const auto& [key, folder] : nb::borrow<nb::dict>(value)) {
    folders[Value<std::string>::from(key, name)] = path_from(folder, name);
  }
  return folders;
}

void bind_collisions(nb::module_& m) {
  bind_record<Sphere>(m);
  bind_record<Capsule>(m);
  bind_record<Box>(m);
  bind_record<Cylinder>(m);
  bind_half_space(m);
  bind_record<ConvexHull>(m);
  bind_record<Shape>(m);
  bind_record<PointCloud>(m);
  bind_record<Obstacle>(m);
  bind_record<Scene>(m);
  bind_record<LinkShapes>(m);
  bind_record<ArmShapes>(m);
  bind_record<BodyDistance>(m);
  bind_record<ClearanceRecovery>(m);
  bind_record<ClearanceProof>(m);
  bind_record<ClearanceOverTime>(m);
  bind_scene(m);
  bind_shape_files(m);
  bind_other_shape_files(m);
  bind_model(m);
  m.def(
      "_collision_files",
      [](const CollisionModel& model) {
        const CollisionFiles files = collision_files(model);
        return nb::make_tuple(nb::str(files.arm.data(), files.arm.size()),
                              nb::str(files.scene.data(), files.scene.size()));
      },
      nb::arg());  // for the page
}

}  // namespace beeline::python
