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
