import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { beforeAll, expect, test } from "vitest";
import type { Arm } from "../npm/arm.js";
import { Beeline } from "../npm/beeline.js";
import { poseNumbers } from "../npm/values.js";
import { loadCommands, loadCore, run } from "./native.js";
import { refusal } from "./refusal.js";

let beeline: Beeline;
beforeAll(async () => {
  beeline = new Beeline(await loadCore(), loadCommands);
});

test("a name of a file that is not given is refused before the core reads it, and leaves no trace", async () => {
  const missing = ["my.urdf", "a.json", "x.xml", "A.URDF", "folder/x", "no.such", "__proto__.urdf", "rrr:3.5,2"];
  for (let i = 0; i < 50; ++i) {
    for (const name of missing)
      expect(await refusal(() => beeline.readArm(name))).toBe(
        `invalid_arm: ${name}: no such file; give its text in files`,
      );
  }
  expect(await refusal(() => beeline.readArm("toString"))).toMatch(/^invalid_arm: unknown arm "toString"/);
  expect(beeline.readArm("RRR:3.5,3.5,2.5").dof).toBe(3); // a dot in a joint string
  expect(await refusal(() => beeline.readArm("R:my.urdf"))).toMatch(/^invalid_arm: joint string R: .*not a number/);
  for (const text of [undefined, null, 5, {}]) {
    const expected = /^invalid_argument: the file arm\.(urdf|json) is .*; it must be a text or a Uint8Array$/;
    expect(await refusal(() => beeline.armFromUrdf(text as never))).toMatch(expected);
    expect(await refusal(() => beeline.armFromJson(text as never))).toMatch(expected);
    expect(await refusal(() => beeline.readArm(text as never))).toMatch(/^invalid_argument: the arm is .*a text$/);
  }
});

test("what is no arm, no option or no list of numbers is refused in each function", async () => {
  const rrr = beeline.readArm("rrr");
  const any = (value: unknown): never => value as never;
  const q = [0.1, 0.2, 0.3];
  for (const [arm, words] of [
    [undefined, "undefined"],
    [null, "null"],
    ["ur5", '"ur5"'],
    [{}, "an object"],
    [3, "3"],
  ] as const) {
    const calls: (() => unknown)[] = [
      () => beeline.forwardKinematics(any(arm), q),
      () => beeline.linkPoses(any(arm), q),
      () => beeline.jacobian(any(arm), q),
      () => beeline.manipulabilityMeasures(any(arm), q),
      () => beeline.inverseKinematics(any(arm), [1, 2, 0]),
      () => beeline.ik(any(arm), [1, 2, 0]),
      () => beeline.ik(any(arm), [1, 2, 0], { task: "planar" }),
      () => beeline.line(any(arm), q, [[1, 2, 0]]),
      () => beeline.verb("fk", any(arm), { q }),
    ];
    for (const call of calls)
      expect(await refusal(call)).toBe(`invalid_argument: arm is ${words}; it must be an arm of readArm()`);
  }
  const endless = [{ length: 1e9 }, { length: Infinity }, { length: -1 }, new Float64Array(1e8), { length: "3" }];
  const calls: (() => unknown)[] = [
    ...endless.flatMap((list) => [
      () => beeline.forwardKinematics(rrr, any(list)),
      () => beeline.jacobian(rrr, any(list)),
      () => beeline.inverseKinematics(rrr, any(list)),
      () => beeline.inverseKinematics(rrr, [1, 2, 0], { seed: any(list) }),
      () => beeline.ik(rrr, any(list)),
      () => beeline.line(rrr, q, [any(list)]),
      () => beeline.line(rrr, q, any(list)),
      () => beeline.verb("fk", rrr, { q: any(list) }),
      () => beeline.armFromDh("long", any(list), "standard"),
      () => poseNumbers(any(list)),
      () => beeline.run(any(list)),
    ]),
    () => beeline.line(rrr, q, new Array(1e9)),
    () => beeline.armFromDh("long", new Array(1e6).fill({ a: 1 }), "standard"),
    () => beeline.armFromDh("long", any(null), "standard"),
    () => poseNumbers(any(undefined)),
    () => poseNumbers(new Array(16).fill(NaN)),
    () => poseNumbers(any("0123456789012345")),
    () => beeline.inverseKinematics(rrr, [1, 2, 0], any({ al: true })),
    () => beeline.inverseKinematics(rrr, [1, 2, 0], any({ all: "no" })),
    () => beeline.inverseKinematics(rrr, [1, 2, 0], any({ ignoreLimits: 1 })),
    () => beeline.inverseKinematics(rrr, [1, 2, 0], any(null)),
    () => beeline.ik(rrr, [1, 2, 0], any(null)),
    () => beeline.ik(rrr, [1, 2, 0], any({ all: null })),
    () => beeline.ik(rrr, [1, 2, 0], any({ maxSamples: null })),
    () => beeline.line(rrr, q, [[1, 2, 0]], any([])),
    () => beeline.verb("fk", rrr, any(null)),
    () => beeline.verb("fk", rrr, { q }, any(null)),
    () => beeline.verb(any(undefined), rrr),
    () => beeline.jacobian(rrr, q, any({ frames: "tool" })),
    () => beeline.jacobian(rrr, q, any(null)),
    () => beeline.readArm("rrr", any(null)),
    () => beeline.readArm("rrr", {}, any(null)),
    () => beeline.readArm("rrr", {}, any({ tips: "b" })),
    () => beeline.readArm("rrr", {}, any({ tip: 5 })),
    () => beeline.readArm("r\0rr"),
    () => beeline.armFromUrdf("<robot>\0"),
    () => beeline.run(any(undefined)),
    () => beeline.run(["arms", any(5)]),
    () => beeline.run(["ar\0ms"]),
    () => beeline.run(["arms"], any({ "a.csv": 5 })),
    () => beeline.run(["arms"], any(null)),
  ];
  for (const call of calls) expect(await refusal(call), String(call)).toMatch(/^invalid_argument: /);
  expect(await refusal(() => beeline.ik(rrr, [1, 2, 0], { help: true }))).toMatch(/^invalid_usage: .*place of JSON$/);
  const header = readFileSync(fileURLToPath(new URL("../../beeline/model/internal/ranges.h", import.meta.url)), "utf8");
  const most = /max_joints = (\d+)/.exec(header)?.[1] ?? "";
  expect(await refusal(() => beeline.armFromDh("long", new Array(1e6).fill({}), "standard"))).toContain(
    `at most ${most} joints`,
  );
});

test("a pose outside the plane of a planar arm is refused as the command refuses it", async () => {
  const table = (d: number): Arm => beeline.armFromDh("table", [{ a: 3.5, d }, { a: 3.5 }, { a: 2 }], "standard");
  for (const [arm, height] of [
    [beeline.readArm("rrr"), 0],
    [table(0.25), 0.25],
  ] as const) {
    for (const [pose, accepted] of [
      [[4, 3, 0.4], true],
      [[4, 3, height, 0, 0, 0.4], true],
      [[4, 3, height + 5e-7, 0, 0, 0.4], true],
      [[4, 3, height + 2e-6, 0, 0, 0.4], false],
      [[4, 3, height, 0.1, 0, 0.4], false],
      [[4, 3, height, 0, -0.1, 0.4], false],
      [[4, 3, height, Math.PI, 0, 0.4], false],
    ] as const) {
      const files = { "arm.json": arm.toJson() };
      const code = run(["ik", "arm.json", `--pose=${pose.join(",")}`], files).code;
      expect(code, pose.join()).toBe(accepted ? 0 : 2);
      const words = `invalid_argument: the pose is outside the plane z = ${height} m of arm ${arm.name}; give x,y,theta`;
      for (const call of [() => beeline.inverseKinematics(arm, pose), () => beeline.ik(arm, pose)])
        expect(await refusal(call)).toBe(accepted ? "no error" : words);
      expect((await beeline.ik(arm, pose, { task: "planar" })).status).toBe("solved");
    }
  }
});

test("bytes of a file are its text in UTF-8, and poses of links have numbers of their own", async () => {
  const json = beeline
    .readArm("R")
    .toJson()
    .replace(/"name": "R"/, '"name": "bras à un axe"');
  const bytes = new TextEncoder().encode(json);
  expect(beeline.armFromJson(bytes).name).toBe("bras à un axe");
  const arm = beeline.readArm("a.json", { "a.json": bytes });
  expect(await beeline.verb("fk", arm, { q: [0.5] })).toMatchObject({ pose: { planar: { theta: 0.5 } } });
  const poses = beeline.linkPoses(arm, [0.5]);
  expect(poses.map(({ buffer }) => buffer.byteLength)).toEqual(poses.map(() => 128));
});

test("a trajectory refuses quantities, joints and samples that it does not have", async () => {
  const { trajectory } = await beeline.line(beeline.readArm("rrr"), [1.95, -0.9, -1.05], [[4.5, 5.2, 0]]);
  if (!trajectory) throw new Error("there is no trajectory");
  const any = (value: unknown): never => value as never;
  const calls: (() => unknown)[] = [
    () => trajectory.column(any("jerk"), 0),
    () => trajectory.column(any(undefined), 0),
    ...[-1, 3, 0.5, NaN, "0", undefined].map((k) => () => trajectory.column("position", any(k))),
    ...[-1, trajectory.size, 0.5, NaN, "0", undefined].map((i) => () => trajectory.row(any(i))),
    () => trajectory.text(any(undefined)),
  ];
  for (const call of calls) expect(await refusal(call)).toMatch(/^invalid_argument: /);
  expect(trajectory.column("position", 2)[0]).toBe(-1.05);
  expect(trajectory.row(trajectory.size - 1).length).toBe(3);
  trajectory.release();
});
