import type { FunctionName } from "./expression.js";

/** A piece of a formula. `index`: the digits behind a letter, empty without any. */
export type Token = { text: string; spaced: boolean } & (
  | { kind: "number" }
  | { kind: "sign" }
  | { kind: "function"; name: FunctionName }
  | { kind: "fraction" }
  | { kind: "pi" }
  /** q1, θ₁, d2; θ alone. */
  | { kind: "joint"; letter: "q" | "θ" | "d"; index: string }
  /** c12, the cosine of θ1 + θ2. */
  | { kind: "short"; name: "cos" | "sin"; index: string }
  /** The length of a link: L1, a_1. */
  | { kind: "length"; letter: string; index: string }
  | { kind: "sum of angles"; letter: "α" | "β" }
  | { kind: "unknown" }
);

const index = "(?:‹(\\d+)›|(\\d+))";
const theta = "θ|theta|th";

/** What is tried at each place, in this order. */
const kinds: [RegExp, (match: RegExpExecArray) => Omit<Token, "text" | "spaced">][] = [
  [/(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?/y, () => ({ kind: "number" })],
  [/(sin|sen|cos|tan|sqrt|√)/y, ([, name]) => ({ kind: "function", name: functionOf(name ?? "") })],
  [/[dt]?frac/y, () => ({ kind: "fraction" })],
  [/pi|π/y, () => ({ kind: "pi" })],
  [
    new RegExp(`(q|${theta}|d(?!eg))(?:\\s*${index})?`, "y"),
    ([, letter = "", braced, digits]) => ({
      kind: "joint",
      letter: letter === "q" || letter === "d" ? letter : "θ",
      index: braced ?? digits ?? "",
    }),
  ],
  [
    new RegExp(`([cs])${index}`, "y"),
    ([, letter, braced, digits]) => ({ kind: "short", name: longName(letter), index: braced ?? digits ?? "" }),
  ],
  [new RegExp(`([cs])_?(?=\\s*[(q]|${theta})`, "y"), ([, letter]) => ({ kind: "function", name: longName(letter) })],
  [
    new RegExp(`([al])${index}`, "y"),
    ([, letter, braced, digits]) => ({
      kind: "length",
      letter: letter === "a" ? "a" : "L",
      index: braced ?? digits ?? "",
    }),
  ],
  [/(α|alpha|β|beta)/y, ([, name = ""]) => ({ kind: "sum of angles", letter: /^[αa]/.test(name) ? "α" : "β" })],
  [/\*\*|[-+*/^()°]/y, () => ({ kind: "sign" })],
  [/deg(?:rees?)?/y, () => ({ kind: "sign" })],
  [/[a-zα-ω]+|./suy, () => ({ kind: "unknown" })],
];

function functionOf(name: string): FunctionName {
  return name === "sen" ? "sin" : name === "√" ? "sqrt" : (name as FunctionName);
}

function longName(letter = ""): "cos" | "sin" {
  return letter === "c" ? "cos" : "sin";
}

/** A text without the full stop or semicolon at its end. */
export function withoutEnd(text: string): string {
  return text.trimEnd().replace(/[.;]$/, "").trimEnd();
}

/** What stands behind the last =, which is not part of another sign, such as != or >=. */
export function behindSign(text: string): string {
  const at = text.lastIndexOf("=");
  return at > 0 && "!<>".includes(text[at - 1] ?? "") ? text : text.slice(at + 1);
}

/** One way to write what can be written in many: in plain text, as books are set, in LaTeX. */
function plain(text: string): string {
  return behindSign(withoutEnd(text)) // x = …
    .replace(/^\s*\w+\s*:/, "")
    .replace(/[₀-₉]+/g, (digits) => `‹${digits.normalize("NFKC")}›`)
    .replace(/[⁰¹²³⁴-⁹]+/g, (digits) => `^${digits.normalize("NFKC")} `)
    .replace(/[º˚]/g, "°")
    .replace(/(?<![a-zα-ω_›\d.,])(\d+)\s*([¼-¾⅐-⅞])/giu, "($1+$2)") // 3½ is a sum
    .replace(/(?<=\d\s*)[¼-¾⅐-⅞]/g, " $&") // no digit of the number or index in front of it
    .replace(/(?<!\d\s*)[¼-¾⅐-⅞]/g, "($&)")
    .replace(/[\u2061-\u2064\u200b]/g, "") // invisible signs
    .normalize("NFKC")
    .toLowerCase()
    .replace(/\\(?:left|right|,|;|!|:|quad)/g, " ")
    .replace(/\\(?:cdot|times)|[·×∙⋅∗•]/g, "*")
    .replace(/\\circ/g, "°")
    .replace(/\^\s*\{?\s*°\s*\}?/g, "°")
    .replace(/[÷∕⁄]/g, "/")
    .replace(/[−–—‒‐]/g, "-")
    .replace(/\\/g, "")
    .replace(/frac\s*(\d)\s*(\d)/g, "frac($1)($2)")
    .replace(/_\s*\{\s*([\d\s+,]+)\}/g, (_, digits: string) => `‹${digits.replace(/\D/g, "")}›`)
    .replace(/(?<=(?<![a-z])[qθdcsal])\{(\d+)\}/g, "‹$1›")
    .replace(/_\s*(\d+)/g, "‹$1›")
    .replace(/(\d),(?=\d)/g, "$1.")
    .replace(/[[{]/g, "(")
    .replace(/[\]}]/g, ")");
}

/** The pieces of a formula, without blanks. */
export function tokensOf(text: string): Token[] {
  const written = plain(text);
  const tokens: Token[] = [];
  for (let at = 0; at < written.length;) {
    const blank = /\s*/y;
    blank.lastIndex = at;
    const spaced = blank.exec(written)?.[0] ?? "";
    at += spaced.length;
    if (at >= written.length) break;
    for (const [pattern, make] of kinds) {
      pattern.lastIndex = at;
      const match = pattern.exec(written);
      if (!match) continue;
      const text = signOf(match[0]);
      tokens.push({ ...make(match), text, spaced: spaced !== "" } as Token);
      at += match[0].length;
      break;
    }
  }
  return tokens;
}

function signOf(text: string): string {
  return text === "**" ? "^" : text.startsWith("deg") ? "°" : text;
}
