import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";
import { lessonHtml } from "../lesson_plugin.js";
import { stepResponse } from "../src/core/step_response.js";
import {
  armTyped,
  checkAngle,
  checkConstantJacobian,
  checkCount,
  checkGain,
  checkLost,
  checkNumbers,
  checkReach,
  checkString,
} from "../src/lessons/checks.js";
import { checkDrawing, movedParts, type Part } from "../src/lessons/drawn_arm.js";
import type { Names } from "../src/lessons/formula.js";
import { checkFormulas, planarPose, rpJacobian } from "../src/lessons/formula_checks.js";
import { exercises } from "../src/lessons/exercises.js";
import { figureNames } from "../src/page/lesson_figures.js";
import { loadCore, random } from "./native.js";

const next = random(Number(process.env["BEELINE_SEED"] ?? 20240229));
const core = await loadCore();
const degree = Math.PI / 180;
const rrrNames: Names = { joints: ["revolute", "revolute", "revolute"], lengths: [3.5, 3.5, 2] };
const rpNames: Names = { joints: ["revolute", "prismatic"], lengths: [1] };

/** Exercises: ten answers each that are right and ten that are wrong, as people give them. The pose of the arm RP is in
 * formulas.test.ts. */
const answers: Record<string, { solved(answer: string): boolean; right: string[]; wrong: string[] }> = {
  string: {
    solved: (typed) => checkString(typed, "PPP").solved,
    right: [
      "PPP",
      "ppp",
      " PPP ",
      "P P P",
      "P-P-P",
      "p,p,p",
      "Ppp",
      "P–P–P",
      "prismatic prismatic prismatic",
      "P; P; P",
    ],
    wrong: ["", "RRR", "PP", "PPPP", "PPR", "RPP", "3", "xyz", "gantry", "PRP"],
  },
  "rrr-entry": {
    solved: (typed) => {
      const arm = core.arm("rrr");
      const { solved } = checkFormulas([typed], planarPose.slice(1, 2), arm, rrrNames, next);
      arm.release();
      return solved;
    },
    right: [
      "3.5 sin θ1 + 3.5 sin α + 2 sin β",
      "L1 s1 + L2 s12 + L3 s123",
      "3.5(s1 + s12) + 2s123",
      "a1 sin(θ1) + a2 sin(θ1+θ2) + a3 sin(θ1+θ2+θ3)",
      "y = 3.5sinθ₁+3.5sin(θ₁+θ₂)+2sin(θ₁+θ₂+θ₃)",
      "2*sin(q1+q2+q3) + 3.5*sin(q1+q2) + 3.5*sin(q1)",
      "3,5 s1 + 3,5 s12 + 2 s123",
      "7/2 sin(th1) + 7/2 sin(th2+th1) + 2 sin beta",
      "3.5\\sin\\theta_1 + 3.5\\sin\\alpha + 2\\sin\\beta",
      "s_1 L_1 + s_{12} L_2 + s_{123} L_3",
      "3.5 s₁ + 3.5 s₁₂ + 2 s₁₂₃",
    ],
    wrong: [
      "3.5 cos θ1 + 3.5 cos α + 2 cos β",
      "3.5 sin θ1 + 3.5 sin θ2 + 2 sin θ3",
      "3.5 s1 + 3.5 s12 + 2.5 s123",
      "9 sin θ1",
      "L1 s1 + L2 s2 + L3 s3",
      "3.5 s1 - 3.5 s12 - 2 s123",
      "3.5 sin θ1 + 3.5 sin θ1 + θ2 + 2 sin β",
      "s1 + s12 + s123",
      "-(L1 s1 + L2 s12 + L3 s123)",
      "L1 s1 + L2 s12",
    ],
  },
  "rp-jacobian": {
    solved: (typed) => {
      const arm = core.arm("rp");
      const { solved } = checkFormulas(typed.split(";"), rpJacobian, arm, rpNames, next);
      arm.release();
      return solved;
    },
    right: [
      "-(1+d2) sin θ1; cos θ1; (1+d2) cos θ1; sin θ1",
      "-(1+d2)s1; c1; (1+d2)c1; s1",
      "-s1 - d2 s1; c1; c1 + d2 c1; s1",
      "−sin(q1)(1+q2); cos(q1); cos(q1)(1+q2); sin(q1)",
      "-(L1+d)sinθ; cosθ; (L1+d)cosθ; sinθ",
      "-sin(θ1)-d2*sin(θ1); cos(θ1); cos(θ1)+d2*cos(θ1); sin(θ1)",
      "-(1+d₂)·sin θ₁; cos θ₁; (1+d₂)·cos θ₁; sin θ₁",
      "(-1-d2) s1; c1; (d2+1) c1; s1",
      "-(1+d_2)\\sin\\theta_1; \\cos\\theta_1; (1+d_2)\\cos\\theta_1; \\sin\\theta_1",
      "-(1+q_2)*s(q_1); c(q_1); (1+q_2)*c(q_1); s(q_1)",
    ],
    wrong: [
      "(1+d2) sin θ1; cos θ1; (1+d2) cos θ1; sin θ1",
      "-d2 sin θ1; cos θ1; d2 cos θ1; sin θ1",
      "cos θ1; -(1+d2) sin θ1; sin θ1; (1+d2) cos θ1",
      "-(1+d2) sin θ1; (1+d2) cos θ1; cos θ1; sin θ1",
      "-sin θ1; cos θ1; cos θ1; sin θ1",
      "-(1+d2) s1; c1; (1+d2) c1; 0",
      "-(1+d2) s1; 1; (1+d2) c1; 1",
      "-(1+d2) s1; c1; (1+d2) c1;",
      "-(1+d2) s2; c1; (1+d2) c1; s1",
      "-(1+d2) s1 + c1; 0; (1+d2) c1 + s1; 0",
    ],
  },
  "constant-jacobian": {
    solved: (typed) => {
      try {
        const arm = core.arm(armTyped(typed));
        const { solved } = checkConstantJacobian(arm, next);
        arm.release();
        return solved;
      } catch {
        return false;
      }
    },
    right: [
      "gantry",
      "a gantry",
      "PP",
      "pp",
      "P",
      "P P",
      "P-P",
      "PPP",
      "P:1",
      "Cartesian robot",
      "prismatic, prismatic",
    ],
    wrong: ["", "rrr", "rp", "RP", "PR", "scara", "RRR:1,1,1", "R", "nothing", "RRP", "puma560"],
  },
  gain: {
    solved: (typed) => {
      const arm = core.arm("rrr");
      const ones = [1, 1, 1];
      const response = stepResponse(arm, { kp: Number(typed) }, [0, 0, 0], ones, 400);
      arm.release();
      return checkGain(response, 10).solved;
    },
    right: ["0.33", "0.35", "0.4", "0.45", "0.5", "0.6", "0.7", "0.8", "0.9", "1"],
    wrong: ["0.02", "0.1", "0.2", "0.3", "0.32", "1.05", "1.2", "1.5", "2", "2.5"],
  },
  ominus: {
    solved: (typed) => checkAngle(typed, 110, 0, { joints: [] }, []).solved,
    right: [
      "110",
      "110°",
      "+110",
      "110 deg",
      "110 degrees",
      "= 110°",
      "260 - 150",
      "360-250",
      "1.92 rad",
      "11π/18",
      "110.0",
      "110°.",
      "1.92 rad;",
      "109½",
    ],
    wrong: ["", "-250", "-110", "250", "50", "-50", "110 rad", "1.92", "470", "hundred", "π"],
  },
  reach: {
    solved: (typed) => {
      const arm = core.arm("rrr");
      const q = typed.split(",").map((value) => Number(value) * degree);
      const { solved } = checkReach(arm.forward(q).at(-1) ?? [], { x: 2, y: 6, degrees: 45 });
      arm.release();
      return solved;
    },
    right: [
      "34.05,97.33,-86.39",
      "131.39,-97.33,10.95",
      "34.1,97.3,-86.4",
      "131.4,-97.3,10.9",
      "34,97,-86",
      "131,-97,11",
      "394.05,97.33,-86.39",
      "34.05,97.33,273.61",
      "34.5,97.3,-87.5",
      "131.8,-97.3,9.5",
    ],
    wrong: [
      "0,0,0",
      "34.05,97.33,-80",
      "131.39,97.33,10.95",
      "34.05,-97.33,-86.39",
      "97.33,34.05,-86.39",
      "45,0,0",
      "30,97.33,-86.39",
      "34.05,105,-86.39",
      "-34.05,-97.33,86.39",
      "90,90,90",
    ],
  },
  "draw-rp": {
    solved: (typed) => checkDrawing(drawing(typed)).solved,
    right: [
      "R 0 0, P 1 0, tool 2 0",
      "R 0 0, P 0.5 0, tool 2 0",
      "R 0 0, P 1.5 0, tool 2 0",
      "R 0 0, P 0 0, tool 2 0",
      "R 0 0, P -0.5 0, tool 2 0",
      "R 0 0, P 1.25 0, tool 2 0",
      "R 0 0, P 0.25 0, tool 2 0",
      "R 0 0, P 1.75 0, tool 2 0",
      "R 0 0, P -1 0, tool 2 0",
      "R 0 0, P 0.75 0, tool 2 0",
    ],
    wrong: [
      "",
      "R 0 0, P 1 0",
      "R 0 0, tool 2 0",
      "P 0 0, R 1 0, tool 2 0",
      "R 0 0, R 1 0, tool 2 0",
      "P 0 0, P 1 0, tool 2 0",
      "R 0 0, P 1 0, tool 1 1",
      "R 0 0, P 2 1, tool 2 0",
      "R 1 0, P 1.5 0, tool 2 0",
      "R 0 0, P 2.5 0, tool 2 0",
      "R 0 0, P 1 0, tool 2.5 0",
      "R 0 0, P 1 0, P 1.5 0, tool 2 0",
    ],
  },
  elbow: {
    solved: (typed) => checkAngle(typed, 90, 180, { joints: [] }, []).solved,
    right: ["90", "-90", "90°", "−90°", "π/2", "-pi/2", "θ2 = 90", "1.5708 rad", "270", "+90 deg", "180° - 90°"],
    wrong: ["", "0", "45", "180", "1.5708", "90 rad", "60°", "-45", "π", "cos"],
  },
  screw: {
    solved: (typed) => checkNumbers(typed, [-7], rrrNames).solved,
    right: ["-7", "−7", "-7.0", "- 7", "v_y = -7", "-7 m/s", "-(3.5+3.5)", "-(L1+L2)", "-L1 - L2", "-2*3.5", "(-7)"],
    wrong: ["", "7", "-3.5", "-9", "0", "-7,5", "down", "1, 0, -7", "-L1", "−70"],
  },
  "body-column": {
    solved: (typed) => checkNumbers(typed, [0, 2, 1], rrrNames).solved,
    right: [
      "0, 2, 1",
      "(0, 2, 1)",
      "0 2 1",
      "[0; 2; 1]",
      "0,2,1",
      "(0 2 1)^T",
      "[0, 2, 1]T",
      "0; L3; 1",
      "0.0, 2.0, 1.0",
      "J3 = (0, 2, 1)",
      "(0, 2, 1).",
    ],
    wrong: ["", "2, 0, 1", "0, 2", "0, -2, 1", "1, 0, 2", "0, 3.5, 1", "0, 2, 0", "0, 2, 1, 0", "two", "021"],
  },
  spare: {
    solved: (typed) => checkCount(typed, 7).solved,
    right: ["7", " 7 ", "7 joints", "seven", "Seven joints", "6+1", "6 + 1", "7.", "7 joints.", "n = 7", "+7", "(7)"],
    wrong: ["", "6", "4", "8", "77", "six", "many", "6 joints", "6.5", "-7"],
  },
  singular: {
    solved: (typed) => {
      const [q = "", direction = ""] = typed.split(" → ");
      return checkLost(
        direction,
        q.split(",").map((value) => Number(value) * degree),
      ).solved;
    },
    right: [
      "30,0,20 → 30",
      "30,0,20 → 30°",
      "30,0,20 → 210°",
      "30,0,20 → −150",
      "30,0,20 → θ1",
      "30,0,20 → q1",
      "30,2,20 → π/6",
      "30,180,20 → 0.52 rad",
      "30,-180,20 → along the arm",
      "0,0,0 → 0",
      "-45,1,90 → -45 deg",
      "30,0,20 → Along the links.",
      "30,0,20 → along the line of the first two links",
      "30,0,20 → along link 1",
      "30,0,20 → radially",
      "30,0,20 → towards the base",
      "30,0,20 → towards or away from joint 1",
      "30,0,20 → 30°.",
    ],
    wrong: [
      "30,90,20 → 30",
      "30,0,20 → 120",
      "30,0,20 → ",
      "30,0,20 → 0",
      "30,0,20 → 90°",
      "30,0,20 → θ2",
      "30,0,20 → 30 rad",
      "30,0,20 → up",
      "30,10,20 → 30",
      "30,0,20 → 45",
      "30,0,20 → not along the links",
      "30,0,20 → along",
      "30,0,20 → along the y axis",
      "30,0,20 → along link 3",
      "30,0,20 → at right angles to the radial direction",
      "30,0,20 → towards the moon",
      "30,0,20 → not towards the base",
    ],
  },
};

/** The parts of a drawing, as R 0 0, P 1 0, tool 2 0. */
function drawing(text: string): Part[] {
  return text === ""
    ? []
    : text.split(", ").map((part) => {
        const [kind, x, y] = part.split(" ");
        return { kind: kind as Part["kind"], x: Number(x), y: Number(y) };
      });
}

test.each(Object.entries(answers))("%s: ten right answers are accepted, ten wrong ones are not", (_, one) => {
  expect(one.right.length).toBeGreaterThanOrEqual(10);
  expect(one.wrong.length).toBeGreaterThanOrEqual(10);
  expect(one.right.filter((typed) => !one.solved(typed))).toEqual([]);
  expect(one.wrong.filter((typed) => one.solved(typed))).toEqual([]);
});

test("the verdict on a wrong answer names the mistake", () => {
  expect(checkString("PPR", "PPP").says).toBe("Not yet: look at joint 3 again.");
  expect(checkString("PP", "PPP").says).toBe("Not yet: that has 2 letters, and the arm has 3 joints.");
  expect(checkAngle("-250", 110, 0, { joints: [] }, []).says).toBe("Not yet: it is not −250°.");
  expect(checkLost("30", [0, 1, 0]).says).toBe("The arm is not singular: θ2 is 57° away from where it would be.");
  expect(checkLost("30", null)).toEqual({
    solved: false,
    says: "This is asked of the arm rrr: press “Show the lesson’s arm” first.",
  });
  expect(checkAngle("±90°", 90, 180, { joints: [] }, []).says).toBe(
    "The angle cannot be read: “±” is not known here: use numbers, sin and cos.",
  );
  expect(checkDrawing(drawing("P 0 0, R 1 0, tool 2 0")).says).toBe(
    "Not yet: at θ1 = 90°, d2 = 1.0 m your tool is at (1.00, 1.00, 90°), and the tool of RP at (0.00, 2.00, 90°).",
  );
  const arm = core.arm("rp");
  expect(checkConstantJacobian(arm, next).says).toBe(
    "Not yet: the column of its joint 1 changes with the configuration.",
  );
  arm.release();
});

test("a drawn arm moves as the core moves the same arm", () => {
  const arm = core.arm("RRP:1,1,1");
  const drawn = drawing("R 0 0, R 1 0, P 2 0, tool 3 0");
  const ends = (q: number[]): ArrayLike<number> => arm.forward(q).at(-1) ?? [];
  const atRest = ends([0, 0, 0])[12] ?? NaN;
  for (let i = 0; i < 20; ++i) {
    const q = [6 * next() - 3, 6 * next() - 3, next()];
    const [x, y, angle] = movedParts(drawn, [q[0] ?? 0, q[1] ?? 0, (q[2] ?? 0) + atRest - 3]).at(-1) ?? [];
    const pose = ends(q);
    expect(x).toBeCloseTo(pose[12] ?? NaN, 9);
    expect(y).toBeCloseTo(pose[13] ?? NaN, 9);
    expect(Math.cos(angle ?? NaN)).toBeCloseTo(pose[0] ?? NaN, 9);
  }
  arm.release();
});

const texts = fileURLToPath(new URL("../src/lessons/text", import.meta.url));
test("every exercise has a test here, a hint and a solution, and blocks name exercises and figures that there are", () => {
  const all = readdirSync(texts).map((name) => readFileSync(`${texts}/${name}`, "utf8"));
  const blocks = all.flatMap((text) => [...text.matchAll(/```check (\S+)\s*?\n([\s\S]*?)```/g)]);
  const tested = [...Object.keys(answers), "rp", "formula-rp"];
  expect(new Set(blocks.map(([, name]) => name))).toEqual(new Set(tested));
  expect(new Set(Object.keys(exercises))).toEqual(new Set(tested));
  for (const [, name, body = ""] of blocks) {
    expect(body, name).toMatch(/^hint:/m);
    expect(body, name).toMatch(/^solution:/m);
  }
  const figures = all.flatMap((text) => [...text.matchAll(/```figure (\S+)/g)].map(([, name]) => name));
  expect(new Set(figures)).toEqual(new Set(figureNames));
  expect(figures).toEqual(expect.arrayContaining(["1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8", "1.9"]));
  for (const text of all) expect(text).toMatch(/^Sources?: /m);
});

test("a lesson becomes HTML with its hints, solution and numbered equations", () => {
  const html = lessonHtml("$$(1.3) a = b $$\n\n```check gain\nhint: Try $x$.\nsolution: It is\n  _two_.\n```\n");
  expect(html).toContain('<span class="equation"><math');
  expect(html).toContain("<span>(1.3)</span>");
  expect(html).toMatch(/<div data-check="gain"><details class="hint"><summary>Hint 1<\/summary><p>Try <math/);
  expect(html).toContain(
    '<details class="solution"><summary>Solution</summary><p>It is\n  <em>two</em>.</p></details>',
  );
});
