import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { compressed } from "../src/address/compression.js";
import { compile, instantiateCommand } from "../src/core/load.js";
import type { NearestPair, SceneDocument } from "../src/core/scene.js";
import { SceneModule } from "../src/core/scene_module.js";
import { axe, drag, jointValues, pages, toolAt } from "./browser.js";
import { commandParts, json, run } from "./native.js";

const { opened } = pages();

const start = [0, -0.5, 0, -2.2, 0, 1.8, 0.8]; // of panda
const behind = start.with(0, 1.4);
/** A wall of 2 mm beside the arm, which ends in front of its base. */
const wall: SceneDocument = {
  obstacles: [{ name: "wall", shapes: [{ box: { size: [0.95, 0.002, 1.2] }, pose: { xyz: [0.725, 0.3, 0.6] } }] }],
};

async function hashOf(more: string, scene = wall, q = start): Promise<string> {
  const packed = await compressed(new TextEncoder().encode(JSON.stringify(scene)));
  return `#arm=panda&unit=rad&scene=${packed}&q=${q.join(",")}&${more}`;
}

const callout = (page: Page) => page.locator(".callout");
const firstJoint = async (page: Page): Promise<number> => (await jointValues(page))[0] ?? NaN;

/** Drags the slider of the first joint to a value. */
async function slideTo(page: Page, value: number): Promise<void> {
  await page.locator(".joints input[type=range]").first().fill(String(value));
}

/** The least distance beyond its clearance of panda at joint values, m. */
async function sparing(scene: SceneDocument): Promise<(q: number[]) => number> {
  const { factory, wasm } = await commandParts();
  const ignore = (): void => undefined;
  const module = new SceneModule(await instantiateCommand(factory, await compile(wasm), ignore, ignore));
  module.answer({ ask: "arm", arm: { argument: "panda", tip: "", files: {} }, clearance: 0 });
  const text = module.answer({ ask: "read", name: "scene.json", content: JSON.stringify(scene) }) as string;
  return (q) => {
    const [nearest] = module.answer({ ask: "nearest", scene: text, q }) as NearestPair[];
    return (nearest?.lower ?? NaN) - (nearest?.clearance ?? NaN);
  };
}

test("a slider stops the arm in front of a thin wall, in any section, unless it may pass; a number that is typed goes there", async () => {
  const page = await opened(await hashOf("section=pose"));
  await slideTo(page, 1.4);
  await callout(page)
    .getByText(/^panda_\w+ stops in front of wall\.$/)
    .waitFor();
  expect(await callout(page).getAttribute("role")).toBe("status");
  const held = await firstJoint(page);
  expect(held).toBeGreaterThan(0.3);
  expect(held).toBeLessThan(1);
  const spare = (await sparing(wall))(await jointValues(page));
  expect(spare).toBeGreaterThan(0);
  expect(spare).toBeLessThan(1e-3);
  expect(await axe(page)).toEqual([]);
  await slideTo(page, 0.2);
  await expect.poll(() => firstJoint(page)).toBeCloseTo(0.2, 3);
  await expect.poll(() => callout(page).isVisible()).toBe(false);
  await page.locator("#joint-0").fill("1.4");
  await page.keyboard.press("Enter");
  await expect.poll(() => firstJoint(page)).toBeCloseTo(1.4, 3);
  await page.getByRole("link", { name: "Obstacles", exact: true }).click();
  await page.getByLabel("Let the arm pass through obstacles").check();
  await expect.poll(() => page.url()).toContain("passes=1");
  await slideTo(page, 0);
  await expect.poll(() => firstJoint(page)).toBeCloseTo(0, 3);
  const again = await opened(new URL(page.url()).hash);
  await again.getByRole("checkbox", { name: "Let the arm pass through obstacles", checked: true }).waitFor();
});

test("an arm that is in an obstacle says so, and a slider moves it out", async () => {
  const ball = { name: "ball", shapes: [{ sphere: { radius: 0.12 }, pose: { xyz: [0.45, 0.1, 0.5] } }] };
  const page = await opened(await hashOf("section=obstacles", { obstacles: [ball] }, start.with(0, 0.02)));
  await page.locator(".nearest .over").filter({ hasText: "ball" }).waitFor();
  await slideTo(page, 0.2);
  await callout(page)
    .getByText(/^panda_\w+ is too close to ball: it can only move away\.$/)
    .waitFor();
  expect(await firstJoint(page)).toBeLessThan(0.05);
  await slideTo(page, -0.5);
  await expect.poll(() => firstJoint(page)).toBeCloseTo(-0.5, 3);
  await expect.poll(() => callout(page).isVisible()).toBe(false);
});

/** A plate of 2 mm at the right of the tool, in the picture. */
const plate: SceneDocument = {
  obstacles: [
    {
      name: "plate",
      shapes: [{ box: { size: [0.002, 0.3, 0.5] }, pose: { xyz: [0.515, 0.09, 0.37], rpy: [0, 0, 0.7] } }],
    },
  ],
};

test("the tool that is dragged through a plate stays in front of it in each picture; dropped, the arm goes around", async () => {
  const page = await opened(await hashOf("section=obstacles", plate), { width: 1280, height: 800 });
  await page.locator(".nearest p").nth(1).waitFor();
  const from = await toolAt(page);
  await page.evaluate(`
    window.shown = [];
    (function look() {
      window.shown.push([...document.querySelectorAll(".joints input[type=number]")].map(({ value }) => Number(value)));
      window.looking = requestAnimationFrame(look);
    })();`);
  await drag(page, from, { x: from.x + 230, y: from.y }, false);
  await callout(page)
    .getByText(/^panda_\w+ stops in front of plate\. Let go to plan a way around\.$/)
    .waitFor();
  await page.evaluate("cancelAnimationFrame(window.looking)");
  const spare = await sparing(plate);
  const shown = new Map((await page.evaluate<number[][]>("window.shown")).map((q) => [q.join(","), q]));
  expect(shown.size).toBeGreaterThan(3);
  for (const q of shown.values()) expect(spare(q)).toBeGreaterThan(-2e-4); // the numbers are rounded
  await page.mouse.up();
  const report = page.getByRole("region", { name: "A way around" });
  await report.getByText(/^Proved: at every time each of the \d+ pairs of bodies that count keeps at least/).waitFor();
  await expect.poll(() => callout(page).isVisible()).toBe(false);
  const goal = async (): Promise<number[]> =>
    (new URL(page.url().replace("#", "?")).searchParams.get("goal") ?? "").split(",").map(Number);
  const away = async (): Promise<number> => {
    const [values, wanted] = [await jointValues(page), await goal()];
    return Math.max(...values.map((value, k) => Math.abs(value - (wanted[k] ?? NaN))));
  };
  await expect.poll(away).toBeLessThan(1e-3);
});

test("a way around to the goal is what the command plans; it is played, and proved by the command", async () => {
  const page = await opened(await hashOf(`section=obstacles&goal=${behind.join(",")}`));
  const report = page.getByRole("region", { name: "A way around" });
  await report.getByRole("button", { name: "Go around" }).click();
  await report.getByText("reached").waitFor();
  await expect.poll(() => firstJoint(page)).toBeCloseTo(1.4, 3);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    report.getByRole("button", { name: "Save motion.csv" }).click(),
  ]);
  const motion = readFileSync((await download.path()) ?? "", "utf8");
  const files = { "motion.csv": motion, "scene.json": JSON.stringify(wall) };
  const { clearance } = json<{ clearance: { status: string } }>(
    ["check", "panda", "motion.csv", "--scene=scene.json"],
    files,
  );
  expect(clearance.status).toBe("clear");
  expect(await axe(page)).toEqual([]);
  await report.getByRole("button", { name: "Remove the goal" }).click();
  await expect.poll(() => report.getByText("reached").count()).toBe(0);
  await report.getByRole("button", { name: "Set the goal here" }).click();
  await expect.poll(() => page.url()).toMatch(/goal=1\.39999|goal=1\.4/);
});

test("the goal is dragged in the picture, and a way there is planned when it is dropped", async () => {
  const page = await opened(await hashOf(`section=obstacles&goal=${behind.join(",")}`));
  await page.locator(".nearest p").nth(1).waitFor();
  await toolAt(page); // the picture is at rest
  const box = await page.locator(".overlay .waypoint-text", { hasText: "goal" }).boundingBox();
  const at = { x: (box?.x ?? NaN) + (box?.width ?? NaN) / 2, y: (box?.y ?? NaN) + (box?.height ?? NaN) / 2 };
  await drag(page, at, { x: at.x - 15, y: at.y - 15 });
  const report = page.getByRole("region", { name: "A way around" });
  await report.getByText("reached").waitFor();
  const goal = (): string | null => new URL(page.url().replace("#", "?")).searchParams.get("goal");
  await expect.poll(goal).not.toBe(behind.join(","));
  const away = async (): Promise<number> => {
    const wanted = (goal() ?? "").split(",").map(Number);
    return Math.max(...(await jointValues(page)).map((value, k) => Math.abs(value - (wanted[k] ?? NaN))));
  };
  await expect.poll(away).toBeLessThan(1e-3);
});

test("a goal in an obstacle is refused in the page's words", async () => {
  const inWall = start.with(0, 0.75);
  const page = await opened(await hashOf(`section=obstacles&goal=${inWall.join(",")}`));
  const report = page.getByRole("region", { name: "A way around" });
  await report.getByRole("button", { name: "Go around" }).click();
  await report.getByText(/At the goal the bodies panda_\w+ and wall overlap at \(/).waitFor();
  const { stdout } = run(
    [
      "move",
      "panda",
      `--from=${start.join(",")}`,
      `--to=${inWall.join(",")}`,
      "--method=around",
      "--scene=scene.json",
      "--json",
    ],
    { "scene.json": JSON.stringify(wall) },
  );
  expect((JSON.parse(stdout) as { code: string }).code).toBe("goal_not_free");
  expect(await firstJoint(page)).toBeCloseTo(0, 3);
});
