import type uPlot from "uplot";
import type { JointDescription } from "../core/description.js";
import type { Quantity, Trajectory } from "../core/trajectory.js";
import { element, shown } from "../elements/element.js";
import { unitOf } from "../elements/units.js";
import { jointColour, onTheme, resolved } from "../scene/colours.js";
import { numbered } from "./chart_axis.js";

const perTime: Record<Quantity, string> = { position: "", velocity: "/s", acceleration: "/s²" };
const height = 110;

/** The limits of a joint's quantity in the page's unit; null: none. */
interface Range {
  lower: number | null;
  upper: number | null;
  assumed: boolean;
}

function rangeOf({ limits, assumed }: JointDescription, quantity: Quantity, factor: number): Range {
  const scaled = (value: number | null): number | null => (value === null ? null : value * factor);
  if (quantity === "position") return { lower: scaled(limits.lower), upper: scaled(limits.upper), assumed: false };
  const known = limits[quantity];
  const most = scaled(known ?? assumed?.[quantity] ?? null);
  return { lower: most === null ? null : -most, upper: most, assumed: known === null && most !== null };
}

/** Curves of each joint over time beside its limits, one chart a joint. A click goes to that time. */
export class JointCurves {
  readonly root = element("figure", { class: "curves", "aria-label": "Joint curves beside their limits" });
  private readonly charts = element("div");
  private readonly choice = element("select", { "aria-label": "Quantity of the joint curves" });
  private plots: uPlot[] = [];
  private motion: Trajectory | null = null;
  private joints: JointDescription[] = [];
  private degrees = true;
  private time = 0;

  constructor(private readonly chosen: (time: number) => void) {
    this.root.append(element("figcaption", { class: "pair" }, "Joints over time ", this.choice), this.charts);
    this.choice.addEventListener("change", () => void this.draw());
    new ResizeObserver(() => {
      for (const plot of this.plots) plot.setSize({ width: this.width(), height });
    }).observe(this.root);
    onTheme(() => void this.draw());
    this.take(null, [], true);
  }

  /** Shows a motion, or none. */
  take(motion: Trajectory | null, joints: JointDescription[], degrees: boolean): void {
    [this.motion, this.joints, this.degrees] = [motion, joints, degrees];
    this.root.hidden = motion === null;
    const { value } = this.choice;
    const there = motion?.quantities ?? [];
    this.choice.replaceChildren(...there.map((quantity) => element("option", { value: quantity }, quantity)));
    this.choice.value = there.includes(value as Quantity) ? value : "position";
    void this.draw();
  }

  /** Marks a time. */
  point(time: number): void {
    this.time = time;
    for (const plot of this.plots) plot.redraw(false);
  }

  private width(): number {
    return Math.max(200, this.charts.clientWidth);
  }

  private async draw(): Promise<void> {
    const { motion, joints } = this;
    const quantity = this.choice.value as Quantity;
    const { default: Plot } = motion ? await import("uplot") : { default: null };
    if (motion !== this.motion || quantity !== this.choice.value) return;
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    this.charts.replaceChildren();
    if (!motion || !Plot) return;
    joints.forEach((joint, k) => {
      const unit = unitOf(joint.type, this.degrees);
      const values = motion.column(quantity, k).map((value) => value * unit.factor);
      const range = rangeOf(joint, quantity, unit.factor);
      const holder = element("div", {
        role: "img",
        "aria-label": description(joint.name, values, range, unit.name + perTime[quantity]),
      });
      const title = element("p", { class: "quiet" }, caption(joint.name, range, unit.name + perTime[quantity]));
      this.charts.append(title, holder);
      this.plots.push(new Plot(this.options(range, jointColour(k)), [motion.times, values], holder));
    });
  }

  private options(range: Range, colour: string): uPlot.Options {
    const grid = { stroke: resolved("--grid"), width: 1 };
    const axis = { stroke: resolved("--quiet"), grid, ticks: { show: false }, font: "12px system-ui, sans-serif" };
    return {
      width: this.width(),
      height,
      legend: { show: false },
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false }, sync: { key: "joints" } },
      scales: { x: { time: false }, y: { range: (_, low, high) => around(low, high) } },
      axes: [
        { ...axis, size: 24, values: (_, times) => times.map((time) => `${time} s`) },
        { ...axis, size: 52, ...numbered(2) },
      ],
      series: [{}, { stroke: resolved(colour), width: 1.5, points: { show: false } }],
      hooks: {
        draw: [(plot) => this.marks(plot, range)],
        ready: [
          (plot) => {
            plot.over.addEventListener("click", () => {
              const { left } = plot.cursor;
              if (left !== undefined && left >= 0) this.chosen(plot.posToVal(left, "x"));
            });
          },
        ],
      },
    };
  }

  /** Draws what is beyond the limits as bands, and the time of the player. */
  private marks(plot: uPlot, { lower, upper }: Range): void {
    const { ctx, bbox } = plot;
    const [top, bottom] = [bbox.top, bbox.top + bbox.height];
    const at = (value: number): number => Math.min(bottom, Math.max(top, plot.valToPos(value, "y", true)));
    ctx.save();
    ctx.fillStyle = resolved("--alarm");
    ctx.globalAlpha = 0.16;
    if (upper !== null) ctx.fillRect(bbox.left, top, bbox.width, at(upper) - top);
    if (lower !== null) ctx.fillRect(bbox.left, at(lower), bbox.width, bottom - at(lower));
    ctx.globalAlpha = 1;
    const x = plot.valToPos(this.time, "x", true);
    ctx.fillStyle = resolved("--text");
    if (x >= bbox.left && x <= bbox.left + bbox.width) ctx.fillRect(x, top, devicePixelRatio, bbox.height);
    ctx.restore();
  }
}

/** A range of the axis that shows the curve; limits near it are seen too. */
function around(low: number, high: number): [number, number] {
  const margin = Math.max(0.12 * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  return [low - margin, high + margin];
}

function caption(name: string, { lower, upper, assumed }: Range, unit: string): string {
  const bound = (value: number | null): string => (value === null ? "no limit" : shown(value, 2));
  const limits = lower === null && upper === null ? "no limits" : `limits ${bound(lower)} to ${bound(upper)}`;
  return `${name}, ${unit}; ${limits}${assumed ? ", assumed" : ""}`;
}

function description(name: string, values: Float64Array, range: Range, unit: string): string {
  const low = values.reduce((a, b) => Math.min(a, b), Infinity);
  const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  return `${caption(name, range, unit)}; from ${shown(low, 2)} to ${shown(high, 2)}`;
}
