import { element, shown } from "./element.js";
import type { JointDescription } from "../core/description.js";
import { unitOf } from "./units.js";

/** What `beeline ik --json` prints. */
export interface InverseAnswer {
  status: string;
  solutions: number[][];
  singular: boolean;
  complete: boolean;
  residual: number;
  reason: string;
  nearest: { q: number[]; position_error: number; orientation_error: number } | null;
  method: string;
}

/** All solutions of inverse kinematics for the tool's pose; a click goes there. The reason, where there is none. */
export class SolutionsPanel {
  readonly root = element("section", { class: "solutions", "aria-label": "Inverse kinematics" });
  private readonly status = element("p", { role: "status" });
  private readonly list = element("ol");

  constructor(
    private readonly chosen: (q: number[]) => void,
    private readonly pointed: (index: number | null) => void,
  ) {
    this.root.append(this.status, this.list);
  }

  show(answer: InverseAnswer, joints: JointDescription[], degrees: boolean): void {
    const count = answer.solutions.length;
    this.status.textContent =
      count === 0
        ? answer.reason
        : `${count} solution${count === 1 ? "" : "s"}${answer.complete ? ", all that exist" : ""}, by ${answer.method}.` +
          (answer.singular ? ` ${answer.reason}` : "");
    this.list.replaceChildren(
      ...answer.solutions.map((q, index) => {
        const text = q.map((value, k) => {
          const unit = unitOf(joints[k]?.type ?? "revolute", degrees);
          return shown(value * unit.factor, unit.name === "°" ? 1 : 3);
        });
        const button = element(
          "button",
          {
            type: "button",
            onclick: () => this.chosen(q),
            onmouseenter: () => this.pointed(index),
            onmouseleave: () => this.pointed(null),
            onfocus: () => this.pointed(index),
            onblur: () => this.pointed(null),
          },
          text.join(", "),
        );
        return element("li", {}, button);
      }),
    );
  }

  /** Says why the pose that was asked for is not reached. */
  refuse(reason: string): void {
    this.status.textContent = reason;
    this.list.replaceChildren();
  }

  clear(): void {
    this.refuse("");
  }
}
