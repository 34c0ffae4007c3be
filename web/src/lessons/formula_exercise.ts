import { poseOfRpy } from "../core/pose.js";
import { element } from "../elements/element.js";
import { sameArm } from "../state/page_state.js";
import { checkButton, exercise, judged, typedText, verdict, type Exercise, type ExerciseContext } from "./exercise.js";
import { mathOf, valueOf, type Expression } from "./expression.js";
import { readFormula } from "./formula.js";
import { planarPose } from "./formula_checks.js";
import type { FormulaTask } from "./judges.js";

/** A field for a formula, and beside it the formula typeset as it was read. */
interface Field {
  root: HTMLElement;
  input: HTMLInputElement;
  /** null while it cannot be read. */
  formula: Expression | null;
}

let made = 0;

function field(name: string, { names, example }: FormulaTask, changed: () => void): Field {
  const id = `formula-${++made}`;
  const placeholder = `e.g. ${example}`;
  const input = element("input", { ...typedText, id, placeholder });
  const typeset = element("output", { class: "typeset", for: id, "aria-live": "off" });
  const root = element("p", { class: "formula" }, element("label", { for: id }, `${name} =`), input, typeset);
  const one: Field = { root, input, formula: null };
  input.addEventListener("input", () => {
    try {
      one.formula = readFormula(input.value, names);
    } catch {
      one.formula = null; // it is being typed: the check says what is wrong
    }
    typeset.innerHTML = one.formula ? `<math>${mathOf(one.formula)}</math>` : ""; // only what was read
    changed();
  });
  return one;
}

/** An exercise that asks for formulas. Where they are the pose of the tool, the picture of that arm has the pose that
 * they describe, also while it moves. */
export function formulaExercise(context: ExerciseContext, exerciseName: string, task: FormulaTask): Exercise {
  const { arm, asked, start } = task;
  const { services } = context;
  const answer = verdict();
  let at: number[] | undefined;
  const show = (q: number[] | null): void => {
    const isThere = sameArm(services.store.get().arm, { text: arm });
    services.store.set(isThere ? { q: q ?? services.store.get().q } : { arm: { text: arm }, q, goal: null });
  };
  const setArm = element("button", { type: "button", onclick: () => show(start ?? null) }, "Show this arm");
  const setPlace = element(
    "button",
    { type: "button", hidden: true, onclick: () => show(at ?? null) },
    "Show it there",
  );
  const draw = (): void => {
    const { q, arm: source } = services.store.get();
    const isThere = sameArm(source, { text: arm });
    setArm.hidden = isThere;
    if (asked !== planarPose) return;
    const values = fields.map(({ formula }) => (formula && q ? valueOf(formula, q) : NaN));
    const [x = NaN, y = NaN, angle = NaN] = values;
    const isDrawn = isThere && values.every(Number.isFinite);
    const pose = isDrawn ? [{ pose: poseOfRpy([x, y, 0, 0, 0, angle]), label: "your formula", held: false }] : [];
    services.draw({ waypoints: pose });
  };
  const changed = (): void => {
    answer.show({ solved: false, says: "" }); // it was for other formulas
    setPlace.hidden = true;
    draw();
  };
  const fields: Field[] = asked.map(({ name }) => field(name, task, changed));
  const typed = (): string => fields.map(({ input }) => input.value.replaceAll(";", " ")).join("; ");
  const check = (): void => {
    const found = judged(context, exerciseName, typed());
    at = found.at;
    setPlace.hidden = at === undefined;
    answer.show(found);
  };
  const rows = fields.map(({ root }) => root);
  const root = exercise(check, ...rows, checkButton(setArm, setPlace), answer.root);
  return { root, arm, start, update: draw, answer: typed };
}
