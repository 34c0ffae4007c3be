import { stepResponse } from "../core/step_response.js";
import { poseOfRpy } from "../core/pose.js";
import { element } from "../elements/element.js";
import {
  armTyped,
  checkAngle,
  checkConstantJacobian,
  checkCount,
  checkGain,
  checkLost,
  checkNumbers,
  checkReach,
  checkString,
  type Verdict,
} from "./checks.js";
import { drawingExercise } from "./drawing_board.js";
import { checkButton, exercise, verdict, type Exercise, type ExerciseContext } from "./exercise.js";
import { formulaExercise, type FormulaTask } from "./formula_exercise.js";
import { planarPose, rpJacobian } from "./formula_checks.js";
import type { Names } from "./formula.js";
import { sameArm } from "../state/page_state.js";

/** The pose of the tool of the arm RP, whose link has the length 1. */
const rpPose: FormulaTask = {
  arm: "rp",
  names: { joints: ["revolute", "prismatic"], lengths: [1] },
  asked: planarPose,
};

/** The target is in the picture, and it is checked while the arm moves. */
function reach(context: ExerciseContext): Exercise {
  const { services } = context;
  const goal = { x: 2, y: 6, degrees: 45 };
  const target = poseOfRpy([goal.x, goal.y, 0, 0, 0, (goal.degrees * Math.PI) / 180]);
  const around = [-1.2, 1.2].map((far) => [goal.x + far, goal.y + far, 0]); // its frame is in the picture too
  const answer = verdict();
  const away = element("p", { class: "quiet" });
  let isThere = false;
  const text = `Bring the tool to x = ${goal.x}, y = ${goal.y}, at ${goal.degrees}°: drag it, or use the sliders.`;
  return {
    root: exercise(text, () => undefined, away, answer.root),
    update() {
      const { q } = services.store.get();
      const { arm } = context.shown;
      const fits = q !== null && arm.planar && q.length === arm.dof;
      const extent = fits ? around : [];
      services.draw({ waypoints: fits ? [{ pose: target, label: "target", held: false }] : [], extent });
      const found = fits ? checkReach(arm.forward(q).at(-1) ?? [], goal) : { solved: false, says: "" };
      away.textContent = found.solved ? "" : found.says;
      if (found.solved !== isThere) answer.show(found.solved ? found : { solved: false, says: "" });
      isThere = found.solved;
    },
  };
}

let fields = 0;

/** A question that is answered in one line. */
function question(label: string, text: string, check: (typed: string) => Verdict, placeholder = ""): HTMLElement {
  const answer = verdict();
  const id = `answer-${++fields}`;
  const input = element("input", { id, spellcheck: "false", autocomplete: "off", autocapitalize: "off", placeholder });
  input.addEventListener("input", () => answer.show({ solved: false, says: "" }));
  const row = element("p", { class: "formula" }, element("label", { for: id }, label), input);
  return exercise(text, () => answer.show(check(input.value)), row, checkButton(), answer.root);
}

/** The arm is brought into a singular configuration, which is measured while it moves; then the direction is asked for. */
function singular(context: ExerciseContext): Exercise {
  const measure = element("p", { class: "quiet" });
  const root = question(
    "Direction",
    "Bring the arm rrr into a configuration where J is singular. Joint 3 then cannot move in one direction: " +
      "type its angle against the x axis.",
    (typed) => {
      const { arm, q } = context.services.store.get();
      return checkLost(typed, sameArm(arm, { text: "rrr" }) ? (q ?? []) : null);
    },
    "30°",
  );
  root.querySelector(".formula")?.before(measure);
  return {
    root,
    update() {
      const { arm } = context.shown;
      const { q } = context.services.store.get();
      if (!q || q.length !== arm.dof) return;
      const least = arm.manipulability(q).singularValues.at(-1) ?? NaN;
      measure.textContent = `The smallest singular value of J is ${least.toFixed(2)}.`;
    },
  };
}

function constantJacobian({ arm }: ExerciseContext): Exercise {
  const text =
    "The Jacobian of this arm changes as the arm moves. Is that so for every arm? Name one whose Jacobian is constant.";
  const check = (typed: string): Verdict => {
    try {
      const made = arm(armTyped(typed));
      try {
        return checkConstantJacobian(made, Math.random);
      } finally {
        made.release();
      }
    } catch (error) {
      return { solved: false, says: (error as Error).message };
    }
  };
  return { root: question("Arm", text, check, "RRR:1,1,1") };
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

const rrrNames: Names = { joints: ["revolute", "revolute", "revolute"], lengths: [3.5, 3.5, 2] };

/** The exercises by the names that the lessons use. */
export const exercises: Record<string, (context: ExerciseContext) => Exercise> = {
  reach,
  gain,
  "draw-rp": () => drawingExercise(),
  rp: (context) =>
    formulaExercise(
      context,
      rpPose,
      "Where is the tool of this arm RP, whose link has the length 1? Type x, y and the angle in θ1 and d2, as you would " +
        "write them.",
    ),
  "formula-rp": (context) =>
    formulaExercise(
      context,
      rpPose,
      "Multiply the matrices of the RP arm out, as it was done above for the three-link arm, and type the result.",
    ),
  "rrr-entry": (context) =>
    formulaExercise(
      context,
      { arm: "rrr", names: rrrNames, asked: planarPose.slice(1, 2) },
      "Now without looking up: the y coordinate of the tool of the arm RRR. Use numbers, or L1, L2, L3; α and β are known.",
    ),
  "rp-jacobian": (context) =>
    formulaExercise(
      context,
      { ...rpPose, asked: rpJacobian },
      "Find the first two rows of the Jacobian of the RP arm, whose pose you know from lesson 3.",
    ),
  "constant-jacobian": constantJacobian,
  singular,
  string: () => ({
    root: question(
      "Joints",
      "A gantry carries a gripper along x, along y, and up and down, and never turns it. Which string names its joints?",
      (typed) => checkString(typed, "PPP"),
    ),
  }),
  elbow: () => ({
    root: question("θ₂", "The tool of the arm RRR is to be at (5.5, 3.5, 0°). Which angle has joint 2?", (typed) =>
      checkAngle(typed, 90, 180, { joints: [] }, []),
    ),
  }),
  screw: () => ({
    root: question("v_y", "Why is the last number of S₃ what it is? Work out v_y of the third axis.", (typed) =>
      checkNumbers(typed, [-7], rrrNames),
    ),
  }),
  "body-column": () => ({
    root: question("Column", "Which is the third column of the body Jacobian, in x, y and θ?", (typed) =>
      checkNumbers(typed, [0, 2, 1], rrrNames),
    ),
  }),
  spare: () => ({
    root: question(
      "Joints",
      "How many joints does an arm in space have that has one more than a pose needs?",
      (typed) => checkCount(typed, 7),
    ),
  }),
  ominus: () => ({
    root: question("Angle", "Compute −100° ⊖ 150°.", (typed) => checkAngle(typed, 110, 0, { joints: [] }, [])),
  }),
};
