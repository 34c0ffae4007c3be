import { middle, type ArmDescription } from "../core/description.js";
import { toolPose } from "../core/pose.js";
import { iconButton } from "../elements/button.js";
import { element } from "../elements/element.js";
import { reducedMotion } from "../elements/motion.js";
import { GainsPanel } from "../panels/gains.js";
import { StepChart } from "../panels/step_chart.js";
import type { Ghost } from "../scene/picture.js";
import type { PageState } from "../state/page_state.js";
import { ControlRuns, type ControlKind, type ControlTask } from "./control_runs.js";
import type { PageSection, Services, Shown } from "./section.js";

const duration = 2000; // milliseconds of a run, at most
const glide = 500; // milliseconds from where the arm is to where it starts
const frame = 30; // milliseconds of a step, at least
const longest = 0.2; // of a motion, from picture to picture
const smallestVisibleMotion = 0.01; // rad or m

/** Joint-space and Cartesian control to the same goal: Figures 1.7 and 1.9 of the chapter. All that is shown follows the
 * gains while they move. */
export class Control implements PageSection {
  readonly root = element("div", { class: "panel" });
  private readonly gains = new GainsPanel((key, value) => {
    this.interrupt();
    this.services.store.set({ [key === "kp" ? "gain" : key]: value });
  });
  private readonly chart = new StepChart();
  private readonly runs: ControlRuns;
  private readonly back: HTMLButtonElement;
  private readonly go: HTMLButtonElement[];
  /** Said where the start is so near the goal that Go seems to do nothing. */
  private readonly near = element("p", { class: "quiet", role: "status" });
  private shown: Shown | null = null;
  /** Where the arm has started; null: it starts where it is. */
  private start: number[] | null = null;
  private computed = "";
  private playing = 0;
  private moving = false;

  constructor(private readonly services: Services) {
    const { store } = services;
    this.runs = new ControlRuns(services, ["joint", "cartesian"]);
    const goal = element("button", { type: "button" }, "Make this the goal");
    goal.addEventListener("click", () => {
      this.start = null;
      store.set({ goal: store.get().q });
    });
    this.back = element("button", { type: "button", onclick: () => this.goBack() }, "Back to the start");
    const go = (kind: ControlKind, word: string): HTMLButtonElement =>
      iconButton("play", word, "The arm moves step by step", () => void this.play(kind));
    this.go = [go("joint", "Go in joint space"), go("cartesian", "Go in Cartesian space")];
    const quiet = (text: string): HTMLElement => element("p", { class: "quiet" }, text);
    this.root.append(
      element("h2", {}, "Control"),
      quiet("Two controllers go to the goal, each step in proportion to the error. A dot is a step."),
      this.gains.root, // nothing above it changes its height: sliders stay under the finger
      this.chart.words,
      element("p", { class: "pair" }, ...this.go),
      this.near,
      this.runs.root,
      quiet(
        "In joint space (eq. 1.3) the error is measured in the joints, and the tool's path is curved; in Cartesian " +
          "space (eq. 1.6) it is measured at the tool, and the path is straight. The tool may arrive there in another " +
          "configuration than the goal's.",
      ),
      element("p", { class: "pair" }, goal, this.back),
      this.chart.root,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.start = null;
    this.forget();
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    if (!this.shown) return;
    if (changed.size === 1 && changed.has("q") && !this.moving) {
      this.interrupt();
      this.start = null; // a hand has moved the arm: it starts from here
    }
    const { gain, ki, kd, degrees } = this.services.store.get();
    this.gains.show({ kp: gain, ki, kd });
    const task = this.task(q);
    this.back.disabled = this.start === null;
    const key = JSON.stringify([task, degrees]);
    if (key === this.computed) return;
    this.computed = key;
    this.compute(task);
  }

  leave(): void {
    this.forget();
  }

  interrupt(): void {
    ++this.playing;
    this.services.draw({ moving: false });
  }

  /** The goal was dragged to a pose. */
  waypoint(_: number, pose: number[]): void {
    if (!this.shown) return;
    const { goal } = this.task(this.services.store.get().q ?? []);
    const [found] = this.shown.arm.inverse(pose, goal);
    if (found) this.services.store.set({ goal: Array.from(found) });
  }

  private forget(): void {
    ++this.playing;
    this.computed = "";
    this.runs.stop();
  }

  private task(q: number[]): ControlTask {
    const { goal, gain, ki, kd } = this.services.store.get();
    const from = this.start ?? q;
    const fits = goal !== null && goal.length === this.shown?.arm.dof;
    return { from, goal: fits ? goal : aside(from, this.shown?.description), gains: { kp: gain, ki, kd } };
  }

  private compute(task: ControlTask): void {
    if (!this.shown) return;
    const { arm, description } = this.shown;
    const start: Ghost[] = this.start ? [{ q: task.from, tone: "start" }] : [];
    const ghosts: Ghost[] = [...start, { q: task.goal, tone: "goal" }];
    const waypoints = [{ pose: Array.from(toolPose(arm, task.goal)), label: "goal", held: true }];
    const distance = Math.max(...task.goal.map((value, k) => Math.abs(value - (task.from[k] ?? NaN))));
    for (const button of this.go) button.disabled = distance === 0;
    this.near.textContent =
      distance > 0 && distance < smallestVisibleMotion
        ? "The arm is so near the goal that hardly anything moves: drag the arm or the goal elsewhere."
        : "";
    if (distance === 0) {
      this.runs.clear();
      this.services.draw({ trails: [], ghosts: [], waypoints });
      return this.chart.refuse("The arm is at the goal: drag the arm or the goal elsewhere.");
    }
    try {
      this.services.draw({ trails: this.runs.update(this.shown, task), ghosts, waypoints });
      if (this.runs.response)
        this.chart.show(this.runs.response, task.gains, description.joints, this.services.store.get().degrees);
    } catch (error) {
      this.services.draw({ trails: [], ghosts, waypoints });
      this.chart.refuse((error as Error).message);
    }
  }

  private goBack(): void {
    const turn = ++this.playing;
    const { start } = this;
    if (!start) return;
    void this.glideTo(start, turn).then(() => {
      if (turn !== this.playing) return;
      this.start = null;
      this.computed = ""; // the start has no ghost any more
      this.update(start, new Set());
    });
  }

  /** Moves the arm to joint values on the straight way in joint space. */
  private async glideTo(to: number[], turn: number): Promise<void> {
    const from = this.services.store.get().q ?? to;
    if (from.every((value, k) => value === to[k])) return;
    await this.animate(glide, turn, (fraction) => {
      const part = fraction * fraction * (3 - 2 * fraction); // it begins and ends at rest
      this.move(fraction === 1 ? to : from.map((value, k) => value + part * ((to[k] ?? 0) - value)));
    });
  }

  /** Calls `show` with fractions of the time from 0 to 1, until another motion begins. A slow browser shows the way too. */
  private async animate(length: number, turn: number, show: (fraction: number) => void): Promise<void> {
    const begin = performance.now();
    let next = 0;
    while (turn === this.playing) {
      const fraction = reducedMotion() ? 1 : Math.min(1, next, (performance.now() - begin) / length);
      next = fraction + longest;
      show(fraction);
      if (fraction === 1) return;
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
  }

  private move(q: number[]): void {
    this.moving = true;
    this.services.store.set({ q });
    this.moving = false;
  }

  /** Moves the arm along the steps of a controller, from the start to where they end. */
  private async play(kind: ControlKind): Promise<void> {
    const { q, goal } = this.services.store.get();
    if (!q || !this.shown) return;
    const turn = ++this.playing;
    const task = this.task(q);
    if (goal === null) this.services.store.set({ goal: task.goal });
    this.start = task.from;
    this.services.draw({ moving: true });
    await this.glideTo(task.from, turn);
    const rows = this.runs.rowsOf(kind);
    await this.animate(Math.min(duration, frame * rows.length), turn, (fraction) => {
      const row = rows[Math.round(fraction * (rows.length - 1))];
      if (row) this.move(row);
    });
    if (turn === this.playing) this.services.draw({ moving: false });
    this.computed = ""; // the start has a ghost from now on
    if (turn === this.playing) this.update(this.services.store.get().q ?? q, new Set());
  }
}

/** A goal for those who have not chosen one: each joint up to a third of the way to the farther limit, each by another
 * part of it, so that their curves differ. */
function aside(q: number[], description: ArmDescription | undefined): number[] {
  if (!description) return q;
  const centre = middle(description);
  return q.map((value, k) => {
    const { lower, upper } = description.joints[k]?.limits ?? { lower: null, upper: null };
    const far = value > (centre[k] ?? 0) ? (lower ?? value - 1.5) : (upper ?? value + 1.5);
    const part = 1 - (0.7 * k) / q.length;
    return value + part * Math.sign(far - value) * Math.min(Math.abs(far - value) / 3, 0.7);
  });
}
