import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { compressed } from "../src/address/compression.js";
import { lessons } from "../src/lessons/lessons.js";
import { axe, jointValues, pages, toolAt, touch } from "./browser.js";

const { there } = pages();

async function phone(hash: string, size = { width: 390, height: 844 }): Promise<Page> {
  const context = await there().browser.newContext({ viewport: size, hasTouch: true, isMobile: true });
  const page = await context.newPage();
  await page.goto(there().address + hash);
  await page.waitForSelector("#first", { state: "detached" });
  return page;
}

test.each(["pose", "control", "line", "obstacles", "workspace", "lessons"])(
  "on a phone the picture and the sliders of the section %s are on the screen together",
  async (section) => {
    const page = await phone(`#arm=rrr&section=${section}&lesson=rrr`);
    const slider = page.getByLabel("joint3, degrees, slider");
    if (section === "lessons") await page.locator("article h1").waitFor();
    await slider.scrollIntoViewIfNeeded();
    const [stage, row] = [await page.locator("#stage").boundingBox(), await slider.boundingBox()];
    expect(stage?.y).toBeGreaterThanOrEqual(0);
    expect(stage?.height).toBeGreaterThan(250);
    expect((stage?.y ?? 0) + (stage?.height ?? 0)).toBeLessThanOrEqual(row?.y ?? 0);
    expect((row?.y ?? 0) + (row?.height ?? 0)).toBeLessThanOrEqual(844);
    expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(390);
    expect(await page.evaluate("document.documentElement.scrollHeight")).toBeLessThanOrEqual(844);
    expect(await axe(page)).toEqual([]);
    await page.context().close();
  },
);

test.each(["rrr", "panda"])("on a phone all buttons of the picture of %s are seen, and large enough", async (arm) => {
  const page = await phone(`#arm=${arm}`);
  const names = arm === "rrr" ? ["Angles", "Whole arm"] : ["Turn", "Whole arm"];
  for (const name of ["Frames", "Solutions", "Jacobian", "Ellipsoid", ...names]) {
    const box = await page.locator("#tools").getByRole("button", { name, exact: true }).boundingBox();
    expect(box?.x).toBeGreaterThanOrEqual(0);
    expect((box?.x ?? NaN) + (box?.width ?? NaN)).toBeLessThanOrEqual(390);
  }
  await expect.poll(() => small(page)).toEqual([]);
  await page.locator("#arm").click();
  await expect.poll(() => small(page)).toEqual([]);
  const [a, b] = [page.locator(".gallery li").nth(0), page.locator(".gallery li").nth(1)];
  expect((await a.boundingBox())?.y).toBe((await b.boundingBox())?.y); // two columns
  await page.context().close();
});

test("on a phone a long name of an arm is cut off, and all buttons beside it are on the screen", async () => {
  const page = await phone("#section=lessons&lesson=redundant");
  await page.getByRole("heading", { name: "A redundant arm" }).waitFor();
  for (const name of ["Undo", "Redo", "Share", "Settings", "Help"]) {
    const box = await page.locator("#bar").getByRole("button", { name }).boundingBox();
    expect([name, (box?.x ?? NaN) + (box?.width ?? NaN) <= 390]).toEqual([name, true]);
  }
  await page.context().close();
});

test("on a phone equations have the room of the text: a number goes below, and only one of all is scrolled", async () => {
  const wide: string[] = [];
  const page = await phone("#section=lessons&lesson=definitions");
  for (const { id } of lessons) {
    await page.goto(page.url().replace(/#.*/, `#section=lessons&lesson=${id}`));
    await page.locator(`.contents a[aria-current="page"][href$="lesson=${id}"]`).waitFor({ state: "attached" });
    await page.locator("article h1").waitFor();
    const over = await page
      .locator('article math[display="block"], article .matrices, article li')
      .evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth + 1).length);
    if (over > 0) wide.push(`${id}: ${over}`);
  }
  expect(wide).toEqual(["waypoints: 1"]); // eq. 1.7
  await page.context().close();
});

/** The part of the panel that is on the screen: from its top to the links of the sections. */
async function panel(page: Page): Promise<{ top: number; bottom: number }> {
  const box = await page.locator("#side").boundingBox();
  return { top: box?.y ?? NaN, bottom: (box?.y ?? NaN) + (box?.height ?? NaN) };
}

test("on a phone a gain and why it diverges are on the screen at once; the slider stays under the finger", async () => {
  const page = await phone("#arm=rrr&section=control&gain=0.1");
  const slider = page.getByLabel("Kp, proportional gain, slider");
  await page.getByText(/Cartesian space, eq. 1.6: .* and the goal is reached/).waitFor();
  const before = await slider.boundingBox();
  const [x, y] = [before?.x ?? NaN, (before?.y ?? NaN) + (before?.height ?? NaN) / 2];
  expect(y).toBeLessThan((await panel(page)).bottom);
  await touch(page, [
    { x: x + 15, y },
    { x: x + (before?.width ?? NaN) - 2, y },
  ]);
  await page.getByText("it shrinks only for 0 < Kp < 2").waitFor();
  const words = await page.locator(".response").boundingBox();
  expect((words?.y ?? NaN) + (words?.height ?? NaN)).toBeLessThanOrEqual((await panel(page)).bottom);
  await page.getByText(/Cartesian space, eq. 1.6: .* does not arrive/).waitFor();
  expect((await slider.boundingBox())?.y).toBe(before?.y);
  const texts = await page.locator(".labels text").all();
  expect(texts.length).toBeGreaterThan(4);
  for (const box of await Promise.all(texts.map((text) => text.boundingBox()))) {
    expect(box?.x).toBeGreaterThanOrEqual(0); // no text is cut off
    expect((box?.x ?? NaN) + (box?.width ?? NaN)).toBeLessThanOrEqual(390);
  }
  await page.context().close();
});

test("on a phone waypoints are added in one place, and Play and the proof are on the screen", async () => {
  const page = await phone("#arm=rrr&q=0.4,0.9,0.6&section=line");
  const add = await page.getByRole("button", { name: "Add a waypoint here" }).boundingBox();
  const items = page.locator("ol.waypoints li");
  for (const [count, dx] of [
    [1, 0],
    [2, -40],
    [3, -30],
  ] as const) {
    const [from, q] = [await toolAt(page), await jointValues(page)];
    if (dx !== 0) {
      await touch(page, [from, { x: from.x + dx, y: from.y + 5 }]);
      await expect.poll(() => jointValues(page)).not.toEqual(q);
      await toolAt(page);
    }
    let taps = 0; // one that a loaded browser has lost is made again
    const added = async (): Promise<[number, string[]]> => {
      if ((await items.count()) < count && ++taps <= 2)
        await page.touchscreen.tap((add?.x ?? NaN) + 60, (add?.y ?? NaN) + 20);
      return [await items.count(), await page.locator(".panel .refusal:visible").allTextContents()];
    };
    await expect.poll(added, { interval: 10_000 }).toEqual([count, []]);
    if (count > 1) await page.locator(".panel strong").getByText("reached").waitFor();
  }
  expect(await page.getByRole("button", { name: "Add a waypoint here" }).boundingBox()).toEqual(add);
  const { bottom } = await panel(page);
  const places = [page.getByRole("button", { name: "Play" }), page.locator(".panel .proof")];
  for (const place of places) {
    const below = async (): Promise<number> => {
      const box = await place.boundingBox();
      return (box?.y ?? NaN) + (box?.height ?? NaN);
    };
    await expect.poll(below).toBeLessThanOrEqual(bottom); // the bar of a computation is above them meanwhile
  }
  await page.context().close();
});

/** What can be touched and is less than 40 pixels high or wide. */
function small(page: Page): Promise<string[]> {
  return page.evaluate(`[...document.querySelectorAll("button, a, input, select, summary, textarea")]
    .map((part) => {
      const label = /checkbox|radio/.test(part.type) ? part.closest("label") : null;
      return [part, (label ?? part).getBoundingClientRect()];
    })
    .filter(([part, { width, height }]) => part.checkVisibility() && width > 0 && (width < 40 || height < 40))
    .filter(([part]) => !part.matches(".skip"))
    .map(([part, { width, height }]) => [part.textContent || part.id, width, height].join(" "))`);
}

test("touch drags the tool and a link; two fingers magnify; the panel scrolls, the picture does not", async () => {
  const page = await phone("#arm=rrr&q=0.4,0.9,0.6");
  const from = await toolAt(page);
  const before = await jointValues(page);
  const to = { x: from.x - 40, y: from.y + 20 };
  await touch(page, [from, to]);
  await expect.poll(() => jointValues(page)).not.toEqual(before);
  await toolAt(page);
  const dragged = await jointValues(page);
  const now = await toolAt(page);
  expect(Math.hypot(now.x - to.x, now.y - to.y)).toBeLessThan(6);
  const link = await page.locator('[data-grab="joint 0"]').boundingBox();
  const middle = { x: (link?.x ?? 0) + (link?.width ?? 0) / 2, y: (link?.y ?? 0) + (link?.height ?? 0) / 2 };
  await touch(page, [middle, { x: middle.x - 10, y: middle.y - 40 }]);
  await expect.poll(async () => (await jointValues(page))[0]).not.toBe(dragged[0]);
  await toolAt(page);
  const turned = await jointValues(page);
  expect(turned[0]).not.toBe(dragged[0]);
  expect(turned.slice(1)).toEqual(dragged.slice(1));
  const width = async (): Promise<number> => {
    const ticks = await page
      .locator(".axes text[data-axis=x]")
      .evaluateAll((all) =>
        all.map((text) => [Number((text.textContent ?? "").replace("−", "-")), Number(text.getAttribute("x"))]),
      );
    return ((ticks.at(-1)?.[1] ?? 0) - (ticks[0]?.[1] ?? 0)) / ((ticks.at(-1)?.[0] ?? 0) - (ticks[0]?.[0] ?? 0));
  };
  const scale = await width();
  const stage = await page.locator("#stage").boundingBox();
  const [x, y] = [(stage?.x ?? 0) + 120, (stage?.y ?? 0) + 60];
  await touch(
    page,
    [
      { x, y },
      { x: x - 40, y },
    ],
    [
      { x: x + 60, y },
      { x: x + 120, y },
    ],
  );
  await toolAt(page);
  expect(await width()).toBeGreaterThan(1.5 * scale);
  expect(await jointValues(page)).toEqual(turned);
  const scrolled = (): Promise<number> => page.evaluate("document.querySelector('#side').scrollTop");
  expect(await scrolled()).toBe(0);
  const panel = await page.locator("#side").boundingBox();
  const foot = (panel?.y ?? 0) + (panel?.height ?? 0) - 40;
  await touch(page, [
    { x: 40, y: foot },
    { x: 40, y: foot - 200 },
  ]);
  await expect.poll(scrolled).toBeGreaterThan(50);
  await page.context().close();
});

test("on a narrow phone a long name of an obstacle leaves its buttons on the screen", async () => {
  const name = "an_obstacle_with_a_very_long_name_as_a_planning_scene_may_have_it";
  const body = { name, shapes: [{ box: { size: [0.1, 0.1, 0.1] }, pose: { xyz: [0.9, 0, 0.3] } }] };
  const scene = await compressed(new TextEncoder().encode(JSON.stringify({ obstacles: [body] })));
  const page = await phone(`#arm=panda&section=obstacles&scene=${scene}`, { width: 360, height: 740 });
  await page.getByLabel("Nearest bodies").getByText(name).waitFor();
  for (const button of [`Hide ${name}`, `Remove ${name}`]) {
    const box = await page.getByRole("button", { name: button, exact: true }).boundingBox();
    expect((box?.x ?? NaN) + (box?.width ?? NaN)).toBeLessThanOrEqual(360);
  }
  const [width, inner] = await page.evaluate<number[]>(
    "[document.getElementById('side').scrollWidth, document.getElementById('side').clientWidth]",
  );
  expect(width).toBeLessThanOrEqual(inner ?? NaN);
  await page.context().close();
});

test("on a phone on its side the panel stands beside the picture", async () => {
  const page = await phone("#arm=panda", { width: 844, height: 390 });
  const [stage, side] = [await page.locator("#stage").boundingBox(), await page.locator("#side").boundingBox()];
  expect(side?.x).toBeGreaterThanOrEqual((stage?.x ?? 0) + (stage?.width ?? 0));
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(844);
  await page.context().close();
});
