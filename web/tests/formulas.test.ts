import { expect, test } from "vitest";
import { mathOf, valueOf } from "../src/lessons/expression.js";
import { readFormula, type Names } from "../src/lessons/formula.js";
import { checkFormulas, planarPose } from "../src/lessons/formula_checks.js";
import { loadCore, random } from "./native.js";

const next = random(Number(process.env["BEELINE_SEED"] ?? 20240229));
const core = await loadCore();
const rr: Names = { joints: ["revolute", "revolute"] };
const rrr: Names = { joints: ["revolute", "revolute", "revolute"], lengths: [3.5, 3.5, 2] };
const rp: Names = { joints: ["revolute", "prismatic"], lengths: [1] };

test.each([
  ["1 + 2*3", 7],
  ["-2^2", -4],
  ["2^-1", 0.5],
  ["2^3^2", 512],
  ["(1+2)*cos(0) - sin(pi/2)", 2],
  ["1 - 2 - 3", -4],
  ["8/2/2", 2],
  [".5e1 + 1.e-1", 5.1],
  ["q1*q2", 6],
  ["sin 1", Math.sin(1)],
  ["2 cos^2 q1", 2 * Math.cos(2) ** 2],
  ["cos²θ₁", Math.cos(2) ** 2],
  ["cos 2θ1", Math.cos(4)],
  ["180°", Math.PI],
  ["cos 60°", 0.5],
  ["cos(60 deg)", 0.5],
  ["cos(60^\\circ)", 0.5],
  ["\\frac{q_1}{4} + \\frac12", 1],
  ["\\sqrt{16}", 4],
  ["3,5 + 1", 4.5],
  ["½ q1", 1],
  ["3½", 3.5],
  ["3½ q1 - 1 ¼", 5.75],
  ["1/½", 2],
  ["c1 ½", 0.5 * Math.cos(2)],
  ["c1½", 0.5 * Math.cos(2)],
  ["c1 3½", 3.5 * Math.cos(2)],
  ["2^½", Math.SQRT2],
  ["2½°", Math.PI / 72],
  ["7.", 7],
  ["q1 + 1.; ", 3],
  ["c1 3.5", 3.5 * Math.cos(2)],
  ["q(q1) = 2 q1", 4],
  ["y: q2", 3],
])("%s is %d", (text, value) => {
  expect(valueOf(readFormula(text, rr), [2, 3])).toBeCloseTo(value, 12);
});

/** The same formula as textbooks, students and programs write it. */
const ways: [string, Names, (q: number[]) => number][] = [
  ...[
    "q1",
    "q_1",
    "q₁",
    "θ1",
    "θ_1",
    "θ₁",
    "θ 1",
    "th1",
    "Th1",
    "theta1",
    "Theta_1",
    "\\theta_1",
    "\\theta_{1}",
    "𝜃₁",
  ].map((text): [string, Names, (q: number[]) => number] => [text, rrr, ([a = 0]) => a]),
  ...["q2", "q₂", "q_2", "d2", "d₂", "d_2", "d_{2}", "d", "D2"].map(
    (text): [string, Names, (q: number[]) => number] => [text, rp, ([, b = 0]) => b],
  ),
  ...[
    "c1",
    "c₁",
    "c_1",
    "C1",
    "c_{1}",
    "cθ1",
    "cθ₁",
    "c(θ1)",
    "cos θ1",
    "cosθ1",
    "cos(θ_1)",
    "COS(q1)",
    "\\cos\\theta_1",
  ].map((text): [string, Names, (q: number[]) => number] => [text, rrr, ([a = 0]) => Math.cos(a)]),
  ...[
    "s12",
    "s₁₂",
    "s_{12}",
    "s_12",
    "S12",
    "sin(θ1+θ2)",
    "sin(θ₂ + θ₁)",
    "s(q1+q2)",
    "sin α",
    "sin(alpha)",
    "sin θ12",
    "sen(th1+th2)",
  ].map((text): [string, Names, (q: number[]) => number] => [text, rrr, ([a = 0, b = 0]) => Math.sin(a + b)]),
  ...[
    "L1 c1 + L2 c12 + L3 c123",
    "l1*c1+l2*c12+l3*c123",
    "a1c1 + a2c12 + a3c123",
    "a_1 c_1 + a_2 c_{12} + a_3 c_{123}",
    "3.5cosθ1 + 3.5cosα + 2cosβ",
    "3,5 cos θ₁ + 3,5 cos α + 2 cos β",
    "2cos(β)+3.5(cos θ1+cos α)",
    "c123·2 + c12·3.5 + c1·3.5",
    "x(q) = 3.5 \\cos\\theta_1 + 3.5 \\cos\\alpha + 2 \\cos\\beta",
    "7/2 (c1 + c12) + 2 c(θ1+θ2+θ3)",
    "3.5 cos⁡(θ1) + 3.5 cos⁡(θ1 + θ2) + 2 cos⁡(θ1 + θ2 + θ3)",
  ].map((text): [string, Names, (q: number[]) => number] => [
    text,
    rrr,
    ([a = 0, b = 0, c = 0]) => 3.5 * Math.cos(a) + 3.5 * Math.cos(a + b) + 2 * Math.cos(a + b + c),
  ]),
];
test.each(ways)("%s is read", (text, names, value) => {
  for (const q of [
    [0.3, 0.7, -1.1],
    [-2, 1.4, 0.6],
  ])
    expect(valueOf(readFormula(text, names), q)).toBeCloseTo(value(q), 12);
});

test.each([
  ["", "the formula ends too early"],
  ["1 +", "the formula ends too early"],
  ["(1", "a closing bracket is missing"],
  ["1)", "one closing bracket is too many"],
  ["q3", "“q3” is not known here: use θ1, d2, L1, numbers, sin and cos"],
  ["x", "“x” is not known here"],
  ["±90°", "“±” is not known here"],
  ["3.5½", "write a sign, such as +, in front of 1"],
  [";", "the formula ends too early"],
  ["constructor", "is not known here"],
  ["__proto__", "is not known here"],
  ["1 2", "write a sign, such as +, in front of 2"],
  ["q", "say which joint: q1"],
  ["θ2", "joint 2 is prismatic: its value is d2, or q2"],
  ["d1", "joint 1 is revolute: its value is θ1, or q1"],
  ["c12", "c12 is of an angle, but joint 2 is prismatic"],
  ["α", "“α” is not known here"],
  ["L2", "“L2” is not known here"],
  ["cos", "the formula ends too early"],
  ["cos -q1", "write brackets: cos(−…)"],
  ["(".repeat(500), "too many brackets"],
  ["-".repeat(999), "too many brackets"],
  ["1e999", "1e999 is too large a number"],
  ["1".repeat(1001), "a formula has at most 1000 characters"],
  ["<img src=x onerror=alert(1)>", "is not known here"],
])("%j is refused", (text, words) => {
  expect(() => readFormula(text, rp)).toThrow(words);
});

test("a formula is typeset as it was read", () => {
  const bare = (text: string, names = rrr): string =>
    mathOf(readFormula(text, names))
      .replace(/<mspace[^>]*><\/mspace>/g, " ")
      .replace(/<\/?mrow>/g, "")
      .replace(/<(?:mi|mn|mo)[^>]*>(.*?)<\/(?:mi|mn|mo)>/g, "$1")
      .replace(/<msub>(.)(\d)<\/msub>/g, "$1_$2");
  expect(bare("L1c1+L2*c12")).toBe("L_1 cos θ_1+L_2·cos(θ_1+θ_2)");
  expect(bare("2cosθ1-q_2")).toBe("2 cos θ_1−q_2");
  expect(bare("cos²(θ1)/(1+L2)")).toBe("<mfrac><msup>cos2</msup> θ_11+L_2</mfrac>");
  expect(bare("-sin θ1 + θ2")).toBe("−sin θ_1+θ_2"); // not the sine of the sum
  expect(bare("sqrt(2)^3")).toBe("<msup><msqrt>2</msqrt>3</msup>");
});

/** Answers for the pose of the arm RP, as people write them: x, y, θ. */
const right: [string, string, string][] = [
  ["(1+d2) cos θ1", "(1+d2) sin θ1", "θ1"],
  ["cosθ1 + d2 cosθ1", "sinθ1 + d2 sinθ1", "θ1"],
  ["c1 + d2 c1", "s1 + d2 s1", "θ_1"],
  ["c1(1+q2)", "s1(1+q2)", "q1"],
  ["(L1 + d2)*cos(theta1)", "(L1 + d2)*sin(theta1)", "theta1"],
  ["cos(q_1)·(q_2+1)", "sin(q_1)·(q_2+1)", "q_1"],
  ["x = (1 + d₂) cos θ₁", "y = (1 + d₂) sin θ₁", "θ = θ₁"],
  ["(1+d)cosθ", "(1+d)sinθ", "θ"],
  ["d_2\\cos\\theta_1 + \\cos\\theta_1", "d_2\\sin\\theta_1 + \\sin\\theta_1", "\\theta_1"],
  ["q2*cos(q1)+1*cos(q1)", "sin(q1)-(-q2)*sin(q1)", "q1+2*pi"],
  ["cosθ1 (1,0 + d2)", "sinθ1 (1,0 + d2)", "θ1 - 360°"],
];
test.each(right)("RP: %s, %s, %s is right", (...texts) => {
  const arm = core.arm("rp");
  expect(checkFormulas(texts, planarPose, arm, rp, next)).toEqual({
    solved: true,
    says: "Right: all 3 agree with the arm at 25 configurations.",
  });
  arm.release();
});

const wrong: [string, string, string, string][] = [
  [
    "(1+d2) sin θ1",
    "(1+d2) cos θ1",
    "θ1",
    "x and y differ. At θ1 = 30°, d2 = 2 m: x is 1.50 by your formula, and 2.60 on",
  ],
  ["(1+d2) sin θ1", "(1+d2) cos θ1", "θ1", "x and y are exchanged."],
  [
    "d2 cos θ1",
    "d2 sin θ1",
    "θ1",
    "x is 1.73 by your formula, and 2.60 on the arm; y is 1.00 by your formula, and 1.50",
  ],
  ["(1+d2) cos θ1", "-(1+d2) sin θ1", "θ1", "y has the wrong sign."],
  ["cos θ1 + d2", "sin θ1 + d2", "θ1", "x and y differ."],
  ["1 + d2 cos θ1", "1 + d2 sin θ1", "θ1", "x and y differ."],
  ["(1+d2) cos θ1", "(1+d2) sin θ1", "d2", "θ differs. At θ1 = 30°, d2 = 2 m: θ is 114.6° by your formula, and 30.0°"],
  ["(1+d2) cos θ1", "(1+d2) sin θ1", "0", "θ is 0.0° by your formula, and 30.0° on the arm."],
  ["(1+d2) cos θ2", "(1+d2) sin θ2", "θ1", "x cannot be read: joint 2 is prismatic: its value is d2, or q2."],
  ["c1 + d2 c12", "s1 + d2 s12", "θ1", "c12 is of an angle, but joint 2 is prismatic."],
  ["(1+d2) cos θ1", "", "", "Type a formula for y and θ too."],
  ["cos θ1/(d2-2)", "(1+d2) sin θ1", "θ1", "x has no value by your formula there."],
  ["(1+d2 cos θ1", "(1+d2) sin θ1", "θ1", "x cannot be read: a closing bracket is missing."],
  ["1.000001 (1+d2) cos θ1", "(1+d2) sin θ1", "θ1", "x is 2.598079 by your formula, and 2.598076 on the arm."],
];
test.each(wrong)("RP: %s, %s, %s is wrong: %4$s", (x, y, angle, words) => {
  const arm = core.arm("rp");
  const { solved, says } = checkFormulas([x, y, angle], planarPose, arm, rp, next);
  expect(solved).toBe(false);
  expect(says).toContain(words);
  arm.release();
});
