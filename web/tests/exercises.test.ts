import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";
import { lessonHtml } from "../lesson_plugin.js";
import { lineBound, lineRows, linkLengths, sampledDeviation } from "../src/core/line_bound.js";
import { poseOfRpy } from "../src/core/pose.js";
import { checkAngle, checkConstantJacobian, checkLost, checkString } from "../src/lessons/checks.js";
import { checkDrawing, movedParts, type Part } from "../src/lessons/drawn_arm.js";
import { exercises, figureOf, wristStart } from "../src/lessons/exercises.js";
import { anglesText, judges } from "../src/lessons/judges.js";
import { codesIn } from "../src/lessons/handed_in.js";
import { itemsOf } from "../src/lessons/typed_answer.js";
import { codeOf, codeOfContent, resultsOf } from "../src/lessons/results.js";
import { figureNames } from "../src/page/lesson_figures.js";
import { answers } from "./exercise_answers.js";
import { loadCore, random } from "./native.js";

const next = random(Number(process.env["BEELINE_SEED"] ?? 20240229));
const core = await loadCore();

const bench = { arm: (text: string) => core.arm(text), random: next };

/** The verdict of the judge of an exercise. */
function solved(name: string, answer: string): boolean {
  const judge = judges[name];
  if (!judge) throw new Error(`no judge of ${name}`);
  return judge(answer, bench).solved;
}

/** The parts of a drawing, as R 0 0, P 1 0, tool 2 0. */
function drawing(text: string): Part[] {
  return text === ""
    ? []
    : text.split(", ").map((part) => {
        const [kind, x, y] = part.split(" ");
        return { kind: kind as Part["kind"], x: Number(x), y: Number(y) };
      });
}

test.each(Object.entries(answers))("%s: ten right answers are accepted, ten wrong ones are not", (name, one) => {
  expect(one.right.length).toBeGreaterThanOrEqual(10);
  expect(one.wrong.length).toBeGreaterThanOrEqual(10);
  expect(one.right.filter((typed) => !solved(name, typed))).toEqual([]);
  expect(one.wrong.filter((typed) => solved(name, typed))).toEqual([]);
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
  const says = (answer: string): string | undefined => judges["describe"]?.(answer, bench).says;
  expect(says("RRP:1,2,0.5")).toBe("Not yet: link 1 does not end where it should.");
  expect(says("RRP:2,1,5")).toBe("Not yet: the tool is not where it should be.");
  expect(says("RRR:2,1,0.5")).toBe("Not yet: joint 3 is revolute there.");
  expect(says("RP:2,1")).toBe("Not yet: that arm has 2 joints, and the wanted one 3.");
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
  const tested = Object.keys(answers);
  expect(new Set(blocks.map(([, name]) => name))).toEqual(new Set(tested));
  expect(blocks.length).toBe(tested.length); // its name is the address of an exercise: it stands in one lesson
  for (const [i, text] of all.entries()) if (!/```tool/.test(text)) expect(text, `lesson ${i}`).toMatch(/```check/);
  expect(new Set(Object.keys(exercises))).toEqual(new Set(tested));
  expect(new Set(Object.keys(judges))).toEqual(new Set(tested));
  expect(tested.filter((name) => figureNames.includes(name))).toEqual([]); // nor of a figure
  for (const figure of Object.values(figureOf)) expect(figureNames).toContain(figure);
  for (const [, name, body = ""] of blocks) {
    expect(body, name).toMatch(/^\S[\s\S]+\nhint:/);
    expect(body, name).toMatch(/^solution:/m);
  }
  const figures = all.flatMap((text) => [...text.matchAll(/```figure (\S+)/g)].map(([, name]) => name));
  expect(new Set(figures)).toEqual(new Set(figureNames));
  expect(figures).toEqual(expect.arrayContaining(["1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8", "1.9"]));
  for (const text of all.filter((one) => !one.includes("```tool")))
    expect(text).toMatch(/```sources\n(?:\S.* \| \S.*\n)+```\n$/);
});

test("on paper exercises stand alone that speak of the page or of their lesson", () => {
  const all = readdirSync(texts).map((name) => readFileSync(`${texts}/${name}`, "utf8"));
  const paper = all.flatMap((text) =>
    [...text.matchAll(/```check (\S+)\n(?:(?!```)[\s\S])*?^paper:/gm)].map(([, name]) => name),
  );
  const needed = ["reach", "draw-rp", "formula-rp", "gain", "singular", "rp-jacobian"];
  expect(paper).toEqual(expect.arrayContaining([...needed, "elbow", "screw", "body-column", "intervals"]));
});

test("a lesson becomes HTML with its hints, solution and numbered equations", () => {
  const html = lessonHtml(
    "$$(1.3) a = b $$\n\n```check gain\nFind $K$.\nhint: Try $x$.\nsolution: It is\n  _two_.\n```\n\n" +
      "Shown:\n\n```console\n$ beeline\n```\n\n```sources\nThis | that\n```\n",
  );
  expect(html).toContain('<span class="equation"><math');
  expect(html).toContain("<span>(1.3)</span>");
  expect(html).toMatch(
    /<div data-check="gain"><p class="task">Find <math.*<\/p><details class="hint"><summary>Hint 1</,
  );
  expect(html).not.toContain("beeline"); // a session
  expect(html).toContain("<p>Shown.</p>");
  expect(html).toContain("<dt>This</dt><dd>that</dd>");
  expect(html).toContain(
    '<details class="solution"><summary>Solution</summary><p>It is\n  <em>two</em>.</p></details>',
  );
});

test("results become a code and back; a code that is cut off, changed or no code is refused", async () => {
  const all = [
    { name: "rp", answer: "(1+d2)cosθ1; (1+d2)sinθ1; θ1", time: 29_000_000 * 60_000 },
    { name: "singular", answer: "30,0,20 → 30°", time: 29_000_017 * 60_000 },
  ];
  const code = await codeOf(all);
  expect(code).toMatch(/^beeline1-[\w-]+$/);
  expect(await resultsOf(code)).toEqual(all);
  expect(await resultsOf(`${code.slice(0, 30)}\n ${code.slice(30)}`)).toEqual(all); // as mail wraps it
  await expect(resultsOf(code.slice(0, -1))).rejects.toThrow("cut off or changed");
  const other = code[20] === "a" ? "b" : "a";
  await expect(resultsOf(code.slice(0, 20) + other + code.slice(21))).rejects.toThrow("cut off or changed");
  await expect(resultsOf("hello")).rejects.toThrow("begins with");
  const long = await resultsOf(await codeOf([{ name: "rp", answer: "x".repeat(5000), time: 0 }]));
  expect(long[0]?.answer.length).toBe(4100);
  await expect(resultsOf(code.replace("beeline1-", "beeline2-"))).rejects.toThrow("another version");
});

test.each([
  ["an answer of 24,000 blanks", [["string", `PPP${" ".repeat(24_000)}x`, 5]]],
  ["a name of 300 letters", [["x".repeat(300), "PPP", 5]]],
  ["a time beyond all dates", [["string", "PPP", 1e300]]],
  ["a time before 1970", [["string", "PPP", -1]]],
  ["half a minute", [["string", "PPP", 0.5]]],
  ["a time as text", [["string", "PPP", "5"]]],
  ["no time", [["string", "PPP"]]],
  ["a number as answer", [["string", 5, 5]]],
  ["no rows", { string: "PPP" }],
  ["nothing", null],
  ["more rows than there are exercises", Array.from({ length: 101 }, () => ["string", "PPP", 5])],
])("a forged code is refused: %s", async (_, rows) => {
  await expect(resultsOf(await codeOfContent(rows))).rejects.toThrow("other content than results");
});

test("a code that unpacks to more than any page writes is refused", async () => {
  await expect(resultsOf(await codeOfContent(" ".repeat(2_000_000)))).rejects.toThrow("other content");
  await expect(resultsOf(`beeline1-${"x".repeat(20_000)}`)).rejects.toThrow("longer than any");
  expect(await resultsOf(await codeOfContent([["string", "PPP", 1e8]]))).toEqual([
    { name: "string", answer: "PPP", time: 6e12 },
  ]);
});

test("judging takes time in proportion to the length of an answer: this test ends", () => {
  const judged = Object.keys(judges).filter((name) => !["constant-jacobian", "describe"].includes(name)); // long arms
  for (const filler of [" ", "r ", "1 ", "= ", "rad ", "(", ", ", "- ", "or "]) {
    const blank = filler.repeat(50_000 / filler.length);
    for (const name of judged)
      for (const answer of [`PPP${blank}x`, `30,0,0 → along${blank}x`, `${blank}no`])
        expect(solved(name, answer), `${name} ${filler}`).toBe(false);
  }
  for (const name of ["constant-jacobian", "describe"]) expect(solved(name, `PP${" ".repeat(400_000)}x`)).toBe(false);
});

test("codes are found as they arrive", async () => {
  const all = [1, 2, 3, 4].map((k) => ({ name: "rp", answer: `(1+d2)cosθ${k}; ${next()}`, time: 60_000 * k }));
  const code = await codeOf(all);
  const other = await codeOf(all.slice(0, 1));
  expect(code.length).toBeGreaterThan(76);
  expect(codesIn(`Ada: ${code}`)).toEqual([{ whose: "Ada", code }]);
  expect(codesIn(`${code} Ada Lovelace`)).toEqual([{ whose: "Ada Lovelace", code }]);
  expect(codesIn(`${code},\n"${other}"`)).toEqual([
    { whose: "Code 1", code },
    { whose: "Code 2", code: other },
  ]);
  expect(codesIn(`Ada,\u200b${code.slice(0, 30)}\u200b${code.slice(30)}\ufeff`)).toEqual([{ whose: "Ada", code }]);
  const mail = `Ada ${code.slice(0, 72)}\r\n${code.slice(72, 76)}\n> ${code.slice(76)}\r\nGrace ${other}\nThanks\n`;
  expect(codesIn(mail)).toEqual([
    { whose: "Ada", code },
    { whose: "Grace", code: other },
    { whose: "Thanks", code: "" },
  ]);
  expect(codesIn(`Ada ${code} Grace ${other}`)).toEqual([
    { whose: "Ada", code },
    { whose: "Grace", code: other },
  ]);
  expect(codesIn(`Ada ${code.slice(0, 40)}\nGrace: ${other}`)).toEqual([
    { whose: "Ada", code: code.slice(0, 40) },
    { whose: "Grace", code: other },
  ]);
});

test("a line without a code names the code below it, and no cut code takes it for its rest", async () => {
  const code = await codeOf([{ name: "rp", answer: `(1+d2)cosθ1; ${next()}`, time: 60_000 }]);
  const cut = code.slice(0, 50);
  expect(codesIn(`${cut}\nAnna\n${code}\nBob\n${code}`)).toEqual([
    { whose: "Code 1", code: cut },
    { whose: "Anna", code },
    { whose: "Bob", code },
  ]);
  expect(codesIn(`Anna Lind:\n\n${code.slice(0, 50)}\n> ${code.slice(50)}\nBob\nCleo\n${code}\nDora`)).toEqual([
    { whose: "Anna Lind", code },
    { whose: "Bob", code: "" },
    { whose: "Cleo", code },
    { whose: "Dora", code: "" },
  ]);
  const rest = code.slice(20, 70);
  expect(codesIn(`Anna ${code.slice(0, 20)}\n${rest}\n${code}`)).toEqual([
    { whose: "Anna", code: code.slice(0, 20) },
    { whose: `${rest.slice(0, 40)} …`, code: "" },
    { whose: "Code 3", code },
  ]);
});

test("reading codes takes time in proportion to the text: this test ends", async () => {
  const code = await codeOf([{ name: "rp", answer: "1", time: 60_000 }]);
  for (const filler of [" ", ":", "> ", "a\n", "a b\n", "> a\n", "beeline1-\n", "beeline1-a\nb\n", '"<']) {
    const text = filler.repeat(500_000 / filler.length);
    for (const all of [`${text}x`, `x${text}x`, `${code}${text}x`, `beeline1-${text}x ${code}`, `beeline1-x\n${text}`])
      expect(codesIn(all).length).toBeGreaterThan(0);
  }
  for (const sign of ["(", ")", "]", "} "]) expect(itemsOf(`1${sign.repeat(200_000)}2`).length).toBeGreaterThan(0);
});

test("a name of a file is no answer, and leaves the arms as they are", () => {
  for (const name of ["describe", "constant-jacobian"]) {
    for (const answer of ["my.urdf", "a.json", "x.xml", "./x", "a.b/c"]) {
      const { solved, says } = judges[name]?.(answer, bench) ?? {};
      expect([solved, says]).toEqual([false, `"${answer}" is no joint string and no name of an arm.`]);
    }
  }
});

test.each([
  ["steps", "18", "7"],
  ["spare", "7", "18"],
  ["ominus", "110", "7"],
  ["screw", "-7", "7"],
  ["body-column", "(0, 2, 1)", "7"],
  ["elbow", "90", "30°"],
])("a number is no name for another one: %s", (name, right, other) => {
  expect(solved(name, `n = ${right}`)).toBe(true);
  expect(solved(name, `${other} = ${right}`)).toBe(false);
});

test("between samples no tool leaves the bound, which is near the truth, and falls to a quarter", () => {
  const arm = core.arm("RRRR:3,2.5,2,1.5");
  const lengths = linkLengths(arm);
  expect(lengths).toEqual([3, 2.5, 2, 1.5]);
  for (let i = 0; i < 300; ++i) {
    const from = lengths.map(() => 6 * next() - 3);
    const to = from.map((value) => value + next() - 0.5);
    expect(Math.max(...sampledDeviation(arm, from, to, 40))).toBeLessThanOrEqual(lineBound(lengths, from, to));
  }
  arm.release();
  const rrr = core.arm("rrr");
  const [a, b] = [
    [112, -52, -60],
    [60, -45, -90],
  ].map((row) => row.map((value) => (value * Math.PI) / 180)) as [number[], number[]];
  const largest = (intervals: number): [bound: number, truth: number] => {
    const rows = lineRows(rrr, a, b, intervals);
    expect(rows.length).toBe(intervals + 1);
    const pairs = rows.slice(1).map((to, i): [number[], number[]] => [rows[i] ?? to, to]);
    return [
      Math.max(...pairs.map(([from, to]) => lineBound([3.5, 3.5, 2], from, to))),
      Math.max(...pairs.flatMap(([from, to]) => sampledDeviation(rrr, from, to, 40))),
    ];
  };
  const [[bound, truth], [half]] = [largest(16), largest(32)];
  expect(truth / bound).toBeGreaterThan(0.1);
  expect(truth).toBeLessThanOrEqual(bound);
  expect(bound / half).toBeCloseTo(4, 0);
  rrr.release();
});

test("a line turns by the shorter way", () => {
  const arm = core.arm("rrr");
  const [from, to] = [
    [60, 60, 50],
    [70, 60, 60],
  ].map((row) => row.map((value) => (value * Math.PI) / 180)) as [number[], number[]]; // 170° and -170°
  const rows = lineRows(arm, from, to, 4);
  expect(rows.length).toBe(5);
  for (const row of rows) expect(Math.cos(row.reduce((sum, value) => sum + value, 0))).toBeLessThan(-0.98);
  arm.release();
});

test("reach is judged alike in the page and in a code, to the hundredth of a millimetre", () => {
  const arm = core.arm("rrr");
  for (const away of [0.09999, 0.10001]) {
    const pose = poseOfRpy([2 + away, 6, 0, 0, 0, Math.PI / 4]);
    const [q] = arm.inverse(pose, [0.6, 1.7, -1.5]);
    expect(solved("reach", anglesText(Array.from(q ?? [])))).toBe(away < 0.1);
  }
  arm.release();
});

test("at the wrist singularity of the Puma only the sum of joints 4 and 6 counts, as the exercise says", () => {
  const arm = core.arm("puma560");
  const degree = Math.PI / 180;
  const q = wristStart;
  const turned = q.map((value, k) => value + (k === 3 ? 30 : k === 5 ? -30 : 0) * degree);
  const [before, after] = [arm.forward(q).at(-1) ?? [], arm.forward(turned).at(-1) ?? []];
  for (let i = 0; i < 16; ++i) expect(after[i]).toBeCloseTo(before[i] ?? NaN, 12);
  arm.release();
  const text = readFileSync(fileURLToPath(new URL("../src/lessons/text/14_failures.md", import.meta.url)), "utf8");
  const links = [...text.matchAll(/wrist singularity[^]*?#arm=puma560&q=([-\d.,]+)/gi)].map(([, values]) => values);
  expect(links).toEqual([q.join(","), q.join(",")]);
});
