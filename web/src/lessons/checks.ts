import type { Arm } from "../core/arm.js";
import type { StepResponse } from "../core/step_response.js";

/** What a check answers: whether the exercise is solved, and a sentence; `at`: the joint values that it speaks of. */
export interface Verdict {
  solved: boolean;
  says: string;
  at?: number[];
}

/** Whether a gain of joint-space control is quick, without overshoot. */
export function checkGain({ settled, overshoot }: StepResponse, most: number): Verdict {
  if (overshoot > 1e-9)
    return { solved: false, says: `Not yet: the joints overshoot by ${(100 * overshoot).toFixed(0)} %.` };
  if (settled === null || settled > most)
    return { solved: false, says: `Not yet: ${settled === null ? "far too many" : settled} steps are needed.` };
  return { solved: true, says: `Right: ${settled} steps, and no overshoot.` };
}

const trials = 20;
const close = 1e-9;

/** Whether the tool is at a place, with an angle, in the plane. */
export function checkReach(pose: ArrayLike<number>, goal: { x: number; y: number; degrees: number }): Verdict {
  const [x = 0, y = 0] = [pose[12], pose[13]];
  const angle = Math.atan2(pose[1] ?? 0, pose[0] ?? 1) - (goal.degrees * Math.PI) / 180;
  const turn = Math.abs(Math.atan2(Math.sin(angle), Math.cos(angle))) * (180 / Math.PI);
  const away = Math.hypot(x - goal.x, y - goal.y);
  if (away <= 0.1 && turn <= 3) return { solved: true, says: "Right: the tool is there." };
  return { solved: false, says: `The tool is ${away.toFixed(2)} m and ${turn.toFixed(0)}° away.` };
}

/** Whether the Jacobian of an arm is the same at all configurations: compared at random ones. */
export function checkConstantJacobian(arm: Arm, random: () => number): Verdict {
  const at = (): number[] => Array.from({ length: arm.dof }, () => 2 * random() - 1);
  const first = arm.jacobian(at());
  for (let trial = 0; trial < trials; ++trial) {
    const other = arm.jacobian(at());
    if (!first.every((value, i) => Math.abs(value - (other[i] as number)) < close)) {
      return { solved: false, says: "Not yet: its Jacobian changes with the configuration." };
    }
  }
  return { solved: true, says: "Right: its Jacobian is the same everywhere. Which joints does it have, and why?" };
}
