import { answer } from "../core/command.js";
import { toolPose } from "../core/pose.js";
import { iconButton } from "../elements/button.js";
import { element } from "../elements/element.js";
import { reducedMotion } from "../elements/motion.js";
import type { LineAnswer } from "../panels/motion_report.js";
import type { Ghost, Mark, Trail } from "../scene/picture.js";
import type { PageState } from "../state/page_state.js";
import { MotionPlayer } from "./motion_player.js";
import { ReportedMotion } from "./reported_motion.js";
import type { Services, Shown } from "./section.js";

const same = 1e-6; // rad or m

/** A joint motion around the obstacles to a goal: planned and proved when the goal is dropped, and played. */
export class AroundMove {
  readonly root = element("section", { class: "around", "aria-label": "A way around" });
  private readonly player: MotionPlayer;
  private readonly report: ReportedMotion;
  private readonly plan: HTMLButtonElement;
  private readonly remove: HTMLButtonElement;
  private shown: Shown | null = null;
  private trails: Trail[] = [];
  private plannedFor = "";
  private drawn = "";

  constructor(private readonly services: Services) {
    const { store } = services;
    this.player = new MotionPlayer(services, null);
    this.report = new ReportedMotion(services);
    const set = iconButton("add", "Set the goal here", "The arm’s joint values become the goal", () =>
      store.set({ goal: store.get().q }),
    );
    this.plan = iconButton(
      "play",
      "Go around",
      "Plans a way from where the arm stands to the goal",
      () => void this.go(),
    );
    this.remove = element("button", { type: "button", onclick: () => store.set({ goal: null }) }, "Remove the goal");
    this.root.append(
      element("h3", {}, "A way around"),
      element(
        "p",
        { class: "quiet" },
        "Drag the arm beyond an obstacle and let go, or drag the goal: a way around is planned, proved and played.",
      ),
      element("p", { class: "pair" }, set, this.plan, this.remove),
      this.report.work.root,
      this.player.bar,
      this.report.root,
      this.player.root,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.player.take(shown);
    this.report.take(shown);
    this.clear();
  }

  /** The state has changed, or the section is shown from now on. */
  update(changed: ReadonlySet<keyof PageState>): void {
    if (changed.has("q") && !this.player.places) this.player.pause();
    if (changed.has("degrees")) {
      this.player.showCurves();
      this.report.unitsChanged();
    }
    if (this.key !== this.plannedFor) this.clear();
    const { goal } = this;
    this.plan.disabled = goal === null || this.isThere(goal);
    this.remove.disabled = goal === null;
    if (changed.has("section")) this.drawn = "";
    this.draw();
  }

  pause(): void {
    this.player.pause();
  }

  /** Another section is shown: nothing is planned any more. */
  leave(): void {
    this.report.work.stop();
    this.player.pause();
  }

  /** The goal was dragged to a pose, or dropped there. */
  goalAt(pose: number[], released: boolean): void {
    const { goal, shown } = this;
    if (!goal || !shown) return;
    const [found] = shown.arm.inverse(pose, goal);
    if (found) this.services.store.set({ goal: Array.from(found) });
    if (released) void this.go();
  }

  /** Plans a way to joint values and goes there. */
  goTo(goal: number[]): void {
    this.services.store.set({ goal });
    void this.go();
  }

  private get goal(): number[] | null {
    const { goal } = this.services.store.get();
    return goal !== null && goal.length === this.shown?.arm.dof ? goal : null;
  }

  /** What a plan depends on beside where it begins. */
  private get key(): string {
    return [this.goal?.join(","), this.services.surroundings()].join("\n");
  }

  private isThere(goal: number[]): boolean {
    const { q } = this.services.store.get();
    return goal.every((value, k) => Math.abs(value - (q?.[k] ?? NaN)) < same);
  }

  private clear(): void {
    this.report.work.stop();
    this.player.clear();
    this.plannedFor = this.key;
    this.trails = [];
    this.report.show(null);
  }

  private async go(): Promise<void> {
    const { goal } = this;
    const { q } = this.services.store.get();
    if (!goal || !q || this.isThere(goal)) return;
    this.clear();
    this.draw();
    const ends = [`--from=${q.join(",")}`, `--to=${goal.join(",")}`];
    const args = ["move", "arm.json", ...ends, "--method=around", "--out=motion.csv", "--json"];
    await this.report.work.run(async (progress, current) => {
      const result = await this.services.inScene(args, {}, progress);
      if (!current()) return;
      this.report.show(answer<LineAnswer>(result));
      const csv = result.files["motion.csv"];
      if (csv === undefined) return;
      this.player.show("motion.csv", csv);
      this.trails = this.player.trail("planned");
      this.draw();
      if (!reducedMotion()) this.player.play();
    });
  }

  /** Draws the goal where the arm is elsewhere, and the way there. */
  private draw(): void {
    const { goal, shown } = this;
    if (!shown || this.services.store.get().section !== "obstacles") return;
    const isShown = goal !== null && !this.isThere(goal);
    const drawn = [isShown, goal?.join(","), this.trails.length > 0, this.plannedFor].join("\n");
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    const ghosts: Ghost[] = isShown ? [{ q: goal, tone: "goal" }] : [];
    const waypoints: Mark[] = isShown
      ? [{ pose: Array.from(toolPose(shown.arm, goal)), label: "goal", held: true }]
      : [];
    this.services.draw({ ghosts, waypoints, trails: this.trails });
  }
}
