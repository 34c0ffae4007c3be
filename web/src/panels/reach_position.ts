import { measures, type ReachMap } from "../core/reach.js";
import { element, shown } from "./element.js";
import { measureText, shapeOf } from "./reach_measures.js";

const names = ["x", "y", "z"];

/** The values at a position of a map, which is typed here or chosen in the picture, and a button that moves the tool
 * there. */
export class ReachPosition {
  readonly root: HTMLElement;
  private readonly fields: HTMLInputElement[];
  private readonly words = element("p", { role: "status" });
  private readonly go: HTMLButtonElement;

  /** `asked` gets the point that was typed, m. */
  constructor(asked: (point: number[]) => void, move: () => void) {
    this.fields = names.map((name) =>
      element("input", { type: "number", step: 0.05, "aria-label": `${name} of a position`, onchange: () => ask() }),
    );
    const ask = (): void => {
      if (this.fields.every((field) => field.value !== "")) asked(this.fields.map((field) => Number(field.value)));
    };
    this.go = element("button", { type: "button", disabled: true, onclick: move }, "Move the tool there");
    this.root = element(
      "fieldset",
      {},
      element("legend", {}, "At a position"),
      element("p", { class: "quiet" }, "Click a tile of the slice, or type."),
      element(
        "div",
        { class: "pose" },
        element("span", {}, "x y z"),
        ...this.fields,
        element("span", { class: "unit" }, "m"),
      ),
      this.words,
      element("p", { class: "pair" }, this.go),
    );
  }

  /** Shows position `p` of the map; null: outside or none. */
  show(map: ReachMap, point: number[] | null, p: number | null, orientations: string): void {
    this.fields.forEach((field, k) => {
      if (document.activeElement !== field) field.value = point ? shown(point[k] ?? 0, 3).replace("−", "-") : "";
    });
    const reached = p !== null && !Number.isNaN(map.values.branches[p]);
    this.go.disabled = !reached;
    if (point === null) this.say("");
    else if (p === null) this.say("This is outside the map.");
    else if (!reached) this.say("The arm reaches the centre of this cell in no orientation of the map.");
    else
      this.say(
        measures
          .map((measure) => {
            const shape = shapeOf(measure, orientations);
            return `${shape.title} ${measureText(map.values[measure][p] ?? NaN, shape)}`;
          })
          .join(", ") + ".",
      );
  }

  say(text: string): void {
    this.words.textContent = text;
  }
}
