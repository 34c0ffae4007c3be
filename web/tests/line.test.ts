import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { drag, frames, jointValues, pages, toolAt, toWorld } from "./browser.js";
import { json } from "./native.js";

const { opened } = pages();

const pose = ([x, y, degrees]: readonly [number, number, number]): string => {
  const half = (degrees * Math.PI) / 360;
  return [x, y, 0, Math.cos(half), 0, 0, Math.sin(half)].join(",");
};
const places = [
  [6, 2.5, 30],
  [-0.5, 6.5, 120],
  [-4, 2.5, 180],
] as const;
const three = places.map(pose).join(";");
const strong = (page: Page) => page.locator(".numbers strong").first();

test("three points are added with the tool; numbers and a dashed preview stand in the picture; the plan is proved", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&section=line");
  const add = page.getByRole("button", { name: "Add a waypoint here" });
  await add.click();
  await page.getByText("One more waypoint makes a line.").waitFor();
  for (const [dx, dy] of [
    [-60, 10],
    [-40, 50],
  ] as const) {
    const from = await toolAt(page);
    await drag(page, from, { x: from.x + dx, y: from.y + dy });
    await add.click();
  }
  expect(await page.getByText("One more waypoint").count()).toBe(0);
  await expect.poll(() => page.locator(".drawing .waypoint-text").allTextContents()).toEqual(["1", "2", "3"]);
  await strong(page).getByText("reached").waitFor();
  expect(await page.getByText("Deviation from the line").count()).toBe(1);
  await expect.poll(() => page.locator(".trail.planned").count()).toBe(1);
});

test("a waypoint is dragged in the picture: the preview follows, the plan when it is dropped", async () => {
  const page = await opened(`#arm=rrr&q=1.2,-1.7,1&section=line&waypoints=${three}`);
  await strong(page).getByText("reached").waitFor();
  await toolAt(page); // the picture has the room for the plan
  const box = await page.locator('.waypoints [data-grab="waypoint 1"]').boundingBox();
  const at = { x: (box?.x ?? 0) + 16, y: (box?.y ?? 0) + 16 };
  const to = { x: at.x + 40, y: at.y + 60 };
  await drag(page, at, to, false);
  await page.locator(".trail.preview .line").waitFor({ state: "attached" });
  expect(await page.locator(".trail.planned").count()).toBe(0);
  await page.mouse.up();
  await strong(page).getByText("reached").waitFor();
  await expect.poll(() => page.locator(".trail.planned").count()).toBe(1);
  const stage = await page.locator("#stage").boundingBox();
  const [x = NaN, y = NaN] = (await toWorld(page))([to.x - (stage?.x ?? 0), to.y - (stage?.y ?? 0)]);
  const away = (): number => {
    const words = new URL(page.url().replace("#", "?")).searchParams.get("waypoints") ?? "";
    const [u = NaN, v = NaN] = (words.split(";")[1] ?? "").split(",").map(Number);
    return Math.hypot(u - x, v - y);
  };
  await expect.poll(away).toBeLessThan(0.05);
});

test.each([0, 1])("the elbow that is held, %d, is kept by the plan", async (k) => {
  const files = {
    "p.csv": `x,y,theta\n${places.map(([x, y, t]) => [x, y, (t * Math.PI) / 180].join(",")).join("\n")}\n`,
  };
  const { branches } = json<{ branches: { start: number[] }[] }>(
    ["line", "rrr", "--through=p.csv", "--branches"],
    files,
  );
  const start = branches[k]?.start ?? [];
  const near = start.map((value) => value + 0.05);
  const page = await opened(`#arm=rrr&unit=rad&q=${near.join(",")}&section=line&waypoints=${three}`);
  await page.getByRole("button", { name: /^Branch \d/, pressed: true }).waitFor();
  const bar = page.getByRole("slider", { name: "Time" });
  await bar.press("End");
  await bar.press("Home");
  await expect.poll(async () => Math.abs(((await jointValues(page))[1] ?? 0) - (start[1] ?? 0))).toBeLessThan(1e-3);
});

test("a recording that exceeds a limit is red and not reached, under its own name; retimed it is", async () => {
  const page = await opened(`#arm=rrr&section=line&waypoints=${three}`);
  await strong(page).getByText("reached").waitFor();
  const text = "t,joint1,joint2,joint3\n0,0,0,0\n0.5,1,1,1\n1,0,0,0\n";
  await page
    .getByLabel("A trajectory, CSV or JSON")
    .setInputFiles({ name: "r.csv", mimeType: "text/csv", buffer: Buffer.from(text) });
  const recording = page.getByRole("region", { name: "Recording" });
  const status = recording.locator("strong");
  await status.getByText("exceeds the limits").waitFor();
  expect(await status.getAttribute("class")).toBe("over");
  expect(await recording.locator("tr.over").count()).toBe(2);
  await expect.poll(() => page.locator(".trail.refused").count()).toBe(1);
  await recording.getByRole("button", { name: "Check against the line" }).click();
  await expect.poll(() => status.textContent()).not.toContain("exceeds");
  await recording.getByRole("button", { name: "Retime within the limits" }).click();
  await status.getByText("reached").waitFor();
});

test("curves show the data with limits as bands; the player loops", async () => {
  const poses = "-0.5,0.2,0.3,0,1,0,0;-0.5,-0.2,0.3,0,1,0,0";
  const page = await opened(`#arm=ur5&section=line&waypoints=${poses}`);
  const curves = page.getByLabel("Joint curves beside their limits");
  await curves.getByRole("img").nth(5).waitFor();
  const range = (): Promise<unknown> =>
    page.evaluate(`(() => {
      // The tallest curve spans most of its chart: pixels in the joint's colour, first chart.
      const canvas = document.querySelector(".curves canvas");
      const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let [top, bottom] = [height, 0];
      for (let i = 0; i < data.length; i += 4)
        if (data[i] > 180 && data[i + 1] < 90 && data[i + 2] < 90 && data[i + 3] > 200) {
          const y = Math.floor(i / 4 / width);
          [top, bottom] = [Math.min(top, y), Math.max(bottom, y)];
        }
      return (bottom - top) / height;
    })()`);
  await expect.poll(range).toBeGreaterThan(0.35);
  const loop = page.getByRole("button", { name: "Loop" }).first();
  await loop.click();
  await page.getByRole("button", { name: "Play" }).first().click();
  await page.evaluate(`
    window.times = [];
    (function look() {
      window.times.push(Number(document.querySelector(".player input").value));
      requestAnimationFrame(look);
    })();`);
  await page.waitForFunction("window.times.some((time, i) => time < window.times[i - 1])"); // it begins again
  expect(await page.getByRole("button", { name: "Pause" }).count()).toBe(1);
  await page.getByRole("button", { name: "Pause" }).click();
});

test("after planning Play is on the screen of a phone, and the time is where the arm stands", async () => {
  const page = await opened(`#arm=rrr&q=1.2,-1.7,1&section=line&waypoints=${three}`, { width: 390, height: 844 });
  const play = page.getByRole("button", { name: "Play" });
  await play.waitFor();
  const side = await page.locator("#side").boundingBox();
  const inside = async (): Promise<boolean> => {
    const box = await play.boundingBox();
    const [top, bottom] = [box?.y ?? NaN, (box?.y ?? NaN) + (box?.height ?? NaN)];
    return top >= (side?.y ?? NaN) && bottom <= (side?.y ?? NaN) + (side?.height ?? NaN);
  };
  await expect.poll(inside).toBe(true);
  const bar = page.getByRole("slider", { name: "Time" });
  await bar.press("End");
  await page.getByRole("button", { name: "Remove waypoint 1" }).click(); // the arm stands at the last one
  await strong(page).getByText("reached").waitFor();
  await expect.poll(async () => Number(await bar.inputValue())).toBeGreaterThan(0.1);
  await expect.poll(() => bar.inputValue()).toBe(await bar.getAttribute("max"));
});

test("why a line is not possible is said in the words and the units of the page", async () => {
  const page = await opened(
    `#arm=rrr&section=line&waypoints=${[places[0], [9.5, 6.5, 115] as const].map(pose).join(";")}`,
  );
  const report = page.locator(".panel .numbers").first();
  const text = async (): Promise<string> => (await report.textContent()) ?? "";
  await expect
    .poll(text)
    .toMatch(/From waypoint 1 to waypoint 2 the tool comes \d+ % of the way, to \(\d\.\d{3}, \d\.\d{3}\) m: /);
  expect(await text()).toMatch(/stays \d\.\d° off; at the next waypoint the position is out of reach by \d\.\d{3} m/);
  expect(await text()).not.toMatch(/line 1 of 1|deg\)|_/);
  await expect
    .poll(() => page.locator(".branches li").first().textContent())
    .toContain("From waypoint 1 to waypoint 2");
  await page.getByRole("button", { name: "Settings" }).click();
  await page.getByLabel("radians").check();
  await expect.poll(text).toMatch(/stays 0\.\d{3} rad off/);
  expect(await page.locator(".branches li").first().textContent()).toContain("rad off");
});

test("a motion with new times is proved again", async () => {
  const page = await opened(`#arm=rrr&q=1.2,-1.7,1&section=line&waypoints=${three}`);
  await strong(page).getByText("reached").waitFor();
  const report = page.locator(".panel .numbers").first();
  const duration = async (): Promise<string | undefined> =>
    /reached, ([\d.]+) s/.exec((await report.textContent()) ?? "")?.[1];
  const before = await duration();
  await page.getByRole("button", { name: "Retime within the limits" }).first().click();
  await expect.poll(duration).not.toBe(before);
  await report.getByText(/^Proved: at every time the tool is within/).waitFor();
});

test("a waypoint is added where the tool is, and the button stays under the mouse; twice in one place is none", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&section=line", { width: 1280, height: 800 });
  const box = await page.getByRole("button", { name: "Add a waypoint here" }).boundingBox();
  const add = async (): Promise<void> => {
    await page.mouse.click((box?.x ?? 0) + (box?.width ?? 0) / 2, (box?.y ?? 0) + (box?.height ?? 0) / 2);
  };
  const items = page.locator("ol.waypoints li");
  await add();
  await expect.poll(() => items.count()).toBe(1);
  await add();
  await page.getByText("The tool is at waypoint 1 already. Drag it elsewhere first.").waitFor();
  expect(await items.count()).toBe(1);
  for (const [count, value] of [
    [2, "40"],
    [3, "60"],
  ] as const) {
    await page.locator("#joint-0").fill(value);
    await page.keyboard.press("Enter");
    await expect.poll(() => page.getByText("Drag it elsewhere first.").count()).toBe(0);
    await page.locator("#side").evaluate((side) => side.scrollTo(0, 0));
    await add();
    await expect.poll(() => items.count()).toBe(count);
  }
});

test("a waypoint is removed while the motion is played; the focus goes to the next one", async () => {
  const page = await opened(`#arm=rrr&q=1.2,-1.7,1&section=line&waypoints=${three}`);
  await strong(page).getByText("reached").waitFor();
  await page.getByRole("button", { name: "Loop" }).click();
  await page.getByRole("button", { name: "Play" }).click();
  const remove = page.getByRole("button", { name: "Remove waypoint 1" });
  const box = await remove.boundingBox();
  await page.mouse.move((box?.x ?? 0) + (box?.width ?? 0) / 2, (box?.y ?? 0) + (box?.height ?? 0) / 2);
  await page.mouse.down();
  await frames(page, 5); // the arm has moved
  await page.mouse.up();
  const items = page.locator("ol.waypoints li");
  await expect.poll(() => items.count()).toBe(2);
  await remove.press("Enter");
  await expect.poll(() => items.count()).toBe(1);
  expect(await remove.evaluate((button) => button === document.activeElement)).toBe(true);
  await remove.press("Enter");
  await expect.poll(() => items.count()).toBe(0);
  const add = page.getByRole("button", { name: "Add a waypoint here" });
  expect(await add.evaluate((button) => button === document.activeElement)).toBe(true);
});
