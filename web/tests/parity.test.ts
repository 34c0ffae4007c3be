import { beforeAll, describe, expect, test } from "vitest";
import type { Arm } from "../src/core/arm.js";
import type { Commands } from "../src/core/commands.js";
import type { Core } from "../src/core/core.js";
import type { Frame } from "../src/core/types.js";
import { json, loadCommands, loadCore, random, run } from "./native.js";

const seed = Number(process.env["BEELINE_SEED"] ?? 20240229);
console.log(`BEELINE_SEED=${seed}`);
const cases = Number(process.env["BEELINE_CASES"] ?? 1);

interface Description {
  joints: { limits: { lower: number | null; upper: number | null } }[];
}
interface Pose {
  matrix: number[][];
  translation: number[];
  quaternion: Record<"qw" | "qx" | "qy" | "qz", number>;
  planar?: { x: number; y: number; theta: number };
}
interface Fk {
  pose: Pose;
  links: Pose[];
}
interface Jacobian {
  rows: string[];
  jacobian: number[][];
  singular_values: number[];
  manipulability: number;
  condition: number | null;
}
interface Ik {
  status: string;
  solutions: number[][];
  residual: number;
  complete: boolean;
  nearest: unknown;
}

const names = json<{ arms: { name: string }[] }>(["arms"]).arms.map((arm) => arm.name);
const random_ = random(seed);

let core: Core;
let commands: Commands;
beforeAll(async () => {
  core = await loadCore();
  commands = await loadCommands();
});

/** The angles of q within half a turn of the angles of `near`: half a turn from the seed, rounding chooses the turn, and of
 * two solutions at one distance from it the order. */
function sameTurn(q: number[], near: number[]): number[] {
  const turn = 2 * Math.PI;
  return q.map((value, k) => value - turn * Math.round((value - (near[k] ?? 0)) / turn));
}

/** Joint values within the limits, and within a turn where there are none. */
function configuration(description: Description, dof: number): number[] {
  return description.joints.slice(0, dof).map(({ limits }) => {
    const lower = limits?.lower ?? -Math.PI;
    const upper = limits?.upper ?? Math.PI;
    return lower + (upper - lower) * random_();
  });
}

function largestDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  expect(a.length).toBe(b.length);
  let largest = 0;
  for (let i = 0; i < a.length; ++i) largest = Math.max(largest, Math.abs((a[i] ?? NaN) - (b[i] ?? NaN)));
  return largest;
}

const columnMajor = (rows: number[][]): number[] => (rows[0] ?? []).flatMap((_, k) => rows.map((row) => row[k] ?? NaN));
const typed = (q: ArrayLike<number>): string => Array.from(q, String).join(",");

function poseText({ translation, quaternion: r, planar }: Pose): string {
  return planar ? typed([planar.x, planar.y, planar.theta]) : typed([...translation, r.qw, r.qx, r.qy, r.qz]);
}

async function withArm(name: string, work: (arm: Arm, description: Description) => Promise<void>): Promise<void> {
  const arm = core.arm(name);
  try {
    await work(arm, arm.description as Description);
  } finally {
    arm.release();
  }
}

describe.each(names)("%s", (name) => {
  test("forward kinematics of all links", async () => {
    await withArm(name, async (arm, description) => {
      for (let i = 0; i < 4 * cases; ++i) {
        const q = configuration(description, arm.dof);
        const expected = json<Fk>(["fk", name, `--q=${typed(q)}`, "--all"]);
        const poses = arm.forward(q);
        const all = [...expected.links, expected.pose];
        expect(poses.length).toBe(all.length);
        all.forEach(({ matrix }, k) => {
          expect(largestDifference(poses[k] ?? [], columnMajor(matrix))).toBeLessThan(1e-12);
        });
      }
    });
  });

  test("Jacobian in each frame, manipulability", async () => {
    await withArm(name, async (arm, description) => {
      for (let i = 0; i < 2 * cases; ++i) {
        const q = configuration(description, arm.dof);
        for (const frame of ["base", "tool", "space"] as Frame[]) {
          const expected = json<Jacobian>(["jacobian", name, `--q=${typed(q)}`, "--frame", frame, "--task", "spatial"]);
          expect(expected.rows.length).toBe(6);
          expect(largestDifference(arm.jacobian(q, frame), columnMajor(expected.jacobian))).toBeLessThan(1e-12);
        }
        const expected = json<Jacobian>(["jacobian", name, `--q=${typed(q)}`]);
        const found = arm.manipulability(q);
        expect(Math.abs(found.manipulability - expected.manipulability)).toBeLessThan(1e-12);
        expect(largestDifference(found.singularValues, expected.singular_values)).toBeLessThan(1e-12);
      }
    });
  });

  test("inverse kinematics: statuses, counts, solutions, residuals", async () => {
    await withArm(name, async (arm, description) => {
      for (let i = 0; i < 2 * cases; ++i) {
        const q = configuration(description, arm.dof);
        const { pose } = json<Fk>(["fk", name, `--q=${typed(q)}`]);
        const { condition } = json<Jacobian>(["jacobian", name, `--q=${typed(q)}`]);
        const tolerance = 1e-12 * Math.max(1, condition ?? Infinity);
        const args = ["ik", name, `--pose=${poseText(pose)}`, `--seed=${typed(q)}`];
        for (const all of [[], ["--all"]]) {
          const expected = json<Ik>([...args, ...all]);
          const found = await commands.json<Ik>([...args, ...all]);
          expect(found.status).toBe(expected.status);
          // Where a self-motion ends, rounding decides whether its last sample counts.
          const ends = arm.dof > 6 ? 2 : 0;
          expect(Math.abs(found.solutions.length - expected.solutions.length)).toBeLessThanOrEqual(ends);
          expect(found.residual).toBeLessThan(1e-10);
          const missing = expected.solutions.filter((solution) => {
            const at = arm.manipulability(solution).condition;
            // The arm with its redundant joint locked can be next to a singularity where the whole arm is not.
            const bound = arm.dof > 6 ? 1e-2 : Math.max(tolerance, 1e-12 * at);
            const distances = found.solutions.map((other) => largestDifference(sameTurn(other, solution), solution));
            return !(Math.min(...distances) < bound);
          });
          expect(missing.length).toBeLessThanOrEqual(ends);
          for (const solution of found.solutions) {
            expect(largestDifference(arm.forward(solution).at(-1) ?? [], columnMajor(pose.matrix))).toBeLessThan(1e-9);
          }
        }
        const hot = arm.inverse(arm.forward(q).at(-1) ?? [], q);
        expect(hot.length).toBe(1);
        expect(largestDifference(arm.forward(hot[0] ?? []).at(-1) ?? [], columnMajor(pose.matrix))).toBeLessThan(1e-9);
      }
    });
  });

  test("a pose out of reach has the same status and reason", async () => {
    const args = [
      "ik",
      name,
      name === "rrr" || name === "rp" || name === "gantry" ? "--pose=90,90,0" : "--pose=9,9,9,0,0,0",
    ];
    const expected = json<Ik & { reason: string }>(args);
    const found = await commands.json<Ik & { reason: string }>(args);
    expect(found.status).toBe(expected.status);
    expect(found.reason).toBe(expected.reason);
  });
});

test("a certified line has its bound", async () => {
  const files = { "poses.csv": "x,y,theta\n4.5,5.2,0\n5.6,2,-1.3\n" };
  const args = ["line", "rrr", "--from=1.95,-0.9,-1.05", "--through", "poses.csv", "--out", "line.csv"];
  interface Line {
    status: string;
    deviation_bound: unknown;
    samples: number;
    duration: number;
  }
  const expected = json<Line>(args, files);
  const result = await commands.run([...args, "--json"], files);
  const found = JSON.parse(result.stdout) as Line;
  expect(found.status).toBe(expected.status);
  expect(found.status).toBe("reached");
  expect(found.samples).toBe(expected.samples);
  expect(JSON.stringify(found.deviation_bound)).toMatch(/\d/);
  const numbers = (value: unknown): number[] => (JSON.stringify(value).match(/-?[\d.]+(e-?\d+)?/g) ?? []).map(Number);
  expect(largestDifference(numbers(found.deviation_bound), numbers(expected.deviation_bound))).toBeLessThan(1e-9);
  const checked = await commands.run(["check", "rrr", "line.csv", "--through", "poses.csv", "--json"], {
    ...files,
    "line.csv": result.files["line.csv"] ?? "",
  });
  expect(checked.code).toBe(0);
});

test("formulas and drawings equal the command line's", async () => {
  for (const args of [
    ["formula", "rrr"],
    ["formula", "rp"],
    ["show", "panda"],
    ["figure", "--help"],
  ]) {
    const expected = run(args);
    const found = await commands.run(args);
    expect(found.code).toBe(expected.code);
    expect(found.stdout).toBe(expected.stdout);
  }
  const drawn = await commands.run(["draw", "rrr", "--q=1.9,-0.9,-1", "--out", "arm.svg"]);
  expect(drawn.stderr).toBe("");
  expect(drawn.files["arm.svg"]).toContain("<svg");
});

test("what is refused is refused in the command line's words", async () => {
  for (const args of [
    ["fk", "rr"],
    ["fk", "pandaa", "--q=1"],
    ["fk", "panda", "--q=1,2"],
    ["show", "no.urdf"],
  ]) {
    const expected = run(args);
    const found = await commands.run(args);
    expect(found.code).toBe(expected.code);
    expect(found.stderr).toBe(expected.stderr);
    expect(`beeline: ${found.refusal}\n`).toBe(expected.stderr);
    await expect(commands.json(args)).rejects.toThrow(found.refusal.split(" (see")[0]);
  }
  expect((await commands.run(["show", "rrr"])).refusal).toBe("");
  const none = await commands.run([]);
  expect(none.code).toBe(run([]).code);
  expect(none.stderr).toBe(run([]).stderr);
  const truncated = { "arm.urdf": "<robot name='a'><link name='b'>" };
  const refused = await commands.run(["show", "arm.urdf"], truncated);
  expect(refused.stderr).toBe(run(["show", "arm.urdf"], truncated).stderr);
  expect(() => core.arm("arm.urdf", truncated)).toThrow(refused.refusal);
});

test("a second command does not see the first one's options", async () => {
  const all = await commands.run(["fk", "rrr", "--q=0,0,0", "--all"]);
  const one = await commands.run(["fk", "rrr", "--q=0,0,0"]);
  expect(one.stdout.length).toBeLessThan(all.stdout.length);
});

test("invalid joint values and handles give messages", async () => {
  const arm = core.arm("rrr");
  expect(() => arm.forward([0, 0])).toThrow("3 joint values");
  expect(() => arm.forward([0, 0, NaN])).toThrow();
  expect(arm.pid({ kp: 1 }, [0, 0, 0], [1, 2, 3], 1)[0]).toEqual(Float64Array.of(1, 2, 3));
  expect(() => arm.pid({ kp: -1 }, [0, 0, 0], [1, 2, 3], 1)).toThrow();
  arm.release();
  expect(() => arm.forward([0, 0, 0])).toThrow("released");
});

test("arms come in by every way, and go out as the command line writes them", () => {
  const dh = { "my.json": '{"name":"my","dh":{"convention":"standard","rows":[{"a":1,"alpha":0,"d":0.5,"theta":0}]}}' };
  const ways: [string, Record<string, string>][] = [
    ["panda", {}],
    ["RRP:1,0.8,0", {}],
    ["my.json", dh],
  ];
  for (const [name, files] of ways) {
    const outcome = run(["show", name, "--out", "out.json"], files);
    const arm = core.arm(name, files);
    expect(outcome.code, outcome.stderr).toBe(0);
    const written = JSON.parse(`${outcome.files["out.json"]}`) as Record<string, unknown>;
    delete written["shapes"]; // which the page reads by another function
    expect(JSON.parse(arm.json)).toEqual(written);
    const document = json<Record<string, unknown>>(["show", name], files);
    for (const key of ["units", "maker", "model", "source", "note", "shapes_source"]) delete document[key];
    expect(arm.description).toEqual(document);
    const again = core.arm("again.json", { "again.json": arm.json });
    expect(again.json).toBe(arm.json);
    arm.release();
    again.release();
  }
  expect(core.builtInNames()).toEqual(names);
});
