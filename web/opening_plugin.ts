import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Plugin } from "vite";
import { Core } from "./src/core/core.js";
import { describe } from "./src/core/description.js";
import { openingRows } from "./src/page/opening_rows.js";

const name = "virtual:opening";
const count = 399; // rows: about the pictures that the opening shows

/** Imports of virtual:opening are the joint values of the motion with which the page opens. `module` is the folder of the
 * WebAssembly modules. */
export function opening(module: string): Plugin {
  return {
    name: "opening",
    resolveId: (id) => (id === name ? `\0${name}` : null),
    async load(id) {
      if (id !== `\0${name}`) return null;
      const script = (await import(pathToFileURL(join(module, "core.js")).href)) as { default: never };
      const core = await Core.load(script.default, readFileSync(join(module, "core.wasm")));
      const arm = core.arm("rrr");
      const rows = openingRows(arm, describe(arm).joints, count);
      return { code: `export default ${JSON.stringify(rows)};`, map: null };
    },
  };
}
