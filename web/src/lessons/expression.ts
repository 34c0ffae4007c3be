/** A formula that was read: a tree, of which the value and the typeset form are made. */
export type Expression =
  | { kind: "number"; text: string }
  /** A joint's value, the length of a link, α or β: `value` at joint values q. */
  | { kind: "symbol"; letter: string; index: string; value(q: readonly number[]): number }
  | { kind: "sum"; parts: Expression[] }
  /** `sign`: empty where none was typed. */
  | { kind: "product"; left: Expression; right: Expression; sign: "" | "·" }
  | { kind: "quotient"; over: Expression; under: Expression }
  | { kind: "minus"; of: Expression }
  | { kind: "power"; base: Expression; exponent: Expression }
  | { kind: "applied"; name: FunctionName; exponent: Expression | null; argument: Expression }
  | { kind: "degrees"; of: Expression }
  | { kind: "bracket"; of: Expression };

export const functions = { sin: Math.sin, cos: Math.cos, tan: Math.tan, sqrt: Math.sqrt };
export type FunctionName = keyof typeof functions;

/** The value of a formula at joint values, rad and m. */
export function valueOf(of: Expression, q: readonly number[]): number {
  const at = (part: Expression): number => valueOf(part, q);
  switch (of.kind) {
    case "number":
      return Number(of.text);
    case "symbol":
      return of.value(q);
    case "sum":
      return of.parts.reduce((sum, part) => sum + at(part), 0);
    case "product":
      return at(of.left) * at(of.right);
    case "quotient":
      return at(of.over) / at(of.under);
    case "minus":
      return -at(of.of);
    case "power":
      return at(of.base) ** at(of.exponent);
    case "applied": {
      const value = functions[of.name](at(of.argument));
      return of.exponent ? value ** at(of.exponent) : value;
    }
    case "degrees":
      return (at(of.of) * Math.PI) / 180;
    case "bracket":
      return at(of.of);
  }
}

const space = "<mspace width='0.17em'></mspace>";

/** A formula as presentation MathML, without its <math>: only what was read is in it, so it is safe as HTML. */
export function mathOf(of: Expression): string {
  switch (of.kind) {
    case "number":
      return `<mn>${of.text}</mn>`;
    case "symbol":
      return of.index === "" ? `<mi>${of.letter}</mi>` : `<msub><mi>${of.letter}</mi><mn>${of.index}</mn></msub>`;
    case "sum":
      return row(...of.parts.map((part, i) => termOf(part, i > 0)));
    case "product":
      return row(mathOf(of.left), of.sign === "" ? space : operator("·"), mathOf(of.right));
    case "quotient":
      return `<mfrac>${mathOf(bare(of.over))}${mathOf(bare(of.under))}</mfrac>`;
    case "minus":
      return row("<mo form='prefix'>−</mo>", mathOf(of.of));
    case "power":
      return `<msup>${mathOf(of.base)}${mathOf(bare(of.exponent))}</msup>`;
    case "applied":
      return appliedMath(of);
    case "degrees":
      return row(mathOf(of.of), "<mi>°</mi>");
    case "bracket":
      return row(operator("("), mathOf(of.of), operator(")"));
  }
}

function appliedMath({ name, exponent, argument }: Expression & { kind: "applied" }): string {
  if (name === "sqrt") {
    const root = `<msqrt>${mathOf(bare(argument))}</msqrt>`;
    return exponent ? `<msup>${root}${mathOf(bare(exponent))}</msup>` : root;
  }
  const word = exponent ? `<msup><mi>${name}</mi>${mathOf(bare(exponent))}</msup>` : `<mi>${name}</mi>`;
  const inner = argument.kind === "bracket" && argument.of.kind === "symbol" ? argument.of : argument;
  return row(word, inner.kind === "bracket" ? "" : space, mathOf(inner));
}

/** A term of a sum with its sign; the first one has a sign only where it is negative. */
function termOf(part: Expression, follows: boolean): string {
  if (!follows) return mathOf(part);
  return part.kind === "minus" ? operator("−") + mathOf(part.of) : operator("+") + mathOf(part);
}

function bare(of: Expression): Expression {
  return of.kind === "bracket" ? of.of : of;
}

function row(...parts: string[]): string {
  return `<mrow>${parts.join("")}</mrow>`;
}

function operator(sign: string): string {
  return `<mo>${sign}</mo>`;
}
