"""completion: the scripts parse, and complete verbs, options, values and built-in arms."""

import shutil
import subprocess

import pytest

from profiles import PROFILES

SHELLS = {"bash": ["bash", "-n"], "zsh": ["zsh", "-n"], "fish": ["fish", "--no-execute"]}


@pytest.fixture
def script(beeline, tmp_path):
    def write(shell):
        answer = beeline("completion", shell)
        assert answer.code == 0 and answer.err == ""
        path = tmp_path / f"completion.{shell}"
        path.write_text(answer.out)
        return path

    return write


@pytest.mark.parametrize("shell", SHELLS)
def test_a_script_parses(script, shell):
    path = script(shell)
    for word in ("retime", "batch", "jacobian", "profile", "s-curve", "panda", "max-samples"):
        assert word in path.read_text()
    if not shutil.which(shell):
        pytest.skip(f"{shell} is not installed")
    process = subprocess.run([*SHELLS[shell], str(path)], capture_output=True, text=True)
    assert process.returncode == 0 and process.stderr == "", process.stderr


@pytest.fixture
def completed(script, tmp_path):
    """completed("fk", "pa") -> the words that bash offers for the last one."""
    path = script("bash")

    def complete(*words):
        words = ("beeline", *words)
        quoted = " ".join(f"'{word}'" for word in words)
        code = (f"source {path}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _beeline; "
                'printf "%s\\n" "${COMPREPLY[@]}"')
        process = subprocess.run(["bash", "-c", code], capture_output=True, text=True, cwd=tmp_path)
        assert process.returncode == 0 and process.stderr == "", process.stderr
        return set(process.stdout.split())

    return complete


def test_bash_completes(completed, written):
    assert completed("re") == {"reach", "retime", "replay"}
    assert completed("fk", "pan") == {"panda"}
    assert completed("fk", "panda", "--deg") == {"--degrees"}
    assert completed("retime", "panda", "--profile", "s") == {"s-curve"}
    assert completed("retime", "panda", "--profile", "=", "qu") == {"quintic"}
    assert completed("retime", "panda", "--profile", "") == set(PROFILES)
    assert completed("batch", "j") == {"jacobian"}
    assert completed("batch", "ik", "ur5", "--redundancy", "") == {"any", "nearest", "centred"}
    assert completed("help", "dr") == {"draw"}
    assert completed("help", "batch", "") == {"fk", "jacobian", "ik", "map", "merge", "query", "slice", "compare", "export", "place"}
    assert completed("completion", "") == {"bash", "zsh", "fish"}
    assert completed("figure", "1.") == {f"1.{n}" for n in range(1, 10)}
    written("move.csv", "")
    assert completed("check", "panda", "mo") == {"move.csv"}
    assert completed("line", "panda", "--through", "mo") == {"move.csv"}
    assert completed("reach", "merge", "a.h5", "b.h5", "mo") == {"move.csv"}
    assert completed("fk", "panda", "--q", "") == set()


@pytest.mark.skipif(not shutil.which("fish"), reason="fish is not installed")
def test_fish_completes(script, written, tmp_path):
    path = script("fish")
    written("move.csv", "")

    def complete(line):
        code = f"source {path}; complete -C '{line}'"
        process = subprocess.run(["fish", "--private", "-c", code], capture_output=True, text=True,
                                 cwd=tmp_path, env={"HOME": str(tmp_path), "PATH": "/usr/bin:/bin"})
        assert process.returncode == 0 and process.stderr == "", process.stderr
        return {row.split("\t")[0] for row in process.stdout.splitlines()}

    assert complete("beeline re") == {"reach", "retime", "replay"}
    assert complete("beeline fk pan") == {"panda"}
    assert complete("beeline retime panda --profile s") == {"s-curve"}
    assert complete("beeline batch j") == {"jacobian"}
    assert complete("beeline help batch ") == {"fk", "jacobian", "ik"}
    assert "--seed" in complete("beeline batch ik ur5 --")
    assert "--seed" not in complete("beeline batch fk ur5 --")
    assert "move.csv" in complete("beeline check panda mo")
