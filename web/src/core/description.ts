import type { Arm } from "./arm.js";

/** What the page uses of `beeline show --json`. */
export interface JointDescription {
  name: string;
  type: "revolute" | "prismatic" | "helical";
  limits: { lower: number | null; upper: number | null; velocity: number | null; acceleration: number | null };
  /** Of a joint that follows another. */
  mimic?: object;
  /** What motions are planned within where a limit is not known. */
  assumed?: { velocity?: number; acceleration?: number };
}

export interface ArmDescription {
  name: string;
  /** Those with a coordinate, in its order: without joints that mimic others. */
  joints: JointDescription[];
  reach?: { centre?: number[]; radius: number | null };
}

/** What the page uses of the description of an arm. */
export function describe({ description }: Arm): ArmDescription {
  const all = description as ArmDescription;
  return { ...all, joints: all.joints.filter(({ mimic }) => mimic === undefined) };
}

/** The middle of the limits; 0 where a joint has none. */
export function middle(arm: ArmDescription): number[] {
  return arm.joints.map(({ limits: { lower, upper } }) => (lower === null || upper === null ? 0 : (lower + upper) / 2));
}
