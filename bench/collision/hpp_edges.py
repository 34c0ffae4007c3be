"""HPP's certified validations, Dichotomy and Progressive, of the edges that bench_edges wrote: Markdown tables.

Usage: hpp_edges.py EDGES.jsonl ARM.urdf [--passes 3]

HPP asks for contact (clearance 0) and Beeline for its clearance, so an edge whose least distance is between them has two
right answers. The referee is the least of coal's distances along the edge, from bench_edges. The arm's shapes are spheres,
boxes and cylinders: meshes would need HPP's hulls. Times are CPU times of a call from Python; LD_LIBRARY_PATH must name
the folder lib of the wheels' prefix (cmeel.prefix)."""

import argparse
import itertools
import json
import statistics
import time
import xml.etree.ElementTree as xml

import numpy as np
from pinocchio import SE3, rpy
from pyhpp.core import Dichotomy, Problem, Progressive, Straight
from pyhpp.pinocchio import Device
from pyhpp.pinocchio.urdf import loadModelFromString

METHODS = {"Dichotomy": (Dichotomy, 0.0), "Progressive, 1 mm": (Progressive, 1e-3), "Progressive, 10 mm": (Progressive, 1e-2)}
PRECISION = 1e-6  # of coal's distances, m


def words(numbers):
    return " ".join(map(repr, map(float, numbers)))


def origin(pose):
    """The position and the angles of a pose of a scene file, which has a matrix where angles would not read back exactly."""
    if "matrix" not in pose:
        return {key: pose.get(key, [0, 0, 0]) for key in ("xyz", "rpy")}
    matrix = np.array(pose["matrix"], dtype=float)
    return {"xyz": matrix[:3, 3], "rpy": rpy.matrixToRpy(matrix[:3, :3])}


def add_obstacle(robot, root, obstacle):
    """Appends a link with the obstacle's shapes, fixed to the root link."""
    name = f"obstacle_{obstacle['name']}"
    link = xml.SubElement(robot, "link", name=name)
    for shape in obstacle["shapes"]:
        collision = xml.SubElement(link, "collision")
        xml.SubElement(collision, "origin", {key: words(value) for key, value in origin(shape.get("pose", {})).items()})
        geometry = xml.SubElement(collision, "geometry")
        if "box" in shape:
            xml.SubElement(geometry, "box", size=words(shape["box"]["size"]))
        else:
            xml.SubElement(geometry, "cylinder", {key: repr(value) for key, value in shape["cylinder"].items()})
    joint = xml.SubElement(robot, "joint", name=f"{name}_joint", type="fixed")
    xml.SubElement(joint, "parent", link=root)
    xml.SubElement(joint, "child", link=name)
    return name


def joint_counts(robot):
    """For each link the number of joints that move between the root and the link."""
    parents = {joint.find("child").get("link"): joint for joint in robot.iter("joint") if joint.find("parent") is not None}

    def count(link):
        if link not in parents:
            return 0
        joint = parents[link]
        return count(joint.find("parent").get("link")) + (joint.get("type") != "fixed")

    return {link.get("name"): count(link.get("name")) for link in robot.findall("link")}


def device(urdf, scene):
    """The arm among the obstacles; pairs of links at one joint, of obstacles with link 0, and allowed pairs are excluded."""
    robot = xml.fromstring(urdf)
    for link in robot.findall("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    count = joint_counts(robot)
    root = next(iter(count))
    names = [add_obstacle(robot, root, obstacle) for obstacle in scene["obstacles"]]
    excluded = [tuple(pair) for pair in scene.get("allowed_pairs", [])]
    excluded += [pair for pair in itertools.combinations(count, 2) if abs(count[pair[0]] - count[pair[1]]) < 2]
    excluded += [(link, name) for link, name in itertools.product(count, names) if count[link] == 0]
    excluded += itertools.combinations(names, 2)
    srdf = "".join(f'<disable_collisions link1="{a}" link2="{b}"/>' for a, b in excluded)
    made = Device("arm")
    loadModelFromString(made, 0, "", "anchor", xml.tostring(robot, encoding="unicode"), f'<robot name="{robot.get("name")}">{srdf}</robot>',
                        SE3.Identity())
    return made


def answers(urdf, scene, passes):
    """For each edge and method: whether HPP calls it valid, and the median time, microseconds."""
    robot = device(urdf, scene["scene"])
    problem = Problem(robot)
    steering = Straight(problem)
    validations = {name: kind(robot, tolerance) for name, (kind, tolerance) in METHODS.items()}
    for edge in scene.get("edges", []):
        path = steering(np.array(edge["from"]), np.array(edge["to"]))
        found = {}
        for name, validation in validations.items():
            times = []
            for _ in range(passes):
                start = time.process_time_ns()
                valid = validation.validate(path, False)[0]
                times.append((time.process_time_ns() - start) / 1000)
            found[name] = (valid, statistics.median(times))
        yield edge, found


def row(name, times):
    ordered = sorted(times)
    if not ordered:
        return
    mean = statistics.fmean(ordered)
    print(f"| {name} | {len(ordered)} | {mean:.1f} | {ordered[len(ordered) // 2]:.1f} | {ordered[len(ordered) * 95 // 100]:.1f}"
          f" | {ordered[-1]:.1f} | {1e6 / mean:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("edges")
    parser.add_argument("arm")
    parser.add_argument("--passes", type=int, default=3)
    options = parser.parse_args()
    with open(options.arm) as file:
        urdf = file.read()
    times = {name: {True: [], False: []} for name in METHODS}
    ours = {True: [], False: []}
    wrong, lines = dict.fromkeys(METHODS, 0), []
    differ = dict.fromkeys(METHODS, 0)
    with open(options.edges) as file:
        for line in file:
            scene = json.loads(line)
            for i, (edge, found) in enumerate(answers(urdf, scene, options.passes)):
                clear = edge["certified"] == "clear"
                ours[clear].append(edge["certified_us"])
                for name, (valid, microseconds) in found.items():
                    times[name][valid].append(microseconds)
                    if valid == clear:
                        continue
                    differ[name] += 1
                    is_wrong = valid != (edge["least"] > 0) and abs(edge["least"]) > PRECISION
                    wrong[name] += is_wrong
                    lines.append(f"  {scene['name']} edge {i}: {name} {'valid' if valid else 'not valid'}, Beeline {edge['certified']};"
                                 f" least distance {1e3 * edge['least']:.6f} mm: HPP is {'wrong' if is_wrong else 'right about contact'}")
    print("| validation | edges | mean µs | median | 95 % | worst | edges a second |\n|---|---|---|---|---|---|---|")
    row("Beeline, clear", ours[True])
    row("Beeline, all", ours[True] + ours[False])
    for name in METHODS:
        row(f"HPP {name}, valid", times[name][True])
        row(f"HPP {name}, all", times[name][True] + times[name][False])
    print("\n| HPP | answers that differ from Beeline's | of these wrong by the referee |\n|---|---|---|")
    for name in METHODS:
        print(f"| {name} | {differ[name]} | {wrong[name]} |")
    print("\n".join(["", *lines]))


if __name__ == "__main__":
    main()
