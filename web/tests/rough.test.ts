import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { deflateRawSync } from "node:zlib";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { chooseArm, frames, pages } from "./browser.js";

const { opened, there } = pages();

async function joints(page: Page): Promise<number> {
  return page.locator(".joints .joint").count();
}

const bomb = deflateRawSync(Buffer.alloc(50_000_000)).toString("base64url");

test.each([
  ["#arm=pnada", "pnada"],
  ["#json=garbage", "arm.json"],
  [`#json=${bomb}`, "arm.json"],
  [`#json=${deflateRawSync("[".repeat(100_000)).toString("base64url")}`, "arm.json"],
  [`#arm=${"R".repeat(100_000)}`, "joint"],
])("an address whose arm is refused (%#) gives the reason and shows another arm", async (hash, reason) => {
  const page = await opened(hash);
  expect(await page.getByRole("alert").textContent()).toContain(reason);
  expect(await joints(page)).toBe(3);
});

test.each([
  "#arm=rrr&q=NaN,1,Infinity&gain=NaN&section=lesson&frame=x&waypoints=1,2;3",
  "#arm=rrr&q=1e308,-1e308,1e300&gain=1e300",
  "#arm=rrr&q=1,2&goal=1,2,3,4,5",
  `#arm=rrr&q=${"1,".repeat(50_000)}1`,
  "#arm=RP:1e3,1e3&q=1,1e308",
])("an address with wrong numbers (%#) is read as far as it makes sense", async (hash) => {
  const page = await opened(hash);
  expect(await joints(page)).toBe(hash.includes("RP") ? 2 : 3);
  for (const section of ["Control", "Line", "Pose"]) await page.getByRole("link", { name: section }).click();
  expect(await page.getByLabel("Pose of the tool").textContent()).not.toContain("NaN");
});

test("after a refusal the address and the buttons belong to the arm that is shown", async () => {
  const page = await opened("#arm=rrr&q=0.1,0.2,0.3");
  await chooseArm(page, "pnada");
  await expect.poll(() => page.getByRole("alert").textContent()).toContain("pnada");
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Settings" }).click();
  await page.getByLabel("radians").check();
  await page.keyboard.press("Escape");
  await expect.poll(() => page.getByLabel("joint1, rad", { exact: true }).inputValue()).toBe("0.1000");
  await expect.poll(() => page.url()).toContain("arm=rrr&q=0.1,0.2,0.3&unit=rad");
});

test("arms and sections changed while a command runs leave nothing of the arm before", async () => {
  const poses = "-0.5,0.2,0.3,0,1,0,0;-0.5,-0.2,0.3,0,1,0,0";
  const page = await opened(`#arm=ur5&section=line&waypoints=${poses}`);
  await page.evaluate("location.hash = '#arm=rrr&section=control&q=0.4,0.9,0.6&goal=1.4,-0.6,0.9'");
  await page.getByRole("button", { name: "Go in joint space" }).click();
  await page.evaluate("location.hash = '#arm=panda&section=control'");
  await page.evaluate("location.hash = '#arm=RRP:1,1,1&section=hold'");
  await expect.poll(() => joints(page)).toBe(3);
  const list = page.getByLabel("Inverse kinematics").locator("li button");
  await list.first().waitFor();
  expect((await list.first().textContent())?.split(", ").length).toBe(3);
  await page.getByRole("link", { name: "Control" }).click();
  await expect
    .poll(() => page.locator(".runs").textContent())
    .toMatch(/^Joint space, eq. 1.3: .*Cartesian space, eq. 1.6: /);
  expect(await page.locator(".runs li").count()).toBe(2);
  await page.getByRole("link", { name: "Line" }).click();
  expect(await page.locator("button:visible", { hasText: "Cancel" }).count()).toBe(0);
  expect(await page.getByText("cancelled").count()).toBe(0);
});

test("without WebAssembly exceptions the page says which browsers have them", async () => {
  const context = await there().browser.newContext();
  const page = await context.newPage();
  await page.addInitScript("WebAssembly.validate = () => false");
  await page.goto(there().address);
  await page.getByRole("alert").getByText("exceptions").waitFor();
});

test("twenty arms, one after another, leave no picture's context behind", async () => {
  const page = await opened("#arm=rrr");
  const warnings: string[] = [];
  page.on("console", (message) => warnings.push(message.text()));
  for (let i = 0; i < 20; ++i) {
    const arm = i % 2 === 0 ? "URR:1,1,1" : "RRU:1,1,1";
    await page.evaluate((arm) => (location.hash = `#arm=${arm}`), arm);
    await page.locator(".arm-name", { hasText: arm }).waitFor();
    expect(await joints(page)).toBe(4);
  }
  expect(warnings.filter((text) => text.includes("Too many active WebGL contexts"))).toEqual([]);
});

test("a value beyond a limit becomes the limit, in the field too", async () => {
  const page = await opened("#arm=panda");
  const field = page.locator("#joint-0");
  await field.fill("999");
  await field.press("Enter");
  await expect
    .poll(() => field.inputValue())
    .toBe(await field.evaluate((input) => Number(input.getAttribute("max")).toFixed(2)));
});

test.each(["RRR:1e-6,1e-6,1e-6", "RRR:1e3,1e3,1e3", "RRR:0,0,0", "RP", "PPP"])("%s is shown", async (arm) => {
  const page = await opened(`#arm=${arm}&frames=1&solutions=1`);
  await expect.poll(() => joints(page)).toBeGreaterThan(1);
  await expect.poll(() => page.getByLabel("Inverse kinematics").getByRole("status").textContent()).not.toBe("");
});

test.each([
  ["wrong.csv", "a,b\n1,2\n", 'column "t" is missing'],
  ["cell.csv", "t,joint1,joint2,joint3\n0,1,,2\n", "motion.csv:2"],
  ["back.csv", "t,joint1,joint2,joint3\n1,1,1,2\n0,1,1,2\n", "times must increase"],
  ["none.json", "{", "motion.json"],
  ["other.csv", "t,joint1,joint2,joint3,joint4\n0,1,1,1,1\n1,1,1,1,1\n", "does not fit"],
  ["large.csv", "1,".repeat(10_500_000), "at most"],
])("the trajectory %s is refused with a reason", async (name, text, reason) => {
  const page = await opened("#arm=rrr&section=line");
  const folder = mkdtempSync(join(tmpdir(), "beeline-rough-"));
  try {
    writeFileSync(join(folder, name), text); // the browser reads a large file sooner than a message
    await page.getByLabel("A trajectory, CSV or JSON").setInputFiles(join(folder, name));
    await page.getByRole("status").getByText(reason).first().waitFor();
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test.each([
  ["binary.urdf", "\0\x01\xff", 1000],
  ["bomb.urdf", `<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">${"<!ENTITY b '&a;&a;'>".repeat(99)}]><robot name="&b;"/>`],
  ["50MB.urdf", " ", 50_000_000],
  ["ünïcode \"<b>&'.json", "{"],
  ["__proto__", "{}"],
])("the arm's file %s is refused with a reason", async (name, text, times = 1) => {
  const page = await opened("#arm=rrr");
  await page.evaluate(
    ({ name, text, times }) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text.repeat(times)], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer }));
    },
    { name, text, times },
  );
  await expect.poll(() => page.getByRole("alert").textContent()).not.toBe("");
  expect(await joints(page)).toBe(3);
});

test("a pose beyond all numbers is refused, and of two arms dropped the later is shown", async () => {
  const page = await opened("#arm=ur5");
  await expect.poll(() => joints(page)).toBe(6);
  const x = page.getByLabel("Pose of the tool").getByLabel("x", { exact: true });
  await expect.poll(() => x.inputValue()).not.toBe("");
  await x.fill("1e308");
  await x.press("Enter");
  await page.getByText("above 1e100 m").waitFor();
  await page.evaluate(`
    window.read = 0;
    const { text } = File.prototype;
    File.prototype.text = function () {
      return text.call(this).finally(() => ++window.read);
    };
    const drop = (name, text) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([text], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    };
    drop("first.json", " ".repeat(15_000_000) + "{}");
    drop("later.json", "[]");`);
  await page.getByText("later.json").first().waitFor();
  await page.waitForFunction("window.read === 3"); // each to see whether it is a scene, the later one as an arm
  await frames(page);
  expect(await page.getByText("first.json").count()).toBe(0);
});
