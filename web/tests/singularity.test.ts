import { expect, test } from "vitest";
import { singularity } from "../src/core/singularity.js";
import { singularInWords } from "../src/panels/jacobian.js";
import { pages } from "./browser.js";
import { loadCore, random } from "./native.js";

const seed = Number(process.env["BEELINE_SEED"] ?? 20240229);
console.log(`BEELINE_SEED=${seed}`);
const next = random(seed);
const core = await loadCore();
const { opened } = pages();
const degree = Math.PI / 180;

/** What is said of an arm at joint values, degrees or metres. */
function said(name: string, values: number[], toRadians = degree): string {
  const arm = core.arm(name);
  const words = singularInWords(
    singularity(
      arm,
      values.map((value) => value * toRadians),
    ),
    arm.planar,
    true,
  );
  arm.release();
  return words;
}

test("no joint moves the tool in a lost direction, and one direction is named only where one is lost", () => {
  const wrist = (q: number[]): number[] => q.map((value, k) => (k === 4 ? 0 : value));
  for (const [name, singular] of [
    ["rrr", (q: number[]) => [q[0] ?? 0, 0, q[2] ?? 0]],
    ["rrr", (q: number[]) => [q[0] ?? 0, Math.PI, q[2] ?? 0]],
    ["puma560", wrist],
    ["ur5", wrist],
  ] as const) {
    const arm = core.arm(name);
    for (let trial = 0; trial < 30; ++trial) {
      const random = Array.from({ length: arm.dof }, () => 0.4 + next());
      expect(singularity(arm, random).is).not.toBe("at");
      const q = singular(random);
      const found = singularity(arm, q);
      expect([name, found.is, found.full - found.rank]).toEqual([name, "at", 1]);
      expect(found.lost).not.toBeNull();
      const { linear, angular } = found.lost ?? {};
      const jacobian = arm.jacobian(q);
      const rates = (axis: number[] | null | undefined, row: number): number[] =>
        Array.from({ length: arm.dof }, (_, k) =>
          (axis ?? []).reduce((sum, value, i) => sum + value * (jacobian[6 * k + row + i] ?? 0), 0),
        );
      const [along, about] = [rates(linear, 0), rates(angular, 3)];
      // u_v . v + c u_w . w is 0 for all joints, with one c: both rows are parallel
      const dot = (a: number[], b: number[]): number => a.reduce((sum, value, k) => sum + value * (b[k] ?? 0), 0);
      const cross = dot(along, along) * dot(about, about) - dot(along, about) ** 2;
      expect(Math.abs(cross)).toBeLessThan(1e-9);
      expect(said(name, q, 1)).toMatch(/^ At a singularity: the tool cannot /);
    }
    arm.release();
  }
});

test("planar arms name the angle of the lost direction; where two are lost none is named", () => {
  expect(said("rrr", [65.9, 0, 0])).toBe(" At a singularity: the tool cannot move along 65.9°.");
  expect(said("rrr", [65.9, 0, 40])).toBe(
    " At a singularity: the tool cannot move along 65.9° without turning, and cannot turn in place.",
  );
  expect(said("rrr", [65.9, 0.01, 0])).toBe(
    " Near a singularity: the tool needs very fast joints to move along 65.9°.",
  );
  expect(said("rrr", [65.9, 60, 0])).toBe("");
  expect(said("RRR:0,0,1", [10, 20, 30])).toBe(
    " At a singularity: the velocities of the tool have 1 dimension, and 3 away from singularities.",
  );
});

test("the Pose panel says at a singularity, and near one", async () => {
  const page = await opened(`#arm=rrr&section=pose&q=${65.9 * degree},0,0`);
  await page.getByText("At a singularity: the tool cannot move along 65.9°.").waitFor();
  await page.locator("#joint-1").fill("0.1");
  await page.keyboard.press("Enter");
  await page.getByText("Near a singularity: ").waitFor();
  await page.locator("#joint-1").fill("60");
  await page.keyboard.press("Enter");
  await page.getByText("singularity").waitFor({ state: "hidden" });
});
