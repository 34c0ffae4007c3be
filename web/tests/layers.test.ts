import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";

const source = fileURLToPath(new URL("../src", import.meta.url));
/** Folders of a layer import from their own layer and from the layers before. */
const layers = [["core"], ["state", "address", "elements"], ["scene", "panels", "share", "live"], ["lessons", "page"]];

function layerOf(path: string): number {
  const folder = path.split("/")[0] ?? "";
  const layer = layers.findIndex((names) => names.includes(folder));
  return layer < 0 ? layers.length : layer; // main.ts
}

test("no file imports from a layer above its own, and the scene imports no panel", () => {
  const upward: string[] = [];
  for (const file of readdirSync(source, { recursive: true, encoding: "utf8" })) {
    if (!file.endsWith(".ts")) continue;
    const text = readFileSync(join(source, file), "utf8");
    for (const [, path = ""] of text.matchAll(/(?:from|import\()\s*"(\.[^"]*)"/g)) {
      const other = relative(source, join(source, dirname(file), path));
      const drawn = file.startsWith("scene/") && other.startsWith("panels/");
      if (layerOf(other) > layerOf(file) || drawn) upward.push(`${file} imports ${other}`);
    }
  }
  expect(upward).toEqual([]);
});
