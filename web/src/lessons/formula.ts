/** A formula that somebody typed, as a function of named numbers. */
export type Formula = (values: Record<string, number>) => number;

const functions: Record<string, (x: number) => number> = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  sqrt: Math.sqrt,
};
const deepest = 100; // brackets in brackets
const longest = 1000; // characters

/** Joint variables and their sines and cosines, as textbooks write them: q1, θ_1, \theta_{1}, d₂, c1, s12. */
const variable = /(?:theta|[qθd])_?\{?\d\}?|[cs]_?\{?\d+\}?(?![\w(])/;
const token = new RegExp(
  `(?:\\d+\\.?\\d*|\\.\\d+)(?:e[+-]?\\d+)?|sin|cos|tan|sqrt|pi|${variable.source}|[a-z_α-ω]\\w*|\\S`,
  "gi",
);

/** One way to write what can be written in many. */
function plain(text: string): string {
  return text
    .replace(/^\s*(?:[xyθ]|\\?theta)\s*=/i, "")
    .replace(/[₀-₉]/g, (digit) => String("₀₁₂₃₄₅₆₇₈₉".indexOf(digit)))
    .replace(/[⁰¹²³⁴-⁹]/g, (digit) => `^${"⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(digit)}`)
    .replace(/\\(?:left|right|,|;|!| )/g, " ")
    .replace(/\\(?:cdot|times)|[·×∙⋅∗]/g, "*")
    .replace(/÷/g, "/")
    .replace(/[−–]/g, "-")
    .replace(/π/g, "pi")
    .replace(/\\/g, "")
    .replace(/[[]/g, "(")
    .replace(/[\]]/g, ")");
}

/** Reads formulas of one kind: which variables there are. */
class Reader {
  private readonly tokens: string[];
  private at = 0;
  private depth = 0;

  constructor(
    text: string,
    private readonly names: string[],
  ) {
    this.tokens = plain(text).match(token) ?? [];
  }

  whole(): Formula {
    const formula = this.sum();
    if (this.at < this.tokens.length) throw new Error(`${this.next()} is not expected there`);
    return formula;
  }

  private next(): string | undefined {
    return this.tokens[this.at];
  }

  private take(...wanted: string[]): boolean {
    return wanted.includes(this.next() ?? "") && ++this.at > 0;
  }

  private deeper<T>(read: () => T): T {
    if (++this.depth > deepest) throw new Error("the formula has too many brackets or signs");
    const value = read();
    --this.depth;
    return value;
  }

  private sum(): Formula {
    let left = this.product();
    while (this.next() === "+" || this.next() === "-") {
      const [a, minus, b] = [left, this.tokens[this.at++] === "-", this.product()];
      left = (v) => (minus ? a(v) - b(v) : a(v) + b(v));
    }
    return left;
  }

  /** Factors with *, / or nothing between them; a number stands first. */
  private product(): Formula {
    let left = this.signed();
    for (;;) {
      const [a, by] = [left, this.next() ?? ""];
      const beside = /^[a-zα-ω(]/i.test(by);
      if (!beside && by !== "*" && by !== "/") return left;
      if (!beside) ++this.at;
      const b = beside ? this.power() : this.signed();
      left = by === "/" ? (v) => a(v) / b(v) : (v) => a(v) * b(v);
    }
  }

  private signed(): Formula {
    return this.deeper(() => {
      const minus = this.take("-");
      if (!minus && !this.take("+")) return this.power();
      const value = this.signed();
      return minus ? (v) => -value(v) : value;
    });
  }

  private power(): Formula {
    const base = this.factor();
    if (this.take("°")) return (v) => (base(v) * Math.PI) / 180;
    if (!this.take("^", "**")) return base;
    const exponent = this.signed();
    return (v) => base(v) ** exponent(v);
  }

  private bracket(): Formula {
    if (!this.take("(")) throw new Error(`( is missing in front of ${this.next() ?? "the end"}`);
    const inner = this.deeper(() => this.sum());
    if (!this.take(")")) throw new Error(`) is missing in front of ${this.next() ?? "the end"}`);
    return inner;
  }

  private factor(): Formula {
    const token = this.next();
    if (token === undefined) throw new Error("the formula ends too early");
    if (token === "(") return this.bracket();
    ++this.at;
    if (/^[\d.]/.test(token)) return number(token);
    const word = token.toLowerCase();
    if (Object.hasOwn(functions, word)) return this.applied(functions[word] as (x: number) => number);
    if (word === "pi") return () => Math.PI;
    const read = this.variable(word);
    if (read) return read;
    const known = [...this.names, "pi", ...Object.keys(functions)].join(", ");
    throw new Error(`${token} is not known; the names are ${known}`);
  }

  /** A function of a bracket or of the name or number behind it: cos(q1), cos q1, cos^2(q1). */
  private applied(f: (x: number) => number): Formula {
    const exponent = this.take("^") ? this.factor() : null;
    const argument = this.next() === "(" ? this.bracket() : this.factor();
    return exponent ? (v) => f(argument(v)) ** exponent(v) : (v) => f(argument(v));
  }

  private variable(word: string): Formula | null {
    const [, letter = "", digits = ""] = /^([a-zθ]+)_?\{?(\d+)\}?$/.exec(word) ?? [];
    const nameOf = (digit: string): string | undefined => this.names.find((name) => name === `q${digit}`);
    if (["q", "θ", "theta", "d"].includes(letter)) {
      const name = nameOf(digits);
      return name === undefined ? null : (v) => v[name] as number;
    }
    const names = [...digits].map(nameOf); // c12 is the cosine of q1 + q2
    if ((letter !== "c" && letter !== "s") || names.length === 0 || names.includes(undefined)) return null;
    const f = letter === "c" ? Math.cos : Math.sin;
    return (v) => f(names.reduce((sum, name) => sum + (v[name ?? ""] as number), 0));
  }
}

function number(token: string): Formula {
  const value = Number(token);
  if (!Number.isFinite(value)) throw new Error(`${token} is not a number`);
  return () => value;
}

/** Reads a formula in the variables `names`, q1, q2, …: numbers, + - * / ^, also ·, ×, − and no sign for a product;
 * brackets, sin, cos, tan, sqrt, pi; θ1, d2, c1 and s1 as textbooks have them. Throws an Error that says what is wrong. */
export function readFormula(text: string, names: string[]): Formula {
  if (text.length > longest) throw new Error(`a formula has at most ${longest} characters`);
  return new Reader(text, names).whole();
}
