"""The tree of a URDF file, read apart from Beeline and from Pinocchio."""

import sys
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path

ROBOTS = next(Path(sys.prefix).rglob("example-robot-data/robots"))


@dataclass
class UrdfJoint:
    kind: str
    parent: str
    mimic: tuple[str, float, float] | None  # leader, multiplier, offset

    @property
    def moves(self):
        return self.kind != "fixed"


class UrdfTree:
    def __init__(self, path):
        robot = xml.parse(path).getroot()
        self.links = [link.get("name") for link in robot.findall("link")]
        self.joints = {}
        self.joint_above = {}  # by the link that it carries
        for joint in robot.findall("joint"):
            mimic = joint.find("mimic")
            self.joints[joint.get("name")] = UrdfJoint(
                joint.get("type"),
                joint.find("parent").get("link"),
                None
                if mimic is None
                else (
                    mimic.get("joint"),
                    float(mimic.get("multiplier", 1)),
                    float(mimic.get("offset", 0)),
                ),
            )
            self.joint_above[joint.find("child").get("link")] = joint.get("name")

    @property
    def root(self):
        return next(link for link in self.links if link not in self.joint_above)

    def leaves(self):
        parents = {joint.parent for joint in self.joints.values()}
        return [link for link in self.links if link not in parents]

    def unknown_leaders(self, tip):
        """Joints that some of the chain's mimic and that the file does not have."""
        mimics = [self.joints[name].mimic for name in self.moving_joints(tip)]
        return [mimic[0] for mimic in mimics if mimic and mimic[0] not in self.joints]

    def moving_joints(self, tip):
        """The names of the joints that move between the root and the tip, from the root on."""
        names = []
        while tip in self.joint_above:
            name = self.joint_above[tip]
            if self.joints[name].moves:
                names.insert(0, name)
            tip = self.joints[name].parent
        return names

    def drive(self, name, among):
        """The joint of `among` whose value drives this one, with the ratio and the shift: value =
        ratio * leader + shift. Of those that follow a leader which is not among them, the first
        one in the file drives the others."""
        leader, ratio, shift = self.leader(name, among)
        if leader == name:
            return name, 1.0, 0.0
        if leader in among:
            first, factor, offset = self.drive(leader, among)
            return first, ratio * factor, ratio * offset + shift
        first = next(j for j in self.joints if j in among and self.leader(j, among)[0] == leader)
        _, own_ratio, own_shift = self.leader(first, among)
        return first, ratio / own_ratio, shift - ratio / own_ratio * own_shift

    def leader(self, name, among):
        """The first leader among these, or the last one."""
        leader, ratio, shift = name, 1.0, 0.0
        while (mimic := self.joints[leader].mimic) and mimic[0] in self.joints:
            leader, ratio, shift = mimic[0], ratio * mimic[1], ratio * mimic[2] + shift
            if leader in among:
                break
        return leader, ratio, shift
