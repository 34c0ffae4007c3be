import type uPlot from "uplot";
import type { JointDescription } from "../core/description.js";
import { divergence, isProportional, type StepResponse } from "../core/step_response.js";
import type { Gains } from "../core/types.js";
import { element, shown } from "../elements/element.js";
import { unitOf } from "../elements/units.js";
import { jointColour, onTheme, resolved } from "../scene/colours.js";
import { numbered } from "./chart_axis.js";

const height = 190;
const usual = 60; // steps: the same for all gains that converge, so that charts can be compared

/** The errors of the joints over the steps of PID control, one curve a joint. */
export class StepChart {
  readonly root = element("figure", { class: "curves" });
  /** What the response means, or why it diverges: stands apart, where it is seen without scrolling. */
  readonly words = element("p", { class: "response" });
  private readonly caption = element("figcaption");
  private readonly holder = element("div", { role: "img" });
  private readonly legend = element("ul", { class: "legend", "aria-label": "Curves" });
  private plot: uPlot | null = null;
  private latest: { rows: number[][]; range: [number, number] } | null = null;
  private drawing = 0;

  constructor() {
    this.root.append(this.caption, this.holder, this.legend);
    new ResizeObserver(() => {
      if (this.root.clientWidth > 0) this.plot?.setSize({ width: this.root.clientWidth, height });
    }).observe(this.root);
    onTheme(() => void this.draw());
  }

  /** Says why there is no response. */
  refuse(reason: string): void {
    this.latest = null;
    this.caption.textContent = "";
    this.plot?.destroy();
    this.plot = null;
    this.legend.replaceChildren();
    this.words.textContent = reason;
  }

  show(response: StepResponse, gains: Gains, joints: JointDescription[], degrees: boolean): void {
    const units = joints.map(({ type }) => unitOf(type, degrees));
    const names = [...new Set(units.map(({ name }) => name))].join(" and ");
    const count = stepsOf(response);
    const scaled = response.errors.map((errors, k) =>
      errors.slice(0, count + 1).map((error) => error * (units[k]?.factor ?? 1)),
    );
    const words = inWords(response, gains);
    const control = isProportional(gains) ? "joint space (eq. 1.3)" : "joint space, PID control";
    this.caption.textContent = `Step response in ${control}: errors of the joints`;
    this.words.textContent = words;
    this.holder.setAttribute("aria-label", `Errors in ${names} over ${count} steps. ${words}`);
    this.legend.replaceChildren(
      ...joints.map(({ name }, k) => {
        const swatch = element("span", {
          class: "swatch",
          "aria-hidden": "true",
          style: `background: ${jointColour(k)}`,
        });
        return element("li", {}, swatch, `${name}, ${units[k]?.name ?? ""}`);
      }),
    );
    const low = scaled.flat().reduce((least, value) => Math.min(least, value), 0);
    const high = scaled.flat().reduce((top, value) => Math.max(top, value), 0);
    const margin = 0.05 * (high - low) || 1;
    const range: [number, number] = [low - margin, high + margin];
    this.latest = { rows: scaled, range };
    void this.draw();
  }

  private async draw(): Promise<void> {
    const turn = ++this.drawing;
    if (!this.latest) return;
    const { default: Plot } = await import("uplot");
    if (turn !== this.drawing || !this.latest || this.root.clientWidth === 0) return;
    this.plot?.destroy();
    const { rows, range } = this.latest;
    const steps = (rows[0] ?? []).map((_, step) => step);
    this.plot = new Plot(options(rows.length, range, this.root.clientWidth), [steps, ...rows], this.holder);
  }
}

/** How many steps are drawn: of a controller that diverges, until the errors hide how they began. */
function stepsOf({ errors, diverged, left }: StepResponse): number {
  return diverged ?? (left < 1 ? usual : (errors[0]?.length ?? 1) - 1);
}

function options(count: number, range: [number, number], width: number): uPlot.Options {
  const grid = { stroke: resolved("--grid"), width: 1 };
  const axis = { stroke: resolved("--quiet"), grid, ticks: { show: false }, font: "12px system-ui, sans-serif" };
  return {
    width,
    height,
    legend: { show: false },
    cursor: { show: false },
    scales: { x: { time: false }, y: { range: () => range } },
    axes: [
      { ...axis, size: 24, values: (_, steps) => steps.map((step, i) => (i === 0 ? `step ${step}` : `${step}`)) },
      { ...axis, size: 52, ...numbered(4) },
    ],
    series: [
      {},
      ...Array.from({ length: count }, (_, k) => ({
        stroke: resolved(jointColour(k)),
        width: 1.5,
        points: { show: true, size: 4, fill: resolved(jointColour(k)) },
      })),
    ],
  };
}

/** What one should see. */
function inWords({ errors, overshoot, settled, left, diverged, factor }: StepResponse, gains: Gains): string {
  const steps = (errors[0]?.length ?? 1) - 1;
  const over = overshoot > 0.001 ? `It overshoots by ${shown(100 * overshoot, 1)} % of the first error. ` : "";
  const why = becauseOf(factor, gains);
  if (diverged !== null)
    return `Unstable: the errors grow from step to step, beyond ${divergence} times the first after ${diverged} steps. ${why}`;
  if (left > 1) return `Unstable: the errors grow from step to step. ${why}`;
  if (settled === null)
    return `${over}After ${steps} steps ${shown(100 * left, 1)} % of the error is left.${left > 0.999 ? ` ${why}` : ""}`;
  const slow = settled > usual && over === "" ? "It crawls: " : ""; // not one that swings
  return `${over}${slow}${slow === "" ? "T" : "t"}he errors stay below 2 % from step ${settled} on.`;
}

/** Why the errors grow. */
export function becauseOf(factor: number, gains: Gains): string {
  const { kp } = gains;
  if (isProportional(gains))
    return `Each step multiplies the error by 1 − Kp = ${shown(1 - kp, 2).replace(/\.?0+$/, "")}; it shrinks only for 0 < Kp < 2.`;
  return `In the end each step multiplies the error by about ${shown(factor, 2)}: the gains are too large together.`;
}
