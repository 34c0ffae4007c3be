import type { JointDescription } from "../core/description.js";
import { element, shown } from "../elements/element.js";
import { unitOf } from "../elements/units.js";
import { reasonInWords, type Reason, type Wording } from "./reasons/reasons.js";

/** What the page uses of what `beeline ik --json` prints. */
export interface InverseAnswer extends Reason {
  status: string;
  solutions: number[][];
  singular: boolean;
  complete: boolean;
  /** Dimension of the motions of the joints that keep the tool at rest. */
  self_motion_dimension: number;
  method: string;
  /** Solutions that hit something or come too close, with what they hit; of a question in a scene. */
  blocked?: (Reason & { q: number[] })[];
}

const same = 1e-6;

/** Whether two lists of joint values are one configuration. */
function isSame(a: number[], b: number[]): boolean {
  return a.every((value, k) => Math.abs(value - (b[k] ?? 0)) < same);
}

/** The solutions of an answer with the present joint values first, which a sample of infinitely many may lack. */
export function withPresent(solutions: number[][], q: number[]): number[][] {
  return [q, ...solutions.filter((other) => !isSame(other, q))];
}

/** All solutions of inverse kinematics for the tool's pose, the present one first; a click goes there, and the list stays
 * as it is. */
export class SolutionsPanel {
  readonly root = element("section", { class: "solutions", "aria-label": "Inverse kinematics" });
  private readonly status = element("p", { role: "status" });
  private readonly list = element("ol");
  private items: { q: number[]; button: HTMLButtonElement }[] = [];
  private present = 0;

  /** `pointed` gets the solution under the mouse or with the focus; null: none, or the present one. */
  constructor(
    private readonly chosen: (q: number[]) => void,
    private readonly pointed: (q: number[] | null) => void,
  ) {
    this.root.append(this.status, this.list);
  }

  /** `q`: the present joint values, which solve the pose. */
  show(answer: InverseAnswer, q: number[], joints: JointDescription[], wording: Wording): void {
    this.status.textContent = inWords(answer, wording);
    const { solutions, blocked = [] } = answer;
    const all = [...solutions, ...blocked.map((one) => one.q)];
    const rows = all.length === 0 ? [] : withPresent(all, q);
    this.items = rows.map((row, index) => ({ q: row, button: this.button(row, index, joints, wording.degrees) }));
    this.list.replaceChildren(
      ...this.items.map(({ button, q: row }) => {
        const why = blocked.find((one) => isSame(one.q, row));
        return element(
          "li",
          {},
          button,
          ...(why ? [element("p", { class: "over" }, reasonInWords(why, wording))] : []),
        );
      }),
    );
    this.mark(q);
  }

  /** Marks the solution of the list where the arm is now; false: it is at none of them. */
  mark(q: number[]): boolean {
    const index = this.items.findIndex((item) => isSame(item.q, q));
    if (index < 0) return false;
    this.present = index;
    this.items.forEach(({ button }, i) => {
      if (i === index) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
      button.title = i === index ? "The arm is here now" : "Go there";
    });
    return true;
  }

  /** Says why the pose that was asked for is not reached. */
  refuse(reason: string): void {
    this.status.textContent = reason;
    this.items = [];
    this.list.replaceChildren();
  }

  clear(): void {
    this.refuse("");
  }

  private button(q: number[], index: number, joints: JointDescription[], degrees: boolean): HTMLButtonElement {
    const text = q.map((value, k) => {
      const unit = unitOf(joints[k]?.type ?? "revolute", degrees);
      return shown(value * unit.factor, unit.name === "°" ? 1 : 3);
    });
    const point = (): void => this.pointed(index === this.present ? null : q);
    const leave = (): void => this.pointed(null);
    return element(
      "button",
      {
        type: "button",
        onclick: () => this.chosen(q),
        onmouseenter: point,
        onmouseleave: leave,
        onfocus: point,
        onblur: leave,
      },
      text.join(", "),
    );
  }
}

/** How many solutions there are, how they were found, and whether they are all. */
export function inWords(answer: InverseAnswer, wording: Wording): string {
  const { solutions, complete, self_motion_dimension: free, method, singular } = answer;
  const count = solutions.length;
  const { length: hits } = answer.blocked ?? [];
  const reason = reasonInWords(answer, wording);
  if (count === 0) return reason;
  const blocked = hits === 0 ? "" : ` ${hits} more ${hits === 1 ? "is" : "are"} blocked.`;
  const many = count === 1 ? "1 solution" : `${count} solutions`;
  const all = count === 1 ? ", the only one" : ", all that exist";
  const found =
    free > 0 ? `Infinitely many solutions, a sample of ${count}` : `${many}${complete && hits === 0 ? all : ""}`;
  const by = method === "numerical" ? "a numerical search" : method;
  return `${found}, by ${by}.${blocked} ${singular ? reason : ""}`.trim();
}
