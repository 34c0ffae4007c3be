import { cellCount, centreAround, positionCount, positionOf, type ReachMap, type ReachPlan } from "../core/reach.js";
import { element } from "../panels/element.js";
import { levelOf, ReachDisplay } from "../panels/reach_display.js";
import { grouped, ReachForm } from "../panels/reach_form.js";
import { ReachPosition } from "../panels/reach_position.js";
import type { PageState } from "../state/page_state.js";
import { ReachPicture } from "./reach_picture.js";
import type { SectionPanel, Services, Shown } from "./section.js";
import { toolAt } from "./tool_at.js";

const planned: ReadonlySet<keyof PageState> = new Set(["reachCells", "reachDirections"]);

/** Values for a surface. All measures fall to 0 where nothing is reached, so that the surface is smooth; all that is
 * reached is above level 0. */
function solid(values: Float32Array, level: number): Float32Array {
  return level > 0 ? values.map((value) => (Number.isNaN(value) ? 0 : value)) : values;
}

/** A map of what the arm can do at the centres of cells, computed in the worker: its isosurface and its slices. */
export class ReachSection implements SectionPanel {
  readonly root = element("div", { class: "panel" });
  private readonly form: ReachForm;
  private readonly totals = element("p", { role: "status" });
  private readonly display: ReachDisplay;
  private readonly position: ReachPosition;
  private readonly results: HTMLElement;
  private shown: Shown | null = null;
  private picture: ReachPicture | null = null;
  private open = false;
  private map: { values: ReachMap; plan: ReachPlan } | null = null;
  private chosen: number[] | null = null;
  private computing = false;
  private turn = 0;
  private asked = 0;
  private drawing = 0;
  private drawn: Promise<unknown> = Promise.resolve();

  constructor(private readonly services: Services) {
    const { store } = services;
    this.form = new ReachForm(
      (change) => store.set(change),
      () => void this.compute(),
      () => this.cancel(),
    );
    this.display = new ReachDisplay((change) => store.set(change));
    this.position = new ReachPosition(
      (point) => this.choose(point),
      () => this.moveTool(),
    );
    this.results = element("div", { hidden: true }, this.totals, this.display.root, this.position.root);
    this.root.append(
      element("h2", {}, "What the arm can reach"),
      element(
        "p",
        { class: "quiet" },
        "The inverse kinematics is solved at the centre of each cell of a grid, in each tool direction.",
      ),
      this.form.root,
      this.results,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.picture?.dispose();
    this.picture = new ReachPicture(shown.view, (point) => this.choose(point.toArray()));
    this.open = false;
    this.clear();
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    if (!this.shown || !this.picture) return;
    const { arm, view } = this.shown;
    const state = this.services.store.get();
    view.show(q, arm.forward(q), state.showFrames);
    const first = !this.open;
    if (first) this.picture.enter();
    this.open = true;
    if (first || [...planned].some((key) => changed.has(key))) void this.describe();
    if (changed.size > 1 || !changed.has("q")) this.draw();
  }

  leave(): void {
    this.open = false;
    this.cancel(); // the other sections need the worker
    this.picture?.leave();
  }

  private cancel(): void {
    if (!this.computing) return;
    this.computing = false;
    this.services.cancel();
  }

  private get orientations(): string {
    return this.shown?.arm.planar === true ? "headings" : "directions";
  }

  private clear(): void {
    ++this.turn;
    ++this.drawing;
    this.computing = false;
    this.map = this.chosen = null;
    this.results.hidden = true;
    this.form.progress(null);
    this.picture?.clear();
  }

  /** What a map of these choices covers; the edge of its cells is a round number. */
  private plan({ arm, description }: Shown): ReachPlan {
    const { reachCells, reachDirections, q } = this.services.store.get();
    const diameter = 2 * (description.reach?.radius ?? 0);
    const tool = arm.forward(q ?? arm.displayConfiguration()).at(-1) as Float64Array;
    const columns = [0, 4, 8].flatMap((k) => Array.from(tool.subarray(k, k + 3)));
    return {
      arm: arm.json,
      resolution: Number((diameter / reachCells).toPrecision(2)),
      directions: (reachDirections * Math.PI) / 180,
      rolls: Math.PI / 3,
      orientation: reachDirections === 0 ? columns : null,
    };
  }

  /** Says how many cells the next map has, or why there is none. */
  private async describe(): Promise<void> {
    if (!this.shown) return;
    const asked = ++this.asked;
    const { reachCells, reachDirections } = this.services.store.get();
    const redundant = this.shown.arm.dof > (this.shown.arm.planar ? 3 : 6);
    this.form.show(reachCells, reachDirections, this.orientations);
    this.form.describe(null, this.orientations, redundant);
    try {
      const grid = await this.services.reach({ ask: "grid", plan: this.plan(this.shown) });
      if (asked === this.asked) this.form.describe(grid, this.orientations, redundant);
    } catch (error) {
      if (asked === this.asked) this.form.refuse((error as Error).message);
    }
  }

  private async compute(): Promise<void> {
    if (!this.shown) return;
    this.clear();
    const { turn } = this;
    const plan = this.plan(this.shown);
    this.computing = true;
    this.form.progress(0);
    try {
      const values = await this.services.reach({ ask: "map", plan }, (fraction) => {
        if (turn === this.turn) this.form.progress(fraction);
      });
      if (turn !== this.turn) return;
      this.map = { values, plan };
      this.showTotals(values);
      this.shown?.view.stage.retreat(1.1 * this.shown.view.size);
      this.draw();
    } catch (error) {
      // What was cancelled needs no words.
      if (turn === this.turn && this.computing) this.form.refuse((error as Error).message);
    } finally {
      if (turn === this.turn) {
        this.form.progress(null);
        this.computing = false;
      }
    }
  }

  private showTotals(map: ReachMap): void {
    const planar = this.shown?.arm.planar === true;
    const reached = map.values.branches.reduce((count, value) => count + Number(value > 0), 0);
    const size = (reached * map.axes[0].step ** (planar ? 2 : 3)).toPrecision(4);
    this.totals.textContent =
      `${grouped(reached)} of ${grouped(positionCount(map))} positions are reached: ` +
      `${Number(size)}\u00a0${planar ? "m²" : "m³"}. ${grouped(map.cellsReached)} of ${grouped(cellCount(map))} cells.`;
    this.results.hidden = false;
  }

  private draw(): void {
    if (!this.map || !this.shown || !this.picture) return;
    const { planar } = this.shown.arm;
    const state = this.services.store.get();
    this.display.show(this.map.values, state, this.orientations, planar);
    this.picture.showTiles(this.map.values, state, planar);
    this.showPosition();
    if (planar || !state.showSurface) this.picture.surfaceVisible = false;
    else void this.drawSurface();
  }

  /** Asks for the surface once the one before is there, so that none pile up while a slider moves. */
  private async drawSurface(): Promise<void> {
    const drawing = ++this.drawing;
    await this.drawn;
    if (drawing !== this.drawing || !this.map || !this.picture) return;
    const { values, plan } = this.map;
    const state = this.services.store.get();
    const { measure } = state;
    // Between two numbers of branches.
    const level = levelOf(values, measure, state.level) - (measure === "branches" ? 0.5 : 0);
    const asked = this.services.reach({ ask: "surface", plan, values: solid(values.values[measure], level), level });
    this.drawn = asked.catch(() => undefined);
    try {
      const surface = await asked;
      if (drawing === this.drawing) this.picture.showSurface(surface, values, state);
    } catch (error) {
      if (drawing === this.drawing) this.form.refuse((error as Error).message);
    }
  }

  /** Shows the values at the cell around a point. */
  private choose(point: number[]): void {
    if (!this.map) return;
    const inside = positionOf(this.map.values, point) !== null;
    this.chosen = inside ? centreAround(this.map.values, point) : point;
    this.showPosition();
  }

  private showPosition(): void {
    if (!this.map) return;
    const { values } = this.map;
    const p = this.chosen ? positionOf(values, this.chosen) : null;
    this.position.show(values, this.chosen, p, this.orientations);
    this.picture?.choose(values, p === null ? null : this.chosen);
  }

  private moveTool(): void {
    const { q } = this.services.store.get();
    if (!this.map || !this.shown || !this.chosen || !q) return;
    const found = toolAt(this.shown.arm, this.map.values, this.chosen, q);
    if (found) this.services.store.set({ q: found });
    else this.position.say("No orientation of the map that was tried has a solution at this centre.");
  }
}
