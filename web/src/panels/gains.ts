import type { Gains } from "../core/types.js";
import { element } from "./element.js";

interface Gain {
  key: keyof Gains;
  letter: string;
  name: string;
  min: number;
  max: number;
}

const all: Gain[] = [
  { key: "kp", letter: "p", name: "proportional", min: 0.01, max: 2.5 },
  { key: "ki", letter: "i", name: "integral", min: 0, max: 0.5 },
  { key: "kd", letter: "d", name: "derivative", min: 0, max: 1 },
];

/** A slider and a number for each gain of a PID controller. */
export class GainsPanel {
  readonly root = element("fieldset", { class: "gains" }, element("legend", {}, "Gains, per step"));
  private readonly fields = new Map<keyof Gains, { slider: HTMLInputElement; number: HTMLInputElement }>();

  constructor(changed: (key: keyof Gains, value: number) => void) {
    for (const { key, letter, name, min, max } of all) {
      const label = `K${letter}, ${name} gain`;
      const id = `gain-${key}`;
      const slider = element("input", { type: "range", "aria-label": `${label}, slider`, min, max, step: 0.01 });
      const number = element("input", { type: "number", id, "aria-label": label, min, max, step: "any" });
      slider.addEventListener("input", () => changed(key, Number(slider.value)));
      number.addEventListener("change", () => {
        if (number.value === "") return;
        const value = Math.min(max, Math.max(min, Number(number.value)));
        number.value = String(value);
        changed(key, value);
      });
      this.fields.set(key, { slider, number });
      const title = element("label", { for: id }, element("i", {}, "K", element("sub", {}, letter)), ` ${name}`);
      this.root.append(element("div", { class: "joint" }, title, slider, number));
    }
  }

  show(gains: Gains): void {
    for (const [key, { slider, number }] of this.fields) {
      const value = gains[key] ?? 0;
      slider.value = String(value);
      if (document.activeElement !== number) number.value = String(value);
    }
  }
}
