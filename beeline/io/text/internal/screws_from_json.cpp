#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/internal/joint_from_json.h>
#include <beeline/io/text/internal/name_json.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/screws_from_json.h>
#include <beeline/model/internal/ranges.h>

namespace beeline::internal {
namespace {

/// Reads [v w] of a row, from v or from a point of the axis.
Twist screw_from_row(const JsonDocument& document, const Json& row) {
  const Vector3 w = vector_from_json(document, document.need(row, "w"));
  const Json *v = document.find(row, "v"), *point = document.find(row, "point"),
             *pitch = document.find(row, "pitch");
  if ((v == nullptr) == (point == nullptr)) {
    document.refuse(row, v == nullptr ? "needs the key \"v\", or \"point\", a point of the axis"
                                      : "has both v and point; give one of them");
  }
  if (v != nullptr && pitch != nullptr) {
    document.refuse(*pitch, "is for a row with a point; v contains the pitch");
  }
  Twist screw;
  if (v != nullptr) {
    screw << vector_from_json(document, *v), w;
    return screw;
  }
  if (w.isZero(0)) document.refuse(*point, "is for rotations; a translation has w = 0 and v");
  screw << vector_from_json(document, *point).cross(w), w;
  if (pitch != nullptr) screw.head<3>() += document.number(*pitch) * w;
  return screw;
}

ScrewFrame frame_of(const JsonDocument& document, const Json& screws) {
  const Json& frame = document.need(screws, "frame");
  const std::string& text = document.text(frame);
  if (text == "space") return ScrewFrame::space;
  if (text == "body") return ScrewFrame::body;
  document.refuse(frame, "must be space (screws in the world) or body (in the tool)");
}

}  // namespace

Arm arm_from_screws_json(const JsonDocument& document, const Json& screws,
                         const std::string& name) {
  document.check_keys(screws, {"frame", "home", "rows"});
  const ScrewFrame frame = frame_of(document, screws);
  const Pose home = pose_from_json(document, document.need(screws, "home"));
  const Json::Items& rows = document.items(document.need(screws, "rows"));
  if (rows.size() > max_joints) {
    document.refuse(screws, "has " + std::to_string(rows.size()) + " rows; at most " +
                                std::to_string(max_joints) + " are accepted");
  }
  std::vector<Twist> twists;
  for (const Json& row : rows) {
    document.check_keys(row, {"name", "w", "v", "point", "pitch", "limits"});
    twists.push_back(screw_from_row(document, row));
  }
  try {
    const Arm arm = arm_from_screws(name, twists, home, frame);
    std::vector<Joint> joints = arm.joints();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (const Json* own = document.find(rows[i], "name")) {
        joints[i].name = name_from_json(document, *own);
      }
      const Json* pitch = document.find(rows[i], "pitch");
      if (pitch != nullptr && kind(joints[i]) == JointKind::revolute) {
        document.refuse(*pitch, "is a pitch of 0 to rounding; leave it out");
      }
      if (const Json* limits = document.find(rows[i], "limits")) {
        joints[i].limits = overridden({}, limit_overrides_from_json(document, *limits));
      }
    }
    return Arm(arm.name(), std::move(joints), arm.tool());
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    document.refuse(screws, std::string("is no arm: ") + error.what());
  }
}

}  // namespace beeline::internal
