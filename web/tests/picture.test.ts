import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { chooseArm, drag, jointValues, pages, slow, toolAt, toWorld } from "./browser.js";
import { json, run } from "./native.js";

const { opened, there } = pages();

type Point = number[];

/** The points of a path, without curves. */
function points(path: string): Point[] {
  return [...path.matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(([, x, y]) => [Number(x), Number(y)]);
}

/** The links of a drawing of `beeline draw`, m, by the numbers of its axes. */
function drawnLinks(drawing: string): Point[][] {
  const ticks = [...drawing.matchAll(/<text x="([\d.]+)" y="([\d.]+)" font-size="7.5"[^>]*>([^<]+)</g)];
  const level = ticks.filter(([, , y]) => y === ticks[0]?.[2]); // the numbers of x stand in one row
  const upright = ticks.filter((tick) => !level.includes(tick));
  const scale = (all: typeof ticks, k: 1 | 2, shift: number): ((value: number) => number) => {
    const at = (i: number): [number, number] => {
      const tick = all.at(i);
      return [Number(tick?.[3]?.replace("−", "-")), Number(tick?.[k]) - shift];
    };
    const [[v1, p1], [v2, p2]] = [at(0), at(-1)];
    return (pixel) => v1 + ((pixel - p1) * (v2 - v1)) / (p2 - p1);
  };
  const [x, y] = [scale(level, 1, 0), scale(upright, 2, 2.7)];
  const bars = [...drawing.matchAll(/<path d="([^"]+)" stroke="#a8bdd1" stroke-width="8"\/>/g)];
  return bars.map(([, path = ""]) => points(path).map(([px = 0, py = 0]) => [x(px), y(py)]));
}

test.each([
  ["rrr", [0.5, 0.8, 0.4]],
  ["rrr", [-2, 1.1, 0.3]],
  ["RRRR:1,0.8,0.6,0.3", [0.4, 0.5, -0.6, 0.8]],
])("the picture of %s at %j has the geometry of beeline draw", async (arm, q) => {
  const page = await opened(`#arm=${arm}&q=${q.join(",")}`);
  const drawing = run(["draw", arm, `--q=${q.join(",")}`, "--out=arm.svg"]).files["arm.svg"] ?? "";
  const expected = drawnLinks(drawing).filter((link) => link.length > 0);
  await toolAt(page);
  const world = await toWorld(page);
  const paths = await page
    .locator(".drawing .arm:not(.ghost) .core")
    .evaluateAll((all) => all.map((path) => path.getAttribute("d") ?? ""));
  const found = paths.filter((path) => path !== "").map((path) => points(path).map(world));
  expect(found.length).toBe(expected.length);
  const size = Math.max(...expected.flat(2).map(Math.abs));
  found.forEach((link, i) => {
    for (const end of [0, -1])
      link
        .at(end)
        ?.forEach((value, k) => expect(Math.abs(value - (expected[i]?.at(end)?.[k] ?? NaN))).toBeLessThan(4e-3 * size));
  });
});

test("a joint has one colour: in the picture, on its slider, its column, its curve", async () => {
  const page = await opened("#arm=RRRR:1,1,1,1&q=0.3,0.4,0.5,0.6&columns=1&section=control");
  await page.locator(".legend .swatch").nth(3).waitFor();
  await page.locator(".drawing .arm:not(.ghost) circle:not(.joint-shape)").nth(3).waitFor({ state: "attached" });
  await page.locator(".columns .head").nth(3).waitFor({ state: "attached" });
  const colours = (selector: string, property: string) =>
    page.locator(selector).evaluateAll(
      (all, property) =>
        all.map((part) =>
          (
            part.ownerDocument.defaultView as unknown as {
              getComputedStyle(e: unknown): { getPropertyValue(p: string): string };
            }
          )
            .getComputedStyle(part)
            .getPropertyValue(property),
        ),
      property,
    );
  const joints = await colours(".drawing .arm:not(.ghost) circle:not(.joint-shape)", "fill");
  expect(new Set(joints).size).toBe(4);
  expect(joints[0]).toBe("rgb(212, 33, 38)"); // as the first joint of the figures
  expect(await colours(".columns .head", "fill")).toEqual(joints);
  expect(await colours(".angles .arc", "stroke")).toEqual(joints);
  expect(await colours(".legend .swatch", "background-color")).toEqual(joints);
  const drawing =
    run(["draw", "RRRR:1,1,1,1", "--q=0.3,0.4,0.5,0.6", "--jacobian", "--out=a.svg"]).files["a.svg"] ?? "";
  const hex = (rgb: string): string =>
    `#${(rgb.match(/\d+/g) ?? []).map((n) => Number(n).toString(16).padStart(2, "0")).join("")}`;
  for (const colour of joints.slice(0, 3)) expect(drawing).toContain(hex(colour));
});

/** The middle of a link in the picture, pixels of the window. */
async function middleOf(page: Page, link: number): Promise<{ x: number; y: number }> {
  const box = await page.locator("#stage").boundingBox();
  const path = points((await page.locator(`[data-grab="joint ${link}"]`).getAttribute("d")) ?? "");
  const [a, b] = [path[0] ?? [], path.at(-1) ?? []];
  return { x: (box?.x ?? 0) + ((a[0] ?? 0) + (b[0] ?? 0)) / 2, y: (box?.y ?? 0) + ((a[1] ?? 0) + (b[1] ?? 0)) / 2 };
}

/** Where the joint of a link is drawn, in the window. */
async function jointOf(page: Page, link: number): Promise<{ x: number; y: number }> {
  const box = await page.locator("#stage").boundingBox();
  const [x = 0, y = 0] = points((await page.locator(`[data-grab="joint ${link}"]`).getAttribute("d")) ?? "")[0] ?? [];
  return { x: (box?.x ?? 0) + x, y: (box?.y ?? 0) + y };
}

test("a link that is dragged turns its joint and follows the mouse; a limit is named beside it", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  await toolAt(page);
  const from = await middleOf(page, 1);
  const before = await jointValues(page);
  const to = { x: from.x - 50, y: from.y + 30 };
  await drag(page, from, to);
  const after = await jointValues(page);
  expect(after[0]).toBe(before[0]);
  expect(after[2]).toBe(before[2]);
  expect(Math.abs((after[1] ?? 0) - (before[1] ?? 0))).toBeGreaterThan(5);
  await toolAt(page);
  const now = await middleOf(page, 1);
  const joint = await jointOf(page, 1);
  const ray = (point: { x: number; y: number }): number => Math.atan2(point.y - joint.y, point.x - joint.x);
  expect(Math.abs(ray(now) - ray(to))).toBeLessThan(0.05); // on the mouse's ray
  const slide = await opened("#arm=RP:1,1&q=0.3,0.4");
  await toolAt(slide);
  const rod = await middleOf(slide, 1);
  const values = await jointValues(slide);
  await drag(slide, rod, { x: rod.x + 50, y: rod.y - 15 });
  const slid = await jointValues(slide);
  expect(slid[0]).toBe(values[0]);
  expect(slid[1]).toBeGreaterThan((values[1] ?? 0) + 0.1);
  const limited = await opened("#arm=panda&q=0,-0.8,0,-2.4,0,1.6,0.8");
  await limited.locator("#joint-3").fill("0");
  await limited.keyboard.press("Enter");
  expect((await jointValues(limited))[3]).toBe(-4);
});

test("a link of a spatial arm is dragged, and a limit is named beside the tool", async () => {
  const page = await opened("#arm=panda&q=0,-0.8,0,-2.4,0,1.6,0.8");
  const box = await page.locator("#stage").boundingBox();
  await toolAt(page);
  const before = await jointValues(page);
  const at = { x: (box?.x ?? 0) + 0.5 * (box?.width ?? 0), y: (box?.y ?? 0) + 0.62 * (box?.height ?? 0) };
  let moved: number[] = before;
  for (const dx of [-60, -40, -20, 0, 20, 40]) {
    await drag(page, { x: at.x + dx, y: at.y }, { x: at.x + dx + 50, y: at.y + 10 });
    moved = await jointValues(page);
    if (moved.some((value, k) => value !== before[k])) break;
  }
  expect(moved.filter((value, k) => value !== before[k]).length).toBe(1);
});

test("toggles act in every section, and those that do not act on the arm are not there", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  for (const section of ["Pose", "Control", "Line", "Obstacles", "Workspace", "Lessons"]) {
    await page.getByRole("link", { name: section, exact: true }).click();
    if (section === "Lessons")
      await page.evaluate("location.hash = '#arm=rrr&q=0.4,0.9,0.6&section=lessons&lesson=rrr'");
    for (const [name, mark] of [
      ["Solutions", ".ghost.solution"],
      ["Ellipsoid", ".ellipsoid"],
      ["Jacobian", ".columns .head"],
      ["Frames", ".frame-text"],
      ["Angles", ".angle-text"],
    ] as const) {
      const button = page.locator("#tools").getByRole("button", { name, exact: true });
      const isOn = (await button.getAttribute("aria-pressed")) === "true";
      if (isOn) await button.click();
      const count = async (): Promise<number> =>
        (await page.locator(`.drawing ${mark}`).all()).length === 0
          ? 0
          : Number(await page.locator(`.drawing ${mark}`).first().isVisible());
      await expect.poll(count, { message: `${name} off in ${section}` }).toBe(0);
      await button.click();
      await expect.poll(count, { message: `${name} on in ${section}` }).toBe(1);
      if (!isOn) await button.click();
    }
  }
  expect(await page.locator("#tools").getByRole("button", { name: "Turn" }).isVisible()).toBe(false);
  await chooseArm(page, "ur5");
  await page.locator("#tools").getByRole("button", { name: "Turn" }).waitFor();
  expect(await page.locator("#tools").getByRole("button", { name: "Angles" }).isVisible()).toBe(false);
});

test("ghosts follow the tool without flicker", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&solutions=1");
  await page.locator(".ghost.solution").waitFor({ state: "attached" });
  await page.evaluate(`
    window.gone = 0;
    new MutationObserver((all) => all.forEach((one) => (window.gone += one.removedNodes.length)))
      .observe(document.querySelector(".ghost.solution").parentNode, { childList: true, subtree: true });`);
  const from = await toolAt(page);
  await drag(page, from, { x: from.x - 40, y: from.y + 40 });
  const values = await jointValues(page);
  const { solutions } = json<{ solutions: number[][] }>(
    ["ik", "rrr", "--all", `--pose=${(await tool(page)).join(",")}`].concat([]),
  );
  expect(solutions.length).toBe(2);
  expect(values.length).toBe(3);
  expect(await page.evaluate("window.gone")).toBe(0);
  await expect.poll(() => page.locator(".ghost.solution").count()).toBe(1);
});

async function tool(page: Page): Promise<number[]> {
  const fields = await page.getByLabel("Pose of the tool").locator("input").all();
  const [x = 0, y = 0, degrees = 0] = await Promise.all(fields.map(async (field) => Number(await field.inputValue())));
  return [x, y, (degrees * Math.PI) / 180];
}

test("without WebGL a planar arm is drawn and dragged; a spatial one says why it is not", async () => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  await page.addInitScript(`
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return /webgl/.test(kind) ? null : get.call(this, kind, ...rest);
    };`);
  await page.goto(`${there().address}#arm=rrr&q=0.4,0.9,0.6`);
  await page.waitForSelector("#first", { state: "detached" });
  const before = await jointValues(page);
  const from = await toolAt(page);
  await drag(page, from, { x: from.x - 30, y: from.y + 30 });
  expect(await jointValues(page)).not.toEqual(before);
  await chooseArm(page, "panda");
  await page.getByText("its picture needs WebGL").waitFor();
  await page.getByLabel("Inverse kinematics").locator("li button").first().waitFor();
  await context.close();
});

test.skipIf(slow > 1)("an arm of 100 joints stays fluid under the hand", async () => {
  const lengths = Array.from({ length: 100 }, () => 0.1).join(",");
  const page = await opened(`#arm=${"R".repeat(100)}:${lengths}`);
  const from = await toolAt(page);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const seconds = async (): Promise<number> =>
    (await session.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration")?.value ?? NaN;
  const begin = await seconds();
  await drag(page, from, { x: from.x - 60, y: from.y + 60 });
  await toolAt(page);
  const each = (1000 * ((await seconds()) - begin)) / 10;
  console.log(`${each.toFixed(1)} ms of the processor for each of ten moves`);
  expect(each).toBeLessThan(250);
});
