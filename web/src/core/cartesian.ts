import type { Arm } from "./arm.js";
import type { JointDescription } from "./description.js";
import { poseError, toolPose } from "./pose.js";
import { eigen } from "./symmetric_eigen.js";

const dampedBelow = 1e-2; // fraction of the largest singular value
const maxDampedStep = 0.1; // rad
const maxStep = 1; // rad
const timeStep = 0.02; // s, of the command's simulation
const spatialRows = [0, 1, 2, 3, 4, 5];
const planarRows = [0, 1, 5];

/** The step of Cartesian control by the inverse Jacobian (eq. 1.6), as `beeline line --method inverse-jacobian` takes
 * it: damped near singularities, no joint by more than 1 rad, slowed as a whole by velocity limits. */
function step(
  arm: Arm,
  joints: JointDescription[],
  q: number[],
  pose: number[],
  gain: number,
): { moved: number[]; error: number } {
  const rows = arm.planar ? planarRows : spatialRows;
  const all = poseError(toolPose(arm, q), pose);
  const error = rows.map((i) => all[i] ?? 0);
  const columns = arm.jacobian(q);
  const jacobian = rows.map((i) => q.map((_, k) => columns[6 * k + i] ?? 0));
  const dot = (a: number[], b: number[]): number => a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
  const { values, vectors } = eigen(jacobian.map((a) => jacobian.map((b) => dot(a, b))));
  const order = values.map((_, i) => i).sort((a, b) => (values[b] ?? 0) - (values[a] ?? 0));
  const sigma = (i: number): number => Math.sqrt(Math.max(0, values[i] ?? 0));
  const count = Math.min(rows.length, q.length);
  const threshold = dampedBelow * sigma(order[0] ?? 0);
  const damped = sigma(order[count - 1] ?? 0) < threshold;
  const full = q.map(() => 0);
  for (const i of threshold > 0 ? order.slice(0, count) : []) {
    const relative = sigma(i) / threshold;
    const damping = Math.max(0, 1 - relative);
    const left = vectors[i] ?? [];
    const factor = dot(left, error) / (relative ** 2 + damping ** 2) / threshold ** 2;
    full.forEach(
      (_, k) =>
        (full[k] = (full[k] ?? 0) + factor * jacobian.reduce((sum, row, j) => sum + (row[k] ?? 0) * (left[j] ?? 0), 0)),
    );
  }
  const turns = full.map((value, k) => (joints[k]?.type === "prismatic" ? 0 : Math.abs(value)));
  const rotation = gain * Math.max(...turns);
  const allowed = damped ? maxDampedStep : maxStep;
  let scale = rotation > allowed ? (gain * allowed) / rotation : gain;
  const slower = full.map(
    (value, k) => ((joints[k]?.limits.velocity ?? Infinity) * timeStep) / Math.abs(scale * value),
  );
  scale *= Math.min(1, ...slower.filter((factor) => !Number.isNaN(factor)));
  return { moved: q.map((value, k) => value + scale * (full[k] ?? 0)), error: Math.max(...error.map(Math.abs)) };
}

/** Whether a joint would leave its limits. */
export function outside(q: number[], joints: JointDescription[]): boolean {
  return joints.some(({ limits: { lower, upper } }, k) => {
    const value = q[k] ?? 0;
    return (lower !== null && value < lower) || (upper !== null && value > upper);
  });
}

/** The joint values of Cartesian control from q through poses, one row a step, at most `maxSteps` of them; a pose is
 * reached within `tolerance`, m and rad. Ends before a joint leaves its limits. */
export function* cartesianRows(
  arm: Arm,
  joints: JointDescription[],
  q: number[],
  poses: number[][],
  { gain, tolerance, maxSteps }: { gain: number; tolerance: number; maxSteps: number },
): Generator<number[]> {
  let now = q;
  let steps = 0;
  for (const pose of poses) {
    for (;;) {
      const { moved, error } = step(arm, joints, now, pose, gain);
      const change = Math.max(...moved.map((value, k) => Math.abs(value - (now[k] ?? 0))));
      if (error <= tolerance && change <= tolerance) break;
      if (++steps > maxSteps || !moved.every(Number.isFinite) || outside(moved, joints)) return;
      now = moved;
      yield now;
    }
  }
}
