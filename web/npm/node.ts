import { readFile } from "node:fs/promises";
import type { Beeline } from "./beeline.js";
import { load as loadFrom } from "./load.js";

export * from "./exports.js";

/** Loads the core; the command line is loaded when it is first needed. */
export const load = (): Promise<Beeline> =>
  loadFrom(
    async () => Uint8Array.from(await readFile(new URL("../wasm/core.wasm", import.meta.url))),
    async () => Uint8Array.from(await readFile(new URL("../wasm/beeline.wasm", import.meta.url))),
  );
