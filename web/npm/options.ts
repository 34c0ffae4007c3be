import { inWords } from "../src/core/words.js";
import { finite, invalid, lengthOf, type Numbers } from "./checks.js";

export type OptionValue = string | number | boolean | Numbers | undefined;

/** Options of the command in camel case: {maxSamples: 9, all: true} is --max-samples=9 --all. T: the type of the object that
 * is given, which may be an interface. */
export type Options<T = Record<string, OptionValue>> = { [K in keyof T]: OptionValue };

const maxNumbers = 1000; // of an option: far more than an arm has joints

function typedValue(name: string, value: unknown): string {
  if (typeof value === "string" || typeof value === "number") return String(value);
  const accepted = `at most ${maxNumbers} numbers, or a text, a number, true or false`;
  const count = lengthOf(name, value, accepted);
  if (count > maxNumbers) throw invalid(`${name} has ${count} numbers; it must be ${accepted}`);
  return finite(name, value as Numbers).join(",");
}

export function typedOptions(options: Options): string[] {
  return Object.entries(options).flatMap(([name, value]) => {
    if (!/^[a-z][A-Za-z0-9]*$/.test(name)) {
      throw invalid(
        `${inWords(name)} is no option; options have the names of the command in camel case, such as maxSamples`,
      );
    }
    const option = `--${name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`;
    if (value === undefined || value === false) return [];
    return [value === true ? option : `${option}=${typedValue(name, value)}`];
  });
}
