"""--help and help: every verb, its options and its examples, which run as they are printed."""

import os
import pathlib
import re
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


def test_no_verb_is_left_out(beeline):
    """The list above has every verb, except those with tests of their own; docs/verbs.md has a row for each that computes."""
    parts = dict(re.findall(r"Of `(\w+)`: ([\w, ]+)\.", " ".join(beeline("help", "--help").out.split())))
    verbs = re.findall(r"^  (\w+)  ", beeline("--help").out.split("\nVerbs:\n")[1].split("\nOptions:")[0], re.M)
    every = verbs + [f"{verb} {part}" for verb in parts for part in parts[verb].split(", ")]
    elsewhere = {"reach", "view", *(f"reach {part}" for part in parts["reach"].split(", "))}
    assert set(every) == set(VERBS) | elsewhere
    page = pathlib.Path(__file__).parents[2] / "docs" / "verbs.md"
    rows = re.findall(r"^\| `([a-z |\\]+)", page.read_text(), re.M)
    documented = {f"{row.split()[0]} {part}".strip() for row in rows
                  for part in " ".join(row.split()[1:]).split("\\|")}
    assert documented == set(every) - {"batch", "reach", "view", "completion", "man", "help"}


def test_an_option_of_several_verbs_has_one_text(beeline):
    """Without its defaults and ranges, which belong to the verb."""
    one = ["--threads", "--limit-tolerance", "--profile", "--interpolation", "--degrees", "--task", "--frame", "--lock",
           "--time-limit", "--max-work", "--tolerance METRES", "--orientation-tolerance", "--pose-form", "--tip", "--redundancy"]
    texts = {}
    for verb in [*VERBS, "reach map", "reach place"]:
        for entry in beeline(*verb.split(), "--help").out.split("\n  -")[1:]:
            text = " ".join(("-" + entry).split("\n\n")[0].split())
            name = next((name for name in one if text.startswith(name + " ") or text == name), None)
            if name:
                texts.setdefault(name, set()).add(re.split(r" (?:Default|Range|Needs|Requires|Excludes|For --method)", text)[0])
    assert len(texts) == len(one)
    assert {name: found for name, found in texts.items() if len(found) > 1} == {}


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
