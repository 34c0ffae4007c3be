import { Matrix4, Vector3 } from "three";
import { answer } from "../core/command.js";
import { JacobianPanel } from "../panels/jacobian.js";
import type { JointsPanel } from "../panels/joints.js";
import { PosePanel, poseNumbers } from "../panels/pose.js";
import { SolutionsPanel, type InverseAnswer } from "../panels/solutions.js";
import { element } from "../panels/element.js";
import { VelocityEllipsoid } from "../scene/ellipsoid.js";
import { Arrows } from "../scene/marks.js";
import type { PageState } from "../state/page_state.js";
import type { SectionPanel, Services, Shown } from "./section.js";
import { selfMotion } from "./self_motion.js";

const shortening = 0.35; // metres drawn for a metre a second

/** The section where the arm is held: sliders, the tool dragged by hand, numbers, all solutions. */
export class Hold implements SectionPanel {
  readonly root = element("div", { class: "panel" });
  private readonly pose = new PosePanel((pose) => this.reach(pose));
  private readonly jacobian: JacobianPanel;
  private readonly solutions: SolutionsPanel;
  private readonly redundancy = element("input", { type: "range", min: -1, max: 1, step: "any", value: 0, id: "self" });
  private readonly selfMotionRow = element(
    "div",
    { class: "joint" },
    element("label", { for: "self" }, "self-motion"),
    this.redundancy,
  );
  private columns: Arrows | null = null;
  private ellipsoid: VelocityEllipsoid | null = null;
  private shown: Shown | null = null;
  private asked = 0;
  /** The joint velocities of the self-motion's last step. */
  private selfDirection: number[] = [];
  private answered: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly services: Services,
    private readonly joints: JointsPanel,
  ) {
    const { store } = services;
    this.jacobian = new JacobianPanel((frame) => store.set({ frame }));
    this.solutions = new SolutionsPanel(
      (q) => store.set({ q }),
      (index) => this.shown?.view.point(index),
    );
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
    this.root.append(this.selfMotionRow, this.pose.root, this.solutions.root, this.jacobian.root);
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.selfDirection = [];
    this.columns?.dispose();
    this.ellipsoid?.dispose();
    this.columns = this.ellipsoid = null;
    ++this.asked;
    this.solutions.clear();
    this.selfMotionRow.hidden = shown.arm.dof <= (shown.arm.planar ? 3 : 6);
    shown.view.onDrag((pose) => this.reach(pose));
    this.pose.describe(shown.arm.planar);
    this.joints.describe(shown.description.joints, this.services.store.get().degrees);
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    if (!this.shown) return;
    const { arm, description, view } = this.shown;
    const state = this.services.store.get();
    if (changed.has("degrees")) this.joints.describe(description.joints, state.degrees);
    if (this.joints.root.parentElement !== this.root) this.root.prepend(this.joints.root);
    this.joints.show(q);
    const poses = arm.forward(q);
    const tool = poses[poses.length - 1] as Float64Array;
    view.show(q, poses, state.showFrames);
    this.pose.show(tool, state.degrees);
    const names = description.joints.map((joint) => joint.name);
    this.jacobian.show(arm.jacobian(q, state.frame), names, state.frame, arm.manipulability(q));
    this.showColumns(this.shown, q, tool);
    void this.ask(Array.from(tool), q, (found) => {
      const { degrees, showSolutions } = this.services.store.get();
      this.solutions.show(found, description.joints, degrees);
      view.showGhosts(showSolutions ? found.solutions : []);
    });
  }

  leave(): void {
    ++this.asked;
    this.columns?.removeFromParent();
    this.ellipsoid?.removeFromParent();
    this.shown?.view.showGhosts([]);
  }

  /** The columns of the Jacobian at the tool, red, green, blue: Figure 1.8 of the chapter. */
  private showColumns({ arm, view }: Shown, q: number[], tool: Float64Array): void {
    const base = arm.jacobian(q, "base");
    const vectors = Array.from(
      { length: arm.dof },
      (_, k) => new Vector3(base[6 * k], base[6 * k + 1], base[6 * k + 2]),
    );
    const origin = new Vector3().setFromMatrixPosition(new Matrix4().fromArray(Array.from(tool)));
    this.ellipsoid ??= new VelocityEllipsoid(view.size / 500);
    this.ellipsoid.place(origin, vectors, shortening);
    this.ellipsoid.visible = this.services.store.get().showEllipsoid;
    const shorter = vectors.map((vector) => vector.multiplyScalar(shortening));
    this.columns ??= new Arrows(arm.dof, view.size / 100);
    this.columns.place(origin, shorter);
    view.stage.scene.add(this.columns, this.ellipsoid);
    view.stage.changed();
  }

  /** Moves the tool to a pose, or says why the arm does not reach it. */
  private reach(pose: number[]): void {
    const { q } = this.services.store.get();
    if (!this.shown || !q) return;
    let found: Float64Array | undefined;
    try {
      [found] = this.shown.arm.inverse(pose, q);
    } catch (error) {
      return this.refuse((error as Error).message); // for numbers beyond the range of any arm
    }
    if (found) this.services.store.set({ q: Array.from(found) });
    else void this.ask(pose, q, ({ reason }) => this.refuse(reason));
  }

  private refuse(reason: string): void {
    this.solutions.refuse(reason);
    this.shown?.view.showGhosts([]);
  }

  /** Asks the worker once the hand rests and the question before is answered, so that none pile up. Only the answer to
   * the last question is shown. */
  private async ask(pose: number[], q: number[], show: (found: InverseAnswer) => void): Promise<void> {
    const asked = ++this.asked;
    await new Promise((resolve) => setTimeout(resolve, 120));
    await this.answered;
    if (asked !== this.asked) return;
    const found = this.inverse(pose, q);
    this.answered = found.catch(() => undefined);
    try {
      const solutions = await found;
      if (asked === this.asked) show(solutions);
    } catch (error) {
      if (asked === this.asked) this.refuse((error as Error).message);
    }
  }

  /** All solutions for the pose, the nearest to q first, as `beeline ik` finds them. */
  private async inverse(pose: number[], q: number[]): Promise<InverseAnswer> {
    const { position, quaternion } = poseNumbers(pose);
    const goal = `--pose=${[...position, ...quaternion].join(",")}`;
    return answer(await this.services.command(["ik", "arm.json", goal, `--seed=${q.join(",")}`, "--all", "--json"]));
  }

  private moveItself(distance: number): void {
    const { q } = this.services.store.get();
    if (!this.shown || !q) return;
    const { arm } = this.shown;
    const pose = arm.forward(q).at(-1) as Float64Array;
    const found = selfMotion(arm.jacobian(q, "base"), arm.dof);
    if (!found) return;
    // Both signs are right: the one that goes on as before.
    const along = found.reduce((sum, value, k) => sum + value * (this.selfDirection[k] ?? 0), 0);
    const direction = along < 0 ? found.map((value) => -value) : found;
    this.selfDirection = direction;
    const moved = q.map((value, k) => value + distance * (direction[k] ?? 0));
    const [reached] = arm.inverse(pose, moved);
    if (reached) this.services.store.set({ q: Array.from(reached) });
  }
}
