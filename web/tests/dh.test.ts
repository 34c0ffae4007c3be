import { afterAll, beforeAll, expect, test } from "vitest";
import { armOfDhTable, type DhTable } from "../src/core/dh_table.js";
import { open, ownFiles, shownArm, visit, type Visit } from "./browser.js";
import { json } from "./native.js";

let there: Visit;
beforeAll(async () => {
  there = await visit();
});
afterAll(() => there.close());

const link = { a: "0", alpha: "0", d: "0", theta: "0", lower: "", upper: "", type: "revolute" as const };
const puma: DhTable = {
  name: "puma",
  convention: "standard",
  degrees: true,
  rows: [
    { ...link, alpha: "90", lower: "-160", upper: "160" },
    { ...link, a: "0.4318" },
    { ...link, a: "0.0203", alpha: "-90", d: "0.15005" },
    { ...link, alpha: "pi/2", d: "0.4318" },
    { ...link, alpha: "−90" },
    link,
  ],
};

function fk(table: DhTable, q: string): number[] {
  const arm = armOfDhTable(table);
  const { pose } = json<{ pose: { matrix: number[][] } }>(["fk", "arm.json", `--q=${q}`], { "arm.json": arm });
  return pose.matrix.flat();
}

test("a table's arm equals the native command's: puma560", () => {
  const q = "0.1,0.2,-0.3,0.4,0.5,-0.6";
  const { pose } = json<{ pose: { matrix: number[][] } }>(["fk", "puma560", `--q=${q}`]);
  fk(puma, q).forEach((value, i) => expect(value).toBeCloseTo(pose.matrix.flat()[i] as number, 12));
  const radians = { ...puma, degrees: false, rows: puma.rows.map((row) => ({ ...row })) };
  for (const row of radians.rows) {
    row.alpha = row.alpha.replace("−90", "-pi/2").replace(/^(-?)90$/, "$1π/2");
    row.lower = row.upper = "";
  }
  fk(radians, q).forEach((value, i) => expect(value).toBeCloseTo(pose.matrix.flat()[i] as number, 12));
});

test("a modified table with a slide and an offset, by its formula", () => {
  const rows = [
    { ...link, theta: "30", d: "0.2" },
    { ...link, type: "prismatic" as const, a: "0.5", alpha: "90", d: "0.1" },
  ];
  const [r11, , , x, , , , y, , , , z] = fk({ name: "m", convention: "modified", degrees: true, rows }, "0,0.3");
  const turn = Math.PI / 6; // Rz(30°) Tz(0.2) Tx(0.5) Rx(90°) Tz(0.1 + 0.3)
  expect(r11).toBeCloseTo(Math.cos(turn), 12);
  expect(x).toBeCloseTo(0.5 * Math.cos(turn) + 0.4 * Math.sin(turn), 12);
  expect(y).toBeCloseTo(0.5 * Math.sin(turn) - 0.4 * Math.cos(turn), 12);
  expect(z).toBeCloseTo(0.2, 12);
});

test.each([
  [{ a: "1,5" }, 'Row 2, a: "1,5" is not a number.'],
  [{ alpha: "" }, "Row 2, alpha: a number is missing."],
  [{ d: "pi" }, 'Row 2, d: "pi" is an angle; metres are expected.'],
  [{ theta: "1e999" }, 'Row 2, theta: "1e999" is not a number.'],
  [{ lower: "2", upper: "1" }, "Row 2, upper: it is below the lower limit."],
  [{ upper: "x" }, 'Row 2, upper: "x" is not a number.'],
])("the cell of a fault is named: %o", (change, message) => {
  const rows = [link, { ...link, ...change }];
  expect(() => armOfDhTable({ ...puma, rows })).toThrow(message);
});

test("a table is typed, its faults are named, and its arm moves as the native command says", async () => {
  const { page, complaints } = await open(there);
  await ownFiles(page);
  await page.getByText("A DH table").click();
  const cell = (row: number, name: string) => page.getByLabel(`row ${row}, ${name}`, { exact: true });
  await page.getByRole("button", { name: "Show the arm" }).click();
  const fault = page.locator("#dh-fault");
  expect(await fault.textContent()).toContain("convention");
  await page.getByLabel("modified:").check();
  await cell(1, "d, metres").fill("0.3");
  await cell(2, "alpha").fill("ninety");
  await page.getByRole("button", { name: "Show the arm" }).click();
  expect(await fault.textContent()).toBe('Row 2, alpha: "ninety" is not a number.');
  expect(await cell(2, "alpha").evaluate((input) => input === input.ownerDocument.activeElement)).toBe(true);
  await cell(2, "alpha").fill("-90");
  await cell(2, "theta, offset").fill("45");
  await cell(2, "lower limit").fill("-100");
  await cell(2, "upper limit").fill("100");
  await page.getByRole("button", { name: "Add a joint" }).click();
  await cell(4, "type").selectOption("prismatic");
  await cell(4, "alpha").fill("pi/2");
  await cell(3, "a, metres").fill("0.4");
  await page.getByRole("button", { name: "remove row 3" }).click();
  await cell(3, "a, metres").fill("0.25");
  await page.locator("#dh-name").fill("typed");
  await page.getByRole("button", { name: "Show the arm" }).click();
  await expect.poll(() => shownArm(page)).toBe("typed");
  expect(await page.locator(".joints .joint").count()).toBe(3);
  expect(await page.locator("#joint-1").getAttribute("max")).toMatch(/^100(\.0+1?)?$|^99\.9/);
  for (const [i, value] of ["20", "-30", "0.2"].entries()) {
    await page.locator(`#joint-${i}`).fill(value);
    await page.locator(`#joint-${i}`).press("Enter");
  }
  const arm = {
    name: "typed",
    dh: {
      convention: "modified",
      rows: [
        { d: 0.3 },
        { alpha: -Math.PI / 2, theta: Math.PI / 4, limits: { lower: -1.8, upper: 1.8 } },
        { type: "prismatic", a: 0.25, alpha: Math.PI / 2 },
      ],
    },
  };
  const native = json<{ pose: { translation: number[] } }>(["fk", "arm.json", "--q=20,-30,0.2", "--degrees"], {
    "arm.json": JSON.stringify(arm),
  });
  const panel = page.getByLabel("Pose of the tool");
  for (const [i, name] of ["x", "y", "z"].entries()) {
    await expect
      .poll(async () => Number(await panel.getByLabel(name, { exact: true }).inputValue()))
      .toBeCloseTo(native.pose.translation[i] as number, 4);
  }
  await ownFiles(page);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save as JSON" }).click(),
  ]);
  expect(download.suggestedFilename()).toBe("arm.json");
  expect(complaints).toEqual({ errors: [], requests: [] });
  await page.context().close();
});
