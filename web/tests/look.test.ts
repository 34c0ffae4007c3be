import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { axe, chooseArm, frames, pages, toolAt } from "./browser.js";

const { opened, there } = pages();
const phone = { width: 390, height: 844 };

interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** The boxes of all elements of a selector in the window. */
function boxes(page: Page, selector: string): Promise<Rect[]> {
  return page.evaluate(
    (selector) => [...document.querySelectorAll(selector)].map((one) => one.getBoundingClientRect().toJSON() as Rect),
    selector,
  );
}

test("on a phone the labels of rp keep clear of the frame, and the labels of rrr keep clear of the goal", async () => {
  const page = await opened("#arm=rp", phone);
  await toolAt(page);
  const [plot] = await boxes(page, ".axes .frame");
  const labels = await boxes(page, ".drawing .labels text");
  expect(labels.length).toBe(3);
  const right = (plot?.x ?? NaN) + (plot?.width ?? NaN);
  for (const { x, width } of labels) {
    expect(x).toBeGreaterThan((plot?.x ?? NaN) + 4);
    expect(x + width).toBeLessThan(right - 4);
  }
  const other = await opened("#arm=rrr&section=control", phone);
  await toolAt(other);
  const joints = await boxes(other, ".ghost.goal circle");
  expect(joints.length).toBeGreaterThan(2);
  const texts = await boxes(other, ".drawing .labels text");
  for (const { x, y, width, height } of texts)
    for (const joint of joints) {
      const [cx, cy] = [joint.x + joint.width / 2, joint.y + joint.height / 2];
      expect(cx > x && cx < x + width && cy > y && cy < y + height).toBe(false);
    }
});

test("in space the tool's coordinates keep clear of the goal", async () => {
  const page = await opened("#arm=panda&section=control", { width: 1280, height: 800 });
  await toolAt(page);
  const [goal] = await boxes(page, ".overlay .waypoint-text");
  const [pose] = await boxes(page, ".overlay .pose-text");
  expect(pose && goal && pose.y > goal.y + 40).toBe(true); // the goal's arm is above the tool, behind its name
});

test("names in the panel have one line, and choices one edge; an arm without bounds has no map", async () => {
  const page = await opened("#arm=panda&section=workspace", { width: 1280, height: 800 });
  const [self] = await boxes(page, ".self-motion label");
  expect(self?.height).toBeLessThan(24);
  const [cells, directions] = await boxes(page, ".choice select");
  expect([cells?.x, cells?.width]).toEqual([directions?.x, directions?.width]);
  for (const { height } of await boxes(page, ".choice label")) expect(height).toBeLessThan(24);
  const rp = await opened("#arm=rp&section=workspace");
  await rp
    .getByText("joint2 slides without limits, so the reach of rp has no bounds: there is no map of it.")
    .waitFor();
  await rp.getByRole("link", { name: "Pose", exact: true }).click();
  await rp.getByText("1 solution, the only one, by closed form: planar.").waitFor();
});

test("on a wide screen the panel is wider: the buttons of both controllers stand side by side", async () => {
  const page = await opened("#arm=rrr&section=control", { width: 1920, height: 1080 });
  const [joint, cartesian] = await boxes(page, ".panel .pair .icon-button");
  expect(joint?.y).toBe(cartesian?.y);
});

test("every section is accessible in dark colours; other tests look at light ones", async () => {
  const page = await opened("#arm=ur5");
  await page.emulateMedia({ colorScheme: "dark" });
  for (const section of ["Pose", "Control", "Line", "Obstacles", "Workspace", "Lessons"]) {
    await page.getByRole("link", { name: section, exact: true }).click();
    await frames(page);
    expect([section, await axe(page)]).toEqual([section, []]);
  }
});

test("the motion with which the page opens is not computed before it begins", async () => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  // Counts the calls of the core.
  await page.addInitScript(`
    window.calls = 0;
    const instantiate = WebAssembly.instantiate;
    WebAssembly.instantiate = async (module, imports) => {
      const { exports } = await instantiate(module, imports);
      const counted = (one) => typeof one === "function" ? (...args) => (++window.calls, one(...args)) : one;
      return { exports: Object.fromEntries(Object.entries(exports).map(([name, one]) => [name, counted(one)])) };
    };
    (function look() {
      const tool = document.getElementById("stage")?.dataset.tool;
      window.first ??= tool;
      if (tool === window.first) requestAnimationFrame(look);
      else window.callsThen = window.calls;
    })();`);
  await page.goto(there().address);
  await page.waitForFunction("window.callsThen !== undefined");
  const calls = Number(await page.evaluate("window.callsThen"));
  console.log(`the core is called ${calls} times before the arm moves`);
  const loads = await page.evaluate(
    "performance.getEntriesByType('resource').filter(({ name }) => /core-.*wasm/.test(name)).map((one) => one.initiatorType)",
  );
  expect(loads).toEqual(["link"]); // with the script, and once
  expect(calls).toBeGreaterThan(10);
  expect(calls).toBeLessThan(2000); // one row of control takes several
  await context.close();
});

test("numbers keep to one line beside their names, and zero has no sign", async () => {
  const page = await opened("#arm=iiwa14&q=0.68,-0.67,-0.84,1.27,0.72,-1.27,0.02", { width: 1280, height: 800 });
  for (const { height } of await boxes(page, ".pose > .quiet:nth-of-type(1)")) expect(height).toBeLessThan(24);
  await page.getByText("Infinitely many solutions").waitFor();
  const [present] = await boxes(page, ".solutions li button");
  expect(present?.height).toBeLessThan(40);
  const rrr = await opened("#arm=rrr&q=0.5,-0.000005,0.6&section=control", phone);
  await rrr.locator(".drawing .labels text", { hasText: "θ₂ = 0.0°" }).waitFor();
  const beyond = await rrr
    .locator(".gains .joint label")
    .evaluateAll((all) => all.map((label) => label.scrollWidth - label.clientWidth));
  expect(beyond).toEqual([0, 0, 0]);
});

test("a picture that cannot be loaded is a sentence; another arm is shown from the top of the panel", async () => {
  const context = await there().browser.newContext({ viewport: phone });
  const page = await context.newPage();
  await page.route("**/spatial_picture-*.js", (route) => route.abort());
  await page.goto(`${there().address}#arm=rrr&section=line`);
  await page.waitForSelector("#first", { state: "detached" });
  await chooseArm(page, "ur5");
  await page.getByText("The picture of spatial arms cannot be loaded: reload the page.").waitFor();
  await page.locator("#side").evaluate((side) => side.scrollTo(0, 300));
  await chooseArm(page, "rp");
  await expect.poll(() => page.locator("#side").evaluate((side) => side.scrollTop)).toBe(0);
  await context.close();
});

test("the value of an angle has the colour of its joint, which it may be far from", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const texts = page.locator(".drawing .angle-text");
  await expect.poll(() => texts.count()).toBe(3);
  const fills = await texts.evaluateAll((all) => all.map((text) => getComputedStyle(text).fill));
  const strongest = fills.map((fill) => {
    const channels = (fill.match(/[\d.]+/g) ?? []).slice(0, 3).map(Number);
    return channels.indexOf(Math.max(...channels));
  });
  expect(strongest).toEqual([0, 1, 2]); // red, green, blue
});
