import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";
import { cartesianRows } from "../src/core/cartesian.js";
import type { JointDescription } from "../src/core/description.js";
import { poseError, toolPose } from "../src/core/pose.js";
import { readFormula } from "../src/lessons/formula.js";
import { formulaTasks, judges } from "../src/lessons/judges.js";
import { lessons } from "../src/lessons/lessons.js";
import { chooseArm, frames, jointValues, pages, shownArm } from "./browser.js";
import { loadCore, random } from "./native.js";

const next = random(Number(process.env["BEELINE_SEED"] ?? 20240229));
const core = await loadCore();
const texts = fileURLToPath(new URL("../src/lessons/text", import.meta.url));
const { opened } = pages();

test.each(lessons.map(({ title, ...one }) => [title, one] as const))(
  "the contents say the equations and the exercises of lesson %s",
  (title, { equations, exercises }) => {
    const file = readdirSync(texts).find((name) => name.startsWith(`${parseInt(title)}_`)) ?? "";
    const text = readFileSync(join(texts, file), "utf8");
    const numbered = [...text.matchAll(/^\$\$\((1\.\d)\)/gm)].map(([, number]) => number);
    expect(equations).toEqual(expect.arrayContaining(numbered));
    for (const number of equations)
      expect(text).toMatch(new RegExp(`^\\$\\$\\(${number}\\)|equation\\s${number}`, "m"));
    expect(exercises.length).toBe(text.match(/^```check /gm)?.length ?? 0);
  },
);

test("what a lesson is about is found by reading the contents", async () => {
  const page = await opened("#section=lessons&lesson=rrr");
  await page.locator(".contents summary").click();
  const line = (words: string) =>
    page.getByRole("navigation", { name: "Lessons", exact: true }).getByRole("listitem").filter({ hasText: words });
  await line("eq. 1.3").getByRole("link", { name: "6 Joint-space control" }).waitFor();
  await line("eq. 1.5 and 1.6").getByRole("link", { name: "8 Cartesian control" }).waitFor();
  await line("draw an arm").getByRole("link", { name: "3 Forward kinematics" }).waitFor();
  await line("singular configuration").getByRole("link", { name: "7 The Jacobian" }).waitFor();
});

test("in lesson 10 the Cartesian controller ends at the goal's pose with the elbow on the other side", async () => {
  const arm = core.arm("rrr");
  const goal = [99.2, -68.8, -30.4].map((value) => (value * Math.PI) / 180);
  const pose = Array.from(toolPose(arm, goal));
  const joints = goal.map(() => ({ limits: { lower: null, upper: null } }));
  const options = { gain: 0.1, tolerance: 1e-6, maxSteps: 2000 };
  const rows = [...cartesianRows(arm, joints as JointDescription[], [-0.5, 0.9, -0.4], [pose], options)];
  const end = rows.at(-1) ?? [];
  expect(Math.hypot(...poseError(toolPose(arm, end), pose))).toBeLessThan(1e-5);
  expect(end[1]).toBeCloseTo(-(goal[1] ?? NaN), 4);
  arm.release();
  const page = await opened("#section=lessons&lesson=comparison");
  await page.getByText("which the tool may reach in another configuration").waitFor();
});

test("the opening says how many lessons there are on the chapter and beyond it", async () => {
  const page = await opened();
  await page.getByText("16 lessons: 9 on the chapter, 7 beyond it").waitFor();
});

test("the examples in the fields of formulas can be typed, and are no answers", () => {
  const bench = { arm: (text: string) => core.arm(text), random: next };
  for (const [name, { names, asked, example }] of Object.entries(formulaTasks)) {
    expect(() => readFormula(example, names), name).not.toThrow();
    const verdict = judges[name]?.(asked.map(() => example).join("; "), bench);
    expect([name, verdict?.solved, verdict?.says.startsWith("Not yet")]).toEqual([name, false, true]);
  }
});

test("a button in an exercise that shows its arm leaves the lesson where it is read", async () => {
  const page = await opened("#section=lessons&lesson=forward");
  await page.getByText("Figure 1.4").waitFor();
  const field = page.getByLabel("x =");
  expect(await field.getAttribute("placeholder")).toMatch(/^e\.g\. /);
  await field.scrollIntoViewIfNeeded();
  const top = async (): Promise<number> => (await field.boundingBox())?.y ?? NaN;
  const before = await top();
  await page.getByRole("button", { name: "Show this arm" }).click();
  await expect.poll(() => shownArm(page)).toBe("rp");
  await page.getByRole("button", { name: "Show this arm" }).waitFor({ state: "hidden" });
  await frames(page);
  expect(Math.abs((await top()) - before)).toBeLessThan(60);
});

test("a lesson says that its arm has replaced another, and a button brings that one back", async () => {
  const page = await opened("#arm=panda&section=pose");
  await page.getByRole("link", { name: "Lessons" }).click();
  await expect.poll(() => shownArm(page)).toBe("R:1");
  await page.getByText("The lesson’s arm has replaced the one before.").waitFor();
  const before = page.getByRole("button", { name: "Show the arm before" });
  await before.click();
  await expect.poll(() => shownArm(page)).toBe("panda");
  await before.waitFor({ state: "hidden" });
  expect(page.url()).toContain("section=lessons");
  await page.locator("#joint-0").fill("20");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Show the lesson’s arm" }).click();
  await expect.poll(() => shownArm(page)).toBe("R:1");
  await before.click();
  await expect.poll(() => shownArm(page)).toBe("panda");
  expect((await jointValues(page))[0]).toBe(20);
});

test("the link q = 0 of lesson 7 sets all joints to 0 exactly, where the arm is singular", async () => {
  const page = await opened("#section=lessons&lesson=jacobian");
  await page.getByText("Figure 1.8").waitFor();
  for (const name of ["q = 0", "velocity ellipse"]) {
    await page.locator("#joint-1").fill("30");
    await page.keyboard.press("Enter");
    await page.getByRole("link", { name }).click();
    await expect.poll(() => jointValues(page)).toEqual([0, 0, 0]);
    await expect.poll(() => page.url()).toContain("q=0,0,0");
  }
  await page.locator(".ellipse, .ellipsoid").first().waitFor({ state: "attached" });
});

test("the matrices of Figure 1.4 follow the arm RP too, and of an arm in space the page says why there are none", async () => {
  const page = await opened("#section=lessons&lesson=forward");
  const matrices = page.locator("article .matrices math");
  await expect.poll(() => matrices.count()).toBe(3);
  await page.getByRole("link", { name: "RP", exact: true }).click();
  await expect.poll(() => shownArm(page)).toBe("rp");
  const numbers = async (i: number): Promise<string> =>
    (await matrices.nth(i).locator("mn").allTextContents()).join(" ");
  await expect.poll(() => numbers(1)).toBe("2 1 1.00 0.00 1.00 0.00 1.00 0.00 0.00 0.00 1.00"); // a slide turns nothing
  const [c, s] = [Math.cos(0.6), Math.sin(0.6)].map((value) => (2 * value).toFixed(2));
  await expect.poll(() => numbers(2)).toContain(`0.83 −0.56 ${c} 0.56 0.83 ${s} 0.00 0.00 1.00`);
  await page.getByRole("group", { name: "Motion" }).getByRole("button", { name: "Play" }).waitFor();
  await chooseArm(page, "panda");
  await page.getByText("The numbers here are only of planar arms without mimic joints.").waitFor();
  await expect.poll(() => matrices.count()).toBe(0);
});

test("of a planar arm with a mimic joint there are no matrices", async () => {
  const joint = (k: number, more = ""): string =>
    `<link name="link${k}"/><joint name="joint${k}" type="revolute"><parent link="link${k - 1}"/><child link="link${k}"/>
    <axis xyz="0 0 1"/><origin xyz="1 0 0"/><limit lower="-2" upper="2"/>${more}</joint>`;
  const urdf = `<robot name="coupled"><link name="link0"/>${joint(1)}${joint(2, '<mimic joint="joint1"/>')}${joint(3)}</robot>`;
  const page = await opened("#section=lessons&lesson=forward");
  const matrices = page.locator("article .matrices math");
  await expect.poll(() => matrices.count()).toBe(3);
  await page.setInputFiles("#arm-file", { name: "coupled.urdf", mimeType: "text/xml", buffer: Buffer.from(urdf) });
  await expect.poll(() => shownArm(page)).toBe("coupled");
  await page.getByText("The numbers here are only of planar arms without mimic joints.").waitFor();
  expect(await matrices.count()).toBe(0);
});

test("a verdict on the arm or the gain goes when these change", async () => {
  const page = await opened("#arm=rrr&q=0.5,0,0.3&section=lessons&lesson=jacobian");
  const direction = page.getByLabel("Direction");
  await direction.fill("θ1");
  await page.keyboard.press("Enter");
  const right = page.getByText("Right: along the line of the first two links, θ1.");
  await right.waitFor();
  await page.locator("#joint-1").fill("40");
  await page.keyboard.press("Enter");
  await right.waitFor({ state: "detached" });
  expect(await direction.inputValue()).toBe("θ1");
  await page.goto(page.url().replace(/#.*/, "#section=lessons&lesson=joint-control"));
  await page.getByLabel("Gain Kp").fill("0.5");
  await page.getByRole("button", { name: "Check" }).click();
  const found = page.getByText("Right: 6 steps, and no overshoot.");
  await found.waitFor();
  await page.getByLabel("Gain Kp").fill("0.1");
  await found.waitFor({ state: "detached" });
});

test("the section Pose leads from the arm RP to where it is drawn and its formula is found", async () => {
  const page = await opened("#arm=rp&q=0.5,1");
  await page.getByRole("link", { name: "Draw an arm RP and find its formula" }).click();
  await page.locator(".board").waitFor();
  await page.getByRole("button", { name: "Show the arm before" }).click();
  await expect.poll(() => shownArm(page)).toBe("rp");
  expect((await jointValues(page))[1]).toBe(1);
  await page.getByRole("link", { name: "Pose", exact: true }).click();
  await chooseArm(page, "panda");
  await expect.poll(() => page.getByRole("link", { name: /formula/ }).count()).toBe(0);
});

test("a link from a lesson to another opens it with its arm", async () => {
  const page = await opened("#section=lessons&lesson=worked");
  await page.getByText("which you have drawn in").getByRole("link", { name: "lesson 3" }).click();
  await page.locator(".board").waitFor();
  await expect.poll(() => shownArm(page)).toBe("RR:3.5,2.5");
});

test("drawings follow the theme: dark on white, or light on dark", async () => {
  const page = await opened("#section=lessons&lesson=describing");
  await page.getByText("As a drawing, like the chapter’s").click();
  const image = page.getByRole("img", { name: "Figure 1.5" });
  await image.waitFor();
  const filter = (): Promise<string> => image.evaluate((one) => getComputedStyle(one).filter);
  for (const [colorScheme, theme, expected] of [
    ["light", "", "none"],
    ["dark", "", "invert(0.91) hue-rotate(180deg)"],
    ["dark", "light", "none"],
    ["light", "dark", "invert(0.91) hue-rotate(180deg)"],
  ] as const) {
    await page.emulateMedia({ colorScheme });
    await page.evaluate((name) => (document.documentElement.dataset["theme"] = name), theme);
    expect([colorScheme, theme, await filter()]).toEqual([colorScheme, theme, expected]);
  }
  await page.emulateMedia({ media: "print" });
  expect(await filter()).toBe("none");
});
