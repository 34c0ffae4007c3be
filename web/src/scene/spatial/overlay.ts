import { Vector3 } from "three";
import { pathOf, set, svg } from "../../elements/svg.js";
import { along, Labels, wide, type Box, type Label, type Obstacle, type Pixel } from "../labels.js";
import { roundStep, tickText } from "../ticks.js";
import type { Stage } from "./stage.js";

const corner = 52; // pixels from the lower left corner to the triad
const arm = 26;

/** What is written over the picture of a spatial arm: labels, the directions of the axes, a scale bar. */
export class Overlay {
  readonly root = svg("svg", { class: "overlay", "aria-hidden": "true" });
  private readonly labels = new Labels();
  private readonly axes = ["x", "y", "z"].map((name) =>
    svg("g", { class: `axis-${name}` }, svg("path", { class: "line" }), svg("text", {}, name)),
  );
  private readonly ring = svg("circle", { class: "ring", r: 13 });
  private readonly bar = svg("g", { class: "scale-bar" }, svg("path"), svg("text"));
  private readonly held = svg("circle", { class: "held", r: 13 });
  private readonly hint = svg("text", { class: "hint-text" });

  constructor(private readonly stage: Stage) {
    this.root.append(this.ring, this.labels.root, ...this.axes, this.bar, this.held, this.hint);
    this.point("", [0, 0], null);
  }

  /** Writes a word beside the mouse, and draws a ring around what it points at; none where it is null. */
  point(word: string, [x, y]: Pixel, ring: Pixel | null): void {
    set(this.hint, { x: (x + 14).toFixed(1), y: (y - 12).toFixed(1) });
    this.hint.textContent = word;
    this.held.style.display = ring ? "" : "none";
    if (ring) set(this.held, { cx: ring[0].toFixed(1), cy: ring[1].toFixed(1) });
  }

  /** The label of this kind that is written at a pixel. */
  labelAt(pixel: Pixel, kind: Label["kind"]): string | null {
    return this.labels.at(pixel, kind);
  }

  /** `handle`: the pixel of the tool, where it can be taken hold of; `obstacles`: what labels should not cover. Returns
   * what else texts should not cover: labels, and the obstacles with the triad and the scale bar. */
  place(
    width: number,
    height: number,
    labels: Label[],
    obstacles: Obstacle[],
    handle: Pixel | null,
  ): { taken: Box[]; obstacles: Obstacle[] } {
    set(this.root, { width, height, viewBox: `0 0 ${width} ${height}` });
    this.ring.style.display = handle ? "" : "none";
    if (handle) set(this.ring, { cx: handle[0].toFixed(1), cy: handle[1].toFixed(1) });
    const all = [...obstacles, ...this.placeAxes(height), ...this.placeBar(width, height)];
    return { taken: this.labels.place(labels, all, { x: 0, y: 0, width, height }), obstacles: all };
  }

  private placeAxes(height: number): Obstacle[] {
    const turn = this.stage.camera.quaternion.clone().invert();
    const origin = [corner, height - corner] as const;
    const points: Pixel[] = [];
    [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].forEach((axis, i) => {
      const { x, y } = axis.applyQuaternion(turn);
      const end = [origin[0] + arm * x, origin[1] - arm * y] as const;
      const [line, name] = [...(this.axes[i]?.children ?? [])] as SVGElement[];
      set(line as SVGElement, { d: pathOf([origin, end]) });
      const long = Math.hypot(x, y) || 1;
      const beyond = 10;
      set(name as SVGElement, {
        x: (end[0] + (beyond * x) / long).toFixed(1),
        y: (end[1] - (beyond * y) / long + 4).toFixed(1),
      });
      points.push(...along([origin, end]));
    });
    return wide(points, 12); // the names of the axes
  }

  private placeBar(width: number, height: number): Obstacle[] {
    const step = roundStep(70 / this.stage.pixelsPerMetre);
    const long = step * this.stage.pixelsPerMetre;
    const [right, y] = [width - 24, height - 26];
    const [path, text] = [...this.bar.children] as SVGElement[];
    set(path as SVGElement, { d: `M${right - long} ${y - 4}v8m0 -4h${long}m0 -4v8` });
    set(text as SVGElement, { x: right - long / 2, y: y - 8 });
    const words = `${tickText(step, step)} m`;
    if ((text as SVGElement).textContent !== words) (text as SVGElement).textContent = words;
    const middle = y - 10; // of the bar and its number
    const line: Pixel[] = [
      [right - long, middle],
      [right, middle],
    ];
    return wide(along(line), 14);
  }
}
