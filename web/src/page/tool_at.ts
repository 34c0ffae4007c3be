import { Matrix3, Matrix4, Vector3 } from "three";
import type { Arm } from "../core/arm.js";
import type { ReachMap } from "../core/reach.js";

/** Rolls that are tried where a map has any: the last joint reaches one of them. */
const triedRolls = 24;

/** How alike two rotations are: the trace of A^T B, 3 if they are equal. */
function likeness(a: Matrix3, b: Matrix3): number {
  return a.elements.reduce((sum, value, k) => sum + value * (b.elements[k] as number), 0);
}

/** The orientations of a map, with rolls about the tool's z axis where the map has any roll. */
function orientationsOf(map: ReachMap, planar: boolean): Matrix3[] {
  const rolls = !planar && map.directions > 1 && map.rolls === 1 ? triedRolls : 1;
  return Array.from({ length: map.directions * map.rolls * rolls }, (_, i) => {
    const k = Math.floor(i / rolls);
    const rotation = new Matrix3().fromArray(map.orientations.subarray(9 * k, 9 * k + 9));
    const roll = new Matrix4().makeRotationZ((2 * Math.PI * (i % rolls)) / rolls);
    return rotation.multiply(new Matrix3().setFromMatrix4(roll));
  });
}

/** Joint values that bring the tool to a point: in its orientation, or in the nearest orientation of the map that has a
 * solution. Null where none has. */
export function toolAt(arm: Arm, map: ReachMap, point: number[], q: number[]): number[] | null {
  const now = new Matrix4().fromArray(Array.from(arm.forward(q).at(-1) as Float64Array));
  const turned = new Matrix3().setFromMatrix4(now);
  const others = orientationsOf(map, arm.planar).map((rotation) => ({ rotation, rank: likeness(turned, rotation) }));
  others.sort((a, b) => b.rank - a.rank);
  for (const rotation of [turned, ...others.map((other) => other.rotation)]) {
    const pose = new Matrix4().setFromMatrix3(rotation).setPosition(new Vector3(...point));
    const [found] = arm.inverse(pose.toArray(), q);
    if (found) return Array.from(found);
  }
  return null;
}
