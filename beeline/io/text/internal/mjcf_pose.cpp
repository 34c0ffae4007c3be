#include <cmath>
#include <numbers>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/io/text/internal/mjcf_pose.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

constexpr double min_direction = 1e-10;

/// The direction of a vector. Refuses one without.
Vector3 direction(const MjcfAttributes& attributes, const char* attribute, const Vector3& vector) {
  const double largest = vector.cwiseAbs().maxCoeff();  // its square may exceed the numbers
  if (!(largest > min_direction) || !std::isfinite(largest)) {
    attributes.refuse(attribute, "has no direction: its length is " + number(largest));
  }
  return (vector / largest).normalized();
}

/// The smallest rotation from the z axis to a direction; opposite ones about x, as in MuJoCo.
Rotation rotation_to(const Vector3& z) {
  Vector3 axis = Vector3::UnitZ().cross(z);
  const double sine = axis.norm();
  axis = sine < min_direction ? Vector3::UnitX() : Vector3(axis / sine);
  return Eigen::AngleAxisd(std::atan2(sine, z.z()), axis).toRotationMatrix();
}

Rotation rotation_of_euler(const Vector3& angles, const MjcfSettings& settings) {
  Rotation rotation = Rotation::Identity();
  for (int i = 0; i < 3; ++i) {
    const char letter = settings.euler[static_cast<std::size_t>(i)];
    const bool fixed = letter <= 'Z';
    const Vector3 axis = Vector3::Unit(letter - (fixed ? 'X' : 'x'));
    const Rotation turn = Eigen::AngleAxisd(settings.radians(angles[i]), axis).toRotationMatrix();
    rotation = fixed ? Rotation(turn * rotation) : Rotation(rotation * turn);
  }
  return rotation;
}

Rotation rotation_of_quaternion(const MjcfAttributes& attributes) {
  const std::vector<double> q = attributes.numbers("quat", 4);
  Eigen::Vector4d wxyz(q[0], q[1], q[2], q[3]);
  const double largest = wxyz.cwiseAbs().maxCoeff();
  if (!(largest > min_direction)) attributes.refuse("quat", "has length 0");
  wxyz = (wxyz / largest).normalized();
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).toRotationMatrix();
}

/// The attribute that gives the orientation: the element's own or, without one, the innermost
/// class's that has any, as in MuJoCo 4. Two of the element are refused.
const char* orientation_given(const MjcfAttributes& attributes) {
  const char* given = nullptr;
  std::size_t nearest = 0;
  for (const char* attribute : mjcf_orientations) {
    const std::optional<std::size_t> level = attributes.level(attribute);
    if (!level || (given != nullptr && *level > nearest)) continue;
    if (given != nullptr && *level == 0 && nearest == 0) {
      attributes.refuse(attribute, std::string("is given beside ") + given + "; write one of them");
    }
    given = attribute;
    nearest = *level;
  }
  return given;
}

Rotation orientation(const MjcfAttributes& attributes, const MjcfSettings& settings) {
  const char* const given = orientation_given(attributes);
  if (given == nullptr) return Rotation::Identity();
  const std::string_view kind = given;
  if (kind == "quat") return rotation_of_quaternion(attributes);
  if (kind == "euler") {
    return rotation_of_euler(attributes.vector(given, Vector3::Zero()), settings);
  }
  if (kind == "zaxis") {
    return rotation_to(direction(attributes, given, attributes.vector(given, Vector3::Zero())));
  }
  if (kind == "axisangle") {
    const std::vector<double> a = attributes.numbers(given, 4);
    const Vector3 axis = direction(attributes, given, {a[0], a[1], a[2]});
    return Eigen::AngleAxisd(settings.radians(a[3]), axis).toRotationMatrix();
  }
  const std::vector<double> a = attributes.numbers(given, 6);
  Rotation axes;
  axes.col(0) = direction(attributes, given, {a[0], a[1], a[2]});
  const Vector3 y = Vector3(a[3], a[4], a[5]);
  axes.col(1) = direction(attributes, given, y - axes.col(0) * axes.col(0).dot(y));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

}  // namespace

double MjcfSettings::radians(double angle) const {
  return degrees ? angle * std::numbers::pi / 180 : angle;
}

MjcfSettings mjcf_settings(const MjcfDocument& document) {
  MjcfSettings settings;
  std::string assets, meshes;
  for (const XMLElement* at : document.children(document.root())) {
    if (std::string_view(at->Name()) != "compiler") continue;
    refuse_misspelt_attribute(
        *at,
        {"alignfree",    "angle",       "assetdir",      "autolimits",      "balanceinertia",
         "boundinertia", "boundmass",   "conflict",      "coordinate",      "discardvisual",
         "eulerseq",     "fitaabb",     "fusestatic",    "inertiafromgeom", "inertiagrouprange",
         "meshdir",      "passthrough", "savecanonical", "savecompiled",    "saveinertial",
         "settotalmass", "strippath",   "texturedir",    "usethread"});
    const MjcfAttributes attributes(*at);
    const auto truth = [&](const char* attribute, bool otherwise) {
      return attributes.choice(attribute, {"true", "false"}, otherwise ? "true" : "false") ==
             "true";
    };
    settings.degrees = attributes.choice("angle", {"degree", "radian"},
                                         settings.degrees ? "degree" : "radian") == "degree";
    settings.autolimits = truth("autolimits", settings.autolimits);
    settings.strip_path = truth("strippath", settings.strip_path);
    settings.euler = attributes.text_or("eulerseq", settings.euler);
    if (settings.euler.size() != 3 ||
        settings.euler.find_first_not_of("xyzXYZ") != std::string::npos) {
      attributes.refuse("eulerseq", "is " + in_quotes(settings.euler) +
                                        "; it must be three of x, y, z, X, Y and Z");
    }
    if (attributes.choice("coordinate", {"local", "global"}, "local") == "global") {
      attributes.refuse("coordinate",
                        "is global, which is not supported, as in MuJoCo since 2.3.3");
    }
    assets = attributes.text_or("assetdir", assets);
    meshes = attributes.text_or("meshdir", meshes);
  }
  settings.mesh_folder = meshes.empty() ? assets : meshes;
  return settings;
}

MjcfEnds mjcf_ends(const MjcfAttributes& attributes) {
  const std::vector<double> e = attributes.numbers("fromto", 6);
  MjcfEnds ends{.from = {e[0], e[1], e[2]}, .to = {e[3], e[4], e[5]}};
  if (!((ends.from - ends.to).cwiseAbs().maxCoeff() > min_direction)) {
    attributes.refuse("fromto", "has two ends at one place");
  }
  return ends;
}

Pose mjcf_pose(const MjcfAttributes& attributes, const MjcfSettings& settings) {
  if (attributes.source("fromto") != nullptr) {
    const MjcfEnds ends = mjcf_ends(attributes);
    return make_pose(ends.from / 2 + ends.to / 2,
                     rotation_to(direction(attributes, "fromto", ends.from - ends.to)));
  }
  return make_pose(attributes.vector("pos", Vector3::Zero()), orientation(attributes, settings));
}

}  // namespace beeline::internal
