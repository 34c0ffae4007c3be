import type { Arm } from "../core/arm.js";
import { cartesianRows } from "../core/cartesian.js";
import type { JointDescription } from "../core/description.js";
import { poseOfRpy } from "../core/pose.js";

/** Figure 1.9 of the chapter: eq. 1.6 from this start through three poses, x, y, degrees. */
const start = [0, Math.PI / 2, 0];
const waypoints = [
  [6, 2.5, 30],
  [-0.5, 6.5, 120],
  [-4, 2.5, 180],
] as const;
const control = { gain: 0.01, tolerance: 2e-3, maxSteps: 20_000 };
const decimals = 5; // of a joint value in rad: less than a pixel

export const poses = waypoints.map(([x, y, degrees]) => poseOfRpy([x, y, 0, 0, 0, (degrees * Math.PI) / 180]));

/** `count` joint values of the figure, evenly among the steps; the last ones are exactly at the last pose, which control
 * only comes near. The build computes them (opening_plugin.ts): the page opens without a thousand steps of control. */
export function openingRows(arm: Arm, joints: JointDescription[], count: number): number[][] {
  const rows = [start, ...cartesianRows(arm, joints, start, poses, control)];
  const every = (rows.length - 1) / (count - 1);
  const some = Array.from({ length: count - 1 }, (_, i) => rows[Math.round(i * every)] ?? start);
  const last = rows.at(-1) ?? start;
  const [exact] = arm.inverse(poses.at(-1) ?? [], last);
  return [...some.map((q) => q.map((value) => Number(value.toFixed(decimals)))), Array.from(exact ?? last)];
}
