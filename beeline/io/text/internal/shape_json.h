#pragma once

#include <beeline/collision/scene.h>
#include <beeline/io/text/json.h>

namespace beeline::internal {

/// Reads a shape: {"box": {"size": [x, y, z]}, "pose": POSE, "padding": metres}, see read_scene().
/// Throws FileError that names the value, also for one that check_shape() refuses.
Shape shape_from_json(const JsonDocument& document, const Json& json);

/// Reads the member "shapes" of a body, a list.
std::vector<Shape> shapes_from_json(const JsonDocument& document, const Json& body);

/// Writes a shape on one line.
std::string shape_to_json(const Shape& shape);

}  // namespace beeline::internal
