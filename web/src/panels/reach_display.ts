import { cellOf, centreOf, largest, measures, type Measure, type ReachMap } from "../core/reach.js";
import { gradient } from "../scene/colour_scale.js";
import type { PageState } from "../state/page_state.js";
import { element, typed } from "../elements/element.js";
import { measureText, shapeOf } from "./reach_measures.js";

/** The part of the state that this panel owns. */
type Choices = Pick<PageState, "measure" | "level" | "sliceNormal" | "sliceAt" | "showSurface" | "showSlice">;

/** The index of the plane of a slice: the middle one where none is chosen, the nearest one for a coordinate outside. */
export function sliceIndex(map: ReachMap, { sliceNormal, sliceAt }: Choices): number {
  const axis = map.axes[sliceNormal] ?? map.axes[2];
  if (sliceAt === null) return Math.floor(axis.cells / 2);
  return cellOf(axis, sliceAt) ?? (sliceAt < axis.lower ? 0 : axis.cells - 1);
}

/** What the surface encloses: values of this and above; branches are whole numbers. */
export function levelOf(map: ReachMap, measure: Measure, fraction: number): number {
  const level = fraction * largest(map, measure);
  return measure === "branches" ? Math.max(1, Math.round(level)) : level;
}

/** How a map is shown: the measure with its colours, the level of the surface, the plane of the slice. */
export class ReachDisplay {
  readonly root = element("section", { "aria-label": "What is shown of the map" });
  private readonly measure = element("select", { id: "reach-measure" });
  private readonly numbers = element("div", { class: "ends" });
  private readonly caption = element("figcaption", { class: "quiet" });
  private readonly surface = element("input", { type: "checkbox", id: "reach-surface" });
  private readonly level = element("input", { type: "range", min: 0, max: 1, "aria-label": "Level of the surface" });
  private readonly levelText = element("output", { for: "reach-surface" });
  private readonly tiles = element("input", { type: "checkbox", id: "reach-tiles" });
  private readonly normal = element("select", { "aria-label": "Normal of the slice" });
  private readonly slider = element("input", { type: "range", "aria-label": "Position of the slice, slider" });
  private readonly at = element("input", { type: "number", step: "any", "aria-label": "Position of the slice" });
  private readonly surfaceRow: HTMLElement;
  private readonly colours: HTMLElement;
  private readonly plane: HTMLElement;
  private readonly sliceLabel = element("label", { for: "reach-tiles" }, "Slice");

  constructor(changed: (change: Partial<Choices>) => void) {
    this.measure.addEventListener("change", () => changed({ measure: this.measure.value as Measure }));
    this.surface.addEventListener("change", () => changed({ showSurface: this.surface.checked }));
    this.level.addEventListener("input", () => changed({ level: Number(this.level.value) }));
    this.tiles.addEventListener("change", () => changed({ showSlice: this.tiles.checked }));
    this.normal.append(...["x", "y", "z"].map((name, value) => element("option", { value }, name)));
    this.normal.addEventListener("change", () => changed({ sliceNormal: Number(this.normal.value), sliceAt: null }));
    const scale = element("div", { class: "scale", role: "img", "aria-label": "From dark blue, low, to yellow, high" });
    scale.style.background = gradient;
    this.slider.addEventListener("input", () => changed({ sliceAt: Number(this.slider.value) }));
    this.at.addEventListener("change", () => {
      if (this.at.value !== "") changed({ sliceAt: Number(this.at.value) });
    });
    this.plane = element("span", { class: "plane" }, this.normal, " = ", this.at, " m");
    const label = (text: string, of: HTMLElement): HTMLElement => element("label", { for: of.id }, text);
    this.surfaceRow = element(
      "div",
      { class: "shown" },
      this.surface,
      label("Surface", this.surface),
      this.level,
      this.levelText,
    );
    this.colours = element("figure", { class: "colours" }, scale, this.numbers, this.caption);
    this.root.append(
      element("div", { class: "choice" }, label("Measure of a position", this.measure), this.measure),
      this.colours,
      this.surfaceRow,
      element("div", { class: "shown" }, this.tiles, this.sliceLabel, this.slider, this.plane),
    );
  }

  /** `planar`: in the arm's plane there is one slice and no surface. */
  show(map: ReachMap, state: Choices, orientations: string, planar: boolean): void {
    const options = measures.map((name) => element("option", { value: name }, shapeOf(name, orientations).title));
    this.measure.replaceChildren(...options);
    this.measure.value = state.measure;
    const shape = shapeOf(state.measure, orientations);
    const most = largest(map, state.measure);
    const parts = state.measure === "branches" ? Math.min(4, most) : 4;
    this.numbers.replaceChildren(
      ...Array.from({ length: parts + 1 }, (_, k) => element("span", {}, measureText((k * most) / parts, shape))),
    );
    this.caption.textContent = shape.caption;
    this.surfaceRow.hidden = planar;
    this.colours.hidden = !state.showSlice && (planar || !state.showSurface); // nothing has these colours
    this.surface.checked = state.showSurface;
    this.level.step = state.measure === "branches" ? String(1 / most) : "0.01";
    this.level.value = String(state.level);
    const level = levelOf(map, state.measure, state.level);
    this.levelText.textContent = level > 0 ? `≥ ${measureText(level, shape)}` : "all reached";
    this.level.setAttribute("aria-valuetext", this.levelText.textContent);
    this.showSlice(map, state, planar);
  }

  private showSlice(map: ReachMap, state: Choices, planar: boolean): void {
    const normal = planar ? 2 : state.sliceNormal;
    const axis = map.axes[normal] ?? map.axes[2];
    const at = centreOf(axis, sliceIndex(map, { ...state, sliceNormal: normal }));
    this.tiles.checked = state.showSlice;
    this.normal.value = String(normal);
    this.slider.hidden = this.plane.hidden = planar; // the map has one height
    this.sliceLabel.textContent = planar ? "Tiles" : "Slice";
    this.slider.min = String(centreOf(axis, 0));
    this.slider.max = String(centreOf(axis, axis.cells - 1));
    this.slider.step = String(axis.step);
    this.slider.value = String(at);
    if (document.activeElement !== this.at) this.at.value = typed(at, 3);
  }
}
