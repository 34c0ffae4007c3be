import { poseOfRpy } from "../core/pose.js";
import { element } from "../elements/element.js";
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

/** An exercise in a lesson. */
export interface Exercise {
  root: HTMLElement;
  /** The arm has moved, or the lesson was opened. */
  update?(): void;
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

/** A form: Enter checks as the button does. */
function exercise(text: string, check: () => void, ...children: HTMLElement[]): HTMLElement {
  const form = element("form", { class: "exercise", "aria-label": "Exercise", novalidate: true });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    check();
  });
  form.append(element("h2", {}, "Exercise"), element("p", {}, text), ...children);
  return form;
}

function checkButton(): HTMLElement {
  return element("p", {}, element("button", {}, "Check"));
}

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

function formulas({ arm }: ExerciseContext, text: string): Exercise {
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
  return { root: exercise(text, check, rowX, rowY, rowAngle, checkButton(), answer.root) };
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
    formulas(
      context,
      "Sketch an arm RP in the plane: a revolute joint, a link of length 1, then a prismatic joint along the link. Where " +
        "is its tool? Type x, y and the angle as formulas in q1 and q2, or θ1 and d2, as you would write them.",
    ),
  "formula-rp": (context) =>
    formulas(
      context,
      "Multiply the matrices of the RP arm out, as it was done above for the three-link arm, and type the result.",
    ),
  "constant-jacobian": constantJacobian,
};
