import type uPlot from "uplot";
import type { JointDescription } from "../core/description.js";
import type { StepResponse } from "../core/step_response.js";
import { element, shown } from "./element.js";
import { unitOf } from "./units.js";

const height = 190;
const drawn = 60; // steps: the same for all gains, so that charts can be compared
const colours = ["#d0312d", "#2e8b3d", "#4a7fe0", "#d95f02", "#9a5fc0", "#1f9e9e", "#8a8f98"];

/** The errors of the joints over the steps of PID control, one curve a joint. */
export class StepChart {
  readonly root = element("figure", { class: "curves" });
  private readonly words = element("p", { class: "response" });
  private readonly holder = element("div", { role: "img" });
  private readonly legend = element("ul", { class: "legend", "aria-label": "Curves" });
  private plot: uPlot | null = null;
  private latest: { rows: number[][]; range: [number, number] } | null = null;
  private drawing = 0;

  constructor() {
    this.root.append(element("figcaption", {}, "Step response: errors of the joints"));
    this.root.append(this.holder, this.legend, this.words);
    new ResizeObserver(() => {
      if (this.root.clientWidth > 0) this.plot?.setSize({ width: this.root.clientWidth, height });
    }).observe(this.root);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => void this.draw());
  }

  /** Says why there is no response. */
  refuse(reason: string): void {
    this.latest = null;
    this.plot?.destroy();
    this.plot = null;
    this.legend.replaceChildren();
    this.words.textContent = reason;
  }

  show(response: StepResponse, joints: JointDescription[], degrees: boolean): void {
    const units = joints.map(({ type }) => unitOf(type, degrees));
    const names = [...new Set(units.map(({ name }) => name))].join(" and ");
    const scaled = response.errors.map((errors, k) =>
      errors.slice(0, drawn + 1).map((error) => error * (units[k]?.factor ?? 1)),
    );
    this.words.textContent = inWords(response);
    this.holder.setAttribute("aria-label", `Errors in ${names} over ${drawn} steps. ${inWords(response)}`);
    this.legend.replaceChildren(
      ...joints.map(({ name }, k) => {
        const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
        swatch.style.background = colour(k);
        return element("li", {}, swatch, `${name}, ${units[k]?.name ?? ""}`);
      }),
    );
    const most = 1.3 * scaled.reduce((most, [first = 0]) => Math.max(most, Math.abs(first)), 0) || 1;
    const low = scaled.flat().reduce((least, value) => Math.min(least, value), 0);
    const high = scaled.flat().reduce((top, value) => Math.max(top, value), 0);
    const margin = 0.05 * (high - low);
    const range: [number, number] = [Math.max(-most, low - margin), Math.min(most, high + margin) || 1];
    this.latest = { rows: scaled, range };
    void this.draw();
  }

  private async draw(): Promise<void> {
    const turn = ++this.drawing;
    const { default: Plot } = await import("uplot");
    if (turn !== this.drawing || !this.latest || this.root.clientWidth === 0) return;
    this.plot?.destroy();
    const { rows, range } = this.latest;
    const steps = Array.from({ length: drawn + 1 }, (_, step) => step);
    this.plot = new Plot(options(rows.length, range, this.root.clientWidth), [steps, ...rows], this.holder);
  }
}

function colour(k: number): string {
  return colours[k % colours.length] as string;
}

function options(count: number, range: [number, number], width: number): uPlot.Options {
  const style = getComputedStyle(document.documentElement);
  const quiet = style.getPropertyValue("--quiet").trim();
  const grid = { stroke: style.getPropertyValue("--line").trim(), width: 1 };
  const axis = { stroke: quiet, grid, ticks: { show: false } };
  return {
    width,
    height,
    legend: { show: false },
    cursor: { show: false },
    scales: { x: { time: false }, y: { range: () => range } },
    axes: [
      { ...axis, size: 24, values: (_, steps) => steps.map((step) => (step === drawn ? `${step} steps` : `${step}`)) },
      { ...axis, size: 52 },
    ],
    series: [
      {},
      ...Array.from({ length: count }, (_, k) => ({
        stroke: colour(k),
        width: 2,
        points: { show: true, size: 3, fill: colour(k) },
      })),
    ],
  };
}

/** What one should see. */
function inWords({ errors, overshoot, settled, left }: StepResponse): string {
  const steps = (errors[0]?.length ?? 1) - 1;
  const over = overshoot > 0.001 ? `It overshoots by ${shown(100 * Math.min(overshoot, 1e6), 1)} % of the way. ` : "";
  if (left > 1) return `Unstable: the errors grow from step to step.`;
  if (settled === null) return `${over}After ${steps} steps ${shown(100 * left, 1)} % of the error is left.`;
  const slow = settled > drawn ? "It crawls: " : "";
  return `${over}${slow}${slow === "" ? "T" : "t"}he errors stay below 2 % from step ${settled} on.`;
}
