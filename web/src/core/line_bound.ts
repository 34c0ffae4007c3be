import type { Arm } from "./arm.js";
import { headingOf, poseOfRpy, toolPose } from "./pose.js";

const rounding = 1e-12; // more than the rounding errors of the bound itself, relative and m

/** The lengths of the links of a planar arm of revolute joints. */
export function linkLengths(arm: Arm): number[] {
  const zero = new Array<number>(arm.dof).fill(0);
  const ends = [...arm.skeleton(zero).joints.map(({ centre }) => centre[0] ?? 0), arm.forward(zero).at(-1)?.[12] ?? 0];
  return ends.slice(1).map((end, i) => end - (ends[i] ?? 0));
}

/** Joint values at which the tool is on the straight line between its poses at two configurations, in `intervals` equal
 * parts, its angle by the shorter way; the configuration nearest to the one before. Fewer where a pose is out of reach. */
export function lineRows(arm: Arm, from: number[], to: number[], intervals: number): number[][] {
  const [start, end] = [from, to].map((q) => {
    const pose = toolPose(arm, q);
    return [pose[12] ?? 0, pose[13] ?? 0, headingOf(pose)];
  }) as [number[], number[]];
  const turn = (end[2] ?? 0) - (start[2] ?? 0);
  const difference = [
    (end[0] ?? 0) - (start[0] ?? 0),
    (end[1] ?? 0) - (start[1] ?? 0),
    Math.atan2(Math.sin(turn), Math.cos(turn)),
  ];
  const rows = [from];
  for (let i = 1; i <= intervals; ++i) {
    const [x = 0, y = 0, angle = 0] = start.map((value, k) => value + (i / intervals) * (difference[k] ?? 0));
    const [found] = arm.inverse(poseOfRpy([x, y, 0, 0, 0, angle]), rows.at(-1) ?? from);
    if (!found) break;
    rows.push(Array.from(found));
  }
  return rows;
}

/** How far the tool of a planar arm of revolute joints leaves the straight line between its positions at two
 * configurations at most, m, while the joints move evenly from one to the other: an eighth of a bound of the second
 * derivative of its position, and what rounding may take from that. */
export function lineBound(lengths: number[], from: number[], to: number[]): number {
  let rotation = 0; // of the link
  const second = lengths.map((length, i) => {
    rotation += (to[i] ?? 0) - (from[i] ?? 0);
    return length * rotation ** 2;
  });
  return (second.reduce((sum, value) => sum + value, 0) / 8) * (1 + rounding) + rounding;
}

/** How far the tool leaves that line at the ends of `count` equal parts of the motion, m. */
export function sampledDeviation(arm: Arm, from: number[], to: number[], count: number): number[] {
  const at = (q: number[]): [number, number] => {
    const pose = toolPose(arm, q);
    return [pose[12] ?? 0, pose[13] ?? 0];
  };
  const [[ax, ay], [bx, by]] = [at(from), at(to)];
  const length = Math.hypot(bx - ax, by - ay) || 1;
  return Array.from({ length: count + 1 }, (_, i) => {
    const [x, y] = at(from.map((value, k) => value + (i / count) * ((to[k] ?? 0) - value)));
    return Math.abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length;
  });
}
