import { expect, test } from "vitest";
import { CoreWorker } from "../src/core/client.js";
import { missingFeature } from "../src/core/load.js";
import type { Request, WorkerStart } from "../src/core/protocol.js";
import { positionCount } from "../src/core/reach.js";
import { serve, type Scope } from "../src/core/worker.js";
import { commandParts, run } from "./native.js";

const { factory, wasm } = await commandParts();
const compile = (): Promise<WebAssembly.Module> => WebAssembly.compile(wasm);

/** A worker in this thread, which is deaf after terminate(). */
function start(): Promise<Worker> {
  let alive = true;
  const worker = {
    onmessage: null as ((event: MessageEvent) => void) | null,
    onerror: null,
    terminate: () => (alive = false),
    postMessage: (request: WorkerStart | Request) => {
      queueMicrotask(() => alive && scope.onmessage?.({ data: request } as MessageEvent<WorkerStart | Request>));
    },
  };
  const scope: Scope = {
    onmessage: null,
    postMessage: (message) => {
      if (alive) worker.onmessage?.({ data: message } as MessageEvent);
    },
  };
  serve(scope, factory);
  return Promise.resolve(worker as unknown as Worker);
}

const poses = { "poses.csv": "x,y,theta\n4.5,5.2,0\n5.6,2,-1.3\n" };
const line = ["line", "rrr", "--from=1.95,-0.9,-1.05", "--through", "poses.csv", "--json"];

test("requests are answered each by its own result", async () => {
  const worker = new CoreWorker(start, compile);
  const [good, bad] = await Promise.all([
    worker.command(["fk", "rrr", "--q=0,0,0"]),
    worker.command(["fk", "nothing"]),
  ]);
  expect(good.stdout).toBe(run(["fk", "rrr", "--q=0,0,0"]).stdout);
  expect(bad.code).toBe(2);
});

test("a long command reports progress, without it in its messages", async () => {
  const seen: number[] = [];
  const result = await new CoreWorker(start, compile).command(line, poses, (fraction) => seen.push(fraction));
  expect(result.code).toBe(0);
  expect(result.stderr).toBe(run(line, poses).stderr);
  expect(seen.length).toBeGreaterThan(0);
  seen.forEach((fraction) => expect(fraction >= 0 && fraction <= 1).toBe(true));
});

test("cancel() rejects what is under way, and the next command works", async () => {
  const worker = new CoreWorker(start, compile);
  const cancelled = worker.command(line, poses);
  worker.cancel();
  await expect(cancelled).rejects.toThrow("cancelled");
  expect((await worker.command(["arms"])).code).toBe(0);
});

test("a map is computed with progress, and what it refuses has a reason", async () => {
  const worker = new CoreWorker(start, compile);
  const { files } = run(["show", "rrr", "--out=rrr.json"]);
  const plan = { arm: files["rrr.json"] ?? "", resolution: 1, directions: 1, rolls: 1, orientation: null };
  const seen: number[] = [];
  const map = await worker.reach({ ask: "map", plan }, (fraction) => seen.push(fraction));
  expect(map.values.branches.length).toBe(positionCount(map));
  expect(map.cellsReached).toBeGreaterThan(0);
  expect(seen.at(-1)).toBe(1);
  await expect(worker.reach({ ask: "grid", plan: { ...plan, directions: 9 } })).rejects.toThrow(
    "angle between headings",
  );
  const { values } = map;
  const flat = worker.reach({ ask: "surface", plan, values: values.branches.subarray(1), level: 1 });
  await expect(flat).rejects.toThrow("a surface takes a value for each of the");
  expect((await worker.command(["arms"])).code).toBe(0);
});

test("a file's name with a folder is refused, and the worker lives on", async () => {
  const worker = new CoreWorker(start, compile);
  await expect(worker.command(["arms"], { "../a.csv": "" })).rejects.toThrow("not the name of a file");
  expect((await worker.command(["arms"])).code).toBe(0);
});

test("this engine has what the core needs", () => expect(missingFeature()).toBeNull());
