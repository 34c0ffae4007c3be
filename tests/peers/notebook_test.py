"""The first notebook runs; what it shows are pictures, formulas and an animation; the file has no outputs."""

import os
from pathlib import Path

import pytest

pytest.importorskip("beeline")
nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

NOTEBOOK = Path(__file__).parents[2] / "docs" / "first_steps.ipynb"


@pytest.fixture(scope="module")
def executed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("notebook")
    os.environ.setdefault("JUPYTER_PLATFORM_DIRS", "1")
    os.environ["IPYTHONDIR"] = str(folder / "ipython")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    resources = {"metadata": {"path": folder}}
    return nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources=resources).execute()


def test_the_file_has_no_outputs():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    for cell in notebook.cells:
        assert not cell.get("outputs") and cell.get("execution_count") is None


def test_it_shows_what_it_speaks_of(executed):
    shown = {}
    printed = ""
    for cell in executed.cells:
        for output in cell.get("outputs", []):
            assert output.output_type != "error"
            assert output.get("name") != "stderr", output.text
            printed += output.get("text", "")
            for kind, data in output.get("data", {}).items():
                shown.setdefault(kind, []).append(data)
    assert len(shown["image/svg+xml"]) >= 5
    assert any("base64" in data for data in shown["text/html"])
    assert any("\\begin{pmatrix}" in data for data in shown["text/latex"])
    assert "reached in" in printed and "µm off the line" in printed and "verified" in printed
    assert "False unreachable" in printed
