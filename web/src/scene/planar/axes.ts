import { children, pathOf, set, svg } from "../../elements/svg.js";
import { roundStep, ticks, tickText } from "../ticks.js";
import { margin, type PlaneView } from "./plane_view.js";

const gap = 58; // pixels between two ticks, at least

/** The frame of the plot, its grid, and numbered axes, as the figures have them. */
export class Axes {
  readonly root = svg("g", { class: "axes", "aria-hidden": "true" });
  private readonly grid = svg("path", { class: "grid" });
  private readonly zero = svg("path", { class: "zero" });
  private readonly frame = svg("path", { class: "frame" });
  private readonly numbers = svg("g");
  private readonly titles = [svg("text", {}, "x [m]"), svg("text", {}, "y [m]")] as const;

  constructor() {
    this.root.append(this.grid, this.zero, this.frame, this.numbers, ...this.titles);
  }

  place(view: PlaneView): void {
    const [left, top] = [margin.left, margin.top];
    const [right, bottom] = [left + view.plotWidth, top + view.plotHeight];
    const [low, high] = [view.world([left, bottom]), view.world([right, top])];
    const step = roundStep(gap / view.scale);
    const xs = ticks(low[0], high[0], step);
    const ys = ticks(low[1], high[1], step);
    const upright = (x: number): string =>
      pathOf([
        [view.pixel([x, 0])[0], top],
        [view.pixel([x, 0])[0], bottom],
      ]);
    const level = (y: number): string =>
      pathOf([
        [left, view.pixel([0, y])[1]],
        [right, view.pixel([0, y])[1]],
      ]);
    const away = (value: number): boolean => Math.abs(value) > step / 2;
    set(this.grid, { d: xs.filter(away).map(upright).join("") + ys.filter(away).map(level).join("") });
    const inside = (value: number, k: 0 | 1): boolean => value >= low[k] && value <= high[k];
    set(this.zero, { d: (inside(0, 0) ? upright(0) : "") + (inside(0, 1) ? level(0) : "") });
    set(this.frame, {
      d:
        `${pathOf([
          [left, top],
          [right, top],
          [right, bottom],
          [left, bottom],
        ])}Z` +
        xs
          .map((x) =>
            pathOf([
              [view.pixel([x, 0])[0], bottom],
              [view.pixel([x, 0])[0], bottom + 4],
            ]),
          )
          .join("") +
        ys
          .map((y) =>
            pathOf([
              [left, view.pixel([0, y])[1]],
              [left - 4, view.pixel([0, y])[1]],
            ]),
          )
          .join(""),
    });
    const texts = children(this.numbers, xs.length + ys.length, () => svg("text"));
    xs.forEach((x, i) => write(texts[i], tickText(x, step), view.pixel([x, 0])[0], bottom + 16, "middle", "x"));
    ys.forEach((y, i) =>
      write(texts[xs.length + i], tickText(y, step), left - 8, view.pixel([0, y])[1] + 4, "end", "y"),
    );
    const [x, y] = this.titles;
    set(x, { x: (left + right) / 2, y: bottom + 33, "text-anchor": "middle" });
    set(y, { transform: `translate(16 ${(top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" });
  }
}

function write(text: SVGElement | undefined, words: string, x: number, y: number, anchor: string, axis: string): void {
  if (!text) return;
  set(text, { x: x.toFixed(1), y: y.toFixed(1), "text-anchor": anchor, "data-axis": axis });
  if (text.textContent !== words) text.textContent = words;
}
