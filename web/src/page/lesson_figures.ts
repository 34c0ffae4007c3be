import { Matrix4, Vector3, type Group } from "three";
import { answer } from "../core/command.js";
import { stepResponse } from "../core/step_response.js";
import { element, shown as text } from "../panels/element.js";
import { poseNumbers } from "../panels/pose.js";
import { Arrows, blue, trail } from "../scene/marks.js";
import type { Services, Shown } from "./section.js";

/** What a lesson draws at the arm, and shows in its text. */
export interface LessonFigure {
  readonly root: HTMLElement;
  update(shown: Shown, q: number[]): void;
  /** Takes its marks out of the picture. */
  leave(): void;
}

const amber = 0xd95f02;
const steps = 200;

function toolAt({ arm }: Shown, q: ArrayLike<number>): Vector3 {
  return new Vector3().setFromMatrixPosition(
    new Matrix4().fromArray(Array.from(arm.forward(q).at(-1) as Float64Array)),
  );
}

/** The columns of the Jacobian at the tool, and as numbers: Figure 1.8. */
class JacobianFigure implements LessonFigure {
  readonly root = element("p", { class: "columns" });
  private arrows: Arrows | null = null;
  private of: Shown | null = null;

  update(shown: Shown, q: number[]): void {
    const { arm, view } = shown;
    if (this.of !== shown) this.leave();
    this.of = shown;
    const all = arm.jacobian(q);
    const columns = q.map((_, k) => new Vector3(all[6 * k], all[6 * k + 1], all[6 * k + 2]));
    this.arrows ??= new Arrows(arm.dof, view.size / 100);
    this.arrows.place(
      toolAt(shown, q),
      columns.map((column) => column.clone().multiplyScalar(0.35)),
    );
    view.stage.scene.add(this.arrows);
    view.stage.changed();
    this.root.replaceChildren(
      ...columns.flatMap(({ x, y, z }, k) => [
        `joint ${k + 1}: (${[x, y, ...(arm.planar ? [] : [z])].map((value) => text(value, 2)).join(", ")}) m/s`,
        element("br"),
      ]),
    );
  }

  leave(): void {
    this.arrows?.dispose();
    this.arrows = null;
  }
}

/** The paths of the tool under control in joint space, orange, and in Cartesian space, blue: Figures 1.7 and 1.9. They
 * follow the gain, and the arm while it is moved. */
class ControlFigure implements LessonFigure {
  readonly root = element("fieldset", {}, element("legend", {}, "Try it"));
  private readonly gain = element("input", { type: "range", id: "lesson-gain", min: 0.02, max: 1.9, step: 0.01 });
  private readonly value = element("output", { for: "lesson-gain" });
  private readonly says = element("p", { role: "status" });
  private readonly trails = new Map<number, Group>();
  private drawn = "";
  private turn = 0;
  private of: Shown | null = null;

  constructor(
    private readonly services: Services,
    private readonly kinds: { joint: boolean; cartesian: boolean },
  ) {
    this.gain.addEventListener("input", () => services.store.set({ gain: Number(this.gain.value) }));
    const label = element("label", { for: "lesson-gain" }, "Gain Kp ", this.value);
    this.root.append(label, element("p", { class: "pair" }, this.gain), this.says);
  }

  update(shown: Shown, q: number[]): void {
    const { goal, gain } = this.services.store.get();
    this.gain.value = String(gain);
    this.value.textContent = gain.toFixed(2);
    const key = JSON.stringify([q, goal, gain]);
    if (this.of === shown && key === this.drawn) return;
    if (this.of !== shown) this.leave();
    this.of = shown;
    this.drawn = key;
    const turn = ++this.turn;
    if (goal === null || goal.length !== shown.arm.dof) {
      this.says.textContent = "There is no goal yet: choose the lesson in the list again, which sets its arm and goal.";
      return;
    }
    shown.view.showGhosts([goal, goal]);
    try {
      if (this.kinds.joint) this.jointSpace(shown, q, goal, gain);
    } catch (error) {
      this.says.textContent = (error as Error).message;
    }
    if (this.kinds.cartesian) void this.cartesian(turn, shown, q, goal, gain);
  }

  leave(): void {
    ++this.turn;
    this.drawn = "";
    for (const group of this.trails.values()) group.removeFromParent();
    this.trails.clear();
    this.of?.view.showGhosts([]);
  }

  private draw(shown: Shown, colour: number, rows: ArrayLike<number>[]): void {
    this.trails.get(colour)?.removeFromParent();
    const group = trail(
      rows.map((row) => toolAt(shown, row)),
      colour,
    );
    this.trails.set(colour, group);
    shown.view.stage.scene.add(group);
    shown.view.stage.changed();
  }

  private drawFile(shown: Shown, csv: string): void {
    const motion = shown.arm.trajectory("run.csv", csv);
    this.draw(shown, blue, motion.rows());
    motion.release();
  }

  private jointSpace(shown: Shown, q: number[], goal: number[], kp: number): void {
    this.draw(shown, amber, [q, ...shown.arm.pid({ kp }, q, goal, steps)]);
    const { settled, overshoot } = stepResponse(shown.arm, { kp }, q, goal, steps);
    const over = overshoot > 0.001 ? `, overshoot ${text(100 * overshoot, 0)} %` : "";
    this.says.textContent =
      `Orange, joint space: ` +
      (settled === null ? `more than ${steps} steps` : `within 2 % of the way after ${settled} steps`) +
      `${over}. `;
  }

  private async cartesian(turn: number, shown: Shown, q: number[], goal: number[], gain: number): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve, 120)); // while a slider moves, its last value counts
    if (turn !== this.turn) return;
    const { position, quaternion } = poseNumbers(shown.arm.forward(goal).at(-1) as Float64Array);
    const files = { "goal.csv": `x,y,z,qw,qx,qy,qz\n${[...position, ...quaternion].join(",")}\n` };
    const how = ["--method=inverse-jacobian", `--gain=${gain}`, `--max-steps=${10 * steps}`, "--out=run.csv", "--json"];
    const before = this.kinds.joint ? (this.says.textContent ?? "") : "";
    try {
      const result = await this.services.command(
        ["line", "arm.json", `--from=${q.join(",")}`, "--through=goal.csv", ...how],
        files,
      );
      if (turn !== this.turn) return;
      const { status, steps: count, reason } = answer<{ status: string; steps?: number; reason: string }>(result);
      const csv = result.files["run.csv"];
      if (csv !== undefined) this.drawFile(shown, csv);
      this.says.textContent = `${before}Blue, Cartesian space: ${status}${count === undefined ? "" : ` after ${count} steps`}. ${reason}`;
    } catch (error) {
      if (turn === this.turn) this.says.textContent = before + (error as Error).message;
    }
  }
}

/** The figures by the names that the lessons use. */
export const lessonFigures: Record<string, (services: Services) => LessonFigure> = {
  jacobian: () => new JacobianFigure(),
  "joint-control": (services) => new ControlFigure(services, { joint: true, cartesian: false }),
  "cartesian-control": (services) => new ControlFigure(services, { joint: false, cartesian: true }),
  "both-controls": (services) => new ControlFigure(services, { joint: true, cartesian: true }),
};
