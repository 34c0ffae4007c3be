import { checked, writeText, type CommandModule } from "./module.js";
import {
  measures,
  positionCount,
  type ReachAnswers,
  type ReachAxis,
  type ReachGrid,
  type ReachMap,
  type ReachPlan,
  type ReachSurface,
  type ReachTask,
} from "./reach.js";

/** Calls to the core between which progress is reported. */
const parts = 200;

/** Answers a question about a map in a module. */
export function reach(
  module: CommandModule,
  task: ReachTask,
  progress: (fraction: number) => void = () => undefined,
): ReachAnswers[keyof ReachAnswers] {
  const map = begin(module, task.plan);
  try {
    const grid = gridOf(module, map);
    if (task.ask === "surface") return surface(module, map, task.values, task.level);
    return task.ask === "map" ? compute(module, map, grid, progress) : grid;
  } finally {
    module._beeline_reach_release(map);
  }
}

/** Works with a buffer of `count` numbers, which is freed afterwards. */
function withNumbers<T>(module: CommandModule, count: number, work: (buffer: number) => T): T {
  const buffer = module._beeline_allocate(count);
  if (buffer === 0) throw new Error("the core has no more memory");
  try {
    return work(buffer);
  } finally {
    module._beeline_release(buffer);
  }
}

function begin(module: CommandModule, { arm, resolution, directions, rolls, orientation }: ReachPlan): number {
  const text = writeText(module, arm);
  try {
    return withNumbers(module, 9, (matrix) => {
      module.HEAPF64.set(orientation ?? [], matrix / 8);
      const one = orientation ? matrix : 0;
      return checked(module, module._beeline_reach(text, resolution, directions, rolls, one));
    });
  } finally {
    module._free(text);
  }
}

function gridOf(module: CommandModule, map: number): ReachGrid {
  const numbers = withNumbers(module, 11, (buffer) => {
    checked(module, module._beeline_reach_grid(map, buffer));
    return Array.from(module.HEAPF64.subarray(buffer / 8, buffer / 8 + 11));
  });
  const axis = (k: number): ReachAxis => {
    const [cells = 0, lower = 0, step = 0] = numbers.slice(3 * k, 3 * k + 3);
    return { cells, lower, step };
  };
  return { axes: [axis(0), axis(1), axis(2)], directions: numbers[9] ?? 1, rolls: numbers[10] ?? 1 };
}

function compute(module: CommandModule, map: number, grid: ReachGrid, progress: (fraction: number) => void): ReachMap {
  const positions = positionCount(grid);
  const count = Math.ceil(positions / parts);
  let cellsReached = 0;
  for (let first = 0; first < positions; first += count) {
    const last = Math.min(positions, first + count);
    cellsReached += checked(module, module._beeline_reach_compute(map, first, last));
    progress(last / positions);
  }
  const floats = (measure: number): Float32Array => {
    const at = module._beeline_reach_values(map, measure);
    checked(module, at === 0 ? -1 : 0);
    return module.HEAPF32.slice(at / 4, at / 4 + positions);
  };
  const values = Object.fromEntries(measures.map((name, k) => [name, floats(k)])) as ReachMap["values"];
  const size = 9 * grid.directions * grid.rolls;
  const orientations = withNumbers(module, size, (buffer) => {
    checked(module, module._beeline_reach_orientations(map, buffer));
    return module.HEAPF64.slice(buffer / 8, buffer / 8 + size);
  });
  return { ...grid, values, orientations, cellsReached };
}

function surface(module: CommandModule, map: number, values: Float32Array, level: number): ReachSurface {
  const triangles = withNumbers(module, Math.ceil(values.length / 2), (buffer) => {
    module.HEAPF32.set(values, buffer / 4);
    return checked(module, module._beeline_reach_surface(map, buffer, level));
  });
  const vertices = checked(module, module._beeline_reach_vertex_count(map));
  const [points, corners] = [module._beeline_reach_vertices(map), module._beeline_reach_triangles(map)];
  return {
    vertices: module.HEAPF32.slice(points / 4, points / 4 + 3 * vertices),
    triangles: Uint32Array.from(module.HEAP32.subarray(corners / 4, corners / 4 + 3 * triangles)),
  };
}
