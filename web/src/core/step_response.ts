import type { Arm } from "./arm.js";
import type { Gains } from "./types.js";

/** How joint-space PID control answers a step of the goal. */
export interface StepResponse {
  /** The joint values, the first row at the start. */
  rows: number[][];
  /** errors[k][t]: goal minus value of joint k after t steps, radians or metres. */
  errors: number[][];
  /** Largest distance of a joint beyond its goal, relative to the distance at the start. */
  overshoot: number;
  /** The steps after which all errors stay below 2 % of those at the start; null: not within the computed ones. */
  settled: number | null;
  /** The largest error after the last step, relative to that at the start. */
  left: number;
  /** The steps after which the largest error is more than `divergence` times the first one: what is drawn ends here;
   * null: it never is. */
  diverged: number | null;
  /** By what a step multiplies the error in the end, about; with a proportional gain alone by 1 - Kp. */
  factor: number;
}

/** Whether a controller is eq. 1.3 of the chapter. */
export const isProportional = ({ ki = 0, kd = 0 }: Gains): boolean => ki === 0 && kd === 0;

const band = 0.02;
export const divergence = 10;
const lastSteps = 60; // in which the factor of a step is found

/** Computes the step response for a number of steps. Throws where the core refuses the gains. */
export function stepResponse(arm: Arm, gains: Gains, q: number[], goal: number[], steps: number): StepResponse {
  const rows = [q, ...arm.pid(gains, q, goal, steps).map((row) => Array.from(row))];
  const errors = goal.map((end, k) => rows.map((row) => end - (row[k] as number)));
  const relative = errors
    .filter(([first]) => first !== 0)
    .map((values) => values.map((value) => value / (values[0] as number)));
  const largest = rows.map((_, t) => Math.max(...errors.map((values) => Math.abs(values[t] as number))));
  const diverged = largest.findIndex((error) => error > divergence * (largest[0] ?? 0));
  const factor = isProportional(gains) ? 1 - gains.kp : ratioOf(largest);
  return { rows, errors, ...settling(relative, steps), diverged: diverged < 0 ? null : diverged, factor };
}

/** The mean factor between neighbours of the last numbers. */
function ratioOf(largest: number[]): number {
  const last = largest.filter((value) => Number.isFinite(value) && value > 0).slice(-lastSteps - 1);
  return ((last.at(-1) ?? 0) / (last[0] ?? 1)) ** (1 / Math.max(1, last.length - 1));
}

/** From relative errors of some quantities over the steps: overshoot, settling, and what is left. */
function settling(relative: number[][], steps: number): Pick<StepResponse, "overshoot" | "settled" | "left"> {
  const settled = settledAfter(relative, steps);
  return {
    overshoot: relative.flat().reduce((most, value) => Math.max(most, -value), 0),
    settled,
    left: relative.reduce((most, values) => Math.max(most, Math.abs(values.at(-1) as number)), 0),
  };
}

/** The steps after which all relative errors stay below 2 %; null: not within these steps. */
export function settledAfter(relative: number[][], steps: number): number | null {
  const times = Array.from({ length: steps + 1 }, (_, t) => t);
  const outside = times.findLastIndex((t) => relative.some((values) => Math.abs(values[t] as number) >= band));
  return outside < steps ? outside + 1 : null;
}
