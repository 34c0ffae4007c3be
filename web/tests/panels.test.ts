import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { small } from "../src/elements/units.js";
import { frames, pages } from "./browser.js";

const { opened, there } = pages();

const three = "6,2.5,0,0.9659258,0,0,0.2588190;-0.5,6.5,0,0.5,0,0,0.8660254;-4,2.5,0,0,0,0,1";

/** How far the text of the widest of some fields goes beyond its field, pixels. */
function cutOff(page: Page, selector: string): Promise<number> {
  return page.evaluate(
    `Math.max(...[...document.querySelectorAll("${selector}")].map((field) => field.scrollWidth - field.clientWidth))`,
  );
}

test("on a phone no digit of joints and pose is cut off, and fields do not touch", async () => {
  const context = await there().browser.newContext({
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
  });
  const page = await context.newPage();
  await page.goto(`${there().address}#arm=panda&q=-2.7,-1.5,-2.7,-2.0,-2.7,3.5,-2.7`);
  await page.waitForSelector("#first", { state: "detached" });
  expect(await cutOff(page, ".joints input[type=number], .pose input")).toBe(0);
  const fields = await page.locator(".joints input[type=number]").all();
  const boxes = await Promise.all(fields.map((field) => field.boundingBox()));
  for (const [i, box] of boxes.slice(1).entries())
    expect((box?.y ?? 0) - (boxes[i]?.y ?? 0) - (boxes[i]?.height ?? 0)).toBeGreaterThan(5);
  await context.close();
});

test.each([768, 1024])("on a screen %d wide no digit is cut off", async (width) => {
  for (const hash of ["#arm=panda&q=-2.7,-1.5,-2.7,-2.0,-2.7,3.5,-2.7", "#arm=ur5&q=-3.1,-2.5,-2.7,-2.0,-2.7,3.5"]) {
    const page = await opened(hash, { width, height: 800 });
    await page.locator(".solutions li button").nth(3).waitFor();
    for (const part of [".joints input[type=number]", ".pose input", ".solutions button", ".joint .name", ".ends"])
      expect(await cutOff(page, part), part).toBeLessThanOrEqual(0);
  }
});

test("a position of a planar map has labelled fields side by side, no z, and no slice along z", async () => {
  const page = await opened("#arm=rrr&section=workspace&cells=8&directions=90");
  await page.getByRole("button", { name: "Compute the map" }).click();
  await page.getByText(/positions are reached/).waitFor();
  const [x, y] = [page.getByLabel("x of a position"), page.getByLabel("y of a position")];
  const [a, b] = [await x.boundingBox(), await y.boundingBox()];
  expect(Math.abs((a?.y ?? NaN) - (b?.y ?? NaN))).toBeLessThan(2);
  expect(await page.getByLabel("z of a position").isVisible()).toBe(false);
  expect(await page.getByLabel("Normal of the slice").isVisible()).toBe(false);
  await x.fill("3");
  await y.fill("2");
  await y.press("Enter");
  await page.getByText(/headings reached \d+\s%/).waitFor();
});

test("waypoints of a planar arm are listed as x, y and θ", async () => {
  const page = await opened(`#arm=rrr&section=line&waypoints=${three}`);
  const items = page.locator("ol.waypoints li");
  expect(await items.first().textContent()).toContain("6.000, 2.500 m, 30.0°");
  expect(await items.nth(2).textContent()).toContain("−4.000, 2.500 m, 180.0°");
});

test("a report begins with what is proved, and names the limits that are assumed", async () => {
  const page = await opened(`#arm=rrr&section=line&waypoints=${three}`);
  const proof = page.getByText(/^Proved: at every time the tool is within \d+(\.\d)? [nµm]?m of the line\.$/);
  await proof.waitFor();
  const report = page.locator(".panel .numbers").first();
  expect(await report.locator("p").first().textContent()).toBe(await proof.textContent());
  expect(await report.textContent()).toContain("are published for this arm; 57.3°/s and 229.2°/s² are assumed.");
  const other = await opened("#arm=panda&section=line&waypoints=0.5,0,0.5,0,1,0,0;0.5,0.2,0.5,0,1,0,0");
  await other.getByText("Proved: at every time").waitFor();
  expect(await other.getByText("57.3°/s").count()).toBe(0);
});

test.each([
  [1.84e-8, "18 nm", "19 nm"],
  [9.2e-10, "0.9 nm", "1.0 nm"],
  [9.9951e-4, "1.0 mm", "1.0 mm"],
  [0.0123, "12 mm", "13 mm"],
  [2, "2.0 m", "2.0 m"],
  [0, "0.0 nm", "0.0 nm"],
  [1e-14, "0.0 nm", "0.1 nm"],
])("%d m is %s, as a bound %s", (value, words, bound) => {
  const units = [
    ["m", 1],
    ["mm", 1e-3],
    ["µm", 1e-6],
    ["nm", 1e-9],
  ] as const;
  expect(small(value, [...units])).toBe(words);
  expect(small(value, [...units], "up")).toBe(bound);
});

test("the caption of the Jacobian stands beside its scrolling table, whose edge fades", async () => {
  const page = await opened("#arm=panda", { width: 1280, height: 800 });
  const box = page.getByRole("region", { name: "Table of the Jacobian" });
  await box.locator("td").nth(8).waitFor();
  expect(await box.locator("caption").count()).toBe(0);
  const caption = page.getByText("Jacobian: m/s and rad/s of the tool");
  expect(
    await caption.evaluate((part) => (part as unknown as { scrollWidth: number }).scrollWidth),
  ).toBeLessThanOrEqual(Math.ceil((await box.boundingBox())?.width ?? 0));
  for (const cell of await box.locator("tbody td").allTextContents()) expect(cell).toMatch(/^−?\d+\.\d\d$/);
  const hidden = Number(
    await box.evaluate((b) => {
      const { scrollWidth, clientWidth } = b as unknown as Record<string, number>;
      return (scrollWidth ?? 0) - (clientWidth ?? 0);
    }),
  );
  const fade = (): Promise<string> =>
    box.evaluate((b) =>
      (b as unknown as { style: { getPropertyValue(n: string): string } }).style.getPropertyValue("--right"),
    );
  await expect.poll(async () => Number.parseFloat(await fade())).toBe(Math.min(24, hidden));
});

test("an empty formula names its field", async () => {
  const page = await opened("#arm=rp&section=lessons&lesson=forward");
  await page.getByLabel("x =").fill("q1");
  await page.keyboard.press("Enter");
  await page.getByText("Type a formula for y and θ too.").waitFor();
});

test("the lessons are one step of Back, with their arm", async () => {
  const page = await opened("#arm=panda");
  const before = Number(await page.evaluate("history.length"));
  await page.getByRole("link", { name: "Lessons", exact: true }).click();
  await expect.poll(() => page.locator(".arm-name").textContent()).toBe("R:1");
  await expect.poll(() => page.url()).toContain("section=lessons");
  await frames(page, 30); // another step would be written in this time
  expect(Number(await page.evaluate("history.length"))).toBe(before + 1);
});

test("before the opening is over neither charts nor the command are loaded", async () => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  const asked: string[] = [];
  page.on("request", (request) => asked.push(request.url().split("/").at(-1) ?? ""));
  await page.addInitScript(`
    (function look() { // when the opening was last seen
      if (document.querySelector(".callout")?.textContent !== "Drag the tool.") window.opening = performance.now();
      if (window.ended !== true) requestAnimationFrame(look);
    })();`);
  await page.goto(there().address);
  await page.getByText("Drag the tool.").waitFor();
  await page.evaluate("window.ended = true");
  await page.getByText(/^2 solutions/).waitFor();
  const early = await page.evaluate(`performance.getEntriesByType("resource")
    .filter(({ name, startTime }) => /(beeline|uPlot|command_worker)[^/]*$/.test(name) && startTime < window.opening)
    .map(({ name }) => name)`);
  expect(early).toEqual([]);
  expect(asked.some((name) => name.startsWith("beeline"))).toBe(true);
  expect(asked.some((name) => name.startsWith("uPlot"))).toBe(false);
  await expect.poll(() => page.locator("#pose-2").inputValue()).toBe("180.00");
  expect(await page.locator("#pose-0").inputValue()).toBe("-4.0000");
  await context.close();
});
