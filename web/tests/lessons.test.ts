import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { afterAll, beforeAll, expect, test } from "vitest";
import { checkConstantJacobian, checkFormulas, checkReach } from "../src/lessons/checks.js";
import { readFormula } from "../src/lessons/formula.js";
import { lessons } from "../src/lessons/lessons.js";
import { open, visit, type Visit } from "./browser.js";
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
])("%s is %d", (text, value) => {
  expect(readFormula(text, ["q1", "q2"])({ q1: 2, q2: 3 })).toBeCloseTo(value, 12);
});

test.each([
  "",
  "1 +",
  "(1",
  "1)",
  "q3",
  "sin 1",
  "constructor",
  "__proto__",
  "1 2",
  "(".repeat(500),
  "-".repeat(999),
  "1e999",
])("%j is refused", (text) => {
  expect(() => readFormula(text, ["q1"])).toThrow();
});

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
  const require = createRequire(import.meta.url);
  await page.evaluate(readFileSync(require.resolve("axe-core"), "utf8"));
  const found = await page.evaluate(
    "axe.run().then((all) => all.violations.map((one) => one.id + ': ' + one.nodes[0].html))",
  );
  expect(found).toEqual([]);
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(360);
  for (const link of await page.locator("article a").all()) {
    await link.click();
    await page.waitForTimeout(100);
    if ((await page.locator("article").count()) === 0 || !(await page.locator("article").isVisible())) break;
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
  await page.getByText("Not yet: the angle differ").waitFor();
  await page.getByLabel("θ =").fill("q1");
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText("Right: all three agree").waitFor();
});

test("a lesson opens with its figure: control in both spaces follows the gain, as the command line computes it", async () => {
  const { page, complaints } = await open(there, "#arm=ur5&section=lessons");
  await page.getByRole("link", { name: "9 Both side by side" }).click();
  await expect.poll(() => page.locator("#arm-text").inputValue()).toBe("rrr");
  const says = page.getByRole("status").filter({ hasText: "Orange" });
  await page.getByText(/within 2 % of the way after 38 steps\..*Cartesian space: reached after \d+ steps/).waitFor();
  const slider = page.getByLabel("Gain Kp");
  await slider.focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.getByText(/within 2 % of the way after 18 steps\..*Cartesian space: reached after \d+ steps/).waitFor();
  const goal = [1.73, -1.2, -0.53];
  const { pose } = json<{ pose: { matrix: number[][] } }>(["fk", "rrr", `--q=${goal.join(",")}`]);
  const angle = goal.reduce((sum, value) => sum + value, 0);
  const csv = `x,y,theta\n${pose.matrix[0]?.[3]},${pose.matrix[1]?.[3]},${angle}\n`;
  const line = ["line", "rrr", "--from=-0.5,0.9,-0.4", "--through=goal.csv", "--method=inverse-jacobian", "--gain=0.2"];
  const { steps } = json<{ steps: number }>(line, { "goal.csv": csv });
  expect(await says.textContent()).toContain(`reached after ${steps} steps`);

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
  await expect.poll(() => page.url()).toContain("q=");
  const words = new URL(page.url().replace("#", "?")).searchParams;
  expect(words.get("waypoints")).toBe("1,2,0,1,0,0,0;2,1,0,1,0,0,0");
  expect(words.get("unit")).toBe("rad");
  expect(words.get("section")).toBe("lessons");
});

test("a link to a lesson alone shows its figure", async () => {
  const { page } = await open(there, "#section=lessons&lesson=comparison");
  await page.getByText("3 Forward kinematics").waitFor();
  expect(await page.locator("#arm-text").inputValue()).toBe("rrr");
  expect(await page.getByText("There is no goal yet").count()).toBe(0);
});
