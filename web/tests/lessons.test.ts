import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, expect, test } from "vitest";
import { exercises } from "../src/lessons/exercises.js";
import { checkConstantJacobian, checkFormulas, checkReach } from "../src/lessons/checks.js";
import { readFormula } from "../src/lessons/formula.js";
import { lessons } from "../src/lessons/lessons.js";
import { lessonFigures } from "../src/page/lesson_figures.js";
import { axe, open, shownArm, visit, type Visit } from "./browser.js";
import { json, loadCore, random } from "./native.js";

const next = random(Number(process.env["BEELINE_SEED"] ?? 20240229));
const core = await loadCore();

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
  ["180°", Math.PI],
])("%s is %d", (text, value) => {
  expect(readFormula(text, ["q1", "q2"])({ q1: 2, q2: 3 })).toBeCloseTo(value, 12);
});

test.each(["", "1 +", "(1", "1)", "q3", "constructor", "__proto__", "1 2", "(".repeat(500), "-".repeat(999), "1e999"])(
  "%j is refused",
  (text) => {
    expect(() => readFormula(text, ["q1"])).toThrow();
  },
);

test("formulas of the RP arm: right ones are accepted however they are written, wrong ones are not", () => {
  const arm = core.arm("rp");
  const right = { x: "cos(q1)*(1 + q2)", y: "sin(q1) + q2*sin(q1)", angle: "q1" };
  expect(checkFormulas(right, arm, next).solved).toBe(true);
  expect(checkFormulas({ ...right, angle: "q1 + 2*pi" }, arm, next).solved).toBe(true);
  for (const wrong of [{ x: "cos(q1)" }, { y: "sin(q1)*q2" }, { angle: "q2" }, { x: "" }, { x: "0/0" }]) {
    expect(checkFormulas({ ...right, ...wrong }, arm, next).solved).toBe(false);
  }
  arm.release();
});

test("the lessons name every exercise and every figure of the page, and no others", () => {
  const folder = fileURLToPath(new URL("../src/lessons/text/", import.meta.url));
  const files = readdirSync(folder).map((name) => readFileSync(folder + name, "utf8"));
  expect(files.length).toBe(lessons.length);
  const named = (kind: string): string[] =>
    files.flatMap((text) =>
      [...text.matchAll(new RegExp(`^\`\`\`${kind} (\\S+)$`, "gm"))].map(([, name]) => name ?? ""),
    );
  expect(named("check").sort()).toEqual(Object.keys(exercises).sort());
  expect(named("figure").sort()).toEqual(Object.keys(lessonFigures).sort());
});

/** Ways to write a product, a joint's value and a function, as textbooks and people do. */
const products = ["*", "", " ", "·", "×", " \\cdot "];
const variables: [string, string][] = [
  ["q1", "q2"],
  ["q_1", "q_2"],
  ["q₁", "q₂"],
  ["θ1", "d2"],
  ["θ_1", "d_2"],
  ["θ₁", "d₂"],
  ["\\theta_1", "d_{2}"],
  ["theta1", "d2"],
];
test.each(variables)("formulas in %s and %s are accepted with every sign of a product", (first, second) => {
  const arm = core.arm("rp");
  for (const times of products) {
    for (const f of ["cos(A)", "cos A", "\\cos(A)", "Cos(A)"].map((text) => text.replace("A", first))) {
      const x = [`(1 + ${second})${times}${f}`, `${f}${times}(1 + ${second})`, `x = ${f} + ${second}${times}${f}`];
      const sine = f.replace(/cos/i, "sin");
      for (const [i, text] of x.entries()) {
        const y = text.replaceAll(f, sine).replace("x =", "y =");
        const verdict = checkFormulas({ x: text, y, angle: i === 1 ? `${first} − 2pi` : first }, arm, next);
        expect(verdict.solved, `${text}, ${y}: ${verdict.says}`).toBe(true);
        expect(checkFormulas({ x: text, y: text, angle: first }, arm, next).says).toMatch(/^Not yet: y differs at/);
      }
    }
  }
  const short = { x: "c1 (1 + d2)", y: "s₁(1+d₂)", angle: first };
  expect(checkFormulas(short, arm, next).solved).toBe(true);
  arm.release();
});

test("constant Jacobians", () => {
  for (const [text, constant] of [
    ["gantry", true],
    ["P:1", true],
    ["rrr", false],
    ["rp", false],
    ["scara", false],
  ] as const) {
    const arm = core.arm(text);
    expect(checkConstantJacobian(arm, next).solved, text).toBe(constant);
    arm.release();
  }
});

test("a pose is reached within 0.1 m and 3 degrees", () => {
  const arm = core.arm("rrr");
  const q = [0.4, 0.9, 0.3];
  const pose = arm.forward(q).at(-1) as Float64Array;
  const goal = { x: pose[12] as number, y: pose[13] as number, degrees: (1.6 * 180) / Math.PI };
  expect(checkReach(pose, goal).solved).toBe(true);
  expect(checkReach(pose, { ...goal, degrees: goal.degrees - 360 }).solved).toBe(true);
  expect(checkReach(pose, { ...goal, x: goal.x + 0.2 }).solved).toBe(false);
  expect(checkReach(pose, { ...goal, degrees: goal.degrees + 5 }).solved).toBe(false);
  arm.release();
});

let there: Visit;
beforeAll(async () => {
  there = await visit();
});
afterAll(() => there.close());

test.each(lessons.map(({ id, title }) => [id, title]))("the lesson %s opens, and is accessible", async (id, title) => {
  const { page, complaints } = await open(there, `#arm=rrr&section=lessons&lesson=${id}`, { width: 360, height: 740 });
  await page.getByRole("link", { name: title, exact: true }).waitFor();
  await page.locator("article h1").waitFor();
  const found = await axe(page);
  expect(found).toEqual([]);
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(360);
  for (const link of await page.locator("article a").all()) {
    const address = (await link.getAttribute("href")) ?? "";
    const section = /section=(\w+)/.exec(address)?.[1] ?? "lessons";
    await link.click();
    await expect.poll(() => shownArm(page)).toBe(/arm=([^&]+)/.exec(address)?.[1] ?? "rrr");
    await expect.poll(() => page.url()).toContain(`section=${section}`);
    if (section !== "lessons") break;
  }
  expect(complaints).toEqual({ errors: [], requests: [] });
  await page.context().close();
});

test("an exercise is checked in the page", async () => {
  const { page } = await open(there, "#arm=rrr&section=lessons&lesson=forward");
  await page.getByLabel("x =").fill("cos(q1)*(1+q2)");
  await page.getByLabel("y =").fill("sin(q1)*(1+q2)");
  await page.getByLabel("θ =").fill("q2");
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText("Not yet: the angle differs").waitFor();
  await page.getByLabel("θ =").fill("q1");
  await page.keyboard.press("Enter");
  await page.getByText("Right: all three agree").waitFor();
});

test("lessons bring the arm that they speak of, and both elbows are seen", async () => {
  const { page, complaints } = await open(there, "#arm=panda");
  await page.getByRole("link", { name: "Lessons" }).click();
  await expect.poll(() => shownArm(page)).toBe("rrr");
  await page.getByRole("link", { name: "2 A planar arm" }).click();
  await page.getByRole("link", { name: "in two ways" }).click();
  await expect.poll(() => page.locator(".ghost.solution").count()).toBe(1);
  await page.goBack();
  await page.goBack();
  await expect.poll(() => shownArm(page)).toBe("panda");
  expect(complaints).toEqual({ errors: [], requests: [] });
});

test("the pose that an exercise asks for is in the picture, and its verdict goes when the arm moves on", async () => {
  const { page } = await open(there, "#section=lessons&lesson=rrr");
  await page.locator(".waypoint-text", { hasText: "target" }).waitFor();
  const panel = page.getByLabel("Pose of the tool");
  for (const [name, value] of [
    ["x", "3"],
    ["y", "5.5"],
    ["θ", "45"],
    ["x", "2"],
    ["y", "6"],
  ] as const) {
    await panel.getByLabel(name, { exact: true }).fill(value);
    await page.keyboard.press("Enter");
  }
  await page.getByRole("button", { name: "Check" }).click();
  const right = page.getByText("Right: the tool is there.");
  await right.waitFor();
  await page.locator("#joint-0").fill("10");
  await page.keyboard.press("Enter");
  await right.waitFor({ state: "detached" });
});

test("a lesson opens with its figure: control in both spaces follows the gain, as the command line computes it", async () => {
  const { page, complaints } = await open(there, "#arm=ur5&section=lessons");
  await page.getByRole("link", { name: "9 Both side by side" }).click();
  await expect.poll(() => shownArm(page)).toBe("rrr");
  const joint = page.getByText(/Joint space: within 2 % of the way after/);
  const says = page.getByText(/Cartesian space: within 2 % of the way after \d+ steps, reached/); // one criterion for both
  await page.getByText(/Joint space: within 2 % of the way after 38 steps, reached/).waitFor();
  await says.waitFor();
  const slider = page.getByLabel("Gain Kp");
  await slider.focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.getByText(/Joint space: within 2 % of the way after 18 steps, reached/).waitFor();
  expect(await joint.count()).toBe(1);
  const goal = [1.73, -1.2, -0.53];
  const { pose } = json<{ pose: { matrix: number[][] } }>(["fk", "rrr", `--q=${goal.join(",")}`]);
  const angle = goal.reduce((sum, value) => sum + value, 0);
  const csv = `x,y,theta\n${pose.matrix[0]?.[3]},${pose.matrix[1]?.[3]},${angle}\n`;
  const line = ["line", "rrr", "--from=-0.5,0.9,-0.4", "--through=goal.csv", "--method=inverse-jacobian", "--gain=0.2"];
  const { steps } = json<{ steps: number }>(line, { "goal.csv": csv });
  await expect.poll(() => says.textContent()).toContain(`reached after ${steps} steps`);

  await page.getByRole("link", { name: "6 Joint-space control" }).click();
  await page.getByRole("heading", { name: "Joint-space motion control" }).waitFor();
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText("Not yet: 18 steps are needed.").waitFor();
  await page.getByLabel("Gain Kp").fill("0.5");
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText("Right: 6 steps, and no overshoot.").waitFor();

  await page.getByRole("link", { name: "7 The Jacobian" }).click();
  await page.getByText("joint 1: (−5.50, 3.50) m/s").waitFor(); // as in Figure 1.8
  expect(complaints).toEqual({ errors: [], requests: [] });
  await page.context().close();
});

test("a link inside a lesson leaves the waypoints and the units as they are", async () => {
  const { page } = await open(
    there,
    "#arm=rrr&unit=rad&section=lessons&lesson=rrr&waypoints=1,2,0,1,0,0,0;2,1,0,1,0,0,0",
  );
  await page.getByRole("link", { name: "in two ways" }).click();
  await expect.poll(() => page.url()).toContain("solutions=1");
  const words = new URL(page.url().replace("#", "?")).searchParams;
  expect(words.get("waypoints")).toBe("1,2,0,1,0,0,0;2,1,0,1,0,0,0");
  expect(words.get("unit")).toBe("rad");
  expect(words.get("section")).toBe("lessons");
});

test("a link to a lesson alone shows its figure", async () => {
  const { page } = await open(there, "#section=lessons&lesson=comparison");
  await page.getByText("3 Forward kinematics").waitFor();
  expect(await shownArm(page)).toBe("rrr");
  expect(await page.getByText("There is no goal yet").count()).toBe(0);
});

test("a lesson is opened by key: its link keeps the focus, and numbers that follow the arm are not announced", async () => {
  const { page } = await open(there, "#arm=rrr&section=lessons&lesson=rrr");
  const link = page.getByRole("navigation", { name: "Lessons" }).getByRole("link").nth(6); // the Jacobian, with its figure
  await link.press("Enter");
  await page.locator("article .columns li").first().waitFor();
  expect(await link.getAttribute("aria-current")).toBe("page");
  expect(await link.evaluate((one) => one === document.activeElement)).toBe(true);
  expect(await page.locator("[aria-live=polite] .columns, [role=status] .columns").count()).toBe(0);
  await page.context().close();
});
