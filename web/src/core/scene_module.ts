import { checked, readText, writeText, type CommandModule } from "./module.js";
import type { ArmBodies, ArmWithShapes, NearestPair, SceneAnswers, SceneDocument, SceneTask } from "./scene.js";

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
    return task.ask === "read" ? this.read(task.name, task.content) : this.nearest(task.scene, task.q);
  }

  private take({ argument, tip, files }: ArmWithShapes, clearance: number): ArmBodies {
    const { module } = this;
    if (this.handle !== null) module._beeline_scene_release(this.handle);
    this.handle = null; // where the arm is refused
    this.write(files);
    const handle = this.withTexts([argument, "", tip], ([arm = 0, base = 0, end = 0]) =>
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
      return this.withTexts([name], ([path = 0]) => this.text(this.module._beeline_scene_read(this.arm, path)));
    } finally {
      this.module.FS.unlink(name);
    }
  }

  private nearest(scene: string, q: number[]): NearestPair[] {
    const { module } = this;
    if (scene !== this.obstacles) {
      const text = scene === "" ? '{"obstacles": []}' : scene;
      this.withTexts([text], ([at = 0]) => checked(module, module._beeline_scene_obstacles(this.arm, at)));
      this.obstacles = scene;
    }
    const buffer = module._beeline_allocate(q.length + numbersOfPair);
    if (buffer === 0) throw new Error("the core has no more memory");
    try {
      module.HEAPF64.set(q, buffer / 8);
      const into = buffer + 8 * q.length;
      const pairs = [0, 1].flatMap((ofLinks) => {
        const count = checked(module, module._beeline_scene_nearest(this.arm, ofLinks, buffer, into));
        return count === 0 ? [] : [pairOf(Array.from(module.HEAPF64.subarray(into / 8, into / 8 + numbersOfPair)))];
      });
      return pairs.sort((a, b) => a.lower - a.clearance - (b.lower - b.clearance));
    } finally {
      module._beeline_release(buffer);
    }
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

  private withTexts<T>(texts: string[], work: (pointers: number[]) => T): T {
    const pointers = texts.map((text) => writeText(this.module, text));
    try {
      return work(pointers);
    } finally {
      for (const pointer of pointers) this.module._free(pointer);
    }
  }
}

function pairOf(numbers: number[]): NearestPair {
  const [first = 0, second = 0, lower = 0, upper = 0, clearance = 0, ...points] = numbers;
  return { first, second, lower, upper, clearance, onFirst: points.slice(0, 3), onSecond: points.slice(3) };
}
