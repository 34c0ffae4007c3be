import { createServer, type Server } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type Download, type Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect } from "vitest";
import { patience } from "../vitest.config.js";

const root = fileURLToPath(new URL("../../build/web", import.meta.url));

/** The headless shell has the engine of Chromium without its windows, and opens a page with half of the computation. */
const browsers = ["/usr/bin/chromium-headless-shell", "/usr/bin/chromium"];
export const executablePath =
  process.env["CHROMIUM"] ?? browsers.find((path) => existsSync(path)) ?? "/usr/bin/chromium";

const types: Record<string, string> = {
  html: "text/html",
  js: "text/javascript",
  css: "text/css",
  wasm: "application/wasm",
};

/** How many times slower than it is the processor of each page is made: SLOW=8 finds tests that depend on time. */
export const slow = Number(process.env["SLOW"] ?? 1);

/** The built page on a server of this computer, and a real browser. */
export interface Visit {
  address: string;
  browser: Browser;
  close(): Promise<void>;
}

function serve(): Promise<Server> {
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url ?? "/", "http://page").pathname).replace(/\/$/, "/index.html");
    readFile(join(root, path)).then(
      (bytes) => {
        response.setHeader("Content-Type", types[path.split(".").at(-1) ?? ""] ?? "application/octet-stream");
        response.end(bytes);
      },
      () => response.writeHead(404).end(),
    );
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

export async function visit(): Promise<Visit> {
  const server = await serve();
  const address = server.address();
  if (address === null || typeof address === "string") throw new Error("the server has no port");
  const browser = await chromium.launch({
    executablePath,
    // The processor computes WebGL: without antialiasing, and only for the picture, frames come eight times as fast.
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-gpu-compositing",
      "--webgl-antialiasing-mode=none",
    ],
  });
  browser.on("context", (context) => {
    context.setDefaultTimeout(patience);
    if (slow > 1) context.on("page", (page) => void throttle(page));
  });
  return {
    address: `http://127.0.0.1:${address.port}/`,
    browser,
    async close() {
      await browser.close();
      server.close();
    },
  };
}

async function throttle(page: Page): Promise<void> {
  const session = await page.context().newCDPSession(page);
  await session.send("Emulation.setCPUThrottlingRate", { rate: slow });
}

/** What a page must not do: errors in its console, requests to other computers. */
export interface Complaints {
  errors: string[];
  requests: string[];
}

/** Opens the page at an address behind #, in a fresh profile, and waits until it can be used. */
export async function open(
  { browser, address }: Visit,
  hash = "",
  size = { width: 1200, height: 900 },
): Promise<{ page: Page; complaints: Complaints }> {
  const context = await browser.newContext({ viewport: size });
  const page = await context.newPage();
  const complaints: Complaints = { errors: [], requests: [] };
  page.on("console", (message) => {
    if (message.type() === "error") complaints.errors.push(message.text());
  });
  page.on("pageerror", (error) => complaints.errors.push(error.message));
  page.on("request", (request) => {
    if (!request.url().startsWith(address) && !/^(data|blob):/.test(request.url()))
      complaints.requests.push(request.url());
  });
  await page.goto(address + hash);
  await page.waitForSelector("#first", { state: "detached" });
  return { page, complaints };
}

/**
 * One browser for all tests of a file. `opened` opens the page for a test; after the test no such page may have a complaint,
 * and all contexts are closed. `there` is the visit, once the tests run.
 */
export function pages(): {
  there(): Visit;
  opened(hash?: string, size?: { width: number; height: number }): Promise<Page>;
} {
  let visited: Visit;
  let complaints: Complaints[] = [];
  beforeAll(async () => {
    visited = await visit();
  });
  afterAll(() => visited.close());
  afterEach(async () => {
    const all = complaints;
    complaints = [];
    await Promise.all(visited.browser.contexts().map((context) => context.close()));
    for (const of of all) expect(of).toEqual({ errors: [], requests: [] });
  });
  return {
    there: () => visited,
    async opened(hash, size) {
      const { page, complaints: of } = await open(visited, hash, size);
      complaints.push(of);
      return page;
    },
  };
}

/** Chooses an arm in the dialog, as a user does: a name, a joint string or a search. */
export async function chooseArm(page: Page, text: string): Promise<void> {
  if (!(await page.locator("dialog.arms").isVisible())) await page.locator("#arm").click();
  await page.locator("#arm-text").fill(text);
  await page.keyboard.press("Enter");
}

/** The name of the arm that is shown. */
export async function shownArm(page: Page): Promise<string | null> {
  return page.locator(".arm-name").textContent();
}

/** Opens the dialog with files of one's own. */
export async function ownFiles(page: Page): Promise<void> {
  await page.locator("#arm").click();
}

/** Presses a button of the dialog Share, which saves a file. */
export async function shared(page: Page, name: string): Promise<Download> {
  await page.getByRole("button", { name: "Share" }).click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name, exact: true }).click(),
  ]);
  await page.keyboard.press("Escape");
  return download;
}

/** Waits for the next pictures of the page: all that was to be drawn is drawn. */
export async function frames(page: Page, count = 2): Promise<void> {
  await page.evaluate(`(async () => {
    for (let i = 0; i < ${count}; ++i) await new Promise(requestAnimationFrame);
  })()`);
}

/** Evaluates in the page the body of a function of `data`: the pixels of the picture of a spatial arm, drawn again, of four
 * numbers each. */
export function ofPixels<Result>(page: Page, body: string): Promise<Result> {
  return page.evaluate(`new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
    const canvas = document.querySelector("#stage canvas");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    done((() => { ${body} })());
  })))`);
}

/** Where the picture shows the tool, in pixels of the window, once the tool is at rest there. */
export async function toolAt(page: Page): Promise<{ x: number; y: number }> {
  const stage = page.locator("#stage");
  const text = await page.evaluate(`new Promise((done) => {
    let [last, same] = ["", 0];
    const look = () => {
      const now = document.getElementById("stage").dataset.tool ?? "";
      same = now !== "" && now === last ? same + 1 : 0;
      last = now;
      if (same > 2) done(now);
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  })`);
  const [x = NaN, y = NaN] = String(text).split(",").map(Number);
  const box = await stage.boundingBox();
  return { x: x + (box?.x ?? NaN), y: y + (box?.y ?? NaN) };
}

/** The joint values that the panel shows. */
export async function jointValues(page: Page): Promise<number[]> {
  const all = await page.locator(".joints input[type=number]").all();
  return Promise.all(all.map(async (field) => Number(await field.inputValue())));
}

/** Drags with the mouse, in steps; the button is released unless it is to be held. */
export async function drag(
  page: Page,
  from: { x: number; y: number },
  to: { x: number; y: number },
  release = true,
): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 8 });
  if (release) await page.mouse.up();
}

const axeScript = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** What axe finds wrong. What it finds right is not described, which takes as long. */
export async function axe(page: Page): Promise<string[]> {
  if (!(await page.evaluate("'axe' in window"))) await page.evaluate(axeScript);
  return page.evaluate(
    `axe.run({ resultTypes: ["violations"] }).then(({ violations }) =>
      violations.map((one) => one.id + ": " + one.nodes.map((n) => n.html).join(" ").slice(0, 300)))`,
  );
}

/** From pixels of the drawing of a planar arm to metres, by the numbers of its axes. */
export async function toWorld(page: Page): Promise<(pixel: number[]) => number[]> {
  const [x, y] = await Promise.all(
    (["x", "y"] as const).map(async (axis) => {
      const texts = page.locator(`.axes text[data-axis=${axis}]`);
      const ticks = await texts.evaluateAll(
        (all, axis) =>
          all.map((text) => [Number((text.textContent ?? "").replace("−", "-")), Number(text.getAttribute(axis))]),
        axis,
      );
      const [[v1 = 0, p1 = 0], [v2 = 1, p2 = 1]] = [ticks[0] ?? [], ticks.at(-1) ?? []];
      const shift = axis === "y" ? 4 : 0; // of the text below its tick
      return (pixel: number): number => v1 + ((pixel - (p1 - shift)) * (v2 - v1)) / (p2 - p1);
    }),
  );
  return ([px = NaN, py = NaN]) => [x?.(px) ?? NaN, y?.(py) ?? NaN];
}

/** A touch of one or more fingers, each from a point to another, in steps. */
export async function touch(
  page: Page,
  ...fingers: [{ x: number; y: number }, { x: number; y: number }][]
): Promise<void> {
  const session = await page.context().newCDPSession(page);
  const send = (type: string, touchPoints: object[]): Promise<unknown> =>
    session.send("Input.dispatchTouchEvent" as never, { type, touchPoints } as never);
  const steps = 6;
  for (let i = 0; i <= steps; ++i) {
    const points = fingers.map(([a, b], id) => ({
      id,
      x: a.x + ((b.x - a.x) * i) / steps,
      y: a.y + ((b.y - a.y) * i) / steps,
    }));
    await send(i === 0 ? "touchStart" : "touchMove", points);
    await frames(page, 1);
  }
  await send("touchEnd", []);
  await session.detach();
}
