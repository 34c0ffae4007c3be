import { createServer, type Server } from "node:http";
import { readFile } from "node:fs/promises";
import { join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect } from "vitest";

const root = fileURLToPath(new URL("../../build/web", import.meta.url));
const types: Record<string, string> = {
  html: "text/html",
  js: "text/javascript",
  css: "text/css",
  wasm: "application/wasm",
};

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
    executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
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
  }, 60_000);
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
