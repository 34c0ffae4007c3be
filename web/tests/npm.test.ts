import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { Arm } from "../npm/arm.js";
import type { Beeline } from "../npm/beeline.js";
import type { Numbers } from "../npm/checks.js";
import type * as Vite from "vite";
import { compile } from "../src/core/load.js";
import { executablePath } from "./browser.js";
import { json, module, run } from "./native.js";
import { refusal } from "./refusal.js";

/** NPM_TRIAL: the package to try, in a project with Vite from npm; otherwise it is packed here, and Vite is the page's. */
const given = process.env["NPM_TRIAL"];
const at = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

interface Computed {
  error?: string;
  arms: { name: string; q: number[]; pose: number[]; jacobian: number[][]; inverse: number[][] | null }[];
  line: { status: string; samples: number; deviation_bound: number };
  positions: number[][];
}

let folder: string;
let beeline: Beeline;
/** What Node computes by import. */
let computed: string;

const npm = (...args: string[]) => execFileSync("npm", [...args, "--no-audit", "--no-fund"], { cwd: folder });
const node = (...args: string[]) => execFileSync("node", args, { cwd: folder, encoding: "utf8" });

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "beeline-npm-"));
  cpSync(at("npm_project"), folder, { recursive: true });
  writeFileSync(join(folder, "package.json"), '{ "private": true, "type": "module" }');
  const packed = given ?? join(folder, "packed");
  if (given === undefined) execFileSync(at("../../scripts/npm.sh"), [module, packed]);
  npm("install", packed.endsWith(".tgz") ? packed : join(packed, `beeline-arms-${version()}.tgz`));
  if (given !== undefined) npm("install", "--save-dev", "vite");
  else symlinkSync(at("../node_modules/vite"), join(folder, "node_modules/vite"));
  beeline = await ((await import(entry())) as { load(): Promise<Beeline> }).load();
  computed = node("module.mjs");
});
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

const version = (): string =>
  /^project\(beeline VERSION ([\d.]+)/m.exec(readFileSync(at("../../CMakeLists.txt"), "utf8"))?.[1] ?? "";
const entry = (): string => pathToFileURL(join(folder, "node_modules/beeline-arms/npm/node.js")).href;

function difference(a: number[], b: number[]): number {
  expect(a.length).toBe(b.length);
  return Math.max(...a.map((value, i) => Math.abs(value - (b[i] ?? NaN))));
}

test("computes as the command does", () => {
  const { arms, line, positions } = JSON.parse(computed) as Computed;
  expect(arms.length).toBeGreaterThan(20);
  for (const { name, q, pose, jacobian, inverse } of arms) {
    const typed = `--q=${q.join(",")}`;
    const fk = json<{ pose: { matrix: number[][] } }>(["fk", name, typed]);
    expect(
      difference(
        pose,
        [0, 1, 2, 3].flatMap((k) => fk.pose.matrix.map((row) => row[k] ?? NaN)),
      ),
    ).toBeLessThan(1e-12);
    const found = json<{ jacobian: number[][]; condition: number | null }>(["jacobian", name, typed, "--task=spatial"]);
    expect(difference(jacobian.flat(), found.jacobian.flat())).toBeLessThan(1e-12);
    if (inverse === null) continue; // of a redundant arm rounding may choose
    const matrix = fk.pose.matrix.flat().join(",");
    const ik = json<{ solutions: number[][] }>(["ik", name, `--pose=${matrix}`, `--seed=${q.join(",")}`]);
    expect(inverse.length, name).toBe(ik.solutions.length);
    const bound = 1e-12 * Math.max(1, found.condition ?? 1);
    inverse.forEach((solution, i) => {
      expect(difference(solution, ik.solutions[i] ?? []), name).toBeLessThan(bound);
    });
  }
  const args = ["line", "rrr", "--from=1.95,-0.9,-1.05", "--through=poses.csv"];
  const expected = json<Computed["line"]>(args, { "poses.csv": "x,y,theta\n4.5,5.2,0\n" });
  expect(line.status).toBe(expected.status);
  expect(line.samples).toBe(expected.samples);
  expect(Math.abs(line.deviation_bound - expected.deviation_bound)).toBeLessThan(1e-9);
  expect(positions.length).toBe(line.samples);
});

test("by import() in CommonJS", () => {
  expect(node("in_commonjs.cjs")).toBe(computed);
});

test.each([
  ["nodenext", "nodenext"],
  ["esnext", "bundler"],
])("types for module %s, resolution %s, without types of browsers and of Node", (kind, resolution) => {
  const tsc = at("../node_modules/.bin/tsc");
  const options = ["--noEmit", "--strict", "--exactOptionalPropertyTypes", "--target", "es2022", "--lib", "es2023"];
  const args = [...options, "--types", "", "--module", kind, "--moduleResolution", resolution, "types.ts"];
  expect(execFileSync(tsc, args, { cwd: folder, encoding: "utf8" })).toBe("");
});

test.each(["../../docs/howto/javascript.md", "../../docs/install.md"])("the session of %s", (page) => {
  const text = readFileSync(at(page), "utf8");
  const block = (language: string): string => new RegExp(`\`\`\`${language}\\n([^]*?)\`\`\``).exec(text)?.[1] ?? "";
  writeFileSync(join(folder, "session.mjs"), block("js"));
  expect(node("session.mjs")).toBe(block("text"));
});

const urdf = `<robot name="one_joint"><link name="a"/><link name="b"/><link name="c"/>
<joint name="turn" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><origin xyz="0 0 0.5"/>
<limit lower="-1" upper="1"/></joint>
<joint name="end" type="fixed"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/></joint></robot>`;

test("arms from texts", async () => {
  const rows = [
    { a: 3.5, theta: 0 },
    { a: 3.5, alpha: 0 },
    { a: 2, type: "revolute" as const, d: 0 },
  ];
  const fromUrdf = beeline.armFromUrdf(urdf);
  const table = beeline.armFromDh("table", rows, "standard");
  const string = beeline.readArm("RRR:3.5,3.5,2");
  const again = beeline.armFromJson(table.toJson());
  const q = [0.5, -0.2, 0.1];
  const poses = [table, string, again].map((arm) => beeline.forwardKinematics(arm, q));
  for (const pose of poses) expect(difference([...pose], [...(poses[0] ?? [])])).toBeLessThan(1e-14);
  const position = [...beeline.forwardKinematics(fromUrdf, [0.5])].slice(12);
  expect(difference(position, [Math.cos(0.5), Math.sin(0.5), 0.5, 1])).toBe(0);
  expect(await beeline.verb("fk", fromUrdf, { q: [0.5] })).toEqual(
    json(["fk", "arm.urdf", "--q=0.5"], { "arm.urdf": urdf }),
  );
  const { solutions } = await beeline.ik(table, poses[0] ?? [], { seed: q });
  expect(difference(solutions[0] ?? [], q)).toBeLessThan(1e-12);
  const tip = beeline.armFromUrdf(urdf, { tip: "b" });
  expect(beeline.linkPoses(tip, [0]).at(-1)?.slice(12)).toEqual(Float64Array.of(0, 0, 0.5, 1));
  expect((await beeline.run(["--version"])).stdout).toBe(run(["--version"]).stdout);
});

test("refuses invalid input with a code and what is accepted", async () => {
  const arm = beeline.readArm("rrr");
  const refusals: [() => unknown, RegExp][] = [
    [() => beeline.readArm("ur55"), /^invalid_arm: unknown arm "ur55"; did you mean "ur5"\?.*RRR:3.5,3.5,2/],
    [() => beeline.readArm("a.urdf", { "folder/a.urdf": "" }), /^invalid_argument: "folder\/a.urdf" is not the name/],
    [() => beeline.readArm("a.urdf", { ".a.urdf": "" }), /^invalid_argument: "\.a\.urdf" .* no leading dot$/],
    [() => beeline.run(["arms"], { "../a.csv": "" }), /^invalid_argument: "\.\.\/a\.csv" is not the name/],
    [() => beeline.armFromUrdf("<robot>"), /^invalid_arm: arm\.urdf:1: /],
    [() => beeline.armFromDh("table", [{ a: NaN }], "standard"), /^invalid_arm: arm\.json.*number/],
    [
      () => beeline.forwardKinematics(arm, [1, 2]),
      /^invalid_argument: q has 2 numbers; rrr has 3 joint values: joint1, /,
    ],
    [
      () => beeline.forwardKinematics(arm, [1, NaN, 2]),
      /^invalid_argument: q\[1\] is NaN; it must be a finite number$/,
    ],
    [
      () => beeline.jacobian(arm, undefined as never),
      /^invalid_argument: q is undefined; it must be a list of 3 joint/,
    ],
    [
      () => beeline.jacobian(arm, [0, 0, 0], { frame: "world" as never }),
      /^invalid_argument: frame is "world"; .*tool/,
    ],
    [() => beeline.inverseKinematics(arm, [1, 2, 0], { seed: [1] }), /^invalid_argument: seed has 1 numbers/],
    [() => beeline.ik(arm, [1, 2, 0], { allSolutions: true }), /^invalid_usage: .*--all-solutions/],
    [() => beeline.ik(arm, [1, 2, 0], { "--all": true }), /^invalid_argument: "--all" is no option; .*camel case/],
    [() => beeline.line(arm, [0, 0, 1], [[1, 2, "x" as never]]), /^invalid_argument: through\[0\]\[2\] is "x"; /],
    [() => beeline.line(arm, [0, 0, 1], 7 as never), /^invalid_argument: through is 7; it must be a list of poses$/],
    [() => beeline.line(arm, [0, 0, 1], []), /^invalid_(file|usage): .*poses/],
    [() => beeline.verb("fly", arm), /^invalid_usage: .*fly/],
  ];
  for (const [work, expected] of refusals) expect(await refusal(work)).toMatch(expected);
});

test("inverseKinematics and ik refuse the same poses with the same code", async () => {
  const [rrr, ur5] = [beeline.readArm("rrr"), beeline.readArm("ur5")];
  const refusals: [Arm, Numbers, RegExp][] = [
    [rrr, [1, 2], /^invalid_argument: pose has 2 numbers; it must be x,y,z/],
    [ur5, [1, 2, 0], /^invalid_argument: pose has 3 numbers/],
    [rrr, [1, 2, 0, 2, 0, 0, 0], /^invalid_argument: pose: the quaternion 2,0,0,0 has length 2/],
    [rrr, new Float64Array(16), /^invalid_argument: .*rigid/],
  ];
  for (const [arm, pose, expected] of refusals) {
    const one = await refusal(() => beeline.inverseKinematics(arm, pose));
    expect(one).toMatch(expected);
    expect(await refusal(() => beeline.ik(arm, pose))).toBe(one);
  }
});

test("a quaternion's length is accepted as the command accepts it", async () => {
  const arm = beeline.readArm("ur5");
  for (const [length, accepted] of [
    [1.0009, true],
    [1.0011, false],
    [0.9991, true],
    [0.9989, false],
  ] as const) {
    const pose = [0.3, 0.2, 0.4, length, 0, 0, 0];
    expect(run(["ik", "ur5", `--pose=${pose.join(",")}`]).code < 2, `${length}`).toBe(accepted);
    expect((await refusal(() => beeline.inverseKinematics(arm, pose))) === "no error", `${length}`).toBe(accepted);
  }
});

test("options of a method's own are not replaced", async () => {
  const arm = beeline.readArm("rrr");
  const options = { out: "other.csv", from: [0, 0, 0], through: "none.csv" };
  const { status, trajectory } = await beeline.line(arm, [1.95, -0.9, -1.05], [[4.5, 5.2, 0]], options);
  expect(status).toBe("reached");
  expect(trajectory?.row(0)).toEqual([1.95, -0.9, -1.05]);
  trajectory?.release();
});

test("a line that is not reached has no duration", async () => {
  const line = await beeline.line(beeline.readArm("rrr"), [1.95, -0.9, -1.05], [[4.5, 9.2, 0]]);
  expect(line.status).not.toBe("reached");
  expect(line.duration).toBeNull();
});

test("a module that cannot be read or compiled has a code", async () => {
  const sources: [() => Promise<Uint8Array<ArrayBuffer> | Response>, RegExp][] = [
    [
      () => Promise.reject(new TypeError("Failed to fetch")),
      /^not_loaded: The core cannot be loaded: Failed to fetch$/,
    ],
    [() => readFile(join(folder, "none.wasm")).then((bytes) => Uint8Array.from(bytes)), /^not_loaded: .*ENOENT/],
    [() => Promise.resolve(Uint8Array.of(1, 2, 3)), /^not_loaded: .*compile/i],
    [() => Promise.resolve(new Response("", { status: 404 })), /^not_loaded: .*404/],
  ];
  for (const [read, expected] of sources) expect(await refusal(() => compile(read()))).toMatch(expected);
});

test("arms and trajectories refuse after release()", async () => {
  const arm = beeline.readArm("rrr");
  const { trajectory } = await beeline.line(arm, [1.95, -0.9, -1.05], [[4.5, 5.2, 0]]);
  trajectory?.release();
  trajectory?.release();
  expect(await refusal(() => trajectory?.at(0))).toBe("released: the trajectory was released");
  arm.release();
  arm.release();
  expect(beeline.forwardKinematics(beeline.readArm("rp"), [0, 0]).length).toBe(16); // the memory is as it was
  expect(await refusal(() => beeline.forwardKinematics(arm, [0, 0, 0]))).toBe("released: the arm was released");
  const later: (() => unknown)[] = [
    () => beeline.ik(arm, [4.5, 5.2, 0]),
    () => beeline.line(arm, [1.95, -0.9, -1.05], [[4.5, 5.2, 0]]),
    () => beeline.verb("fk", arm, { q: [0, 0, 0] }),
  ];
  for (const work of later) expect(await refusal(work)).toBe("released: the arm was released");
});

test("an unreachable pose is an answer with a status", async () => {
  const far = await beeline.ik(beeline.readArm("rrr"), [90, 90, 0]);
  expect([far.status, far.solutions.length, far.code === null]).toEqual(["unreachable", 0, false]);
  expect(far.reason).not.toBe("");
});

/** What a page of the project shows. */
async function shown(address: string): Promise<string> {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  try {
    const page = await browser.newPage();
    await page.goto(address);
    await page.waitForFunction(() => document.body.textContent.startsWith("{"));
    return (await page.textContent("body")) ?? "";
  } finally {
    await browser.close();
  }
}

test("in a project of Vite, built and served while it is written", async () => {
  const path = createRequire(join(folder, "main.js")).resolve("vite");
  const vite = (await import(pathToFileURL(path).href)) as typeof Vite;
  console.log(`Node ${process.version}, Vite ${vite.version}`);
  const options = { root: folder, configFile: false, logLevel: "warn" } as const;
  await vite.build(options);
  const built = await vite.preview({ ...options, preview: { host: "127.0.0.1", port: 0 } });
  const served = await vite.createServer({ ...options, server: { host: "127.0.0.1", port: 0 } });
  try {
    await served.listen();
    for (const { resolvedUrls } of [built, served]) {
      expect(JSON.parse(await shown(resolvedUrls?.local[0] ?? ""))).toEqual(JSON.parse(computed));
    }
  } finally {
    await built.close();
    await served.close();
  }
});
