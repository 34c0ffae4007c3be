/** What a position of a map is valued by: the best of its orientations. In the order of beeline_reach_values(). */
export const measures = ["directions", "branches", "manipulability", "margin"] as const;
export type Measure = (typeof measures)[number];

/** What a map covers. */
export interface ReachPlan {
  /** The arm as `beeline show --out` writes it. */
  arm: string;
  /** The edge of the cells, m; 0 for an arm whose reach has no bounds, which is refused. */
  resolution: number;
  /** The angle between tool directions, or headings of a planar arm, rad. */
  directions: number;
  /** The angle between rolls where the last joint does not roll the tool, rad; otherwise any roll will do. */
  rolls: number;
  /** The only orientation, a matrix by columns; null: as `directions` says. */
  orientation: number[] | null;
}

/** Equal cells along a coordinate, m. */
export interface ReachAxis {
  cells: number;
  lower: number;
  step: number;
}

/** The cells of a map: position p = (ix ny + iy) nz + iz and, at each, directions (or headings) and rolls. */
export interface ReachGrid {
  axes: [ReachAxis, ReachAxis, ReachAxis];
  directions: number;
  rolls: number;
}

export interface ReachMap extends ReachGrid {
  /** One for each position; NaN: not reached. */
  values: Record<Measure, Float32Array>;
  /** The orientations at each position, rolls fastest, matrices of 9 numbers by columns. */
  orientations: Float64Array;
  cellsReached: number;
}

/** A closed mesh, m: 3 coordinates for each vertex, 3 vertices for each triangle. */
export interface ReachSurface {
  vertices: Float32Array;
  triangles: Uint32Array;
}

/** A question about a map, and what it is answered by. */
export interface ReachAnswers {
  grid: ReachGrid;
  map: ReachMap;
  surface: ReachSurface;
}
export type ReachTask =
  { ask: "grid" | "map"; plan: ReachPlan } | { ask: "surface"; plan: ReachPlan; values: Float32Array; level: number };

export function positionCount({ axes }: ReachGrid): number {
  return axes[0].cells * axes[1].cells * axes[2].cells;
}

export function cellCount(grid: ReachGrid): number {
  return positionCount(grid) * grid.directions * grid.rolls;
}

/** The number of the position with these indices along x, y and z. */
export function positionAt({ axes }: ReachGrid, [x = 0, y = 0, z = 0]: number[]): number {
  return (x * axes[1].cells + y) * axes[2].cells + z;
}

/** The index of the cell of a value; null for one outside. An edge is inside, whatever its last digit. */
export function cellOf({ cells, lower, step }: ReachAxis, value: number): number | null {
  const steps = (value - lower) / step;
  const rounding = 1e-9;
  if (!(steps >= -rounding && steps <= cells + rounding)) return null;
  return Math.min(Math.floor(Math.max(0, steps)), cells - 1);
}

export function centreOf({ lower, step }: ReachAxis, index: number): number {
  return lower + (index + 0.5) * step;
}

/** The position of a map around a point; null for one outside. */
export function positionOf(grid: ReachGrid, point: number[]): number | null {
  const indices = grid.axes.map((axis, k) => cellOf(axis, point[k] ?? NaN));
  return indices.every((index) => index !== null) ? positionAt(grid, indices as number[]) : null;
}

/** The centre of the cell around a point of the map, m. */
export function centreAround(grid: ReachGrid, point: number[]): number[] {
  return grid.axes.map((axis, k) => centreOf(axis, cellOf(axis, point[k] ?? NaN) ?? 0));
}

/** The largest value of a measure in a map; 1 for the fraction of directions. */
export function largest(map: ReachMap, measure: Measure): number {
  if (measure === "directions") return 1;
  return map.values[measure].reduce((most, value) => (value > most ? value : most), 0) || 1;
}

/** The values in the plane at `index` along the axis `normal`, and the other two axes; the second one is the fastest. */
export function sliceOf(
  grid: ReachGrid,
  values: Float32Array,
  normal: number,
  index: number,
): { axes: [number, number]; values: Float32Array } {
  const axes: [number, number] = [normal === 0 ? 1 : 0, normal === 2 ? 1 : 2];
  const [rows, columns] = axes.map((k) => grid.axes[k]?.cells ?? 0) as [number, number];
  const slice = new Float32Array(rows * columns);
  for (let i = 0; i < rows; ++i) {
    for (let j = 0; j < columns; ++j) {
      const at = [index, index, index].with(axes[0], i).with(axes[1], j);
      slice[i * columns + j] = values[positionAt(grid, at)] ?? NaN;
    }
  }
  return { axes, values: slice };
}
