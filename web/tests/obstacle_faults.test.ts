import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { compressed } from "../src/address/compression.js";
import type { SceneDocument } from "../src/core/scene.js";
import { guarantee, closestInWords, pairsThatMayTouch, type ClearanceAnswer } from "../src/panels/clearance.js";
import { inWords, type InverseAnswer } from "../src/panels/solutions.js";
import { pages } from "./browser.js";
import { json } from "./native.js";

const { opened } = pages();

const names = [1, 2, 3, 4, 5, 6, 7].map((i) => `panda_joint${i}`);
const start = [0, -0.5, 0, -2.2, 0, 1.8, 0.8]; // of panda
const crateAt = (xyz: number[]): SceneDocument => ({
  obstacles: [{ name: "crate", shapes: [{ box: { size: [0.15, 0.15, 0.3] }, pose: { xyz } }] }],
});

async function hashOf(scene: SceneDocument, more: string): Promise<string> {
  return `#arm=panda&scene=${await compressed(new TextEncoder().encode(JSON.stringify(scene)))}&${more}`;
}

async function turnTo(page: Page, section: string): Promise<void> {
  await page.locator("#sections a", { hasText: section }).click();
}

/** Types the position of the crate in the section Obstacles. */
async function moveCrate(page: Page, xyz: number[]): Promise<void> {
  await turnTo(page, "Obstacles");
  await page.getByRole("button", { name: "crate", exact: true }).click();
  for (const [i, value] of xyz.entries()) {
    await page.locator(`#obstacle-${i}`).fill(value.toFixed(4));
    await page.keyboard.press("Enter");
  }
}

test("a recording and the solutions of a pose are checked again where obstacles have moved", async () => {
  const page = await opened(await hashOf(crateAt([0.5, 1.5, 0.3]), `section=line&q=${start.join(",")}`));
  await page.emulateMedia({ reducedMotion: "reduce" }); // the recording is not played
  const rows = [
    ["t", ...names],
    [0, ...start],
    [3, 0.5, ...start.slice(1)],
  ].map((row) => `${row.join(",")}\n`);
  const file = { name: "motion.csv", mimeType: "text/csv", buffer: Buffer.from(rows.join("")) };
  const said = page.locator("section.recording [role=status]");
  await page.getByLabel("A trajectory, CSV or JSON").setInputFiles(file);
  await said.getByText(/^Proved: at every time each of the \d+ pairs of bodies that count keeps/).waitFor();
  await said.getByText("Pairs that may touch").click();
  await said.getByText(/^At a joint: panda_link0 and panda_link1, /).waitFor();

  const { pose } = json<{ pose: { translation: number[] } }>(["fk", "panda", `--q=${start.join(",")}`]);
  await moveCrate(page, pose.translation);
  await turnTo(page, "Line");
  await said.locator("strong", { hasText: "collides" }).waitFor();
  expect(await said.getByText("Proved").count()).toBe(0);
  await moveCrate(page, [0.5, 1.5, 0.3]);
  await turnTo(page, "Line");
  await said.getByText(/^Proved: /).waitFor();
  expect(await said.locator("strong").textContent()).not.toContain("collides");

  await turnTo(page, "Pose");
  const solutions = page.getByLabel("Inverse kinematics");
  await solutions.getByText(/^Infinitely many solutions/).waitFor();
  await moveCrate(page, pose.translation);
  await turnTo(page, "Pose");
  await solutions.getByText(/^Every solution that was found is blocked|^Every solution is blocked/).waitFor();
});

test("solutions are all that exist only where nothing is blocked", () => {
  const found: InverseAnswer = {
    status: "found",
    solutions: [[0], [1]],
    singular: false,
    complete: true,
    self_motion_dimension: 0,
    method: "analytical",
    reason: "",
    code: null,
    fields: {},
  };
  const wording = { degrees: true, planar: false };
  expect(inWords(found, wording)).toContain("2 solutions, all that exist");
  const blocked = [{ reason: "", code: null, fields: {}, q: [2] }];
  expect(inWords({ ...found, blocked }, wording)).toBe("2 solutions, by analytical. 1 more is blocked.");
});

test("a proof names what it counts, and what it leaves out", () => {
  const answer: ClearanceAnswer = {
    least_distance: 0.0123,
    pair: ["a", "b"],
    lower: 0.0123,
    time: 1,
    links_without_shapes: [],
    nothing_checked: false,
    pairs: 11,
    allowed_pairs: [["a", "c"]],
    exempted_pairs: [["a", "d"]],
    srdf_pairs: [],
    neighbour_pairs: [
      ["a", "e"],
      ["e", "f"],
    ],
  };
  expect(guarantee(answer)).toBe("each of the 11 pairs of bodies that count keeps at least 12.3\u00a0mm");
  expect(guarantee({ ...answer, pairs: 1 })).toMatch(/^the pair of bodies that counts keeps/);
  expect(guarantee({ ...answer, pairs: 0 })).toBe("no pair of bodies meets within the joint limits");
  expect(guarantee({ ...answer, pairs: 0, nothing_checked: true })).toBe("");
  expect(closestInWords({ ...answer, nothing_checked: true })).toMatch(/^Nothing was checked/);
  expect(pairsThatMayTouch(answer)).toEqual([
    "By the scene: a and c.",
    "By the scene’s matrix: a and d.",
    "At a joint: a and e, e and f.",
  ]);
});
