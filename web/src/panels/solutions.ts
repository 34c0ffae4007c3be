import type { JointDescription } from "../core/description.js";
import { element, shown } from "../elements/element.js";
import { unitOf } from "../elements/units.js";

/** What the page uses of what `beeline ik --json` prints. */
export interface InverseAnswer {
  status: string;
  solutions: number[][];
  singular: boolean;
  complete: boolean;
  /** Dimension of the motions of the joints that keep the tool at rest. */
  self_motion_dimension: number;
  reason: string;
  /** The kind of the reason, and its numbers, m. */
  code: string | null;
  fields: { distance?: number; nearest?: number[] };
  method: string;
}

const same = 1e-6;

/** The solutions of an answer with the present joint values first, which a sample of infinitely many may lack. */
export function withPresent(solutions: number[][], q: number[]): number[][] {
  const isPresent = (other: number[]): boolean => other.every((value, k) => Math.abs(value - (q[k] ?? 0)) < same);
  return [q, ...solutions.filter((other) => !isPresent(other))];
}

/** All solutions of inverse kinematics for the tool's pose; a click goes there. */
export class SolutionsPanel {
  readonly root = element("section", { class: "solutions", "aria-label": "Inverse kinematics" });
  private readonly status = element("p", { role: "status" });
  private readonly list = element("ol");

  /** `pointed` gets the index of the solution under the mouse or with the focus, 0 the present one; null: none. */
  constructor(
    private readonly chosen: (q: number[]) => void,
    private readonly pointed: (index: number | null) => void,
  ) {
    this.root.append(this.status, this.list);
  }

  /** `q`: the present joint values, which solve the pose. */
  show(answer: InverseAnswer, q: number[], joints: JointDescription[], degrees: boolean): void {
    this.status.textContent = inWords(answer);
    const rows = answer.solutions.length === 0 ? [] : withPresent(answer.solutions, q);
    this.list.replaceChildren(...rows.map((row, index) => this.item(row, index, joints, degrees)));
  }

  /** Says why the pose that was asked for is not reached. */
  refuse(reason: string): void {
    this.status.textContent = reason;
    this.list.replaceChildren();
  }

  clear(): void {
    this.refuse("");
  }

  private item(q: number[], index: number, joints: JointDescription[], degrees: boolean): HTMLElement {
    const text = q.map((value, k) => {
      const unit = unitOf(joints[k]?.type ?? "revolute", degrees);
      return shown(value * unit.factor, unit.name === "°" ? 1 : 3);
    });
    const button = element(
      "button",
      {
        type: "button",
        ...(index === 0 ? { "aria-current": "true", title: "The arm is here now" } : { title: "Go there" }),
        onclick: () => this.chosen(q),
        onmouseenter: () => this.pointed(index),
        onmouseleave: () => this.pointed(null),
        onfocus: () => this.pointed(index),
        onblur: () => this.pointed(null),
      },
      text.join(", "),
    );
    return element("li", {}, button);
  }
}

function inWords({
  solutions,
  complete,
  self_motion_dimension: free,
  method,
  singular,
  reason,
}: InverseAnswer): string {
  const count = solutions.length;
  const by = method === "numerical" ? "a numerical search" : method;
  if (count === 0) return reason;
  const many = count === 1 ? "1 solution" : `${count} solutions`;
  if (free > 0) return `Infinitely many solutions, a sample of ${count}, by ${by}. ${singular ? reason : ""}`.trim();
  return `${many}${complete ? ", all that exist" : ""}, by ${by}. ${singular ? reason : ""}`.trim();
}
