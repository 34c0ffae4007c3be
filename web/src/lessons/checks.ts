import type { Arm } from "../core/arm.js";
import type { StepResponse } from "../core/step_response.js";
import { shown } from "../elements/element.js";
import { valueOf } from "./expression.js";
import { readFormula, type Names } from "./formula.js";
import { withoutEnd } from "./formula_tokens.js";

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

/** The joint string or name that somebody has typed: pp, P-P, a gantry, rrr 3.5 3.5 2. */
export function armTyped(text: string): string {
  const plain = withoutEnd(text)
    .trim()
    .replace(/^(?:an?|the)\s+/i, "");
  const [, joints, lengths = ""] = /^([rpsche][rpsche\s,–-]*?)[\s:(]+([\d.][\d\s.,;]*)\)?$/i.exec(plain) ?? [];
  if (joints !== undefined)
    return `${joints.replace(/[\s,–-]+/g, "").toUpperCase()}:${lengths
      .trim()
      .split(/[\s,;]+/)
      .join(",")}`;
  if (/^(?:gantry|cartesian)\b/i.test(plain)) return "gantry";
  const letters = plain
    .replace(/prismatic/gi, "P")
    .replace(/revolute/gi, "R")
    .replace(/[\s,;–-]+/g, "");
  return /^[rpsche]+$/i.test(letters) && !/^(?:rp|rrr)$/.test(plain) ? letters.toUpperCase() : plain;
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
  const typed = /^gantry$/i.test(text.trim()) ? text : armTyped(text).toUpperCase();
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

/** An angle that was typed, degrees: a number is in degrees; with rad, π or the name of a joint in radians. */
export function angleTyped(text: string, names: Names, q: number[]): number {
  const formula = readFormula(withoutEnd(text).replace(/(?<=[\d)πi\s])rad(?:ians?)?\s*$/i, ""), names);
  const isNumber = /^[^a-zα-ωπ°]*$/i.test(text.slice(text.lastIndexOf("=") + 1));
  return valueOf(formula, q) * (isNumber ? 1 : 180 / Math.PI);
}

/** Whether a typed angle is the wanted one, degrees, up to a multiple of `turn`, unless that is 0. */
export function checkAngle(text: string, wanted: number, turn: number, names: Names, q: number[], off = 0.5): Verdict {
  if (text.trim() === "") return { solved: false, says: "Type an angle, such as 30 or 30°." };
  try {
    const typed = angleTyped(text, names, q);
    const away = typed - wanted;
    const solved = Math.abs(turn === 0 ? away : away - turn * Math.round(away / turn)) <= off;
    return { solved, says: solved ? "Right." : `Not yet: it is not ${shown(typed, 1).replace(".0", "")}°.` };
  } catch (error) {
    return { solved: false, says: `The angle cannot be read: ${(error as Error).message}.` };
  }
}

const nearSingular = 3; // degrees of θ2 from 0 or 180

/** The direction of the links, in words. */
const links = "(?:line of )?(?:(?:(?:first )?two |first )?links?(?: 1(?: and 2)?)?|arm)";
const base = "(?:base|origin|joint 1)";
const alongLinks = new RegExp(
  `^(?:along ${links}|(?:in )?radial direction|radial(?:ly)?|(?:towards?|away from|(?:to|towards?) (?:and|or) away from) ${base})$`,
);

/** Whether words name the direction of the first two links. */
function isAlongLinks(text: string): boolean {
  const plain = withoutEnd(text)
    .toLowerCase()
    .replace(/\bthe\b/g, " ")
    .replace(/\s+/g, " ");
  return alongLinks.test(plain.trim());
}

/** Whether the arm rrr is singular at q, and a typed direction, degrees, is the one in which joint 3 cannot move there. q is
 * null where another arm is shown. */
export function checkLost(text: string, q: number[] | null): Verdict {
  if (!q) return { solved: false, says: "This is asked of the arm rrr: press “Show the lesson’s arm” first." };
  const bend = ((q[1] ?? NaN) * 180) / Math.PI;
  const off = Math.abs(bend - 180 * Math.round(bend / 180));
  if (!(off <= nearSingular))
    return { solved: false, says: `The arm is not singular: θ2 is ${shown(off, 0)}° away from where it would be.` };
  if (isAlongLinks(text)) return { solved: true, says: "Right: along the line of the first two links." };
  const names: Names = { joints: ["revolute", "revolute", "revolute"] };
  const verdict = checkAngle(text, ((q[0] ?? 0) * 180) / Math.PI, 180, names, q, nearSingular);
  return verdict.solved ? { solved: true, says: "Right: along the line of the first two links, θ1." } : verdict;
}

/** Whether typed numbers, with commas, semicolons or blanks between them, are the wanted ones. */
export function checkNumbers(text: string, wanted: number[], names: Names): Verdict {
  const typed = withoutEnd(text.slice(text.lastIndexOf("=") + 1)).replace(/\s*(?:m|rad)\s*\/\s*s\b/g, "");
  const items = wanted.length === 1 ? [typed] : itemsOf(typed);
  if (typed.trim() === "" || items.length !== wanted.length)
    return { solved: false, says: `Type ${wanted.length === 1 ? "a number" : `${wanted.length} numbers`}.` };
  try {
    const values = items.map((item) => valueOf(readFormula(item, names), []));
    const off = values.findIndex((value, i) => !(Math.abs(value - (wanted[i] ?? NaN)) < 1e-6));
    if (off < 0) return { solved: true, says: "Right." };
    const place = wanted.length === 1 ? "it" : `number ${off + 1}`;
    return { solved: false, says: `Not yet: ${place} is not ${shown(values[off] ?? NaN, 2).replace(/\.00$/, "")}.` };
  } catch (error) {
    return { solved: false, says: `That cannot be read: ${(error as Error).message}.` };
  }
}

/** The numbers of a row or a column: (0, 2, 1), [0; 2; 1]^T, 0 2 1; with decimal commas where semicolons or blanks stand
 * between them. */
function itemsOf(typed: string): string[] {
  const inner = typed.replace(/\^?\s*T\s*$/, "").replace(/^[\s([{]+|[\s)\]}]+$/g, "");
  const items = inner.split(/\s*[;|]\s*|\s*,\s+|\s+/);
  return items.length === 1 ? inner.split(",") : items;
}

const words =
  "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen nineteen".split(
    " ",
  );
const tens = ["twenty", "thirty", "forty"];

/** The number that words below fifty name, thirty-two; -1: none. */
function counted(text: string): number {
  const below = words.indexOf(text);
  if (below >= 0) return below;
  const [ten = "", one = "zero", ...others] = text.split(/[\s-]+/);
  const [high, low] = [tens.indexOf(ten), words.indexOf(one)];
  return high < 0 || low < 0 || low > 9 || others.length > 0 ? -1 : 20 + 10 * high + low;
}

/** Whether a typed count of things is the wanted one: 7, 7 joints, seven, after 18 steps. */
export function checkCount(text: string, wanted: number, thing: string): Verdict {
  const typed = withoutEnd(text)
    .trim()
    .toLowerCase()
    .replace(/^after\s+/, "")
    .replace(new RegExp(`\\s*${thing}s?$`), "");
  const count = counted(typed);
  return checkNumbers(count < 0 ? typed : String(count), [wanted], { joints: [] });
}

/** Whether an arm is the wanted one: its links have the same poses in random configurations. */
export function checkSameArm(arm: Arm, wanted: Arm, random: () => number): Verdict {
  const no = (says: string): Verdict => ({ solved: false, says: `Not yet: ${says}` });
  if (arm.dof !== wanted.dof) return no(`that arm has ${arm.dof} joints, and the wanted one ${wanted.dof}.`);
  const rest = new Array<number>(arm.dof).fill(0);
  const kinds = (one: Arm): string[] => one.skeleton(rest).joints.map(({ kind }) => kind);
  const other = kinds(arm).findIndex((kind, k) => kind !== kinds(wanted)[k]);
  if (other >= 0) return no(`joint ${other + 1} is ${kinds(arm)[other] ?? ""} there.`);
  const ends = [rest, ...Array.from({ length: trials }, () => rest.map(() => 2 * random() - 1))];
  for (const q of ends) {
    const [here, there] = [arm.forward(q), wanted.forward(q)];
    for (const [k, pose] of here.entries()) {
      const off = pose.some((value, i) => Math.abs(value - (there[k]?.[i] ?? NaN)) > close);
      if (off && k < wanted.dof) return no(`link ${k} does not end where it should.`);
      if (off) return no("the tool is not where it should be.");
    }
  }
  return { solved: true, says: "Right: it is the same arm in all configurations." };
}
