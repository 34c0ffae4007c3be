import type { Arm } from "./arm.js";
import type { Gains } from "./types.js";

/** How joint-space PID control answers a step of the goal. */
export interface StepResponse {
  /** errors[k][t]: goal minus value of joint k after t steps, radians or metres. */
  errors: number[][];
  /** Largest distance of a joint beyond its goal, relative to the distance at the start. */
  overshoot: number;
  /** The steps after which all errors stay below 2 % of those at the start; null: not within the computed ones. */
  settled: number | null;
  /** The largest error after the last step, relative to that at the start. */
  left: number;
}

const band = 0.02;

/** Computes the step response for a number of steps. Throws where the core refuses the gains. */
export function stepResponse(arm: Arm, gains: Gains, q: number[], goal: number[], steps: number): StepResponse {
  const rows = [q, ...arm.pid(gains, q, goal, steps)];
  const errors = goal.map((end, k) => rows.map((row) => end - (row[k] as number)));
  const relative = errors
    .filter(([first]) => first !== 0)
    .map((values) => values.map((value) => value / (values[0] as number)));
  const all = relative.flat();
  const outside = rows.findLastIndex((_, t) => relative.some((values) => Math.abs(values[t] as number) >= band));
  return {
    errors,
    overshoot: all.reduce((most, value) => Math.max(most, -value), 0),
    settled: outside < steps ? outside + 1 : null,
    left: relative.reduce((most, values) => Math.max(most, Math.abs(values.at(-1) as number)), 0),
  };
}
