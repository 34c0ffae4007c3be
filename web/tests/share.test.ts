import { expect, test } from "vitest";
import { axe, chooseArm, drag, jointValues, pages, shownArm, toolAt } from "./browser.js";

const { opened, there } = pages();

test("undo and redo go back and forth, one gesture at a time, by buttons and by keys", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const [undo, redo] = ["Undo", "Redo"].map((name) => page.getByRole("button", { name }));
  expect(await undo?.isDisabled()).toBe(true);
  const states = [await jointValues(page)];
  for (const [dx, dy] of [
    [-30, 20],
    [-20, 30],
  ] as const) {
    const from = await toolAt(page);
    await drag(page, from, { x: from.x + dx, y: from.y + dy });
    states.push(await jointValues(page));
  }
  await undo?.click();
  expect(await jointValues(page)).toEqual(states[1]);
  await page.keyboard.press("Control+z");
  expect(await jointValues(page)).toEqual(states[0]);
  expect(await undo?.isDisabled()).toBe(true);
  await redo?.click();
  await page.keyboard.press("Control+Shift+Z");
  expect(await jointValues(page)).toEqual(states[2]);
  expect(await redo?.isDisabled()).toBe(true);
});

test("a number that was typed can be undone at once, without a moment's rest", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const undo = page.getByRole("button", { name: "Undo" });
  const isEnabled = await page.locator("#joint-0").evaluate((field: HTMLInputElement) => {
    field.value = "20";
    field.dispatchEvent(new Event("change", { bubbles: true }));
    return [...document.querySelectorAll("button")].some((one) => one.textContent === "Undo" && !one.disabled);
  });
  expect(isEnabled).toBe(true);
  await undo.click();
  expect((await jointValues(page))[0]).toBeCloseTo((0.4 * 180) / Math.PI, 1);
  expect(await undo.isDisabled()).toBe(true);
});

test("the browser's Back returns to the section and the arm before", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  await page.getByRole("link", { name: "Control", exact: true }).click();
  await expect.poll(() => page.url()).toContain("section=control");
  await chooseArm(page, "panda");
  await expect.poll(() => shownArm(page)).toBe("panda");
  await expect.poll(() => page.url()).toContain("arm=panda&q="); // the last that is written
  await page.goBack();
  await expect.poll(() => shownArm(page)).toBe("rrr");
  await expect.poll(() => page.url()).toContain("arm=rrr");
  await page.goBack();
  await page.locator('#sections a[aria-current="page"]', { hasText: "Pose" }).waitFor();
  await page.goForward();
  await page.locator('#sections a[aria-current="page"]', { hasText: "Control" }).waitFor();
});

test("a link and a frame show the same arm in the same configuration", async () => {
  const page = await opened("#arm=rrr&q=0.25,0.5,0.125&frames=1");
  await page.getByRole("button", { name: "Share" }).click();
  const link = await page.locator("#share-link").inputValue();
  const frame = await page.locator("#share-frame").inputValue();
  expect(await axe(page)).toEqual([]);
  const other = await opened(new URL(link).hash);
  expect((await jointValues(other))[1]).toBeCloseTo((0.5 * 180) / Math.PI, 1);
  const context = await there().browser.newContext();
  const host = await context.newPage();
  await host.goto(`${there().address}saved.html`).catch(() => undefined);
  await host.setContent(frame);
  const inner = host.frameLocator("iframe");
  await inner.locator("#joint-1").waitFor();
  await expect
    .poll(async () => Number(await inner.locator("#joint-1").inputValue()))
    .toBeCloseTo((0.5 * 180) / Math.PI, 1);
  await context.close();
});

test("Share says beside the button that the link is copied", async () => {
  const page = await opened("#arm=rrr&q=0.25,0.5,0.125");
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.getByText("Link copied").waitFor();
  expect(await page.evaluate("navigator.clipboard.readText()")).toBe(await page.locator("#share-link").inputValue());
});

test("Help links to the documentation where the page stands in it", async () => {
  const page = await opened("#arm=rrr");
  await page.getByRole("button", { name: "Help" }).click();
  await page.getByText("this page (docs/howto/page.md)").waitFor();
  const context = await there().browser.newContext();
  const other = await context.newPage();
  await other.route(there().address, async (route) => {
    const html = await (await route.fetch()).text();
    await route.fulfill({ contentType: "text/html", body: html.replace("<body", '<body data-docs="."') });
  });
  await other.goto(there().address);
  await other.getByRole("button", { name: "Help" }).click();
  expect(await other.getByRole("link", { name: "this page" }).getAttribute("href")).toBe("./howto/page.html");
  await context.close();
});

test("units and appearance are in the settings; the page says that it is in English only", async () => {
  const page = await opened("#arm=rrr&q=0.1,0.2,0.3");
  await page.getByRole("button", { name: "Settings" }).click();
  expect(await axe(page)).toEqual([]);
  await page.getByLabel("radians").check();
  await page.getByLabel("dark", { exact: true }).check();
  await page.getByText("in English only").first().waitFor();
  await page.keyboard.press("Escape");
  await expect.poll(async () => (await jointValues(page))[0]).toBe(0.1);
  const ground = await page.evaluate("getComputedStyle(document.body).backgroundColor");
  expect(ground).toBe("rgb(20, 23, 27)");
  expect(await axe(page)).toEqual([]);
  await page.getByRole("button", { name: "Help" }).click();
  await page.getByText("turns or slides its joint").waitFor();
  expect(await axe(page)).toEqual([]);
});

test.each([
  ["#arm=rrr", "light", /2 solutions/],
  ["#arm=rrr&section=control", "dark", /Cartesian space, eq. 1.6: .* and the goal is reached/],
  ["#arm=ur5&frames=1", "dark", /8 solutions/],
  ["#arm=rrr&section=line&waypoints=4,3,0,1,0,0,0;3,4,0,1,0,0,0", "dark", "From the first waypoint"],
] as const)("%s in %s is accessible", async (hash, colorScheme, complete) => {
  const page = await opened(hash);
  await page.emulateMedia({ colorScheme });
  await page.getByText(complete).waitFor();
  expect(await axe(page)).toEqual([]);
});

test("undo takes back work, not where one looked, and shows where the work was done", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&section=line");
  const undo = page.getByRole("button", { name: "Undo" });
  await page.getByRole("button", { name: "Add a waypoint here" }).click();
  await expect.poll(() => undo.isDisabled()).toBe(false);
  await page.getByRole("link", { name: "Pose", exact: true }).click();
  await page.getByRole("button", { name: "Frames", exact: true }).click();
  await undo.click();
  await expect.poll(() => page.url()).toContain("section=line");
  await expect.poll(() => page.url()).not.toContain("waypoints=");
  expect(await undo.isDisabled()).toBe(true);
  expect(await page.getByRole("button", { name: "Frames", exact: true }).getAttribute("aria-pressed")).toBe("true");
});

test("an arm that is refused leaves arm and waypoints; lessons give the arm back", async () => {
  const waypoint = "0.5,0.1,0.6,0,1,0,0";
  const page = await opened(`#arm=ur5&section=line&waypoints=${waypoint}`);
  await chooseArm(page, "RRR:1,x");
  await page.getByRole("alert").first().waitFor();
  await page.keyboard.press("Escape");
  await expect.poll(() => page.locator(".refusal:visible").count()).toBe(0); // it was about what was typed there
  expect(await shownArm(page)).toBe("ur5");
  await expect.poll(() => page.url()).toContain(`waypoints=${waypoint}`);
  await page.getByRole("link", { name: "Lessons", exact: true }).click();
  await expect.poll(() => shownArm(page)).toBe("R:1");
  await page.getByRole("link", { name: "Line", exact: true }).click();
  await expect.poll(() => shownArm(page)).toBe("ur5");
  await expect.poll(() => page.url()).toContain(`waypoints=${waypoint}`);
});
