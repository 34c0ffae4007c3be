"""The pictures of the gallery: the SVG files that a block of an example has saved."""

import shutil
from pathlib import Path

from sphinx_gallery.scrapers import figure_rst


def saved_pictures(block, block_vars, gallery_conf):
    """A scraper of sphinx-gallery. Pictures are saved in the example's folder."""
    figures = []
    for picture in sorted(Path(block_vars["src_file"]).parent.glob("*.svg")):
        figures.append(Path(next(block_vars["image_path_iterator"])).with_suffix(".svg"))
        shutil.move(picture, figures[-1])
    return figure_rst([str(figure) for figure in figures], gallery_conf["src_dir"])
