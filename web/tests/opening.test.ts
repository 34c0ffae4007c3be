import { expect, test } from "vitest";
import { axe, chooseArm, frames, jointValues, pages, shownArm, toolAt, toWorld } from "./browser.js";
import { json, run } from "./native.js";

const { opened, there } = pages();

/** Keeps each place of the tool, and when it was first seen, in window.tools. */
const toolLog = `
  window.tools = [];
  (function look() {
    const tool = document.getElementById("stage")?.dataset.tool;
    if (tool !== undefined && window.tools.at(-1)?.[1] !== tool) window.tools.push([performance.now(), tool]);
    requestAnimationFrame(look);
  })();`;

test("the page opens with an arm that draws the three lines of Figure 1.9, and hands over", async () => {
  const context = await there().browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  await page.addInitScript(toolLog);
  await page.goto(there().address);
  await page.waitForFunction("window.tools.length > 1");
  const moved = Number(await page.evaluate("window.tools[1][0]"));
  console.log(`first moved pixel after ${moved.toFixed(0)} ms`);
  await page.getByText("Drag the tool.").waitFor();
  const dots = async (): Promise<string[]> =>
    ((await page.locator(".trail .dots").getAttribute("d")) ?? "").match(/-?[\d.]+ -?[\d.]+/g) ?? [];
  await expect.poll(async () => (await dots()).length).toBe(200);
  const world = await toWorld(page);
  const points = (await dots()).map((text) => world(text.split(" ").map(Number)));
  // The figure's motion: eq. 1.6 through the same poses.
  const poses = [
    [6, 2.5, 30],
    [-0.5, 6.5, 120],
    [-4, 2.5, 180],
  ].map(([x, y, t = 0]) => [x, y, (t * Math.PI) / 180].join(","));
  const files = { "poses.csv": `x,y,theta\n${poses.join("\n")}\n` };
  const start = `--from=0,${Math.PI / 2},0`;
  const args = [
    "line",
    "rrr",
    start,
    "--through=poses.csv",
    "--method=inverse-jacobian",
    "--gain=0.01",
    "--out=run.csv",
  ];
  const csv = run(args, files).files["run.csv"] ?? "";
  const rows = csv
    .trim()
    .split("\n")
    .slice(1)
    .map((row) => row.split(",").map(Number));
  const tools = rows.map(([, a = 0, b = 0, c = 0]) => [
    3.5 * Math.cos(a) + 3.5 * Math.cos(a + b) + 2 * Math.cos(a + b + c),
    3.5 * Math.sin(a) + 3.5 * Math.sin(a + b) + 2 * Math.sin(a + b + c),
  ]);
  for (const [x = NaN, y = NaN] of points)
    expect(Math.min(...tools.map(([u = 0, v = 0]) => Math.hypot(u - x, v - y)))).toBeLessThan(0.02);
  const drawing = run(["figure", "1.9", "--out=figure.svg"]).files["figure.svg"] ?? "";
  expect(drawing.length).toBeGreaterThan(1000);
  const before = await jointValues(page);
  const from = await toolAt(page);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 40, from.y - 30, { steps: 5 });
  await page.mouse.up();
  expect(await jointValues(page)).not.toEqual(before);
  await expect.poll(() => page.locator(".trail").count()).toBe(0);
  expect(await page.locator(".callout").isVisible()).toBe(false);
  await context.close();
});

test("a hand stops the opening; with reduced motion there is none; a link has none", async () => {
  const context = await there().browser.newContext({ reducedMotion: "reduce" });
  const page = await context.newPage();
  await page.addInitScript(toolLog);
  await page.goto(there().address);
  await page.getByText("Drag the tool.").waitFor();
  expect(Number(await page.evaluate("window.tools.length"))).toBeLessThan(3);
  await context.close();
  const other = await there().browser.newContext();
  const moving = await other.newPage();
  await moving.goto(there().address);
  await moving.waitForSelector(".trail");
  await moving.mouse.click(200, 300);
  const now = await jointValues(moving);
  await frames(moving, 15);
  expect(await jointValues(moving)).toEqual(now);
  await other.close();
  const linked = await opened("#arm=rrr&q=0.4,0.9,0.6");
  await frames(linked, 15);
  expect((await jointValues(linked))[1]).toBeCloseTo((0.9 * 180) / Math.PI, 1);
});

test.each([
  ["Learn", "lessons"],
  ["Play", "control"],
  ["Plan a line", "line"],
])("%s leads into the section %s", async (name, section) => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  await page.goto(there().address);
  await page.getByRole("navigation", { name: "Ways on" }).getByRole("link", { name }).click();
  await expect.poll(() => page.url()).toContain(`section=${section}`);
  expect(await page.locator(".welcome").isVisible()).toBe(false);
  await context.close();
});

test.each([
  ["hold", "Pose"],
  ["motion", "Line"],
  ["reach", "Workspace"],
])("an old link to the section %s opens %s", async (old, now) => {
  const page = await opened(`#arm=rrr&section=${old}`);
  await page.locator('#sections a[aria-current="page"]', { hasText: now }).waitFor();
});

interface Listed {
  name: string;
  maker: string;
  reach: number | null;
}

test("the gallery has all arms with makers and pictures; KUKA's are found, chosen, and brought to a pose", async () => {
  const page = await opened("#arm=rrr");
  const { arms } = json<{ arms: Listed[] }>(["arms"]);
  await page.locator("#arm").click();
  const cards = page.locator(".gallery li:visible");
  expect(await cards.count()).toBe(arms.length);
  expect(await page.locator(".gallery .thumbnail").count()).toBe(arms.length);
  await page.locator("#arm-text").fill("kuka");
  const kuka = arms.filter(({ maker }) => maker.includes("KUKA"));
  expect(kuka.length).toBeGreaterThan(1);
  expect(await cards.count()).toBe(kuka.length);
  await cards.filter({ hasText: "kr6_r900" }).getByRole("button").click();
  await expect.poll(() => shownArm(page)).toBe("kr6_r900");
  const panel = page.getByLabel("Pose of the tool");
  for (const [name, value] of [
    ["x", "0.5"],
    ["z", "0.6"],
  ] as const) {
    await panel.getByLabel(name, { exact: true }).fill(value);
    await page.keyboard.press("Enter");
    await expect
      .poll(async () => Number(await panel.getByLabel(name, { exact: true }).inputValue()))
      .toBeCloseTo(Number(value), 4);
  }
  const at = async (k: number): Promise<number | undefined> => {
    const q = new URL(page.url().replace("#", "?")).searchParams.get("q");
    return json<{ pose: { translation: number[] } }>(["fk", "kr6_r900", `--q=${q}`]).pose.translation[k];
  };
  await expect.poll(() => at(0)).toBeCloseTo(0.5, 6);
  await expect.poll(() => at(2)).toBeCloseTo(0.6, 6);
});

test("the dialog of arms is accessible; Enter takes the first that fits; a wrong name is refused in it", async () => {
  const page = await opened("#arm=rrr");
  await page.locator("#arm").click();
  expect(await axe(page)).toEqual([]);
  await page.locator("#arm-text").fill("7 joints franka");
  await page.keyboard.press("Enter");
  await expect.poll(() => shownArm(page)).toBe("fr3");
  await chooseArm(page, "pnada");
  await page.locator("dialog.arms").getByRole("alert").getByText("panda").waitFor();
});

test("by keyboard the first joint is near", async () => {
  const page = await opened("#arm=panda");
  const focused = (): Promise<string> =>
    page.evaluate("document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent");
  let tabs = 0;
  for (; tabs < 30; ++tabs) {
    await page.keyboard.press("Tab");
    if ((await focused()).startsWith("joint1")) break;
  }
  expect(tabs).toBeLessThan(12);
  const again = await opened("#arm=panda");
  await again.keyboard.press("Tab");
  await again.keyboard.press("Enter");
  expect(await again.evaluate("document.activeElement.id")).toBe("joint-0");
});

test("the picture is driven by keys", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const panel = page.getByLabel("Pose of the tool");
  const value = async (name: string): Promise<number> =>
    Number(await panel.getByLabel(name, { exact: true }).inputValue());
  const [x, theta] = [await value("x"), await value("θ")];
  await page.locator(".drawing").focus();
  await page.keyboard.press("ArrowLeft");
  await expect.poll(() => value("x")).toBeLessThan(x);
  await page.keyboard.press("q");
  await expect.poll(() => value("θ")).toBeCloseTo(theta + 5, 1);
});

test("a number of joints in a search is the arm's, not a digit of its name", async () => {
  const page = await opened("#arm=rrr");
  await page.locator("#arm").click();
  await page.locator("#arm-text").fill("kuka, 7 joints");
  const cards = page.locator(".gallery li:visible");
  const texts = await cards.allTextContents();
  expect(texts.length).toBeGreaterThan(1);
  for (const text of texts) expect(text).toMatch(/KUKA.*7 joints/);
});
