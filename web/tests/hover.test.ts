import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { drag, frames, jointValues, pages, toolAt } from "./browser.js";

const { opened } = pages();

/** What the mouse looks like at a point of the window. */
function cursor(page: Page, { x, y }: { x: number; y: number }): Promise<string> {
  return page.evaluate(`getComputedStyle(document.elementFromPoint(${x}, ${y})).cursor`);
}

const word = (page: Page) => page.locator(".overlay .hint-text");

/** All words that are written while the mouse moves around the tool, in rings around it. */
async function wordsAround(page: Page, radii: number[]): Promise<Set<string>> {
  const words = new Set<string>();
  const { x, y } = await toolAt(page);
  for (const radius of radii)
    for (let k = 0; k < 36; ++k) {
      const angle = (k * Math.PI) / 18;
      await page.mouse.move(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
      await frames(page);
      words.add((await word(page).textContent()) ?? "");
    }
  return words;
}

test("in space the mouse names what it can hold: the tool, its arrows and rings, links", async () => {
  const page = await opened("#arm=panda&q=0,-0.8,0,-2.4,0,1.6,0.8", { width: 900, height: 700 });
  const tool = await toolAt(page);
  await page.mouse.move(tool.x + 1, tool.y);
  await page.mouse.move(tool.x, tool.y);
  await expect.poll(() => word(page).textContent()).toBe("tool");
  expect(await cursor(page, tool)).toBe("grab");
  const around = await wordsAround(page, [40, 60]);
  for (const name of ["x", "y", "z"]) expect([...around]).toContain(name);
  expect([...around].some((name) => /^joint\d$/.test(name))).toBe(true);
  await page.locator("#tools").getByRole("button", { name: "Turn" }).click();
  const rings = await wordsAround(page, [40, 60]);
  expect([...rings].some((name) => /^turn about [xyz]$/.test(name))).toBe(true);
  const box = await page.locator("#stage").boundingBox();
  const empty = { x: (box?.x ?? 0) + 20, y: (box?.y ?? 0) + 20 };
  await page.mouse.move(empty.x, empty.y);
  await expect.poll(() => word(page).textContent()).toBe("");
  expect(await cursor(page, empty)).not.toBe("grab");
});

test("in the plane a hand stands over what can be held, which has a name", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const tool = await toolAt(page);
  expect(await cursor(page, tool)).toBe("grab");
  const names = await page.locator(".drawing [data-grab] > title").allTextContents();
  expect(names).toEqual(["joint1", "joint2", "joint3", "turn about z", "move the tool in x and y"]);
  const box = await page.locator("#stage").boundingBox();
  expect(await cursor(page, { x: (box?.x ?? 0) + 80, y: (box?.y ?? 0) + 40 })).not.toBe("grab");
});

test.each([
  ["#arm=rrr&q=1.2,-1.7,1&section=line&waypoints=4,3,0,1,0,0,0;3,4,0,1,0,0,0", ".drawing"],
  ["#arm=panda&section=line&waypoints=0.5,0,0.5,0,1,0,0;0.5,0.2,0.5,0,1,0,0", ".overlay"],
])("the number of a waypoint is dragged as the waypoint is, %#", async (hash, picture) => {
  const page = await opened(hash);
  await page.locator(".numbers strong").first().getByText("reached").waitFor();
  await toolAt(page);
  const q = await jointValues(page);
  const box = await page.locator(`${picture} .waypoint-text`, { hasText: "2" }).boundingBox();
  const at = { x: (box?.x ?? 0) + (box?.width ?? 0) / 2, y: (box?.y ?? 0) + (box?.height ?? 0) / 2 };
  const before = await page.locator("ol.waypoints li").allTextContents();
  await drag(page, at, { x: at.x + 30, y: at.y + 10 });
  await expect.poll(() => page.locator("ol.waypoints li").nth(1).textContent()).not.toBe(before[1]);
  expect(await page.locator("ol.waypoints li").nth(0).textContent()).toBe(before[0]);
  expect(await jointValues(page)).toEqual(q);
});

test.each(["rrr", "panda"])("the columns of the Jacobian of %s have the numbers of their joints", async (arm) => {
  const page = await opened(`#arm=${arm}&columns=1`);
  const texts = page.locator("#stage .column-text");
  await expect.poll(() => texts.count()).toBeGreaterThan(2);
  for (const text of await texts.allTextContents()) expect(text).toMatch(/^J[₁-₇]$/);
});

test("the camera follows an arm that leaves the picture by a number that is typed", async () => {
  const page = await opened("#arm=panda&q=0,-0.8,0,-2.4,0,1.6,0.8");
  const tool = await toolAt(page);
  await page.mouse.move(tool.x, tool.y);
  await page.mouse.wheel(0, -800); // nearer
  await toolAt(page);
  const inside = async (): Promise<boolean> => {
    const [box, { x, y }] = [await page.locator("#stage").boundingBox(), await toolAt(page)];
    if (!box) return false;
    return x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height;
  };
  expect(await inside()).toBe(true);
  for (const [joint, value] of [
    ["#joint-0", "120"],
    ["#joint-1", "60"],
    ["#joint-0", "-120"],
  ] as const) {
    await page.locator(joint).fill(value);
    await page.keyboard.press("Enter");
    await expect.poll(inside).toBe(true);
  }
});
