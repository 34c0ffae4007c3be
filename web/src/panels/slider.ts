import { element } from "../elements/element.js";

/** A slider whose track is filled up to its value. */
export function slider(attributes: Record<string, string | number | boolean>): HTMLInputElement {
  const made = element("input", { ...attributes, type: "range" });
  made.addEventListener("input", () => fill(made));
  fill(made);
  return made;
}

/** Moves a slider to a value. */
export function slide(range: HTMLInputElement, value: number): void {
  range.value = String(value);
  fill(range);
}

/** Fills the track from 0, or from the end that is next to 0, up to the value. */
function fill(range: HTMLInputElement): void {
  const [min, max, value] = [Number(range.min), Number(range.max), Number(range.value)];
  const part = (at: number): number => Math.min(100, Math.max(0, (100 * (at - min)) / (max - min || 1)));
  const [a, b] = [part(0), part(value)].sort((x, y) => x - y) as [number, number];
  range.style.setProperty("--from", `${a.toFixed(2)}%`);
  range.style.setProperty("--to", `${b.toFixed(2)}%`);
}
