import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import type { Frame, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { shownArm, visit, type Visit } from "./browser.js";

const root = fileURLToPath(new URL("../..", import.meta.url));
const python = [process.env["PYTHON"], `${root}.venv-python/bin/python`].find((path) => path && existsSync(path));
const env = { ...process.env, PYTHONPATH: process.env["PYTHONPATH"] ?? `${root}build/python`, BROWSER: "true" };
const module = python !== undefined && spawnSync(python, ["-c", "import beeline"], { env }).status === 0;
if (!module) console.warn("Skipped: the page of beeline.view(), as the Python module is not built here (make test)");

const q = [0.5, -1, 1, 0.25, 1, 1 / 3];
const script = `
import beeline, sys
arm = beeline.arms.ur5()
page = beeline.view(arm, ${JSON.stringify(q)})
page.save("held.html")
open("notebook.html", "w").write("<!doctype html><title>Notebook</title>" + page._repr_html_())
move = beeline.control_joints(arm, [0] * 6, ${JSON.stringify(q)})
beeline.view(arm, trajectory=move).save("moved.html")
move.trajectory.save("move.csv")
`;

const folder = mkdtempSync(join(tmpdir(), "beeline-python-"));
let there: Visit;
beforeAll(async () => {
  there = await visit();
  if (!module) return;
  const done = spawnSync(python as string, ["-c", script], {
    cwd: folder,
    env: { ...env, TMPDIR: folder },
    encoding: "utf8",
  });
  expect(done.stderr).toBe("");
});
afterAll(async () => {
  await there.close();
  rmSync(folder, { recursive: true });
});

async function opened(address: string, offline: boolean): Promise<{ page: Page; errors: string[] }> {
  const page = await (await there.browser.newContext({ offline })).newPage();
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(address);
  return { page, errors };
}

async function joints(page: Page | Frame): Promise<number[]> {
  await page.waitForSelector("#first", { state: "detached" });
  const boxes = q.map((_, i) => page.locator(`#joint-${i}`).inputValue());
  return (await Promise.all(boxes)).map((text) => (Number(text) * Math.PI) / 180);
}

test.skipIf(!module)("the page that Python saved shows the arm in its configuration, from a disk", async () => {
  const { page, errors } = await opened(`file://${folder}/held.html`, true);
  for (const [i, value] of (await joints(page)).entries()) expect(value).toBeCloseTo(q[i] as number, 3);
  expect(await shownArm(page)).toBe("ur5");
  await page.getByText(/8 solutions/).waitFor(); // of the command, in its worker
  await page.getByRole("button", { name: "Frames" }).click(); // the address holds the change, and all numbers exactly
  await expect.poll(() => page.evaluate("location.hash")).toContain(`q=${q.join(",")}`);
  expect(errors).toEqual([]);
});

test.skipIf(!module)("the page that Python saved plays the motion", async () => {
  const { page, errors } = await opened(`file://${folder}/moved.html`, true);
  const written = readFileSync(join(folder, "move.csv"), "utf8");
  const end = Number(written.trim().split("\n").at(-1)?.split(",")[0]);
  const bar = page.getByRole("slider", { name: "Time" });
  await bar.press("End");
  expect(Number(await bar.inputValue())).toBeCloseTo(end, 3);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "motion.csv" }).click(),
  ]);
  await download.saveAs(join(folder, "played.csv"));
  expect(readFileSync(join(folder, "played.csv"), "utf8")).toBe(written);
  expect(errors).toEqual([]);
});

test.skipIf(!module)("a notebook shows the page in a frame", async () => {
  const server = createServer((_, response) => {
    response.setHeader("Content-Type", "text/html; charset=utf-8");
    response.end(readFileSync(join(folder, "notebook.html")));
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { page, errors } = await opened(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`, false);
  const frame = page.frames()[1] as Frame;
  for (const [i, value] of (await joints(frame)).entries()) expect(value).toBeCloseTo(q[i] as number, 3);
  await frame.locator("#joint-0").fill("90");
  await frame.locator("#joint-0").press("Enter");
  await expect.poll(() => frame.evaluate("location.hash")).toContain(`q=${Math.PI / 2},-1,1`);
  await frame.getByRole("link", { name: "Lessons" }).click();
  await frame.getByRole("heading", { name: "Links and joints" }).waitFor();
  expect(page.url()).not.toContain("#"); // the frame has its own address
  expect(errors).toEqual([]);
  server.close();
});
