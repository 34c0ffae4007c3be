#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/written_angles.h>

namespace beeline::internal {

std::vector<WrittenOrientation> written_orientations(const JsonDocument& document) {
  std::vector<WrittenOrientation> found;
  const auto add = [&](const Json& object, const char* key, const std::string& joint) {
    const Json* pose = document.find(object, key);
    const Json* rpy = pose == nullptr ? nullptr : document.find(*pose, "rpy");
    if (rpy != nullptr) found.push_back({joint, key, vector_from_json(document, *rpy), pose->line});
  };
  const Json& root = document.root();
  for (const char* key : {"base", "tool", "controller_base", "flange"}) add(root, key, "");
  if (const Json* screws = document.find(root, "screws")) add(*screws, "home", "");
  if (const Json* joints = document.find(root, "joints")) {
    for (const Json& joint : document.items(*joints)) {
      add(joint, "origin", document.text(document.need(joint, "name")));
    }
  }
  return found;
}

AngleUnit unit_of_dh(const JsonDocument& document) {
  const Json* dh = document.find(document.root(), "dh");
  const Json* degrees = dh == nullptr ? nullptr : document.find(*dh, "degrees");
  return degrees != nullptr && document.truth(*degrees) ? AngleUnit::degrees : AngleUnit::radians;
}

std::vector<WrittenDhAngle> written_dh_angles(const JsonDocument& document) {
  std::vector<WrittenDhAngle> found;
  const Json* dh = document.find(document.root(), "dh");
  if (dh == nullptr) return found;
  std::size_t i = 0;
  for (const Json& row : document.items(document.need(*dh, "rows"))) {
    for (const char* key : {"alpha", "theta"}) {
      const Json* angle = document.find(row, key);
      if (angle != nullptr) found.push_back({i, key, document.number(*angle), angle->line});
    }
    ++i;
  }
  return found;
}

}  // namespace beeline::internal
