import { element } from "../panels/element.js";
import type { Services, Shown } from "../page/section.js";
import { stepResponse } from "../core/step_response.js";
import { checkConstantJacobian, checkGain, checkFormulas, checkReach, type Verdict } from "./checks.js";

/** What an exercise needs of the page. */
export interface ExerciseContext {
  services: Services;
  shown: Shown;
  /** The arm of a joint string or a built-in name, to compare with; release it. */
  arm(text: string): Shown["arm"];
}

function verdict(): { root: HTMLElement; show(verdict: Verdict): void } {
  const root = element("p", { role: "status" });
  return {
    root,
    show({ solved, says }) {
      root.className = solved ? "solved" : "";
      root.textContent = says;
    },
  };
}

function exercise(text: string, ...children: HTMLElement[]): HTMLElement {
  return element(
    "section",
    { class: "exercise", "aria-label": "Exercise" },
    element("h2", {}, "Exercise"),
    text,
    ...children,
  );
}

function reach(context: ExerciseContext): HTMLElement {
  const goal = { x: 2, y: 6, degrees: 45 };
  const answer = verdict();
  const check = (): void => {
    const { shown } = context; // now, not when the lesson was opened
    const { q } = context.services.store.get();
    const fits = q && shown.arm.planar && q.length === shown.arm.dof;
    if (!fits) return answer.show({ solved: false, says: "Set the arm rrr first." });
    answer.show(checkReach(shown.arm.forward(q).at(-1) as Float64Array, goal));
  };
  const text = `Bring the tool to x = ${goal.x}, y = ${goal.y}, at ${goal.degrees}°, with the sliders below or by hand.`;
  return exercise(text, element("p", {}, element("button", { type: "button", onclick: check }, "Check")), answer.root);
}

function formulas({ arm }: ExerciseContext, text: string): HTMLElement {
  const answer = verdict();
  const field = (label: string, id: string): [HTMLElement, HTMLInputElement] => {
    const input = element("input", { id, spellcheck: "false", autocomplete: "off" });
    return [element("p", { class: "formula" }, element("label", { for: id }, label), input), input];
  };
  const [rowX, x] = field("x =", "formula-x");
  const [rowY, y] = field("y =", "formula-y");
  const [rowAngle, angle] = field("θ =", "formula-angle");
  const check = (): void => {
    const rp = arm("rp");
    answer.show(checkFormulas({ x: x.value, y: y.value, angle: angle.value }, rp, Math.random));
    rp.release();
  };
  const button = element("button", { type: "button", onclick: check }, "Check");
  return exercise(text, rowX, rowY, rowAngle, element("p", {}, button), answer.root);
}

function constantJacobian({ arm }: ExerciseContext): HTMLElement {
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
  return exercise(
    "The Jacobian of this arm changes as the arm moves. Is that so for every arm? Name one whose Jacobian is constant.",
    element("p", { class: "formula" }, element("label", { for: "constant-arm" }, "Arm"), input),
    element("p", {}, element("button", { type: "button", onclick: check }, "Check")),
    answer.root,
  );
}

function gain(context: ExerciseContext): HTMLElement {
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
  return exercise(
    wanted,
    element("p", {}, element("button", { type: "button", onclick: check }, "Check")),
    answer.root,
  );
}

/** The exercises by the names that the lessons use. */
export const exercises: Record<string, (context: ExerciseContext) => HTMLElement> = {
  reach,
  gain,
  rp: (context) =>
    formulas(
      context,
      "Sketch an arm RP in the plane: a revolute joint, a link of length 1, then a prismatic joint along the link. Where " +
        "is its tool? Type x, y and the angle as formulas in q1 and q2: with sin, cos, + − * / ^ and brackets.",
    ),
  "formula-rp": (context) =>
    formulas(
      context,
      "Multiply the matrices of the RP arm out, as it was done above for the three-link arm, and type the result.",
    ),
  "constant-jacobian": constantJacobian,
};
