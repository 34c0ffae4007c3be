import { maxBytes } from "../core/limits.js";
import type { PathFile } from "../scene/mesh_files.js";
import { DhForm } from "./dh_form.js";
import { droppedFiles, filesOf } from "./dropped.js";
import { element } from "./element.js";

/** Why a file is not read; null if it is. */
export function tooLarge(file: File): string | null {
  return file.size <= maxBytes ? null : `${file.name} has ${file.size} bytes; at most ${maxBytes} are read`;
}

/** Chooses the arm: a built-in one, a joint string, or a file (URDF or JSON), also one dropped on the page. */
export class ArmChooser {
  readonly root = element("section", { class: "chooser", "aria-label": "Arm" });
  private readonly message = element("p", { role: "alert", class: "refusal" });
  private readonly text: HTMLInputElement;
  private readonly opened: (files: PathFile[]) => void;

  constructor(
    builtIn: string[],
    private readonly chosen: (text: string) => void,
    opened: (files: PathFile[]) => void,
    typed: (json: string) => void,
    ...below: HTMLElement[]
  ) {
    const names = element("datalist", { id: "built-in" }, ...builtIn.map((value) => element("option", { value })));
    this.text = element("input", {
      id: "arm-text",
      list: "built-in",
      spellcheck: "false",
      autocomplete: "off",
      placeholder: "panda, or RRR:3.5,3.5,2",
    });
    const file = element("input", { type: "file", multiple: true, id: "arm-file" });
    const folder = element("input", { type: "file", webkitdirectory: true, id: "arm-folder" });
    for (const input of [file, folder]) {
      input.addEventListener("change", () => {
        const files = filesOf(input.files);
        input.value = ""; // the same file can be opened again after an edit
        if (files.length > 0) opened(files);
      });
    }
    const form = element(
      "form",
      {
        onsubmit: (event: Event) => {
          event.preventDefault();
          if (this.text.value.trim() !== "") this.chosen(this.text.value.trim());
        },
      },
      element("label", { for: "arm-text" }, "Arm: a name, or joints with lengths"),
      element("span", { class: "pair" }, this.text, element("button", {}, "Show")),
      element("label", { for: "arm-file" }, "or a file: URDF, with its meshes, or JSON"),
      file,
      names,
    );
    this.text.addEventListener("input", () => {
      if (builtIn.includes(this.text.value)) this.chosen(this.text.value);
    });
    const whole = element(
      "details",
      {},
      element("summary", {}, "or a folder"),
      element("label", { for: "arm-folder" }, "A folder with a URDF and its meshes; it can be dropped on the page too"),
      folder,
    );
    this.root.append(form, whole, new DhForm(typed).root, this.message, ...below);
    this.opened = opened;
  }

  /** Takes files that are dropped on `target`. */
  acceptDrops(target: HTMLElement): void {
    target.addEventListener("dragover", (event) => event.preventDefault());
    target.addEventListener("drop", (event) => {
      event.preventDefault();
      if (!event.dataTransfer) return;
      droppedFiles(event.dataTransfer).then(
        (files) => {
          if (files.length > 0) this.opened(files);
        },
        (error: unknown) => this.refuse(`What was dropped cannot be read: ${(error as Error).message}`),
      );
    });
  }

  show(name: string): void {
    if (document.activeElement !== this.text) this.text.value = name;
    this.message.textContent = "";
  }

  refuse(reason: string): void {
    this.message.textContent = reason;
  }
}
