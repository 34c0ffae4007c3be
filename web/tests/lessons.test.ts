import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { checkConstantJacobian, checkReach } from "../src/lessons/checks.js";
import { allPages } from "../src/lessons/lessons.js";
import { axe, chooseArm, jointValues, open, shownArm, visit, type Visit } from "./browser.js";
import { loadCore, random } from "./native.js";
import { stepsOfProportional } from "./settling.js";

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

/** The links to the lessons. */
const contents = (page: Page) => page.getByRole("navigation", { name: "Lessons", exact: true });

/** Opens a lesson by the contents. */
async function turnTo(page: Page, title: string): Promise<void> {
  if (!(await contents(page).isVisible())) await page.locator(".contents summary").click();
  await contents(page).getByRole("link", { name: title, exact: true }).click();
}

let there: Visit;
beforeAll(async () => {
  there = await visit();
});
afterAll(() => there.close());

test.each(allPages.map(({ id, title }) => [id, title]))("the lesson %s opens, and is accessible", async (id, title) => {
  const { page, complaints } = await open(there, `#arm=rrr&section=lessons&lesson=${id}`, {
    width: 360,
    height: 740,
  });
  await page.locator("article h1").waitFor();
  await page.locator(".contents summary").click();
  await contents(page).getByRole("link", { name: title, exact: true }).waitFor();
  const found = await axe(page);
  expect(found).toEqual([]);
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(360);
  for (const details of await page.locator("article details summary").all()) await details.click();
  for (const link of await page.locator("article a").all()) {
    const address = (await link.getAttribute("href")) ?? "";
    const section = /section=(\w+)/.exec(address)?.[1] ?? "lessons";
    const arm = /arm=([^&:]+)/.exec(address)?.[1];
    if (arm === undefined) continue; // another lesson
    await link.click();
    await expect.poll(async () => (await shownArm(page))?.split(":")[0]).toBe(arm);
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
  const form = page.getByRole("form", { name: "Exercise" }).filter({ has: page.getByLabel("θ =") });
  await form.getByRole("button", { name: "Check" }).click();
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
  await expect.poll(() => shownArm(page)).toBe("R:1");
  await turnTo(page, "2 A planar arm");
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
  const right = page.getByText("Right: the tool is there.");
  await right.waitFor();
  await page.locator("#joint-0").fill("10");
  await page.keyboard.press("Enter");
  await right.waitFor({ state: "detached" });
});

test("a lesson opens with its figure: control in both spaces follows the gain, as the command line computes it", async () => {
  const { page, complaints } = await open(there, "#arm=ur5&section=lessons");
  await turnTo(page, "10 The two controllers compared");
  await expect.poll(() => shownArm(page)).toBe("rrr");
  const joint = page.getByText(/Joint space, eq. 1.3: error below 2 % after/);
  const [slow, fast] = [0.1, 0.2].map(
    (kp) => `error below 2 % after ${stepsOfProportional(kp)} steps, and the goal is reached`,
  );
  await page.getByText(`Joint space, eq. 1.3: ${slow}`).waitFor();
  const motion = page.getByRole("group", { name: "Motion" });
  await motion.getByText("eq. 1.3: 0 / 66").waitFor();
  await motion.getByLabel("Step", { exact: true }).fill("133");
  await motion.getByText("eq. 1.6: 66 / 66").waitFor(); // the same fraction of both errors is left
  await page.getByRole("link", { name: "from the start again" }).click();
  const slider = page.getByLabel("Gain Kp");
  await slider.focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.getByText(`Joint space, eq. 1.3: ${fast}`).waitFor();
  expect(await joint.count()).toBe(1);
  await page.getByText(`Cartesian space, eq. 1.6: ${fast}`).waitFor(); // one criterion for both

  await turnTo(page, "6 Joint-space control");
  await page.getByRole("heading", { name: "Joint-space motion control" }).waitFor();
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText(`Not yet: ${stepsOfProportional(0.1)} steps are needed.`).waitFor(); // the lesson begins with its own gain
  await page.getByLabel("Gain Kp").fill("0.5");
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText("Right: 6 steps, and no overshoot.").waitFor();

  await turnTo(page, "7 The Jacobian");
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
  await page.getByRole("heading", { name: "The two controllers compared" }).waitFor();
  await expect.poll(() => shownArm(page)).toBe("rrr");
  expect(await page.getByText("There is no goal").count()).toBe(0);
});

test("a lesson that a link opens takes the focus at its heading; numbers that follow the arm are not announced", async () => {
  const { page } = await open(there, "#arm=rrr&section=lessons&lesson=rrr");
  await page.locator(".contents summary").press("Enter");
  const link = contents(page).getByRole("link", { name: "7 The Jacobian" });
  await link.press("Enter");
  await page.locator("article .columns li").first().waitFor();
  expect(await page.locator('.contents a[aria-current="page"]').textContent()).toBe("7 The Jacobian");
  const heading = page.getByRole("heading", { name: "The Jacobian" });
  await expect.poll(() => heading.evaluate((one) => one === document.activeElement)).toBe(true);
  expect(await page.locator("[aria-live=polite] .columns, [role=status] .columns").count()).toBe(0);
  await page.context().close();
});

test("a reader of two columns: the text has 640 pixels, the picture stays, and the figure plays under it", async () => {
  const { page, complaints } = await open(there, "#section=lessons&lesson=worked", { width: 1280, height: 800 });
  await page.getByText("Figure 1.6").waitFor();
  const box = async (selector: string) =>
    (await page.locator(selector).boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
  expect((await box("#side")).width).toBe(640);
  const [stage, player] = [await box("#stage"), await box(".lesson-player")];
  expect(player.y).toBeGreaterThanOrEqual(stage.y + stage.height);
  expect(player.y + player.height).toBeLessThanOrEqual(800);
  const motion = page.getByRole("group", { name: "Motion" });
  await motion.getByRole("button", { name: "Step" }).click();
  await motion.getByText("1 / 45").waitFor();
  await motion.getByLabel("Speed").selectOption("4");
  await motion.getByRole("button", { name: "Play" }).click();
  await motion.getByText("45 / 45").waitFor();
  await expect.poll(() => jointValues(page)).toEqual([60, -45, -90]); // Figure 1.6 (b)
  await page.getByText("(b) θ").waitFor();
  await page.getByRole("link", { name: "(a) θ" }).click();
  await expect.poll(() => jointValues(page)).toEqual([112, -52, -60]);
  await page.locator("#side").evaluate((side) => side.scrollTo({ top: side.scrollHeight }));
  expect(await box("#stage")).toEqual(stage);
  expect(complaints).toEqual({ errors: [], requests: [] });
  await page.context().close();
});

test("Figure 1.7 starts from rest, also where the gain changes while the motion is shown", async () => {
  const { page } = await open(there, "#section=lessons&lesson=joint-control");
  const motion = page.getByRole("group", { name: "Motion" });
  await motion.getByText("0 / 66").waitFor();
  const start = (): Promise<string> =>
    page.locator(".trail.joint .line").evaluate((path) => path.getAttribute("d")?.split("L")[0] ?? "");
  await page.getByText(`error below 2 % after ${stepsOfProportional(0.1)} steps`).waitFor();
  const before = await start();
  for (let i = 0; i < 3; ++i) await motion.getByRole("button", { name: "Step" }).click();
  await motion.getByText("3 / 66").waitFor();
  await page.getByLabel("Gain Kp").fill("0.2");
  await page.getByText(`error below 2 % after ${stepsOfProportional(0.2)} steps`).waitFor();
  expect(await start()).toBe(before);
  await page.getByRole("link", { name: "from the start again" }).click();
  await expect.poll(() => jointValues(page)).toEqual([0, 0, 0]);
  await page.locator("#joint-0").fill("30");
  await page.keyboard.press("Enter");
  await expect.poll(start).not.toBe(before);
  await page.context().close();
});

test("a lesson says minutes and what is before it; previous and next; ticks are kept in the browser", async () => {
  const { page } = await open(there, "#section=lessons&lesson=cartesian");
  await page
    .getByText("Section 1.8, eq. 1.5 and 1.6 · 8 minutes · after 6 Joint-space control and 7 The Jacobian")
    .waitFor();
  const around = page.getByRole("navigation", { name: "Previous and next lesson" });
  await around.getByRole("link", { name: "9 Worked example of control" }).click();
  await page.getByText("Figure 1.9").waitFor();
  await around.getByRole("link", { name: "8 Cartesian control" }).click();
  await page.getByLabel("Angle", { exact: true }).fill("-250");
  await page.keyboard.press("Enter");
  await page.getByText("Not yet: it is not −250°.").waitFor();
  await page.getByText("Hint 1").click();
  await page.getByText("Go both ways round the circle.").waitFor();
  await page.getByLabel("Angle", { exact: true }).fill("110°");
  await page.keyboard.press("Enter");
  await page.getByText("16 · 1 done").waitFor(); // its only exercise is solved
  expect(await page.locator(".lesson-foot input").isChecked()).toBe(true);
  await page.reload();
  await page.getByText("16 · 1 done").waitFor();
  await page.locator(".lesson-foot input").uncheck();
  await page.getByText("16 · 0 done").waitFor();
  await page.context().close();
});

test("a formula is typeset beside its field, and the pose that it describes is in the picture while the arm moves", async () => {
  const { page } = await open(there, "#section=lessons&lesson=forward");
  await page.getByLabel("x =").fill("(1+d2)c1");
  await page.getByLabel("y =").fill("(1+d2) sin th1");
  await page.getByLabel("θ =").fill("θ_1");
  await expect.poll(() => page.locator(".typeset math").first().textContent()).toBe("(1+d2)cosθ1");
  await page.getByRole("button", { name: "Show this arm" }).click();
  await expect.poll(() => shownArm(page)).toBe("rp");
  const label = page.locator(".waypoint-text", { hasText: "your formula" });
  await label.waitFor();
  const before = await label.boundingBox();
  await page.locator("#joint-0").fill("60");
  await page.keyboard.press("Enter");
  await expect.poll(() => label.boundingBox()).not.toEqual(before);
  const ring = page.locator(".waypoints .ring").first();
  const off = await page.evaluate(`(() => {
    const [x, y] = document.getElementById("stage").dataset.tool.split(",").map(Number);
    const ring = document.querySelector(".waypoints .ring");
    return Math.hypot(ring.getAttribute("cx") - x, ring.getAttribute("cy") - y);
  })()`);
  expect(await ring.count()).toBe(1);
  expect(off).toBeLessThan(1);
  await page.getByLabel("y =").fill("(1+d2) cos th1");
  await page.keyboard.press("Enter");
  await page.getByText("y is 2.60 by your formula, and 1.50 on the arm").waitFor();
  await page.getByRole("button", { name: "Show it there" }).click();
  await expect.poll(() => jointValues(page)).toEqual([30, 2]);
  await page.context().close();
});

test("the arm RP is drawn with the mouse, and the verdict shows where the drawing differs", async () => {
  const { page } = await open(there, "#section=lessons&lesson=forward");
  const board = page.locator(".board");
  await board.scrollIntoViewIfNeeded();
  const box = (await board.boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
  const metre = box.width / 4; // from -0.75 to 3.25
  const place = (x: number, y: number): Promise<void> =>
    page.mouse.click(box.x + (x + 0.75) * metre, box.y + (2.5 - y) * metre);
  const form = page.getByRole("form", { name: "Exercise" }).filter({ has: board });
  await form.getByText("Next part: Joint R.").waitFor();
  await place(0, 0);
  await form.getByText("R at (0, 0). Next part: Joint P.").waitFor();
  await place(1, 0);
  await place(2.1, 0.6); // snaps to (2, 0.5)
  await form.getByText("R at (0, 0), P at (1, 0), tool at (2, 0.5)").waitFor();
  await form.getByRole("button", { name: "Check" }).click();
  await form.getByText("Not yet: at θ1 = 0°, d2 = 1.5 m your tool is at").waitFor();
  await expect.poll(() => board.locator(".moved .joint").count()).toBe(2);
  await form.getByRole("button", { name: "Take back" }).click();
  await board.focus();
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await form.getByText("R at (0, 0), P at (1, 0), tool at (2, 0)").waitFor();
  await form.getByRole("button", { name: "Check" }).click();
  await form.getByText("Right: the tool is where it is to be at three configurations.").waitFor();
  await expect.poll(() => shownArm(page)).toBe("rp"); // as it is drawn
  await expect.poll(() => jointValues(page)).toEqual([0, 1]);
  await page.getByText("Another arm is in the picture.").waitFor({ state: "hidden" });
  await page.context().close();
});

test("another arm than the lesson's is said, and one button brings it back", async () => {
  const { page } = await open(there, "#section=lessons&lesson=worked");
  await page.getByText("Figure 1.6").waitFor();
  await chooseArm(page, "panda");
  await expect.poll(() => shownArm(page)).toBe("panda");
  await page.getByRole("button", { name: "Show the lesson’s arm" }).click();
  await expect.poll(() => shownArm(page)).toBe("rrr");
  await page.getByText("Another arm is in the picture.").waitFor({ state: "hidden" });
  await page.context().close();
});

test("on a phone the handle makes the text taller", async () => {
  const { page } = await open(there, "#section=lessons&lesson=worked", { width: 390, height: 844 });
  await page.getByText("Figure 1.6").waitFor();
  const height = async (): Promise<number> => (await page.locator("#side").boundingBox())?.height ?? 0;
  const before = await height();
  await page.getByRole("button", { name: "Taller text" }).click();
  await expect.poll(height).toBeGreaterThan(before + 100);
  await page.getByRole("button", { name: "Taller text", expanded: true }).click();
  await expect.poll(height).toBe(before);
  await page.context().close();
});

test("Figure 1.9 has straight trails through three waypoints, and the redundant arm moves while its tool rests", async () => {
  const { page, complaints } = await open(there, "#section=lessons&lesson=waypoints");
  await page.getByText("Figure 1.9").waitFor();
  await expect.poll(() => page.locator(".waypoints .ring").count()).toBe(3);
  const says = page.getByText(/^\d+ steps\. The tool leaves the straight lines by up to 28 mm\. A dot is 5 steps\.$/);
  await says.waitFor(); // as the command measures it: docs/errata.md
  await page.getByLabel("Gain Kp").fill("0.1");
  await page.getByText(/^\d+ steps\. The tool leaves the straight lines by up to 15\d mm\.$/).waitFor();
  await turnTo(page, "15 A redundant arm");
  await expect.poll(async () => (await shownArm(page))?.split(":")[0]).toBe("RRRR");
  const pose = page.locator(".drawing .pose-text");
  const before = await pose.textContent();
  const q = await jointValues(page);
  const motion = page.getByRole("group", { name: "Motion" });
  for (let i = 0; i < 5; ++i) await motion.getByRole("button", { name: "Step" }).click();
  await expect.poll(() => jointValues(page)).not.toEqual(q);
  expect(await pose.textContent()).toBe(before);
  expect(complaints).toEqual({ errors: [], requests: [] });
  await page.context().close();
});
