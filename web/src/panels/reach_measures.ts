import type { Measure } from "../core/reach.js";
import { shown } from "../elements/element.js";

/** How a measure of the positions of a map is shown. */
interface Shape {
  title: string;
  /** Below its colours. */
  caption: string;
  /** What a value is multiplied by. */
  factor: number;
  unit: string;
  digits: number;
}

/** `orientations`: what a map has at each position. */
export function shapeOf(measure: Measure, orientations: string): Shape {
  switch (measure) {
    case "directions":
      return { title: `${orientations} reached`, caption: `of the ${orientations}`, factor: 100, unit: "%", digits: 0 };
    case "branches":
      return { title: "branches", caption: "solutions within the limits, at most", factor: 1, unit: "", digits: 0 };
    case "manipulability":
      return { title: "manipulability", caption: "at most, metres and radians", factor: 1, unit: "", digits: 3 };
    case "margin":
      return {
        title: "margin to the limits",
        caption: "at most: 100\u00a0% in the middle of all joint ranges, 0\u00a0% at a limit",
        factor: 100,
        unit: "%",
        digits: 0,
      };
  }
}

/** A value of a measure with its unit. */
export function measureText(value: number, { factor, unit, digits }: Shape): string {
  return `${shown(factor * value, digits)}${unit === "" ? "" : `\u00a0${unit}`}`;
}
