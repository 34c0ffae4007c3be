import type { Arm } from "./arm.js";

/** A pose in numbers: position, m; roll pitch yaw about the fixed axes x, y, z, rad; quaternion w x y z with w >= 0. */
export interface PoseNumbers {
  position: number[];
  rpy: number[];
  quaternion: number[];
}

type Numbers = ArrayLike<number>;
const at = (m: Numbers, i: number): number => m[i] ?? 0;

/** The numbers of a column-major 4 x 4 matrix. */
export function poseNumbers(m: Numbers): PoseNumbers {
  const [r11, r21, r31, r12, r22, r32, r13, r23, r33] = [0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => at(m, i)) as [
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const level = Math.hypot(r11, r21);
  const upright = level < 1e-7; // roll and yaw turn about one axis: roll is 0
  const rpy = [
    upright ? 0 : Math.atan2(r32, r33),
    Math.atan2(-r31, level),
    upright ? Math.atan2(-r12, r22) : Math.atan2(r21, r11),
  ];
  const squares = [1 + r11 + r22 + r33, 1 + r11 - r22 - r33, 1 - r11 + r22 - r33, 1 - r11 - r22 + r33];
  const largest = squares.indexOf(Math.max(...squares)); // its root loses no digits
  const rows = [
    [squares[0] ?? 0, r32 - r23, r13 - r31, r21 - r12],
    [r32 - r23, squares[1] ?? 0, r12 + r21, r13 + r31],
    [r13 - r31, r12 + r21, squares[2] ?? 0, r23 + r32],
    [r21 - r12, r13 + r31, r23 + r32, squares[3] ?? 0],
  ];
  const row = rows[largest] ?? [1, 0, 0, 0];
  const length = Math.hypot(...row) * ((row[0] ?? 0) < 0 ? -1 : 1);
  return { position: positionOf(m), rpy, quaternion: row.map((value) => value / length) };
}

/** The position of a column-major 4 x 4 matrix, m. */
export function positionOf(m: Numbers): number[] {
  return [at(m, 12), at(m, 13), at(m, 14)];
}

/** The angle of a planar pose about z, rad. */
export function headingOf(m: Numbers): number {
  return Math.atan2(at(m, 1), at(m, 0));
}

/** The column-major 4 x 4 matrix of x y z, metres, and roll pitch yaw, radians. */
export function poseOfRpy([x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0]: number[]): number[] {
  const [cr, sr, cp, sp] = [Math.cos(roll), Math.sin(roll), Math.cos(pitch), Math.sin(pitch)];
  const [cy, sy] = [Math.cos(yaw), Math.sin(yaw)];
  return [
    ...[cy * cp, sy * cp, -sp, 0],
    ...[cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr, 0],
    ...[cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr, 0],
    ...[x, y, z, 1],
  ];
}

/** The column-major 4 x 4 matrix of x y z qw qx qy qz. */
export function poseOfQuaternion([x = 0, y = 0, z = 0, qw = 1, qx = 0, qy = 0, qz = 0]: number[]): number[] {
  const [w, i, j, k] = [qw, qx, qy, qz].map((value) => value / (Math.hypot(qw, qx, qy, qz) || 1)) as [
    number,
    number,
    number,
    number,
  ];
  return [
    ...[1 - 2 * (j * j + k * k), 2 * (i * j + w * k), 2 * (i * k - w * j), 0],
    ...[2 * (i * j - w * k), 1 - 2 * (i * i + k * k), 2 * (j * k + w * i), 0],
    ...[2 * (i * k + w * j), 2 * (j * k - w * i), 1 - 2 * (i * i + j * j), 0],
    ...[x, y, z, 1],
  ];
}

/** A pose, column-major 4 x 4, as x y z qw qx qy qz. */
export function sevenOf(pose: Numbers): number[] {
  const { position, quaternion } = poseNumbers(pose);
  return [...position, ...quaternion];
}

/** The file of poses that the command reads, from rows x y z qw qx qy qz. */
export function posesFile(poses: number[][]): string {
  return ["x,y,z,qw,qx,qy,qz", ...poses.map((pose) => pose.join(",")), ""].join("\n");
}

/** What turns `from` into `to`, two column-major 4 x 4 matrices: the translation, m, and the rotation vector, rad, in
 * world axes. */
export function poseError(from: Numbers, to: Numbers): number[] {
  const r = (i: number, k: number): number =>
    [0, 4, 8].reduce((sum, column) => sum + at(to, column + i) * at(from, column + k), 0);
  const twice = [r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)];
  const sine = Math.hypot(...twice) / 2;
  const cosine = (r(0, 0) + r(1, 1) + r(2, 2) - 1) / 2;
  const angle = Math.atan2(sine, cosine);
  const shift = [12, 13, 14].map((i) => at(to, i) - at(from, i));
  if (sine > 1e-9) return [...shift, ...twice.map((value) => (value / (2 * sine)) * angle)];
  if (cosine > 0) return [...shift, ...twice.map((value) => value / 2)];
  const diagonal = [0, 1, 2].map((i) => Math.sqrt(Math.max(0, (r(i, i) + 1) / 2))); // half a turn about this axis
  const first = diagonal.indexOf(Math.max(...diagonal));
  const axis = diagonal.map((value, i) => (i === first ? value : r(first, i) / (2 * (diagonal[first] ?? 1))));
  return [...shift, ...axis.map((value) => value * Math.PI)];
}

/** The pose of the tool, column-major 4 x 4. */
export function toolPose(arm: Arm, q: Numbers): Float64Array {
  return arm.forward(q).at(-1) as Float64Array;
}

/** The position of the tool, m. */
export function toolPosition(arm: Arm, q: Numbers): number[] {
  return positionOf(toolPose(arm, q));
}
