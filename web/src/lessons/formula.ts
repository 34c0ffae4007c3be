import type { Expression, FunctionName } from "./expression.js";
import { tokensOf, type Token } from "./formula_tokens.js";

/** What a formula may name: the joints of an arm and, where they are given, the lengths of its links, m. */
export interface Names {
  joints: ("revolute" | "prismatic")[];
  lengths?: number[];
}

const deepest = 100; // brackets in brackets
export const longestFormula = 1000; // characters
const letters = { revolute: "θ", prismatic: "d" };

/** Reads a formula as people write it: numbers, + - * / ^, ·, ×, − and no sign for a product; brackets; sin, cos, tan,
 * sqrt, π and degrees; joints as q1, θ_1, θ₁, th1, theta1, d2; c12 or c(θ1+θ2) for a cosine; lengths L1 or a1; for an
 * arm RRR α = θ1 + θ2 and β = θ1 + θ2 + θ3; also as LaTeX. Throws an Error that says what is wrong. */
export function readFormula(text: string, names: Names): Expression {
  if (text.length > longestFormula) throw new Error(`a formula has at most ${longestFormula} characters`);
  return new Reader(tokensOf(text), names).whole();
}

class Reader {
  private at = 0;
  private depth = 0;

  constructor(
    private readonly tokens: Token[],
    private readonly names: Names,
  ) {}

  whole(): Expression {
    const formula = this.sum();
    const next = this.next();
    if (next?.text === ")") throw new Error("one closing bracket is too many");
    if (next?.kind === "number") throw new Error(`write a sign, such as +, in front of ${next.text}`);
    if (next) throw new Error(`“${next.text}” is not expected there`);
    return formula;
  }

  private next(): Token | undefined {
    return this.tokens[this.at];
  }

  private take(sign: string): boolean {
    const next = this.next();
    return next?.kind === "sign" && next.text === sign && ++this.at > 0;
  }

  private deeper<T>(read: () => T): T {
    if (++this.depth > deepest) throw new Error("the formula has too many brackets or signs");
    const value = read();
    --this.depth;
    return value;
  }

  private sum(): Expression {
    const parts = [this.product()];
    for (;;) {
      if (this.take("+")) parts.push(this.product());
      else if (this.take("-")) parts.push({ kind: "minus", of: this.product() });
      else return parts.length === 1 ? (parts[0] as Expression) : { kind: "sum", parts };
    }
  }

  /** Factors with *, / or nothing between them. */
  private product(): Expression {
    let left = this.signed();
    for (;;) {
      if (this.take("/")) left = { kind: "quotient", over: left, under: this.signed() };
      else if (this.take("*")) left = { kind: "product", left, right: this.signed(), sign: "·" };
      else if (this.isBeside()) left = { kind: "product", left, right: this.power(), sign: "" };
      else return left;
    }
  }

  /** Whether a factor follows without a sign. A number does behind a name or a bracket: c1 3.5, but not behind another number. */
  private isBeside(): boolean {
    const next = this.next();
    if (!next) return false;
    if (next.kind === "number") return this.tokens[this.at - 1]?.kind !== "number";
    return next.kind !== "sign" || next.text === "(";
  }

  private signed(): Expression {
    return this.deeper(() => {
      if (this.take("-")) return { kind: "minus", of: this.signed() };
      return this.take("+") ? this.signed() : this.power();
    });
  }

  private power(): Expression {
    let base = this.factor();
    if (this.take("°")) base = { kind: "degrees", of: base };
    return this.take("^") ? { kind: "power", base, exponent: this.signed() } : base;
  }

  private bracket(): Expression {
    const next = this.next();
    if (!this.take("(")) throw new Error(next ? `( is missing in front of ${next.text}` : "the formula ends too early");
    const of = this.deeper(() => this.sum());
    if (this.take(")")) return { kind: "bracket", of };
    const other = this.next();
    throw new Error(other ? `“${other.text}” is not expected there` : "a closing bracket is missing");
  }

  private factor(): Expression {
    const token = this.next();
    if (!token) throw new Error("the formula ends too early");
    if (token.kind === "sign" && token.text === "(") return this.bracket();
    ++this.at;
    switch (token.kind) {
      case "number":
        if (!Number.isFinite(Number(token.text))) throw new Error(`${token.text} is too large a number`);
        return { kind: "number", text: token.text };
      case "pi":
        return { kind: "symbol", letter: "π", index: "", value: () => Math.PI };
      case "function":
        return this.applied(token.name);
      case "fraction":
        return { kind: "quotient", over: this.bracket(), under: this.bracket() };
      case "joint":
        return this.joint(token.letter, token.index);
      case "short":
        return { kind: "applied", name: token.name, exponent: null, argument: this.angles(token.index, token.text) };
      case "length":
        return this.lengthOf(token.letter, token.index);
      case "sum of angles":
        return this.sumOfAngles(token.letter);
      default:
        throw new Error(this.unknown(token.text));
    }
  }

  /** A function of a bracket, or of what stands behind it: cos(q1), cos q1, cos 2q1, cos^2(q1). */
  private applied(name: FunctionName): Expression {
    const exponent = this.take("^") ? this.factor() : null;
    const next = this.next();
    if (next?.kind === "sign" && next.text === "-") throw new Error(`write brackets: ${name}(−…)`);
    const argument = this.deeper(() => this.argument());
    return { kind: "applied", name, exponent, argument };
  }

  private argument(): Expression {
    const first = this.next();
    let argument = this.factor();
    if (this.take("°")) return { kind: "degrees", of: argument };
    const second = this.next();
    const isMultiple = first?.kind === "number" && (second?.kind === "joint" || second?.kind === "sum of angles");
    if (isMultiple) argument = { kind: "product", left: argument, right: this.factor(), sign: "" };
    return argument;
  }

  private joint(letter: "q" | "θ" | "d", index: string): Expression {
    const { joints } = this.names;
    if (index === "") {
      const [only, another] = joints.flatMap((kind, k) => (letters[kind] === letter ? [k] : []));
      if (only === undefined || another !== undefined) throw new Error(`say which joint: ${letter}1`);
      return { kind: "symbol", letter, index: "", value: (q) => q[only] ?? NaN };
    }
    const k = Number(index) - 1;
    const kind = joints[k];
    if (!kind && letter === "θ" && index.length > 1) return { kind: "bracket", of: this.angles(index, `θ${index}`) };
    if (!kind) throw new Error(this.unknown(`${letter}${index}`));
    if (letter !== "q" && letters[kind] !== letter)
      throw new Error(`joint ${index} is ${kind}: its value is ${letters[kind]}${index}, or q${index}`);
    return { kind: "symbol", letter, index: String(k + 1), value: (q) => q[k] ?? NaN };
  }

  /** The sum of the angles of the joints that digits name. */
  private angles(index: string, text: string): Expression {
    const parts = [...index].map((digit): Expression => {
      if (this.names.joints[Number(digit) - 1] === "revolute") return this.joint("θ", digit);
      throw new Error(
        this.names.joints[Number(digit) - 1]
          ? `${text} is of an angle, but joint ${digit} is prismatic`
          : this.unknown(text),
      );
    });
    const [first = { kind: "number", text: "0" }] = parts;
    return parts.length === 1 ? first : { kind: "bracket", of: { kind: "sum", parts } };
  }

  private lengthOf(letter: string, index: string): Expression {
    const length = this.names.lengths?.[Number(index) - 1];
    if (length === undefined) throw new Error(this.unknown(`${letter}${index}`));
    return { kind: "symbol", letter, index, value: () => length };
  }

  /** α = θ1 + θ2 and β = θ1 + θ2 + θ3, as the chapter defines them (eq. 1.2). */
  private sumOfAngles(letter: "α" | "β"): Expression {
    if (this.names.joints.join() !== "revolute,revolute,revolute") throw new Error(this.unknown(letter));
    const count = letter === "α" ? 2 : 3;
    return {
      kind: "symbol",
      letter,
      index: "",
      value: (q) => q.slice(0, count).reduce((sum, value) => sum + value, 0),
    };
  }

  private unknown(text: string): string {
    const { joints, lengths = [] } = this.names;
    const values = joints.map((kind, k) => `${letters[kind]}${k + 1}`);
    const known = [...values, ...lengths.map((_, k) => `L${k + 1}`), "numbers"].join(", ");
    return `“${text.replace(/[‹›]/g, "")}” is not known here: use ${known}, sin and cos`;
  }
}
