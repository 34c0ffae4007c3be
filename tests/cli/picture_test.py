"""Pictures as files: SVG that any parser reads, with texts that hold no markup."""

import re
from xml.etree import ElementTree

import pytest

SVG = "{http://www.w3.org/2000/svg}"
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?|nan|inf", re.IGNORECASE)


@pytest.fixture
def parsed(tmp_path):
    """parsed("a.svg") -> the root, of which no coordinate is NaN or far off the page."""

    def parse(name):
        root = ElementTree.parse(tmp_path / name).getroot()
        width, height = map(float, root.get("viewBox").split()[2:])
        for path in root.iter(SVG + "path"):
            for number in map(float, NUMBER.findall(path.get("d"))):
                assert -10 <= number <= max(width, height) + 10, path.get("d")
        return root

    return parse


@pytest.mark.parametrize("title", ["</text><script>alert(1)</script>", 'a"b&amp;<c>\'', "\x01\x1b[31m\x7f",
                                   "関節 Ünïcödé 🤖", "]]>", "&#0;"])
def test_titles_hold_no_markup(beeline, parsed, title):
    assert beeline("draw", "rrr", "--title", title, "--out", "a.svg").code == 0
    texts = ["".join(text.itertext()) for text in parsed("a.svg").iter(SVG + "text")]
    assert re.sub(r"[\x00-\x1f\x7f]", "?", title) in texts
    assert not list(parsed("a.svg").iter(SVG + "script"))


def test_names_of_joints_hold_no_markup(beeline, written, parsed):
    written("a.urdf", """<robot name="&lt;robot&gt;"><link name="a"/><link name="b"/>
      <joint name="&lt;/svg&gt;&amp;" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
      <origin xyz="0.3 0 0.5"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>""")
    answer = beeline("move", "a.urdf", "--from", "0", "--to", "0.5", "--plot", "p.svg", "--draw", "d.svg")
    assert answer.code == 0, answer.err
    parsed("d.svg")
    assert "</svg>&" in ["".join(text.itertext()) for text in parsed("p.svg").iter(SVG + "text")]
