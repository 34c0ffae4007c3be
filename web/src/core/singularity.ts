import type { Arm } from "./arm.js";
import { eigen } from "./symmetric_eigen.js";

const rounding = 1e-12; // of the largest singular value: a smaller one is 0
const near = 0.02; // of the largest singular value
const apart = 1e-4; // of the largest singular value: a larger second one leaves the vector of the smallest exact

/** A direction of the tool's velocity: a unit vector of the linear and of the angular velocity, in base axes; null where
 * it has no such part. */
export interface LostDirection {
  linear: number[] | null;
  angular: number[] | null;
}

/** What a singular configuration takes from the tool's velocity. */
export interface Singularity {
  /** "at": the smallest singular value of the Jacobian is 0 to rounding. */
  is: "at" | "near" | "far";
  /** The dimension of the space of the tool's velocities, and of the same space away from singularities. */
  rank: number;
  full: number;
  /** The one direction that is lost, or nearly lost: the left singular vector of the smallest singular value. null where
   * it is not the only one, or where the arm never moves its tool in all directions. */
  lost: LostDirection | null;
}

/** Judges a configuration by the singular values of the Jacobian of the tool: a planar arm's x, y and angle, or all six. */
export function singularity(arm: Arm, q: ArrayLike<number>): Singularity {
  const { singularValues } = arm.manipulability(q);
  const rows = arm.planar ? [0, 1, 5] : [0, 1, 2, 3, 4, 5];
  const full = singularValues.length;
  const largest = singularValues[0] ?? 0;
  const relative = singularValues.map((value) => (largest > 0 ? value / largest : 0));
  const rank = relative.filter((value) => value > rounding).length;
  const least = relative.at(-1) ?? 0;
  const is = rank < full ? "at" : least < near ? "near" : "far";
  const isOnly = (relative.at(-2) ?? 0) > (is === "at" ? apart : near);
  if (is === "far" || !isOnly || full < rows.length) return { is, rank, full, lost: null };
  const jacobian = arm.jacobian(q);
  const columns = Array.from({ length: arm.dof }, (_, k) => rows.map((i) => jacobian[6 * k + i] ?? 0));
  const product = rows.map((_, i) =>
    rows.map((_, k) => columns.reduce((sum, c) => sum + (c[i] ?? 0) * (c[k] ?? 0), 0)),
  );
  const { values, vectors } = eigen(product);
  const vector = vectors[values.indexOf(Math.min(...values))] ?? [];
  const twist = [0, 1, 2, 3, 4, 5].map((row) => vector[rows.indexOf(row)] ?? 0);
  const smallest = is === "at" ? 1e-6 : 0.1; // of a part that has a direction
  return {
    is,
    rank,
    full,
    lost: { linear: unit(twist.slice(0, 3), smallest), angular: unit(twist.slice(3), smallest) },
  };
}

/** The unit vector along `vector`, whose first number that is not 0 is positive; null where it is shorter than `smallest`. */
function unit(vector: number[], smallest: number): number[] | null {
  const length = Math.hypot(...vector);
  if (length < smallest) return null;
  const scaled = vector.map((value) => (Math.abs(value) < 1e-9 * length ? 0 : value / length));
  const sign = Math.sign(scaled.find((value) => value !== 0) ?? 1);
  return scaled.map((value) => (value === 0 ? 0 : sign * value));
}
