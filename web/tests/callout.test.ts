import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { drag, pages, toolAt, toWorld } from "./browser.js";

const { opened } = pages();

/** How many of the points along the links of a planar arm lie behind an element, pixels. */
function covered(page: Page, selector: string): Promise<number> {
  return page.evaluate(`(() => {
    const stage = document.querySelector("#stage").getBoundingClientRect();
    const box = document.querySelector("${selector}").getBoundingClientRect();
    let count = 0;
    for (const link of document.querySelectorAll(".drawing .arm:not(.ghost) .core")) {
      const length = link.getAttribute("d") === "" ? -1 : link.getTotalLength();
      for (let at = 0; at <= length; at += 4) {
        const { x, y } = link.getPointAtLength(at);
        const [px, py] = [x + stage.x, y + stage.y];
        count += Number(px > box.left && px < box.right && py > box.top && py < box.bottom);
      }
    }
    return count;
  })()`);
}

test.each([
  [0.1, 0.1],
  [0.9, 0.1],
  [0.95, 0.9],
  [0.1, 0.9],
])("out of reach at %d, %d the sentence says how far the tool stays away, and leaves the arm free", async (u, v) => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  await page.locator(".drawing").hover();
  await page.mouse.wheel(0, 500);
  const tool = await toolAt(page);
  const stage = await page.locator("#stage").boundingBox();
  const to = { x: (stage?.x ?? 0) + u * (stage?.width ?? 0), y: (stage?.y ?? 0) + v * (stage?.height ?? 0) };
  await drag(page, tool, to, false);
  const callout = page.locator(".callout");
  await callout.getByText(/^Out of reach\. The tool stays \d+\.\d{3} m away\.$/).waitFor();
  const said = Number(/[\d.]+ m/.exec((await callout.textContent()) ?? "")?.[0].replace(" m", ""));
  const now = await toolAt(page);
  const world = await toWorld(page);
  const [a, b] = [now, to].map(({ x, y }) => world([x - (stage?.x ?? 0), y - (stage?.y ?? 0)]));
  const away = Math.hypot((a?.[0] ?? 0) - (b?.[0] ?? 0), (a?.[1] ?? 0) - (b?.[1] ?? 0));
  expect(Math.abs(said - away)).toBeLessThan(0.1);
  await expect.poll(() => covered(page, ".callout")).toBe(0);
  await page.mouse.up();
});

test("a pose that is typed out of reach: three digits, and no z in the plane", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  await page.locator("#pose-0").fill("20");
  await page.keyboard.press("Enter");
  await page
    .locator(".callout")
    .getByText(/^Out of reach by \d+\.\d{3} m: the nearest point is \(\d\.\d{3}, \d\.\d{3}\) m\.$/)
    .waitFor();
  await expect.poll(() => covered(page, ".callout")).toBe(0);
});

test("the invitation covers nothing of the arm, and goes with the first thing that is done", async () => {
  const page = await opened("");
  const callout = page.locator(".callout");
  await callout.getByText("Drag the tool.").waitFor();
  await expect.poll(() => covered(page, ".callout")).toBe(0);
  await page.getByRole("link", { name: "Control", exact: true }).click();
  await expect.poll(() => callout.isVisible()).toBe(false);
  const other = await opened("");
  await other.getByText("Drag the tool.").waitFor();
  await other.evaluate("location.hash = '#arm=rrr&q=1,1,1&section=line'"); // no hand
  await expect.poll(() => other.locator(".callout").isVisible()).toBe(false);
});

test("texts lie beside the arm, its handle and each other", async () => {
  for (const q of ["0.4,0.9,0.6", "0.1,0.2,0.1", "2.5,-0.4,0.3", "-1,2.2,-1.4"]) {
    const page = await opened(`#arm=rrr&q=${q}`, { width: 900, height: 700 });
    await toolAt(page);
    await expect.poll(() => page.locator(".drawing .labels text").count()).toBe(4);
    const texts = await page.locator(".drawing .labels text").all();
    const boxes = await Promise.all(texts.map((text) => text.boundingBox()));
    const knob = await page.locator(".handle .knob").boundingBox();
    const all = [...boxes, knob].map((box) => box ?? { x: NaN, y: NaN, width: NaN, height: NaN });
    for (const [i, one] of all.entries())
      for (const other of all.slice(0, i)) {
        const overlap =
          Math.min(one.x + one.width, other.x + other.width) - Math.max(one.x, other.x) > 1 &&
          Math.min(one.y + one.height, other.y + other.height) - Math.max(one.y, other.y) > 3;
        expect(overlap, `${q}: ${i}`).toBe(false);
      }
    for (let k = 1; k <= 4; ++k) expect(await covered(page, `.drawing .labels text:nth-of-type(${k})`)).toBe(0);
    await page.close();
  }
});

test.each(["0,0,0", "1.5707963,0,0", "3.1415926,0,0", "0.4,0.9,0.6"])(
  "at %s, arm and handle lie in the picture, and the arm takes much of it",
  async (q) => {
    const page = await opened(`#arm=rrr&q=${q}`);
    await toolAt(page);
    const plot = await page.locator(".axes .frame").boundingBox();
    for (const part of [".handle .knob", ".handle .ring", ".drawing .arm .joint-shape"]) {
      const box = await page.locator(part).first().boundingBox();
      expect(box?.x).toBeGreaterThan(plot?.x ?? NaN);
      expect((box?.x ?? NaN) + (box?.width ?? NaN)).toBeLessThan((plot?.x ?? NaN) + (plot?.width ?? NaN));
      expect(box?.y).toBeGreaterThan(plot?.y ?? NaN);
    }
    const arm = await page.locator(".drawing .arm:not(.ghost)").boundingBox();
    const [w, h] = [(arm?.width ?? 0) / (plot?.width ?? 1), (arm?.height ?? 0) / (plot?.height ?? 1)];
    expect(Math.max(w, h)).toBeGreaterThan(0.5);
    const turn = await page.locator(".handle .knob").boundingBox();
    const at = { x: (turn?.x ?? 0) + 5, y: (turn?.y ?? 0) + 5 };
    const theta = async (): Promise<number> => Number(await page.locator("#pose-2").inputValue());
    const before = await theta();
    await drag(page, at, { x: at.x + 1, y: at.y + 1 }); // it does not jump when it is taken
    expect(Math.abs(Math.sin(((await theta()) - before) * (Math.PI / 180)))).toBeLessThan(0.2);
    expect(Math.cos(((await theta()) - before) * (Math.PI / 180))).toBeGreaterThan(0.9);
  },
);
