import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { chooseArm, drag, jointValues, pages, shared, shownArm, toolAt } from "./browser.js";
import { json, run } from "./native.js";

const { opened, there } = pages();

const status = (page: Page) => page.getByLabel("Inverse kinematics").getByRole("status");
const field = (page: Page, i: number) => page.locator(`#joint-${i}`);

test("the tool follows the mouse; out of reach it slides along the border, with the command's reason beside it", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&unit=rad");
  await status(page).getByText("solution").waitFor();
  await page.locator(".drawing").hover();
  await page.mouse.wheel(0, 400); // all of the reach is seen
  const begin = await toolAt(page);
  await drag(page, begin, { x: begin.x + 30, y: begin.y + 20 });
  await status(page).getByText("solution").waitFor();
  const now = await toolAt(page);
  expect(Math.hypot(now.x - begin.x - 30, now.y - begin.y - 20)).toBeLessThan(2);
  const pose = await page
    .getByLabel("Pose of the tool")
    .locator("input")
    .evaluateAll((all) => all.map((input) => Number((input as unknown as { value: string }).value)));
  const q = await jointValues(page);
  const native = json<{ pose: { planar: Record<"x" | "y" | "theta", number> } }>(["fk", "rrr", `--q=${q.join(",")}`]);
  expect(pose[0]).toBeCloseTo(native.pose.planar.x, 2);
  expect(pose[2]).toBeCloseTo(native.pose.planar.theta, 3);
  const box = await page.locator("#stage").boundingBox();
  const corner = { x: (box?.x ?? 0) + 60, y: (box?.y ?? 0) + 30 };
  await drag(page, now, corner, false);
  const callout = page.locator(".callout");
  await callout.getByText(/reach/).waitFor();
  const { x, y } = await toolAt(page);
  const beside = await callout.boundingBox();
  const gap = Math.max((beside?.x ?? NaN) - x, x - (beside?.x ?? NaN) - (beside?.width ?? 0));
  expect(gap).toBeLessThan(60);
  const border = await jointValues(page);
  await page.mouse.move(corner.x + 160, corner.y, { steps: 6 });
  await callout.getByText(/reach/).waitFor();
  const slid = await toolAt(page);
  expect(Math.hypot(slid.x - x, slid.y - y)).toBeGreaterThan(20);
  for (const values of [border, await jointValues(page)]) {
    const { pose: at } = json<typeof native>(["fk", "rrr", `--q=${values.join(",")}`]);
    const wrist = Math.hypot(at.planar.x - 2 * Math.cos(at.planar.theta), at.planar.y - 2 * Math.sin(at.planar.theta));
    expect(Math.abs(wrist - 7)).toBeLessThan(0.02); // the first two links, stretched
  }
  await page.mouse.up();
  await callout.waitFor({ state: "hidden" });
  await status(page).getByText("solution").waitFor();
  expect(await page.getByLabel("Inverse kinematics").locator("li").count()).toBeGreaterThan(0);
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
  await expect.poll(async () => await jointValues(page)).not.toEqual(q);
  await expect.poll(() => page.url()).not.toContain(q.join(","));
  const moved = (new URL(page.url().replace("#", "?")).searchParams.get("q") ?? "").split(",");
  const { pose } = json<{ pose: { translation: number[] } }>(["fk", "ur5", `--q=${moved.join(",")}`]);
  expect(pose.translation[0]).toBeCloseTo(after, 9);
  await panel.getByLabel("yaw", { exact: true }).fill("1");
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await jointValues(page)).join()).not.toBe(moved.join());
  const rest = await jointValues(page);
  await x.fill("5");
  await page.keyboard.press("Enter");
  await status(page).getByText("reach").waitFor();
  const z = await Promise.all(
    ["y", "z", "roll", "pitch", "yaw"].map((name) => panel.getByLabel(name, { exact: true }).inputValue()),
  );
  const native = run(["ik", "ur5", `--pose=5,${z.join(",")}`, "--json"]);
  const { code, fields } = JSON.parse(native.stdout) as { code: string; fields: Record<string, number | number[]> };
  const text = (await status(page).textContent()) ?? "";
  expect(code).toBe("position_unreachable");
  const metres = [Number(fields["distance"]), ...(fields["nearest"] as number[])];
  const said = (text.match(/−?\d+\.\d+/g) ?? []).map((one) => Number(one.replace("−", "-")));
  expect(said.length).toBe(metres.length);
  said.forEach((value, i) => expect(value).toBeCloseTo(metres[i] ?? NaN, 2)); // the fields show less than the page asks with
  expect(await jointValues(page)).toEqual(rest);
  await page.keyboard.press("Tab");
  expect(Number(await x.inputValue())).toBe(5); // it waits for the other numbers
  expect(await x.getAttribute("aria-invalid")).toBe("true");
});

test("a planar arm's tool has x, y and θ, and nothing else", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const panel = page.getByLabel("Pose of the tool");
  expect(await panel.locator("input").count()).toBe(3);
  await panel.getByLabel("θ", { exact: true }).fill("90");
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await jointValues(page)).reduce((sum, value) => sum + value, 0)).toBeCloseTo(90, 1);
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
  const chosen = await jointValues(page);
  expect(chosen).not.toContain(0);
  expect(chosen[0]).not.toBeCloseTo(180 / Math.PI, 1);
});

test("a joint string with an empty length is refused as the command refuses it", async () => {
  const page = await opened("#arm=rrr");
  await chooseArm(page, "RRR:1,,2");
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
  const colours = (): Promise<unknown> =>
    page.evaluate(
      "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => { const c = document.querySelector('#stage canvas');" +
        "const d = document.createElement('canvas'); d.width = c.width; d.height = c.height; const g = d.getContext('2d'); g.drawImage(c, 0, 0);" +
        "done(new Set(new Uint32Array(g.getImageData(0, 0, c.width, c.height).data.buffer)).size); })))",
    );
  await expect.poll(colours).toBeGreaterThan(20);
});

test("without WebAssembly the page says so", async () => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  await page.addInitScript("delete globalThis.WebAssembly");
  await page.goto(there().address);
  await page.getByRole("alert").getByText("has no WebAssembly").waitFor();
});

test("a picture is saved as the command's drawing, of a spatial arm as it is seen, and as a PNG", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6");
  const saved = readFileSync(await (await shared(page, "Drawing")).path(), "utf8");
  const native = run(["draw", "rrr", "--q=0.4,0.9,0.6", "--out=arm.svg"]).files["arm.svg"];
  expect(saved).toBe(native);
  await chooseArm(page, "panda");
  await expect.poll(() => page.url()).toMatch(/arm=panda&q=/);
  const spatial = readFileSync(await (await shared(page, "Drawing")).path(), "utf8");
  const q = new URL(page.url().replace("#", "?")).searchParams.get("q") ?? "";
  const [azimuth, elevation] = [-50, 25];
  const view = [`--azimuth=${azimuth}`, `--elevation=${elevation}`];
  const size = (text: string): string => /viewBox="[^"]*"/.exec(text)?.[0] ?? "";
  expect(size(spatial)).toBe(size(run(["draw", "panda", `--q=${q}`, ...view, "--out=arm.svg"]).files["arm.svg"] ?? ""));
  for (const arm of ["panda", "rrr"]) {
    await chooseArm(page, arm);
    await expect.poll(() => shownArm(page)).toBe(arm);
    const png = readFileSync(await (await shared(page, "Picture")).path());
    expect(png.subarray(1, 4).toString()).toBe("PNG");
    expect(png.length).toBeGreaterThan(10_000);
  }
});

test("a number replaces the one that is clicked; numbers that are not reached wait for the others", async () => {
  const page = await opened("#arm=ur5");
  await page.locator("#pose-0").click();
  await page.keyboard.type("5");
  expect(await page.locator("#pose-0").inputValue()).toBe("5");
  await page.keyboard.press("Enter");
  await expect.poll(() => page.locator("#pose-0").getAttribute("aria-invalid")).toBe("true");
  await page.locator("#pose-1").click();
  await page.keyboard.type("0.2");
  await page.keyboard.press("Enter");
  expect(await page.locator("#pose-0").inputValue()).toBe("5.0000");
  await page.locator("#pose-0").click();
  await page.keyboard.type("0.4");
  await page.keyboard.press("Enter");
  await expect.poll(() => page.locator("#pose-0").getAttribute("aria-invalid")).toBe(null);
  expect(await page.locator("#pose-1").inputValue()).toBe("0.2000");
});
