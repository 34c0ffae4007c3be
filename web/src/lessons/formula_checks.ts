import type { Arm } from "../core/arm.js";
import { headingOf } from "../core/pose.js";
import { shown } from "../elements/element.js";
import type { Verdict } from "./checks.js";
import { valueOf, type Expression } from "./expression.js";
import { readFormula, type Names } from "./formula.js";

/** A quantity of an arm that a formula is asked for. Angles that differ by whole turns are equal. */
export interface Asked {
  /** As it stands before the field: x, θ. */
  name: string;
  kind: "length" | "angle";
  of(arm: Arm, q: number[]): number;
}

const toolOf = (arm: Arm, q: number[]): Float64Array => arm.forward(q).at(-1) as Float64Array;

/** The pose of the tool of a planar arm. */
export const planarPose: Asked[] = [
  { name: "x", kind: "length", of: (arm, q) => toolOf(arm, q)[12] ?? NaN },
  { name: "y", kind: "length", of: (arm, q) => toolOf(arm, q)[13] ?? NaN },
  { name: "θ", kind: "angle", of: (arm, q) => headingOf(toolOf(arm, q)) },
];

/** The first two rows of the Jacobian of the arm RP, entry by entry. */
export const rpJacobian: Asked[] = (["x", "y"] as const).flatMap((row, i) =>
  ["θ1", "d2"].map((joint, k) => ({
    name: `∂${row}/∂${joint}`,
    kind: "length",
    of: (arm: Arm, q: number[]) => arm.jacobian(q)[6 * k + i] ?? NaN,
  })),
);

const close = 1e-9;
const trials = 20;
const degree = Math.PI / 180;
/** Joint values that are easy to work out by hand, degrees and m; then random ones. */
const easy = { revolute: [30, 60, -45, 120, 0], prismatic: [0.5, 1, 2, 0.2, 0] };

/** Configurations at which formulas are compared. */
function configurations({ joints }: Names, random: () => number): number[][] {
  const round = easy.revolute.map((_, i) =>
    joints.map((kind, k) => {
      const value = easy[kind][(i + 2 * k) % easy[kind].length] ?? 0;
      return kind === "revolute" ? value * degree : value;
    }),
  );
  const others = Array.from({ length: trials }, () =>
    joints.map((kind) => (kind === "revolute" ? 6 * random() - 3 : 2 * random())),
  );
  return [...round, ...others];
}

/** The difference of a formula from what is asked, of which an angle is taken in [-π, π]. */
function difference({ kind }: Asked, value: number, wanted: number): number {
  const off = value - wanted;
  return kind === "angle" ? Math.atan2(Math.sin(off), Math.cos(off)) : off;
}

/** Whether typed formulas, one for each quantity, are right at all configurations. If not, the verdict names what
 * differs, where, and both values. */
export function checkFormulas(texts: string[], asked: Asked[], arm: Arm, names: Names, random: () => number): Verdict {
  const missing = asked.filter((_, i) => (texts[i] ?? "").trim() === "").map(({ name }) => name);
  if (missing.length > 0) return { solved: false, says: `Type a formula for ${listed(missing)} too.` };
  const formulas: Expression[] = [];
  for (const [i, { name }] of asked.entries()) {
    try {
      formulas.push(readFormula(texts[i] ?? "", names));
    } catch (error) {
      return { solved: false, says: `${name} cannot be read: ${(error as Error).message}.` };
    }
  }
  const all = configurations(names, random);
  for (const q of all) {
    const wrong = asked.flatMap((one, i) => {
      const [value, wanted] = [valueOf(formulas[i] as Expression, q), one.of(arm, q)];
      return Math.abs(difference(one, value, wanted)) < close ? [] : [{ one, value, wanted }];
    });
    if (wrong.length === 0) continue;
    const values = wrong.map(({ one, value, wanted }) => `${one.name} ${compared(one, value, wanted)}`).join("; ");
    const verb = wrong.length === 1 ? "differs" : "differ";
    const says = `Not yet: ${listed(wrong.map(({ one }) => one.name))} ${verb}. At ${place(q, names)}: ${values}.`;
    const hint = mistake(asked, formulas, arm, all);
    return { solved: false, says: hint === "" ? says : `${says} ${hint}`, at: q };
  }
  const count = asked.length === 1 ? "it agrees" : asked.length === 2 ? "both agree" : `all ${asked.length} agree`;
  return { solved: true, says: `Right: ${count} with the arm at ${all.length} configurations.` };
}

/** What the formula gives and what the arm has, with as many digits as show that they differ. */
function compared({ kind }: Asked, value: number, wanted: number): string {
  if (!Number.isFinite(value)) return "has no value by your formula there";
  for (let digits = 2; ; ++digits) {
    const text = (of: number): string => (kind === "angle" ? `${shown(of / degree, digits - 1)}°` : shown(of, digits));
    if (text(value) !== text(wanted) || digits > 8)
      return `is ${text(value)} by your formula, and ${text(wanted)} on the arm`;
  }
}

/** Joint values as the chapter writes them: θ1 = 30°, d2 = 0.50 m. */
function place(q: number[], { joints }: Names): string {
  const round = (value: number): string => shown(value, Math.abs(value - Math.round(value)) < 1e-6 ? 0 : 2);
  return joints
    .map((kind, k) => {
      const value = q[k] ?? 0;
      return kind === "revolute" ? `θ${k + 1} = ${round(value / degree)}°` : `d${k + 1} = ${round(value)} m`;
    })
    .join(", ");
}

/** What would make the formulas right everywhere: two of them exchanged, or another sign; empty where that is not so. */
function mistake(asked: Asked[], formulas: Expression[], arm: Arm, all: number[][]): string {
  const fits = (i: number, j: number, sign: number): boolean =>
    all.every((q) => {
      const one = asked[i] as Asked;
      return Math.abs(difference(one, sign * valueOf(formulas[j] as Expression, q), one.of(arm, q))) < close;
    });
  for (const [i, { name }] of asked.entries()) {
    if (fits(i, i, 1)) continue;
    if (fits(i, i, -1)) return `${name} has the wrong sign.`;
    const other = asked.findIndex((_, j) => j !== i && !fits(j, j, 1) && fits(i, j, 1) && fits(j, i, 1));
    if (other >= 0) return `${name} and ${asked[other]?.name ?? ""} are exchanged.`;
  }
  return "";
}

function listed(names: string[]): string {
  return names.length < 2 ? (names[0] ?? "") : `${names.slice(0, -1).join(", ")} and ${names.at(-1) ?? ""}`;
}
