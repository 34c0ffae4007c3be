import { afterAll, beforeAll, expect, test } from "vitest";
import { checkConstantJacobian, checkReach } from "../src/lessons/checks.js";
import { lessons } from "../src/lessons/lessons.js";
import { axe, open, shownArm, visit, type Visit } from "./browser.js";
import { json, loadCore, random } from "./native.js";

const next = random(Number(process.env["BEELINE_SEED"] ?? 20240229));
const core = await loadCore();

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
  await page
    .getByText("Not yet: θ differs. At θ1 = 30°, d2 = 2 m: θ is 114.6° by your formula, and 30.0° on the arm.")
    .waitFor();
  await page.getByLabel("θ =").fill("q1");
  await page.keyboard.press("Enter");
  await page.getByText("Right: all 3 agree").waitFor();
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
