import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { instantiateCommand } from "../src/core/load.js";
import { centreOf, measures, positionCount, sliceOf, type Measure, type ReachMap } from "../src/core/reach.js";
import { ReachModule } from "../src/core/reach_module.js";
import { addressOf, partOf, stateOf } from "../src/address/address.js";
import { initialState } from "../src/state/page_state.js";
import { toolAt } from "../src/page/tool_at.js";
import { chooseArm, pages } from "./browser.js";
import { commandParts, loadCore, run } from "./native.js";

const { factory, wasm } = await commandParts();
const ignore = (): void => undefined;
const maps = new ReachModule(await instantiateCommand(factory, await WebAssembly.compile(wasm), ignore, ignore));
const core = await loadCore();
const folder = mkdtempSync(join(tmpdir(), "beeline-reach-"));

const { opened } = pages();
afterAll(() => {
  rmSync(folder, { recursive: true });
});

/** The arm's plan with its tool directions or headings 90 degrees apart. */
function planOf(name: string, resolution: number) {
  const arm = core.arm(name);
  const plan = { arm: arm.json, resolution, directions: Math.PI / 2, rolls: Math.PI / 3, orientation: null };
  arm.release();
  return plan;
}

function mapOf(name: string, resolution: number): ReachMap {
  return maps.answer({ ask: "map", plan: planOf(name, resolution) });
}

/** What `beeline reach slice` writes: rows x, y, z, value. */
function nativeSlice(file: string, plane: string, measure: Measure): number[][] {
  const { files } = run(["reach", "slice", file, `--at=${plane}`, `--measure=${measure}`, "--out=slice.csv"]);
  const [, ...rows] = (files["slice.csv"] ?? "").trim().split("\n");
  return rows.map((row) => row.split(",").map(Number));
}

test.each([
  ["ur5", 0.3, ["--directions=90"]],
  ["panda", 0.5, ["--directions=90"]],
  ["scara", 0.2, ["--directions=90", "--rolls=60"]],
  ["rrr", 1, ["--directions=90"]],
] as const)("a slice of %s equals beeline reach slice", (name, resolution, orientations) => {
  const file = join(folder, `${name}.h5`);
  const made = run(["reach", "map", name, `--resolution=${resolution}`, ...orientations, "--degrees", `--out=${file}`]);
  expect(made.stderr).toBe("");
  const map = mapOf(name, resolution);
  for (const measure of measures) {
    for (const normal of name === "rrr" ? [2] : [0, 1, 2]) {
      const axis = map.axes[normal] ?? map.axes[0];
      const index = Math.floor(axis.cells / 2);
      const rows = nativeSlice(file, `${"xyz"[normal]}=${centreOf(axis, index)}`, measure);
      const slice = sliceOf(map, map.values[measure], normal, index);
      expect(rows.length).toBe(slice.values.length);
      rows.forEach((row, k) => {
        expect(row[normal]).toBeCloseTo(centreOf(axis, index), 9);
        const value = slice.values[k] as number;
        if (Number.isNaN(row[3])) expect(value).toBeNaN();
        else expect(Math.abs(value - (row[3] as number))).toBeLessThan(1e-5);
      });
    }
  }
});

test("a surface encloses the positions that are reached, less of them at a higher level", () => {
  const plan = planOf("ur5", 0.3);
  const map = mapOf("ur5", 0.3);
  const volume = (level: number): number => {
    const values = map.values.directions;
    const { vertices, triangles } = maps.answer({ ask: "surface", plan, values, level });
    let six = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => vertices.subarray(3 * (triangles[t + k] ?? 0)));
      const [[ax = 0, ay = 0, az = 0], [bx = 0, by = 0, bz = 0], [cx = 0, cy = 0, cz = 0]] = [a, b, c] as [
        Float32Array,
        Float32Array,
        Float32Array,
      ];
      six += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    }
    return six / 6;
  };
  const reached = map.values.branches.filter((value) => value > 0).length * map.axes[0].step ** 3;
  expect(Math.abs(volume(0) / reached - 1)).toBeLessThan(0.15);
  expect(volume(0.9)).toBeLessThan(volume(0.5));
  expect(volume(1.1)).toBe(0);
});

test("the tool moves to each position that is reached", () => {
  for (const [name, resolution] of [
    ["ur5", 0.4],
    ["panda", 0.5],
    ["rrr", 2],
  ] as const) {
    const arm = core.arm(name);
    const map = mapOf(name, resolution);
    const q = arm.displayConfiguration();
    let count = 0;
    for (let p = 0; p < positionCount(map); ++p) {
      if (Number.isNaN(map.values.branches[p])) continue;
      const [ny, nz] = [map.axes[1].cells, map.axes[2].cells];
      const at = [Math.floor(p / (ny * nz)), Math.floor(p / nz) % ny, p % nz];
      const point = map.axes.map((axis, k) => centreOf(axis, at[k] ?? 0));
      const found = toolAt(arm, map, point, q);
      expect(found).not.toBeNull();
      const tool = arm.forward(found ?? q).at(-1) as Float64Array;
      point.forEach((value, k) => expect(Math.abs(value - (tool[12 + k] ?? NaN))).toBeLessThan(1e-6));
      ++count;
    }
    expect(count).toBeGreaterThan(10);
    arm.release();
  }
});

test("the choices of the section are read back from an address", async () => {
  const chosen = {
    section: "workspace",
    reachCells: 20,
    reachDirections: 0,
    measure: "margin",
    level: 0.25,
    sliceNormal: 1,
    sliceAt: -0.3,
    showSurface: false,
    showSlice: false,
  } as const;
  const hash = await addressOf({ ...initialState, ...chosen });
  expect(hash).toContain("cells=20&directions=0&measure=margin&level=0.25&slice=y=-0.3&surface=0&tiles=0");
  expect(await stateOf(hash)).toEqual({ ...initialState, ...chosen });
  expect(Object.keys(await partOf("#slice=x")).sort()).toEqual(["sliceAt", "sliceNormal"]);
  expect(await stateOf("#cells=9&directions=7&measure=luck&level=2&slice=w=1")).toEqual(initialState);
});

/** The share of the pixels of the picture that are not as they were. */
async function changed(page: Page, before: Buffer): Promise<number> {
  const after = await page.locator("#stage canvas").screenshot();
  return Number(
    await page.evaluate(`(async () => {
      const pixels = async (png) => {
        const image = await createImageBitmap(await (await fetch("data:image/png;base64," + png)).blob());
        const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, image.width, image.height).data;
      };
      const [a, b] = await Promise.all(["${before.toString("base64")}", "${after.toString("base64")}"].map(pixels));
      let count = 0;
      for (let i = 0; i < a.length; i += 4) if (Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) > 12) ++count;
      return (4 * count) / a.length;
    })()`),
  );
}

const picture = (page: Page) => page.locator("#stage canvas").screenshot();
/** Whether the picture is what it was; `now` gets what it is. */
async function unchanged(page: Page, before: Buffer, now: (picture: Buffer) => void): Promise<boolean> {
  const same = (await changed(page, before)) === 0;
  now(await picture(page));
  return same;
}
const totals = /\d+ of \d+ positions are reached/;

test("a map is computed, shown as a surface and a slice, and cleared with the arm", async () => {
  const page = await opened("#arm=ur5&section=workspace&cells=8&directions=90&unit=rad");
  await page.getByText(/positions of 0\.\d+\sm × 6 directions/).waitFor();
  await page.getByRole("button", { name: "Compute the map" }).click();
  await page.getByText(totals).waitFor();
  const level = page.getByLabel("Level of the surface");
  const [surface, slice] = [page.getByLabel("Surface", { exact: true }), page.getByLabel("Slice", { exact: true })];
  await surface.uncheck();
  await slice.uncheck();
  await expect.poll(() => page.locator(".colours").isVisible()).toBe(false); // nothing has its colours
  let empty = await picture(page);
  await expect.poll(() => unchanged(page, empty, (now) => (empty = now))).toBe(true);
  for (const part of [surface, slice]) {
    await part.check();
    await expect.poll(() => changed(page, empty)).toBeGreaterThan(0.1);
    await part.uncheck();
    await expect.poll(() => changed(page, empty)).toBeLessThan(0.01);
  }
  await surface.check();
  await slice.check();
  await level.focus();
  await page.keyboard.press("ArrowRight");
  await page.getByText("≥ 51 %").waitFor();
  await page.getByLabel("Measure of a position").selectOption("branches");
  await page.getByText("solutions within the limits, at most").waitFor();
  await page.getByLabel("Normal of the slice").selectOption("x");
  await page.getByLabel("Position of the slice", { exact: true }).fill("0.3");
  await page.getByLabel("Position of the slice", { exact: true }).press("Enter");
  await expect
    .poll(() => page.url())
    .toContain("section=workspace&unit=rad&cells=8&directions=90&measure=branches&level=0.51&slice=x=0.3");
  await chooseArm(page, "panda");
  await expect.poll(() => page.getByText(totals).isVisible()).toBe(false);
  await page.context().close();
});

test("a position that is typed or clicked shows its values, and the tool moves there", async () => {
  const page = await opened("#arm=rrr&q=0.3,0.5,0.5&section=reach&cells=12&directions=90");
  await page.getByRole("button", { name: "Compute the map" }).click();
  await page.getByText(totals).waitFor();
  const words = page.getByText(/headings reached \d+\s%/);
  for (const [name, value] of [
    ["x", "4"],
    ["y", "3"],
  ] as const) {
    await page.getByLabel(`${name} of a position`).fill(value);
    await page.getByLabel(`${name} of a position`).press("Enter");
  }
  await words.waitFor();
  const before = page.url();
  await page.getByRole("button", { name: "Move the tool there" }).click();
  await expect.poll(() => page.url()).not.toBe(before);
  const x = Number(await page.getByLabel("x of a position").inputValue());
  expect(Math.abs(x - 4)).toBeLessThan(1);
  await page.getByLabel("x of a position").fill("40");
  await page.getByLabel("x of a position").press("Enter");
  await page.getByText("outside the map").waitFor();
  const { width = 0, height = 0 } = (await page.locator("#stage .drawing").boundingBox()) ?? {};
  await page.locator("#stage .drawing").click({ position: { x: 0.3 * width, y: 0.5 * height } });
  await words.waitFor();
  await page.context().close();
});

test("a map under way shows its progress and is cancelled, also by another section", async () => {
  const page = await opened("#arm=panda&section=reach&cells=20&directions=45");
  const start = page.getByRole("button", { name: "Compute the map" });
  const stop = page.getByRole("button", { name: "Cancel" });
  await page.getByText("This may take minutes.").waitFor();
  await start.click();
  await page.getByText(/^[1-9]\d* %, about \d+ s left/).waitFor();
  await stop.click();
  await start.waitFor();
  expect(await page.getByText("cancelled").count()).toBe(0);
  await start.click();
  await stop.waitFor();
  await page.getByRole("link", { name: "Pose", exact: true }).click();
  await page.getByText(/solutions?, /).waitFor(); // by the worker
  await page.getByRole("link", { name: "Workspace", exact: true }).click();
  await start.waitFor();
  await page.context().close();
});

test.each([
  ["gantry", "has no bounds"],
  ["URR:0.4,0.3,0.2", "has 4 joints"],
])("%s has no map, and the page says why", async (arm, reason) => {
  const page = await opened(`#arm=${arm}&section=reach`);
  await page.locator(".panel .refusal").getByText(reason).waitFor();
  expect(await page.getByRole("button", { name: "Compute the map" }).isDisabled()).toBe(true);
  await page.context().close();
});

test.each([1200, 360])("the section is accessible and no wider than %d px", async (width) => {
  const page = await opened("#arm=ur5&section=reach&cells=8&directions=90", { width, height: 740 });
  await page.getByRole("button", { name: "Compute the map" }).click();
  await page.getByText(totals).waitFor();
  await page.addScriptTag({ path: "node_modules/axe-core/axe.min.js" });
  const found = await page.evaluate("axe.run().then((all) => all.violations.map((one) => one.id))");
  expect(found).toEqual([]);
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(width);
  await page.context().close();
});
