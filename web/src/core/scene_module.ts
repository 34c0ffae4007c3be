import { checked, readText, withTexts, type CommandModule } from "./module.js";
import type {
  ArmBodies,
  ArmWithShapes,
  GuardedStep,
  NearestPair,
  SceneAnswers,
  SceneDocument,
  SceneTask,
} from "./scene.js";

const folder = "/scene";
const numbersOfPair = 11;

/** Answers questions about an arm among obstacles in a module, which keeps the last arm and its obstacles. */
export class SceneModule {
  private handle: number | null = null;
  private obstacles = "";
  private files: string[] = [];

  constructor(private readonly module: CommandModule) {
    module.FS.mkdir(folder);
    module.FS.chdir(folder);
  }

  answer(task: SceneTask): SceneAnswers[keyof SceneAnswers] {
    if (task.ask === "arm") return this.take(task.arm, task.clearance);
    if (task.ask === "read") return this.read(task.name, task.content);
    this.use(task.scene);
    return task.ask === "nearest" ? this.nearest(task.q) : this.guard(task.from, task.to, task.slides);
  }

  private take({ argument, tip, files }: ArmWithShapes, clearance: number): ArmBodies {
    const { module } = this;
    if (this.handle !== null) module._beeline_scene_release(this.handle);
    this.handle = null; // where the arm is refused
    this.write(files);
    const handle = withTexts(module, [argument, "", tip], (arm = 0, base = 0, end = 0) =>
      checked(module, module._beeline_scene(arm, base, end, clearance)),
    );
    [this.handle, this.obstacles] = [handle, ""];
    const { bodies, links } = JSON.parse(this.text(module._beeline_scene_links(handle))) as {
      bodies: SceneDocument;
      links: number[];
    };
    return { bodies: bodies.obstacles, links, clearance: module._beeline_scene_clearance(handle) };
  }

  private read(given: string, content: string): string {
    const name = this.files.includes(given) ? `scene_${given}` : given; // the arm's files stay
    this.module.FS.writeFile(name, content);
    try {
      return withTexts(this.module, [name], (path = 0) => this.text(this.module._beeline_scene_read(this.arm, path)));
    } finally {
      this.module.FS.unlink(name);
    }
  }

  /** Puts the arm among these obstacles. */
  private use(scene: string): void {
    const { module } = this;
    if (scene === this.obstacles) return;
    const text = scene === "" ? '{"obstacles": []}' : scene;
    withTexts(module, [text], (at = 0) => checked(module, module._beeline_scene_obstacles(this.arm, at)));
    this.obstacles = scene;
  }

  private nearest(q: number[]): NearestPair[] {
    const { module } = this;
    return this.withNumbers([q], numbersOfPair, ([at = 0], into, answer) => {
      const pairs = [0, 1].flatMap((ofLinks) => {
        const count = checked(module, module._beeline_scene_nearest(this.arm, ofLinks, at, into));
        return count === 0 ? [] : [pairOf(answer())];
      });
      return pairs.sort((a, b) => a.lower - a.clearance - (b.lower - b.clearance));
    });
  }

  private guard(from: number[], to: number[], slides: boolean): GuardedStep {
    const { module } = this;
    const dof = from.length;
    return this.withNumbers([from, to], dof + 3, ([start = 0, goal = 0], into, answer) => {
      const going = checked(module, module._beeline_scene_guard(this.arm, slides ? 1 : 0, start, goal, into));
      const numbers = answer();
      const [first = -1, second = -1, free = 0] = numbers.slice(dof);
      const heldBy: [number, number] | null = first < 0 ? null : [first, second];
      return { q: numbers.slice(0, dof), heldBy, isOnItsWay: going === 1, isGoalFree: free === 1 };
    });
  }

  private get arm(): number {
    return this.handle ?? -1; // which the core refuses
  }

  private write(files: ArmWithShapes["files"]): void {
    for (const name of this.files) this.module.FS.unlink(name);
    this.files = Object.keys(files);
    for (const [name, content] of Object.entries(files)) this.module.FS.writeFile(name, content);
  }

  /** A text of the core, which returns null where it fails. */
  private text(pointer: number): string {
    checked(this.module, pointer === 0 ? -1 : 0);
    return readText(this.module, pointer);
  }

  /** Calls `work` with lists of numbers in the module's memory, where an answer of `count` numbers is written, and with what
   * reads the answer. */
  private withNumbers<T>(
    lists: number[][],
    count: number,
    work: (pointers: number[], into: number, answer: () => number[]) => T,
  ): T {
    const { module } = this;
    const all = lists.flat();
    const buffer = module._beeline_allocate(all.length + count);
    if (buffer === 0) throw new Error("the core has no more memory");
    try {
      module.HEAPF64.set(all, buffer / 8);
      const begins = lists.map((_, i) => buffer + 8 * lists.slice(0, i).flat().length);
      const begin = buffer / 8 + all.length;
      return work(begins, 8 * begin, () => Array.from(module.HEAPF64.subarray(begin, begin + count)));
    } finally {
      module._beeline_release(buffer);
    }
  }
}

function pairOf(numbers: number[]): NearestPair {
  const [first = 0, second = 0, lower = 0, upper = 0, clearance = 0, ...points] = numbers;
  return { first, second, lower, upper, clearance, onFirst: points.slice(0, 3), onSecond: points.slice(3) };
}
