import { poseOfRpy } from "../core/pose.js";
import { element } from "../elements/element.js";
import { sameArm } from "../state/page_state.js";
import { drawingExercise } from "./drawing_board.js";
import type { Verdict } from "./checks.js";
import { checkButton, exercise, judged, typedText, verdict, type Exercise, type ExerciseContext } from "./exercise.js";
import { formulaExercise } from "./formula_exercise.js";
import { anglesText, formulaTasks, reachGoal } from "./judges.js";

/** The target is in the picture, and it is checked while the arm moves. */
function reach(context: ExerciseContext): Exercise {
  const { services } = context;
  const target = poseOfRpy([reachGoal.x, reachGoal.y, 0, 0, 0, (reachGoal.degrees * Math.PI) / 180]);
  const around = [-1.2, 1.2].map((far) => [reachGoal.x + far, reachGoal.y + far, 0]); // its frame is in the picture too
  const answer = verdict();
  const away = element("p", { class: "quiet" });
  let isThere = false;
  const typed = (): string => anglesText(services.store.get().q ?? []);
  return {
    root: exercise(() => undefined, away, answer.root),
    answer: typed,
    update() {
      const fits = services.store.get().q !== null && sameArm(services.store.get().arm, { text: "rrr" });
      const extent = fits ? around : [];
      services.draw({ waypoints: fits ? [{ pose: target, label: "target", held: false }] : [], extent });
      const found = fits ? judged(context, "reach", typed()) : { solved: false, says: "" };
      away.textContent = found.solved ? "" : found.says;
      if (found.solved !== isThere) answer.show(found.solved ? found : none);
      isThere = found.solved;
    },
  };
}

let fields = 0;
const none: Verdict = { solved: false, says: "" };

/** A question that is answered in one line. `before`: what stands in front of the typed text in the answer; where it changes,
 * the verdict disappears. */
function question(
  context: ExerciseContext,
  name: string,
  label: string,
  placeholder = "",
  before: () => string = () => "",
): Exercise {
  const says = verdict();
  const id = `answer-${++fields}`;
  const input = element("input", { ...typedText, id, placeholder });
  input.addEventListener("input", () => says.show(none));
  const row = element("p", { class: "formula" }, element("label", { for: id }, label), input);
  const answer = (): string => before() + input.value;
  let judgedPrefix = "";
  const check = (): void => {
    judgedPrefix = before();
    says.show(judged(context, name, answer()));
  };
  const update = (): void => {
    if (before() !== judgedPrefix) says.show(none);
  };
  return { root: exercise(check, row, checkButton(), says.root), answer, update };
}

/** The arm is brought into a singular configuration, which is measured while it moves; then the direction is asked for. */
function singular(context: ExerciseContext): Exercise {
  const measure = element("p", { class: "quiet" });
  const configuration = (): string => {
    const { arm, q } = context.services.store.get();
    return `${sameArm(arm, { text: "rrr" }) ? anglesText(q ?? []) : ""} → `;
  };
  const made = question(context, "singular", "Direction", "30°", configuration);
  made.root.querySelector(".formula")?.before(measure);
  return {
    ...made,
    update() {
      made.update?.();
      const { arm } = context.shown;
      const { q } = context.services.store.get();
      if (!q || q.length !== arm.dof) return;
      const least = arm.manipulability(q).singularValues.at(-1) ?? NaN;
      measure.textContent = `The smallest singular value of J is ${least.toFixed(2)}.`;
    },
  };
}

/** The gain is the one of the figure above. */
function gain(context: ExerciseContext): Exercise {
  const says = verdict();
  const answer = (): string => String(context.services.store.get().gain);
  let judgedGain = "";
  const check = (): void => {
    judgedGain = answer();
    says.show(judged(context, "gain", judgedGain));
  };
  const update = (): void => {
    if (answer() !== judgedGain) says.show(none);
  };
  return { root: exercise(check, checkButton(), says.root), answer, update };
}

/** The Puma with its wrist singular: joint 5 is at 0. */
export const wristStart = [0.3, 0.5, 0.3, 0, 0, 0];

const one =
  (name: string, label: string, placeholder = "") =>
  (context: ExerciseContext): Exercise =>
    question(context, name, label, placeholder);

/** The figures that exercises are answered with, where these are shown alone. */
export const figureOf: Record<string, string> = { gain: "1.7", steps: "both-controls", intervals: "proof" };

/** The exercises by the names that the lessons use. */
export const exercises: Record<string, (context: ExerciseContext) => Exercise> = {
  reach,
  gain,
  singular,
  "draw-rp": drawingExercise,
  ...Object.fromEntries(
    Object.entries(formulaTasks).map(([name, task]) => [
      name,
      (context: ExerciseContext) => formulaExercise(context, name, task),
    ]),
  ),
  string: one("string", "Joints"),
  describe: one("describe", "Arm", "RRR:3.5,3.5,2"),
  "constant-jacobian": one("constant-jacobian", "Arm", "RRR:1,1,1"),
  ominus: one("ominus", "Angle"),
  steps: one("steps", "Steps"),
  elbow: one("elbow", "θ₂"),
  screw: one("screw", "v_y"),
  "body-column": one("body-column", "Column"),
  wrist: (context) => ({ ...question(context, "wrist", "Angle"), arm: "puma560", start: wristStart }),
  spare: one("spare", "Joints"),
  intervals: one("intervals", "Intervals"),
};
