"""--help and help: every verb, its options and its examples, which run as they are printed."""

import os
import subprocess

import pytest

VERBS = ["arms", "show", "fk", "jacobian", "ik", "batch", "batch fk", "batch jacobian", "batch ik",
         "move", "line", "check", "retime", "replay", "diff", "export", "draw", "figure", "formula", "doctor", "completion", "man",
         "help"]


def examples(text):
    """The commands of a help text, as a script."""
    lines = text.split("\nExamples:\n")[1].splitlines()
    return [line[2:] for line in lines if not line.startswith("  #")]


@pytest.mark.parametrize("verb", VERBS)
def test_help_names_every_part(beeline, verb):
    answer = beeline(*verb.split(), "--help")
    assert answer.code == 0 and answer.err == ""
    assert f"\nUsage: beeline {verb}" in answer.out
    assert "\nOptions:\n" in answer.out and "--help" in answer.out
    assert len(examples(answer.out)) >= 1
    assert beeline("help", *verb.split()).out == answer.out
    text = answer.out.split("\nExamples:\n")[0]
    assert all(len(line) <= 100 for line in text.splitlines())


@pytest.mark.parametrize("verb", VERBS)
def test_examples_run_as_they_are_printed(build, beeline, verb, tmp_path):
    script = "set -euo pipefail\n" + "\n".join(examples(beeline(*verb.split(), "--help").out))
    assert f"beeline {verb}" in script
    environment = {**os.environ, "PATH": f"{build}:{os.environ['PATH']}"}
    process = subprocess.run(["bash", "-c", script], cwd=tmp_path, env=environment,
                             capture_output=True, text=True)
    assert process.returncode == 0, process.stderr


def test_the_overview_lists_the_verbs(beeline):
    answer = beeline("--help")
    assert answer.code == 0 and answer.out == beeline("help").out == beeline("-h").out
    for verb in VERBS:
        assert f"\n  {verb.split()[0]} " in answer.out
    assert "Exit codes: 0 yes, 1 the computed answer is no" in " ".join(answer.out.split())


def test_every_option_of_the_verbs_has_a_sentence(beeline):
    for verb in VERBS:
        for entry in beeline(*verb.split(), "--help").out.split("\n  -")[1:]:
            assert entry.split("\n\n")[0].rstrip().split("\nOptions")[0].endswith("."), (verb, entry)


def test_version(beeline):
    answer = beeline("--version")
    assert answer.code == 0 and answer.out.startswith("beeline ")


def test_help_on_an_unknown_verb(refused):
    refused(2, "help", "retiem", says=['"retime"'])
    refused(2, "help", "batch", "fkk", says=['"fk"'])
    refused(2, "help", "time", says=["retime"])
