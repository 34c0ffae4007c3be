import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { stateOf } from "../src/address/address.js";
import { compressed } from "../src/address/compression.js";
import { compile, instantiateCommand } from "../src/core/load.js";
import { movedBody, poseOfShape, roundedPose, type SceneBody, type SceneDocument } from "../src/core/scene.js";
import { SceneModule } from "../src/core/scene_module.js";
import type { NearestPair } from "../src/core/scene.js";
import { axe, drag, frames, ofPixels, pages } from "./browser.js";
import { binaryStl } from "./meshes.js";
import { commandParts, json, random, run } from "./native.js";

const { opened } = pages();
const seed = Number(process.env["BEELINE_SEED"] ?? 20260301);
console.log(`BEELINE_SEED=${seed}`);

const example = (name: string): string =>
  readFileSync(fileURLToPath(new URL(`../../examples/${name}`, import.meta.url)), "utf8");
const crate: SceneDocument = {
  obstacles: [{ name: "crate", shapes: [{ box: { size: [0.15, 0.15, 0.3] }, pose: { xyz: [0.5, 0.1, 0.3] } }] }],
};
const start = [0, -0.5, 0, -2.2, 0, 1.8, 0.8]; // of panda, clear of the crate

async function hashOf(scene: SceneDocument, more: string): Promise<string> {
  return `#arm=panda&scene=${await compressed(new TextEncoder().encode(JSON.stringify(scene)))}&${more}`;
}

const nearest = (page: Page) => page.getByLabel("Nearest bodies").locator("p");
/** The distance to the obstacle `name` in millimetres, as the panel says it. */
async function distanceTo(page: Page, name: string): Promise<number> {
  const text = (await nearest(page).allTextContents()).find((one) => one.includes(name)) ?? "";
  const [, number = "NaN"] = /: ([\d.]+)\u00a0mm/.exec(text) ?? [];
  return text.includes("deep") ? -Number(number) : Number(number);
}

interface Checked {
  clearance: { status: string; pair: [string, string]; lower: number; upper: number };
}

/** What `beeline check` says of the arm at rest: the pair nearest to its clearance. */
function atRest(arm: string, names: string[], q: number[], files: Record<string, string>): Checked["clearance"] {
  const rows = [
    ["t", ...names],
    [0, ...q],
    [1, ...q],
  ]
    .map((row) => row.join(","))
    .join("\n");
  const args = ["check", arm, "rest.csv", "--scene", "scene.json"];
  return json<Checked>(args, { ...files, "rest.csv": `${rows}\n` }).clearance;
}

test("the nearest pair is the command's", async () => {
  const { factory, wasm } = await commandParts();
  const ignore = (): void => undefined;
  const module = new SceneModule(await instantiateCommand(factory, await compile(wasm), ignore, ignore));
  const next = random(seed);
  const cases = [
    { arm: "planar_arm.json", files: { "planar_arm.json": example("planar_arm.json") }, scene: example("cell.json") },
    { arm: "panda", files: {}, scene: JSON.stringify(crate) },
  ];
  let kept = 0;
  for (const { arm, files, scene } of cases) {
    const { joints } = json<{ joints: { name: string; limits: { lower: number | null; upper: number | null } }[] }>(
      ["show", arm],
      files,
    );
    const { bodies } = module.answer({ ask: "arm", arm: { argument: arm, tip: "", files }, clearance: 0 }) as {
      bodies: SceneBody[];
    };
    const text = module.answer({ ask: "read", name: "scene.json", content: scene }) as string;
    expect(module.answer({ ask: "read", name: "scene.json", content: text })).toBe(text);
    const names = [...bodies, ...(JSON.parse(text) as SceneDocument).obstacles].map(({ name }) => name);
    for (let i = 0; i < 10; ++i) {
      const q = joints.map(({ limits }) => {
        const [lower, upper] = [limits.lower ?? -Math.PI, limits.upper ?? Math.PI];
        return lower + (0.1 + 0.8 * next()) * (upper - lower);
      });
      const [first] = module.answer({ ask: "nearest", scene: text, q }) as NearestPair[];
      const said = atRest(
        arm,
        joints.map(({ name }) => name),
        q,
        { ...files, "scene.json": scene },
      );
      expect((first?.lower ?? NaN) >= (first?.clearance ?? NaN)).toBe(said.status === "clear");
      if (said.status !== "clear") continue;
      ++kept;
      expect([names[first?.first ?? -1], names[first?.second ?? -1]]).toEqual(said.pair);
      expect(first?.lower).toBeCloseTo(said.lower, 6);
      expect(Math.hypot(...(first?.onFirst ?? []).map((v, k) => v - (first?.onSecond[k] ?? NaN)))).toBeCloseTo(
        said.upper,
        5,
      );
    }
  }
  expect(kept).toBeGreaterThan(4);
});

test("an obstacle of several shapes moves as one", () => {
  const body: SceneBody = {
    name: "shelf",
    shapes: [
      { box: { size: [1, 1, 0.1] }, pose: { xyz: [1, 2, 3], rpy: [0, 0, 0.5] } },
      { sphere: { radius: 0.1 }, pose: { xyz: [1.3, 2, 3] } },
    ],
  };
  const to = roundedPose(poseOfShape({ pose: { xyz: [0, 0, 1], rpy: [0.3, 0.2, -0.4] } }));
  const moved = movedBody(body, to).shapes.map(poseOfShape);
  const before = body.shapes.map(poseOfShape);
  const between = (poses: number[][]): number =>
    Math.hypot(...[12, 13, 14].map((i) => (poses[0]?.[i] ?? 0) - (poses[1]?.[i] ?? 0)));
  expect(between(moved)).toBeCloseTo(between(before), 12);
  expect(moved[0]?.slice(12, 15)).toEqual([0, 0, 1]);
  const back = movedBody(movedBody(body, to), { xyz: [1, 2, 3], rpy: [0, 0, 0.5] }).shapes.map(poseOfShape);
  back.forEach((pose, k) => pose.forEach((value, i) => expect(value).toBeCloseTo(before[k]?.[i] ?? NaN, 4)));
});

test("a scene from a file is shown; an obstacle is dragged, and the distance follows; what is saved is what --scene reads", async () => {
  const page = await opened(`#arm=panda&section=obstacles&q=${start.join(",")}`);
  const file = { name: "cell.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(crate)) };
  await page.locator("#scene-file").setInputFiles(file);
  await nearest(page).filter({ hasText: "crate" }).waitFor();
  const names = json<{ joints: { name: string }[] }>(["show", "panda"]).joints.map(({ name }) => name);
  const first = await distanceTo(page, "crate");
  const said = atRest("panda", names, start, { "scene.json": JSON.stringify(crate) });
  expect(await nearest(page).first().textContent()).toContain(said.pair.join(" and "));
  await page.getByRole("button", { name: "crate", exact: true }).click();
  expect(await axe(page)).toEqual([]);
  const size = await page.getByLabel("size z").inputValue();
  expect(Number(size)).toBe(0.3);
  // The picture, from above: the crate is dragged in the plane of the screen.
  const box = await page.locator("#stage").boundingBox();
  const at = await crateAt(page);
  await drag(page, at, { x: Math.min(at.x + 120, (box?.x ?? 0) + (box?.width ?? 0) - 20), y: at.y + 30 });
  await expect.poll(() => distanceTo(page, "crate")).not.toBe(first);
  const x = Number(await page.locator("#obstacle-0").inputValue());
  expect(x).not.toBe(0.5);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save scene.json" }).click(),
  ]);
  const saved = readFileSync((await download.path()) ?? "", "utf8");
  const again = JSON.parse(saved) as SceneDocument;
  expect(again.obstacles[0]?.shapes[0]?.pose?.xyz?.[0]).toBeCloseTo(x, 3);
  const distance = await distanceTo(page, "crate");
  const reread = atRest("panda", names, start, { "scene.json": saved });
  if (reread.pair.includes("crate")) expect(1000 * reread.lower).toBeCloseTo(distance, 0);
  else expect(1000 * reread.lower).toBeLessThanOrEqual(distance + 0.1);
  await page.getByRole("button", { name: "Undo" }).click();
  await expect.poll(() => distanceTo(page, "crate")).toBe(first);
  // The picture of a number that is typed.
  await page.locator("#obstacle-0").fill("0.9");
  await page.keyboard.press("Enter");
  await expect.poll(() => distanceTo(page, "crate")).toBeGreaterThan(first);
});

/** A pixel of an obstacle: where the mouse names it. */
async function crateAt(page: Page, name = "crate"): Promise<{ x: number; y: number }> {
  const box = await page.locator("#stage").boundingBox();
  for (let row = 0.75; row > 0.2; row -= 0.08) {
    for (let column = 0.5; column < 0.95; column += 0.08) {
      const at = { x: (box?.x ?? 0) + column * (box?.width ?? 0), y: (box?.y ?? 0) + row * (box?.height ?? 0) };
      await page.mouse.move(at.x, at.y);
      await frames(page, 2);
      if ((await page.locator(".overlay .hint-text").textContent()) === name) return at;
    }
  }
  throw new Error(`the picture shows no ${name}`);
}

test("a point cloud is seen, named where the mouse points at it, and dragged", async () => {
  const row = Array.from({ length: 15 }, (_, i) => 0.04 * (i - 7));
  const points = row.flatMap((y) => row.map((z) => [0.7, y, 0.5 + z]));
  const scan: SceneDocument = { obstacles: [{ name: "scan", shapes: [], point_cloud: { radius: 0.03, points } }] };
  const page = await opened(await hashOf(scan, `section=obstacles&q=${start.join(",")}`));
  await nearest(page).filter({ hasText: "scan" }).waitFor();
  const sandy = (): Promise<number> =>
    ofPixels<number>(
      page,
      `let count = 0;
       for (let i = 0; i < data.length; i += 4) if (data[i] > 1.3 * data[i + 2] && data[i + 1] > 1.1 * data[i + 2]) ++count;
       return count;`,
    );
  await expect.poll(sandy).toBeGreaterThan(2000);
  const seen = await sandy();
  const at = await crateAt(page, "scan");
  const first = await distanceTo(page, "scan");
  await drag(page, at, { x: at.x + 60, y: at.y });
  await expect.poll(() => distanceTo(page, "scan")).not.toBe(first);
  await page.getByRole("button", { name: "Remove scan" }).click();
  await expect.poll(sandy).toBeLessThan(seen / 2); // the arm has such pixels too
});

test("obstacles that are added do not hit the arm, and are kept in the link; one is removed", async () => {
  const page = await opened(`#arm=panda&section=obstacles&q=${start.join(",")}`);
  for (const kind of ["box", "sphere", "cylinder"]) {
    await page.getByRole("button", { name: `Add ${kind}` }).click();
    await nearest(page).filter({ hasText: kind }).waitFor(); // alone it is the nearest obstacle
    expect(await distanceTo(page, kind)).toBeGreaterThan(1);
    await page.getByRole("button", { name: `Remove ${kind}` }).click();
  }
  for (const kind of ["box", "sphere", "cylinder"]) {
    await page.getByRole("button", { name: `Add ${kind}` }).click();
    await page.getByRole("button", { name: kind, exact: true }).waitFor();
  }
  await expect.poll(() => distanceTo(page, "panda_link")).toBeGreaterThan(1);
  expect(await nearest(page).and(page.locator(".over")).count()).toBe(0);
  // The page writes the address some time after a change: one that names a part of the obstacles may stand there before.
  const hash = (): string => new URL(page.url()).hash;
  const kept = async (): Promise<string> => (await stateOf(hash())).scene;
  await expect.poll(kept).toMatch(/box.*sphere.*cylinder/);
  const again = await opened(hash());
  await expect.poll(() => again.locator(".obstacles .name").allTextContents()).toEqual(["box", "sphere", "cylinder"]);
  await again.getByRole("button", { name: "Remove sphere" }).click();
  expect(await again.locator(".obstacles .name").allTextContents()).toEqual(["box", "cylinder"]);
});

const waypoints = "waypoints=0.5,-0.3,0.3,0,1,0,0;0.5,0.4,0.3,0,1,0,0";
const strong = (page: Page) => page.locator(".numbers strong").first();

test("a line through an obstacle is refused with the two bodies named, and proved without it", async () => {
  const page = await opened(await hashOf(crate, `section=line&${waypoints}`));
  await strong(page).getByText("collides").waitFor();
  const said = json<{ code: string; fields: { other_body: string } }>(
    ["line", "panda", "--through=poses.csv", "--scene=scene.json"],
    {
      "poses.csv": "x,y,z,qw,qx,qy,qz\n0.5,-0.3,0.3,0,1,0,0\n0.5,0.4,0.3,0,1,0,0\n",
      "scene.json": JSON.stringify(crate),
    },
  );
  expect(said.fields.other_body).toBe("crate");
  expect(await page.locator(".panel:not([hidden]) .numbers").first().textContent()).toMatch(
    /At [\d.]+ s the bodies panda_link\d and crate (overlap|are [\d.]+\u00a0mm apart) at \(/,
  );
  const far = { obstacles: crate.obstacles.map((body) => movedBody(body, { xyz: [0.5, 1.5, 0.3] })) };
  const other = await opened(await hashOf(far, `section=line&${waypoints}`));
  await other
    .getByText(/Proved: .* of the line, and each of the \d+ pairs of bodies that count keeps at least [\d.]+\u00a0mm/)
    .waitFor();
});

test("solutions that hit an obstacle say so", async () => {
  const q = [0.3, -1, 1.2, 0.5, 0.6, 0];
  const { pose } = json<{ pose: { translation: number[] } }>(["fk", "ur5e", `--q=${q.join(",")}`]);
  const around = [{ sphere: { radius: 0.12 }, pose: { xyz: pose.translation } }]; // the tool: no solution is free
  const page = await opened(
    (await hashOf({ obstacles: [{ name: "ball", shapes: around }] }, `q=${q.join(",")}`)).replace("panda", "ur5e"),
  );
  const solutions = page.getByLabel("Inverse kinematics");
  await solutions.getByText(/^Every solution is blocked; in the first one the bodies \w+ and ball overlap/).waitFor();
  expect(await solutions.locator("li .over").count()).toBe(await solutions.locator("li").count());
});

test("files that are no scenes, planar arms and arms without shapes have their sentence", async () => {
  const page = await opened("#arm=panda&section=obstacles");
  const refused = page.locator(".panel:not([hidden]) > .refusal");
  const give = (text: string, name = "bad.json"): Promise<void> =>
    page.locator("#scene-file").setInputFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
  for (const [text, name] of [
    ['{"obstacles": [{"name": "a", "shapes": [{"box": {"size": [1, 2]}}]}]}', "bad.json"],
    ["{", "bad.json"],
    ['{"obstacles": [], "walls": []}', "bad.json"],
    ["no scene", "bad.scene"],
  ] as const) {
    await give(text, name);
    const folder = { [name]: text };
    const { stderr } = run(["ik", "panda", "--pose=0.5,0,0.5,0,0,0", `--scene=${name}`], folder);
    await expect.poll(() => refused.textContent()).toBe(stderr.replace(/^beeline: /, "").trim());
  }
  await give(JSON.stringify(crate), "good.json");
  await expect.poll(() => refused.textContent()).toBe("");
  const exported = ["(noname)+", "* shelf", 1, "box", "0.2 0.2 0.05", "0.6 0 0.4", "0 0 0 1", "0 0 0 0", ".", ""];
  await give(exported.join("\n"), "moveit.scene");
  await page.getByRole("button", { name: "shelf", exact: true }).waitFor();
  // Dropped where arms are, a scene is a scene.
  await page.goto(page.url().replace("#", "?again#"));
  await page.locator("#arm").click();
  await page.locator("#arm-file").setInputFiles({
    name: "other.json",
    mimeType: "application/json",
    buffer: Buffer.from(JSON.stringify(crate).replaceAll("crate", "bin")),
  });
  await page.getByRole("button", { name: "bin", exact: true }).waitFor();
  const planar = await opened("#arm=rrr&section=obstacles");
  await planar.getByText("This arm moves in a plane.").waitFor();
  expect(await planar.getByRole("button", { name: "Add box" }).isVisible()).toBe(false);
  const bare = await opened("#arm=puma560&section=obstacles");
  await bare.getByText("puma560 has no shapes of its links: nothing is checked").waitFor();
});

const urdf = `<robot name="two">
  <link name="foot"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="post"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <link name="post"><collision><geometry><mesh filename="package://two/meshes/post.stl"/></geometry></collision></link>
  <joint name="lift" type="revolute"><parent link="post"/><child link="beam"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <link name="beam"><collision><origin xyz="0.3 0 0"/><geometry><box size="0.6 0.05 0.05"/></geometry></collision></link>
</robot>`;

test("the shapes of a URDF file are its collision elements, with the meshes that are dropped with it", async () => {
  const page = await opened("#arm=panda&section=obstacles");
  const robot = { name: "two.urdf", mimeType: "text/xml", buffer: Buffer.from(urdf) };
  await page.locator("#arm").click();
  await page.locator("#arm-file").setInputFiles([robot]);
  await page.locator(".panel:not([hidden]) > .refusal").filter({ hasText: "post.stl" }).waitFor(); // it is missing
  await page.locator("#arm").click();
  await page.locator("#arm-file").setInputFiles([{ name: "post.stl", mimeType: "model/stl", buffer: binaryStl() }]);
  await page.keyboard.press("Escape");
  await nearest(page)
    .filter({ hasText: /foot and beam|beam and foot/ })
    .waitFor();
  await page.getByRole("button", { name: "Add box" }).click();
  await nearest(page).filter({ hasText: "and box" }).waitFor();
  await expect.poll(() => page.locator(".panel:not([hidden]) > .refusal").textContent()).toBe("");
});
