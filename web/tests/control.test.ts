import { expect, test } from "vitest";
import type { Page } from "playwright-core";
import { stepResponse } from "../src/core/step_response.js";
import { pages } from "./browser.js";
import { json, loadCore, random, run } from "./native.js";

const from = [0, 0.3, 0.5];
const to = [1.73, -1.2, -0.53];
const section = `#arm=rrr&q=${from.join(",")}&goal=${to.join(",")}&section=control`;

const { opened } = pages();

test.each([
  { kp: 0.05, ki: 0, kd: 0 },
  { kp: 0.5, ki: 0.1, kd: 0.2 },
  { kp: 1.5, ki: 0, kd: 0 },
  { kp: 1.5, ki: 0.05, kd: 0.1 },
])("the step response of $kp, $ki, $kd equals beeline move", async (gains) => {
  const arm = (await loadCore()).arm("rrr");
  const given = Object.entries(gains).map(([name, value]) => `--${name}=${value}`);
  const args = ["move", "rrr", `--from=${from.join(",")}`, `--to=${to.join(",")}`, ...given, "--out=run.csv"];
  const { overshoot, steps } = json<{ overshoot: number; steps: number }>(args);
  const motion = arm.trajectory("run.csv", run(args).files["run.csv"] ?? "");
  const rows = motion.rows();
  motion.release();
  expect(rows.length).toBe(steps + 1);
  const response = stepResponse(arm, gains, from, to, steps);
  expect(response.overshoot).toBeCloseTo(overshoot, 12);
  rows.forEach((row, t) =>
    row.forEach((value, k) => {
      expect(Math.abs((to[k] as number) - value - (response.errors[k]?.[t] ?? NaN))).toBeLessThan(1e-12);
    }),
  );
  const far = (t: number): boolean =>
    to.some((end, k) => Math.abs(end - (rows[t]?.[k] ?? NaN)) >= 0.02 * Math.abs(end - (from[k] as number)));
  expect(far(response.settled as number)).toBe(false);
  expect(far((response.settled as number) - 1)).toBe(true);
  arm.release();
});

test("gains too small, good, too large, and unstable are seen in the step response", async () => {
  const page = await opened(section);
  const words = page.locator(".response");
  const kp = page.getByLabel("Kp, proportional gain", { exact: true });
  const type = async (value: string): Promise<void> => {
    await kp.fill(value);
    await kp.press("Enter");
  };
  await expect.poll(() => words.textContent()).toBe("The errors stay below 2 % from step 38 on.");
  await type("0.02");
  await expect.poll(() => words.textContent()).toContain("It crawls: the errors stay below 2 % from step 194 on.");
  await type("1.5");
  const native = json<{ overshoot: number }>([
    "move",
    "rrr",
    `--from=${from.join(",")}`,
    `--to=${to.join(",")}`,
    "--kp=1.5",
  ]);
  await expect.poll(() => words.textContent()).toContain(`overshoots by ${(100 * native.overshoot).toFixed(1)} %`);
  await type("2.3");
  await expect.poll(() => words.textContent()).toContain("Unstable");
  await type("0.5");
  await page.getByLabel("Ki, integral gain, slider").focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.getByLabel("Kd, derivative gain", { exact: true }).fill("0.2");
  await page.getByLabel("Kd, derivative gain", { exact: true }).press("Enter");
  await expect.poll(() => words.textContent()).toContain("overshoots by 20.5 %");
  await page.getByRole("button", { name: "Go to the goal" }).click();
  await page.getByText("Joint space: reached, 54 steps, overshoot 0.2054").waitFor();
  await expect.poll(() => page.url()).toContain("gain=0.5&ki=0.1&kd=0.2");
  await page.context().close();
});

/** The orange and blue pixels of the picture: the trails. */
async function trails(page: Page): Promise<number> {
  const png = (await page.locator("#stage canvas").screenshot()).toString("base64");
  return Number(
    await page.evaluate(`(async () => {
      const image = await createImageBitmap(await (await fetch("data:image/png;base64,${png}")).blob());
      const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (Math.abs(data[i] - 217) < 12 && Math.abs(data[i + 1] - 95) < 12 && data[i + 2] < 20) ++count;
      }
      return count;
    })()`),
  );
}

test("trails come back with the section", async () => {
  const page = await opened(section);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.getByRole("button", { name: "Go to the goal" }).click();
  await page.getByText(/Cartesian space: reached, \d+ steps/).waitFor();
  await expect.poll(() => trails(page), { timeout: 20_000 }).toBeGreaterThan(200);
  await page.getByRole("link", { name: "Hold", exact: true }).click();
  await expect.poll(() => trails(page), { timeout: 20_000 }).toBeLessThan(50);
  await page.getByRole("link", { name: "Control", exact: true }).click();
  await expect.poll(() => trails(page), { timeout: 20_000 }).toBeGreaterThan(200);
  await page.context().close();
});

/** A chain whose names are long and hard to compress. */
function longUrdf(joints: number): string {
  const next = random(1);
  const name = (): string => Array.from({ length: 90 }, () => next().toString(36).slice(2, 12)).join("");
  const links = Array.from({ length: joints + 1 }, name);
  const parts = links.map((link, i) => {
    const ends = `<parent link="${links[i - 1] ?? ""}"/><child link="${link}"/><origin xyz="0.1 0 0"/>`;
    const joint = i > 0 ? `<joint name="${name()}" type="continuous">${ends}</joint>` : "";
    return `<link name="${link}"/>${joint}`;
  });
  return `<robot name="long">${parts.join("")}</robot>`;
}

test("a state too long for a link keeps the last address, and the page says so", async () => {
  const next = random(2);
  const pose = (): string => [next(), next(), next(), 1, 0, 0, 0].map((value) => value.toFixed(18)).join(",");
  const waypoints = Array.from({ length: 1000 }, pose).join(";");
  const page = await opened(`#arm=rrr&q=0.1,0.2,0.3&waypoints=${waypoints}`);
  await page.setInputFiles("#arm-file", {
    name: "long.urdf",
    mimeType: "text/xml",
    buffer: Buffer.from(longUrdf(100)),
  });
  const note = page.getByText("This is too long for a link: the address stays as it was. Use Save page.");
  await note.waitFor();
  expect(page.url()).toContain("arm=rrr&q=0.1,0.2,0.3");
  await page.locator("#arm-text").fill("panda");
  await page.getByRole("button", { name: "Show", exact: true }).click();
  await expect.poll(() => page.url(), { timeout: 20_000 }).toContain("arm=panda");
  expect(await note.count()).toBe(0);
  await page.context().close();
});
