/** What the page uses of `beeline show --json`. */
export interface JointDescription {
  name: string;
  type: "revolute" | "prismatic" | "helical";
  limits: { lower: number | null; upper: number | null; velocity: number | null };
}

export interface ArmDescription {
  name: string;
  joints: JointDescription[];
  reach?: { radius: number | null };
}

/** The middle of the limits; 0 where a joint has none. */
export function middle(arm: ArmDescription): number[] {
  return arm.joints.map(({ limits: { lower, upper } }) => (lower === null || upper === null ? 0 : (lower + upper) / 2));
}
