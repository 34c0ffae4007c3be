import type { JointDescription } from "../core/description.js";
import { element } from "./element.js";
import { unitOf, type Unit } from "./units.js";

/** Limits of a slider where the joint has none, radians or metres. */
const open = { revolute: Math.PI, prismatic: 1 };

interface Row {
  slider: HTMLInputElement;
  number: HTMLInputElement;
  unit: Unit;
}

/** A slider and a number for each coordinate, within its limits. */
export class JointsPanel {
  readonly root = element("fieldset", { class: "joints" });
  private rows: Row[] = [];
  private q: number[] = [];

  constructor(private readonly changed: (q: number[]) => void) {}

  /** Shows sliders for other joints, or in other units. */
  describe(joints: JointDescription[], degrees: boolean): void {
    this.rows = joints.map((joint) => this.row(joint, degrees));
    this.root.replaceChildren(
      element("legend", {}, "Joints"),
      ...this.rows.map((row, i) => {
        const joint = joints[i] as JointDescription;
        const id = `joint-${i}`;
        row.number.id = id;
        return element(
          "div",
          { class: "joint" },
          element("label", { for: id }, joint.name),
          row.slider,
          row.number,
          element("span", { class: "unit", "aria-hidden": "true" }, row.unit.name),
        );
      }),
    );
  }

  show(q: number[]): void {
    this.q = q;
    this.rows.forEach(({ slider, number, unit }, i) => {
      const value = (q[i] ?? 0) * unit.factor;
      slider.value = String(value);
      if (document.activeElement !== number) number.value = value.toFixed(unit.digits);
    });
  }

  private row(joint: JointDescription, degrees: boolean): Row {
    const unit = unitOf(joint.type, degrees);
    const span = joint.type === "prismatic" ? open.prismatic : open.revolute;
    const lower = (joint.limits.lower ?? -span) * unit.factor;
    const upper = (joint.limits.upper ?? span) * unit.factor;
    const range = { min: lower, max: upper, step: "any" };
    const label = `${joint.name}, ${unit.name === "°" ? "degrees" : unit.name}`;
    const slider = element("input", { type: "range", "aria-label": `${label}, slider`, ...range });
    const number = element("input", { type: "number", "aria-label": label, ...range });
    const take = (from: HTMLInputElement): void => {
      if (from.value === "") return;
      const value = Math.min(upper, Math.max(lower, Number(from.value)));
      number.value = value.toFixed(unit.digits);
      slider.value = String(value);
      const k = this.rows.findIndex((row) => row.slider === slider);
      this.changed(this.q.with(k, value / unit.factor));
    };
    slider.addEventListener("input", () => take(slider));
    number.addEventListener("change", () => take(number));
    return { slider, number, unit };
  }
}
