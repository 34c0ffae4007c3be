"""Triangles that are bisected, as arrays (n, 3, 3), and whether convex bodies contain them."""

import numpy as np


def longest_edges(triangles):
    return np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2).max(1)


def halved(triangles):
    """Each triangle as two: its longest edge is bisected."""
    longest = np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2).argmax(1)
    a, b, c = (triangles[np.arange(len(triangles)), (longest + k) % 3] for k in range(3))
    middle = (a + b) / 2
    return np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])


def subdivided(triangles, edge):
    """Triangles whose edges are at most so long and cover the same surface."""
    done = []
    while len(triangles):
        is_long = longest_edges(triangles) > edge
        done.append(triangles[~is_long])
        triangles = halved(triangles[is_long])
    return np.concatenate(done)


def pieces_in_no_body(triangles, within, edge=np.inf, levels=24):
    """The pieces of triangles that lie in no single body; none if the union of the bodies is proved to contain them all.

    `within(points)` says for each body and point whether it contains the point. A triangle whose corners lie in one body lies in
    it, because bodies are convex; the others are bisected. A piece that has a corner in no body and no edge longer than `edge` is
    given up, and so are those that are left after the last level.
    """
    lost = []
    for level in range(levels):
        if level:
            triangles = halved(triangles)
        inside = np.asarray(within(triangles.reshape(-1, 3))).reshape(-1, len(triangles), 3)
        open_ = ~inside.all(2).any(0)
        given_up = open_ & ~inside.any(0).all(1) & (longest_edges(triangles) <= edge)
        lost.append(triangles[given_up])
        triangles = triangles[open_ & ~given_up]
        if not len(triangles):
            break
    return np.concatenate([*lost, triangles])
