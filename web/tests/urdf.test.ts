import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Euler, Matrix4, Quaternion, Vector3 } from "three";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { axe, chooseArm, frames, ofPixels, ownFiles, pages, shared, toolAt } from "./browser.js";
import { binaryStl, collada, obj, textStl, urdf } from "./meshes.js";
import { json, run } from "./native.js";

const { opened, there } = pages();

/** Drops files on the page, as a mouse does. */
async function drop(page: Page, files: Record<string, Buffer | string>): Promise<void> {
  const all = Object.entries(files).map(([name, content]) => [name, Buffer.from(content).toString("base64")]);
  await page.evaluate((all) => {
    const transfer = new DataTransfer();
    for (const [name = "", content = ""] of all)
      transfer.items.add(new File([Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0))], name));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, all);
}

const line = (page: Page) => page.locator(".notes").getByRole("status");
const everything = {
  "arm.urdf": urdf,
  "base.stl": binaryStl(),
  "upper.dae": collada(),
  "fore.obj": obj(),
  "sensor.stl": textStl(),
};

function pose([x = 0, y = 0, z = 0]: number[], [roll = 0, pitch = 0, yaw = 0]: number[] = []): Matrix4 {
  const turn = new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
  return new Matrix4().compose(new Vector3(x, y, z), turn, new Vector3(1, 1, 1));
}

/** The largest difference between the numbers of a mesh in the page's list and its frame: its link's, turned by its origin. */
function distance(
  item: string,
  links: { link: string; matrix: number[][] }[],
  origins: Record<string, Matrix4>,
): number {
  const [name = "", numbers = ""] = item.split(": x y z");
  const link = name.replace(/.* on /, "").replace("sensor", "fore");
  const matrix = links.find((one) => one.link === link)?.matrix.flat() ?? [];
  const frame = new Matrix4().set(...(matrix as Parameters<Matrix4["set"]>)).multiply(origins[name] as Matrix4);
  const turn = new Euler().setFromRotationMatrix(frame, "ZYX");
  const expected = [...new Vector3().setFromMatrixPosition(frame).toArray(), turn.x, turn.y, turn.z];
  const found = numbers.replaceAll("−", "-").match(/-?\d+\.\d+/g) ?? [];
  expect(found.length).toBe(6);
  return Math.max(...expected.map((value, i) => Math.abs(value - Number(found[i]))));
}

test("meshes stand in the frame of their link times their visual's origin, as the native command has the links", async () => {
  const page = await opened("#unit=rad");
  await drop(page, everything);
  await line(page).getByText("5 meshes. Missing: gone.stl.", { exact: true }).waitFor();
  expect(await page.locator(".joints .joint").count()).toBe(3);
  await page.getByText("Frames of the 5 meshes").click();
  const origins: Record<string, Matrix4> = {
    "base.stl on base": pose([0.1, 0, -0.05], [0, 0, 0.5]),
    "upper.dae on upper": pose([0, 0.02, 0.1], [0.3, -0.2, 0.1]),
    "fore.obj on fore": pose([0, 0, 0]),
    "sensor.STL on sensor": pose([0.1, 0, 0.2], [0, 0.4, 0]).multiply(pose([0, 0, 0.03], [1.2, 0, 0])),
    "base.stl on tool0": pose([0, 0, 0.1]),
  };
  for (const q of [
    [0.3, -0.5, 0.1],
    [-1.2, 0.9, 0.25],
  ]) {
    for (const [i, value] of q.entries()) {
      await page.locator(`#joint-${i}`).fill(String(value));
      await page.locator(`#joint-${i}`).press("Enter");
    }
    const { links } = json<{ links: { link: string; matrix: number[][] }[] }>(
      ["fk", "arm.urdf", `--q=${q.join(",")}`, "--all"],
      { "arm.urdf": urdf },
    );
    await expect
      .poll(async () => {
        const items = await page.locator(".notes li").allTextContents();
        expect(items.length).toBe(5);
        return Math.max(...items.map((item) => distance(item, links, origins)));
      })
      .toBeLessThan(1e-4);
  }
});

test("without meshes a URDF is drawn with shapes, and one line says what is missing; they can be dropped later", async () => {
  const page = await opened("#arm=rrr");
  const { "arm.urdf": arm, ...meshes } = everything;
  await drop(page, { "arm.urdf": arm });
  await line(page).getByText("Missing: base.stl, upper.dae, fore.obj, gone.stl, sensor.STL").waitFor();
  await drop(page, meshes);
  await line(page).getByText("5 meshes. Missing: gone.stl.").waitFor();
  await chooseArm(page, "panda");
  await expect.poll(() => page.locator(".joints .joint").count()).toBe(7);
  expect(await line(page).count()).toBe(0);
  await drop(page, meshes);
  await page.getByRole("alert").getByText("drop it with them").waitFor();
});

const gripper = urdf.replaceAll("tool0", "palm");

test("a gripper has several ends: the page asks where the arm ends, and shows it as the native command does", async () => {
  const page = await opened("#unit=rad");
  await drop(page, { ...everything, "arm.urdf": gripper });
  await page.getByLabel("Where does the arm end?").selectOption("finger");
  await page.getByRole("button", { name: "End there" }).click();
  await line(page).getByText("5 meshes.").waitFor();
  const { dof } = json<{ dof: number }>(["show", "arm.urdf", "--tip", "finger"], { "arm.urdf": gripper });
  expect(await page.locator(".joints .joint").count()).toBe(dof);
  await chooseArm(page, "panda");
  await expect.poll(() => page.getByLabel("Where does the arm end?").isVisible()).toBe(false);
});

test("in the dialog the question stands in the dialog, without a refusal, with the ends that the command names", async () => {
  const page = await opened("#unit=rad");
  await ownFiles(page);
  const file = (name: string, text: string) => ({ name, mimeType: "text/xml", buffer: Buffer.from(text) });
  await page.setInputFiles("#arm-file", [file("arm.urdf", gripper), file("other.urdf", urdf)]);
  const dialog = page.locator("dialog.arms");
  const choice = dialog.getByLabel("Where does the arm end?");
  await choice.waitFor();
  expect(await page.locator(".refusal:visible").count()).toBe(0);
  expect(await page.getByText("arm.urdf is shown").count()).toBe(0);
  const links = await choice.locator("option").evaluateAll((all) => all.map((one) => one.getAttribute("value") ?? ""));
  for (const link of links)
    expect(run(["show", "arm.urdf", "--tip", link, "--json"], { "arm.urdf": gripper }).code).toBe(0);
  const refusal = run(["show", "arm.urdf"], { "arm.urdf": gripper }).stderr;
  for (const link of ["palm", "finger", "thumb", "sensor"])
    expect([links.includes(link), refusal]).toEqual([true, refusal]);
  await choice.selectOption("sensor");
  await dialog.getByRole("button", { name: "End there" }).click();
  await dialog.waitFor({ state: "hidden" });
  await page.getByText("arm.urdf is shown; not shown: other.urdf.").waitFor();
});

test("a saved page shows meshes too, from a disk and without a network", async () => {
  const page = await opened("#arm=rrr");
  const download = await shared(page, "One file");
  const folder = mkdtempSync(join(tmpdir(), "beeline-saved-"));
  await download.saveAs(join(folder, "beeline.html"));
  const context = await there().browser.newContext({ offline: true });
  const saved = await context.newPage();
  await saved.goto(`file://${folder}/beeline.html`);
  await saved.waitForSelector("#first", { state: "detached" });
  await drop(saved, everything);
  await line(saved).getByText("5 meshes.").waitFor();
  await context.close();
  rmSync(folder, { recursive: true });
});

test("several files are chosen by keyboard as well", async () => {
  const page = await opened("#arm=rrr");
  const files = Object.entries(everything).map(([name, content]) => ({
    name,
    mimeType: "application/octet-stream",
    buffer: Buffer.from(content),
  }));
  await page.setInputFiles("#arm-file", files);
  await line(page).getByText("5 meshes.").waitFor();
});

test("a folder with a URDF is chosen; meshes of one name are told apart by their folders", async () => {
  const page = await opened("#arm=rrr");
  const folder = mkdtempSync(join(tmpdir(), "beeline-urdf-"));
  const put = (path: string, content: Buffer | string): void => {
    mkdirSync(join(folder, "t", path, ".."), { recursive: true });
    writeFileSync(join(folder, "t", path), content);
  };
  put("package.xml", "<package/>");
  put("urdf/arm.urdf", urdf);
  put("meshes/base.stl", binaryStl());
  put("other/base.stl", "not this one");
  await ownFiles(page);
  await page.setInputFiles("#arm-folder", join(folder, "t"));
  await line(page).getByText("1 mesh. Missing: upper.dae, fore.obj, gone.stl, sensor.STL.").waitFor();
  await line(page).getByText("base.stl is not shown: it is no STL file, or cut off.").waitFor();
  await page.getByText("Frame of the mesh").click();
  await page.locator(".notes li", { hasText: "base.stl on base" }).waitFor();
  rmSync(folder, { recursive: true });
});

test.each([
  { width: 1200, height: 900 },
  { width: 360, height: 740 },
])("forms and lists that are opened are accessible and no wider than the screen, %o", async (size) => {
  const page = await opened("", size);
  await drop(page, everything);
  await line(page).getByText("5 meshes.").waitFor();
  for (const summary of await page.locator("#side details:not([open]) > summary:visible").all()) await summary.click();
  expect(await axe(page)).toEqual([]);
  await ownFiles(page);
  await page.getByText("A DH table").click();
  await page.getByRole("button", { name: "Show the arm" }).click();
  await page.getByRole("alert").getByText("convention").waitFor();
  const found = await axe(page);
  expect(found).toEqual([]);
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(size.width);
});

const broken = collada().subarray(0, 900);
const notNumbers = binaryStl();
notNumbers.writeFloatLE(NaN, 100);
test.each([
  ["upper.dae", broken, "upper.dae is not shown: it is no Collada file, or cut off."],
  ["upper.dae", "<COLLADA/>", "upper.dae is not shown: "],
  ["base.stl", binaryStl().subarray(0, 300), "base.stl is not shown: it is no STL file, or cut off."],
  ["base.stl", "", "base.stl is not shown: it is no STL file, or cut off."],
  ["base.stl", "solid", "base.stl is not shown: it is no STL file, or cut off."],
  ["base.stl", `solid ${"nothing ".repeat(20)}`, "base.stl is not shown: it has no triangles."],
  ["base.stl", notNumbers, "base.stl is not shown: a position in it is not a number."],
  ["fore.obj", Buffer.from([0, 1, 2, 255]), "fore.obj is not shown: it has no triangles."],
])("a mesh that cannot be read, %s %#, has one line, and the page lives on", async (name, content, reason) => {
  const page = await opened("#arm=rrr");
  await drop(page, { ...everything, [name]: content });
  await line(page).getByText(reason).waitFor();
  await page.locator("#joint-0").fill("20");
  await page.locator("#joint-0").press("Enter");
  await page.getByLabel("Inverse kinematics").getByRole("status").getByText("solution").waitFor();
});

/** Counts the pixels of the rendered picture that are black, which no colour of the page is, and those that differ from the
 * first picture without black ones that this was asked of. */
function counted(page: Page): Promise<{ black: number; changed: number }> {
  return ofPixels(
    page,
    `
    const count = { black: 0, changed: 0 };
    const before = window.kept ?? data;
    for (let i = 0; i < data.length; i += 4) {
      count.black += Number(data[i] + data[i + 1] + data[i + 2] === 0);
      count.changed += Number([0, 1, 2].some((k) => Math.abs(data[i + k] - before[i + k]) > 8));
    }
    if (count.black === 0) window.kept ??= data;
    return count;`,
  );
}

test("meshes are painted once their pictures are there; a link that they cover takes the colour of its joint under the mouse, and gives it back", async () => {
  const page = await opened("#unit=rad");
  await drop(page, everything);
  await line(page).getByText("5 meshes. Missing: gone.stl.", { exact: true }).waitFor();
  const tool = await toolAt(page);
  const box = await page.locator("#stage").boundingBox();
  const away = { x: (box?.x ?? 0) + 5, y: (box?.y ?? 0) + 5 };
  await page.mouse.move(away.x, away.y);
  await expect.poll(async () => (await counted(page)).black).toBe(0);
  const word = page.locator(".overlay .hint-text");
  const lit = new Map<string, number>();
  for (let k = 0; k < 60 && lit.size < 2; ++k) {
    const angle = (k % 12) * (Math.PI / 6);
    const radius = 40 + 30 * Math.floor(k / 12);
    await page.mouse.move(tool.x + radius * Math.cos(angle), tool.y + radius * Math.sin(angle));
    await frames(page);
    const name = (await word.textContent()) ?? "";
    if (/^\w+$/.test(name) && !/^[xyz]$|^tool$/.test(name)) lit.set(name, (await counted(page)).changed);
  }
  expect(lit.size).toBe(2);
  for (const count of lit.values()) expect(count).toBeGreaterThan(200);
  await page.mouse.move(away.x, away.y);
  await expect.poll(async () => (await counted(page)).changed).toBe(0);
});
