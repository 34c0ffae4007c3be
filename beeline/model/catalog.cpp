#include <array>
#include <functional>
#include <numbers>

#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/model/composite.h>
#include <beeline/model/dh.h>
#include <beeline/pose/orientation.h>

namespace beeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double deg = pi / 180;
constexpr double inch = 0.0254;

Limits within(double lower, double upper) { return {.lower = lower, .upper = upper}; }

struct DhJoint {
  DhRow row;
  Limits limits;
};

Arm dh_arm(const std::string& name, DhConvention convention, const std::vector<DhJoint>& rows,
           const Pose& tool = Pose::Identity()) {
  std::vector<Joint> joints;
  for (const DhJoint& row : rows) {
    Joint joint = dh_joint(row.row, convention);
    joint.name = "joint" + std::to_string(joints.size() + 1);
    joint.limits = row.limits;
    joints.push_back(joint);
  }
  return {name, joints, tool};
}

Arm planar_arm(const std::string& name, std::string_view letters,
               const std::vector<double>& lengths, const std::vector<double>& angles) {
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const Joint joint = composite_joint(letters[i], "joint" + std::to_string(i + 1)).front();
    joints.push_back(planar_link(joint, lengths[i], angles[i]));
  }
  return {name, joints};
}

Arm rrr() { return planar_arm("rrr", "RRR", {3.5, 3.5, 2}, {0, 0, 0}); }
Arm rp() { return planar_arm("rp", "RP", {1, 0}, {0, 0}); }
Arm gantry() { return planar_arm("gantry", "PP", {0, 0}, {0, pi / 2}); }

// Corke & Armstrong-Helouvry, "A search for consensus among model parameters reported for the
// PUMA 560 robot", ICRA 1994; no pedestal.
Arm puma560() {
  return dh_arm("puma560", DhConvention::standard,
                {{{.a = 0, .alpha = pi / 2, .d = 0}, within(-160 * deg, 160 * deg)},
                 {{.a = 0.4318, .alpha = 0, .d = 0}, within(-45 * deg, 225 * deg)},
                 {{.a = 0.0203, .alpha = -pi / 2, .d = 0.15005}, within(-225 * deg, 45 * deg)},
                 {{.a = 0, .alpha = pi / 2, .d = 0.4318}, within(-110 * deg, 170 * deg)},
                 {{.a = 0, .alpha = -pi / 2, .d = 0}, within(-100 * deg, 100 * deg)},
                 {{.a = 0, .alpha = 0, .d = 0}, within(-266 * deg, 266 * deg)}});
}

// Universal Robots, "DH parameters for calculations of kinematics and dynamics" (maker's support
// page). The e-series differs in every length.
Arm universal_robot(const std::string& name, const std::array<double, 4>& d, double a2, double a3) {
  const Limits range = within(-2 * pi, 2 * pi);
  return dh_arm(name, DhConvention::standard,
                {{{.alpha = pi / 2, .d = d[0]}, range},
                 {{.a = a2}, range},
                 {{.a = a3}, range},
                 {{.alpha = pi / 2, .d = d[1]}, range},
                 {{.alpha = -pi / 2, .d = d[2]}, range},
                 {{.d = d[3]}, range}});
}
Arm ur5() { return universal_robot("ur5", {0.089159, 0.10915, 0.09465, 0.0823}, -0.425, -0.39225); }
Arm ur5e() { return universal_robot("ur5e", {0.1625, 0.1333, 0.0997, 0.0996}, -0.425, -0.3922); }

// Franka Emika, "Robot and interface specifications": DH parameters and limits of the Panda.
Arm panda() {
  return dh_arm(
      "panda", DhConvention::modified,
      {{{.a = 0, .alpha = 0, .d = 0.333}, {-2.8973, 2.8973, 2.1750, 15, 7500}},
       {{.a = 0, .alpha = -pi / 2, .d = 0}, {-1.7628, 1.7628, 2.1750, 7.5, 3750}},
       {{.a = 0, .alpha = pi / 2, .d = 0.316}, {-2.8973, 2.8973, 2.1750, 10, 5000}},
       {{.a = 0.0825, .alpha = pi / 2, .d = 0}, {-3.0718, -0.0698, 2.1750, 12.5, 6250}},
       {{.a = -0.0825, .alpha = -pi / 2, .d = 0.384}, {-2.8973, 2.8973, 2.6100, 15, 7500}},
       {{.a = 0, .alpha = pi / 2, .d = 0}, {-0.0175, 3.7525, 2.6100, 20, 10000}},
       {{.a = 0.088, .alpha = pi / 2, .d = 0}, {-2.8973, 2.8973, 2.6100, 20, 10000}}},
      make_pose({0, 0, 0.107}));
}

// KUKA, "LBR iiwa 7 R800, LBR iiwa 14 R820: specification": dimensions and axis ranges.
Arm iiwa14() {
  return dh_arm("iiwa14", DhConvention::modified,
                {{{.alpha = 0, .d = 0.36}, within(-170 * deg, 170 * deg)},
                 {{.alpha = -pi / 2, .d = 0}, within(-120 * deg, 120 * deg)},
                 {{.alpha = pi / 2, .d = 0.42}, within(-170 * deg, 170 * deg)},
                 {{.alpha = pi / 2, .d = 0}, within(-120 * deg, 120 * deg)},
                 {{.alpha = -pi / 2, .d = 0.4}, within(-170 * deg, 170 * deg)},
                 {{.alpha = -pi / 2, .d = 0}, within(-120 * deg, 120 * deg)},
                 {{.alpha = pi / 2, .d = 0.126}, within(-175 * deg, 175 * deg)}});
}

// Adept Cobra s600 (user's guide: inner link 325 mm, outer link 275 mm, ranges of the axes), the
// quill rotates before it translates, as in the chapter's RRRP; z of the tool points down.
Arm scara() {
  return dh_arm("scara", DhConvention::standard,
                {{{.a = 0.325, .d = 0.387}, within(-105 * deg, 105 * deg)},
                 {{.a = 0.275, .alpha = pi}, within(-150 * deg, 150 * deg)},
                 {{}, within(-360 * deg, 360 * deg)},
                 {{.kind = JointKind::prismatic}, within(0, 0.210)}});
}

// Scheinman's Stanford arm: lengths after Paul, "Modelling, trajectory calculation and servoing of
// a computer controlled arm", Stanford AIM-177, 1972, Figure 2.3.
Arm stanford() {
  const Limits range = within(-170 * deg, 170 * deg);
  return dh_arm("stanford", DhConvention::standard,
                {{{.alpha = -pi / 2, .d = 0.412}, range},
                 {{.alpha = pi / 2, .d = 0.154}, range},
                 {{.theta = -pi / 2, .kind = JointKind::prismatic}, within(12 * inch, 50 * inch)},
                 {{.alpha = -pi / 2}, range},
                 {{.alpha = pi / 2}, within(-90 * deg, 90 * deg)},
                 {{.d = 0.263}, range}});
}

struct Entry {
  std::string_view name;
  std::string_view summary;
  Arm (*build)();
};

constexpr std::array<Entry, 10> catalog{{
    {"rrr", "planar RRR of Dellaert's chapter, links 3.5, 3.5, 2", rrr},
    {"rp", "planar RP, a link of 1 and a prismatic joint", rp},
    {"gantry", "planar PP at right angles: a constant Jacobian", gantry},
    {"puma560", "Unimation Puma 560, RRRRRR, standard DH, no pedestal", puma560},
    {"ur5", "Universal Robots UR5, RRRRRR, standard DH", ur5},
    {"ur5e", "Universal Robots UR5e, RRRRRR, standard DH", ur5e},
    {"panda", "Franka Emika Panda, 7R, modified DH, tool at the flange", panda},
    {"iiwa14", "KUKA LBR iiwa 14 R820, 7R, modified DH", iiwa14},
    {"scara", "Adept Cobra s600, RRRP, standard DH", scara},
    {"stanford", "Stanford arm, RRPRRR, standard DH", stanford},
}};

const Entry& entry(std::string_view name) {
  for (const Entry& candidate : catalog) {
    if (candidate.name == name) return candidate;
  }
  throw unknown_name("built-in arm", name, built_in_names());
}

}  // namespace

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const Entry& candidate : catalog) names.emplace_back(candidate.name);
  return names;
}

std::string built_in_summary(std::string_view name) { return std::string(entry(name).summary); }

Arm built_in(std::string_view name) { return entry(name).build(); }

Joint planar_link(Joint joint, double length, double angle) {
  joint.offset = Eigen::AngleAxisd(angle, Vector3::UnitZ()) * joint.offset;
  return with_link_frame(std::move(joint), make_pose({length, 0, 0}));
}

}  // namespace beeline
