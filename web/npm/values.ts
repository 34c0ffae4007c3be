import { poseNumbers as numbersOfPose, poseOfQuaternion, poseOfRpy, type PoseNumbers } from "../src/core/pose.js";
import { inWords } from "../src/core/words.js";
import type { Arm } from "./arm.js";
import { finite, invalid, lengthOf, type Numbers } from "./checks.js";

/** The joint values of an arm. */
export function configuration(what: string, arm: Arm, q: Numbers): number[] {
  const length = lengthOf(what, q, `${arm.dof} joint values`);
  if (length === arm.dof) return finite(what, q);
  const joints = arm.description.joints.filter(({ mimic }) => mimic === undefined).map(({ name }) => name);
  throw invalid(`${what} has ${length} numbers; ${arm.name} has ${arm.dof} joint values: ${joints.join(", ")}`);
}

const forms = "x,y,z,roll,pitch,yaw, x,y,z,qw,qx,qy,qz or the 16 numbers of a matrix, of a planar arm also x,y,theta";

const maxLengthError = 1e-3; // of a quaternion, as in the core

/** A pose in one of its forms as a column-major 4 x 4 matrix. */
export function matrixOf(what: string, arm: Arm, pose: Numbers): number[] {
  const count = lengthOf(what, pose, forms);
  if (![6, 7, 16].includes(count) && !(count === 3 && arm.planeHeight !== null)) {
    throw invalid(`${what} has ${count} numbers; it must be ${forms}`);
  }
  const numbers = finite(what, pose);
  const [x = 0, y = 0, theta = 0, ...quaternion] = numbers;
  if (count === 16) return numbers;
  if (count === 6) return poseOfRpy(numbers);
  if (count === 3) return poseOfRpy([x, y, arm.planeHeight ?? 0, 0, 0, theta]);
  const length = Math.hypot(...quaternion);
  if (Math.abs(length - 1) <= maxLengthError) return poseOfQuaternion(numbers);
  throw invalid(`${what}: the quaternion ${quaternion.join(",")} has length ${length}; it must be 1`);
}

const maxOutside = 1e-6; // m, and of the unit vector z, as in beeline/kinematics/internal/tool_plane.h

/** Refuses a pose, a column-major 4 x 4 matrix, at which the tool of a planar arm cannot be: the task of such an arm ignores
 * height and tilt. */
export function requireInPlane(what: string, arm: Arm, pose: readonly number[]): void {
  const { planeHeight, name } = arm;
  if (planeHeight === null) return;
  const [zx = 0, zy = 0, zz = 0] = pose.slice(8);
  const isUpright = Math.hypot(zx, zy, zz - 1) < maxOutside;
  if (isUpright && Math.abs((pose[14] ?? 0) - planeHeight) < maxOutside) return;
  throw invalid(`the ${what} is outside the plane z = ${planeHeight} m of arm ${name}; give x,y,theta`);
}

/** A pose as the command reads it, which knows its form by the count of its numbers. */
export function typedPose(what: string, arm: Arm, pose: Numbers): string {
  matrixOf(what, arm, pose); // refuses what is no pose of the arm
  const numbers = Array.from(pose);
  if (numbers.length !== 16) return numbers.join(",");
  return numbers.map((_, i) => numbers[4 * (i % 4) + Math.floor(i / 4)]).join(","); // row by row
}

/** The file of poses that the command reads. */
export function posesFile(what: string, arm: Arm, poses: readonly Numbers[]): string {
  if (!Array.isArray(poses)) throw invalid(`${what} is ${inWords(poses)}; it must be a list of poses`);
  let text = "";
  for (const [i, pose] of poses.entries()) text += `${typedPose(`${what}[${i}]`, arm, pose as Numbers)}\n`;
  return text;
}

/** The numbers of a column-major 4 x 4 matrix. */
export function poseNumbers(pose: Numbers): PoseNumbers {
  const count = lengthOf("pose", pose, "the 16 numbers of a matrix");
  if (count !== 16) throw invalid(`pose has ${count} numbers; it must be the 16 numbers of a matrix`);
  return numbersOfPose(finite("pose", pose));
}
