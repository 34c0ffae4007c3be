import { armOfDhTable, DhFault, type DhColumn, type DhRow, type DhTable } from "../core/dh_table.js";
import { saveFile } from "../share/save_file.js";
import { element } from "../elements/element.js";

const columns: [DhColumn, string][] = [
  ["a", "a, metres"],
  ["alpha", "alpha"],
  ["d", "d, metres"],
  ["theta", "theta, offset"],
  ["lower", "lower limit"],
  ["upper", "upper limit"],
];
const conventions = [
  ["standard", "standard: Rz(θ) Tz(d) Tx(a) Rx(α)"],
  ["modified", "modified: Tx(a) Rx(α) Rz(θ) Tz(d)"],
] as const;
const maxRows = 50;

interface Row {
  root: HTMLElement;
  type: HTMLSelectElement;
  cells: Map<DhColumn, HTMLInputElement>;
}

/** A Denavit-Hartenberg table to type in, which becomes an arm. */
export class DhForm {
  readonly root = element("details", {}, element("summary", {}, "A DH table"));
  private readonly name = element("input", {
    id: "dh-name",
    value: "my arm",
    autocomplete: "off",
    spellcheck: "false",
  });
  private readonly convention = conventions.map(([value, text]) => {
    const radio = element("input", { type: "radio", name: "dh-convention", value });
    return { radio, label: element("label", {}, radio, ` ${text}`) };
  });
  private readonly unit = element(
    "select",
    { id: "dh-unit" },
    element("option", { value: "degrees" }, "degrees"),
    element("option", { value: "radians" }, "radians"),
  );
  private readonly body = element("div", { role: "group", "aria-label": "DH table" });
  private readonly fault = element("p", { role: "alert", class: "refusal", id: "dh-fault" });
  private rows: Row[] = [];

  /** `made` gets the arm as JSON. */
  constructor(made: (json: string) => void) {
    const save = (json: string): void => saveFile("arm.json", new Blob([json], { type: "application/json" }));
    const titles = ["", "type", "a, m", "α", "d, m", "θ"].map((text) => element("span", {}, text));
    const add = element("button", { type: "button", onclick: () => this.add().type.focus() }, "Add a joint");
    const keep = element("button", { type: "button", onclick: () => this.give(save) }, "Save as JSON");
    const form = element(
      "form",
      {
        onsubmit: (event: Event) => {
          event.preventDefault();
          this.give(made);
        },
      },
      element("p", { class: "pair" }, element("label", { for: "dh-name" }, "Name"), this.name),
      element("fieldset", {}, element("legend", {}, "Convention"), ...this.convention.map(({ label }) => label)),
      element("p", { class: "pair" }, element("label", { for: "dh-unit" }, "Angles in"), this.unit),
      element("p", { class: "quiet" }, "Angles can be typed as pi/2 too. An empty limit is none."),
      element("div", { class: "dh quiet", "aria-hidden": "true" }, ...titles),
      this.body,
      this.fault,
      element("p", { class: "pair" }, add, element("button", {}, "Show the arm"), keep),
    );
    this.root.append(form);
    for (let i = 0; i < 3; ++i) this.add();
  }

  private add(): Row {
    const type = element(
      "select",
      {},
      element("option", { value: "revolute" }, "R"),
      element("option", { value: "prismatic" }, "P"),
    );
    const cells = new Map(
      columns.map(([column]) => {
        const value = column === "lower" || column === "upper" ? "" : "0";
        const placeholder = value === "" ? column : "";
        return [column, element("input", { value, placeholder, autocomplete: "off", size: 6 })] as const;
      }),
    );
    const remove = element("button", { type: "button" }, "×");
    const note = element("span", { class: "quiet", "aria-hidden": "true" }, "limits");
    const inputs = [...cells.values()];
    const root = element(
      "div",
      { class: "dh" },
      element("span"),
      type,
      ...inputs.slice(0, 4),
      note,
      ...inputs.slice(4),
      remove,
    );
    const row: Row = { root, type, cells };
    remove.addEventListener("click", () => {
      const at = this.rows.indexOf(row);
      this.rows.splice(at, 1);
      row.root.remove();
      this.number();
      (this.rows[at] ?? this.rows[at - 1] ?? this.add()).type.focus();
    });
    if (this.rows.length < maxRows) {
      this.rows.push(row);
      this.body.append(row.root);
    } else this.fault.textContent = `The form has ${maxRows} rows at most; a file may have more.`;
    this.number();
    return row;
  }

  /** Numbers the rows, in labels too. */
  private number(): void {
    this.rows.forEach(({ root, type, cells }, i) => {
      (root.firstChild as HTMLElement).textContent = String(i + 1);
      type.setAttribute("aria-label", `row ${i + 1}, type`);
      for (const [column, label] of columns) cells.get(column)?.setAttribute("aria-label", `row ${i + 1}, ${label}`);
      root.querySelector("button")?.setAttribute("aria-label", `remove row ${i + 1}`);
    });
  }

  private table(): DhTable {
    const convention = this.convention.find(({ radio }) => radio.checked)?.radio.value ?? "";
    return {
      name: this.name.value,
      convention: convention as DhTable["convention"],
      degrees: this.unit.value === "degrees",
      rows: this.rows.map(({ type, cells }) => {
        const typed = Object.fromEntries([...cells].map(([column, input]) => [column, input.value]));
        return { ...typed, type: type.value } as DhRow;
      }),
    };
  }

  /** Gives the arm away, or shows the fault and goes to its cell. */
  private give(to: (json: string) => void): void {
    this.fault.textContent = "";
    for (const wrong of this.root.querySelectorAll("[aria-invalid]")) {
      wrong.removeAttribute("aria-invalid");
      wrong.removeAttribute("aria-describedby");
    }
    try {
      to(armOfDhTable(this.table()));
    } catch (error) {
      if (!(error instanceof DhFault)) throw error;
      this.fault.textContent = error.message;
      const place = this.placeOf(error);
      place?.setAttribute("aria-invalid", "true");
      place?.setAttribute("aria-describedby", this.fault.id);
      place?.focus();
    }
  }

  private placeOf({ row, column }: DhFault): HTMLElement | undefined {
    if (column === "name") return this.name;
    if (column === "convention") return this.convention[0]?.radio;
    return this.rows[row]?.cells.get(column);
  }
}
