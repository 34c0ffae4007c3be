import { element } from "../elements/element.js";
import { dialog } from "../elements/dialog.js";
import { icon } from "../elements/icons.js";
import type { PathFile } from "../scene/mesh_files.js";
import { DhForm } from "./dh_form.js";
import { droppedFiles, filesOf } from "./dropped.js";
import { Gallery, thumbnail, type ListedArm } from "./gallery.js";

const jointString = /^[RPHSCEU]{1,}(?::.*)?$/;

/** What the chooser calls. */
interface Chosen {
  /** A name or a joint string. */
  text(text: string): void;
  files(files: PathFile[]): void;
  /** A DH table as JSON. */
  table(json: string): void;
}

/** Chooses the arm in one dialog: a gallery with a search, a joint string, a file, a folder, a DH table; files can also
 * be dropped on the page. */
export class ArmChooser {
  /** Opens the dialog, and shows which arm it is. */
  readonly button = element("button", {
    type: "button",
    id: "arm",
    "aria-haspopup": "dialog",
    title: "Choose another arm",
  });
  readonly dialog: HTMLDialogElement;
  /** Why an arm is refused, in the page or in the dialog. */
  readonly notes = element("div", { class: "notes" });
  private readonly message = element("p", { role: "alert", class: "refusal" });
  private readonly question = element("div");
  private readonly text = element("input", {
    id: "arm-text",
    type: "text", // Escape closes the dialog; in a search field it would empty the field first
    spellcheck: "false",
    autocomplete: "off",
    placeholder: "kuka, 7 joints, or RRR:3.5,3.5,2",
  });
  private readonly gallery: Gallery;
  private readonly place = element("div");

  constructor(
    private readonly arms: ListedArm[],
    private readonly chosen: Chosen,
    ...below: HTMLElement[]
  ) {
    this.gallery = new Gallery(arms, (name) => chosen.text(name));
    this.text.addEventListener("input", () => this.gallery.search(this.text.value));
    const form = element(
      "form",
      { class: "search" },
      element("label", { for: "arm-text" }, "Search by name, maker or joints; or type joints with lengths"),
      element("span", { class: "pair" }, this.text, element("button", {}, "Show")),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.submit(this.text.value.trim());
    });
    this.dialog = dialog("Choose an arm", "arms", form, this.place, this.gallery.count, this.gallery.root, this.own());
    this.button.addEventListener("click", () => this.open());
    this.dialog.addEventListener("close", () => {
      if (this.message.className === "refusal") this.message.textContent = ""; // of what was typed there
      this.notes.prepend(this.message);
      this.notes.append(this.question);
    });
    this.notes.append(this.message, ...below, this.question);
  }

  open(): void {
    this.text.value = "";
    this.gallery.search("");
    this.place.append(this.message); // the page behind a dialog cannot be read
    this.message.textContent = "";
    this.dialog.showModal();
    this.text.focus();
  }

  /** Takes files that are dropped on `target`. */
  acceptDrops(target: HTMLElement): void {
    target.addEventListener("dragover", (event) => event.preventDefault());
    target.addEventListener("drop", (event) => {
      event.preventDefault();
      if (!event.dataTransfer) return;
      droppedFiles(event.dataTransfer).then(
        (files) => {
          if (files.length > 0) this.chosen.files(files);
        },
        (error: unknown) => this.refuse(`What was dropped cannot be read: ${(error as Error).message}`),
      );
    });
  }

  /** An arm is shown. */
  show(name: string): void {
    const listed = this.arms.find((arm) => arm.name === name);
    this.button.replaceChildren(
      ...(listed ? [thumbnail(listed)] : []),
      element("span", { class: "arm-name" }, name),
      icon("down"),
    );
    this.button.setAttribute("aria-label", `Arm ${name}: choose another`);
    this.message.textContent = "";
    if (this.dialog.open) this.dialog.close();
  }

  refuse(reason: string): void {
    this.say(reason, "refusal");
  }

  /** A sentence about the arm that is shown, or why another one is not. */
  say(text: string, tone: "quiet" | "refusal" = "quiet"): void {
    this.message.className = tone;
    this.message.textContent = text;
    if (text !== "" && this.dialog.open) this.place.scrollIntoView({ block: "nearest" });
  }

  /** Asks something about a file that was chosen: in the dialog while it is open, else in the page. */
  ask(question: HTMLElement): void {
    this.say("");
    this.question.replaceChildren(question);
    if (!this.dialog.open) return;
    this.place.append(this.question);
    this.place.scrollIntoView({ block: "nearest" });
  }

  /** A name, a joint string, or the first arm that fits a search. */
  private submit(text: string): void {
    if (text === "") return;
    const [first] = this.gallery.found(text);
    const isName = this.arms.some(({ name }) => name === text);
    this.chosen.text(isName || jointString.test(text) || !first ? text : first.name);
  }

  private own(): HTMLElement {
    const file = element("input", { type: "file", multiple: true, id: "arm-file" });
    const folder = element("input", { type: "file", webkitdirectory: true, id: "arm-folder" });
    for (const input of [file, folder]) {
      input.addEventListener("change", () => {
        const files = filesOf(input.files);
        input.value = ""; // the same file can be opened again after an edit
        if (files.length > 0) this.chosen.files(files);
      });
    }
    return element(
      "section",
      { class: "own", "aria-label": "Your own arm" },
      element("h3", {}, "Your own"),
      element(
        "p",
        { class: "quiet" },
        "Files and folders can be dropped on the page too. They do not leave this computer.",
      ),
      element("p", {}, element("label", { for: "arm-file" }, "A file: URDF, with its meshes, or JSON"), file),
      element("p", {}, element("label", { for: "arm-folder" }, "A folder with a URDF and its meshes"), folder),
      new DhForm((json) => this.chosen.table(json)).root,
    );
  }
}
