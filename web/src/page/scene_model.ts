import type { CoreWorker } from "../core/client.js";
import {
  sceneOf,
  textOf,
  withKnownPairs,
  type ArmBodies,
  type ArmWithShapes,
  type GuardedStep,
  type NearestPair,
  type SceneDocument,
} from "../core/scene.js";
import { CoreError, type InputFiles } from "../core/types.js";
import { distance } from "../elements/units.js";
import type { DrawnBody, Gap } from "../scene/picture.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { Shown } from "./section.js";

export const sceneFile = "scene.json";

/** The nearest pair, with the names of its bodies. */
export interface NamedPair extends NearestPair {
  names: [string, string];
}

/** The arm that is shown among obstacles. A worker of its own computes the nearest pair whenever arm, obstacles or joints
 * change: the newest state when it has answered the one before. */
export class SceneModel {
  /** The bodies of the arm; null: they are not read yet, or there are none. */
  arm: ArmBodies | null = null;
  /** The pair of links and the pair with an obstacle that are nearest to their clearance, the nearer one first. */
  nearest: NamedPair[] = [];
  /** Why the arm's shapes or the obstacles are refused. */
  fault = "";
  /** Obstacles that are not drawn, by name. They count all the same. */
  readonly hidden = new Set<string>();
  private shown: Shown | null = null;
  private readonly listeners: (() => void)[] = [];
  private q: number[] = [];
  private parsed: { text: string; scene: SceneDocument } = { text: "", scene: sceneOf("") };
  private arms = 0;
  private known = "";
  private dirty = false;
  private running: Promise<void> | null = null;

  /** `source`: the arm that is shown, as commands read it with its shapes. */
  constructor(
    private readonly worker: CoreWorker,
    private readonly store: Store<PageState>,
    private readonly source: () => Promise<ArmWithShapes>,
  ) {}

  /** `changed` is called when the nearest pair, the shapes or the fault are others. */
  subscribe(changed: () => void): void {
    this.listeners.push(changed);
  }

  take(shown: Shown): void {
    this.shown = shown;
    ++this.arms;
    [this.arm, this.nearest, this.fault, this.known] = [null, [], "", ""];
  }

  get scene(): SceneDocument {
    const text = this.store.get().scene;
    if (text !== this.parsed.text) this.parsed = { text, scene: sceneOf(text) };
    return this.parsed.scene;
  }

  /** Whether the arm is shown among obstacles, or is asked for them. */
  get isUsed(): boolean {
    const { scene, section } = this.store.get();
    return this.shown?.arm.planar === false && (section === "obstacles" || scene !== "");
  }

  /** What the answers of inScene() depend on beside the joints; empty without obstacles. */
  get key(): string {
    const { scene, clearance } = this.store.get();
    return this.isUsed && scene !== "" ? [this.arms, clearance, scene].join("\n") : "";
  }

  /** The scene as it is checked, and the pairs of bodies that are not there, which are left out. */
  get checked(): { text: string; left: [string, string][] } {
    const { scene: text } = this.store.get();
    if (this.arm === null) return { text, left: [] };
    const links = this.arm.bodies.map(({ name }) => name);
    const { scene, left } = withKnownPairs(this.scene, links);
    return { text: left.length === 0 ? text : textOf(scene), left };
  }

  /** Why the obstacles are not checked; empty: they are, or there are none. */
  get unchecked(): string {
    if (this.store.get().scene === "" || !this.shown) return "";
    if (this.shown.arm.planar) return "this arm moves in a plane, and the page has obstacles for arms in space only.";
    if (this.fault !== "") return this.fault;
    return this.hasShapes ? "" : "no link has shapes.";
  }

  get hasShapes(): boolean {
    return (this.arm?.bodies.length ?? 0) > 0;
  }

  /** Whether the arm that is dragged can be kept from the obstacles, now or once its shapes are read. */
  get isGuarded(): boolean {
    const isChecked = this.fault === "" && (this.arm === null || this.hasShapes);
    return isChecked && this.isUsed && this.store.get().scene !== "";
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    this.q = q;
    if (["scene", "section", "showShapes", "arm"].some((key) => changed.has(key as keyof PageState))) this.draw();
    if (!this.isUsed) return;
    this.dirty = true;
    this.running ??= this.run().finally(() => (this.running = null));
  }

  /** The shapes of the arm, once they are read. */
  async ready(): Promise<void> {
    await this.running;
  }

  /** The arguments and files of a command in the scene; as they were if nothing is checked. */
  async inScene(args: string[], files: InputFiles): Promise<{ args: string[]; files: InputFiles }> {
    const { scene, clearance } = this.store.get();
    if (!this.isUsed || scene === "") return { args, files };
    await this.ready();
    if (!this.hasShapes || this.checked.text === "") return { args, files };
    const { argument, tip, files: ofArm } = await this.source();
    const [verb = "", , ...others] = args; // the arm comes behind the verb
    const ends = tip === "" ? [] : [`--tip=${tip}`];
    const distance = clearance === 0 ? [] : [`--clearance=${clearance}`];
    return {
      args: [verb, argument, ...others, ...ends, `--scene=${sceneFile}`, ...distance],
      files: { ...files, ...ofArm, [sceneFile]: this.checked.text },
    };
  }

  /** Reads a file of obstacles as --scene does. Throws CoreError with the command's message. */
  async read(name: string, content: string): Promise<string> {
    await this.ready();
    if (this.arm === null) throw new CoreError(this.fault);
    return this.worker.scene({ ask: "read", name, content });
  }

  /** Whether the arm would keep at least `margin` from these obstacles at the present joint values. */
  async isFree(scene: string, name: string, margin: number): Promise<boolean> {
    const found = await this.worker.scene({ ask: "nearest", scene, q: this.q });
    const index = (this.arm?.bodies.length ?? 0) + sceneOf(scene).obstacles.findIndex((one) => one.name === name);
    return found.every(({ second, lower }) => second !== index || lower > margin);
  }

  /** Leads the arm from joint values towards others, as far as the clearance allows; null: nothing is checked. */
  async guarded(from: number[], to: number[], slides: boolean): Promise<GuardedStep | null> {
    if (this.arm === null) await this.ready();
    if (!this.hasShapes) return null;
    return this.worker.scene({ ask: "guard", scene: this.checked.text, from, to, slides });
  }

  /** The names of bodies by their indices. */
  namesOf([first, second]: [number, number]): [string, string] {
    const names = [...(this.arm?.bodies ?? []), ...this.scene.obstacles].map(({ name }) => name);
    return [names[first] ?? "", names[second] ?? ""];
  }

  draw(): void {
    if (!this.shown) return;
    const { showShapes } = this.store.get();
    const obstacles = this.isUsed ? this.scene.obstacles : [];
    const bodies = this.isUsed && showShapes ? (this.arm?.bodies ?? []) : [];
    this.shown.picture.mark({
      obstacles: obstacles.map((body): DrawnBody => ({ ...body, hidden: this.hidden.has(body.name) })),
      linkShapes: bodies.map((body, i): DrawnBody => ({ ...body, link: this.arm?.links[i] ?? 0 })),
      gaps: this.gaps(),
    });
  }

  private gaps(): Gap[] {
    if (!this.isUsed) return [];
    return this.nearest.map(({ lower, clearance, onFirst, onSecond, names }): Gap => ({
      points: [onFirst, onSecond],
      text: distance(lower),
      bodies: names,
      close: lower < clearance,
    }));
  }

  private async run(): Promise<void> {
    while (this.dirty) {
      this.dirty = false;
      const { arms, q } = this;
      const { clearance } = this.store.get();
      const before = [this.fault, this.arm];
      try {
        await this.readArm(clearance);
        const found = await this.worker.scene({ ask: "nearest", scene: this.checked.text, q });
        if (arms !== this.arms) continue;
        this.fault = "";
        this.nearest = found.map((pair) => ({ ...pair, names: this.namesOf([pair.first, pair.second]) }));
      } catch (error) {
        if (arms !== this.arms) continue;
        [this.fault, this.nearest, this.known] = [(error as Error).message, [], ""]; // the worker may be another one
      }
      if (before[0] !== this.fault || before[1] !== this.arm) this.draw();
      else this.shown?.picture.mark({ gaps: this.gaps() });
      for (const changed of this.listeners) changed();
    }
  }

  /** Reads the arm with its shapes where it is another one or the clearance is. */
  private async readArm(clearance: number): Promise<void> {
    const { arms } = this;
    const key = `${arms} ${clearance}`;
    if (this.known === key) return;
    const arm = await this.worker.scene({ ask: "arm", arm: await this.source(), clearance });
    if (arms === this.arms) [this.known, this.arm] = [key, arm];
  }
}
