import { valueOf } from "./expression.js";
import { readFormula, type Names } from "./formula.js";
import { behindSign, withoutEnd } from "./formula_tokens.js";
import { trimmed } from "./trimming.js";

/** A typed line with single blanks and without its end. What follows it takes time in proportion to its length. */
export function line(text: string): string {
  return withoutEnd(text.replace(/\s+/g, " ")).trim();
}

const articles = /^(?:an?|the) /i;
const kindOfThing = / (?:arm|robot|manipulator|joints?)$/i;

/** The joint string or name that somebody has typed: pp, P-P, 3P, a gantry, rrr 3.5 3.5 2. */
export function armTyped(text: string): string {
  const plain = line(text).replace(articles, "").replace(kindOfThing, "");
  const [, joints, lengths = ""] = /^([rpsche][rpsche ,–-]*?)[ :([]+([\d.][\d .,;]*)[)\]]?$/i.exec(plain) ?? [];
  if (joints !== undefined) {
    const letters = joints.replace(/[ ,–-]+/g, "").toUpperCase();
    const items = itemsOf(lengths).map((item) => item.replace(",", "."));
    return `${letters}:${(items.length === letters.length ? items : lengths.trim().split(/[ ,;]+/)).join(",")}`;
  }
  if (/^(?:gantry|cartesian)\b/i.test(plain)) return "gantry";
  const letters = plain
    .replace(/prismatic/gi, "P")
    .replace(/revolute/gi, "R")
    .replace(/[ ,;–-]+/g, "")
    .replace(/([2-9])[x×]?([rpsche])/gi, (_, count: string, letter: string) => letter.repeat(Number(count)));
  return /^[rpsche]+$/i.test(letters) && !/^(?:rp|rrr)$/.test(plain) ? letters.toUpperCase() : plain;
}

/** An angle that was typed, degrees: a number is in degrees; with rad, π or the name of a joint in radians. */
export function angleTyped(text: string, names: Names, q: number[]): number {
  const typed = line(text);
  const formula = readFormula(typed.replace(/(?<=[\d)πi ])rad(?:ians?)?$/i, ""), names);
  const isNumber = /^[^a-zα-ωπ°]*$/i.test(typed.slice(typed.lastIndexOf("=") + 1));
  return valueOf(formula, q) * (isNumber ? 1 : 180 / Math.PI);
}

/** Angles with a comma, "or" or "and" between them, ±90 as two. */
export function anglesTyped(text: string): string[] {
  const parts = line(text).split(/[,;]|\bor\b|\band\b/i);
  const signed = /±|\+\s?\/?\s?[-−–]/;
  const both = parts.flatMap((part) =>
    signed.test(part) ? [part.replace(signed, ""), part.replace(signed, "-")] : [part],
  );
  return both.filter((part) => part.trim() !== "");
}

/** The numbers of a row or a column: (0, 2, 1), [0; 2; 1]^T, 0 2 1; with decimal commas where semicolons or blanks stand
 * between them. */
export function itemsOf(typed: string): string[] {
  const inner = trimmed(line(typed).replace(/(?:\^ ?T|[ᵀ⊤]|(?<=[)\]}] ?)T)$/, ""), "([{", ")]}");
  const items = inner.split(/ ?[;|] ?|, | /);
  return items.length === 1 ? inner.split(",") : items;
}

/** Numbers in the order of their labels: (0, 2, 1) or J = (0, 2, 1); where each has its label, x = 0, y = 2, θ = 1, in
 * whichever order. Throws where the labels are others. */
export function numbersTyped(text: string, labels: string[]): string[] {
  const typed = line(text);
  if (labels.length === 0 || typed.split("=").length <= 2) return itemsOf(behindSign(typed));
  const parts = typed.replace(/ ?= ?/g, "=").replace(/^[([{]|[)\]}]$/g, "");
  const pairs = itemsOf(parts).map((item) => item.split("="));
  const values = new Map(pairs.map(([label = "", value = ""]) => [label.trim().toLowerCase(), value]));
  const found = labels.map((label) => values.get(label));
  if (values.size !== labels.length || found.includes(undefined))
    throw new Error(`write the numbers of ${labels.join(", ")}, one after the other`);
  return found as string[];
}

/** The numbers in front of the signs = of an answer, where a name may stand: 7 = 18 is true for no answer. */
export function numbersBeforeSign(text: string): string[] {
  const sides = text.split("=").slice(0, -1);
  return sides.map((side) => side.trim()).filter((side) => /^[-+−–]?[\d.,]+ ?°?$/.test(side));
}

const below20 =
  "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen nineteen".split(
    " ",
  );
const tens = ["twenty", "thirty", "forty"];

/** The number below fifty that words name, thirty-two; -1: none. */
export function numberInWords(text: string): number {
  const below = below20.indexOf(text);
  if (below >= 0) return below;
  const [ten = "", one = "zero", ...others] = text.split(/[\s-]+/);
  const [high, low] = [tens.indexOf(ten), below20.indexOf(one)];
  return high < 0 || low < 0 || low > 9 || others.length > 0 ? -1 : 20 + 10 * high + low;
}
