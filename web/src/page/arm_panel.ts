import { answer } from "../core/command.js";
import { poseError, sevenOf, toolPose } from "../core/pose.js";
import { singularity } from "../core/singularity.js";
import { Cancelled } from "../core/types.js";
import { element } from "../elements/element.js";
import { JacobianPanel } from "../panels/jacobian.js";
import { JointsPanel } from "../panels/joints.js";
import { PosePanel } from "../panels/pose.js";
import { slider } from "../panels/slider.js";
import { SolutionsPanel, type InverseAnswer } from "../panels/solutions.js";
import type { PageState, Section } from "../state/page_state.js";
import { ArmLesson } from "./arm_lesson.js";
import type { Holding } from "./holding.js";
import type { Overlays } from "./overlays.js";
import { Rest } from "./rest.js";
import { selfMotion } from "./self_motion.js";
import type { Services, Shown } from "./section.js";

const samePose = 1e-6; // of the size of the picture
const longTable = 20; // columns: a longer table is written when the arm rests

/** The arm in numbers, in all sections: joints, pose of the tool, solutions, Jacobian. */
export class ArmPanel {
  readonly root = element("section", { class: "arm-panel", "aria-label": "Arm" });
  private readonly joints: JointsPanel;
  private readonly pose: PosePanel;
  private readonly solutions: SolutionsPanel;
  private readonly jacobian: JacobianPanel;
  private readonly lesson: ArmLesson;
  /** In the section Pose alone: a lesson has its own links. */
  private readonly lessonPart = element("div");
  private readonly redundancy = slider({ min: -1, max: 1, step: "any", value: 0, id: "self" });
  private readonly selfMotionRow: HTMLElement;
  private readonly solutionsPart: HTMLDetailsElement;
  private readonly jacobianPart: HTMLDetailsElement;
  private readonly rest = new Rest();
  private shown: Shown | null = null;
  /** The pose whose solutions are listed, the unit of their numbers, and the obstacles among which they are. */
  private listed: { pose: ArrayLike<number>; degrees: boolean; surroundings: string } | null = null;
  private asked = 0;
  private answered: Promise<unknown> = Promise.resolve();
  /** The joint velocities of the self-motion's last step. */
  private selfDirection: number[] = [];

  constructor(
    private readonly services: Services,
    private readonly holding: Holding,
    overlays: Overlays,
    openLesson: (lesson: string) => void,
  ) {
    const { store } = services;
    this.lesson = new ArmLesson(openLesson);
    this.lessonPart.append(this.lesson.root);
    this.joints = new JointsPanel((q, isDragged) => {
      if (isDragged) return holding.slid(q);
      holding.forget();
      store.set({ q });
    });
    this.pose = new PosePanel((pose) => holding.typed(pose, (reason) => this.refuse(reason)));
    this.solutions = new SolutionsPanel(
      (q) => store.set({ q }),
      (q) => overlays.point(q, store.get().showSolutions),
    );
    this.jacobian = new JacobianPanel((frame) => store.set({ frame }));
    this.selfMotionRow = element(
      "div",
      { class: "self-motion" },
      element("label", { for: "self" }, "self-motion"),
      this.redundancy,
    );
    this.joints.below.append(this.selfMotionRow);
    let last = 0;
    this.redundancy.addEventListener("input", () => {
      const value = Number(this.redundancy.value);
      this.moveItself(3 * (value - last));
      last = value;
    });
    this.redundancy.addEventListener("change", () => {
      this.redundancy.value = "0";
      last = 0;
    });
    const part = (title: string, content: HTMLElement): HTMLDetailsElement =>
      element("details", { class: "part" }, element("summary", {}, title), content);
    this.solutionsPart = part("Solutions for this pose", this.solutions.root);
    this.jacobianPart = part("Jacobian", this.jacobian.root);
    for (const details of [this.solutionsPart, this.jacobianPart])
      details.addEventListener("toggle", () => {
        const { q } = store.get();
        if (q && details.open && this.fits(q)) this.showParts(q);
      });
    this.root.append(this.joints.root, this.pose.root, this.lessonPart, this.solutionsPart, this.jacobianPart);
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.selfDirection = [];
    this.forget();
    this.listed = null;
    this.solutions.clear();
    this.selfMotionRow.hidden = shown.arm.dof <= (shown.arm.planar ? 3 : 6);
    this.pose.describe(shown.arm.planar);
    this.lesson.take(shown);
    this.joints.describe(shown.description.joints, this.services.store.get().degrees);
  }

  /** Solutions and Jacobian are open in the section Pose, and wait in others. */
  arrange(section: Section): void {
    this.lessonPart.hidden = section !== "pose";
    this.solutionsPart.open = this.jacobianPart.open = section === "pose";
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    if (!this.shown) return;
    const { degrees } = this.services.store.get();
    if (changed.has("degrees")) this.joints.describe(this.shown.description.joints, degrees);
    this.joints.show(q);
    this.pose.show(toolPose(this.shown.arm, q), degrees);
    this.showParts(q);
  }

  private fits(q: number[]): boolean {
    return q.length === this.shown?.arm.dof;
  }

  private showParts(q: number[]): void {
    if (!this.shown) return;
    const { arm, description } = this.shown;
    const { frame, degrees } = this.services.store.get();
    const names = description.joints.map((joint) => joint.name);
    const jacobian = (): void => {
      if (!this.jacobianPart.open) return;
      const measures = { ...arm.manipulability(q), singularity: singularity(arm, q) };
      this.jacobian.show(arm.jacobian(q, frame), names, frame, measures, { planar: arm.planar, degrees });
    };
    const isLong = arm.dof > longTable;
    if (!isLong) jacobian();
    this.forget();
    this.dropOthers();
    const isListed = this.isListed(q) && this.solutions.mark(q);
    this.rest.then(() => {
      if (isLong) jacobian();
      if (this.solutionsPart.open && !isListed) void this.ask(q);
    });
  }

  /** Whether the solutions of this pose of the tool are listed. */
  private isListed(q: number[]): boolean {
    const { shown, listed } = this;
    if (!shown || !listed || listed.degrees !== this.services.store.get().degrees) return false;
    return Math.hypot(...poseError(toolPose(shown.arm, q), Array.from(listed.pose))) < samePose * shown.picture.size;
  }

  /** Solutions among other obstacles are not shown any more. */
  private dropOthers(): void {
    if (!this.listed || this.listed.surroundings === this.services.surroundings()) return;
    this.listed = null;
    this.solutions.clear();
  }

  /** What was asked before is not shown any more. */
  private forget(): void {
    ++this.asked;
    this.rest.cancel();
  }

  private refuse(reason: string): void {
    this.forget();
    this.listed = null;
    this.solutions.refuse(reason);
  }

  /** Asks the worker once the question before is answered, so that none pile up. */
  private async ask(q: number[]): Promise<void> {
    const asked = ++this.asked;
    await this.answered;
    if (asked !== this.asked || !this.shown) return;
    const pose = toolPose(this.shown.arm, q);
    const args = ["ik", "arm.json", `--pose=${sevenOf(pose).join(",")}`, `--seed=${q.join(",")}`, "--all", "--json"];
    const surroundings = this.services.surroundings();
    const found = this.services.inScene(args).then((result) => answer<InverseAnswer>(result));
    this.answered = found.catch(() => undefined);
    try {
      const solutions = await found;
      if (asked !== this.asked) return;
      const { degrees } = this.services.store.get();
      const wording = { degrees, planar: this.shown.arm.planar };
      this.solutions.show(solutions, q, this.shown.description.joints, wording);
      this.listed = { pose, degrees, surroundings };
    } catch (error) {
      if (asked === this.asked && !(error instanceof Cancelled)) this.solutions.refuse((error as Error).message);
    }
  }

  private moveItself(distance: number): void {
    const { q } = this.services.store.get();
    if (!this.shown || !q) return;
    const { arm } = this.shown;
    const found = selfMotion(arm.jacobian(q, "base"), arm.dof);
    if (!found) return;
    // Both signs are right: the one that goes on as before.
    const along = found.reduce((sum, value, k) => sum + value * (this.selfDirection[k] ?? 0), 0);
    const direction = along < 0 ? found.map((value) => -value) : found;
    this.selfDirection = direction;
    const moved = q.map((value, k) => value + distance * (direction[k] ?? 0));
    const [reached] = arm.inverse(toolPose(arm, q), moved);
    if (reached) this.holding.slid(Array.from(reached));
  }
}
