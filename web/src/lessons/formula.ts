/** A formula that somebody typed, as a function of named numbers. */
export type Formula = (values: Record<string, number>) => number;

const functions: Record<string, (x: number) => number> = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  sqrt: Math.sqrt,
};
const constants: Record<string, number> = { pi: Math.PI };
const deepest = 100; // brackets in brackets
const longest = 1000; // characters

/** Reads a formula: numbers, names, + - * / ^, brackets, sin, cos, tan, sqrt, pi. Throws an Error that says what is
 * wrong. */
export function readFormula(text: string, names: string[]): Formula {
  if (text.length > longest) throw new Error(`a formula has at most ${longest} characters`);
  const tokens = text.match(/(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|[A-Za-z_]\w*|\S/g) ?? [];
  let at = 0;
  let depth = 0;
  const next = (): string | undefined => tokens[at];
  const take = (token: string): boolean => next() === token && ++at > 0;

  const sum = (): Formula => {
    let left = product();
    while (next() === "+" || next() === "-") {
      const [a, minus, b] = [left, tokens[at++] === "-", product()];
      left = (v) => (minus ? a(v) - b(v) : a(v) + b(v));
    }
    return left;
  };
  const product = (): Formula => {
    let left = signed();
    while (next() === "*" || next() === "/") {
      const [a, by, b] = [left, tokens[at++] === "/", signed()];
      left = (v) => (by ? a(v) / b(v) : a(v) * b(v));
    }
    return left;
  };
  const signed = (): Formula => {
    if (++depth > deepest) throw new Error("the formula has too many brackets or signs");
    const minus = take("-");
    if (!minus && !take("+")) {
      --depth;
      return power();
    }
    const value = signed();
    --depth;
    return minus ? (v) => -value(v) : value;
  };
  const power = (): Formula => {
    const base = factor();
    if (!take("^")) return base;
    const exponent = signed();
    return (v) => base(v) ** exponent(v);
  };
  const bracket = (): Formula => {
    if (!take("(")) throw new Error(`( is missing in front of ${next() ?? "the end"}`);
    if (++depth > deepest) throw new Error("the formula has too many brackets or signs");
    const inner = sum();
    if (!take(")")) throw new Error(`) is missing in front of ${next() ?? "the end"}`);
    --depth;
    return inner;
  };
  const factor = (): Formula => {
    const token = next();
    if (token === undefined) throw new Error("the formula ends too early");
    if (token === "(") return bracket();
    ++at;
    if (/^[\d.]/.test(token)) {
      const value = Number(token);
      if (!Number.isFinite(value)) throw new Error(`${token} is not a number`);
      return () => value;
    }
    const known = Object.hasOwn(functions, token) ? functions[token] : undefined;
    if (known) {
      const argument = bracket();
      return (v) => known(argument(v));
    }
    if (Object.hasOwn(constants, token)) return () => constants[token] as number;
    if (names.includes(token)) return (v) => v[token] as number;
    throw new Error(`${token} is not known; the names are ${[...names, "pi", ...Object.keys(functions)].join(", ")}`);
  };

  const formula = sum();
  if (at < tokens.length) throw new Error(`${next()} is not expected there`);
  return formula;
}
