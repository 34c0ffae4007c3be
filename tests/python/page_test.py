"""beeline.view(): one document with page, core and arm, in a notebook or in the browser."""

import re
import sys
import types
import webbrowser
import zlib
from base64 import urlsafe_b64decode
from pathlib import Path
from urllib.parse import parse_qs

import numpy as np
import pytest

import beeline
from beeline import _page_document

UR5 = beeline.arms.ur5()
Q = [0.5, -1.0, 1.0, 0.25, 1.0, 1 / 3]

built = pytest.mark.skipif(
    not (Path(__file__).resolve().parents[2] / "build" / "web" / "saved.html").is_file(),
    reason="the page is not built: make web",
)


@pytest.fixture(autouse=True)
def opened(monkeypatch, tmp_path):
    """The addresses that a browser opens, in place of one."""
    addresses = []
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


def part(page, name):
    return re.search(f'<script type="text/plain" id="saved-{name}">([^<]*)</script>', page.html)[1]


def inflated(text):
    return zlib.decompress(urlsafe_b64decode(text + "=" * (-len(text) % 4)), wbits=-15)


@built
def test_the_document_holds_the_core_and_the_arm(opened):
    page = beeline.view(UR5, Q)
    assert inflated(part(page, "core-module"))[:4] == inflated(part(page, "command-module"))[:4] == b"\0asm"
    assert b"onmessage" in inflated(part(page, "worker"))
    assert "data-file=\"assets" not in page.html and part(page, "trajectory") == ""
    state = {key: value for key, [value] in parse_qs(part(page, "state")).items()}
    assert beeline.Arm.from_json(inflated(state["json"]).decode()).to_json() == UR5.to_json()
    assert [float(value) for value in state["q"].split(",")] == Q
    assert "section" not in state


def test_the_document_holds_the_obstacles(monkeypatch, opened, tmp_path):
    monkeypatch.setattr(_page_document, "_empty_document", lambda: '<script type="text/plain" id="saved-state"></script>')
    links = beeline.read_arm_shapes("ur5").links
    links.append(beeline.LinkShapes("cable", 3, [beeline.Shape(beeline.Sphere(0.1))], at_distal_joint=False))
    post = beeline.Obstacle("post", [beeline.Shape(beeline.Cylinder(0.1, 1))], clearance=0.02)
    model = beeline.CollisionModel(UR5, links, beeline.Scene([post], [("post", "wrist_1_link")]), clearance=0.003)
    state = {key: value for key, [value] in parse_qs(part(beeline.view(model, Q), "state")).items()}
    assert float(state["clearance"]) == 0.003
    (tmp_path / "arm.json").write_bytes(inflated(state["json"]))
    (tmp_path / "scene.json").write_bytes(inflated(state["scene"]))
    shown = beeline.CollisionModel(beeline.Arm.load(tmp_path / "arm.json"), beeline.read_arm_shapes(tmp_path / "arm.json").links,
                                   beeline.read_scene(tmp_path / "scene.json"), clearance=0.003)
    assert shown.digest == model.digest
    assert "scene" not in parse_qs(part(beeline.view(UR5, Q), "state"))


@built
def test_outside_of_a_notebook_the_browser_opens_it(opened):
    page = beeline.view(UR5)
    [address] = opened
    assert address.startswith("file:///") and address.endswith(".html")
    assert Path(address[7:]).read_text(encoding="utf-8") == page.html


@built
def test_without_a_browser_it_names_the_file(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    beeline.view(UR5)
    [file] = tmp_path.glob("*.html")
    assert capsys.readouterr().err == f"beeline.view: there is no browser; the page is {file}\n"


@built
def test_a_notebook_shows_it_and_no_browser_opens(monkeypatch, opened):
    shell = types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))
    shown = beeline.view(UR5)._repr_html_()
    assert opened == []
    assert shown.startswith('<iframe srcdoc="&lt;!doctype html&gt;') and shown.count('"') == 10
    assert 'title="' in shown  # for screen readers


@built
def test_a_motion_is_inside_and_exact():
    move = beeline.control_joints(UR5, np.zeros(6), Q)
    page = beeline.view(UR5, trajectory=move)
    assert parse_qs(part(page, "state"))["section"] == ["line"]
    rows = inflated(part(page, "trajectory")).decode().splitlines()
    assert rows[0].split(",")[:2] == ["t", UR5.joint_names[0]]
    assert [float(value) for value in rows[-1].split(",")[1:7]] == list(move.trajectory.positions[-1])


@built
def test_it_begins_in_a_section():
    move = beeline.control_joints(UR5, np.zeros(6), Q)
    for section in ("pose", "control", "line", "obstacles", "workspace", "lessons"):
        page = beeline.view(UR5, trajectory=move, section=section)
        assert parse_qs(part(page, "state"))["section"] == [section]
    with pytest.raises(beeline.Error, match="section: expected one of pose, control, .* not 'hold'"):
        beeline.view(UR5, section="hold")


@built
def test_it_is_saved(tmp_path):
    page = beeline.view(UR5, Q)
    page.save(tmp_path / "arm.html")
    assert (tmp_path / "arm.html").read_text(encoding="utf-8") == page.html
    (tmp_path / "link.html").symlink_to("arm.html")
    page.html += "<!-- again -->"
    page.save(tmp_path / "link.html")  # replaces what the link names, and leaves nothing beside it
    assert (tmp_path / "arm.html").read_text(encoding="utf-8") == page.html
    assert {file.name for file in tmp_path.glob("arm*")} == {"arm.html"} and (tmp_path / "link.html").is_symlink()
    with pytest.raises(beeline.Error, match=r"arm\.txt: a page is written to a \.html file"):
        page.save(tmp_path / "arm.txt")
    with pytest.raises(beeline.Error, match="no/arm.html: No such file"):
        page.save(tmp_path / "no" / "arm.html")


@built
def test_the_archive_of_the_wheel_holds_the_same(root, tmp_path, monkeypatch):
    sys.path.insert(0, str(root / "python"))
    try:
        import page_archive
    finally:
        sys.path.pop(0)
    want = _page_document._files()
    page_archive.main(root / "build" / "web", tmp_path / "page.tar.xz")
    monkeypatch.setattr(_page_document, "__file__", str(tmp_path / "_page_document.py"))
    assert _page_document._files() == want


def test_what_the_arm_does_not_have_is_refused():
    with pytest.raises(beeline.Error, match=r"q has the shape \(2,\); expected \(6,\)"):
        beeline.view(UR5, [1, 2])
    with pytest.raises(beeline.Error, match="q must be finite"):
        beeline.view(UR5, [np.nan] * 6)
    with pytest.raises(beeline.Error, match="does not fit arm ur5"):
        beeline.view(UR5, trajectory=beeline.Trajectory(["a"], [0, 1], [[0], [1]]))
    with pytest.raises(TypeError, match="trajectory: expected a Trajectory"):
        beeline.view(UR5, trajectory=[Q])


def test_without_the_page_the_error_names_make_web(monkeypatch, tmp_path):
    _page_document._empty_document.cache_clear()
    monkeypatch.setattr(_page_document, "__file__", str(tmp_path / "a" / "b" / "c.py"))
    with pytest.raises(beeline.Error, match="^the page is not built: `make web` builds it in a checkout of Beeline, .*$"):
        beeline.view(UR5)
    _page_document._empty_document.cache_clear()
