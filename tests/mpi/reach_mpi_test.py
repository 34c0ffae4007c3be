"""beeline-reach-mpi: the map of one process, whatever the number of ranks, on several machines, after a rank was killed."""

import os
import signal
import subprocess
import time

import pytest

ARM = ["puma560", "--resolution", "0.06"]
NETWORK = "10.213.77"


@pytest.fixture
def mpirun(build):
    """A function that begins a job of so many ranks, each with one thread."""
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

    def begin(out, *options, arm=ARM, prefix=()):
        command = [*prefix, "mpirun", "--oversubscribe", *map(str, options), build / "beeline-reach-mpi", "map", *arm]
        command += ["--threads", "1", "--out", out]
        return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    return begin


@pytest.fixture
def whole(build, tmp_path):
    """A function that computes the same map by one process."""

    def compute(arm=ARM):
        path = tmp_path / "whole.h5"
        subprocess.run([build / "beeline", "reach", "map", *arm, "--out", path], check=True, capture_output=True)
        return path.read_bytes()

    return compute


def ended(job, code=0):
    out, err = job.communicate(timeout=300)
    assert job.returncode == code, err
    return out


@pytest.mark.parametrize("ranks", [1, 2, 5])
def test_the_map_does_not_depend_on_the_number_of_ranks(mpirun, whole, tmp_path, ranks):
    out = ended(mpirun(tmp_path / "map.h5", "-n", ranks))
    assert out.count("reached") == 1  # rank 0 alone answers
    assert (tmp_path / "map.h5").read_bytes() == whole()
    assert not (tmp_path / "map.h5.parts").exists()


def children(process):
    listed = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout
    return [int(word) for word in listed.split()]


def test_after_a_rank_was_killed_any_number_of_ranks_continues(mpirun, whole, tmp_path):
    arm = ["ur5", "--resolution", "0.05"]
    job = mpirun(tmp_path / "map.h5", "-n", 3, arm=arm)
    parts = tmp_path / "map.h5.parts"
    while job.poll() is None and len(list(parts.glob("slab-*.h5"))) < 3:
        time.sleep(0.01)
    os.kill(children(job)[-1], signal.SIGKILL)  # one of the ranks that this test started
    job.communicate(timeout=60)
    assert job.returncode != 0 and not (tmp_path / "map.h5").exists()
    there = {path.name: path.stat().st_mtime_ns for path in parts.glob("slab-*.h5")}
    assert len(there) >= 3
    job = mpirun(tmp_path / "map.h5", "-n", 2, arm=arm)
    while job.poll() is None and len(list(parts.glob("slab-*.h5"))) <= len(there):
        time.sleep(0.01)
    kept = [name for name, written in there.items() if (parts / name).stat().st_mtime_ns == written]
    assert len(kept) == len(there)  # none is computed again
    ended(job)
    assert (tmp_path / "map.h5").read_bytes() == whole(arm)


def test_a_mistake_is_reported_once(mpirun, tmp_path):
    job = mpirun(tmp_path / "map.h5", "-n", 3, arm=["puma560", "--resolution", "-1"])
    _, err = job.communicate(timeout=60)
    assert err.count("must be from 1e-09") == 1
    job = mpirun("/none/map.h5", "-n", 2)
    _, err = job.communicate(timeout=60)
    assert job.returncode == 3 and "No such file or directory" in err


@pytest.fixture
def two_machines(tmp_path):
    """Two network namespaces with a cable between; the agent starts a process in the second, as ssh would."""
    if os.geteuid() != 0:
        pytest.skip("network namespaces need the rights of root")
    names = [f"beeline{os.getpid()}{k}" for k in "ab"]
    agent = tmp_path / "agent"
    agent.write_text(f"#!/bin/sh\nshift\nexec ip netns exec {names[1]} sh -c \"$*\"\n")
    agent.chmod(0o755)
    commands = [["netns", "add", name] for name in names]
    commands += [["link", "add", "cable0", "netns", names[0], "type", "veth", "peer", "cable1", "netns", names[1]]]
    for k, name in enumerate(names):
        commands += [["-n", name, "address", "add", f"{NETWORK}.{k + 1}/24", "dev", f"cable{k}"],
                     ["-n", name, "link", "set", f"cable{k}", "up"], ["-n", name, "link", "set", "lo", "up"]]
    try:
        for command in commands:
            done = subprocess.run(["ip", *command], capture_output=True, text=True)
            if done.returncode != 0:
                pytest.skip(f"no network namespaces here: {done.stderr.strip()}")
        yield names[0], agent
    finally:
        for name in names:
            subprocess.run(["ip", "netns", "delete", name], capture_output=True)


def test_two_machines_compute_one_map(mpirun, whole, two_machines, tmp_path):
    first, agent = two_machines
    network = f"{NETWORK}.0/24"
    options = ["-n", 2, "--host", f"{NETWORK}.1:1,{NETWORK}.2:1", "--mca", "plm_rsh_agent", agent,
               "--mca", "oob_tcp_if_include", network, "--mca", "btl_tcp_if_include", network, "--mca", "btl", "tcp,self"]
    ended(mpirun(tmp_path / "map.h5", *options, prefix=["ip", "netns", "exec", first]))
    assert (tmp_path / "map.h5").read_bytes() == whole()
