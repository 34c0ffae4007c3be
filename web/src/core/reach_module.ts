import { checked, withTexts, type CommandModule } from "./module.js";
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

/** Answers questions about maps in a module, which keeps what the last one was about. */
export class ReachModule {
  private last: { plan: string; map: number } | null = null;

  constructor(private readonly module: CommandModule) {}

  answer<T extends ReachTask>(task: T, progress?: (fraction: number) => void): ReachAnswers[T["ask"]];
  answer(task: ReachTask, progress: (fraction: number) => void = () => undefined): ReachAnswers[keyof ReachAnswers] {
    const map = this.mapOf(task.plan);
    if (task.ask === "surface") return this.surface(map, task.values, task.level);
    return task.ask === "map" ? this.compute(map, progress) : this.grid(map);
  }

  /** The handle of a map of this plan. */
  private mapOf(plan: ReachPlan): number {
    const key = JSON.stringify(plan);
    if (this.last?.plan === key) return this.last.map;
    if (this.last) this.module._beeline_reach_release(this.last.map);
    this.last = null; // where the plan is refused
    const map = this.begin(plan);
    this.last = { plan: key, map };
    return map;
  }

  private begin({ arm, resolution, directions, rolls, orientation }: ReachPlan): number {
    const { module } = this;
    return withTexts(module, [arm], (text = 0) =>
      this.withNumbers(9, (matrix) => {
        module.HEAPF64.set(orientation ?? [], matrix / 8);
        const one = orientation ? matrix : 0;
        return checked(module, module._beeline_reach(text, resolution, directions, rolls, one));
      }),
    );
  }

  private grid(map: number): ReachGrid {
    const numbers = this.read(11, (buffer) => this.module._beeline_reach_grid(map, buffer));
    const axis = (k: number): ReachAxis => {
      const [cells = 0, lower = 0, step = 0] = numbers.subarray(3 * k, 3 * k + 3);
      return { cells, lower, step };
    };
    return { axes: [axis(0), axis(1), axis(2)], directions: numbers[9] ?? 1, rolls: numbers[10] ?? 1 };
  }

  private compute(map: number, progress: (fraction: number) => void): ReachMap {
    const { module } = this;
    const grid = this.grid(map);
    const positions = positionCount(grid);
    module.progress = progress;
    const cellsReached = checked(module, module._beeline_reach_compute(map));
    const floats = (measure: number): Float32Array => {
      const at = module._beeline_reach_values(map, measure);
      checked(module, at === 0 ? -1 : 0);
      return module.HEAPF32.slice(at / 4, at / 4 + positions);
    };
    const values = Object.fromEntries(measures.map((name, k) => [name, floats(k)])) as ReachMap["values"];
    const orientations = this.read(9 * grid.directions * grid.rolls, (buffer) =>
      module._beeline_reach_orientations(map, buffer),
    );
    return { ...grid, values, orientations, cellsReached };
  }

  private surface(map: number, values: Float32Array, level: number): ReachSurface {
    const { module } = this;
    const triangles = this.withNumbers(Math.ceil(values.length / 2), (buffer) => {
      module.HEAPF32.set(values, buffer / 4);
      return checked(module, module._beeline_reach_surface(map, buffer, values.length, level));
    });
    const vertices = checked(module, module._beeline_reach_vertex_count(map));
    const [points, corners] = [module._beeline_reach_vertices(map), module._beeline_reach_triangles(map)];
    return {
      vertices: module.HEAPF32.slice(points / 4, points / 4 + 3 * vertices),
      triangles: Uint32Array.from(module.HEAP32.subarray(corners / 4, corners / 4 + 3 * triangles)),
    };
  }

  /** The numbers that a function of the core writes into a buffer. */
  private read(count: number, write: (buffer: number) => number): Float64Array {
    return this.withNumbers(count, (buffer) => {
      checked(this.module, write(buffer));
      return this.module.HEAPF64.slice(buffer / 8, buffer / 8 + count);
    });
  }

  /** Works with a buffer of `count` numbers, which is freed afterwards. */
  private withNumbers<T>(count: number, work: (buffer: number) => T): T {
    const buffer = this.module._beeline_allocate(count);
    if (buffer === 0) throw new Error("the core has no more memory");
    try {
      return work(buffer);
    } finally {
      this.module._beeline_release(buffer);
    }
  }
}
