"""Sphinx's settings. scripts/docs.sh runs it on a copy of this folder, with what is generated beside the pages."""

import sys
from pathlib import Path

from sphinx.ext.napoleon import Config, NumpyDocstring

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "sphinx"))

project = "Beeline"
copyright = "the authors of Beeline"
html_title = "Beeline"
default_role = "code"  # of docstrings
exclude_patterns = [
    "sphinx", "doxygen", "sessions", "requirements.txt", "embedded_page.md", "examples/*.ipynb", "examples/*.py",
]
smartquotes = False  # "--" is part of options

extensions = [
    "myst_nb", "breathe", "mathml", "sphinx_copybutton", "sphinx.ext.autodoc", "sphinx_gallery.gen_gallery",
]
sphinx_gallery_conf = {
    "examples_dirs": str(HERE.parent / "examples"),
    "gallery_dirs": "examples",
    "within_subsection_order": "FileNameSortKey",
    "filename_pattern": r"\d\d_\w+\.py",
    "image_scrapers": ("pictures.saved_pictures",),
    "abort_on_example_error": True,
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
    "min_reported_time": 1e9,
}
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
html_math_renderer = "mathml"
myst_enable_extensions = ["dollarmath", "deflist", "attrs_inline", "colon_fence"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
copybutton_exclude = ".linenos, .gp, .go"  # of a session, only what is typed

breathe_projects = {"beeline": str(HERE / "doxygen" / "xml")}
breathe_default_project = "beeline"
breathe_default_members = ("members", "undoc-members")
cpp_index_common_prefix = ["beeline::"]
primary_domain = "cpp"
highlight_language = "text"

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["beeline.css"]
html_show_sourcelink = False
html_copy_source = False
pygments_style = "friendly"
pygments_dark_style = "monokai"


def short_types(app, what, name, value, options, signature, result):
    """Signatures without the modules of numpy's types, which the references name in their introduction."""
    return tuple(text and text.replace("numpy.typing.", "").replace("numpy.", "") for text in (signature, result))


def numpy_sections(app, what, name, value, options, lines):
    """Sections of docstrings in numpy's style. Properties have none; Napoleon takes what stands before a colon in their
    first line for a type."""
    if what not in ("property", "attribute"):
        settings = Config(napoleon_use_param=False, napoleon_use_rtype=False)
        lines[:] = NumpyDocstring(lines, settings, app, what, name, value, options).lines()


def setup(app):
    app.connect("autodoc-process-docstring", numpy_sections)
    app.connect("autodoc-process-signature", short_types)
