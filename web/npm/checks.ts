import { CoreError } from "../src/core/types.js";
import { inWords } from "../src/core/words.js";
import { Arm } from "./arm.js";

/** Numbers of joints, or of a pose. */
export type Numbers = ArrayLike<number>;

export const invalid = (message: string): CoreError => new CoreError(message, "invalid_argument");

export function requireArm(arm: unknown): void {
  if (!(arm instanceof Arm)) throw invalid(`arm is ${inWords(arm)}; it must be an arm of readArm()`);
  arm.core.requireUnreleased();
}

/** Refuses what is no object, and where the options of a method are known, other ones. */
export function requireOptions(what: string, options: unknown, known: readonly string[] | null = null): void {
  if (typeof options !== "object" || options === null || Array.isArray(options)) {
    throw invalid(`${what} is ${inWords(options)}; it must be an object`);
  }
  const other = known && Object.keys(options).find((name) => !known.includes(name));
  if (other) throw invalid(`${inWords(other)} is none of the ${what}; they are ${known.join(", ")}`);
}

/** Refuses an option that is given and has another type. */
export function requireType(name: string, value: unknown, type: "string" | "boolean"): void {
  const accepted = type === "string" ? "a text" : "true or false";
  if (value !== undefined && typeof value !== type)
    throw invalid(`${name} is ${inWords(value)}; it must be ${accepted}`);
}

/** The length of a list. `accepted` says what it must be. */
export function lengthOf(what: string, list: unknown, accepted: string): number {
  const length: unknown = typeof list === "object" && list !== null && "length" in list ? list.length : undefined;
  if (!Number.isSafeInteger(length) || (length as number) < 0) {
    throw invalid(`${what} is ${inWords(list)}; it must be a list of ${accepted}`);
  }
  return length as number;
}

/** The finite numbers of a list, whose length is checked before. */
export function finite(what: string, numbers: Numbers): number[] {
  const list = Array.from(numbers);
  const at = list.findIndex((value) => !Number.isFinite(value));
  if (at >= 0) throw invalid(`${what}[${at}] is ${inWords(list[at])}; it must be a finite number`);
  return list;
}
