import type { Arm } from "../core/arm.js";
import type { ReachMap } from "../core/reach.js";

/** Rolls that are tried where a map has any: the last joint reaches one of them. */
const triedRolls = 24;

/** How alike two rotations are, 9 numbers by columns: the trace of A^T B, 3 if they are equal. */
function likeness(a: number[], b: number[]): number {
  return a.reduce((sum, value, k) => sum + value * (b[k] ?? 0), 0);
}

/** A rotation times a turn about its z axis. */
function rolled(r: number[], angle: number): number[] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [x, y] = [r.slice(0, 3), r.slice(3, 6)];
  const mixed = (a: number, b: number): number[] => x.map((value, i) => a * value + b * (y[i] ?? 0));
  return [...mixed(c, s), ...mixed(-s, c), ...r.slice(6, 9)];
}

/** The orientations of a map, with rolls about the tool's z axis where the map has any roll. */
function orientationsOf(map: ReachMap, planar: boolean): number[][] {
  const rolls = !planar && map.directions > 1 && map.rolls === 1 ? triedRolls : 1;
  return Array.from({ length: map.directions * map.rolls * rolls }, (_, i) => {
    const k = Math.floor(i / rolls);
    const rotation = Array.from(map.orientations.subarray(9 * k, 9 * k + 9));
    return rolled(rotation, (2 * Math.PI * (i % rolls)) / rolls);
  });
}

/** Joint values that bring the tool to a point: in its orientation, or in the nearest orientation of the map that has a
 * solution. Null where none has. */
export function toolAt(arm: Arm, map: ReachMap, point: number[], q: number[]): number[] | null {
  const now = arm.forward(q).at(-1) as Float64Array;
  const turned = [0, 4, 8].flatMap((k) => Array.from(now.subarray(k, k + 3)));
  const others = orientationsOf(map, arm.planar).map((rotation) => ({ rotation, rank: likeness(turned, rotation) }));
  others.sort((a, b) => b.rank - a.rank);
  for (const r of [turned, ...others.map((other) => other.rotation)]) {
    const pose = [...r.slice(0, 3), 0, ...r.slice(3, 6), 0, ...r.slice(6, 9), 0, ...point, 1];
    const [found] = arm.inverse(pose, q);
    if (found) return Array.from(found);
  }
  return null;
}
