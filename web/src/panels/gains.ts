import type { Gains } from "../core/types.js";
import { element } from "../elements/element.js";
import { gainRanges } from "../state/page_state.js";
import { slide, slider } from "./slider.js";

interface Gain {
  key: keyof Gains;
  letter: string;
  name: string;
  min: number;
  max: number;
}

const all: Gain[] = [
  { key: "kp", letter: "p", name: "proportional", ...gainRanges.gain },
  { key: "ki", letter: "i", name: "integral", ...gainRanges.ki },
  { key: "kd", letter: "d", name: "derivative", ...gainRanges.kd },
];

/** A slider and a number for each gain of a PID controller. */
export class GainsPanel {
  readonly root = element("fieldset", { class: "gains" }, element("legend", {}, "Gains, per step"));
  /** Which end of its range a typed gain was beyond. */
  private readonly note = element("p", { class: "quiet", role: "status" });
  private readonly fields = new Map<keyof Gains, { range: HTMLInputElement; number: HTMLInputElement }>();

  constructor(changed: (key: keyof Gains, value: number) => void) {
    for (const { key, letter, name, min, max } of all) {
      const label = `K${letter}, ${name} gain`;
      const id = `gain-${key}`;
      const range = slider({ "aria-label": `${label}, slider`, min, max, step: 0.01 });
      const number = element("input", { type: "number", id, "aria-label": label, min, max, step: "any" });
      range.addEventListener("input", () => {
        this.note.textContent = "";
        changed(key, Number(range.value));
      });
      number.addEventListener("change", () => {
        if (number.value === "") return;
        const value = Math.min(max, Math.max(min, Number(number.value)));
        const end = value === max ? "at most" : "at least";
        this.note.textContent = value === Number(number.value) ? "" : `K${letter} is ${end} ${value} here.`;
        number.value = String(value);
        changed(key, value);
      });
      this.fields.set(key, { range, number });
      const title = element("label", { for: id }, element("i", {}, "K", element("sub", {}, letter)), ` ${name}`);
      this.root.append(element("div", { class: "joint" }, title, range, number));
    }
    this.root.append(this.note);
  }

  show(gains: Gains): void {
    for (const [key, { range, number }] of this.fields) {
      const value = gains[key] ?? 0;
      slide(range, value);
      if (document.activeElement !== number) number.value = String(value);
    }
  }
}
