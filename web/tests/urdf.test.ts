import { Euler, Matrix4, Quaternion, Vector3 } from "three";
import type { Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect, test } from "vitest";
import { open, visit, type Complaints, type Visit } from "./browser.js";
import { binaryStl, collada, obj, textStl, urdf } from "./meshes.js";
import { json } from "./native.js";

let there: Visit;
let watched: Complaints | null = null;
let page: Page | null = null;
beforeAll(async () => {
  there = await visit();
}, 60_000);
afterAll(() => there.close());
afterEach(async () => {
  if (watched) expect(watched).toEqual({ errors: [], requests: [] });
  watched = null;
  await page?.context().close();
});

async function opened(hash = ""): Promise<Page> {
  const visited = await open(there, hash);
  watched = visited.complaints;
  page = visited.page;
  return page;
}

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

const line = (page: Page) => page.locator(".chooser").getByRole("status");
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
    const items = await page.locator(".chooser li").allTextContents();
    expect(items.length).toBe(5);
    for (const item of items) {
      const [name = "", numbers = ""] = item.split(": x y z");
      const link = name.replace(/.* on /, "").replace("sensor", "fore");
      const matrix = links.find((one) => one.link === link)?.matrix.flat() ?? [];
      const frame = new Matrix4().set(...(matrix as Parameters<Matrix4["set"]>)).multiply(origins[name] as Matrix4);
      const turn = new Euler().setFromRotationMatrix(frame, "ZYX");
      const expected = [...new Vector3().setFromMatrixPosition(frame).toArray(), turn.x, turn.y, turn.z];
      const found =
        numbers
          .replaceAll("−", "-")
          .match(/-?\d+\.\d+/g)
          ?.map(Number) ?? [];
      expected.forEach((value, i) => expect(found[i]).toBeCloseTo(value, 3.9));
    }
  }
});

test("without meshes a URDF is drawn with shapes, and one line says what is missing; they can be dropped later", async () => {
  const page = await opened();
  const { "arm.urdf": arm, ...meshes } = everything;
  await drop(page, { "arm.urdf": arm });
  await line(page).getByText("Missing: base.stl, upper.dae, fore.obj, gone.stl, sensor.STL").waitFor();
  await drop(page, meshes);
  await line(page).getByText("5 meshes. Missing: gone.stl.").waitFor();
  await page.locator("#arm-text").fill("panda");
  await expect.poll(() => page.locator(".joints .joint").count()).toBe(7);
  expect(await line(page).textContent()).toBe("");
  await drop(page, meshes);
  await page.getByRole("alert").getByText("drop it with them").waitFor();
});

test("several files are chosen by keyboard as well", async () => {
  const page = await opened();
  const files = Object.entries(everything).map(([name, content]) => ({
    name,
    mimeType: "application/octet-stream",
    buffer: Buffer.from(content),
  }));
  await page.setInputFiles("#arm-file", files);
  await line(page).getByText("5 meshes.").waitFor();
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
  const page = await opened();
  await drop(page, { ...everything, [name]: content });
  await line(page).getByText(reason).waitFor();
  await page.locator("#joint-0").fill("20");
  await page.locator("#joint-0").press("Enter");
  await page.getByLabel("Inverse kinematics").getByRole("status").getByText("solution").waitFor();
});
