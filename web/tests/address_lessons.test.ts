import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { stateOf } from "../src/address/address.js";
import { gainRanges } from "../src/state/page_state.js";
import { jointValues, pages, shownArm } from "./browser.js";

const { opened } = pages();

/** Changes the address of the page, as a hand or the page around it does. */
const turnTo = (page: Page, hash: string): Promise<void> =>
  page.evaluate((address) => {
    location.hash = address;
  }, hash);

test.each([
  ["#arm=puma560&q=0.3,0.5,0.3,0,0,0&section=lessons&lesson=failures", "puma560", [17, 29, 17, 0, 0, 0]],
  ["#section=lessons&lesson=failures&q=0.5,-0.5,0.25", "rrr", [29, -29, 14]],
  ["#section=lessons&lesson=redundant", "RRRR:3,2.5,2,1.5", [52, -46, -40, -34]],
  ["#section=lessons&lesson=waypoints", "rrr", [0, 90, 0]],
])(
  "a motion that is played ends where the address opens another lesson, whose start holds: %s",
  async (hash, arm, q) => {
    const page = await opened("#section=lessons&lesson=joint-control");
    const motion = page.getByRole("group", { name: "Motion" });
    await motion.getByText("0 / 66").waitFor();
    await motion.getByLabel("Speed").selectOption("0.25");
    await motion.getByRole("button", { name: "Play" }).click();
    await motion.getByText("3 / 66").waitFor();
    await turnTo(page, hash);
    await expect.poll(() => shownArm(page)).toBe(arm);
    await expect.poll(async () => (await jointValues(page)).map(Math.round)).toEqual(q);
    await page.waitForTimeout(1000); // a motion that went on would be seen
    expect((await jointValues(page)).map(Math.round)).toEqual(q);
  },
);

test("an unknown lesson is named, and the first one is shown with its arm under its own address", async () => {
  const page = await opened("#section=lessons&lesson=nix");
  await page.getByText("There is no lesson nix: this is lesson 1").waitFor();
  await expect.poll(() => page.url()).toContain("lesson=definitions");
  expect(page.url()).not.toContain("nix");
  await turnTo(page, "#section=lessons&lesson=redundant");
  await expect.poll(() => shownArm(page)).toBe("RRRR:3,2.5,2,1.5");
  await turnTo(page, "#section=lessons&lesson=nox");
  await page.getByText("There is no lesson nox: this is lesson 1").waitFor();
  await expect.poll(() => page.url()).toContain("lesson=definitions");
  await expect.poll(() => shownArm(page)).not.toBe("RRRR:3,2.5,2,1.5");
});

test("an unknown part of a lesson is named, and the lesson is shown without surroundings under its own address", async () => {
  const page = await opened("#section=lessons&lesson=redundant&only=nix", { width: 900, height: 900 });
  await page.getByText("This lesson has no part nix").waitFor();
  await page.getByRole("heading", { name: "A redundant arm" }).waitFor();
  await expect.poll(() => page.url()).toContain("only=lesson");
  expect(await shownArm(page)).toBe("RRRR:3,2.5,2,1.5");
  await turnTo(page, "#section=lessons&lesson=redundant&only=spare");
  await page.getByRole("form", { name: "Exercise" }).waitFor();
  await page.getByText("This lesson has no part").waitFor({ state: "detached" });
});

test("gains of an address are within the ranges of their fields", async () => {
  for (const name of ["gain", "ki", "kd"] as const) {
    const { min, max } = gainRanges[name];
    expect((await stateOf(`#${name}=1e9`))[name]).toBe(max);
    expect((await stateOf(`#${name}=-7`))[name]).toBe(min);
    expect((await stateOf(`#${name}=${(min + max) / 2}`))[name]).toBe((min + max) / 2);
  }
});

test("a goal of an address is within the limits of the joints", async () => {
  const page = await opened("#arm=puma560&section=control&goal=1e9,0,0,0,-1e9,0");
  const goal = (): number[] =>
    (new URLSearchParams(new URL(page.url()).hash.slice(1)).get("goal") ?? "").split(",").map(Number);
  await expect.poll(() => goal().map((value) => Math.round((value * 180) / Math.PI))).toEqual([160, 0, 0, 0, -100, 0]);
  await turnTo(page, "#arm=puma560&section=control&goal=-1e9,0,0,0,0,0");
  await expect.poll(() => goal().map((value) => Math.round((value * 180) / Math.PI))).toEqual([-160, 0, 0, 0, 0, 0]);
});
