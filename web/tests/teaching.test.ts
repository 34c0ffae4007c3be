import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { codeOf } from "../src/lessons/results.js";
import { axe, jointValues, pages, shownArm } from "./browser.js";
import { run } from "./native.js";

const { there, opened } = pages();

/** The words that are on the screen, of what a reader could see. */
const visible = (page: Page): Promise<string> => page.locator("body").innerText();

test("a link shows an exercise without the surroundings, with the figure that it needs, and the whole page by a link", async () => {
  const page = await opened("#section=lessons&lesson=joint-control&only=gain", { width: 900, height: 700 });
  await page.getByRole("form", { name: "Exercise" }).waitFor();
  const words = await visible(page);
  expect(words).toContain("Figure 1.7");
  for (const outside of ["Contents", "Workspace", "Share", "Previous", "The simplest way to a goal"])
    expect(words).not.toContain(outside);
  const steps = await page.evaluate("history.length");
  await page.getByLabel("Gain Kp").fill("0.5");
  await page.getByRole("button", { name: "Check" }).click();
  await page.getByText("Right: 6 steps, and no overshoot.").waitFor();
  await expect.poll(() => page.url()).toContain("gain=0.5");
  expect(page.url()).toContain("only=gain");
  expect(await page.evaluate("history.length")).toBe(steps); // Back belongs to the page around it
  expect(await axe(page)).toEqual([]);
  const [whole] = await Promise.all([page.waitForEvent("popup"), page.getByRole("link", { name: "Lesson 6" }).click()]);
  await whole.getByRole("heading", { name: "Joint-space motion control" }).waitFor();
  await whole.getByText("lesson 6 of 16 · 0 done").waitFor(); // one of its exercises alone makes no tick
});

test("an exercise alone brings its arm, and with help=0 it has neither hints nor a solution", async () => {
  const page = await opened("#section=lessons&lesson=forward&only=rp&help=0", { width: 390, height: 844 });
  await expect.poll(() => shownArm(page)).toBe("rp");
  const form = page.getByRole("form", { name: "Exercise" });
  await form.getByLabel("x =").waitFor();
  expect(await form.locator("details").count()).toBe(0);
  const [picture, text] = await Promise.all([page.locator("#stage").boundingBox(), form.boundingBox()]);
  expect((picture?.y ?? NaN) + (picture?.height ?? NaN)).toBeLessThanOrEqual(text?.y ?? NaN);
  expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(390);
  expect(await jointValues(page)).toEqual([35, 1]); // its frames are apart
});

test("the exercise about the wrist brings the Puma whose wrist is singular, and its sliders show the answer", async () => {
  const page = await opened("#section=lessons&lesson=failures&only=wrist", { width: 900, height: 900 });
  await expect.poll(() => shownArm(page)).toBe("puma560");
  expect((await jointValues(page)).slice(3)).toEqual([0, 0, 0]);
  const pose = page.getByLabel("Pose of the tool").locator("input");
  const numbers = (): Promise<string[]> =>
    pose.evaluateAll((all) => all.map((one) => Number((one as HTMLInputElement).value).toFixed(2)));
  const before = await numbers();
  const turn = async (id: string, degrees: string): Promise<void> => {
    await page.locator(id).fill(degrees);
    await page.keyboard.press("Enter");
  };
  await turn("#joint-3", "30");
  await expect.poll(numbers).not.toEqual(before);
  await turn("#joint-5", "-30");
  await expect.poll(numbers).toEqual(before);
});

test("a part without help leads to pages without hints and solutions", async () => {
  const page = await opened("#section=lessons&lesson=cartesian&only=lesson&help=0");
  const follow = async (name: string): Promise<Page> => {
    const [other] = await Promise.all([page.waitForEvent("popup"), page.getByRole("link", { name }).click()]);
    return other;
  };
  const whole = await follow("Lesson 8");
  await whole.getByLabel("Angle", { exact: true }).waitFor();
  await whole.locator(".contents summary").waitFor();
  expect(await whole.locator(".exercise details").count()).toBe(0);
  await page.getByText("Sources of each statement").click();
  const errata = await follow("errata");
  await errata.getByRole("heading", { name: "Errata of the chapter" }).waitFor();
  expect(errata.url()).toContain("help=0");
  await errata.getByText("Computations for most entries: errata of the chapter (docs/errata.md)").waitFor(); // their computations
});

test("the exercise about a pose is judged for its arm only", async () => {
  const solution = "q=0.594284,1.698729,-1.507790";
  const right = await opened(`#arm=rrr&section=lessons&lesson=rrr&${solution}`);
  await right.getByText("Right: the tool is there.").waitFor();
  const other = await opened(`#arm=RRR:3.5,3.5,2.02&section=lessons&lesson=rrr&${solution}`);
  await other.getByText("Another arm is in the picture.").waitFor();
  await other.getByText("Figure 1.3").waitFor();
  expect(await visible(other)).not.toContain("Right: the tool is there.");
});

test("a figure alone brings its arm, where that is not the lesson's", async () => {
  const page = await opened("#section=lessons&lesson=definitions&only=1.2", { width: 800, height: 560 });
  await expect.poll(() => shownArm(page)).toBe("S");
  await page.getByRole("link", { name: "Helical (H)" }).click();
  await expect.poll(() => shownArm(page)).toBe("H");
});

test("a figure alone is played, and its links set the arm in place", async () => {
  const page = await opened("#section=lessons&lesson=jacobian&only=1.8", { width: 800, height: 560 });
  await page.getByRole("link", { name: "right: θ" }).click();
  await expect.poll(() => jointValues(page)).toEqual([161, -109, 38]);
  expect(page.url()).toContain("only=1.8");
  expect(await visible(page)).not.toContain("Come up");
});

test("a frame in a page of another site has the height of what it holds, needs no storage, and works with keys", async () => {
  const context = await there().browser.newContext({ viewport: { width: 900, height: 1000 } });
  await context.addInitScript(() => {
    Object.defineProperty(globalThis, "localStorage", {
      get() {
        throw new DOMException("storage is refused", "SecurityError");
      },
    });
  });
  const shared = await opened("#section=lessons&lesson=cartesian");
  await shared.getByLabel("Angle", { exact: true }).waitFor();
  await shared.getByRole("button", { name: "Share" }).click();
  await shared.getByLabel("Without the surroundings").selectOption("ominus");
  const field = shared.getByLabel("A frame for another page");
  await expect.poll(() => field.inputValue()).toContain("only=ominus");
  const copied = (await field.inputValue()).replace("127.0.0.1", "localhost").replace('height="640"', 'height="100"');
  const page = await context.newPage();
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(there().address.replace(/$/, "none"), { waitUntil: "commit" }).catch(() => null); // 404 of this server
  await page.setContent(`<h1>A course</h1>${copied}`);
  const frame = page.frameLocator("iframe");
  await frame.getByRole("form", { name: "Exercise" }).waitFor();
  const isWhole = async (): Promise<boolean> => {
    const inner = page.frames()[1];
    return inner?.evaluate(
      "document.documentElement.scrollHeight <= innerHeight && innerHeight > 200",
    ) as Promise<boolean>;
  };
  await expect.poll(isWhole).toBe(true);
  await page.evaluate(
    'addEventListener("message", ({ data }) => { if (data === "last") document.body.dataset.heard = "yes"; })',
  );
  const inner = page.frames()[1];
  await inner?.evaluate(
    'parent.postMessage({ beeline: "height", height: "9999" }, "*"); parent.postMessage("last", "*")',
  );
  await page.locator("body[data-heard]").waitFor();
  expect(await page.locator("iframe").getAttribute("height")).not.toBe("9999"); // no number
  const angle = frame.getByLabel("Angle", { exact: true });
  const hasFocus = (): Promise<boolean> => angle.evaluate((one) => one === document.activeElement);
  for (let i = 0; i < 40 && !(await hasFocus()); ++i) await page.keyboard.press("Tab");
  await page.keyboard.type("110");
  await page.keyboard.press("Enter");
  await frame.getByText("Right.").waitFor();
  await frame.getByText("Your results as a code · 1 solved").press("Enter");
  await expect.poll(() => frame.getByLabel("Code of your results").inputValue()).toMatch(/^beeline1-/);
  await expect.poll(isWhole).toBe(true); // it has grown
  expect(errors).toEqual([]);
});

test("Share makes links and frames of the parts of a lesson", async () => {
  const page = await opened("#section=lessons&lesson=forward&arm=rp");
  await page.getByLabel("x =").waitFor();
  await page.getByRole("button", { name: "Share" }).click();
  const part = page.getByLabel("Without the surroundings");
  const link = page.getByLabel("A link to what is shown");
  expect(await link.inputValue()).toContain("arm=rp");
  await part.selectOption("1.4");
  await expect.poll(() => link.inputValue()).toMatch(/#section=lessons&lesson=forward&only=1\.4$/);
  await part.selectOption("draw-rp");
  await page.getByLabel("with hints and solutions").uncheck();
  await expect.poll(() => link.inputValue()).toMatch(/&only=draw-rp&help=0$/);
  const frame = await page.getByLabel("A frame for another page").inputValue();
  expect(frame).toMatch(
    /^<iframe src="http[^"]*&amp;only=draw-rp&amp;help=0" title="Beeline: Exercise: Draw the arm RP/,
  );
  expect(frame).toContain('allow="clipboard-write"');
  expect(frame).toContain("<script>");
});

const lessonText = (name: string): string =>
  readFileSync(fileURLToPath(new URL(`../src/lessons/text/${name}`, import.meta.url)), "utf8");

test("the worksheet prints the exercises of the lessons, and solutions on sheets of their own", async () => {
  const page = await opened("#section=lessons&lesson=teachers");
  await page.evaluate("print = () => (document.body.dataset.printed = 'yes')");
  await page.getByLabel("A gantry carries").waitFor();
  await page.getByRole("button", { name: "None" }).click();
  for (const name of [
    "A gantry carries",
    "Bring the tool",
    "Draw the arm RP",
    "Now without looking up",
    "The tool of the arm RRR is to be",
  ])
    await page.getByLabel(name).check();
  await page.getByLabel("Solutions, on sheets of their own").check();
  await page.getByRole("button", { name: "Print the worksheet" }).click();
  await page.locator("body[data-printed]").waitFor();
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ width: 680, height: 900 }); // as wide as paper
  const words = (await visible(page)).replace(/\s+/g, " ");
  const asked = /```check string\n([\s\S]*?)\nhint:/.exec(lessonText("1_definitions.md"))?.[1] ?? "";
  expect(words).toContain(asked.replace(/\s+/g, " ")); // the text of the lesson
  expect(words).toContain("Find both configurations"); // for paper
  expect(words).toContain("The arm RRR has links of 3.5, 3.5 and 2. Its tool is to be at (5.5, 3.5), at 0°.");
  expect(words).toContain("joint 2 is at (0.71, 0.71)"); // the second drawing
  expect(words).not.toContain("or use the sliders");
  for (const outside of ["Workspace", "Share", "For teachers", "Hint 1"]) expect(words).not.toContain(outside);
  expect(words).toContain("PPP. None of its joints turns");
  const title = page.getByRole("heading", { name: "Serial-link manipulators: exercises" });
  expect((await title.boundingBox())?.width).toBeGreaterThan(200);
  expect(await page.locator(".worksheet img").count()).toBe(1); // Figure 1.6
  expect(await page.locator(".worksheet .board").count()).toBe(1);
  const sheets = await page.evaluate(
    `[...document.querySelectorAll(".worksheet article")].map((one) => one.innerText)`,
  );
  expect((sheets as string[])[0]).not.toContain("None of its joints");
  const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
  expect((pdf.match(/\/Type\s*\/Page\b/g) ?? []).length).toBeGreaterThanOrEqual(2);
  await page.emulateMedia({ media: "screen" });
  await page.evaluate("dispatchEvent(new Event('afterprint'))");
  await expect.poll(() => page.locator(".worksheet").count()).toBe(0);
});

test("a lesson itself prints as text", async () => {
  const page = await opened("#section=lessons&lesson=worked");
  await page.getByText("Figure 1.6").waitFor();
  await page.emulateMedia({ media: "print" });
  const words = await visible(page);
  expect(words).toContain("Multiply the three matrices out");
  for (const outside of ["Workspace", "Contents", "Play", "joint1", "Hint 1"]) expect(words).not.toContain(outside);
  expect(words).toContain("Write both matrices, multiply them"); // the exercise's wording for paper
  expect(words).not.toContain("Now without looking up");
});

test("a code that a student hands in is decoded, and its answers are checked again", async () => {
  const page = await opened("#section=lessons&lesson=definitions");
  await page.getByLabel("Joints", { exact: true }).fill("p p p");
  await page.keyboard.press("Enter");
  await page.getByText("Right: PPP.").waitFor();
  await page.getByText("Your results as a code · 1 solved").click();
  const field = page.getByLabel("Code of your results");
  await expect.poll(() => field.inputValue()).toMatch(/^beeline1-/);
  const code = await field.inputValue();
  await page.reload();
  await page.getByText("Your results as a code · 1 solved").waitFor(); // kept in this browser
  await page.locator(".contents summary").click();
  await page.getByRole("link", { name: "For teachers" }).click();
  const forged = await codeOf([
    { name: "elbow", answer: "45°", time: 0 },
    { name: "none", answer: "1", time: 0 },
    ...["__proto__", "valueOf", "hasOwnProperty"].map((name) => ({ name, answer: "1", time: 0 })),
  ]);
  const input = page.getByLabel("Codes, one a line");
  const wrapped = `${code.slice(0, 25)}\n${code.slice(25)}`;
  await input.fill(`Ada: ${code}\n${forged}\n${code.slice(0, -2)}\n\u200b"${code}", Grace\nAlan ${wrapped}`);
  await page.getByRole("button", { name: "Read the codes" }).click();
  const ada = page.getByRole("table", { name: "Ada: 1 solved" });
  await ada.getByRole("row", { name: /string, lesson 1 p p p 20\d\d-\d\d-\d\d \d\d:\d\d right/ }).waitFor();
  const other = page.getByRole("table", { name: "Code 2: 5 solved" });
  await other.getByRole("row", { name: "elbow, lesson 11 45° 1970-01-01 00:00 not right" }).waitFor();
  await other.getByRole("row", { name: "none 1 1970-01-01 00:00 unknown exercise" }).waitFor();
  for (const name of ["__proto__", "valueOf", "hasOwnProperty"])
    await other.getByRole("row", { name: `${name} 1 1970-01-01 00:00 unknown exercise` }).waitFor();
  for (const name of ["Grace", "Alan"]) await page.getByRole("table", { name: `${name}: 1 solved` }).waitFor();
  await page.getByText("Code 3: the code is cut off or changed.").waitFor();
  await page.getByText("More in the documentation: lessons in a course (docs/howto/course.md).").waitFor();
  expect(await axe(page)).toEqual([]);
});

test("a lesson that cannot be loaded is said where all exercises are needed", async () => {
  const context = await there().browser.newContext();
  await context.route(/15_redundant/, (route) => route.abort());
  const page = await context.newPage();
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(`${there().address}#section=lessons&lesson=teachers`);
  await page.getByText("The exercises cannot be loaded: reload the page.").waitFor();
  await page.getByRole("button", { name: "Read the codes" }).click();
  await page.getByText("The lessons cannot be loaded: read the codes again, or reload the page.").waitFor();
  expect(errors).toEqual([]);
  await context.close();
});

test("Remove results forgets them", async () => {
  const page = await opened("#section=lessons&lesson=redundant");
  await page.getByLabel("Joints", { exact: true }).fill("seven");
  await page.keyboard.press("Enter");
  await page.getByText("Your results as a code · 1 solved").click();
  await page.getByRole("button", { name: "Remove results" }).click();
  await page.getByText("Your results as a code · 0 solved").waitFor();
  await page.reload();
  await page.getByText("Your results as a code · 0 solved").waitFor();
});

test("the proof between samples follows the number of intervals", async () => {
  const page = await opened("#section=lessons&lesson=proof");
  await page.getByText("Bound 26.75 mm, proved. Largest sampled deviation 15.55 mm, 58 % of the bound.").waitFor();
  await page.getByLabel("Intervals", { exact: true }).first().fill("16");
  await page.getByText(/Bound [67]\.\d\d mm, proved/).waitFor();
  await expect.poll(() => page.locator(".proof-chart .bound").count()).toBe(16);
  const spoken = (await page.getByRole("img", { name: "Deviation from the line" }).getAttribute("aria-label")) ?? "";
  const [bounds = [], deviations = []] = [...spoken.matchAll(/: ([\d., ]+)/g)].map(([, row = ""]) => row.split(", "));
  expect([bounds.length, deviations.length]).toEqual([16, 16]);
  deviations.forEach((value, i) => expect(Number.parseFloat(value)).toBeLessThan(Number.parseFloat(bounds[i] ?? "")));
});

test("each figure of the chapter is also there as beeline figure draws it", async () => {
  const page = await opened("#section=lessons&lesson=describing");
  await page.getByText("As a drawing, like the chapter’s").click();
  const image = page.getByRole("img", { name: "Figure 1.5" });
  await image.waitFor();
  const { files } = run(["figure", "1.5", "--out=f.svg"]);
  const source = decodeURIComponent((await image.getAttribute("src")) ?? "");
  const words = (svg: string): string[] => [...svg.matchAll(/<text[^>]*>([^<]*)</g)].map(([, word = ""]) => word);
  expect(words(source)).toEqual(words(files["f.svg"] ?? ""));
  expect(words(source)).toContain("a₁");
});

test("on a phone a button leads from the text to the sliders and back", async () => {
  const page = await opened("#section=lessons&lesson=jacobian", { width: 390, height: 844 });
  await page.getByText("Figure 1.8").waitFor();
  const sheet = page.locator("#side");
  await sheet.evaluate((side) => side.scrollTo({ top: 200 }));
  await page.getByRole("button", { name: "Sliders" }).click();
  const slider = page.getByLabel("joint1, degrees, slider");
  const text = page.getByRole("button", { name: "Text", exact: true });
  for (const part of [slider, text])
    await expect
      .poll(async () => {
        const [box, row] = [await sheet.boundingBox(), await part.boundingBox()];
        return row !== null && box !== null && row.y >= box.y && row.y + row.height <= box.y + box.height;
      })
      .toBe(true);
  await text.click();
  await expect.poll(() => sheet.evaluate((side) => side.scrollTop)).toBe(200);
});
