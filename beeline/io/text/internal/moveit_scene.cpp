#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_hull.h>
#include <beeline/io/text/internal/moveit_scene.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/ros_shapes.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_corners = 1'000'000;  ///< of one mesh

/// The words of a text, with the line of the last one.
class Words {
 public:
  Words(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  [[noreturn]] void refuse(const std::string& why) const { throw FileError(path_, line_, why); }

  /// Returns the rest of the line, without blanks at its ends.
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view rest = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return rest;
  }

  /// Returns the next word; `what` names it where the text ends.
  std::string_view word(std::string_view what) {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    if (at_ == begin) refuse("ends before " + std::string(what));
    return text_.substr(begin, at_ - begin);
  }

  /// Returns the line that follows, without reading it.
  std::string_view next_line() {
    skip_blanks();
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    return trimmed(text_.substr(at_, end - at_));
  }

  double real(const std::string& what) {
    const std::string_view text = word(what);
    try {
      return parse_number(text, what);
    } catch (const Error& error) {
      refuse(error.what());
    }
  }

  /// Returns a whole number from 0 to `most`.
  std::size_t count(const std::string& what, std::size_t most) {
    const double value = real(what);
    if (value >= 0 && value <= static_cast<double>(most) &&
        value == static_cast<double>(static_cast<std::size_t>(value))) {
      return static_cast<std::size_t>(value);
    }
    refuse(what + " is " + number(value) + "; it must be a whole number from 0 to " +
           std::to_string(most));
  }

  Vector3 vector(const std::string& what) {
    const double x = real(what), y = real(what), z = real(what);
    return {x, y, z};
  }

  /// Returns the pose of the lines "x y z" and "qx qy qz qw".
  Pose pose(const std::string& of) {
    const Vector3 position = vector("the position of " + of);
    const std::string what = "the orientation of " + of;
    const double qx = real(what), qy = real(what), qz = real(what), qw = real(what);
    try {
      return ros_pose(position, {qx, qy, qz, qw});
    } catch (const Error& error) {
      refuse(what + ": " + error.what());
    }
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  void skip_blanks() {
    for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
};

Shape mesh(Words& words, const std::string& path) {
  const std::size_t vertices = words.count("the number of vertices", max_corners);
  const std::size_t triangles = words.count("the number of triangles", 4 * max_corners);
  if (vertices == 0) words.refuse("the mesh has no vertices");
  std::vector<Vector3> corners;
  while (corners.size() < vertices) corners.push_back(words.vector("a vertex"));
  for (std::size_t i = 0; i < 3 * triangles; ++i) words.count("a corner", vertices - 1);
  return hull_of_corners(std::move(corners), path);
}

/// The type of a shape, and its sizes.
Shape typed_shape(Words& words, const std::string& path) {
  const std::string_view type = words.word("the type of a shape");
  if (type == "box") return {.body = Box{words.vector("a size of the box")}};
  if (type == "sphere") return {.body = Sphere{words.real("the radius")}};
  if (type == "cylinder" || type == "cone") {
    const double radius = words.real("the radius"), length = words.real("the length");
    return type == "cone" ? cone(radius, length) : Shape{.body = Cylinder{radius, length}};
  }
  if (type == "plane") {
    const Vector3 normal = words.vector("the normal of the plane");
    return plane(normal.x(), normal.y(), normal.z(), words.real("the offset of the plane"));
  }
  if (type == "mesh") return mesh(words, path);
  throw unknown_name("shape", type, {"box", "sphere", "cylinder", "cone", "plane", "mesh"});
}

/// A shape of an object at this pose, with its own pose and its colour.
Shape placed_shape(Words& words, const Pose& object, const std::string& path) {
  try {
    Shape shape = typed_shape(words, path);
    shape.pose = words.pose("a shape") * shape.pose;
    shape.pose = object * shape.pose;
    check_shape(shape);
    for (int i = 0; i < 4; ++i) words.real("the colour of a shape");
    return shape;
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    words.refuse(error.what());
  }
}

}  // namespace

Scene moveit_scene(std::string_view bytes, const std::string& path, const Pose& planning_frame) {
  Words words(text_in(bytes, path), path);
  if (words.rest_of_line().starts_with("* ")) {
    words.refuse("begins with an object; the first line is the name of the scene");
  }
  Scene scene;
  std::unordered_set<std::string> names;
  // The pose of an object, which the first version lacks, has blanks; the number of shapes has
  // none.
  std::optional<bool> has_poses;
  for (std::string_view marker; (marker = words.word("the line \".\" or an object")) != ".";) {
    if (marker != "*") words.refuse("an object begins with *, not with " + in_quotes(marker));
    Obstacle obstacle{.name = std::string(words.rest_of_line())};
    try {
      check_name(obstacle.name, "the name of an object");
    } catch (const Error& error) {
      words.refuse(error.what());
    }
    const std::string quoted = in_quotes(obstacle.name);
    if (!names.insert(obstacle.name).second) words.refuse("has two objects " + quoted);
    if (!has_poses) has_poses = words.next_line().find_first_of(" \t") != std::string_view::npos;
    const Pose pose = *has_poses ? planning_frame * words.pose("object " + quoted) : planning_frame;
    const std::size_t count = words.count("the number of shapes of " + quoted, 100'000);
    for (std::size_t i = 0; i < count; ++i) {
      obstacle.shapes.push_back(placed_shape(words, pose, path));
    }
    if (*has_poses) {
      const std::size_t subframes = words.count("the number of subframes of " + quoted, 100'000);
      for (std::size_t i = 0; i < subframes; ++i) {
        words.word("the name of a subframe");
        words.pose("a subframe");
      }
    }
    if (obstacle.shapes.empty()) words.refuse("object " + quoted + " has no shapes");
    scene.obstacles.push_back(std::move(obstacle));
  }
  if (!words.next_line().empty()) words.refuse("has text after the line \".\", which ends it");
  return scene;
}

}  // namespace beeline::internal
