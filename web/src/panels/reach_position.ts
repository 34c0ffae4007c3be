import { measures, type ReachMap } from "../core/reach.js";
import { element, typed } from "../elements/element.js";
import { measureText, shapeOf } from "./reach_measures.js";

const names = ["x", "y", "z"];

/** The values at a position of a map, which is typed here or chosen in the picture, and a button that moves the tool
 * there. */
export class ReachPosition {
  readonly root: HTMLElement;
  private readonly fields: HTMLInputElement[];
  private readonly height: HTMLElement;
  private readonly words = element("p", { role: "status" });
  private readonly go: HTMLButtonElement;

  /** `asked` gets the point that was typed, m. */
  constructor(asked: (point: number[]) => void, move: () => void) {
    this.fields = names.map((name) =>
      element("input", {
        type: "number",
        id: `reach-${name}`,
        step: 0.05,
        "aria-label": `${name} of a position`,
        onchange: () => ask(),
      }),
    );
    const coordinates = this.fields.map((field, k) =>
      element(
        "div",
        { class: "coordinate" },
        element("label", { for: field.id }, names[k] ?? ""),
        field,
        element("span", { class: "unit", "aria-hidden": "true" }, "m"),
      ),
    );
    this.height = coordinates[2] as HTMLElement;
    const ask = (): void => {
      const wanted = this.fields.filter((_, k) => k < 2 || !this.height.hidden);
      if (wanted.every((field) => field.value !== "")) asked(this.fields.map((field) => Number(field.value)));
    };
    this.go = element("button", { type: "button", disabled: true, onclick: move }, "Move the tool there");
    this.root = element(
      "fieldset",
      {},
      element("legend", {}, "At a position"),
      element("p", { class: "quiet" }, "Click a tile of the slice, or type."),
      element("div", { class: "coordinates" }, ...coordinates),
      this.words,
      element("p", { class: "pair" }, this.go),
    );
  }

  /** Shows position `p` of the map; null: outside or none. A planar arm's position has no z: the map has one height. */
  show(map: ReachMap, point: number[] | null, p: number | null, orientations: string, planar: boolean): void {
    this.height.hidden = planar;
    this.fields.forEach((field, k) => {
      if (document.activeElement !== field) field.value = point ? typed(point[k] ?? 0, 3) : "";
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
