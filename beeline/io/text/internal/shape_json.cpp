#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/shape_json.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

double member(const JsonDocument& document, const Json& body, const char* key) {
  return document.number(document.need(body, key));
}

/// Reads the members of a body of the type of operator()'s argument.
struct BodyReader {
  const JsonDocument& document;
  const Json& json;

  void operator()(Sphere& sphere) const {
    document.check_keys(json, {"radius"});
    sphere.radius = member(document, json, "radius");
  }
  void operator()(Capsule& capsule) const {
    document.check_keys(json, {"radius", "length"});
    capsule = {member(document, json, "radius"), member(document, json, "length")};
  }
  void operator()(Box& box) const {
    document.check_keys(json, {"size"});
    box.size = vector_from_json(document, document.need(json, "size"));
  }
  void operator()(Cylinder& cylinder) const {
    document.check_keys(json, {"radius", "length"});
    cylinder = {member(document, json, "radius"), member(document, json, "length")};
  }
  void operator()(HalfSpace&) const { document.check_keys(json, {}); }
  void operator()(ConvexHull& hull) const {
    document.check_keys(json, {"vertices"});
    for (const Json& vertex : document.items(document.need(json, "vertices"))) {
      hull.vertices.push_back(vector_from_json(document, vertex));
    }
  }
};

/// An empty body of a kind, by its place in Shape::Body.
template <std::size_t... i>
Shape::Body empty_body(std::size_t kind, std::index_sequence<i...>) {
  Shape::Body body;
  ((kind == i ? void(body.emplace<i>()) : void()), ...);
  return body;
}

struct BodyText {
  std::string operator()(const Sphere& sphere) const { return radius(sphere.radius) + "}"; }
  std::string operator()(const Capsule& capsule) const {
    return radius(capsule.radius) + ", \"length\": " + exact(capsule.length) + "}";
  }
  std::string operator()(const Box& box) const {
    return "{\"size\": " + json_numbers(box.size.data(), 3) + "}";
  }
  std::string operator()(const Cylinder& cylinder) const {
    return radius(cylinder.radius) + ", \"length\": " + exact(cylinder.length) + "}";
  }
  std::string operator()(const HalfSpace&) const { return "{}"; }
  std::string operator()(const ConvexHull& hull) const {
    std::string text = "{\"vertices\": [";
    for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
      text += (i == 0 ? "" : ", ") + json_numbers(hull.vertices[i].data(), 3);
    }
    return text + "]}";
  }

 private:
  static std::string radius(double value) { return "{\"radius\": " + exact(value); }
};

}  // namespace

Shape shape_from_json(const JsonDocument& document, const Json& json) {
  const std::vector<std::string> kinds = shape_kind_names();
  std::vector<std::string> known = kinds;
  known.insert(known.end(), {"pose", "padding", "hull_of"});
  document.check_keys(json, known);
  Shape shape;
  std::vector<std::string> given;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const Json* const body = document.find(json, kinds[kind]);
    if (body == nullptr) continue;
    given.push_back(kinds[kind]);
    shape.body = empty_body(kind, std::make_index_sequence<std::variant_size_v<Shape::Body>>());
    std::visit(BodyReader{document, *body}, shape.body);
  }
  if (given.size() != 1) {
    document.refuse(json, "needs exactly one of the keys " + listed(kinds) + "; it has " +
                              (given.empty() ? "none" : listed(given)));
  }
  if (const Json* pose = document.find(json, "pose"))
    shape.pose = shape_pose_from_json(document, *pose);
  if (const Json* padding = document.find(json, "padding")) {
    shape.padding = document.number(*padding);
  }
  if (const Json* mesh = document.find(json, "hull_of")) {
    shape.hull_of = document.text(*mesh);
    if (shape.hull_of.empty()) document.refuse(*mesh, "is empty; it is the path of a mesh");
  }
  try {
    check_shape(shape);
  } catch (const Error& error) {
    document.refuse(json, std::string("is no shape: ") + error.what());
  }
  return shape;
}

std::vector<Shape> shapes_from_json(const JsonDocument& document, const Json& body) {
  std::vector<Shape> shapes;
  for (const Json& shape : document.items(document.need(body, "shapes"))) {
    shapes.push_back(shape_from_json(document, shape));
  }
  return shapes;
}

std::string shape_to_json(const Shape& shape) {
  std::string text = "{\"" + kind_name(shape) + "\": " + std::visit(BodyText(), shape.body);
  if (!shape.pose.matrix().isIdentity(0)) text += ", \"pose\": " + pose_to_json(shape.pose);
  if (shape.padding != 0) {
    text += ", \"padding\": " + exact(shape.padding);
  }
  if (!shape.hull_of.empty()) text += ", \"hull_of\": " + json_string(shape.hull_of);
  return text + "}";
}

}  // namespace beeline::internal
