import { addressOf, longestAddress } from "../address/address.js";
import { dialog } from "../elements/dialog.js";
import { element } from "../elements/element.js";
import { lessonOf } from "../lessons/lessons.js";
import { saveFile } from "../share/save_file.js";
import { pageAsDocument } from "../share/save_page.js";
import { helpWord, type LessonPart } from "./lesson_part.js";
import type { Services, Shown } from "./section.js";

/** Makes the frames of a page as high as what they hold; without it they scroll. */
const follower =
  '<script>addEventListener("message", ({ data, source }) => { if (data && data.beeline === "height" && Number.isFinite(data.height)) ' +
  'for (const frame of document.querySelectorAll("iframe")) if (frame.contentWindow === source) frame.height = data.height; ' +
  "});</script>";

const tooLong = "This is too long for a link. Use “One file”.";

/** Ways to pass on what is shown: a link, a picture, a drawing, the page as one file, a frame for other pages. */
export class ShareDialog {
  readonly root: HTMLDialogElement;
  private readonly link = element("input", { id: "share-link", readonly: true });
  private readonly frame = element("textarea", { id: "share-frame", readonly: true, rows: 3 });
  private readonly says = element("p", { role: "status", class: "quiet" });
  /** The part that is shared: the whole page, the lesson alone, or one of its parts. */
  private readonly part = element("select", { id: "share-part" });
  private readonly help = element("input", { type: "checkbox", id: "share-help", checked: true });
  private readonly choice: HTMLElement;
  /** Beside the buttons that copy. */
  private readonly copied: HTMLElement[] = [];

  constructor(
    private readonly services: Services,
    private readonly shown: () => Shown | null,
    private readonly parts: () => LessonPart[],
  ) {
    this.choice = element(
      "p",
      {},
      element("label", { for: "share-part" }, "Without the surroundings"),
      this.part,
      element("label", { for: "share-help" }, this.help, " with hints and solutions"),
    );
    for (const control of [this.part, this.help]) control.addEventListener("change", () => void this.write());
    const copy = (from: HTMLInputElement | HTMLTextAreaElement, what: string): HTMLElement => {
      const says = element("span", { role: "status", class: "good" });
      this.copied.push(says);
      const button = element(
        "button",
        { type: "button", onclick: () => void this.copy(from, what, says) },
        `Copy ${what}`,
      );
      return element("p", { class: "pair" }, button, says);
    };
    const save = (word: string, what: string, make: () => Promise<void>): HTMLElement =>
      element(
        "p",
        { class: "saver" },
        element("button", { type: "button", onclick: () => void this.save(word, make) }, word),
        element("span", { class: "quiet" }, what),
      );
    this.root = dialog(
      "Share",
      "small",
      this.choice,
      element("p", {}, element("label", { for: "share-link" }, "A link to what is shown"), this.link),
      copy(this.link, "link"),
      save("Picture", "A PNG of what is seen", () => this.savePicture()),
      save("Drawing", "An SVG as beeline draw makes it", () => this.saveDrawing()),
      save("One file", "The page with arm and core, which opens from a disk without a network", () => this.savePage()),
      element("p", {}, element("label", { for: "share-frame" }, "A frame for another page"), this.frame),
      copy(this.frame, "frame"),
      this.says,
    );
  }

  async open(): Promise<void> {
    const isLesson = this.services.store.get().section === "lessons";
    this.choice.hidden = !isLesson;
    const choices: LessonPart[] = [
      { name: "", title: "no, the whole page" },
      { name: "lesson", title: "the lesson" },
      ...(isLesson ? this.parts() : []),
    ];
    this.part.replaceChildren(...choices.map(({ name, title }) => element("option", { value: name }, title)));
    await this.write();
    this.root.showModal();
  }

  /** The link and the frame of what is chosen. A part of a lesson begins as the lesson does. */
  private async write(): Promise<void> {
    for (const place of [this.says, ...this.copied]) place.textContent = "";
    const state = this.services.store.get();
    const only = this.part.value;
    const lesson = lessonOf(state.lesson);
    const alone = `section=lessons&lesson=${lesson.id}&only=${only}${helpWord(this.help.checked)}`;
    const hash = only === "" ? await addressOf(state) : alone;
    this.help.disabled = only === "";
    const address = location.href.replace(/#.*|$/, () => `#${hash}`);
    const fits = hash.length <= longestAddress;
    this.link.value = fits ? address : tooLong;
    const part = only === "lesson" ? lesson.title : (this.part.selectedOptions[0]?.textContent ?? "");
    const title = `Beeline: ${only === "" ? (this.shown()?.description.name ?? "") : part}`.replace(/[&"<>]/g, "");
    const source = address.replaceAll("&", "&amp;").replaceAll('"', "&quot;");
    this.frame.value = fits
      ? `<iframe src="${source}" title="${title}" width="100%" height="640" allow="clipboard-write" style="border: 0">` +
        `</iframe>${only === "" ? "" : follower}`
      : tooLong;
  }

  private async copy(from: HTMLInputElement | HTMLTextAreaElement, what: string, says: HTMLElement): Promise<void> {
    from.select();
    for (const place of this.copied) place.textContent = "";
    try {
      await navigator.clipboard.writeText(from.value);
      says.textContent = `${what === "link" ? "Link" : "Frame"} copied`;
    } catch {
      says.textContent = `The ${what} is selected: copy it with Ctrl C.`;
    }
  }

  private async save(word: string, make: () => Promise<void>): Promise<void> {
    this.says.textContent = "";
    try {
      await make();
    } catch (error) {
      this.says.textContent = `${word} is not saved: ${(error as Error).message}`;
    }
  }

  private async savePicture(): Promise<void> {
    const blob = await this.shown()?.picture.image();
    if (!blob) throw new Error("there is no picture");
    saveFile("arm.png", blob);
  }

  /** What `beeline draw` draws of the arm as it stands. */
  private async saveDrawing(): Promise<void> {
    const { q, showFrames, showColumns } = this.services.store.get();
    const viewer = this.shown()?.picture.viewer();
    const options = [
      ...(showFrames ? ["--frames"] : []),
      ...(showColumns ? ["--jacobian"] : []),
      ...(viewer ? [`--azimuth=${viewer.azimuth}`, `--elevation=${viewer.elevation}`] : []),
    ];
    const args = ["draw", "arm.json", `--q=${(q ?? []).join(",")}`, "--out=arm.svg", ...options];
    const { refusal, files } = await this.services.inScene(args);
    const drawing = files["arm.svg"];
    if (drawing === undefined) throw new Error(refusal);
    saveFile("arm.svg", new Blob([drawing], { type: "image/svg+xml" }));
  }

  /** One file that holds the page, the core and the arm. */
  private async savePage(): Promise<void> {
    const text = await pageAsDocument(await addressOf(this.services.store.get()));
    saveFile("beeline.html", new Blob([text], { type: "text/html" }));
  }
}
