import type { JointDescription } from "../core/description.js";
import { element, shown, typed } from "../elements/element.js";
import { unitOf, type Unit } from "../elements/units.js";
import { jointColour } from "../scene/colours.js";
import { slide, slider } from "./slider.js";

/** How far a slider reaches from 0 where the joint has no limit, radians or metres. A number can be typed beyond. */
const open = { angle: 2 * Math.PI, length: 1 };

interface Row {
  range: HTMLInputElement;
  number: HTMLInputElement;
  unit: Unit;
}

/** A slider and a number for each coordinate, within its limits. */
export class JointsPanel {
  readonly root = element("fieldset", { class: "joints" });
  /** Further rows stand here. */
  readonly below = element("div");
  private rows: Row[] = [];
  private q: number[] = [];

  /** `changed` gets the joint values, and whether a slider was dragged to them: else a number was typed. */
  constructor(private readonly changed: (q: number[], isDragged: boolean) => void) {}

  /** Shows sliders for other joints, or in other units. */
  describe(joints: JointDescription[], degrees: boolean): void {
    this.rows = joints.map((joint) => this.row(joint, degrees));
    const names = shortened(joints.map(({ name }) => name));
    this.root.replaceChildren(
      element("legend", {}, "Joints"),
      ...this.rows.map((row, i) => {
        const joint = joints[i] as JointDescription;
        const id = `joint-${i}`;
        row.number.id = id;
        return element(
          "div",
          { class: "joint", style: `--joint: ${jointColour(i)}` },
          element("label", { for: id, title: joint.name }, element("span", { class: "name" }, names[i] ?? joint.name)),
          element("div", { class: "range" }, row.range, ends(joint, row.unit)),
          row.number,
          element("span", { class: "unit", "aria-hidden": "true" }, row.unit.name),
        );
      }),
      this.below,
      ...withoutLimits(joints),
    );
  }

  show(q: number[]): void {
    this.q = q;
    this.rows.forEach(({ range, number, unit }, i) => {
      const value = (q[i] ?? 0) * unit.factor;
      slide(range, value);
      if (document.activeElement !== number) number.value = typed(value, unit.digits);
    });
  }

  private row(joint: JointDescription, degrees: boolean): Row {
    const unit = unitOf(joint.type, degrees);
    const [lower, upper] = [joint.limits.lower ?? -Infinity, joint.limits.upper ?? Infinity];
    const span = joint.type === "prismatic" ? open.length : open.angle;
    const min = (lower > -Infinity ? lower : Math.min(-span, upper - span)) * unit.factor;
    const max = (upper < Infinity ? upper : Math.max(span, lower + span)) * unit.factor;
    const label = `${joint.name}, ${unit.name === "°" ? "degrees" : unit.name}`;
    const range = slider({ "aria-label": `${label}, slider`, min, max, step: "any" });
    const number = element("input", {
      type: "number",
      "aria-label": label,
      step: "any",
      min: lower > -Infinity && min,
      max: upper < Infinity && max,
    });
    const take = (from: HTMLInputElement): void => {
      if (from.value === "") return;
      const value = Math.min(upper * unit.factor, Math.max(lower * unit.factor, Number(from.value)));
      number.value = typed(value, unit.digits);
      slide(range, value);
      const k = this.rows.findIndex((row) => row.range === range);
      this.changed(this.q.with(k, value / unit.factor), from === range);
    };
    range.addEventListener("input", () => take(range));
    number.addEventListener("change", () => take(number));
    return { range, number, unit };
  }
}

const widest = 8; // letters that fit beside a slider

/** Names without the words, up to an underscore, that all of them begin with, where one of them is too long. */
function shortened(names: string[]): string[] {
  const [first = ""] = names;
  if (names.length < 2 || names.every((name) => name.length <= widest)) return names;
  const words = first.split(/(?<=_)/);
  let prefix = "";
  for (const word of words.slice(0, -1)) {
    if (!names.every((name) => name.startsWith(prefix + word) && name !== prefix + word)) break;
    prefix += word;
  }
  return names.map((name) => name.slice(prefix.length));
}

/** The limits below the ends of a slider; screen readers have them from the slider. */
function ends({ limits, type }: JointDescription, { factor, name }: Unit): HTMLElement {
  const digits = name === "°" ? 0 : type === "prismatic" ? 3 : 2;
  const text = (limit: number | null): string => (limit === null ? "" : shown(limit * factor, digits));
  const texts = [limits.lower, limits.upper].map((limit) => element("span", {}, text(limit)));
  return element("div", { class: "ends", "aria-hidden": "true" }, ...texts);
}

/** Says which joints have no limits, or one only. */
function withoutLimits(joints: JointDescription[]): HTMLElement[] {
  const names = joints
    .filter(({ limits }) => limits.lower === null || limits.upper === null)
    .map(({ name, limits }) => {
      if (limits.lower !== null) return `${name} (upper)`;
      return limits.upper !== null ? `${name} (lower)` : name;
    });
  if (names.length === 0) return [];
  const which = names.length === joints.length && names.length > 1 ? "all joints" : names.join(", ");
  return [element("p", { class: "quiet" }, `No limits: ${which}. Numbers beyond the slider can be typed.`)];
}
