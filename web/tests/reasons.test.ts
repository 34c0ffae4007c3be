import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";
import { inPageWords, reasonInWords } from "../src/panels/reasons/reasons.js";
import { pages } from "./browser.js";
import { json, run } from "./native.js";

const { opened } = pages();

/** What the page does not ask for: starts outside limits, searches with a budget, programs, batches, servo, mounts. */
const elsewhere = [
  /^none$/,
  /^ended/,
  /^excess_rises$/,
  /^program_|^passes_without_rest$|^dwell_too_short$|^tool_too_fast$/,
  /^poses_|^no_mount_/,
  /^singular_velocity$|^too_few_joints$/,
];

/** The codes of beeline/reason.h. */
function codes(): string[] {
  const header = readFileSync(fileURLToPath(new URL("../../beeline/reason.h", import.meta.url)), "utf8");
  const body = /enum class ReasonCode \{([\s\S]*?)\n\};/.exec(header)?.[1] ?? "";
  return [...body.replace(/\/\/.*$/gm, "").matchAll(/[a-z_]+/g)].map(([name]) => name);
}

test("the page has words for each reason that it can meet", () => {
  const wording = { degrees: true, planar: false };
  const all = codes();
  expect(all.length).toBeGreaterThan(70);
  const without = all.filter(
    (code) => inPageWords({ reason: "as the command says it", code, fields: {} }, wording) === null,
  );
  expect(without.filter((code) => !elsewhere.some((pattern) => pattern.test(code)))).toEqual([]);
});

test("small numbers are not rounded to nothing, and a limit that is passed by little has the excess", () => {
  const said = (code: string, fields: object, degrees = true): string =>
    reasonInWords({ reason: "", code, fields: fields as Record<string, number> }, { degrees, planar: false });
  const off = { time: 1.5, distance: 2e-5, angle: 1e-5 };
  expect(said("off_path", off)).toBe("At 1.50 s the tool is off the line by 20 µm and 0.00057°.");
  expect(said("off_path", off, false)).toBe("At 1.50 s the tool is off the line by 20 µm and 10 µrad.");
  const passed = { joint: "elbow", unit: "rad", value: Math.PI / 2 + 1e-5, lower: -Math.PI / 2, upper: Math.PI / 2 };
  expect(said("outside_limits", { ...passed, time: 0 })).toBe(
    "At 0.00 s elbow is at 90.0°, outside its limits, −90.0° to 90.0°, by 0.00057°.",
  );
  expect(said("goal_outside_limits", { ...passed, value: 3 }, false)).toBe(
    "At the goal elbow is at 3.000 rad, outside its limits, −1.571 rad to 1.571 rad.",
  );
});

interface Inverse {
  code: string;
  fields: { joint: string; value: number; limit: number };
}

test("a pose that is typed and not reached has its reason in the page's words and units", async () => {
  const rest = [0, 0.2, 0, 1.2, 0]; // y z roll pitch yaw
  const there = json<{ solutions: number[][] }>(["ik", "kr6_r900", `--pose=0.5,${rest.join(",")}`]).solutions[0];
  const asked = run(["ik", "kr6_r900", `--pose=0.2,${rest.join(",")}`, `--seed=${there?.join(",")}`, "--json"]).stdout;
  const { code, fields } = JSON.parse(asked) as Inverse;
  expect(code).toBe("all_solutions_outside_limits");
  for (const degrees of [true, false]) {
    const page = await opened(`#arm=kr6_r900&q=${there?.join(",")}${degrees ? "" : "&unit=rad"}`);
    await page.getByLabel("Pose of the tool").getByLabel("x", { exact: true }).fill("0.2");
    await page.keyboard.press("Enter");
    const shown = (value: number): string =>
      (degrees ? `${((value * 180) / Math.PI).toFixed(1)}°` : `${value.toFixed(3)} rad`).replace("-", "−");
    const which = fields.value < fields.limit ? "below its lower" : "above its upper";
    const words =
      "Every solution is outside the joint limits; in the nearest one " +
      `${fields.joint} would be at ${shown(fields.value)}, ${which} limit, ${shown(fields.limit)}.`;
    await page.getByLabel("Inverse kinematics").getByText(words, { exact: true }).waitFor();
    await page.locator(".callout").getByText(words, { exact: true }).waitFor(); // beside the tool too
  }
});
