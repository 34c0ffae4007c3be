import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { Commands } from "../src/core/commands.js";
import { Core } from "../src/core/core.js";
import type { Files } from "../src/core/types.js";

const root = fileURLToPath(new URL("../..", import.meta.url));
const native = process.env["BEELINE"] ?? join(root, "build/beeline");
export const module = process.env["BEELINE_WEB"] ?? join(root, "build-web-core/web");

export interface Outcome {
  code: number;
  stdout: string;
  stderr: string;
  /** Those that are in its folder when it ends. */
  files: Files;
}

/** Runs the native command with these files in its folder. */
export function run(args: string[], files: Files = {}): Outcome {
  const folder = mkdtempSync(join(tmpdir(), "beeline-web-"));
  try {
    for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
    const done = spawnSync(native, args, { cwd: folder, encoding: "utf8", maxBuffer: 1 << 28 });
    if (done.error) throw done.error;
    const left: Files = {};
    for (const name of readdirSync(folder)) left[name] = readFileSync(join(folder, name), "utf8");
    return { code: done.status ?? -1, stdout: done.stdout, stderr: done.stderr, files: left };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

export function json<T>(args: string[], files: Files = {}): T {
  return JSON.parse(run([...args, "--json"], files).stdout) as T;
}

async function parts(name: string) {
  const { default: factory } = await import(join(module, `${name}.js`));
  return { factory, wasm: readFileSync(join(module, `${name}.wasm`)) };
}

export async function loadCore(): Promise<Core> {
  const { factory, wasm } = await parts("core");
  return Core.load(factory, wasm);
}

export const commandParts = () => parts("beeline");

export async function loadCommands(): Promise<Commands> {
  const { factory, wasm } = await commandParts();
  return Commands.load(factory, wasm);
}

/** Numbers in [0, 1), the same for the same seed (mulberry32). */
export function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t = (t + Math.imul(t ^ (t >>> 7), t | 61)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
