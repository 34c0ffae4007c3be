import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { expect, test } from "vitest";
import { axe, chooseArm, frames, pages, shared, shownArm } from "./browser.js";
import { json } from "./native.js";
import { stepsOfProportional } from "./settling.js";

interface Fk {
  pose: { translation: number[]; quaternion: number[] | Record<string, number> };
}

const { opened, there } = pages();

function numbers(text: string | null): number[] {
  return (
    (text ?? "")
      .replaceAll("−", "-")
      .match(/-?\d+\.\d+/g)
      ?.map(Number) ?? []
  );
}

test("the pose in the panel equals the command line's", async () => {
  const q = [0.3, -1.1, 1.4, -0.7, 0.9, 0.2];
  const page = await opened(`#arm=ur5&q=${q.join(",")}&unit=rad`);
  const { pose } = json<Fk>(["fk", "ur5", `--q=${q.join(",")}`]);
  const panel = page.getByLabel("Pose of the tool");
  const shown = await Promise.all(
    ["x", "y", "z"].map(async (name) => Number(await panel.getByLabel(name, { exact: true }).inputValue())),
  );
  pose.translation.forEach((value, i) => expect(Math.abs(value - (shown[i] ?? NaN))).toBeLessThan(6e-5));
});

test("the Jacobian in the panel equals the command line's, in each frame", async () => {
  const q = [0.3, -1.1, 1.4, -0.7, 0.9, 0.2];
  const page = await opened(`#arm=ur5&q=${q.join(",")}`);
  for (const frame of ["base", "tool", "space"]) {
    await page.getByLabel("Frame of the Jacobian").selectOption(frame);
    const rows = page.getByRole("region", { name: "Table of the Jacobian" }).locator("tbody td");
    const shown = numbers((await rows.allTextContents()).join(" "));
    const { jacobian } = json<{ jacobian: number[][] }>(["jacobian", "ur5", `--q=${q.join(",")}`, "--frame", frame]);
    jacobian.flat().forEach((value, i) => expect(Math.abs(value - (shown[i] ?? NaN))).toBeLessThan(6e-3));
  }
});

test("a slider moves its joint, by keyboard, and the address follows", async () => {
  const page = await opened("#arm=rrr&q=0.1,0.2,0.3");
  const slider = page.getByLabel("joint2, degrees, slider");
  await slider.focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
  await expect
    .poll(() => Number(new URL(page.url().replace("#", "?")).searchParams.get("q")?.split(",")[1]))
    .not.toBe(0.2);
  const { searchParams } = new URL(page.url().replace("#", "?"));
  expect(searchParams.get("q")?.split(",")[0]).toBe("0.1");
});

test("all solutions are listed as the command line finds them; a click goes there", async () => {
  const q = [0.3, -1.1, 1.4, -0.7, 0.9, 0.2];
  const page = await opened(`#arm=ur5&q=${q.join(",")}&solutions=1`);
  const list = page.getByLabel("Inverse kinematics").locator("li button");
  await list.first().waitFor();
  const { pose } = json<{ pose: { matrix: number[][] } }>(["fk", "ur5", `--q=${q.join(",")}`]);
  expect(pose.matrix.length).toBe(4);
  expect(await list.count()).toBe(8);
  const wanted = numbers(await list.nth(3).textContent());
  const before = await list.allTextContents();
  await list.nth(3).click();
  await expect
    .poll(async () => Number(await page.getByLabel("joint1, degrees", { exact: true }).inputValue()))
    .toBeCloseTo(wanted[0] ?? NaN, 0);
  expect(await list.nth(3).getAttribute("aria-current")).toBe("true");
  await frames(page, 30); // the list would be asked for again in this time
  expect(await list.allTextContents()).toEqual(before);
  expect(await page.locator('.solutions [aria-current="true"]').count()).toBe(1);
});

test("zero has no sign", async () => {
  const page = await opened("#arm=RRP:1,1,1&q=-0.00000001,-0.00000001,-0.00000001");
  const shown = await page
    .locator(".arm-panel input[type=number]")
    .evaluateAll((all) => all.map((one) => (one as unknown as { value: string }).value));
  expect(shown.length).toBe(6);
  for (const text of shown) expect(text).not.toMatch(/^[-−]0\.?0*$/);
});

test("a link shows the same arm in the same configuration in a fresh profile", async () => {
  const first = await opened("#arm=RRP:1,0.5,0.2&q=0.25,-0.5,0.125&unit=rad&frames=1");
  await first.getByLabel("joint1, rad", { exact: true }).fill("0.75");
  await first.getByLabel("joint1, rad", { exact: true }).press("Enter");
  await expect.poll(() => first.url()).toContain("q=0.75,-0.5,0.125");
  const second = await opened(new URL(first.url()).hash);
  for (const [i, value] of [0.75, -0.5, 0.125].entries()) {
    const field = second.locator(`#joint-${i}`);
    expect(Number(await field.inputValue())).toBeCloseTo(value, 4);
  }
  expect(await second.getByRole("button", { name: "Frames" }).getAttribute("aria-pressed")).toBe("true");
});

test("an arm from a file is shown, and its link holds it whole", async () => {
  const page = await opened("");
  const arm = { name: "mine", joint_string: "RRR:1,1,0.5" };
  await page.setInputFiles("#arm-file", {
    name: "mine.json",
    mimeType: "application/json",
    buffer: Buffer.from(JSON.stringify(arm)),
  });
  await expect.poll(() => shownArm(page)).toBe("mine");
  await expect.poll(() => page.url()).toContain("json=");
  const second = await opened(new URL(page.url()).hash);
  expect(await shownArm(second)).toBe("mine");
  expect(await second.locator(".joints .joint").count()).toBe(3);
});

test("a truncated URDF and a wrong name give a reason, and the page lives on", async () => {
  const page = await opened("#arm=rrr");
  const refusal = page.getByRole("alert");
  const urdf = '<robot name="a"><link name="b"/><joint name="j" type="revolute"><parent link="b"/>';
  await page.setInputFiles("#arm-file", { name: "cut.urdf", mimeType: "text/xml", buffer: Buffer.from(urdf) });
  await expect.poll(() => refusal.textContent()).toContain("cut.urdf");
  await chooseArm(page, "pnada");
  await expect.poll(() => refusal.textContent()).toContain("panda");
  await chooseArm(page, "puma560");
  await expect.poll(() => page.locator(".joints .joint").count()).toBe(6);
});

test("joint-space and Cartesian control both reach the goal", async () => {
  const page = await opened("#arm=rrr&q=0.4,0.9,0.6&section=control&goal=1.4,-0.6,0.9&gain=0.1");
  const steps = stepsOfProportional(0.1);
  for (const title of ["Joint space, eq. 1.3", "Cartesian space, eq. 1.6"])
    await page.getByText(`${title}: error below 2 % after ${steps} steps, and the goal is reached.`).waitFor();
});

test("a line is planned, proved and played, with its branches", async () => {
  const poses = "-0.5,0.2,0.3,0,1,0,0;-0.5,-0.2,0.3,0,1,0,0";
  const page = await opened(`#arm=ur5&q=-0.1,-1.2,1.8,-2.2,-1.57,0&section=line&waypoints=${poses}`);
  await page.getByText("reached").first().waitFor();
  const file = `x,y,z,qw,qx,qy,qz\n${poses.replace(";", "\n")}\n`;
  interface Line {
    deviation_bound: number;
    branches: { status: string; reason: string; path_parameter: number; limit_margin: number }[];
    duration: number;
  }
  const args = ["line", "ur5", "--through=poses.csv", "--rate=100"];
  const native = json<Line>([...args, "--branches"], { "poses.csv": file });
  const proved = await page.locator("table", { hasText: "Deviation" }).locator("tbody tr").first().textContent();
  const [, number = "", unit = ""] = /([\d.]+) (nm|µm|mm)$/.exec(proved ?? "") ?? [];
  const bound = Number(number) * { nm: 1e-9, µm: 1e-6, mm: 1e-3 }[unit as "nm" | "µm" | "mm"];
  expect(bound).toBeGreaterThan(0.3 * native.deviation_bound);
  expect(bound).toBeLessThan(3 * native.deviation_bound + 1e-10); // rounded up
  await expect.poll(() => page.getByRole("button", { name: /^Branch \d/ }).count()).toBe(native.branches.length);
  const rows = page.getByLabel("Branches").locator("li");
  for (const [i, branch] of native.branches.entries()) {
    const text = (await rows.nth(i).textContent()) ?? "";
    if (branch.status === "reached") expect(numbers(text + ".0")[0] ?? 0).toBeGreaterThanOrEqual(1);
    else expect(text).toContain(`after ${(100 * branch.path_parameter).toFixed(0)} % of the path. `);
  }
  await page.getByRole("button", { name: "Branch 2", exact: true }).click();
  await page.getByRole("button", { name: "Branch 2", exact: true, pressed: true }).waitFor();
  await page.getByText("Save motion.csv").waitFor();
  await expect.poll(() => rows.count()).toBe(native.branches.length);
});

test("waypoints come from a file of poses; a wrong row is named", async () => {
  const page = await opened("#arm=rrr&section=line");
  await page.getByText("Waypoints from a file").click();
  const load = page.getByLabel("Waypoints from a file");
  const give = (text: string) =>
    load.setInputFiles({ name: "poses.csv", mimeType: "text/csv", buffer: Buffer.from(text) });
  await give("x,y,theta\n4.5,5.2,0\n5.6,2\n");
  await page.getByText("poses.csv:3").waitFor();
  const text = "x,y,theta\n4.5,5.2,0\n5.6,2,-1.3\n";
  await give(text);
  await page.getByRole("button", { name: "Branch 1", exact: true, pressed: true }).waitFor();
  const native = json<{ duration: number }>(["line", "rrr", "--through=p.csv", "--rate=100"], { "p.csv": text });
  const end = Number(await page.getByLabel("Time, seconds").getAttribute("max"));
  expect(Math.abs(end - native.duration)).toBeLessThan(1e-6);
});

test("a motion recorded by hand is played, retimed, and saved as CSV and JSON that the command reads", async () => {
  const page = await opened("#arm=cr5&unit=rad&q=0.1,-1.2,1.5,-0.4,0.8,0.2&section=line");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  await page.getByRole("link", { name: "Pose" }).click();
  const light = page.getByRole("button", { name: "Recording: stop" });
  const slider = page.getByLabel("joint1, rad, slider");
  for (let i = 0; i < 20; ++i) await slider.press("ArrowRight");
  const end = Number(await page.locator("#joint-0").inputValue());
  await light.click();
  const saved = async (name: string): Promise<string> => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: `Save ${name}` }).click(),
    ]);
    return readFileSync(await download.path(), "utf8");
  };
  const csv = await saved("motion.csv");
  const rows = csv.trim().split("\n");
  expect(rows[0]).toBe("t,joint1,joint2,joint3,joint4,joint5,joint6");
  expect(rows.length).toBeGreaterThan(10);
  expect(rows[1]?.split(",").slice(1).map(Number)).toEqual([0.1, -1.2, 1.5, -0.4, 0.8, 0.2]);
  expect(Math.abs(Number(rows.at(-1)?.split(",")[1]) - end)).toBeLessThan(1e-4);
  const recorded = json<{ samples: number }>(["replay", "cr5", "motion.json"], {
    "motion.json": await saved("motion.json"),
  });
  expect(recorded.samples).toBe(rows.length - 1);
  await page.getByRole("button", { name: "Retime within the limits" }).click();
  await page.getByText("reached").waitFor();
  const native = json<{ duration: number }>(["retime", "cr5", "motion.csv"], { "motion.csv": csv });
  await expect
    .poll(async () => Number(await page.getByLabel("Time, seconds").getAttribute("max")))
    .toBeCloseTo(native.duration, 6);
});

test("a JSON trajectory is played; wrong files are refused with their rows", async () => {
  const page = await opened("#arm=rrr&unit=rad&section=line");
  const load = page.getByLabel("A trajectory, CSV or JSON");
  const give = (name: string, text: string) =>
    load.setInputFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
  const point = (time: string, q: number[]) =>
    `{"positions": [${q.join(",")}], "time_from_start": {"sec": ${time}, "nanosec": 0}}`;
  const names = '["joint1", "joint2", "joint3"]';
  await give(
    "a.json",
    `{"joint_names": ${names}, "points": [${point("0", [0, 0, 0])}, ${point("2", [0.1, 0.2, 0.3])}]}`,
  );
  await expect.poll(() => page.getByLabel("Time, seconds").getAttribute("max")).toBe("2");
  for (const [text, reason] of [
    ["t,joint1,joint2,joint3\n1,0,0,0\n0,0,0,0\n", "times must increase"],
    ["t,joint1,joint2,joint3\n0,0,0,0\n1,nan,0,0\n", "must be finite"],
    ["t,joint1,joint2,joint3\n0,0,0,0\n1,0,0\n", "this row has 3 items"],
    ["t,joint1,joint2\n0,0,0\n1,0,0\n", "it lacks joint3"],
    ["nonsense", "seconds, increasing"],
  ] as const) {
    await give("b.csv", text);
    await page.getByText(reason).waitFor();
    expect(await page.getByRole("button", { name: "Save motion.csv" }).count()).toBe(0);
  }
  await give("c.csv", "t,joint1,joint2,joint3\n5,0,0,0\n6,0.5,0,0\n");
  await expect.poll(() => page.getByLabel("Time, seconds").getAttribute("min")).toBe("5");
});

test("joint curves stand beside their limits; a click on them goes to that time", async () => {
  const poses = "-0.5,0.2,0.3,0,1,0,0;-0.5,-0.2,0.3,0,1,0,0";
  const page = await opened(`#arm=ur5&unit=rad&section=line&waypoints=${poses}`);
  const curves = page.getByLabel("Joint curves beside their limits");
  await curves.getByRole("img").nth(5).waitFor();
  expect(await curves.getByRole("img").first().getAttribute("aria-label")).toContain("limits −6.28 to 6.28");
  const bar = page.getByLabel("Time, seconds");
  const end = Number(await bar.getAttribute("max"));
  await curves.getByRole("img").first().locator(".u-over").click();
  await expect.poll(async () => Math.abs(Number(await bar.inputValue()) / end - 0.5)).toBeLessThan(0.1);
  await page.getByLabel("Quantity of the joint curves").selectOption("velocity");
  await expect.poll(() => curves.getByRole("img").first().getAttribute("aria-label")).toContain("rad/s");
  expect(await curves.getByRole("img").first().getAttribute("aria-label")).toContain("limits −3.14 to 3.14");
});

test("the saved page opens from a disk, without a network, and computes", async () => {
  const page = await opened("#arm=RRP:1,0.5,0.2&q=0.25,-0.5,0.125&unit=rad");
  const download = await shared(page, "One file");
  const file = join(mkdtempSync(join(tmpdir(), "beeline-page-")), "beeline.html");
  await download.saveAs(file);
  const size = readFileSync(file).length;
  console.log(`the saved page has ${size} bytes`);
  // As .ci/run builds its modules, and as it is shipped.
  expect(size).toBeLessThan(process.env["BEELINE_WEB_QUICK"] === "ON" ? 10_300_000 : 5_300_000);
  const context = await there().browser.newContext({ offline: true });
  const saved = await context.newPage();
  const errors: string[] = [];
  saved.on("pageerror", (error) => errors.push(error.message));
  saved.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await saved.goto(`file://${file}`);
  await saved.waitForSelector("#first", { state: "detached" });
  expect(Number(await saved.locator("#joint-1").inputValue())).toBeCloseTo(-0.5, 4);
  await saved.getByText(/solutions?, /).waitFor(); // of the command, in its worker
  const again = await shared(saved, "One file");
  const second = `${file}.again.html`;
  await again.saveAs(second);
  expect(readFileSync(second).length / size).toBeCloseTo(1, 2); // its code stands in it once
  await saved.getByRole("link", { name: "Lessons" }).click(); // which the other page loads when they are opened
  await saved.getByRole("heading", { name: "Links and joints" }).waitFor();
  expect(errors).toEqual([]);
  rmSync(dirname(file), { recursive: true });
});

test.each([
  ["#arm=ur5", { width: 1200, height: 900 }, /8 solutions/],
  ["#arm=panda", { width: 360, height: 740 }, /Infinitely many solutions/],
  ["#arm=rrr&section=control", { width: 360, height: 740 }, /Cartesian space, eq. 1.6: .* and the goal is reached/],
  ["#arm=ur5&section=line", { width: 1200, height: 900 }, "Drag the tool to a pose"],
])("%s is accessible and no wider than the screen", async (hash, size, complete) => {
  const page = await opened(hash, size);
  await page.getByText(complete).waitFor();
  const found = await axe(page);
  expect(found).toEqual([]);
  const wide = await page.evaluate("document.documentElement.scrollWidth");
  expect(wide).toBeLessThanOrEqual(size.width);
});
