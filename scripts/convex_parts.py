#!/usr/bin/env python3
"""Divides a mesh into convex parts whose union contains it, verified to 1e-12 of its size.

    scripts/venv.sh ~/parts scripts/convex_parts_requirements.txt
    ~/parts/bin/python scripts/convex_parts.py hook.stl --out parts

Beeline takes a mesh as its convex hull, which closes its hollows. This writes, into the folder of --out,
  hook_00.obj, ...  the parts, each convex: one <collision> each in a URDF file
  hook.urdf.txt     these <collision> elements
  hook.json         a scene with one obstacle, hook, whose shapes are the parts; its "shapes" also fit in an arm file
CoACD (Wei et al., Approximate convex decomposition for 3D meshes with collision-aware concavity and tree search, 2022) divides
the mesh. Its parts do not contain the mesh exactly: each piece of a triangle that lies in no part is added to the part that it
exceeds least. The written files are read again, and every triangle is verified to lie in the parts, to 1e-12 of the size of the
mesh, by bisection; only then do they replace those in the folder. The excess is the largest distance of their outer surface from
the mesh that was measured. The surface counts: a hollow that the surface
encloses may be in no part.
"""

import argparse
import json
import pathlib
import sys
import tempfile

import numpy as np
import trimesh
from scipy.spatial import ConvexHull, QhullError, cKDTree

from triangles import pieces_in_no_body, subdivided

TOLERANCE = 1e-12  # of the size of the mesh: the planes of hulls have rounding errors
ENDINGS = (".stl", ".obj", ".ply", ".off", ".glb")  # trimesh does not apply the unit of Collada files


class Part:
    """The hull of points."""

    def __init__(self, points):
        hull = ConvexHull(points)
        self.points = points[hull.vertices]
        number = {int(old): new for new, old in enumerate(hull.vertices)}
        self.faces = np.array([[number[int(i)] for i in face] for face in hull.simplices])
        self.planes = hull.equations
        inwards = self.points.mean(0)
        a, b, c = self.points[self.faces].transpose(1, 0, 2)
        flipped = np.einsum("ij,ij->i", np.cross(b - a, c - a), inwards - a) > 0
        self.faces[flipped] = self.faces[flipped][:, ::-1]

    def exceeded(self, points):
        """By how much points are outside the plane that they exceed most; 0 or less inside."""
        values = np.full(len(points), -np.inf)
        for plane in self.planes:
            np.maximum(values, points @ plane[:3] + plane[3], out=values)
        return values


def fail(message):
    raise SystemExit(f"convex_parts.py: {message}")


def read_mesh(path, scale):
    if path.suffix.lower() not in ENDINGS:
        fail(f"{path}: convert it to {' or '.join(ENDINGS)}")
    try:
        mesh = trimesh.load_mesh(path, process=False)
    except Exception as error:  # of each format its own
        fail(f"{path}: {error}")
    vertices, faces = np.array(mesh.vertices, float) * scale, np.array(mesh.faces, int)
    if not len(faces) or not np.isfinite(vertices).all():
        fail(f"{path}: has no triangles, or a coordinate that is not finite")
    return vertices, faces


def divided(vertices, faces, args):
    import coacd

    coacd.set_log_level("error")
    mesh = trimesh.Trimesh(vertices, faces, process=True)  # corners that are equal are one
    parts = coacd.run_coacd(coacd.Mesh(np.array(mesh.vertices), np.array(mesh.faces)), threshold=args.concavity,
                            max_convex_hull=args.most, seed=0)
    found = []
    for points, _ in parts:
        try:
            found.append(Part(np.array(points, float)))
        except QhullError:  # flat
            continue
    return found or [Part(vertices)]


def within_of(parts, tolerance):
    return lambda points: [part.exceeded(points) <= tolerance for part in parts]


def grown(parts, triangles, size):
    """The parts with the pieces of triangles that lie in none of them."""
    for round_ in range(20):
        pieces = pieces_in_no_body(triangles, within_of(parts, 0), edge=0.02 * size, levels=12)
        if not len(pieces):
            return parts
        beyond = np.array([part.exceeded(pieces.reshape(-1, 3)).reshape(-1, 3).max(1) for part in parts])
        nearest = beyond.argmin(0)
        print(f"round {round_ + 1}: {len(pieces)} pieces of triangles in no part, by up to {beyond.min(0).max():.3g} m", flush=True)
        margin = 1e-9 * size  # or a corner on a plane is outside by rounding, again
        for k in np.unique(nearest):
            corners = pieces[nearest == k].reshape(-1, 3)
            outwards = corners - parts[k].points.mean(0)
            outwards /= np.maximum(np.linalg.norm(outwards, axis=1), margin)[:, None]
            parts[k] = Part(np.concatenate([parts[k].points, corners + margin * outwards]))
    fail("the parts do not contain the mesh after 20 rounds")


def excess_of(parts, triangles, spacing):
    """The largest distance from the surface of the union to the mesh, at points so far apart."""
    mesh = cKDTree(np.unique(subdivided(triangles, spacing / 2).reshape(-1, 3), axis=0))
    largest, count = 0.0, 0
    for part in parts:
        points = np.unique(subdivided(part.points[part.faces], spacing).reshape(-1, 3), axis=0)
        for other in parts:
            if other is not part and len(points):
                points = points[other.exceeded(points) >= 0]
        if len(points):
            largest, count = max(largest, mesh.query(points)[0].max()), count + len(points)
    return largest, count


def write(parts, name, folder):
    paths = []
    for k, part in enumerate(parts):
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in part.points.tolist()]
        lines += [f"f {a} {b} {c}" for a, b, c in (part.faces + 1).tolist()]
        paths.append(folder / f"{name}_{k:02}.obj")
        paths[-1].write_text("\n".join(lines) + "\n")
    elements = [f'<collision><geometry><mesh filename="{path.name}"/></geometry></collision>' for path in paths]
    (folder / f"{name}.urdf.txt").write_text("\n".join(elements) + "\n")
    shapes = [{"convex_hull": {"vertices": part.points.tolist()}} for part in parts]
    rows = ",\n".join("   " + json.dumps(shape) for shape in shapes)
    (folder / f"{name}.json").write_text(f'{{"obstacles": [{{"name": {json.dumps(name)}, "shapes": [\n{rows}]}}]}}\n')
    return paths


def written(path):
    rows = [line.split()[1:] for line in path.read_text().splitlines() if line.startswith("v ")]
    return Part(np.array(rows, float))


def write_verified(parts, name, out, triangles, size):
    """Writes the parts into a temporary folder, reads them again, and moves them into `out` if the triangles lie in them."""
    out.absolute().parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{name}.", dir=out.absolute().parent) as temporary:
        folder = pathlib.Path(temporary)
        parts = [written(path) for path in write(parts, name, folder)]
        lost = pieces_in_no_body(triangles, within_of(parts, TOLERANCE * size))
        if len(lost):
            fail(f"{len(lost)} pieces of triangles are in no part, one at {lost[0, 0]}")
        out.mkdir(exist_ok=True)
        for path in sorted(folder.iterdir()):
            path.replace(out / path.name)
    return parts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path, help="STL, OBJ, PLY, OFF or GLB")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder")
    parser.add_argument("--scale", type=float, default=1.0, help="multiplies the coordinates: 0.001 for millimetres")
    parser.add_argument("--concavity", type=float, default=0.05, help="CoACD's threshold, 0.01 to 1; smaller: more parts; %(default)s")
    parser.add_argument("--most", type=int, default=-1, help="the largest number of parts; default: no bound")
    args = parser.parse_args()
    vertices, faces = read_mesh(args.mesh, args.scale)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    triangles = vertices[faces]
    parts = grown(divided(vertices, faces, args), triangles, size)
    parts = write_verified(parts, args.mesh.stem, args.out, triangles, size)
    excess, count = excess_of(parts, triangles, 0.01 * size)
    whole, hull = sum(ConvexHull(part.points).volume for part in parts), ConvexHull(vertices)
    print(f"{args.mesh.name}: {len(faces)} triangles lie in {len(parts)} parts, verified to {TOLERANCE:g} of the size; excess {excess:.3g} m at {count} places; "
          f"volume of the parts {whole:.3g} m3, of the hull {hull.volume:.3g} m3")
    return 0


if __name__ == "__main__":
    sys.exit(main())
