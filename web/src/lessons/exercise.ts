import { element } from "../elements/element.js";
import type { Services, Shown } from "../page/section.js";
import type { Verdict } from "./checks.js";
import { longestFormula } from "./formula.js";
import { judges } from "./judges.js";

/** What an exercise needs of the page. */
export interface ExerciseContext {
  services: Services;
  shown: Shown;
  /** The arm of a joint string or a built-in name, to compare with; release it. */
  arm(text: string): Shown["arm"];
}

/** An exercise in a lesson. Its task, hints and solution stand in the lesson's text. */
export interface Exercise {
  root: HTMLElement;
  /** The answer as it stands, as its judge reads it. */
  answer(): string;
  /** The arm that it shows, where that is not the lesson's, and its first configuration. */
  arm?: string;
  start?: number[] | undefined;
  /** The arm that it shows once it is solved. */
  solvedArm?: string;
  /** The arm has moved, or the lesson was opened. */
  update?(): void;
}

export function verdict(): { root: HTMLElement; show(verdict: Verdict): void } {
  const root = element("p", { role: "status" });
  return {
    root,
    show({ solved, says }) {
      root.className = solved ? "solved" : "";
      root.textContent = says;
      if (solved) root.dispatchEvent(new CustomEvent("solved", { bubbles: true }));
    },
  };
}

/** Attributes of a field in which an answer is typed. */
export const typedText = { spellcheck: "false", autocomplete: "off", autocapitalize: "off", maxlength: longestFormula };

/** A form: Enter checks as the button does. */
export function exercise(check: () => void, ...children: HTMLElement[]): HTMLElement {
  const form = element("form", { class: "exercise", "aria-label": "Exercise", novalidate: true });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    check();
  });
  form.append(element("h2", {}, "Exercise"), ...children);
  return form;
}

/** The verdict on an answer to an exercise. */
export function judged(context: ExerciseContext, name: string, answer: string): Verdict {
  const judge = judges[name];
  if (!judge) throw new Error(`no judge for the exercise ${name}`);
  return judge(answer, { arm: (text) => context.arm(text), random: Math.random });
}

export function checkButton(...others: HTMLElement[]): HTMLElement {
  return element("p", { class: "pair" }, element("button", {}, "Check"), ...others);
}
