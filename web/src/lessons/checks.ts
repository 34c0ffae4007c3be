import type { Arm } from "../core/arm.js";
import type { StepResponse } from "../core/step_response.js";
import { shown } from "../elements/element.js";
import { valueOf } from "./expression.js";
import { readFormula, type Names } from "./formula.js";
import {
  angleTyped,
  anglesTyped,
  armTyped,
  line,
  numberInWords,
  numbersBeforeSign,
  numbersTyped,
} from "./typed_answer.js";

/** What a check answers: whether the exercise is solved, and a sentence; `at`: the joint values that it speaks of. */
export interface Verdict {
  solved: boolean;
  says: string;
  at?: number[];
}

/** Whether a gain of joint-space control is quick, without overshoot. */
export function checkGain({ settled, overshoot }: StepResponse, most: number): Verdict {
  if (overshoot > 1e-9)
    return { solved: false, says: `Not yet: the joints overshoot by ${(100 * overshoot).toFixed(0)} %.` };
  if (settled === null || settled > most)
    return { solved: false, says: `Not yet: ${settled === null ? "far too many" : settled} steps are needed.` };
  return { solved: true, says: `Right: ${settled} steps, and no overshoot.` };
}

const trials = 20;
const close = 1e-9;

/** Whether the tool is at a place, with an angle, in the plane. */
export function checkReach(pose: ArrayLike<number>, goal: { x: number; y: number; degrees: number }): Verdict {
  const [x = 0, y = 0] = [pose[12], pose[13]];
  const angle = Math.atan2(pose[1] ?? 0, pose[0] ?? 1) - (goal.degrees * Math.PI) / 180;
  const turn = Math.abs(Math.atan2(Math.sin(angle), Math.cos(angle))) * (180 / Math.PI);
  const away = Math.hypot(x - goal.x, y - goal.y);
  if (away <= 0.1 && turn <= 3) return { solved: true, says: "Right: the tool is there." };
  return { solved: false, says: `The tool is ${away.toFixed(2)} m and ${turn.toFixed(0)}° away.` };
}

/** Whether the Jacobian of an arm is the same at all configurations: compared at random ones. */
export function checkConstantJacobian(arm: Arm, random: () => number): Verdict {
  const at = (): number[] => Array.from({ length: arm.dof }, () => 2 * random() - 1);
  const first = arm.jacobian(at());
  for (let trial = 0; trial < trials; ++trial) {
    const other = arm.jacobian(at());
    const changed = first.findIndex((value, i) => Math.abs(value - (other[i] as number)) >= close);
    if (changed < 0) continue;
    const says = `Not yet: the column of its joint ${Math.floor(changed / 6) + 1} changes with the configuration.`;
    return { solved: false, says };
  }
  return { solved: true, says: "Right: its Jacobian is the same everywhere. Which joints does it have, and why?" };
}

/** Whether a string of joints is the wanted one. */
export function checkString(text: string, wanted: string): Verdict {
  const typed = armTyped(text).toUpperCase();
  if (typed === wanted) return { solved: true, says: `Right: ${wanted}.` };
  if (!/^[A-Z]+$/.test(typed) || /[^RPSCHE]/.test(typed))
    return { solved: false, says: "Type a letter for each joint, from base to tool, such as RRR." };
  if (typed.length !== wanted.length)
    return {
      solved: false,
      says: `Not yet: that has ${typed.length} letters, and the arm has ${wanted.length} joints.`,
    };
  const k = [...typed].findIndex((letter, i) => letter !== wanted[i]);
  return { solved: false, says: `Not yet: look at joint ${k + 1} again.` };
}

const sameAngle = 0.05; // degrees: 1.92 rad are 110.008°, 1.57 rad are 89.954°

/** An angle that is asked for, degrees, up to a multiple of `turn`, unless that is 0; and what a typed formula may name. */
type AskedAngle = [wanted: number, turn: number, names: Names, q: number[], tolerance?: number];

/** Whether a typed angle is the one that is asked for. */
export function checkAngle(text: string, ...[wanted, turn, names, q, tolerance = sameAngle]: AskedAngle): Verdict {
  if (text.trim() === "") return { solved: false, says: "Type an angle, such as 30 or 30°." };
  try {
    const isRight = (typed: number): boolean => {
      const away = typed - wanted;
      return Math.abs(turn === 0 ? away : away - turn * Math.round(away / turn)) <= tolerance;
    };
    const typed = [...numbersBeforeSign(text), text].map((one) => angleTyped(one, names, q));
    const wrong = typed.find((one) => !isRight(one));
    if (wrong === undefined) return { solved: true, says: "Right." };
    return { solved: false, says: `Not yet: it is not ${shown(wrong, 1).replace(".0", "")}°.` };
  } catch (error) {
    return { solved: false, says: `The angle cannot be read: ${(error as Error).message}.` };
  }
}

/** The same for one angle or several, such as ±90 or 30 or 210, of which each must be right. */
export function checkAngles(text: string, ...asked: AskedAngle): Verdict {
  const whole = checkAngle(text, ...asked);
  const parts = anglesTyped(text);
  if (whole.solved || parts.length < 2) return whole;
  const verdicts = parts.map((part) => checkAngle(part, ...asked));
  return verdicts.find(({ solved }) => !solved) ?? { solved: true, says: "Right." };
}

const nearSingular = 3; // degrees of θ2 from 0 or 180

/** The direction of the links, in words. */
const links = "(?:line of )?(?:(?:(?:both|first|second|(?:first )?two) )?links?|links? (?:1|2|1 and 2)|arm)";
const base = "(?:base|origin|joint 1)";
const alongLinks = new RegExp(`^(?:along|parallel to|in line with|in (?:line and )?direction of) ${links}$`);
/** Directions that there are only where joint 3 is away from the base. */
const radial = new RegExp(
  `^(?:(?:in )?radial direction|radial(?:ly)?|(?:towards?|away from|(?:to|towards?) (?:and|or) away from) ${base})$`,
);
/** A direction of the frame. */
const alongAxis = /^(?:(?:along|in|parallel to) )?([xy])(?:[ -](?:axis|direction))?$/;

/** Whether the arm rrr is singular at q, and a typed direction, degrees, is the one in which joint 3 cannot move there. q is
 * null where another arm is shown. */
export function checkLost(text: string, q: number[] | null): Verdict {
  if (!q) return { solved: false, says: "This is asked of the arm rrr: press “Show the lesson’s arm” first." };
  const bend = ((q[1] ?? NaN) * 180) / Math.PI;
  const away = Math.abs(bend - 180 * Math.round(bend / 180));
  if (!(away <= nearSingular))
    return { solved: false, says: `The arm is not singular: θ2 is ${shown(away, 0)}° away from where it would be.` };
  const words = line(text.toLowerCase().replace(/\bthe\b/g, " "));
  if (alongLinks.test(words)) return { solved: true, says: "Right: along the line of the first two links." };
  if (radial.test(words)) {
    if (Math.cos(q[1] ?? NaN) > 0) return { solved: true, says: "Right: along the line of the first two links." };
    return { solved: false, says: "Not yet: the arm is folded, and joint 3 is at the base. Which line is left?" };
  }
  const names: Names = { joints: ["revolute", "revolute", "revolute"] };
  const [, axis] = alongAxis.exec(words) ?? [];
  const typed = axis === undefined ? text : axis === "x" ? "0°" : "90°";
  const verdict = checkAngles(typed, ((q[0] ?? 0) * 180) / Math.PI, 180, names, q, nearSingular);
  return verdict.solved ? { solved: true, says: "Right: along the line of the first two links, θ1." } : verdict;
}

/** Whether typed numbers, with commas, semicolons or blanks between them, are the wanted ones. `labels`: what may stand
 * before them, x = 0, y = 2. */
export function checkNumbers(text: string, wanted: number[], names: Names, labels: string[] = []): Verdict {
  const typed = line(text).replace(/ ?(?:m|rad) ?\/ ?s\b/g, "");
  const count = wanted.length === 1 ? "a number" : `${wanted.length} numbers`;
  try {
    const items = wanted.length === 1 ? [typed] : numbersTyped(typed, labels);
    const others = numbersBeforeSign(typed);
    if (wanted.length > 1 && others.length > 0) return { solved: false, says: `Type ${count}.` };
    if (typed === "" || items.length !== wanted.length) return { solved: false, says: `Type ${count}.` };
    const values = [...items, ...others].map((item) => valueOf(readFormula(item, names), []));
    const wrong = values.findIndex((value, i) => !(Math.abs(value - (wanted[i] ?? wanted[0] ?? NaN)) < 1e-6));
    if (wrong < 0) return { solved: true, says: "Right." };
    const place = wanted.length === 1 ? "it" : `number ${wrong + 1}`;
    return { solved: false, says: `Not yet: ${place} is not ${shown(values[wrong] ?? NaN, 2).replace(/\.00$/, "")}.` };
  } catch (error) {
    return { solved: false, says: `That cannot be read: ${(error as Error).message}.` };
  }
}

/** What may stand before a count that is asked for "about", and before a smallest one. */
export const about = "about|approx(?:imately|\\.)?|roughly|around|circa|ca\\.?|~|≈";
export const atLeast = "after|at least|≥|>=";

/** Whether a typed count of things is the wanted one: 7, 7 joints, seven; with words before it, about 32, after 18 steps.
 * `thing` and `before` are patterns. */
export function checkCount(text: string, wanted: number, thing: string, before = "after"): Verdict {
  const typed = line(text.toLowerCase())
    .replace(new RegExp(`^n (?=${before}|=)`), "")
    .replace(new RegExp(`^(?:(?:${before}) ?)+`), "")
    .replace(new RegExp(`[ -]?(?:${thing})s?$`), "");
  const count = numberInWords(typed);
  return checkNumbers(count < 0 ? typed : String(count), [wanted], { joints: [] });
}

/** Whether an arm is the wanted one: its links have the same poses in random configurations. */
export function checkSameArm(arm: Arm, wanted: Arm, random: () => number): Verdict {
  const no = (says: string): Verdict => ({ solved: false, says: `Not yet: ${says}` });
  if (arm.dof !== wanted.dof) return no(`that arm has ${arm.dof} joints, and the wanted one ${wanted.dof}.`);
  const zero = new Array<number>(arm.dof).fill(0);
  const kinds = (one: Arm): string[] => one.skeleton(zero).joints.map(({ kind }) => kind);
  const other = kinds(arm).findIndex((kind, k) => kind !== kinds(wanted)[k]);
  if (other >= 0) return no(`joint ${other + 1} is ${kinds(arm)[other] ?? ""} there.`);
  const configurations = [zero, ...Array.from({ length: trials }, () => zero.map(() => 2 * random() - 1))];
  for (const q of configurations) {
    const [here, there] = [arm.forward(q), wanted.forward(q)];
    for (const [k, pose] of here.entries()) {
      const isSame = !pose.some((value, i) => Math.abs(value - (there[k]?.[i] ?? NaN)) > close);
      if (!isSame && k < wanted.dof) return no(`link ${k} does not end where it should.`);
      if (!isSame) return no("the tool is not where it should be.");
    }
  }
  return { solved: true, says: "Right: it is the same arm in all configurations." };
}
