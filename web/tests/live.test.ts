import { spawn, type ChildProcess } from "node:child_process";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, expect, test } from "vitest";
import { shownArm, visit, type Visit } from "./browser.js";

const root = fileURLToPath(new URL("../..", import.meta.url));
const native = process.env["BEELINE"] ?? `${root}build/beeline`;
const port = 20000 + (process.pid % 20000);

let there: Visit;
let server: { process: ChildProcess; address: string };
beforeAll(async () => {
  there = await visit();
  server = await view();
});
afterAll(async () => {
  server.process.kill();
  await there.close();
});

/** Starts `beeline view` and waits for its address. */
function view(): Promise<{ process: ChildProcess; address: string }> {
  const args = ["view", "ur5", "--no-browser", "--port", String(port), "--page", `${root}build/web`];
  const process = spawn(native, args, { stdio: ["ignore", "pipe", "inherit"] });
  return new Promise((resolve, reject) => {
    process.once("exit", (code) => reject(new Error(`beeline view ended with ${code}`)));
    process.stdout.once("data", (text: Buffer) => resolve({ process, address: text.toString().trim() }));
  });
}

async function post(q: number[]): Promise<number> {
  const headers = { "Content-Type": "application/json" };
  return (await fetch(`${server.address}api/joints`, { method: "POST", headers, body: JSON.stringify({ q }) })).status;
}

test("the page of beeline view shows its arm, follows a program, and comes back with the server", async () => {
  const page = await there.browser.newPage();
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(server.address);
  await page.waitForSelector("#first", { state: "detached" });
  expect(await page.locator(".live").isVisible()).toBe(false); // no program is there
  expect(page.url()).not.toContain("json="); // a built-in arm has its name in the address
  expect(await shownArm(page)).toBe("ur5");

  const shown = async (): Promise<number> => Number(await page.locator("#joint-0").inputValue());
  for (let i = 0; i <= 30; ++i) expect(await post([i / 30, -1, 1, 0, 1, 0])).toBe(204);
  await expect.poll(shown).toBeCloseTo(180 / Math.PI, 1);
  await expect
    .poll(async () => {
      await post([1, -1, 1, 0, 1, 0]); // it is said for a while only
      return page.getByText("live", { exact: true }).isVisible();
    })
    .toBe(true);
  await page.locator(".live").waitFor({ state: "hidden" }); // the program has stopped

  server.process.removeAllListeners("exit");
  server.process.kill();
  await page.getByText("connecting again").waitFor();
  server = await view();
  await page.getByText("connecting again").waitFor({ state: "hidden" });
  expect(await post([0.5, -1, 1, 0, 1, 0])).toBe(204);
  await expect.poll(shown).toBeCloseTo(90 / Math.PI, 1);
  expect(errors).toEqual([]);
});
