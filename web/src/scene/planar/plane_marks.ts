import { centreOf, sliceOf, type ReachAxis } from "../../core/reach.js";
import { eigen } from "../../core/symmetric_eigen.js";
import { arrowOf, children, dotsOf, pathOf, set, svg } from "../../elements/svg.js";
import { shade } from "../colour_scale.js";
import { jointColour } from "../colours.js";
import { shortening, type Mark, type Tiles, type Trail } from "../picture.js";
import { triad } from "./frames.js";
import type { PlaneView } from "./plane_view.js";

/** Paths of the tool with a dot at each step. */
export class Trails {
  readonly root = svg("g", { class: "trails", "aria-hidden": "true" });

  place(trails: Trail[], view: PlaneView): void {
    const groups = children(this.root, trails.length, () =>
      svg("g", {}, svg("path", { class: "line" }), svg("path", { class: "dots" })),
    );
    trails.forEach(({ tone, points, dots, every = 1 }, i) => {
      const pixels = points.map((point) => view.pixel(point));
      const [line, steps] = [...(groups[i]?.children ?? [])] as SVGElement[];
      set(groups[i] as SVGElement, { class: `trail ${tone}` });
      set(line as SVGElement, { d: pathOf(pixels) });
      set(steps as SVGElement, { d: dots ? dotsOf(pixels.filter((_, k) => k % every === 0)) : "" });
    });
  }
}

/** Poses with a frame each, as in Figure 1.9; their numbers are labels. */
export class Waypoints {
  readonly root = svg("g", { class: "waypoints" });

  place(marks: Mark[], view: PlaneView): void {
    const groups = children(this.root, marks.length, (i) =>
      svg(
        "g",
        {},
        svg("g"),
        svg("circle", { class: "ring", r: 7 }),
        svg("circle", { class: "grip", r: 16, "data-grab": `waypoint ${i}` }),
      ),
    );
    marks.forEach(({ pose, held }, i) => {
      const [frame, ring, grip] = [...(groups[i]?.children ?? [])] as SVGElement[];
      const [x, y] = view.pixel([pose[12] ?? 0, pose[13] ?? 0]);
      triad(pose, view, 26, frame as SVGElement);
      for (const circle of [ring, grip]) set(circle as SVGElement, { cx: x.toFixed(2), cy: y.toFixed(2) });
      (grip as SVGElement).style.display = held ? "" : "none";
    });
  }
}

/** The columns of the Jacobian as arrows at the tool, each in the colour of its joint: Figure 1.8. */
export class Columns {
  readonly root = svg("g", { class: "columns", "aria-hidden": "true" });

  place(columns: number[][] | null, tool: number[], view: PlaneView): void {
    const from = view.pixel(tool);
    const groups = children(this.root, columns?.length ?? 0, (k) =>
      svg("g", { style: `--joint: ${jointColour(k)}` }, svg("path", { class: "line" }), svg("path", { class: "head" })),
    );
    columns?.forEach((column, k) => {
      const to = view.pixel(tool.map((value, i) => value + shortening * (column[i] ?? 0)));
      const long = Math.hypot(to[0] - from[0], to[1] - from[1]);
      const arrow = long > 2 ? arrowOf(from, to, Math.min(12, 0.5 * long)) : { line: "", head: "" };
      set(groups[k]?.children[0] as SVGElement, { d: arrow.line });
      set(groups[k]?.children[1] as SVGElement, { d: arrow.head });
    });
  }
}

/** The ellipse of velocities J dq with |dq| = 1 at the tool (Lynch & Park, section 5.4). */
export class VelocityEllipse {
  readonly root = svg("ellipse", { class: "ellipsoid" });

  place(columns: number[][] | null, tool: number[], view: PlaneView): void {
    this.root.style.display = columns ? "" : "none";
    if (!columns) return;
    const product = [0, 1].map((i) =>
      [0, 1].map((k) => columns.reduce((sum, c) => sum + (c[i] ?? 0) * (c[k] ?? 0), 0)),
    );
    const { values, vectors } = eigen(product);
    const [x, y] = view.pixel(tool);
    const half = (i: number): string =>
      Math.max(1, shortening * view.scale * Math.sqrt(Math.max(0, values[i] ?? 0))).toFixed(2);
    const [ux = 1, uy = 0] = vectors[0] ?? [];
    const turn = ((-Math.atan2(uy, ux) * 180) / Math.PI).toFixed(2);
    set(this.root, {
      rx: half(0),
      ry: half(1),
      transform: `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${turn})`,
    });
  }
}

/** The positions of a map in the plane, a tile in the colour of its value each, and a frame around one cell. */
export class PlaneTiles {
  readonly root = svg("g", { class: "tiles" });
  private readonly image = svg("image", { preserveAspectRatio: "none" });
  private readonly cell = svg("rect", { class: "cell" });
  private drawn: Tiles | null = null;
  private box: [ReachAxis, ReachAxis] | null = null;

  constructor() {
    this.root.append(this.image, this.cell);
  }

  place(tiles: Tiles | null, cell: { centre: number[]; edge: number } | null, view: PlaneView): void {
    if (tiles !== this.drawn) this.paint(tiles);
    this.image.style.display = tiles ? "" : "none";
    if (this.box) {
      const [a, b] = this.box;
      const upper = ({ lower, step, cells }: ReachAxis): number => lower + step * cells;
      const [x, y] = view.pixel([a.lower, upper(b)]);
      set(this.image, { x, y, width: a.step * a.cells * view.scale, height: b.step * b.cells * view.scale });
    }
    this.cell.style.display = cell ? "" : "none";
    if (!cell) return;
    const edge = cell.edge * view.scale;
    const [x, y] = view.pixel(cell.centre);
    set(this.cell, { x: x - edge / 2, y: y - edge / 2, width: edge, height: edge });
  }

  /** The point of the plane at a pixel, if a map is shown there. */
  at(point: readonly [number, number], z: number): number[] | null {
    if (!this.box) return null;
    const inside = this.box.every((axis, k) => {
      const value = point[k] ?? NaN;
      return value >= axis.lower && value <= axis.lower + axis.step * axis.cells;
    });
    return inside ? [...point, z] : null;
  }

  private paint(tiles: Tiles | null): void {
    this.drawn = tiles;
    this.box = null;
    if (!tiles) return;
    const { axes, values } = sliceOf(tiles.grid, tiles.values, tiles.normal, tiles.index);
    const [a, b] = axes.map((k) => tiles.grid.axes[k]) as [ReachAxis, ReachAxis];
    this.box = [a, b];
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [a.cells, b.cells];
    const context = canvas.getContext("2d");
    if (!context) return;
    const pixels = context.createImageData(a.cells, b.cells);
    for (let i = 0; i < a.cells; ++i) {
      for (let j = 0; j < b.cells; ++j) {
        const value = values[i * b.cells + j] as number;
        if (!Number.isNaN(value))
          pixels.data.set([...shade(value / tiles.most), 235], 4 * ((b.cells - 1 - j) * a.cells + i));
      }
    }
    context.putImageData(pixels, 0, 0);
    set(this.image, { href: canvas.toDataURL() });
  }
}

/** The height of the plane of a map, m. */
export function heightOf({ grid, normal, index }: Tiles): number {
  return centreOf(grid.axes[normal] as ReachAxis, index);
}
