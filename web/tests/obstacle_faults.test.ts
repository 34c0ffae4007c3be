import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { addressOf, longestAddress, sceneFault, stateOf } from "../src/address/address.js";
import { compressed } from "../src/address/compression.js";
import { movedBody, poseOfBody, sceneOf, textOf, withKnownPairs, type SceneDocument } from "../src/core/scene.js";
import { guarantee, closestInWords, pairsThatMayTouch, type ClearanceAnswer } from "../src/panels/clearance.js";
import { inWords, type InverseAnswer } from "../src/panels/solutions.js";
import { geometryOf } from "../src/scene/spatial/shape_geometry.js";
import { initialState } from "../src/state/page_state.js";
import { pages } from "./browser.js";
import { json, random } from "./native.js";

const { opened } = pages();
const seed = Number(process.env["BEELINE_SEED"] ?? 20260302);
console.log(`BEELINE_SEED=${seed}`);

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

test("a saved page has no bound on its obstacles; an address whose obstacles are cut off says so", async () => {
  const next = random(seed);
  const vertices = Array.from({ length: 20_000 }, () => [next(), next(), next()]);
  const scene = textOf({ obstacles: [{ name: "rock", shapes: [{ convex_hull: { vertices } }] }] });
  const hash = await addressOf({ ...initialState, scene });
  expect(hash.length).toBeGreaterThan(longestAddress);
  const saved = await stateOf(hash, Infinity);
  expect(saved.scene).toBe(scene);
  expect(sceneFault(hash, saved)).toBe("");
  const cut = await stateOf(hash);
  expect(cut.scene).toBe("");
  expect(sceneFault(hash, cut)).toMatch(/cannot be read/);
  const none = await compressed(new TextEncoder().encode("[]"));
  expect(sceneFault(`#scene=${none}`, await stateOf(`#scene=${none}`))).toMatch(/cannot be read/);
  expect(sceneFault("#arm=panda", await stateOf("#arm=panda"))).toBe("");
});

test("an obstacle of points alone stays in its scene, and its points move with it", () => {
  const cloud = { radius: 0.02, points: [[0.5, 0.1, 0.3]] };
  const text = JSON.stringify({ obstacles: [{ name: "scan", point_cloud: cloud }] });
  const scene = sceneOf(text);
  const [scan] = scene.obstacles;
  expect(scan).toEqual({ name: "scan", shapes: [], point_cloud: cloud });
  expect(textOf(scene)).toBe(text);
  if (!scan) return;
  const to = { xyz: [1, 2, 3], rpy: [0, 0, 0.5] };
  expect(movedBody(scan, to).point_cloud).toEqual({ ...cloud, pose: to });
  const both = { ...scan, shapes: [{ sphere: { radius: 0.1 }, pose: { xyz: [1, 0, 0] } }] };
  const moved = movedBody(both, { xyz: [1, 0, 0.5] });
  expect(poseOfBody({ ...moved, shapes: [] }).slice(12, 15)).toEqual([0, 0, 0.5]);
});

test("pairs without obstacles are kept; pairs of unknown bodies are left out", () => {
  const pairs: [string, string][] = [
    ["link1", "link3"],
    ["link1", "hand"],
  ];
  const scene: SceneDocument = { obstacles: [], allowed_pairs: pairs };
  expect(sceneOf(textOf(scene))).toEqual(scene);
  expect(textOf({ obstacles: [], allowed_pairs: [] })).toBe("");
  const known = withKnownPairs(scene, ["link1", "link3"]);
  expect(known.scene.allowed_pairs).toEqual([["link1", "link3"]]);
  expect(known.left).toEqual([["link1", "hand"]]);
});

test("hulls without a volume are drawn in their own size", () => {
  const point = [0.3, 0.2, 0.1];
  for (const others of [
    [],
    [[0.3, 0.2, 0.4]],
    [
      [0.3, 0.2, 0.4],
      [0.3, 0.3, 0.1],
    ],
    [point, point, point],
  ]) {
    const geometry = geometryOf({ convex_hull: { vertices: [point, ...others] } }, 1);
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox ?? {};
    [point, ...others].forEach((vertex) =>
      vertex.forEach((value, k) => {
        expect(min?.toArray()[k]).toBeLessThan(value + 1e-6);
        expect(max?.toArray()[k]).toBeGreaterThan(value - 1e-6);
      }),
    );
    const size = Math.max(
      ...(max
        ?.clone()
        .sub(min ?? max)
        .toArray() ?? []),
    );
    expect(size).toBeLessThan(others.length === 0 || others.includes(point) ? 0.01 : 0.31);
  }
});

test("pairs, hidden obstacles, clearances and places of the section Obstacles", async () => {
  const scene: SceneDocument = {
    ...crateAt([0.5, 1.5, 0.3]),
    allowed_pairs: [["panda_link0", "hand"]],
    exempted_pairs: [["panda_link5", "panda_link7"]],
  };
  const page = await opened(await hashOf(scene, `section=obstacles&q=${start.join(",")}`));
  const list = page.locator(".obstacles .name");
  const said = page.locator(".panel:not([hidden]) > .refusal");
  const button = (name: string) => page.getByRole("button", { name, exact: true });
  await page.getByLabel("Nearest bodies").getByText("and crate").waitFor();
  await page.getByText(/left out as a body is not there: panda_link0 and hand\.$/).waitFor();
  expect(await said.textContent()).toBe("");

  await button("Remove crate").click();
  expect(await button("Save scene.json").isEnabled()).toBe(true); // the pairs

  await button("Add box").evaluate((node) => [0, 1].forEach(() => (node as unknown as { click(): void }).click()));
  await expect.poll(() => list.allTextContents()).toEqual(["box"]);
  await button("Add sphere").click(); // behind what the second click would have added
  await expect.poll(() => list.allTextContents()).toEqual(["box", "sphere"]);
  await button("box").click();
  await button("Hide box").click();
  await page.locator("#obstacle-name").fill("bin");
  await page.keyboard.press("Enter");
  await expect.poll(() => button("Hide bin").getAttribute("aria-pressed")).toBe("true");
  await button("Remove bin").click();
  await button("Add box").click();
  await button("box").waitFor();
  await button("box").click();
  await page.locator("#obstacle-name").fill("bin");
  await page.keyboard.press("Enter");
  await expect.poll(() => button("Hide bin").getAttribute("aria-pressed")).toBe("false");

  for (const [value, message] of [
    ["0", "A clearance is above 0 m."],
    ["0.02", ""],
  ] as const) {
    await page.locator("#clearance").fill(value);
    await page.keyboard.press("Enter");
    await expect.poll(() => said.textContent()).toBe(message);
  }
  const isFull = async (): Promise<boolean> =>
    (await said.textContent())?.startsWith("No place around the arm") === true;
  for (let count = await list.count(); !(await isFull()); count = await list.count()) {
    await button("Add box").click();
    await expect.poll(async () => (await list.count()) > count || (await isFull())).toBe(true);
    expect(count).toBeLessThan(13);
  }
  expect(await page.getByLabel("Nearest bodies").locator(".over").count()).toBe(0);
});

const robot = `<robot name="two">
  <link name="foot"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="post"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <link name="post"><collision><geometry><mesh filename="post.stl"/></geometry></collision></link>
  <joint name="lift" type="revolute"><parent link="post"/><child link="beam"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <link name="beam"/>
</robot>`;

test("a motion that is not checked against obstacles says why: a missing mesh, an arm in a plane", async () => {
  const page = await opened(await hashOf(crateAt([0.9, 0.9, 0.9]), "section=line"));
  await page.locator("#arm").click();
  const files = { name: "two.urdf", mimeType: "text/xml", buffer: Buffer.from(robot) };
  await page.locator("#arm-file").setInputFiles([files]);
  await page.locator(".arm-name", { hasText: "two" }).waitFor();
  const said = page.locator("section.recording [role=status]");
  const check = async (text: string): Promise<void> => {
    const file = { name: "motion.csv", mimeType: "text/csv", buffer: Buffer.from(text) };
    await page.getByLabel("A trajectory, CSV or JSON").setInputFiles(file);
  };
  await check("t,turn,lift\n0,0,0\n1,0.1,0.1\n");
  await said.getByText(/^Not checked against the obstacles: .*post\.stl/).waitFor();

  const scene = new URL(page.url()).hash.replace(/.*&(scene=[^&]*).*/, "$1");
  await page.goto(`${page.url().replace(/#.*/, "")}#arm=rrr&section=line&${scene}`);
  await page.locator(".arm-name", { hasText: "rrr" }).waitFor();
  await check("t,joint1,joint2,joint3\n0,0,0.5,0.5\n1,0.1,0.6,0.5\n");
  await said.getByText(/^Not checked against the obstacles: this arm moves in a plane/).waitFor();
  await page.goto(`${page.url().replace(/#.*/, "")}#arm=rrr&scene=cutoff`);
  await page.getByText("The obstacles of this address cannot be read").waitFor();
});
