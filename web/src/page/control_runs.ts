import { cartesianRows, outside } from "../core/cartesian.js";
import { answer } from "../core/command.js";
import { clamped } from "../core/nearest.js";
import { poseError, posesFile, sevenOf, toolPose, toolPosition } from "../core/pose.js";
import { divergence, isProportional, settledAfter, stepResponse, type StepResponse } from "../core/step_response.js";
import { Cancelled, type Gains } from "../core/types.js";
import { element, shown as text } from "../elements/element.js";
import { clauseOf, type Reason, type Wording } from "../panels/reasons/reasons.js";
import type { Trail } from "../scene/picture.js";
import { Rest } from "./rest.js";
import type { Services, Shown } from "./section.js";

/** What is controlled: the joints, eq. 1.3, or the tool, eq. 1.6. */
export type ControlKind = "joint" | "cartesian";

/** What a controller is called: joint-space control with further gains is no longer eq. 1.3. */
function titleOf(kind: ControlKind, gains: Gains): string {
  if (kind === "cartesian") return "Cartesian space, eq. 1.6";
  return isProportional(gains) ? "Joint space, eq. 1.3" : "Joint space, PID";
}

/** What `beeline move` and `beeline line --method inverse-jacobian` print. */
interface Outcome extends Reason {
  status: string;
  steps?: number;
  overshoot?: number;
}

/** From where to where, and how. */
export interface ControlTask {
  from: number[];
  goal: number[];
  gains: Required<Gains>;
}

const responseSteps = 400;
const maxSteps = 2000; // of a controller that crawls
const drawnUntil = 1e-3; // relative to the first errors: the drawn steps end below it
const noError = 1e-6; // m and rad: smaller errors count as zero

/** Both controllers to one goal: their trails and step response at once, in the core; the outcome in the words
 * of the command, once the gains rest. */
export class ControlRuns {
  readonly root = element("ul", { class: "runs", "aria-live": "polite" });
  response: StepResponse | null = null;
  private readonly lines: Map<ControlKind, HTMLElement>;
  private readonly rest = new Rest();
  private rows = new Map<ControlKind, number[][]>();
  private turn = 0;
  /** The task whose outcome the lines say. */
  private confirmed = "";

  constructor(
    private readonly services: Services,
    private readonly kinds: ControlKind[],
  ) {
    this.lines = new Map(kinds.map((kind) => [kind, element("span", {})]));
    for (const [kind, line] of this.lines)
      this.root.append(element("li", {}, element("span", { class: `swatch ${kind}`, "aria-hidden": "true" }), line));
  }

  /** The joint values of a controller, a row a step, within the limits. */
  rowsOf(kind: ControlKind): number[][] {
    return this.rows.get(kind) ?? [];
  }

  /** Forgets what is asked of the command. */
  stop(): void {
    ++this.turn;
    this.rest.cancel();
  }

  /** There is no motion: nothing is said of one. */
  clear(): void {
    this.stop();
    this.confirmed = "";
    for (const line of this.lines.values()) line.textContent = "";
    this.root.hidden = true;
  }

  /** Computes both motions and returns their trails. Throws where the core refuses the gains. */
  update(shown: Shown, task: ControlTask): Trail[] {
    this.stop();
    const { turn } = this;
    this.root.hidden = false;
    this.rows.clear();
    this.response = stepResponse(shown.arm, task.gains, task.from, task.goal, responseSteps);
    for (const kind of this.kinds) {
      const rows = kind === "joint" ? jointRows(this.response, shown) : toolRows(this.response, shown, task);
      this.rows.set(kind, rows);
    }
    const key = JSON.stringify([shown.description.name, task]);
    if (key !== this.confirmed) {
      for (const [kind, rows] of this.rows) this.say(kind, this.early(kind, rows, shown, task));
      this.rest.then(
        () => void this.confirm(turn, shown, task).then(() => turn === this.turn && (this.confirmed = key)),
      );
    }
    return [...this.rows].map(([tone, rows]) => ({
      tone,
      points: rows.map((q) => toolPosition(shown.arm, q)),
      dots: true,
    }));
  }

  private say(kind: ControlKind, words: string): void {
    const line = this.lines.get(kind);
    if (line && line.textContent !== words) line.textContent = words;
  }

  /** What is known before the command has answered: one criterion for both. */
  private early(kind: ControlKind, rows: number[][], shown: Shown, task: ControlTask): string {
    const { diverged = null } = this.response ?? {};
    const title = titleOf(kind, task.gains);
    const left = kind === "joint" ? leaving(this.response, shown) : null;
    const grows =
      diverged !== null && kind === "joint"
        ? `beyond ${divergence} times the first error after ${diverged} steps`
        : null;
    if (left !== null || grows !== null) return `${title}: ${[left, grows].filter((one) => one !== null).join("; ")}`;
    const after = this.settled(kind, rows, shown, task);
    if (after !== null) return `${title}: error below 2 % after ${after} steps`;
    return diverged === null || task.gains.kp < 2 ? `${title}:` : `${title}: ${rows.length - 1} steps are drawn`;
  }

  /** The steps after which the errors stay below 2 % of the first ones; null: they do not. */
  private settled(kind: ControlKind, rows: number[][], shown: Shown, task: ControlTask): number | null {
    return kind === "joint" ? (this.response?.settled ?? null) : settledTool(rows, shown, task);
  }

  private async confirm(turn: number, shown: Shown, task: ControlTask): Promise<void> {
    for (const kind of this.kinds) {
      if (turn !== this.turn) return;
      const title = titleOf(kind, task.gains);
      const early = this.early(kind, this.rowsOf(kind), shown, task);
      try {
        const outcome = await this.outcome(kind, shown, task);
        if (turn !== this.turn) return;
        const response = kind === "joint" ? this.response : null;
        this.say(kind, inWords(title, early, outcome, response, this.wordingOf(kind, shown)));
      } catch (error) {
        if (turn === this.turn && !(error instanceof Cancelled))
          this.say(kind, `${title}: ${(error as Error).message}`);
      }
    }
  }

  private wordingOf(kind: ControlKind, { arm, description }: Shown): Wording {
    const wording = { degrees: this.services.store.get().degrees, planar: arm.planar };
    const [first, ...others] = new Set(description.joints.map(({ type }) => type === "prismatic"));
    if (kind === "cartesian" || first === undefined || others.length > 0) return wording;
    return { ...wording, error: first ? "length" : "angle" };
  }

  private async outcome(kind: ControlKind, { arm }: Shown, { from, goal, gains }: ControlTask): Promise<Outcome> {
    const common = [`--gain=${gains.kp}`, `--max-steps=${maxSteps}`, "--json"];
    const start = `--from=${from.join(",")}`;
    const files = { "goal.csv": posesFile([sevenOf(toolPose(arm, goal))]) };
    const args =
      kind === "joint"
        ? ["move", "arm.json", start, `--to=${goal.join(",")}`, `--ki=${gains.ki}`, `--kd=${gains.kd}`]
        : ["line", "arm.json", start, "--through=goal.csv", "--method=inverse-jacobian"];
    return answer<Outcome>(await this.services.command([...args, ...common], kind === "joint" ? {} : files));
  }
}

/** The outcome of the command behind what was known before. `response`: of the joints, where these are controlled. */
function inWords(
  title: string,
  early: string,
  outcome: Outcome,
  response: StepResponse | null,
  wording: Wording,
): string {
  const { status, steps = 0, overshoot = 0 } = outcome;
  const over = overshoot > 1e-3 ? `, overshoot ${text(100 * overshoot, 1)} %` : "";
  if (status === "reached") {
    if (steps === 0) return `${title}: the arm is at the goal.`;
    return early.endsWith(":")
      ? `${early} ${status} after ${steps} steps${over}.`
      : `${early}, and the goal is reached${over}.`;
  }
  if (response?.diverged != null) return `${early}.`; // the chart says why
  return `${early}${early.endsWith(":") ? " " : "; "}${clauseOf(outcome, wording) || `${status} after ${steps} steps`}.`;
}

/** Which joint would leave its limits, and when; null: none does. */
function leaving(response: StepResponse | null, { description }: Shown): string | null {
  const step = response?.rows.findIndex((row) => outside(row, description.joints)) ?? -1;
  if (step < 0) return null;
  const row = response?.rows[step] ?? [];
  const k = description.joints.findIndex((joint, i) => outside([row[i] ?? 0], [joint]));
  return `${description.joints[k]?.name ?? ""} leaves its limits after ${step} ${step === 1 ? "step" : "steps"}`;
}

/** The rows of the joints, within their limits, until the largest error is at most 0.1 % of the largest first error, or the
 * errors have grown too far. */
function jointRows({ rows, errors, diverged }: StepResponse, { description }: Shown): number[][] {
  const first = Math.max(...errors.map((values) => Math.abs(values[0] ?? 0)));
  const error = (t: number): number => Math.max(...errors.map((values) => Math.abs(values[t] ?? 0)));
  const end = rows.findLastIndex((_, t) => error(t) > drawnUntil * first) + 2;
  return rows.slice(0, diverged === null ? end : diverged + 1).map((row) => clamped(row, description.joints));
}

/** The errors of the tool's position and of its orientation in each row, relative to those in the first one; without what
 * is right from the start. */
function toolErrors(rows: number[][], { arm }: Shown, { goal }: ControlTask): number[][] {
  const pose = toolPose(arm, goal);
  const errors = rows.map((q) => poseError(toolPose(arm, q), pose));
  const sizes = [0, 3].map((from) => errors.map((row) => Math.hypot(...row.slice(from, from + 3))));
  return sizes.flatMap((all) => {
    const [first = 0] = all;
    return first > noError ? [all.map((size) => size / first)] : [];
  });
}

/** The rows of Cartesian control until the tool's errors in position and in orientation are each at most 0.1 % of their
 * first value. If the gain is too large: as many steps as of the joints from where the tool first moves away from the goal. */
function toolRows({ diverged }: StepResponse, shown: Shown, task: ControlTask): number[][] {
  const { arm, description } = shown;
  const { from, goal, gains } = task;
  const pose = Array.from(toolPose(arm, goal));
  // A first error that counts is above noError, so the rows do not end before 0.1 % of it is left.
  const options = { gain: gains.kp, tolerance: drawnUntil * noError, maxSteps: responseSteps };
  const rows = [from, ...cartesianRows(arm, description.joints, from, [pose], options)];
  if (gains.kp >= 2 && diverged !== null) {
    const errors = rows.map((q) => Math.hypot(...poseError(toolPose(arm, q), pose)));
    const turn = errors.findIndex((error, t) => (errors[t + 1] ?? 0) > error);
    return turn < 0 ? rows : rows.slice(0, turn + diverged + 1);
  }
  const relative = toolErrors(rows, shown, task);
  return rows.slice(0, rows.findLastIndex((_, t) => relative.some((values) => (values[t] ?? 0) > drawnUntil)) + 2);
}

/** The steps after which the tool's errors in position and in orientation stay below 2 % of the first ones. */
function settledTool(rows: number[][], shown: Shown, task: ControlTask): number | null {
  return settledAfter(toolErrors(rows, shown, task), rows.length - 1);
}
