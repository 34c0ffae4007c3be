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
        """The joint whose value drives this one (itself, unless it mimics one of `among`), with
        the ratio and the shift: value = ratio * leader + shift."""
        mimic = self.joints[name].mimic
        if mimic is None or mimic[0] not in among:
            return name, 1.0, 0.0
        leader, ratio, shift = self.drive(mimic[0], among)
        return leader, mimic[1] * ratio, mimic[1] * shift + mimic[2]
