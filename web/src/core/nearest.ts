import type { Arm } from "./arm.js";
import type { ArmDescription } from "./description.js";
import { poseError, toolPose } from "./pose.js";
import { solve } from "./linear.js";

const rows = 6;
const maxSteps = 60;
/** Weight of a radian of orientation, in reaches of the arm: the tool keeps its orientation and slides. The tool of an
 * arm with too few joints for both goes to the position. */
const orientationWeight = { kept: 2, free: 1e-3 };

/** Whether an arm has the joints to choose position and orientation of its tool. */
export function hasFullTask(arm: Arm): boolean {
  return arm.dof >= (arm.planar ? 3 : 6);
}

/** Joint values within the limits with the tool as near as possible to a pose that it need not reach, found from q by
 * damped least squares (Levenberg and Marquardt): the tool slides along the border of the workspace. `size`: the reach
 * of the arm, m. */
export function nearestTo(
  arm: Arm,
  joints: ArmDescription["joints"],
  pose: number[],
  q: number[],
  size: number,
): number[] {
  const turns = hasFullTask(arm) ? orientationWeight.kept : orientationWeight.free;
  const weights = [1, 1, 1, ...new Array<number>(3).fill(turns * size)];
  const errorAt = (values: number[]): number[] =>
    poseError(toolPose(arm, values), pose).map((value, i) => value * (weights[i] ?? 1));
  const cost = (error: number[]): number => error.reduce((sum, value) => sum + value * value, 0);
  let now = q;
  let error = errorAt(now);
  let damping = 1e-3 * size * size;
  for (let step = 0; step < maxSteps; ++step) {
    const moved = clamped(dampedStep(arm, now, error, weights, damping, joints), joints);
    const after = errorAt(moved);
    const gain = cost(error) - cost(after);
    if (!(gain > 0)) {
      damping *= 8;
      if (damping > 1e6 * size * size) break;
      continue;
    }
    [now, error] = [moved, after];
    damping = Math.max(damping / 4, 1e-9 * size * size);
    if (gain < 1e-12 * size * size) break;
  }
  return now;
}

/** q + Jᵀ (J Jᵀ + d I)⁻¹ e, without the joints that are at a limit and would leave it. */
function dampedStep(
  arm: Arm,
  q: number[],
  error: number[],
  weights: number[],
  damping: number,
  joints: ArmDescription["joints"],
): number[] {
  const columns = arm.jacobian(q).map((value, i) => value * (weights[i % rows] ?? 1));
  const free = q.map(() => true);
  for (;;) {
    const scaled = solve(normalMatrix(columns, free, damping), error);
    const step = q.map((_, k) => {
      let sum = 0;
      if (free[k]) for (let i = 0; i < rows; ++i) sum += (columns[rows * k + i] ?? 0) * (scaled[i] ?? 0);
      return sum;
    });
    const stuck = q.findIndex((value, k) => {
      const { lower, upper } = joints[k]?.limits ?? { lower: null, upper: null };
      const d = step[k] ?? 0;
      return (
        free[k] === true && ((lower !== null && value <= lower && d < 0) || (upper !== null && value >= upper && d > 0))
      );
    });
    if (stuck < 0) return q.map((value, k) => value + (step[k] ?? 0));
    free[stuck] = false;
  }
}

/** J Jᵀ + d I of the free columns. */
function normalMatrix(columns: Float64Array, free: boolean[], damping: number): number[][] {
  const matrix = Array.from({ length: rows }, (_, i) =>
    Array.from({ length: rows }, (_, k) => (i === k ? damping : 0)),
  );
  for (const [k, isFree] of free.entries()) {
    if (!isFree) continue;
    for (let i = 0; i < rows; ++i) {
      const row = matrix[i] as number[];
      for (let j = 0; j < rows; ++j)
        row[j] = (row[j] ?? 0) + (columns[rows * k + i] ?? 0) * (columns[rows * k + j] ?? 0);
    }
  }
  return matrix;
}

/** Joint values within the limits. */
export function clamped(q: number[], joints: ArmDescription["joints"]): number[] {
  return q.map((value, k) => {
    const { lower, upper } = joints[k]?.limits ?? { lower: null, upper: null };
    return Math.min(upper ?? Infinity, Math.max(lower ?? -Infinity, value));
  });
}
