import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { ofPixels, pages, toolAt } from "./browser.js";

const { opened } = pages();

/** Compares the rendered picture with the first one that this was asked of: counts the pixels that differ, of the joints'
 * bands, which have the strongest colours, and other ones. */
function compared(page: Page): Promise<{ joints: number; covered: number; others: number }> {
  return ofPixels(
    page,
    `
    const before = (window.kept ??= data);
    const count = { joints: 0, covered: 0, others: 0 };
    for (let i = 0; i < data.length; i += 4) {
      const [a, b] = [before.slice(i, i + 3), data.slice(i, i + 3)];
      const isSame = a.every((value, k) => Math.abs(value - b[k]) <= 2);
      const isJoint = Math.max(...a) - Math.min(...a) > 120;
      count.joints += Number(isJoint);
      if (!isSame) ++count[isJoint ? "covered" : "others"];
    }
    return count;`,
  );
}

const listed = (page: Page) => page.getByLabel("Inverse kinematics").locator("li button");

test.each(["panda", "ur5"])("ghosts of solutions do not cover the arm %s", async (arm) => {
  const page = await opened(`#arm=${arm}`, { width: 900, height: 600 });
  await listed(page).nth(1).waitFor();
  await toolAt(page);
  expect((await compared(page)).joints).toBeGreaterThan(200);
  await page.locator("#tools").getByRole("button", { name: "Solutions" }).click();
  await expect.poll(async () => (await compared(page)).others).toBeGreaterThan(1000);
  const { joints, covered } = await compared(page);
  expect(covered).toBeLessThan(0.05 * joints); // at its edges pixels are mixed
});

test("a few solutions are drawn, those that differ most; another one when it is pointed at", async () => {
  const page = await opened("#arm=RRRR:1,1,1,1&q=0.3,0.6,0.5,0.4&solutions=1");
  await listed(page).nth(8).waitFor();
  const ghosts = page.locator(".ghost.solution");
  await expect.poll(() => ghosts.count()).toBeGreaterThanOrEqual(3);
  expect(await ghosts.count()).toBeLessThanOrEqual(6);
  const visible = page.locator(".ghost.solution:visible");
  const shapes = new Set<string>();
  for (let i = 1; i <= 8; ++i) {
    await listed(page).nth(i).hover();
    let shape = "";
    await expect
      .poll(async () => {
        if ((await visible.count()) !== 1) return false;
        shape = (await visible.locator(".core").nth(1).getAttribute("d")) ?? "";
        return shape !== "" && !shapes.has(shape);
      })
      .toBe(true);
    shapes.add(shape);
  }
});

test("solutions that are switched on are seen whole, and with the button Whole arm", async () => {
  const q = [94, 163.7, -213].map((degrees) => (degrees * Math.PI) / 180);
  const page = await opened(`#arm=rrr&q=${q.join(",")}`);
  await page.locator("#tools").getByRole("button", { name: "Solutions" }).click();
  const inside = async (): Promise<boolean> => {
    const stage = await page.locator("#stage").boundingBox();
    const ghost = await page.locator(".ghost.solution").boundingBox();
    if (!stage || !ghost) return false;
    return ghost.y >= stage.y && ghost.y + ghost.height <= stage.y + stage.height;
  };
  await expect.poll(inside).toBe(true);
  await page.locator("#tools").getByRole("button", { name: "Whole arm" }).click();
  await expect.poll(inside).toBe(true);
});

test("the trails of the controllers are seen through the arm", async () => {
  const page = await opened("#arm=ur5", { width: 900, height: 600 });
  await toolAt(page);
  await compared(page);
  await page.getByRole("link", { name: "Control", exact: true }).click();
  await expect.poll(async () => (await compared(page)).others).toBeGreaterThan(1000); // the goal's ghost
  expect((await compared(page)).covered).toBeGreaterThan(20); // the trails begin behind the wrist
});
