#include <algorithm>
#include <cmath>

#include <beeline/io/text/internal/arm_tree.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/xml_writer.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

constexpr const char* urdf_remark =
    "URDF by Beeline: m, rad, s. An effort or a velocity of 0 is not known.";

/// Writes the limits. A joint without position limits is continuous; another one has both, as the
/// format has no other way to omit one.
void write_limit(XmlWriter& xml, const Joint& joint, bool continuous) {
  const Limits& limits = joint.limits;
  const auto known = [](double rate) { return std::isfinite(rate) ? rate : 0.0; };
  XmlWriter::Element element(xml, "limit");
  if (!continuous) {
    xml.add("lower", exact(std::max(limits.lower, -no_limit)));
    xml.add("upper", exact(std::min(limits.upper, no_limit)));
  }
  xml.add("effort", "0");
  xml.add("velocity", exact(known(limits.velocity)));
  if (std::isfinite(limits.acceleration)) xml.add("acceleration", exact(limits.acceleration));
  if (std::isfinite(limits.jerk)) xml.add("jerk", exact(limits.jerk));
}

void write_end(XmlWriter& xml, const char* end, const std::string& link) {
  XmlWriter::Element element(xml, end);
  xml.add("link", link);
}

void write_origin(XmlWriter& xml, const Pose& pose) {
  XmlWriter::Element element(xml, "origin");
  xml.add("xyz", coordinates_text(pose.translation()));
  xml.add("rpy", coordinates_text(short_rpy(pose.linear()).value));
}

void write_joint(XmlWriter& xml, const WrittenLink& link, std::vector<std::string>& names) {
  XmlWriter::Element element(xml, "joint");
  const Joint* const joint = link.joint;
  const bool slides = joint != nullptr && kind(*joint) == JointKind::prismatic;
  const bool continuous = joint != nullptr && !slides && !std::isfinite(joint->limits.lower) &&
                          !std::isfinite(joint->limits.upper);
  xml.add("name", joint == nullptr ? new_name(link.name + "_joint", names) : joint->name);
  xml.add("type", joint == nullptr ? "fixed"
                  : slides         ? "prismatic"
                  : continuous     ? "continuous"
                                   : "revolute");
  write_end(xml, "parent", link.parent);
  write_end(xml, "child", link.name);
  write_origin(xml, link.pose);
  if (joint == nullptr) return;
  {
    XmlWriter::Element axis(xml, "axis");
    xml.add("xyz", coordinates_text(link.axis));
  }
  write_limit(xml, *joint, continuous);
  if (!joint->mimic) return;
  XmlWriter::Element mimic(xml, "mimic");
  xml.add("joint", joint->mimic->leader);
  xml.add("multiplier", exact(joint->mimic->multiplier));
  xml.add("offset", exact(joint->mimic->offset));
}

void write_link(XmlWriter& xml, const std::string& name) {
  XmlWriter::Element element(xml, "link");
  xml.add("name", name);
}

}  // namespace

std::string urdf_text(const Arm& arm, const WrittenTree& tree) {
  XmlWriter xml;
  std::vector<std::string> names;
  for (const Joint& joint : arm.joints()) names.push_back(joint.name);
  {
    XmlWriter::Element robot(xml, "robot");
    xml.add("name", arm.name());
    xml.comment(urdf_remark);
    write_link(xml, tree.root);
    for (const WrittenLink& link : tree.links) {
      write_link(xml, link.name);
      write_joint(xml, link, names);
    }
  }
  return xml.text();
}

}  // namespace beeline::internal
