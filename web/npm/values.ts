import { poseOfQuaternion, poseOfRpy } from "../src/core/pose.js";
import { CoreError } from "../src/core/types.js";
import type { Arm } from "./arm.js";

/** Numbers of joints, or of a pose. */
export type Numbers = ArrayLike<number>;

export const invalid = (message: string): CoreError => new CoreError(message, "invalid_argument");

/** A list of finite numbers. `accepted` says what it must be. */
function finite(what: string, numbers: unknown, accepted: string): number[] {
  if (typeof numbers !== "object" || numbers === null || !("length" in numbers)) {
    throw invalid(`${what} is ${String(numbers)}; it must be a list of ${accepted}`);
  }
  const list = Array.from(numbers as Numbers);
  const at = list.findIndex((value) => !Number.isFinite(value));
  if (at >= 0) throw invalid(`${what}[${at}] is ${String(list[at])}; it must be a finite number`);
  return list;
}

/** The joint values of an arm. */
export function configuration(what: string, arm: Arm, q: Numbers): number[] {
  const list = finite(what, q, `${arm.dof} joint values`);
  if (list.length === arm.dof) return list;
  const joints = arm.description.joints.filter(({ mimic }) => mimic === undefined).map(({ name }) => name);
  throw invalid(`${what} has ${list.length} numbers; ${arm.name} has ${arm.dof} joint values: ${joints.join(", ")}`);
}

const forms = "x,y,z,roll,pitch,yaw, x,y,z,qw,qx,qy,qz or the 16 numbers of a matrix, of a planar arm also x,y,theta";

const maxLengthError = 1e-3; // of a quaternion, as in the core

/** A pose in one of its forms as a column-major 4 x 4 matrix. */
export function matrixOf(what: string, arm: Arm, pose: Numbers): number[] {
  const numbers = finite(what, pose, forms);
  const [x = 0, y = 0, theta = 0, ...quaternion] = numbers;
  if (numbers.length === 16) return numbers;
  if (numbers.length === 6) return poseOfRpy(numbers);
  if (numbers.length === 3 && arm.planar) return poseOfRpy([x, y, 0, 0, 0, theta]);
  if (numbers.length !== 7) throw invalid(`${what} has ${numbers.length} numbers; it must be ${forms}`);
  const length = Math.hypot(...quaternion);
  if (Math.abs(length - 1) <= maxLengthError) return poseOfQuaternion(numbers);
  throw invalid(`${what}: the quaternion ${quaternion.join(",")} has length ${length}; it must be 1`);
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
  if (!Array.isArray(poses)) throw invalid(`${what} is ${String(poses)}; it must be a list of poses`);
  return poses.map((pose, i) => `${typedPose(`${what}[${i}]`, arm, pose as Numbers)}\n`).join("");
}

/** Options of the command in camel case: {maxSamples: 9, all: true} is --max-samples=9 --all. */
export type Options = Record<string, string | number | boolean | Numbers | undefined>;

export function typedOptions(options: Options): string[] {
  return Object.entries(options).flatMap(([name, value]) => {
    if (!/^[a-z][A-Za-z0-9]*$/.test(name)) {
      throw invalid(`"${name}" is no option; options have the names of the command in camel case, such as maxSamples`);
    }
    const option = `--${name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`;
    if (value === undefined || value === false) return [];
    if (value === true) return [option];
    return [`${option}=${typeof value === "object" ? Array.from(value).join(",") : value}`];
  });
}
