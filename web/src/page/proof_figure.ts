import { lineBound, lineRows, linkLengths, sampledDeviation } from "../core/line_bound.js";
import { toolPosition } from "../core/pose.js";
import { element, shown as text } from "../elements/element.js";
import { pathOf, svg } from "../elements/svg.js";
import { slider } from "../panels/slider.js";
import type { LessonFigure } from "./lesson_figures.js";
import type { LessonPlayer } from "./lesson_player.js";
import type { Services, Shown } from "./section.js";

const points = 40; // of an interval, where the deviation is computed
const height = 200; // of the chart, pixels
const [least, most] = [240, 560]; // its width
const edge = { left: 52, right: 8, top: 12, bottom: 30 };
const ticks = [1, 1.5, 2, 3, 4, 5, 6, 8];

/** The least round number that is not below a value. */
function roundedUp(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * (ticks.find((tick) => tick * power >= value * (1 - 1e-9)) ?? 10);
}

const hundredthMillimetres = 1e5; // of a metre
/** A bound in mm, rounded away from 0: the number that is shown is one too. */
const boundText = (bound: number): string => text(Math.ceil(bound * hundredthMillimetres) / 100, 2);
const millimetres = (value: number): string => text(1000 * value, 2);

/** The deviation between samples along a line: the computed one as a curve, and a box for the bound of each interval, mm.
 * `available`: the width that there is, pixels. */
function chart(bounds: number[], deviations: number[][], available: number): SVGSVGElement {
  const width = Math.min(most, Math.max(least, available));
  const top = roundedUp(1000 * Math.max(...bounds, 1e-6));
  const digits = Math.max(0, 1 - Math.floor(Math.log10(top)));
  const label = (part: number): string => `${text(part * top, part === 0 ? 0 : digits)}${part === 1 ? " mm" : ""}`;
  const px = (part: number): number => edge.left + part * (width - edge.left - edge.right);
  const py = (mm: number): number => height - edge.bottom - (mm / top) * (height - edge.top - edge.bottom);
  const count = bounds.length;
  const boxes = bounds.map((bound, i) => {
    const [x, y] = [px(i / count), py(1000 * bound)];
    return svg("rect", { class: "bound", x, y, width: px((i + 1) / count) - x, height: py(0) - y });
  });
  const curve = deviations.flatMap((row, i) =>
    row.map((value, k): [number, number] => [px((i + k / (row.length - 1)) / count), py(1000 * value)]),
  );
  const lines = [0, 0.5, 1].flatMap((part) => {
    const y = py(part * top);
    return [
      svg("path", { class: part === 0 ? "zero" : "grid", d: `M${edge.left} ${y}H${width - edge.right}` }),
      svg("text", { x: edge.left - 6, y: y + 4, "text-anchor": "end" }, label(part)),
    ];
  });
  const samples = Array.from({ length: count + 1 }, (_, i) =>
    svg("circle", { class: "sample", cx: px(i / count), cy: py(0), r: 2.5 }),
  );
  const numbers =
    `Bound of each interval, mm: ${bounds.map(boundText).join(", ")}. Largest sampled deviation: ` +
    deviations.map((row) => millimetres(Math.max(...row))).join(", ");
  return svg(
    "svg",
    {
      class: "proof-chart",
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label": `Deviation from the line. ${numbers}`,
    },
    ...lines,
    ...boxes,
    svg("path", { class: "deviation", d: pathOf(curve) }),
    ...samples,
    svg("text", { x: edge.left, y: height - 8 }, "along the line: a dot is a sample"),
  );
}

/** Samples on a straight line, and what a bound proves between them. */
export class ProofFigure implements LessonFigure {
  readonly root = element("fieldset", { class: "gains chapter-figure" });
  private readonly count = slider({ id: "lesson-intervals", min: 2, max: 40, step: 1, value: 8 });
  private readonly value = element("output", { for: "lesson-intervals" });
  private readonly says = element("p", { role: "status" });
  private readonly holder = element("div");
  private drawn = "";
  private shown: Shown | null = null;

  constructor(
    private readonly services: Services,
    private readonly player: LessonPlayer,
    private readonly ends: [number[], number[]],
  ) {
    this.count.addEventListener("input", () => this.draw());
    const row = element(
      "div",
      { class: "joint" },
      element("label", { for: "lesson-intervals" }, "Intervals"),
      this.count,
      this.value,
    );
    this.root.append(element("legend", {}, "Bound and sampled deviation between samples"), row, this.holder, this.says);
  }

  update(shown: Shown): void {
    this.shown = shown;
    this.draw();
  }

  leave(): void {
    this.drawn = "";
    this.player.take([]);
    this.services.draw({ trails: [] });
  }

  private draw(): void {
    if (!this.shown) return;
    const { arm, description } = this.shown;
    const key = `${description.name} ${this.count.value}`;
    if (key === this.drawn) return;
    this.drawn = key;
    this.value.textContent = this.count.value;
    if (description.name !== "rrr") {
      this.player.take([]);
      this.services.draw({ trails: [] });
      this.holder.replaceChildren();
      this.says.textContent = "This figure needs the arm rrr.";
      return;
    }
    const rows = lineRows(arm, ...this.ends, Number(this.count.value));
    const lengths = linkLengths(arm);
    const pairs = rows.slice(1).map((to, i): [number[], number[]] => [rows[i] ?? to, to]);
    const bounds = pairs.map(([from, to]) => lineBound(lengths, from, to));
    const deviations = pairs.map(([from, to]) => sampledDeviation(arm, from, to, points));
    this.holder.replaceChildren(chart(bounds, deviations, this.holder.clientWidth));
    const [bound, largest] = [Math.max(...bounds), Math.max(...deviations.flat())];
    this.says.textContent =
      `Bound ${boundText(bound)} mm, proved. Largest sampled deviation ${millimetres(largest)} mm, ` +
      `${text((100 * largest) / bound, 0)} % of the bound.`;
    const dense = pairs.flatMap(([from, to]) =>
      Array.from({ length: points }, (_, i) => from.map((value, k) => value + (i / points) * ((to[k] ?? 0) - value))),
    );
    const all = [...dense, rows.at(-1) ?? []];
    const path = (of: number[][]): number[][] => of.map((q) => toolPosition(arm, q));
    this.services.draw({
      trails: [
        { tone: "planned", points: path(all), dots: false },
        { tone: "cartesian", points: path(rows), dots: true },
      ],
    });
    this.player.take(all, 60);
  }
}
