#include <algorithm>
#include <cmath>
#include <map>

#include <beeline/io/text/internal/arm_tree.h>
#include <beeline/io/text/internal/xml_writer.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

constexpr const char* mjcf_remark =
    "MJCF by Beeline, which knows no masses: boundmass and boundinertia stand for them.";

void write_pose(XmlWriter& xml, const Pose& pose) {
  if (!pose.translation().isZero(0)) xml.add("pos", coordinates_text(pose.translation()));
  if (pose.linear().isIdentity(0)) return;
  const Quaternion q = quaternion(pose.linear());
  xml.add("quat", coordinate_text(q.qw) + " " + coordinates_text({q.qx, q.qy, q.qz}));
}

void write_joint(XmlWriter& xml, const WrittenLink& link) {
  const Joint& joint = *link.joint;
  XmlWriter::Element element(xml, "joint");
  xml.add("name", joint.name);
  xml.add("type", kind(joint) == JointKind::prismatic ? "slide" : "hinge");
  if (!link.point.isZero(0)) xml.add("pos", coordinates_text(link.point));
  xml.add("axis", coordinates_text(link.axis));
  const Limits& limits = joint.limits;
  if (!std::isfinite(limits.lower) && !std::isfinite(limits.upper)) return;
  xml.add("range",
          exact(std::max(limits.lower, -no_limit)) + " " + exact(std::min(limits.upper, no_limit)));
}

/// The links that are connected to each link.
using Children = std::multimap<std::string, const WrittenLink*>;

void write_bodies(XmlWriter& xml, const Children& children, const std::string& parent) {
  const auto [begin, end] = children.equal_range(parent);
  for (auto child = begin; child != end; ++child) {
    const WrittenLink& link = *child->second;
    XmlWriter::Element body(xml, "body");
    xml.add("name", link.name);
    write_pose(xml, link.pose);
    if (link.joint != nullptr) write_joint(xml, link);
    write_bodies(xml, children, link.name);
  }
}

void write_couplings(XmlWriter& xml, const Arm& arm) {
  XmlWriter::Element equality(xml, "equality");
  for (const Joint& joint : arm.joints()) {
    if (!joint.mimic) continue;
    XmlWriter::Element coupling(xml, "joint");
    xml.add("joint1", joint.name);
    xml.add("joint2", joint.mimic->leader);
    xml.add("polycoef",
            exact(joint.mimic->offset) + " " + exact(joint.mimic->multiplier) + " 0 0 0");
  }
}

}  // namespace

std::string mjcf_text(const Arm& arm, const WrittenTree& tree) {
  XmlWriter xml;
  Children children;
  bool coupled = false;
  for (const WrittenLink& link : tree.links) {
    children.emplace(link.parent, &link);
    coupled = coupled || (link.joint != nullptr && link.joint->mimic);
  }
  {
    XmlWriter::Element model(xml, "mujoco");
    xml.add("model", arm.name());
    xml.comment(mjcf_remark);
    {
      XmlWriter::Element compiler(xml, "compiler");
      xml.add("angle", "radian");
      xml.add("boundmass", "1");
      xml.add("boundinertia", "0.01");
    }
    {
      XmlWriter::Element world(xml, "worldbody");
      write_bodies(xml, children, tree.root);
    }
    if (coupled) write_couplings(xml, arm);
  }
  return xml.text();
}

}  // namespace beeline::internal
