import { mostBytes } from "../core/limits.js";
import { DhForm } from "./dh_form.js";
import { element } from "./element.js";

/** A file that was dropped or opened: its text under its name. */
export interface OpenedFile {
  name: string;
  text: string;
}

/** Why a file is not read; null if it is. */
export function tooLarge(file: File): string | null {
  return file.size <= mostBytes ? null : `${file.name} has ${file.size} bytes; at most ${mostBytes} are read`;
}

/** Chooses the arm: a built-in one, a joint string, or a file (URDF or JSON), also one dropped on the page. */
export class ArmChooser {
  readonly root = element("section", { class: "chooser", "aria-label": "Arm" });
  private readonly message = element("p", { role: "alert", class: "refusal" });
  private readonly text: HTMLInputElement;

  constructor(
    builtIn: string[],
    private readonly chosen: (text: string) => void,
    private readonly opened: (file: OpenedFile) => void,
  ) {
    const names = element("datalist", { id: "built-in" }, ...builtIn.map((value) => element("option", { value })));
    this.text = element("input", {
      id: "arm-text",
      list: "built-in",
      spellcheck: "false",
      autocomplete: "off",
      placeholder: "panda, or RRR:3.5,3.5,2",
    });
    const file = element("input", { type: "file", accept: ".urdf,.json,.xml", id: "arm-file" });
    file.addEventListener("change", () => void this.take(file.files));
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
      element("label", { for: "arm-file" }, "or a file: URDF or JSON"),
      file,
      names,
    );
    this.text.addEventListener("input", () => {
      if (builtIn.includes(this.text.value)) this.chosen(this.text.value);
    });
    const table = new DhForm((text) => this.opened({ name: "dh_table.json", text }));
    this.root.append(form, table.root, this.message);
  }

  /** Takes files that are dropped on `target`. */
  acceptDrops(target: HTMLElement): void {
    target.addEventListener("dragover", (event) => event.preventDefault());
    target.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.take(event.dataTransfer?.files ?? null);
    });
  }

  show(name: string): void {
    if (document.activeElement !== this.text) this.text.value = name;
    this.message.textContent = "";
  }

  refuse(reason: string): void {
    this.message.textContent = reason;
  }

  private async take(files: FileList | null): Promise<void> {
    const file = files?.[0];
    if (!file) return;
    const refusal = tooLarge(file);
    if (refusal !== null) return this.refuse(refusal);
    this.opened({ name: file.name, text: await file.text() });
  }
}
