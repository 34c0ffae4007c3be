import { expect, test } from "vitest";
import { toolPosition } from "../src/core/pose.js";
import { compile, instantiateCommand } from "../src/core/load.js";
import type { GuardedStep, NearestPair, SceneDocument } from "../src/core/scene.js";
import { SceneModule } from "../src/core/scene_module.js";
import { Guard } from "../src/page/guard.js";
import type { Overlays } from "../src/page/overlays.js";
import type { SceneModel } from "../src/page/scene_model.js";
import { initialState, type PageState } from "../src/state/page_state.js";
import { Store } from "../src/state/store.js";
import { commandParts, loadCore, random } from "./native.js";

const seed = Number(process.env["BEELINE_SEED"] ?? 20260301);
console.log(`BEELINE_SEED=${seed}`);

const start = [0, -0.5, 0, -2.2, 0, 1.8, 0.8]; // of panda
/** A wall of 2 mm beside the arm. */
const walled = (from: number, to: number): SceneDocument => {
  const shape = { box: { size: [to - from, 0.002, 1.2] }, pose: { xyz: [(from + to) / 2, 0.3, 0.6] } };
  return { obstacles: [{ name: "wall", shapes: [shape] }] };
};
const around: SceneDocument = {
  obstacles: Array.from({ length: 20 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 20;
    const xyz = [0.7 * Math.cos(angle), 0.7 * Math.sin(angle), 0.2 + 0.25 * (i % 3)];
    return { name: `box ${i}`, shapes: [{ box: { size: [0.1, 0.1, 0.1] }, pose: { xyz } }] };
  }),
};

type Lead = (from: number[], to: number[], slides: boolean) => GuardedStep;

/** panda among obstacles, in the module. */
async function among(document: SceneDocument) {
  const { factory, wasm } = await commandParts();
  const ignore = (): void => undefined;
  const module = new SceneModule(await instantiateCommand(factory, await compile(wasm), ignore, ignore));
  const arm = { argument: "panda", tip: "", files: {} };
  const { bodies } = module.answer({ ask: "arm", arm, clearance: 0 }) as { bodies: { name: string }[] };
  const scene = module.answer({ ask: "read", name: "scene.json", content: JSON.stringify(document) }) as string;
  const names = [...bodies, ...document.obstacles].map(({ name }) => name);
  return {
    names,
    lead: (from: number[], to: number[], slides: boolean) =>
      module.answer({ ask: "guard", scene, from, to, slides }) as GuardedStep,
    /** The least distance beyond its clearance, m. */
    spare: (q: number[]): number => {
      const [nearest] = module.answer({ ask: "nearest", scene, q }) as NearestPair[];
      return (nearest?.lower ?? NaN) - (nearest?.clearance ?? NaN);
    },
  };
}

/** Where the arm is led, step by step. */
function led(lead: Lead, from: number[], to: number[], slides: boolean): GuardedStep {
  let step = lead(from, to, slides);
  for (let i = 0; step.isOnItsWay && i < 60; ++i) step = lead(step.q, to, slides);
  return step;
}

const between = (a: number[], b: number[], part: number): number[] =>
  a.map((value, k) => value + part * ((b[k] ?? NaN) - value));

test("an arm that is led keeps its clearance, wherever it is wanted, and a joint on its way there too", async () => {
  const next = random(seed);
  let held = 0;
  for (const scene of [walled(0.25, 1.2), around]) {
    const { lead, spare } = await among(scene);
    for (let run = 0; run < 6; ++run) {
      let q = start;
      for (let i = 0; i < 25; ++i) {
        const slides = i % 2 === 0;
        const k = Math.floor(7 * next());
        const to = slides
          ? q.map((value) => value + 0.8 * (next() - 0.5))
          : q.with(k, (q[k] ?? NaN) + 1.6 * (next() - 0.5));
        const step = lead(q, to, slides);
        expect(spare(step.q)).toBeGreaterThan(0);
        expect(step.heldBy !== null && step.isOnItsWay).toBe(false);
        if (!slides)
          for (let part = 0; part < 1; part += 0.1) expect(spare(between(q, step.q, part))).toBeGreaterThan(0);
        if (step.heldBy !== null) ++held;
        else if (!step.isOnItsWay && !slides) expect(step.q).toEqual(to);
        q = step.q;
      }
    }
  }
  expect(held).toBeGreaterThan(10);
});

test("a thin wall is not passed, by a joint nor by the tool, and the two bodies are named", async () => {
  const behind = start.with(0, 1.4);
  for (const slides of [false, true]) {
    const { lead, names } = await among(slides ? walled(0, 1.2) : walled(0.25, 1.2)); // the tool slides around the shorter one
    const step = led(lead, start, behind, slides);
    expect(step.q[0]).toBeGreaterThan(0.3);
    expect(step.q[0]).toBeLessThan(1);
    expect(step.isGoalFree).toBe(!slides);
    const [first = -1, second = -1] = step.heldBy ?? [];
    expect(names[first]).toMatch(/^panda_/);
    expect(names[second]).toBe("wall");
    const free = lead(start, start.with(0, -0.3), slides);
    expect(free).toEqual({ q: start.with(0, -0.3), heldBy: null, isOnItsWay: false, isGoalFree: true });
    expect(lead(start, start.with(0, 0.7), slides).isGoalFree).toBe(false); // in the wall
  }
});

test("the tool slides over a body, where a joint stops", async () => {
  const ball = { name: "ball", shapes: [{ sphere: { radius: 0.1 }, pose: { xyz: [0.45, 0.1, 0.5] } }] };
  const { lead } = await among({ obstacles: [ball] });
  const arm = (await loadCore()).arm("panda");
  const at = (q: number[]): number[] => toolPosition(arm, q);
  const to = start.with(0, 0.1);
  const away = (q: number[]): number => Math.hypot(...at(q).map((value, i) => value - (at(to)[i] ?? NaN)));
  const joint = led(lead, start, to, false);
  const tool = led(lead, start, to, true);
  expect(joint.q.slice(1)).toEqual(start.slice(1));
  expect(away(tool.q)).toBeLessThan(0.9 * away(joint.q));
});

test("an arm in an obstacle can move out, and not deeper", async () => {
  const ball = { name: "ball", shapes: [{ sphere: { radius: 0.12 }, pose: { xyz: [0.45, 0.1, 0.5] } }] };
  const { lead, spare } = await among({ obstacles: [ball] });
  const inside = start.with(0, 0.02);
  const before = spare(inside);
  expect(before).toBeLessThan(-0.005);
  for (const slides of [false, true]) {
    const deeper = lead(inside, start.with(0, 0.2), slides);
    expect(deeper.heldBy).not.toBe(null);
    expect(spare(deeper.q)).toBeGreaterThan(before - 1e-6);
    let q = inside;
    for (let i = 0; i < 60; ++i) q = lead(q, start.with(0, -0.5), slides).q;
    expect(q[0]).toBeCloseTo(-0.5, 3);
    expect(spare(q)).toBeGreaterThan(0);
  }
});

test("a hand that lets go does not take what the next hand is held back by", async () => {
  const answers: ((step: GuardedStep) => void)[] = [];
  const model = {
    nearest: [],
    namesOf: () => ["hand", "wall"],
    guarded: () => new Promise<GuardedStep>((resolve) => answers.push(resolve)),
  } as unknown as SceneModel;
  let ghost: number[] | null = null;
  const overlays = { want: (q: number[] | null) => (ghost = q) } as unknown as Overlays;
  const guard = new Guard(new Store<PageState>({ ...initialState, q: [0] }), model, overlays);
  const step: GuardedStep = { q: [0.5], heldBy: [0, 1], isGoalFree: true, isOnItsWay: false };
  const answered = (to: number): Promise<void> => new Promise((resolve) => guard.lead([to], false, () => resolve()));

  void answered(1);
  const first = guard.released();
  guard.stop(); // the next hand presses before the answer
  const second = answered(2);
  answers[0]?.(step);
  await expect.poll(() => answers.length).toBe(2);
  answers[1]?.(step);
  await second;
  expect(await first).toBeNull();
  expect(ghost).toEqual([2]);
  expect((await guard.released())?.to).toEqual([2]);
  expect(ghost).toBeNull();
});
