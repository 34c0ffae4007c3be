import { Matrix4, Vector3, type Group } from "three";
import type { Arm } from "../core/arm.js";
import { answer } from "../core/command.js";
import type { Files } from "../core/types.js";
import { stepResponse } from "../core/step_response.js";
import { element, shown } from "../panels/element.js";
import { GainsPanel } from "../panels/gains.js";
import { poseNumbers } from "../panels/pose.js";
import { StepChart } from "../panels/step_chart.js";
import { blue, trail } from "../scene/marks.js";
import { middle, type ArmDescription } from "../core/description.js";
import type { SectionPanel, Services, Shown } from "./section.js";

/** What `beeline move` and `beeline line --method inverse-jacobian` print. */
interface Outcome {
  status: string;
  steps?: number;
  samples: number;
  overshoot?: number;
  reason: string;
}

interface Run {
  title: string;
  colour: number;
  args: string[];
  files: Files;
}

const steps = 2000; // of a controller that crawls
const responseSteps = 400;
const amber = 0xd95f02;

/** Joint-space and Cartesian control side by side, to the same goal: Figures 1.7 and 1.9 of the chapter. */
export class Control implements SectionPanel {
  readonly root = element("div", { class: "panel" });
  private readonly gains = new GainsPanel((key, value) =>
    this.services.store.set({ [key === "kp" ? "gain" : key]: value }),
  );
  private readonly chart = new StepChart();
  private readonly results = element("div", { role: "status" });
  private readonly go = element("button", { type: "button", onclick: () => void this.run() }, "Go to the goal");
  private trails: Group[] = [];
  private open = false;
  private shown: Shown | null = null;
  private playing = 0;
  private turn = 0;

  constructor(private readonly services: Services) {
    const { store } = services;
    const goal = element("button", { type: "button" }, "Make this the goal");
    goal.addEventListener("click", () => store.set({ goal: store.get().q }));
    this.root.append(
      element("h2", {}, "Joint space beside Cartesian space"),
      element(
        "p",
        {},
        "Both controllers go to the goal by steps in proportion to the error. One measures it in the joints, so " +
          "the tool's path is curved. The other measures it at the tool, through the inverse Jacobian, so the path is a " +
          "straight line. Each dot is a step: the dots lie close together where the arm is slow.",
      ),
      element("p", { class: "quiet" }, "Move the arm to a pose and make it the goal; then move it elsewhere and go."),
      element("p", { class: "pair" }, goal, this.go),
      this.results,
      this.gains.root,
      element(
        "p",
        { class: "quiet" },
        "Both controllers use Kp. Ki and Kd act in joint space: a sum of the errors, and their change.",
      ),
      this.chart.root,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    ++this.playing;
    ++this.turn;
    this.trails = [];
    this.results.replaceChildren();
  }

  update(q: number[]): void {
    const { goal, showFrames } = this.services.store.get();
    if (!this.shown) return;
    const { arm, view } = this.shown;
    if (!this.open) for (const group of this.trails) view.stage.scene.add(group);
    this.open = true;
    view.show(q, arm.forward(q), showFrames);
    view.showGhosts(this.withGoal(goal));
    this.showResponse(q);
  }

  leave(): void {
    this.open = false;
    ++this.playing;
    for (const group of this.trails) group.removeFromParent();
    this.shown?.view.showGhosts([]);
  }

  private showResponse(q: number[]): void {
    const { goal, gain, ki, kd, degrees } = this.services.store.get();
    this.gains.show({ kp: gain, ki, kd });
    if (!this.shown) return;
    const { arm, description } = this.shown;
    const to = this.fits(goal) ? goal : this.aside(q, description);
    if (to.every((value, k) => value === q[k])) return this.chart.refuse("The arm is at the goal: hold it elsewhere.");
    try {
      const response = stepResponse(arm, { kp: gain, ki, kd }, q, to, responseSteps);
      this.chart.show(response, description.joints, degrees);
    } catch (error) {
      this.chart.refuse((error as Error).message);
    }
  }

  /** A list whose second configuration, the first ghost, is the goal. */
  private withGoal(goal: number[] | null): number[][] {
    return this.fits(goal) ? [goal, goal] : [];
  }

  private fits(q: number[] | null): q is number[] {
    return q !== null && q.length === this.shown?.arm.dof;
  }

  private clear(): void {
    ++this.playing;
    ++this.turn;
    for (const group of this.trails) group.removeFromParent();
    this.trails = [];
  }

  private async run(): Promise<void> {
    const { q, goal, gain, ki, kd } = this.services.store.get();
    if (!this.shown || !this.fits(q)) return;
    const { arm, view, description } = this.shown;
    this.clear();
    const to = this.fits(goal) ? goal : this.aside(q, description);
    this.services.store.set({ goal: to });
    const pose = poseNumbers(arm.forward(to).at(-1) as Float64Array);
    const common = [`--gain=${gain}`, `--max-steps=${steps}`, "--out=run.csv", "--json"];
    const from = `--from=${q.join(",")}`;
    const poses = `x,y,z,qw,qx,qy,qz\n${[...pose.position, ...pose.quaternion].join(",")}\n`;
    const runs: Run[] = [
      {
        title: "Joint space",
        colour: amber,
        args: ["move", "arm.json", from, `--to=${to.join(",")}`, `--ki=${ki}`, `--kd=${kd}`, ...common],
        files: {},
      },
      {
        title: "Cartesian space",
        colour: blue,
        args: ["line", "arm.json", from, "--through=goal.csv", "--method=inverse-jacobian", ...common],
        files: { "goal.csv": poses },
      },
    ];
    this.results.replaceChildren();
    const { turn } = this;
    for (const run of runs) {
      if (turn === this.turn) await this.one(run, arm, view);
    }
  }

  private async one(run: Run, arm: Arm, view: Shown["view"]): Promise<void> {
    const { turn } = this;
    const line = element("p", {}, `${run.title}: …`);
    this.results.append(line);
    try {
      const result = await this.services.command(run.args, run.files);
      if (turn !== this.turn) return;
      const outcome = answer<Outcome>(result);
      const written = result.files["run.csv"];
      const rows = written === undefined ? [] : rowsOf(arm, written);
      const points = rows.map((row) => new Vector3().setFromMatrixPosition(this.tool(arm, row)));
      const count = Math.max(0, points.length - 1);
      const over = outcome.overshoot ? `, overshoot ${shown(outcome.overshoot)}` : "";
      line.textContent = `${run.title}: ${outcome.status}, ${count} steps${over}. ${outcome.reason}`;
      const group = trail(points, run.colour);
      this.trails.push(group);
      if (!this.open) return;
      view.stage.scene.add(group);
      await this.play(rows);
    } catch (error) {
      line.textContent = `${run.title}: ${(error as Error).message}`;
    }
  }

  private tool(arm: Arm, q: number[]): Matrix4 {
    return new Matrix4().fromArray(Array.from(arm.forward(q).at(-1) as Float64Array));
  }

  /** Shows the rows in two seconds, then the arm where it began. */
  private async play(rows: number[][]): Promise<void> {
    const turn = ++this.playing;
    const duration = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 2000;
    const begin = performance.now();
    while (turn === this.playing) {
      const share = duration === 0 ? 1 : Math.min(1, (performance.now() - begin) / duration);
      const row = rows[Math.round(share * (rows.length - 1))];
      if (row) this.place(row);
      if (share === 1) break;
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    const { q } = this.services.store.get();
    if (q && turn === this.playing) this.place(q);
  }

  private place(q: number[]): void {
    this.shown?.view.show(q, this.shown.arm.forward(q), this.services.store.get().showFrames);
  }

  /** A goal for those who have not chosen one: each joint a third of the way to the farther limit. */
  private aside(q: number[], description: ArmDescription): number[] {
    const centre = middle(description);
    return q.map((value, k) => {
      const { lower, upper } = description.joints[k]?.limits ?? { lower: null, upper: null };
      const far = value > (centre[k] ?? 0) ? (lower ?? value - 1.5) : (upper ?? value + 1.5);
      return value + Math.sign(far - value) * Math.min(Math.abs(far - value) / 3, 0.7);
    });
  }
}

/** The joint values of a trajectory that the command has written. */
function rowsOf(arm: Arm, csv: string): number[][] {
  const motion = arm.trajectory("motion.csv", csv);
  const rows = motion.rows();
  motion.release();
  return rows;
}
