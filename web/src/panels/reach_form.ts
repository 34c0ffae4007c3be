import { cellCount, positionCount, type ReachGrid } from "../core/reach.js";
import { cellChoices, directionChoices } from "../state/page_state.js";
import { element, shown } from "../elements/element.js";

/** Poses whose inverse kinematics takes minutes, and how many there are in a cell for a redundant arm. */
const many = 1_500_000;
const redundantValues = 16;

/** 12 345 with narrow spaces. */
export function grouped(count: number): string {
  return String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

function cellsText(grid: ReachGrid, orientations: string, redundant: boolean): string {
  const [x, y, z] = grid.axes.map(({ cells }) => cells);
  const edge = Number(grid.axes[0].step.toPrecision(3));
  const rolls = grid.rolls > 1 ? ` × ${grid.rolls} rolls` : "";
  const at = grid.directions > 1 ? ` × ${grid.directions} ${orientations}${rolls}` : "";
  return (
    `${x} × ${y} × ${z} = ${grouped(positionCount(grid))} positions of ${edge}\u00a0m${at}: ` +
    `${grouped(cellCount(grid))} cells to solve.` +
    (cellCount(grid) * (redundant ? redundantValues : 1) > many ? " This may take minutes." : "")
  );
}

/** What the next map covers, and the buttons that compute and cancel it. */
export class ReachForm {
  readonly root = element("div");
  private readonly cells: HTMLSelectElement;
  private readonly directions: HTMLSelectElement;
  private readonly directionsLabel = element("label", { for: "reach-directions" });
  private readonly line = element("p", { role: "status", class: "quiet" });
  private readonly refusal = element("p", { role: "status", class: "refusal" });
  private readonly bar = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress" });
  private readonly left = element("p", { class: "quiet", hidden: true });
  private readonly start: HTMLButtonElement;
  private readonly stop: HTMLButtonElement;
  private began = 0;

  constructor(
    changed: (change: { reachCells?: number; reachDirections?: number }) => void,
    compute: () => void,
    cancel: () => void,
  ) {
    const options = (values: number[]): HTMLElement[] =>
      values.map((value) => element("option", { value }, String(value)));
    this.cells = element("select", { id: "reach-cells" }, ...options(cellChoices));
    this.directions = element("select", { id: "reach-directions" });
    this.cells.addEventListener("change", () => changed({ reachCells: Number(this.cells.value) }));
    this.directions.addEventListener("change", () => changed({ reachDirections: Number(this.directions.value) }));
    this.start = element("button", { type: "button", onclick: compute }, "Compute the map");
    this.stop = element("button", { type: "button", hidden: true, onclick: cancel }, "Cancel");
    this.root.append(
      element(
        "div",
        { class: "choice" },
        element("label", { for: "reach-cells" }, "Cells along the diameter"),
        this.cells,
      ),
      element("div", { class: "choice" }, this.directionsLabel, this.directions),
      this.line,
      this.refusal,
      element("p", { class: "pair" }, this.start, this.stop),
      this.bar,
      this.left,
    );
  }

  /** `orientations`: directions, or headings of a planar arm. */
  show(cells: number, directions: number, orientations: string): void {
    this.directionsLabel.textContent = orientations === "headings" ? "Headings of the tool" : "Tool directions";
    const texts = directionChoices.map((angle) =>
      element("option", { value: angle }, angle > 0 ? `${angle}° apart` : "one, as it is now"),
    );
    this.directions.replaceChildren(...texts);
    this.cells.value = String(cells);
    this.directions.value = String(directions);
  }

  /** What would be computed, or null while that is not known. */
  describe(grid: ReachGrid | null, orientations: string, redundant: boolean): void {
    this.line.textContent = grid ? cellsText(grid, orientations, redundant) : "";
    this.refusal.textContent = "";
    this.start.disabled = grid === null;
  }

  /** Says why there is no map. */
  refuse(reason: string): void {
    this.line.textContent = "";
    this.refusal.textContent = reason;
  }

  /** The fraction that is computed; null: nothing is being computed. */
  progress(fraction: number | null): void {
    const computing = fraction !== null;
    if (computing && this.bar.hidden) this.began = performance.now();
    const elapsed = (performance.now() - this.began) / 1000;
    this.bar.hidden = this.left.hidden = this.stop.hidden = !computing;
    this.start.hidden = computing;
    this.cells.disabled = this.directions.disabled = computing;
    this.bar.value = fraction ?? 0;
    const seconds = fraction ? (elapsed * (1 - fraction)) / fraction : NaN;
    this.left.textContent =
      `${shown(100 * (fraction ?? 0), 0)} %` +
      (elapsed > 1 && Number.isFinite(seconds) ? `, about ${Math.ceil(seconds)} s left` : "");
  }
}
