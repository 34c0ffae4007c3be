import { shown } from "./element.js";

/** The unit in which a coordinate is shown. Radians and metres everywhere else. */
export interface Unit {
  name: string;
  factor: number;
  digits: number;
}

export function unitOf(type: string, degrees: boolean): Unit {
  if (type === "prismatic") return { name: "m", factor: 1, digits: 4 };
  return degrees ? { name: "°", factor: 180 / Math.PI, digits: 2 } : { name: "rad", factor: 1, digits: 4 };
}

/** A whole number as small figures below the line. */
export function subscript(value: number): string {
  return String(value).replace(/\d/g, (digit) => "₀₁₂₃₄₅₆₇₈₉"[Number(digit)] ?? digit);
}

type Size = readonly [name: string, size: number];
export const lengths: Size[] = [
  ["m", 1],
  ["mm", 1e-3],
  ["µm", 1e-6],
  ["nm", 1e-9],
];
export const angles: Size[] = [
  ["rad", 1],
  ["mrad", 1e-3],
  ["µrad", 1e-6],
  ["nrad", 1e-9],
];

/** A length, m, or an angle, rad, with about two digits in the unit that suits it; a bound is rounded up. */
export function small(value: number | null | undefined, units: Size[], rounding: "nearest" | "up" = "nearest"): string {
  if (value === null || value === undefined) return "—";
  const [name, size] = units.find(([, one]) => Math.abs(value) >= 0.9995 * one) ?? (units.at(-1) as Size);
  const number = value / size;
  const digits = Math.abs(number) < 9.95 ? 1 : 0;
  const tens = 10 ** digits;
  return `${shown(rounding === "up" ? Math.ceil(number * tens - 1e-9) / tens : number, digits)} ${name}`;
}

/** A distance between bodies, m, in millimetres, rounded down; a negative one as a depth. */
export function distance(value: number): string {
  const tenths = Math.floor(1e4 * value + 1e-6) / 10;
  return value < 0 ? `${shown(-tenths, 1)}\u00a0mm deep` : `${shown(tenths, 1)}\u00a0mm`;
}
