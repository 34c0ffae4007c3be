"""Tries an installed wheel: kinematics, inverse kinematics, a line, the page, the command, the licences of what it holds; prints
the time of its import."""

import importlib.metadata
import re
import statistics
import subprocess
import sys

import numpy

import beeline


def import_milliseconds() -> float:
    """The import beyond numpy's own, milliseconds: the median of 11 fresh interpreters."""
    code = "import numpy, time; begin = time.perf_counter(); import beeline; print(time.perf_counter() - begin)"
    runs = [subprocess.check_output([sys.executable, "-I", "-c", code]) for _ in range(11)]
    return 1e3 * statistics.median(map(float, runs))


arm = beeline.arms.panda()
q = numpy.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
pose = beeline.forward_kinematics(arm, q)
pose[2, 3] -= 0.1
found = beeline.inverse_kinematics(arm, pose, seed=q)
assert found and numpy.allclose(beeline.forward_kinematics(arm, found.q), pose, atol=1e-6), found
many = beeline.batch_inverse(arm, numpy.tile(pose, (100, 1, 1)))
motion = beeline.move_in_lines(arm, q, [pose])
assert motion and len(motion.trajectory) > 10, motion

from beeline._page_document import document_of  # what beeline.view() opens

assert 'id="saved-core-module">' in document_of(arm, None, motion.trajectory)

for command in ([sys.executable, "-I", "-m", "beeline"], [sys.prefix + "/bin/beeline"]):
    printed = subprocess.check_output([*command, "--help"], text=True)
    assert "Usage: beeline VERB" in printed
    refused = subprocess.run([*command, "ik", "rrr", "--pose", "100,0,0"], capture_output=True)
    assert refused.returncode == 1 and refused.stderr

files = [str(path) for path in importlib.metadata.files("beeline-arms")]
licences = {name.rpartition("/")[2] for name in files if ".dist-info/licenses/" in name}
shipped = set(re.findall(r"beeline_arms\.libs/(lib[\w-]+?)-[0-9a-f]{8}\.so", "\n".join(files)))
headers = {"libcli11", "libeigen3", "libfast-float", "libfmt", "nlohmann-json3"}
assert "libtbb" in shipped, files
wanted = {"LICENSE", "Apache-2.0.txt", "nanobind.txt"} | {f"{library}-dev.txt" for library in shipped | headers}
assert wanted <= licences, wanted - licences

print(
    f"Python {sys.version.split()[0]}, numpy {numpy.__version__}: beeline {beeline.__version__} works,"
    f" imported in {import_milliseconds():.1f} ms after numpy"
)
