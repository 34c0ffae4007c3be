import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Plugin } from "vite";
import { Commands } from "./src/core/commands.js";
import { Core } from "./src/core/core.js";
import type { Skeleton } from "./src/core/types.js";
import type { ListedArm } from "./src/panels/gallery.js";

const name = "virtual:arms";
const radian = Math.PI / 180;
const [azimuth, elevation] = [-50 * radian, 25 * radian]; // of `beeline draw`
const [width, height, margin] = [96, 72, 10];

type Point = [number, number];

/** A point of the world as the viewer of `beeline draw` sees it, y down; a planar arm from above. */
function seen([x = 0, y = 0, z = 0]: number[], planar: boolean): Point {
  if (planar) return [x, -y];
  const [right, back] = [y * Math.cos(azimuth) - x * Math.sin(azimuth), x * Math.cos(azimuth) + y * Math.sin(azimuth)];
  return [right, back * Math.sin(elevation) - z * Math.cos(elevation)];
}

/** The centre line of an arm and its joints in a small picture. */
function picture({ base, joints, tool }: Skeleton, planar: boolean): ListedArm["picture"] {
  const line = [base, ...joints.flatMap(({ enter, leave }) => [enter, leave]), tool].map((p) => seen(p, planar));
  const centres = joints.map(({ centre }) => seen(centre, planar));
  const all = [...line, ...centres];
  const range = (k: 0 | 1): Point => [Math.min(...all.map((p) => p[k])), Math.max(...all.map((p) => p[k]))];
  const [[left, right], [top, bottom]] = [range(0), range(1)];
  const fits = [(width - 2 * margin) / (right - left), (height - 2 * margin) / (bottom - top)].filter(Number.isFinite);
  const scale = Math.min(...fits, 1e3);
  const at = (p: Point): Point => [
    Number((width / 2 + (p[0] - (left + right) / 2) * scale).toFixed(1)),
    Number((height / 2 + (p[1] - (top + bottom) / 2) * scale).toFixed(1)),
  ];
  return { line: line.map(at), joints: centres.map(at) };
}

/** Imports of virtual:arms are the built-in arms, as `beeline arms` lists them, each with a small picture. `module` is the
 * folder of the WebAssembly modules. */
export function arms(module: string): Plugin {
  const parts = async (part: string) => ({
    factory: ((await import(pathToFileURL(join(module, `${part}.js`)).href)) as { default: never }).default,
    wasm: readFileSync(join(module, `${part}.wasm`)),
  });
  return {
    name: "arms",
    resolveId: (id) => (id === name ? `\0${name}` : null),
    async load(id) {
      if (id !== `\0${name}`) return null;
      const [command, small] = [await parts("beeline"), await parts("core")];
      const commands = await Commands.load(command.factory, command.wasm);
      const core = await Core.load(small.factory, small.wasm);
      const { arms: all } = await commands.json<{ arms: Omit<ListedArm, "picture">[] }>(["arms"]);
      const listed = all.map(({ name, maker, model, joints, dof, planar, reach }): ListedArm => {
        const arm = core.arm(name);
        const first = arm.skeleton(arm.displayConfiguration());
        // Slides that are shown drawn in would be a dot.
        const isDot = [first.tool, ...first.joints.map(({ centre }) => centre)].every((point) =>
          point.every((value, i) => Math.abs(value - (first.base[i] ?? 0)) < 1e-6),
        );
        const out = Array.from({ length: arm.dof }, () => 1);
        const drawn = picture(isDot ? arm.skeleton(out) : first, planar);
        arm.release();
        return { name, maker, model, joints, dof, planar, reach, picture: drawn };
      });
      return { code: `export default ${JSON.stringify(listed)};`, map: null };
    },
  };
}
