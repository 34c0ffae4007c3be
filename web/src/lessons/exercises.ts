import { stepResponse } from "../core/step_response.js";
import { poseOfRpy } from "../core/pose.js";
import { element } from "../elements/element.js";
import type { Shown } from "../page/section.js";
import { checkConstantJacobian, checkGain, checkReach } from "./checks.js";
import { checkButton, exercise, verdict, type Exercise, type ExerciseContext } from "./exercise.js";
import { formulaExercise, type FormulaTask } from "./formula_exercise.js";
import { planarPose } from "./formula_checks.js";

/** The pose of the tool of the arm RP, whose link has the length 1. */
const rpPose: FormulaTask = {
  arm: "rp",
  names: { joints: ["revolute", "prismatic"], lengths: [1] },
  asked: planarPose,
};

function reach(context: ExerciseContext): Exercise {
  const goal = { x: 2, y: 6, degrees: 45 };
  const answer = verdict();
  let checkedAt: number[] | null = null;
  const arm = (): Shown["arm"] | null => {
    const { q } = context.services.store.get();
    return q && context.shown.arm.planar && q.length === context.shown.arm.dof ? context.shown.arm : null;
  };
  const check = (): void => {
    const { q } = context.services.store.get();
    checkedAt = q;
    const pose = q && arm()?.forward(q).at(-1);
    if (!pose) return answer.show({ solved: false, says: "Set the arm rrr first." });
    answer.show(checkReach(pose, goal));
  };
  const target = poseOfRpy([goal.x, goal.y, 0, 0, 0, (goal.degrees * Math.PI) / 180]);
  const text = `Bring the tool to x = ${goal.x}, y = ${goal.y}, at ${goal.degrees}°: drag it, or use the sliders.`;
  return {
    root: exercise(text, check, checkButton(), answer.root),
    update() {
      context.services.draw({ waypoints: arm() ? [{ pose: target, label: "target", held: false }] : [] });
      if (checkedAt === context.services.store.get().q) return;
      answer.show({ solved: false, says: "" }); // it was for another place of the arm
      checkedAt = null;
    },
  };
}

function constantJacobian({ arm }: ExerciseContext): Exercise {
  const answer = verdict();
  const input = element("input", {
    id: "constant-arm",
    spellcheck: "false",
    autocomplete: "off",
    placeholder: "RRR:1,1,1",
  });
  const check = (): void => {
    try {
      const typed = arm(input.value.trim());
      answer.show(checkConstantJacobian(typed, Math.random));
      typed.release();
    } catch (error) {
      answer.show({ solved: false, says: (error as Error).message });
    }
  };
  const row = element("p", { class: "formula" }, element("label", { for: "constant-arm" }, "Arm"), input);
  const text =
    "The Jacobian of this arm changes as the arm moves. Is that so for every arm? Name one whose Jacobian is constant.";
  return { root: exercise(text, check, row, checkButton(), answer.root) };
}

function gain(context: ExerciseContext): Exercise {
  const most = 10;
  const answer = verdict();
  const check = (): void => {
    const { arm } = context.shown;
    const kp = context.services.store.get().gain;
    try {
      const rest = new Array<number>(arm.dof).fill(0);
      answer.show(
        checkGain(
          stepResponse(
            arm,
            { kp },
            rest,
            rest.map(() => 1),
            400,
          ),
          most,
        ),
      );
    } catch (error) {
      answer.show({ solved: false, says: (error as Error).message });
    }
  };
  const wanted = `Find a gain with which less than 2 % of the way is left after ${most} steps, and no joint overshoots.`;
  return { root: exercise(wanted, check, checkButton(), answer.root) };
}

/** The exercises by the names that the lessons use. */
export const exercises: Record<string, (context: ExerciseContext) => Exercise> = {
  reach,
  gain,
  rp: (context) =>
    formulaExercise(
      context,
      rpPose,
      "Sketch an arm RP in the plane: a revolute joint, a link of length 1, then a prismatic joint along the link. Where " +
        "is its tool? Type x, y and the angle in θ1 and d2, as you would write them.",
    ),
  "formula-rp": (context) =>
    formulaExercise(
      context,
      rpPose,
      "Multiply the matrices of the RP arm out, as it was done above for the three-link arm, and type the result.",
    ),
  "constant-jacobian": constantJacobian,
};
