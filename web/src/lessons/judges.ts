import type { Arm } from "../core/arm.js";
import { namesFile } from "../core/files.js";
import { stepResponse } from "../core/step_response.js";
import { inWords } from "../core/words.js";
import {
  about,
  atLeast,
  checkAngle,
  checkAngles,
  checkConstantJacobian,
  checkCount,
  checkGain,
  checkLost,
  checkNumbers,
  checkReach,
  checkSameArm,
  checkString,
  type Verdict,
} from "./checks.js";
import { checkDrawing, type Part } from "./drawn_arm.js";
import type { Names } from "./formula.js";
import { checkFormulas, planarPose, rpJacobian, type Asked } from "./formula_checks.js";
import { armTyped } from "./typed_answer.js";

/** What judging takes from the page. */
export interface Bench {
  /** The arm of a joint string or a built-in name; it is released by whoever asks. */
  arm(text: string): Arm;
  random(): number;
}

/** The verdict on an answer: what was typed, or what parts() and the like write of a drawing, an arm or a gain. */
export type Judge = (answer: string, bench: Bench) => Verdict;

/** Formulas of an arm that are asked for; as an answer they stand with semicolons between them. */
export interface FormulaTask {
  /** Its name or joint string. */
  arm: string;
  names: Names;
  asked: Asked[];
  /** A formula that shows how one types; no answer. */
  example: string;
  /** The configuration in which the page shows it first; without it one that shows the arm well. */
  start?: number[];
}

const degree = Math.PI / 180;
export const rrrNames: Names = { joints: ["revolute", "revolute", "revolute"], lengths: [3.5, 3.5, 2] };
const rp = {
  arm: "rp",
  names: { joints: ["revolute", "prismatic"], lengths: [1] },
  example: "d2^2 - 3*cos(theta1)",
  start: [35 * degree, 1], // at d2 = 0 two frames coincide
} satisfies Partial<FormulaTask>;

export const formulaTasks: Record<string, FormulaTask> = {
  rp: { ...rp, asked: planarPose },
  "formula-rp": { ...rp, asked: planarPose },
  "rp-jacobian": { ...rp, asked: rpJacobian },
  "rrr-entry": { arm: "rrr", names: rrrNames, asked: planarPose.slice(1, 2), example: "2*cos(theta1) - L3" },
};

/** The target of the exercise `reach`, and the steps that `gain` allows. */
export const reachGoal = { x: 2, y: 6, degrees: 45 };
export const gainSteps = 10;

/** A drawing as an answer: R 0 0, P 1 0, tool 2 0. */
export const partsText = (parts: Part[]): string => parts.map(({ kind, x, y }) => `${kind} ${x} ${y}`).join(", ");

function partsOf(text: string): Part[] {
  const items = text.split(",").map((item) => item.trim().split(/\s+/));
  const isPart = ([kind = ""]: string[]): boolean => ["R", "P", "tool"].includes(kind);
  return items.filter(isPart).map(([kind, x, y]) => ({ kind: kind as Part["kind"], x: Number(x), y: Number(y) }));
}

/** Joint values as an answer, degrees: 34.05,97.33,-86.39. */
export const anglesText = (q: number[]): string => q.map((value) => Number((value / degree).toFixed(5))).join(",");
const anglesOf = (text: string): number[] => text.split(",").map((value) => Number(value) * degree);

/** Makes the arm of a text, judges with it, and releases it. */
function withArm({ arm }: Bench, text: string, judge: (made: Arm) => Verdict): Verdict {
  if (namesFile(text)) return { solved: false, says: `${inWords(text)} is no joint string and no name of an arm.` };
  try {
    const made = arm(text);
    try {
      return judge(made);
    } finally {
      made.release();
    }
  } catch (error) {
    return { solved: false, says: (error as Error).message };
  }
}

function formulas({ arm, names, asked }: FormulaTask): Judge {
  return (answer, bench) =>
    withArm(bench, arm, (made) => checkFormulas(answer.split(";"), asked, made, names, () => bench.random()));
}

const angle =
  (wanted: number, turn: number): Judge =>
  (answer) =>
    checkAngle(answer, wanted, turn, { joints: [] }, []);

function reached(answer: string, bench: Bench): Verdict {
  const q = anglesOf(answer);
  if (q.length !== 3 || !q.every(Number.isFinite)) return { solved: false, says: "That is no configuration of rrr." };
  return withArm(bench, "rrr", (made) => checkReach(made.forward(q).at(-1) ?? [], reachGoal));
}

function gain(answer: string, bench: Bench): Verdict {
  return withArm(bench, "rrr", (made) => {
    const response = stepResponse(made, { kp: Number(answer) }, [0, 0, 0], [1, 1, 1], 400);
    return checkGain(response, gainSteps);
  });
}

/** 30,0,20 → 60°: the configuration, and the direction that was typed. */
function singular(answer: string): Verdict {
  const [q = "", direction = ""] = answer.split("→");
  return checkLost(direction.trim(), q.trim() === "" ? null : anglesOf(q));
}

/** The number that is asked for, or the whole screw. */
function screw(answer: string): Verdict {
  const one = checkNumbers(answer, [-7], rrrNames);
  const whole = checkNumbers(answer, [1, 0, -7], rrrNames);
  return whole.solved ? whole : one;
}

/** The judges of the exercises by the names that the lessons use. */
export const judges: Record<string, Judge> = {
  ...Object.fromEntries(Object.entries(formulaTasks).map(([name, task]) => [name, formulas(task)])),
  string: (answer) => checkString(answer, "PPP"),
  describe: (answer, bench) =>
    withArm(bench, "RRP:2,1,0.5", (wanted) =>
      withArm(bench, armTyped(answer), (made) => checkSameArm(made, wanted, () => bench.random())),
    ),
  "constant-jacobian": (answer, bench) =>
    withArm(bench, armTyped(answer), (made) => checkConstantJacobian(made, () => bench.random())),
  "draw-rp": (answer) => checkDrawing(partsOf(answer)),
  reach: reached,
  gain,
  singular,
  ominus: angle(110, 0),
  steps: (answer) => checkCount(answer, 18, "step", atLeast),
  elbow: (answer) => checkAngles(answer, 90, 180, { joints: [] }, []),
  screw,
  "body-column": (answer) => checkNumbers(answer, [0, 2, 1], rrrNames, ["x", "y", "θ"]),
  wrist: angle(-30, 360),
  spare: (answer) => checkCount(answer, 7, "joint|dof|degrees? of freedom"),
  intervals: (answer) => checkCount(answer, 32, "interval", about),
};
