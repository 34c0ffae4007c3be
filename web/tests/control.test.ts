import { expect, test } from "vitest";
import type { Page } from "playwright-core";
import { stepResponse } from "../src/core/step_response.js";
import { chooseArm, drag, jointValues, pages, toWorld } from "./browser.js";
import { json, loadCore, random, run } from "./native.js";
import { stepsOfCommand, stepsOfProportional } from "./settling.js";

const from = [0, 0.3, 0.5];
const to = [1.73, -1.2, -0.53];
const section = `#arm=rrr&q=${from.join(",")}&goal=${to.join(",")}&section=control`;

const { opened } = pages();

test.each([
  { kp: 0.05, ki: 0, kd: 0 },
  { kp: 0.5, ki: 0.1, kd: 0.2 },
  { kp: 1.5, ki: 0, kd: 0 },
  { kp: 1.5, ki: 0.05, kd: 0.1 },
])("the step response of $kp, $ki, $kd equals beeline move", async (gains) => {
  const arm = (await loadCore()).arm("rrr");
  const given = Object.entries(gains).map(([name, value]) => `--${name}=${value}`);
  const args = ["move", "rrr", `--from=${from.join(",")}`, `--to=${to.join(",")}`, ...given, "--out=run.csv"];
  const { overshoot, steps } = json<{ overshoot: number; steps: number }>(args);
  const motion = arm.trajectory("run.csv", run(args).files["run.csv"] ?? "");
  const rows = motion.rows();
  motion.release();
  expect(rows.length).toBe(steps + 1);
  const response = stepResponse(arm, gains, from, to, steps);
  expect(response.overshoot).toBeCloseTo(overshoot, 12);
  rows.forEach((row, t) =>
    row.forEach((value, k) => {
      expect(Math.abs((to[k] as number) - value - (response.errors[k]?.[t] ?? NaN))).toBeLessThan(1e-12);
    }),
  );
  const far = (t: number): boolean =>
    to.some((end, k) => Math.abs(end - (rows[t]?.[k] ?? NaN)) >= 0.02 * Math.abs(end - (from[k] as number)));
  expect(far(response.settled as number)).toBe(false);
  expect(far((response.settled as number) - 1)).toBe(true);
  arm.release();
});

test("gains too small, good, too large, and unstable are seen in the step response", async () => {
  const page = await opened(section);
  const words = page.locator(".response");
  const kp = page.getByLabel("Kp, proportional gain", { exact: true });
  const type = async (value: string): Promise<void> => {
    await kp.fill(value);
    await kp.press("Enter");
  };
  await expect
    .poll(() => words.textContent())
    .toBe(`The errors stay below 2 % from step ${stepsOfProportional(0.1)} on.`);
  await type("0.02");
  await expect
    .poll(() => words.textContent())
    .toContain(`It crawls: the errors stay below 2 % from step ${stepsOfProportional(0.02)} on.`);
  await type("1.5");
  const native = json<{ overshoot: number }>([
    "move",
    "rrr",
    `--from=${from.join(",")}`,
    `--to=${to.join(",")}`,
    "--kp=1.5",
  ]);
  await expect.poll(() => words.textContent()).toContain(`overshoots by ${(100 * native.overshoot).toFixed(1)} %`);
  await type("2.3");
  await expect.poll(() => words.textContent()).toContain("Unstable");
  await type("0.5");
  await page.getByLabel("Ki, integral gain, slider").focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.getByLabel("Kd, derivative gain", { exact: true }).fill("0.2");
  await page.getByLabel("Kd, derivative gain", { exact: true }).press("Enter");
  await expect.poll(() => words.textContent()).toContain("overshoots by 20.5 %");
  const steps = stepsOfCommand("rrr", from, to, { kp: 0.5, ki: 0.1, kd: 0.2 });
  const outcome = `Joint space, PID: error below 2 % after ${steps} steps, and the goal is reached, overshoot 20.5 %`;
  await page.getByText(outcome).waitFor();
  await page.getByText("Step response in joint space, PID control: errors of the joints").waitFor(); // no longer eq. 1.3
  await expect.poll(() => page.url()).toContain("gain=0.5&ki=0.1&kd=0.2");
  await page.context().close();
});

test("near the goal the steps are counted by the same criterion, and it is said that hardly anything moves", async () => {
  const page = await opened("#arm=rrr&q=0,0.3,0.5&goal=0,0.3,0.50001&section=control");
  const steps = stepsOfProportional(0.1);
  for (const title of ["Joint space, eq. 1.3", "Cartesian space, eq. 1.6"])
    await page.getByText(`${title}: error below 2 % after ${steps} steps, and the goal is reached.`).waitFor();
  await page.getByText("so near the goal that hardly anything moves").waitFor();
  await page.context().close();
});

test("at the goal there is nothing to start, and the page says why", async () => {
  const page = await opened("#arm=rrr&q=0,0.3,0.5&goal=1,0.3,0.5&section=control");
  const go = page.getByRole("button", { name: /^Go in/ });
  await page.getByText(/^Joint space, eq. 1.3: .* and the goal is reached/).waitFor();
  await page.getByRole("button", { name: "Make this the goal" }).click();
  await page.getByText("The arm is at the goal: drag the arm or the goal elsewhere.").waitFor();
  expect(await go.evaluateAll((all) => all.map((one) => (one as HTMLButtonElement).disabled))).toEqual([true, true]);
  expect(await page.locator(".runs").isVisible()).toBe(false);
  await page.locator("#joint-0").fill("40");
  await page.keyboard.press("Enter");
  await page.getByText(/^Joint space, eq. 1.3: .* and the goal is reached/).waitFor();
  expect(await go.first().isEnabled()).toBe(true);
  await page.context().close();
});

test("the controllers are named with their equations, and the chart says which of them it shows", async () => {
  const page = await opened(section);
  await page.getByText("Step response in joint space (eq. 1.3): errors of the joints").waitFor();
  await page.getByText(/^Joint space, eq. 1.3: .* and the goal is reached\./).waitFor();
  await page.getByText(/^Cartesian space, eq. 1.6: .* and the goal is reached\./).waitFor();
});

/** The path of a trail, its last point's pixels. */
async function trail(page: Page, tone: string): Promise<string> {
  return (await page.locator(`.trail.${tone} .dots`).getAttribute("d")) ?? "";
}

test("trails, chart and words follow the gain while it moves; they come back with the section", async () => {
  const page = await opened(section);
  const steps = async (tone: string): Promise<number> => (await trail(page, tone)).split("M").length - 1;
  await expect.poll(() => steps("joint")).toBeGreaterThan(40);
  const before = { joint: await steps("joint"), cartesian: await steps("cartesian") };
  const kp = page.getByLabel("Kp, proportional gain, slider");
  await kp.focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await expect.poll(() => steps("joint")).toBeLessThan(0.7 * before.joint);
  await expect.poll(() => steps("cartesian")).toBeLessThan(0.7 * before.cartesian);
  await page.getByRole("link", { name: "Pose", exact: true }).click();
  await expect.poll(() => page.locator(".trail").count()).toBe(0);
  await page.getByRole("link", { name: "Control", exact: true }).click();
  await expect.poll(() => steps("joint")).toBeGreaterThan(10);
});

test("the dots are the steps of the command", async () => {
  const page = await opened(section);
  await page.getByText(/Cartesian space, eq. 1.6: .* and the goal is reached\./).waitFor();
  const arm = (await loadCore()).arm("rrr");
  const goal = json<{ pose: { planar: Record<string, number> } }>(["fk", "rrr", `--q=${to.join(",")}`]).pose.planar;
  const files = { "goal.csv": `x,y,theta\n${goal["x"]},${goal["y"]},${goal["theta"]}\n` };
  const ways = {
    joint: ["move", "rrr", `--to=${to.join(",")}`],
    cartesian: ["line", "rrr", "--through=goal.csv", "--method=inverse-jacobian"],
  };
  for (const [tone, args] of Object.entries(ways)) {
    const csv = run([...args, `--from=${from.join(",")}`, "--gain=0.1", "--out=run.csv"], files).files["run.csv"] ?? "";
    const motion = arm.trajectory("run.csv", csv);
    const points =
      (await trail(page, tone)).match(/-?[\d.]+ -?[\d.]+/g)?.map((text) => text.split(" ").map(Number)) ?? [];
    expect(points.length).toBeGreaterThan(20);
    const world = await toWorld(page);
    for (const [i, point] of points.entries()) {
      const pose = arm.forward(motion.row(i)).at(-1) as Float64Array;
      const [x = NaN, y = NaN] = world(point);
      expect(Math.hypot(x - (pose[12] ?? 0), y - (pose[13] ?? 0))).toBeLessThan(8e-3);
    }
    motion.release();
  }
  arm.release();
});

test.each([
  { gain: 2.3, factor: "−1.3" },
  { gain: 2.5, factor: "−1.5" },
])("a controller with the gain $gain diverges: picture, list and chart have one count, and say why", async (one) => {
  const steps = Math.ceil(Math.log(10) / Math.log(one.gain - 1)); // until the error is 10 times the first
  const page = await opened(`${section}&gain=${one.gain}`);
  const words = page.locator(".response");
  await words.getByText(`beyond 10 times the first after ${steps} steps.`).waitFor();
  const why = `Each step multiplies the error by 1 − Kp = ${one.factor}; it shrinks only for 0 < Kp < 2.`;
  expect(await words.textContent()).toContain(why);
  await page.getByText(`Joint space, eq. 1.3: beyond 10 times the first error after ${steps} steps.`).waitFor();
  await page.getByText(/Cartesian space, eq. 1.6: \d+ steps are drawn; it swings about the goal/).waitFor();
  await expect.poll(async () => (await trail(page, "joint")).split("M").length - 1).toBe(steps + 1);
  expect(await page.locator(".runs").textContent()).not.toMatch(/line 1 of 1|\d{4}/);
  await page.evaluate(`
    [window.most, window.labels] = [0, 3];
    (function look() {
      const values = [...document.querySelectorAll(".joints input[type=number]")].map(({ value }) => Math.abs(value));
      window.most = Math.max(window.most, ...values);
      window.labels = Math.min(window.labels, document.querySelectorAll(".drawing .angle-text").length);
      requestAnimationFrame(look);
    })();`);
  await page.getByRole("button", { name: "Go in joint space" }).click();
  await expect.poll(() => page.evaluate("window.most")).toBeGreaterThan(100);
  await expect.poll(() => page.evaluate("window.labels")).toBe(0); // while it moves
  await expect.poll(() => page.locator(".drawing .angle-text").count()).toBe(3);
  expect(Number(await page.evaluate("window.most"))).toBeLessThan(2000);
});

test("why a controller diverges is seen without scrolling", async () => {
  const page = await opened(`${section}&gain=2.3`, { width: 1280, height: 800 });
  const words = page.locator(".response");
  await words.getByText("it shrinks only for 0 < Kp < 2").waitFor();
  const box = await words.boundingBox();
  expect((box?.y ?? NaN) + (box?.height ?? NaN)).toBeLessThanOrEqual(800);
});

test("where joints have limits a controller that diverges leaves them, and the arm stays within", async () => {
  const page = await opened("#arm=panda&section=control&gain=2.4");
  await page.getByText(/Joint space, eq. 1.3: joint\d leaves its limits after \d+ steps?; beyond 10 times/).waitFor();
});

test("with integral and derivative gains the factor is of all of them", async () => {
  const page = await opened(`${section}&gain=1.9&ki=0.5&kd=0.3`);
  await page
    .locator(".response")
    .getByText(/In the end each step multiplies the error by about [1-9]/)
    .waitFor();
});

test("the default goal moves each joint by another amount: three curves are seen", async () => {
  const page = await opened("#arm=rrr&section=control");
  await expect.poll(() => page.url()).toContain("section=control");
  await page.getByRole("button", { name: "Go in joint space" }).click();
  await expect.poll(() => page.url()).toContain("goal=");
  const numbers = (name: string): number[] =>
    (new URL(page.url().replace("#", "?")).searchParams.get(name) ?? "").split(",").map(Number);
  const q = (await loadCore()).arm("rrr").displayConfiguration();
  const ways = numbers("goal").map((value, k) => Math.abs(value - (q[k] ?? NaN)));
  for (const [k, way] of ways.entries())
    for (const other of ways.slice(0, k)) expect(Math.abs(way - other)).toBeGreaterThan(0.1);
});

test("a second Go glides back to the start, and nothing below moves", async () => {
  const page = await opened(section);
  await page.getByText(/Joint space, eq. 1.3: .* and the goal is reached\./).waitFor();
  const go = page.getByRole("button", { name: "Go in joint space" });
  const gains = page.locator(".gains").first();
  const place = async (): Promise<number> => (await gains.boundingBox())?.y ?? NaN;
  const before = await place();
  await go.click();
  await expect.poll(async () => (await jointValues(page))[0]).toBeGreaterThan(98.9);
  await page.evaluate(`
    window.seen = [];
    (function look() {
      window.seen.push([document.querySelector("#joint-0").value, document.querySelector(".gains").getBoundingClientRect().y]);
      requestAnimationFrame(look);
    })();`);
  await go.click();
  const last = "window.seen.at(-1)[0]";
  await page.waitForFunction("window.seen.some(([value]) => value < 5)"); // at the start
  await expect.poll(async () => Number(await page.evaluate(last))).toBeGreaterThan(98.9);
  const seen = (await page.evaluate("window.seen")) as [string, number][];
  const values = seen.map(([value]) => Number(value));
  const arrival = values.findIndex((value) => value < 5);
  expect(arrival).toBeGreaterThan(0);
  expect(values.slice(0, arrival).filter((value) => value < 95).length).toBeGreaterThan(0); // on the way
  for (const [, y] of seen) expect(Math.abs(y - before)).toBeLessThan(1);
});

test("the arm goes to the goal and stays there; the goal is dragged; back to the start", async () => {
  const page = await opened(section);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.getByText(/Cartesian space, eq. 1.6: .* and the goal is reached\./).waitFor();
  await page.getByRole("button", { name: "Go in joint space" }).click();
  const degrees = to.map((value) => (value * 180) / Math.PI);
  await expect.poll(async () => Math.abs(((await jointValues(page))[0] ?? 0) - (degrees[0] ?? 0))).toBeLessThan(0.5);
  await expect.poll(async () => (await trail(page, "joint")).split("M").length - 1).toBeGreaterThan(20); // they stay
  await expect.poll(() => page.locator(".ghost.start").count()).toBe(1);
  await page.getByRole("button", { name: "Back to the start" }).click();
  await expect.poll(async () => (await jointValues(page))[1]).toBeCloseTo(((from[1] ?? 0) * 180) / Math.PI, 1);
  const goal = page.locator('.waypoints [data-grab="waypoint 0"]');
  const box = await goal.boundingBox();
  const at = { x: (box?.x ?? 0) + 16, y: (box?.y ?? 0) + 16 };
  const before = page.url();
  await drag(page, at, { x: at.x - 40, y: at.y + 10 });
  await expect.poll(() => page.url()).not.toBe(before);
  expect(page.url()).toContain(`q=${from.join(",")}`);
});

/** A chain whose names are long and hard to compress. */
function longUrdf(joints: number): string {
  const next = random(1);
  const letters = Array.from({ length: 94 }, (_, i) => String.fromCharCode(33 + i)).filter(
    (c) => !`<>&"'\\`.includes(c),
  );
  const letter = (): string => letters[Math.floor(next() * letters.length)] ?? "";
  const name = (): string => Array.from({ length: 980 }, letter).join("");
  const links = Array.from({ length: joints + 1 }, name);
  const parts = links.map((link, i) => {
    const ends = `<parent link="${links[i - 1] ?? ""}"/><child link="${link}"/><origin xyz="0.1 0 0"/>`;
    const joint = i > 0 ? `<joint name="${name()}" type="continuous">${ends}</joint>` : "";
    return `<link name="${link}"/>${joint}`;
  });
  return `<robot name="long">${parts.join("")}</robot>`;
}

test("a state too long for a link keeps the last address, and the page says so", async () => {
  const next = random(2);
  const pose = (): string => [next(), next(), next(), 1, 0, 0, 0].map((value) => value.toFixed(18)).join(",");
  const waypoints = Array.from({ length: 1000 }, pose).join(";");
  const page = await opened(`#arm=rrr&q=0.1,0.2,0.3&waypoints=${waypoints}`);
  await page.setInputFiles("#arm-file", {
    name: "long.urdf",
    mimeType: "text/xml",
    buffer: Buffer.from(longUrdf(100)),
  });
  const note = page.getByText("This is too long for a link: the address stays as it was. Share it as one file.");
  await note.waitFor();
  expect(page.url()).toContain("arm=rrr&q=0.1,0.2,0.3");
  await chooseArm(page, "panda");
  await expect.poll(() => page.url()).toContain("arm=panda");
  expect(await note.count()).toBe(0);
  await page.context().close();
});
