"""Draws a Markdown table of costs, read from stdin, as a chart with logarithmic axes.

Usage: draw_growth.py X Y FILE.svg: the titles of two columns, and where the picture goes. A dashed
line shows what would grow in proportion, up to the last row."""

import sys

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402  after the choice of what draws

matplotlib.rcParams["svg.hashsalt"] = "beeline"  # the same picture from the same numbers


def columns(lines, *titles):
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines if line[:1] == "|"]
    places = [rows[0].index(title) for title in titles]
    return [[float(row[place].split()[0]) for row in rows[2:]] for place in places]


def main():
    x_title, y_title, path = sys.argv[1:]
    x, y = columns(sys.stdin.read().splitlines(), x_title, y_title)
    figure, axes = pyplot.subplots(figsize=(5, 3.2))
    axes.loglog(x, [y[-1] * each / x[-1] for each in x], "--", color="0.6", label="in proportion")
    axes.loglog(x, y, "o-", label="measured")
    axes.set(xlabel=x_title, ylabel=y_title)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


main()
