import type { ArmDescription } from "../core/description.js";
import {
  cellCount,
  centreAround,
  centreOf,
  largest,
  positionCount,
  positionOf,
  type ReachMap,
  type ReachPlan,
} from "../core/reach.js";
import { Cancelled } from "../core/types.js";
import { element } from "../elements/element.js";
import { levelOf, ReachDisplay, sliceIndex } from "../panels/reach_display.js";
import { grouped, ReachForm } from "../panels/reach_form.js";
import { ReachPosition } from "../panels/reach_position.js";
import { shade } from "../scene/colour_scale.js";
import type { PageState } from "../state/page_state.js";
import type { PageSection, Services, Shown } from "./section.js";
import { toolAt } from "./tool_at.js";

const darkest = 0.3; // of the scale, for a surface that is seen on a dark ground
const planned: ReadonlySet<keyof PageState> = new Set(["reachCells", "reachDirections"]);

/** Values for a surface. All measures fall to 0 where nothing is reached, so that the surface is smooth; all that is
 * reached is above level 0. */
function solid(values: Float32Array, level: number): Float32Array {
  return level > 0 ? values.map((value) => (Number.isNaN(value) ? 0 : value)) : values;
}

/** A map of what the arm can do at the centres of cells, computed in the worker: its isosurface and its slices. */
export class Workspace implements PageSection {
  readonly root = element("div", { class: "panel" });
  private readonly form: ReachForm;
  private readonly totals = element("p", { role: "status" });
  private readonly display: ReachDisplay;
  private readonly position: ReachPosition;
  private readonly results: HTMLElement;
  private shown: Shown | null = null;
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
      element("h2", {}, "Workspace"),
      element(
        "p",
        { class: "quiet" },
        "Where the arm reaches: the inverse kinematics is solved at the centre of each cell of a grid, in each tool " +
          "direction.",
      ),
      this.form.root,
      this.results,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.open = false;
    this.clear();
  }

  update(_: number[], changed: ReadonlySet<keyof PageState>): void {
    if (!this.shown) return;
    const first = !this.open;
    this.open = true;
    if (first || [...planned].some((key) => changed.has(key))) void this.describe();
    if (changed.size > 1 || !changed.has("q")) this.draw();
  }

  leave(): void {
    this.open = false;
    this.cancel(); // the other sections need the worker
  }

  tile(point: number[]): void {
    this.choose(point);
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
    if (this.open) this.services.draw({ tiles: null, surface: null, cell: null });
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
    if (!this.shown.description.reach?.radius) return this.form.refuse(unbounded(this.shown.description));
    try {
      const grid = await this.services.reach({ ask: "grid", plan: this.plan(this.shown) });
      if (asked === this.asked) this.form.describe(grid, this.orientations, redundant);
    } catch (error) {
      if (asked === this.asked && !(error instanceof Cancelled)) this.form.refuse((error as Error).message);
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
      this.shown?.picture.retreat();
      this.draw();
    } catch (error) {
      if (turn === this.turn && !(error instanceof Cancelled)) this.form.refuse((error as Error).message);
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
    if (!this.map || !this.shown || !this.open) return;
    const { planar } = this.shown.arm;
    const state = this.services.store.get();
    const grid = this.map.values;
    this.display.show(grid, state, this.orientations, planar);
    const normal = planar ? 2 : state.sliceNormal;
    const index = sliceIndex(grid, { ...state, sliceNormal: normal });
    const values = grid.values[state.measure];
    const tiles = state.showSlice ? { grid, values, normal, index, most: largest(grid, state.measure) } : null;
    this.services.draw({ tiles });
    this.showPosition();
    if (!planar && state.showSurface) return void this.drawSurface();
    ++this.drawing; // a surface that is on its way is not drawn any more
    this.services.draw({ surface: null });
  }

  /** Asks for the surface once the one before is there, so that none pile up while a slider moves. */
  private async drawSurface(): Promise<void> {
    const drawing = ++this.drawing;
    await this.drawn;
    if (drawing !== this.drawing || !this.map || !this.open) return;
    const { values, plan } = this.map;
    const state = this.services.store.get();
    const { measure } = state;
    // Between two numbers of branches.
    const level = levelOf(values, measure, state.level) - (measure === "branches" ? 0.5 : 0);
    const asked = this.services.reach({ ask: "surface", plan, values: solid(values.values[measure], level), level });
    this.drawn = asked.catch(() => undefined);
    try {
      const mesh = await asked;
      const colour = shade(Math.max(darkest, levelOf(values, measure, state.level) / largest(values, measure)));
      if (drawing === this.drawing && this.open) this.services.draw({ surface: { mesh, colour } });
    } catch (error) {
      if (drawing === this.drawing && !(error instanceof Cancelled)) this.form.refuse((error as Error).message);
    }
  }

  /** Shows the values at the cell around a point. */
  private choose([x = 0, y = 0, z = 0]: number[]): void {
    if (!this.map) return;
    const [, , height] = this.map.values.axes;
    const point = [x, y, this.shown?.arm.planar === true ? centreOf(height, 0) : z];
    const inside = positionOf(this.map.values, point) !== null;
    this.chosen = inside ? centreAround(this.map.values, point) : point;
    this.showPosition();
  }

  private showPosition(): void {
    if (!this.map) return;
    const { values } = this.map;
    const p = this.chosen ? positionOf(values, this.chosen) : null;
    this.position.show(values, this.chosen, p, this.orientations, this.shown?.arm.planar === true);
    const cell = p === null || !this.chosen ? null : { centre: this.chosen, edge: values.axes[0].step };
    this.services.draw({ cell });
  }

  private moveTool(): void {
    const { q } = this.services.store.get();
    if (!this.map || !this.shown || !this.chosen || !q) return;
    const found = toolAt(this.shown.arm, this.map.values, this.chosen, q);
    if (found) this.services.store.set({ q: found });
    else this.position.say("No orientation of the map that was tried has a solution at this centre.");
  }
}

/** Why an arm whose reach has no bounds has no map. */
function unbounded({ name, joints }: ArmDescription): string {
  const free = joints.find(
    ({ type, limits }) => type !== "revolute" && (limits.lower === null || limits.upper === null),
  );
  const why = free ? `${free.name} slides without limits, so the` : "The";
  return `${why} reach of ${name} has no bounds: there is no map of it.`;
}
