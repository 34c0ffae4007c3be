"""man: a page that groff and mandoc set without complaints, with every verb and option."""

import re
import shutil
import subprocess

import pytest

PROGRAMS = {"groff": ["groff", "-man", "-ww", "-Tascii", "-rLL=100n"],
            "mandoc": ["mandoc", "-Tlint", "-Wwarning"]}


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_page_renders(beeline, program):
    if not shutil.which(program):
        pytest.skip(f"{program} is not installed")
    page = beeline("man")
    assert page.code == 0 and page.err == ""
    process = subprocess.run(PROGRAMS[program], input=page.out, capture_output=True, text=True)
    if program == "mandoc":  # the page has no date, so that the same sources print the same page
        complaints = [row for row in process.stdout.splitlines() if "missing date" not in row]
        assert complaints == []
        return
    assert process.returncode == 0 and process.stderr == "", process.stderr
    text = re.sub(r"\x1b\[[0-9;]*m|.\x08", "", process.stdout)
    for word in ("NAME", "SYNOPSIS", "beeline retime ARM FILE", "--profile PROFILE", "batch ik",
                 "--max-restarts", r"printf 'x,y,theta\n4.5,5.2,0\n"):
        assert word in text, word


def test_the_page_has_every_option_of_every_help(beeline):
    page = beeline("man").out.replace("\\-", "-")
    for verb in ("fk", "ik", "line", "move", "retime", "replay", "batch ik"):
        for option in re.findall(r"^  (?:-h, )?(--[a-z-]+)", beeline(*verb.split(), "--help").out, re.M):
            assert option in page, option
