import { readFile } from "node:fs/promises";
import { createServer, type Server, type ServerResponse } from "node:http";
import type { AddressInfo } from "node:net";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, expect, test } from "vitest";
import { visit, type Visit } from "./browser.js";
import { run } from "./native.js";

const root = fileURLToPath(new URL("../../build/web", import.meta.url));
const types: Record<string, string> = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };

/** A server like `beeline view` behind a proxy, which answers `status` for the stream of joint values. */
const proxy = {
  status: 503,
  refused: 0,
  streams: new Set<ServerResponse>(),
  session: '{"arm": "{\\"name\\": \\"mine\\", \\"joint_string\\": \\"RRR:1,1,1\\"}", "trajectory": null}',
};
let there: Visit;
let server: Server;
beforeAll(async () => {
  there = await visit();
  server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://page");
    if (pathname === "/api/session") return void response.end(proxy.session);
    if (pathname === "/api/events") {
      response.writeHead(proxy.status, { "Content-Type": "text/event-stream" });
      if (proxy.status !== 200) return void (++proxy.refused, response.end());
      response.write(": open\n\n");
      proxy.streams.add(response);
      return void response.on("close", () => proxy.streams.delete(response));
    }
    const path = pathname === "/" ? "/index.html" : pathname;
    void readFile(join(root, path)).then((bytes) => {
      response.setHeader("Content-Type", types[path.split(".").at(-1) ?? ""] ?? "application/octet-stream");
      response.end(path === "/index.html" ? `${bytes}`.replace("<body", '<body data-session="api/session"') : bytes);
    });
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
});
afterAll(async () => {
  await there.close();
  server.closeAllConnections();
  server.close();
});

/** Keeps all sentences of the page about its stream in window.said: some are shown for a second only. */
const log = `
  window.said = [];
  new MutationObserver(() => {
    const text = document.querySelector(".live")?.textContent ?? "";
    if (text !== window.said.at(-1)) window.said.push(text);
  }).observe(document, { childList: true, characterData: true, subtree: true });`;

test("the page says why the stream is refused, and follows once it is not", async () => {
  const page = await there.browser.newPage();
  await page.addInitScript(log);
  const said = (text: string) => page.waitForFunction(`window.said.includes(${JSON.stringify(text)})`);
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
  await said("the server answers 503, next try in 1 s");
  await said("the server answers 503, next try in 2 s");
  proxy.status = 200;
  await expect.poll(() => proxy.streams.size).toBe(1);
  for (const stream of proxy.streams) stream.write('event: joints\ndata: {"q": [0.5, 0, 0]}\n\n');
  const shown = async (): Promise<number> => Number(await page.locator("#joint-0").inputValue());
  await expect.poll(shown).toBeCloseTo(90 / Math.PI, 1);
  await said("live");

  proxy.status = 502;
  for (const stream of proxy.streams) stream.destroy(); // the browser connects again, which is refused
  await said("the server answers 502, next try in 1 s");
  proxy.status = 200;
  await page.locator(".live").waitFor({ state: "hidden" });
  expect(errors).toEqual([]);
});

test("a session's arm keeps the shapes of its links, also under the name of a built-in arm", async () => {
  const { "arm.json": text = "" } = run(["show", "panda", "--out=arm.json"]).files;
  const shapes = [{ joint: "joint1", name: "thick", shapes: [{ sphere: { radius: 0.3 } }] }];
  const crate = { name: "crate", shapes: [{ box: { size: [0.1, 0.1, 0.1] }, pose: { xyz: [0.9, 0, 0.3] } }] };
  const arm = JSON.stringify({ ...(JSON.parse(text) as object), shapes });
  const scene = JSON.stringify({ obstacles: [crate] });
  proxy.session = JSON.stringify({ arm, trajectory: null, scene, clearance: 0.03 });
  proxy.status = 200;
  const page = await there.browser.newPage();
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
  await page.getByLabel("Nearest bodies").getByText("thick and crate").waitFor();
  expect(await page.locator(".arm-name").textContent()).toBe("panda");
  expect(await page.locator("#clearance").inputValue()).toBe("0.03");
  await page.close();
});
