"""Hostile arguments and files for the command: valid ones, mutated at random."""

import functools
import pathlib
import random
import re
import struct
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
NUMBERS = """0 -0 1 -1 1e-300 -1e-12 1e-9 0.5 1e3 1e6 -1e6 1e9 1e12 1e100 -1e154 1e300 1.7976931348623157e308 1e309 -1e999 nan NaN
inf -inf Infinity 4294967296 9223372036854775808 -9223372036854775809 0x10 1e 1,5 １２ 3.14159265358979323846264338327950288""".split()
WORDS = ["", " ", "'", '"', "--", "-", "\x1b[31m", "é", "\u202e", "a" * 3000, "R" * 3000, "panda", "..", "/", "%s%n", "\n", "\t", "=", "{}", "[]",
         "[" * 2000, "null", "../../etc/passwd"]

WAYPOINTS = b"x,y,z,roll,pitch,yaw\n0.4,0.2,0.3,3.1,0,0\n0.4,-0.2,0.3,3.1,0,0\n0.3,-0.2,0.4,3.1,0,0\n"
REACHABLE = b"x,y,z,roll,pitch,yaw\n0.25,0,0.1,1.5707963,0,0\n0.22,0,0.12,1.5707963,0,0\n"
PLANAR = b"x,y,theta\n4,4,0\n5,3,0\n4,3,0.2\n"
PROGRAM = b'motion,x,y,z,roll,pitch,yaw,speed,blend,dwell,relative\njoint,0.4,0.2,0.3,3.1,0,0,,,,\nline,0.4,-0.1,0.3,3.1,0,0,0.2,0.01,,\nline,0.4,-0.2,0.3,3.1,0,0,,,,\n' \
          b"via,0.35,-0.1,0.35,3.1,0,0,,,,\narc,0.4,0,0.4,3.1,0,0,,,0.5,\nline,0,0,-0.05,0,0,0,,,,previous\n"
PICK = (ROOT / "tests/fuzz/corpus/poses/attach").read_bytes()
PICK_CELL = b'{"obstacles": [{"name": "box", "shapes": [{"box": {"size": [0.6, 0.6, 0.6]}, "pose": {"xyz": [3, 2, 0]}}]},' \
    b'{"name": "bench", "shapes": [{"box": {"size": [3, 0.4, 1]}, "pose": {"xyz": [3.7, 1.5, 0]}}]},' \
    b'{"name": "fence", "shapes": [{"box": {"size": [0.1, 0.7, 1]}, "pose": {"xyz": [3.7, 2.05, 0]}}]}]}'
PLANAR_MOTION = b"t,joint1,joint2,joint3\n0,0.1,0.5,-0.4\n0.5,0.2,0.6,-0.5\n1,0.3,0.7,-0.6\n1.5,0.3,0.7,-0.6\n"
PANDA_MOTION = b"t," + b",".join(b"joint%d" % k for k in range(1, 8)) + b"," + b",".join(b"joint%d_vel" % k for k in range(1, 8)) + \
    b"\n" + b"\n".join(b"%g,0,%g,0,-1.5,0,1.5,0.7,0,0.1,0,0,0,0,0" % (0.1 * i, 0.01 * i) for i in range(30)) + b"\n"
JSON_MOTION = b'{"joint_names": ["joint1", "joint2", "joint3"], "points": [{"positions": [0.1, 0.5, -0.4], "time_from_start": {"sec": 0, "nanosec": 0}},' \
    b' {"positions": [0.2, 0.6, -0.5], "time_from_start": {"sec": 1, "nanosec": 500000000}}]}'
YAML_MOTION = b"joint_names: [joint1, joint2, joint3]\npoints:\n- positions: [0.1, 0.5, -0.4]\n  time_from_start: {sec: 0, nanosec: 0}\n" \
    b"- positions: [0.2, 0.6, -0.5]\n  time_from_start: {sec: 1, nanosec: 500000000}\n---\n"
LOG = b"timestamp shoulder_pan_joint shoulder_lift_joint elbow_joint wrist_1_joint wrist_2_joint wrist_3_joint\n" + \
    b"".join(b"%d 0,1 -1,%02d 1,2 0,3 1,5 3,%02d\n" % (1700000000000000000 + 20000000 * i, i, i) for i in range(30))
JOINT_MAP = b'{"joint1": "joint3", "joint2": {"sign": -1, "offset": 10, "unit": "deg"}, "joint3": {"name": "joint1"}}'
YAML_LIMITS = b"joint_limits:\n  joint1:\n    has_velocity_limits: true\n    max_velocity: 1.5\n    has_acceleration_limits: true\n    max_acceleration: 3\n" \
    b"  joint2:\n    has_position_limits: true\n    min_position: -1\n    max_position: 1\n"
JSON_LIMITS = b'{"joint1": {"lower": -2, "upper": 2, "velocity": 1.5}, "joint2": {"jerk": 50}}'
SRDF = b'<robot name="r"><group name="arm"><chain base_link="base" tip_link="gripper"/></group>' \
    b'<group_state name="home" group="arm"><joint name="shoulder" value="0.3"/></group_state></robot>'
DH = b'{"name": "d", "dh": {"convention": "modified", "rows": [{"d": 0.3}, {"a": 0.4, "alpha": 1.5707963267948966}]}}'
DEGREES = b'{"name": "e", "dh": {"convention": "modified", "degrees": true, "rows": [{"d": 0.3}, {"a": 0.4, "alpha": 90}]}}'
JOINTS = b"joint1,joint2,joint3\n0.1,0.2,0.3\n0.4,0.5,0.6\n"
NPY = b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }".ljust(127) + b"\n" + b"\0" * 48

PART = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf -1 -2 -3\n"
SCAN = b"ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + \
    struct.pack(">6f", 4, 5, 0, 0, 0, 1)
PART_STL = b"part".ljust(80, b"\0") + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0)
SHAPED = b"""<robot name="shaped"><link name="a"/><link name="b"><collision><origin xyz="0 0 2"/><geometry>
<mesh filename="part.stl" scale="1 1 -2"/></geometry></collision></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1" velocity="1"/></joint></robot>"""
CELL = b"""<robot name="cell"><link name="floor"/><link name="part"><collision><geometry><mesh filename="package://parts/part.obj"/>
</geometry></collision></link><joint name="slide" type="prismatic"><parent link="floor"/><child link="part"/><limit lower="0" upper="1"/>
</joint></robot>"""

FILES = {
    "moved.scene": (ROOT / "tests/fuzz/corpus/scene/moveit").read_bytes(), "cell.yaml": (ROOT / "tests/fuzz/corpus/scene/planning").read_bytes(),
    "shaped.json": (ROOT / "examples/planar_arm.json").read_bytes(), "cell.json": (ROOT / "examples/cell.json").read_bytes(),
    "scan.ply": SCAN, "pick.csv": PICK, "around.csv": PICK.replace(b"line,next", b"around,next"), "pick.json": PICK_CELL,
    "shaped.urdf": SHAPED, "cell.urdf": CELL, "part.obj": PART, "part.stl": PART_STL, "shaped.csv": b"t,j\n0,0\n1,0.1\n", "rail.csv": b"t,rail,j\n0,0,0\n1,0.5,0.1\n",
    "arm.xml": (ROOT / "tests/fuzz/corpus/mjcf/whole").read_bytes(), "arm.xacro": (ROOT / "docs/howto/robot.urdf").read_bytes(),
    "robot.urdf": (ROOT / "docs/howto/robot.urdf").read_bytes(),
    "gen3.json": (ROOT / "tests/inverse/arms/gen3.json").read_bytes(),
    "px150.json": (ROOT / "tests/inverse/arms/px150.json").read_bytes(),
    "ur5.json": (ROOT / "docs/howto/typed_ur5.json").read_bytes(),
    "poses.csv": WAYPOINTS, "reachable.csv": REACHABLE, "planar.csv": PLANAR, "program.csv": PROGRAM, "rrr.csv": PLANAR_MOTION, "panda.csv": PANDA_MOTION,
    "rrr.json": JSON_MOTION, "rrr.yaml": YAML_MOTION, "log.txt": LOG, "map.json": JOINT_MAP, "limits.yaml": YAML_LIMITS, "limits.json": JSON_LIMITS, "arm.srdf": SRDF, "joints.csv": JOINTS, "joints.npy": NPY, "dh.json": DH, "degrees.json": DEGREES,
}

POSE, PLANAR_POSE = "0.4,0.2,0.3,3.1,0,0", "4,4,0.1"
COMMANDS = [line.split() for line in f"""
show robot.urdf --tip gripper
show gen3.json --json
show arm.xml --tip grasp --json
fk arm.xml --tip hand --q 0.1,0.2
move arm.xml --tip hand --from 0,0 --to 0.1,0.2 --method quickest --self
doctor arm.xml --tip left
show arm.xacro --tip gripper
fk dh.json --q 0.1,0.2
show RRRP:1,2,0.5,1
show RHP:1,0.2p0.05,1 --as screws --json
show px150.json --as dh --convention modified --json
show robot.urdf --tip gripper --as dh --convention standard --degrees
show arm.xml --tip grasp --out out.urdf
show robot.urdf --tip gripper --mount 1,2,3 --velocity 2 --out out.xml
show gen3.json --tcp 0,0,0.1 --out out.mjcf
fk px150.json --q 0.1,0.2,0.3,0.4,0.5 --all
fk rrr --q 0.1,0.2,0.3 --json
jacobian ur5.json --q 0,1,1,0,1,0 --frame tool
ik gen3.json --pose {POSE} --all
ik ur5 --pose {POSE} --seed 0,1,1,0,1,0 --json
ik panda --pose {POSE} --redundancy centred --grid 20 --lock joint3=0.2
ik px150.json --pose 0.25,0,0.1,1.5707963,0,0 --pose-tolerance 0.01,0.01,0.01,0.1,0.1,3 --max-restarts 100 --max-iterations 50
ik RRPRH:1,1,0.1,1,0.1p0.02 --pose {PLANAR_POSE} --task position --tolerance 1e-8 --random-seed 3
batch fk rrr --in joints.csv --out out.csv
batch ik panda --in poses.csv --out out.csv --status
batch jacobian rrr --in joints.npy --out out.npy
move rrr --from 0.1,0.2,0.3 --to 0.5,0.1,0.9 --gain 0.5 --out out.csv
line rrr --through planar.csv --out out.csv --draw out.svg
line panda --through poses.csv --out out.json --blend 0.02 --rate 100
line ur5 --through program.csv --out out.csv --profile trapezoidal --max-samples 5000
ik px150.json --pose 0.25,0,0.1,0.3,1.2,0.1 --task approach:xy --all --seed 0.1,0.2,0.3,0.4,0.5
ik px150.json --pose 0.25,0,0.1,0,1.5707963,0 --task direction:x --all --lock wrist_rotate=0.3
line px150.json --through reachable.csv --task 111010:tool --tolerance 0.001 --max-samples 5000
line gen3.json --through poses.csv --path spline --tool-speed 0.2 --branches
check rrr line.csv --through planar.csv
check panda panda_line.csv --through poses.csv --tolerance 0.01
move rrr --from 0.1,0.2,0.3 --method quickest --through rrr.json --joint-blend 0.1 --profile quintic --out out.csv
retime panda panda.csv --out out.csv --joint-blend 0.05
move panda --from 0,-0.8,0,-0.0688,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 --method quickest --recover 0.002 --out out.csv
move panda --from 0,-0.8,0,-0.0688,0,1.6,0.8 --method quickest --through panda.csv --joint-blend 0.05 --recover 0.002 --out out.csv
check panda panda.csv --recover slight --moving-start --moving-end
retime panda panda.csv --out out.csv --velocity 1 --acceleration 2 --jerk 50
retime rrr rrr.json --out out.csv --rate 50 --profile quintic
replay rrr rrr.csv --out out.csv --speed-at 0:0.2 --rate 100
diff rrr rrr.csv rrr.json
diff rrr rrr.yaml rrr.csv --joint-map map.json
retime ur5 log.txt --out out.yaml
replay ur5 log.txt --time-unit ns --degrees
replay ur5 log.txt --angle-unit deg --degrees
export ur5 ur5_line.csv --as urscript --out out.script
draw robot.urdf --tip gripper --out out.svg --q 0.1,0.2,0.1,0
draw panda panda.csv --out out.svg
figure 1.6 --out out.svg
formula rrr --as latex
doctor robot.urdf --tip gripper
doctor dh.json degrees.json
reach map rrr --resolution 2 --directions 1 --out out.h5 --threads 2
reach map ur5 --resolution 0.5 --shard 1/2 --max-work 100000 --out out.h5
reach map panda --resolution 0.5 --by sampling --samples 20000 --out out.h5
reach query map.h5 --pose {PLANAR_POSE} --json
reach query azimuths.h5 --pose 0.4,0.2,0.3
reach slice map.h5 --at z=0 --out out.csv
reach slice azimuths.h5 --at z=0.2 --out out.svg
reach compare map.h5 other.h5 --at z=0 --out out.svg
reach place map.h5 --poses planar.csv --step 1 --max-checked 20
reach merge part1.h5 part2.h5 --out out.h5
reach export azimuths.h5 --out out.vti
show robot.urdf --srdf arm.srdf --group arm
ik shaped.json --pose 4.459,5.226,0 --degrees --all --scene cell.json --clearance 0.02 --allow hand,wall
ik shaped.json --pose 4.459,5.226,0 --degrees --scene scan.ply --radius 0.1
batch ik shaped.json --in planar.csv --out out.csv --status --scene cell.json --no-self
line shaped.json --through planar.csv --out out.csv --scene cell.json
move shaped.json --from 110,-60,-140 --to 80,-50,-120 --degrees --method around --scene cell.json --clearance 0.02 --allow hand,wall --max-edges 500 --out out.csv
move shaped.json --from 80,93,-85 --to 80,-50,-120 --degrees --method quickest --scene cell.json --clearance 0.05 --recover-clearance 0.05 --out out.csv
move shaped.json --from 80,93,-85 --to 80,-50,-120 --degrees --method around --scene cell.json --clearance 0.05 --recover-clearance 0.05 --max-edges 500 --out out.csv
check shaped.urdf shaped.csv --scene cell.urdf --package parts=. --hold slide=0.5 --srdf arm.srdf --moving-start --moving-end --recover-clearance 0.05
line shaped.json --from 110,-60,-140 --degrees --through pick.csv --out out.csv --scene pick.json
line shaped.json --from 110,-60,-140 --degrees --through around.csv --out out.csv --scene pick.json
check shaped.json pick_line.csv --degrees --through pick.csv --scene pick.json
reach map shaped.json --resolution 2 --directions 1 --scene cell.json --clearance 0.02 --allow hand,wall --out out.h5
check shaped.urdf shaped.csv --scene cell.urdf --package parts=. --hold slide=0.5 --srdf arm.srdf --moving-start --moving-end
check shaped.urdf shaped.csv --scene moved.scene --scene cell.yaml --moving-start --moving-end
move shaped.urdf --from 0 --to 0.1 --method quickest --self
fk rrr --q 0.1,0.2,0.3 --limits limits.yaml
fk rrr --q 0.1,0.2,0.3 --limits limits.json --tcp 0.1,0,0 --mount 1,2,0.5
ik ur5 --rail x:2 --pose {POSE} --seed 0.5,0,1,1,0,1,0 --json
line panda --through poses.csv --rail 1,1,0:-1:1 --out out.csv
show robot.urdf --tip gripper --rail z:0.5 --mobile-base -2:2,-1:1,-3:3 --out out.urdf
check shaped.urdf rail.csv --rail y:1 --self
arms --json
completion bash
""".strip().splitlines()]
OPTIONS = """--json --degrees --all --tcp --mount --rail --mobile-base --work --limits --velocity --acceleration --jerk --speed --task --rate --blend --path --profile --out
--tolerance --max-samples --max-iterations --max-restarts --grid --time-limit --max-work --seed --from --tool-speed --plot --help --weights --every-turn
--joint-map --angle-unit --time-unit --no-unwrap --limit-tolerance --ignore-limits --pose-tolerance --threads --settle --max-steps --gain --method --redundancy --base --tip --q --pose --degrees --scene --self --package --hold --clearance --radius --as --convention""".split()


# Files that the command makes, by the command lines before --out.
MADE = {
    "line.csv": "line rrr --through planar.csv",
    "panda_line.csv": "line panda --through poses.csv",
    "ur5_line.csv": "line ur5 --through poses.csv",
    "pick_line.csv": "line shaped.json --from 110,-60,-140 --degrees --through pick.csv --scene pick.json",
    "map.h5": "reach map rrr --resolution 1.5 --directions 1",
    "other.h5": "reach map rrr --resolution 1.5 --directions 1 --mount 1,0,0",
    "azimuths.h5": "reach map puma560 --resolution 0.4 --azimuths 0.5",
    "part1.h5": "reach map rrr --resolution 1.5 --directions 1 --shard 1/2",
    "part2.h5": "reach map rrr --resolution 1.5 --directions 1 --shard 2/2",
}


def is_in_build(command, line):
    """Whether the command has this verb: without HDF5 there is no `reach`."""
    return line[0] != "reach" or subprocess.run([command, "reach", "--help"], capture_output=True).returncode == 0


@functools.lru_cache
def valid_files(command):
    """All files that the command lines name: name -> bytes."""
    with tempfile.TemporaryDirectory() as path:
        folder = pathlib.Path(path)
        for name, data in FILES.items():
            (folder / name).write_bytes(data)
        made = {name: line.split() for name, line in MADE.items() if is_in_build(command, line.split())}
        for name, line in made.items():
            done = subprocess.run([command, *line, "--out", name], cwd=folder, capture_output=True, text=True)
            assert done.returncode == 0, f"beeline {' '.join(line)}: {done.stderr}"
        return {name: (folder / name).read_bytes() for name in [*FILES, *made]}


def mutated_bytes(rng, data):
    """The text with some numbers, bytes or passages changed."""
    for _ in range(rng.choice([1, 1, 1, 2, 5])):
        choice = rng.randrange(10)
        at = rng.randrange(len(data) + 1)
        numbers = list(NUMBER.finditer(data))
        if choice <= 4 and numbers:
            one = rng.choice(numbers)
            data = data[:one.start()] + rng.choice(NUMBERS).encode() + data[one.end():]
        elif choice == 5:
            data = data[:at]
        elif choice == 6:
            data = data[:at] + rng.choice(WORDS).encode() + data[at:]
        elif choice == 7:
            data = data[:at] + bytes(rng.randrange(256) for _ in range(rng.randrange(1, 9))) + data[at + rng.randrange(9):]
        elif choice == 8:
            end = min(len(data), at + rng.randrange(1, 400))
            data = data[:at] + data[at:end] * rng.choice([2, 3, 20, 300]) + data[end:]
        elif b"\n" in data:
            lines = data.split(b"\n")
            rng.shuffle(lines)
            data = b"\n".join(lines)
    return rng.choice([b""] + [data] * 40 + [data + b"9" * 3_000_000, data + b"\0" * 1000])[:4_000_000]


def mutated_argument(rng, argument):
    choice = rng.randrange(6)
    if choice <= 2:
        numbers = list(NUMBER.finditer(argument.encode()))
        if numbers and argument not in FILES | MADE:
            one = rng.choice(numbers)
            data = argument.encode()
            return (data[:one.start()] + rng.choice(NUMBERS).encode() + data[one.end():]).decode()
        return rng.choice(NUMBERS)
    if choice == 3:
        return rng.choice(WORDS)
    if choice == 4:
        return rng.choice([*FILES, *MADE, "/", ".", "folder", "pipe", "/dev/null", "/dev/zero", "/dev/full", "missing.csv", "R" * 100, "panda", "rrr", "RRR", "out.csv"])
    return argument + rng.choice([",1", ",", "0", "=", ":", "e400", " "])


def command(rng, valid):
    """One hostile command line, and the files that were changed, of the valid ones."""
    line = list(rng.choice(COMMANDS))
    changed = {}
    for name in valid:
        if name in line and rng.random() < 0.7:
            changed[name] = mutated_bytes(rng, valid[name])
    for _ in range(rng.choice([0, 0, 1, 1, 2])):
        choice = rng.randrange(4)
        at = rng.randrange(1, len(line)) if len(line) > 1 else 0
        if choice <= 1 and line:
            line[at] = mutated_argument(rng, line[at])
        elif choice == 2:
            line += [rng.choice(OPTIONS)] + ([rng.choice([*NUMBERS, *WORDS, *FILES, *MADE, POSE, "any"])] if rng.random() < 0.7 else [])
        else:
            del line[at:at + 1]
    return [argument.replace("\0", "") for argument in line], changed


def generator(seed):
    return random.Random(seed)
