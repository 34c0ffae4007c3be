import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { pages } from "./browser.js";
import { json, run } from "./native.js";

const { opened, there } = pages();

const status = (page: Page) => page.getByLabel("Inverse kinematics").getByRole("status");
const field = (page: Page, i: number) => page.locator(`#joint-${i}`);

async function values(page: Page, count: number): Promise<number[]> {
  return Promise.all(Array.from({ length: count }, async (_, i) => Number(await field(page, i).inputValue())));
}

/** Where the picture shows the tool, in pixels of the window. */
async function toolAt(page: Page): Promise<{ x: number; y: number }> {
  const stage = page.locator("#stage");
  const [x = NaN, y = NaN] = ((await stage.getAttribute("data-tool")) ?? "").split(",").map(Number);
  const box = await stage.boundingBox();
  return { x: x + (box?.x ?? NaN), y: y + (box?.y ?? NaN) };
}

test("the tool follows the mouse; far out of reach the command's reason stands in the page and the arm stays", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&unit=rad");
  await status(page).getByText("solution").waitFor();
  const begin = await toolAt(page);
  await page.mouse.move(begin.x, begin.y);
  await page.mouse.down();
  await page.mouse.move(begin.x + 10, begin.y + 10, { steps: 4 });
  await page.mouse.up();
  await expect.poll(async () => (await values(page, 3))[0]).not.toBe(0.4);
  await status(page).getByText("solution").waitFor();
  const pose = await page
    .getByLabel("Pose of the tool")
    .locator("input")
    .evaluateAll((all) => all.map((input) => Number((input as unknown as { value: string }).value)));
  const now = await toolAt(page);
  expect(Math.hypot(now.x - begin.x - 10, now.y - begin.y - 10)).toBeLessThan(2);
  const q = await values(page, 3);
  const native = json<{ pose: { planar: Record<"x" | "y" | "theta", number> } }>(["fk", "rrr", `--q=${q.join(",")}`]);
  expect(pose[0]).toBeCloseTo(native.pose.planar.x, 2);
  expect(pose[5]).toBeCloseTo(native.pose.planar.theta, 3);
  // The far corner of the picture.
  const box = await page.locator("#stage").boundingBox();
  await page.mouse.move(now.x, now.y);
  await page.mouse.down();
  await page.mouse.move((box?.x ?? 0) + 3, (box?.y ?? 0) + (box?.height ?? 0) - 3, { steps: 5 });
  await status(page).getByText("reach").waitFor();
  let reason = await status(page).textContent();
  await expect
    .poll(async () => {
      const before = reason;
      await page.waitForTimeout(300);
      return (reason = await status(page).textContent()) === before;
    })
    .toBe(true);
  expect(reason).toMatch(/^[^.]*(reach|far)/);
  expect(await page.getByLabel("Inverse kinematics").locator("li").count()).toBe(0);
  const held = await values(page, 3);
  await page.mouse.up();
  expect(await values(page, 3)).toEqual(held);
  await expect.poll(async () => Math.hypot((await toolAt(page)).x - (box?.x ?? 0))).toBeGreaterThan(20);
  expect(await status(page).textContent()).toBe(reason);
});

test("the tool is moved by keyboard: numbers of its pose, with the command's reason where it is not reached", async () => {
  const q = [0.3, -1.1, 1.4, -0.7, 0.9, 0.2];
  const page = await opened(`#arm=ur5&q=${q.join(",")}&unit=rad`);
  const panel = page.getByLabel("Pose of the tool");
  const x = panel.getByLabel("x", { exact: true });
  const before = Number(await x.inputValue());
  await x.focus();
  await page.keyboard.press("ArrowUp");
  const after = Number(await x.inputValue());
  expect(after).toBeGreaterThan(before);
  await expect.poll(async () => await values(page, 6)).not.toEqual(q);
  await expect.poll(() => page.url()).not.toContain(q.join(","));
  const moved = (new URL(page.url().replace("#", "?")).searchParams.get("q") ?? "").split(",");
  const { pose } = json<{ pose: { translation: number[] } }>(["fk", "ur5", `--q=${moved.join(",")}`]);
  expect(pose.translation[0]).toBeCloseTo(after, 9);
  await panel.getByLabel("yaw", { exact: true }).fill("1");
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await values(page, 6)).join()).not.toBe(moved.join());
  const rest = await values(page, 6);
  await x.fill("5");
  await page.keyboard.press("Enter");
  await status(page).getByText("reach").waitFor();
  const z = await Promise.all(
    ["y", "z", "roll", "pitch", "yaw"].map((name) => panel.getByLabel(name, { exact: true }).inputValue()),
  );
  const native = run(["ik", "ur5", `--pose=5,${z.join(",")}`, "--json"]);
  const { reason } = JSON.parse(native.stdout) as { reason: string };
  const digits = /(\.\d{3})\d+/g; // the fields show less than the page asks with
  expect((await status(page).textContent())?.replace(digits, "$1")).toBe(reason.replace(digits, "$1"));
  expect(await values(page, 6)).toEqual(rest);
  await page.keyboard.press("Tab");
  expect(Number(await x.inputValue())).toBeLessThan(1);
});

test("a planar arm's tool has x, y and yaw", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const panel = page.getByLabel("Pose of the tool");
  for (const name of ["z", "roll", "pitch"])
    expect(await panel.getByLabel(name, { exact: true }).isDisabled()).toBe(true);
  await panel.getByLabel("yaw", { exact: true }).fill("90");
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await values(page, 3)).reduce((sum, value) => sum + value, 0)).toBeCloseTo(90, 1);
});

test("a joint without limits turns beyond half a turn, and the page says that it has none", async () => {
  const page = await opened("#arm=RRP:1,1,1&q=0.1,0.2,0.3");
  await page.getByText("No limits: all joints").waitFor();
  expect(await page.getByLabel("joint1, degrees, slider").getAttribute("max")).toBe("360");
  await field(page, 0).fill("1000");
  await field(page, 0).press("Enter");
  await expect.poll(() => page.url()).toContain("q=17.4532925199432");
  expect(await field(page, 0).inputValue()).toBe("1000.00");
});

test.each(["#arm=rrr&q=1,,2", "#arm=rrr&q=,,", "#arm=rrr&q=1, ,2"])("%s is no list of numbers", async (hash) => {
  const page = await opened(hash);
  const chosen = await values(page, 3);
  expect(chosen).not.toContain(0);
  expect(chosen[0]).not.toBeCloseTo(180 / Math.PI, 1);
});

test("a joint string with an empty length is refused as the command refuses it", async () => {
  const page = await opened("#arm=rrr");
  await page.locator("#arm-text").fill("RRR:1,,2");
  await page.getByRole("button", { name: "Show", exact: true }).click();
  await page.getByRole("alert").waitFor();
  const text = (await page.getByRole("alert").textContent()) ?? "";
  expect(run(["show", "RRR:1,,2"]).stderr).toContain(text);
});

test("a picture that the graphics card loses is announced and comes back", async () => {
  const page = await opened("#arm=ur5");
  await page.evaluate(
    "window.lost = document.querySelector('#stage canvas').getContext('webgl2').getExtension('WEBGL_lose_context')",
  );
  await page.evaluate("window.lost.loseContext()");
  await page.getByRole("status").getByText("lost the picture").waitFor();
  await field(page, 0).fill("20");
  await field(page, 0).press("Enter");
  await page.evaluate("window.lost.restoreContext()");
  await page.getByText("lost the picture").waitFor({ state: "detached" });
  const colours = await page.evaluate(
    "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => { const c = document.querySelector('#stage canvas');" +
      "const d = document.createElement('canvas'); d.width = c.width; d.height = c.height; const g = d.getContext('2d'); g.drawImage(c, 0, 0);" +
      "done(new Set(new Uint32Array(g.getImageData(0, 0, c.width, c.height).data.buffer)).size); })))",
  );
  expect(colours).toBeGreaterThan(20);
});

test("without WebAssembly the page says so", async () => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  await page.addInitScript("delete globalThis.WebAssembly");
  await page.goto(there().address);
  await page.getByRole("alert").getByText("has no WebAssembly").waitFor();
});

test("on a phone the buttons stand below the picture", async () => {
  const page = await opened("#arm=rrr", { width: 360, height: 740 });
  const [stage, tools] = await Promise.all(["#stage", "#tools"].map((part) => page.locator(part).boundingBox()));
  expect(tools?.y).toBeGreaterThanOrEqual((stage?.y ?? 0) + (stage?.height ?? NaN));
  expect(tools?.width).toBeLessThanOrEqual(360);
});

test("a planar arm's picture is saved as the command's SVG; others have no such button", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const button = page.getByRole("button", { name: "Save SVG" });
  const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
  const saved = readFileSync(await download.path(), "utf8");
  const native = run(["draw", "rrr", "--q=0.4,0.9,0.6", "--out=arm.svg"]).files["arm.svg"];
  expect(saved).toBe(native);
  await page.locator("#arm-text").fill("panda");
  await expect.poll(() => button.count()).toBe(0);
});
