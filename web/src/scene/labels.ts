import { children, set, svg } from "../elements/svg.js";
import { subscript } from "../elements/units.js";
import { jointColour } from "./colours.js";
import { shortening } from "./picture.js";

export type Pixel = readonly [number, number];
/** A point that texts should not cover, and how far around it, pixels. */
export type Obstacle = readonly [x: number, y: number, around?: number];

/** A text beside a point of the picture. */
export interface Label {
  /** The same label in the next picture has the same key. */
  key: string;
  text: string;
  at: Pixel;
  /** Of the middle of the text from the point, pixels; and the preferred angle, rad, y up. */
  away: number;
  angle: number;
  kind: "frame" | "angle" | "pose" | "waypoint" | "column" | "distance";
  /** A CSS colour. */
  colour?: string;
  /** What a hand takes hold of with it: an attribute data-grab. */
  grab?: string;
}

/** In pixels, from its upper left corner. */
export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

const directions = 12;
const letter = 7.2; // pixels
const height = 16;
const kept = 0.6; // of an overlap: a label does not jump for less
const nearest = 3; // pixels around an obstacle
const gap = 5; // pixels between texts of a line
const edge = 6; // pixels within the bounds
const cutOff = 20; // cost of a text beyond the bounds: more than of lines behind it
const shortest = 8; // pixels of an arrow that is named
/** Pixels by which a label is moved away from its point, and what that costs. */
const farther = [
  { by: 0, cost: 0 },
  { by: 18, cost: 0.3 },
  { by: 44, cost: 0.8 },
  { by: 72, cost: 1.2 }, // of a pose, whose text says what it is of
] as const;

/** Texts that keep clear of the arm and of each other, as in the figures: of the places around its point each takes the
 * one with the least overlap, and stays there as long as it is good. */
export class Labels {
  readonly root = svg("g", { class: "labels", "aria-hidden": "true" });
  private places = new Map<string, number>();
  private written: { label: Label; box: Box }[] = [];

  /** Returns the boxes of the texts. */
  place(labels: Label[], obstacles: Obstacle[], bounds: Box): Box[] {
    const taken: Box[] = [];
    const texts = children(this.root, labels.length, () => svg("text"));
    const places = new Map<string, number>();
    this.written = [];
    labels.forEach((label, i) => {
      const rings = label.kind === "pose" ? farther.length : farther.length - 1;
      const costs = Array.from({ length: rings * directions }, (_, k) =>
        costOf(boxOf(label, k), k, obstacles, taken, bounds),
      );
      let best = costs.indexOf(Math.min(...costs));
      const before = this.places.get(label.key);
      if (before !== undefined && (costs[before] ?? Infinity) <= (costs[best] ?? 0) + kept) best = before;
      places.set(label.key, best);
      const box = boxOf(label, best);
      taken.push(box);
      this.written.push({ label, box });
      const text = texts[i] as SVGElement;
      set(text, {
        x: (box.x + box.width / 2).toFixed(1),
        y: (box.y + box.height / 2 + 4.5).toFixed(1),
        class: `${label.kind}-text`,
        style: label.colour === undefined ? "" : `fill: ${label.colour}`,
      });
      if (label.grab === undefined) text.removeAttribute("data-grab");
      else text.setAttribute("data-grab", label.grab);
      if (text.textContent !== label.text) text.textContent = label.text;
    });
    this.places = places;
    return taken;
  }

  /** The key of the label of a kind at a pixel. */
  at(pixel: Pixel, kind: Label["kind"]): string | null {
    return this.written.find(({ label, box }) => label.kind === kind && isInside(pixel, box, 4))?.label.key ?? null;
  }
}

/** The box of a text at place k: around its point, near or a little farther. */
function boxOf({ at, text, away, angle }: Label, k: number): Box {
  const width = letter * text.length;
  const turn = [0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6][k % directions] ?? 0;
  const direction = angle + (turn * 2 * Math.PI) / directions;
  const [c, s] = [Math.cos(direction), Math.sin(direction)];
  const reach =
    away +
    (farther[Math.floor(k / directions)]?.by ?? 0) +
    Math.min((width / 2) * Math.abs(c) + (height / 2) * Math.abs(s), 46);
  return { x: at[0] + reach * c - width / 2, y: at[1] - reach * s - height / 2, width, height };
}

function costOf(box: Box, k: number, obstacles: Obstacle[], taken: Box[], bounds: Box): number {
  let cost = 0.04 * (k % directions) + (farther[Math.floor(k / directions)]?.cost ?? 0);
  cost += 0.5 * pointsIn(box, obstacles);
  const roomy = { ...box, x: box.x - gap, width: box.width + 2 * gap };
  for (const other of taken) if (overlap(roomy, other)) cost += 6;
  const inside =
    box.x >= bounds.x + edge &&
    box.y >= bounds.y &&
    box.x + box.width <= bounds.x + bounds.width - edge &&
    box.y + box.height <= bounds.y + bounds.height;
  return inside ? cost : cost + cutOff;
}

/** How many obstacles a box covers. */
export function pointsIn(box: Box, obstacles: Obstacle[]): number {
  let count = 0;
  for (const [x, y, around = nearest] of obstacles) if (isInside([x, y], box, around)) ++count;
  return count;
}

export function isInside([x, y]: Pixel, box: Box, around = 0): boolean {
  return x > box.x - around && x < box.x + box.width + around && y > box.y - around && y < box.y + box.height + around;
}

export function overlap(a: Box, b: Box): boolean {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/** Points along a line, a few pixels apart. */
export function along(line: Pixel[]): Pixel[] {
  return line.slice(1).flatMap(([x, y], i) => {
    const [a, b] = line[i] as Pixel;
    const count = Math.min(40, Math.max(1, Math.ceil(Math.hypot(x - a, y - b) / 9)));
    return Array.from({ length: count + 1 }, (_, k): Pixel => [a + ((x - a) * k) / count, b + ((y - b) * k) / count]);
  });
}

/** A point with the pixels around it that texts should not cover. */
export function wide(points: Pixel[], around: number): Obstacle[] {
  return points.map(([x, y]) => [x, y, around]);
}

const shownOfPath = 120; // points

/** Points of a path, as many as texts need to keep clear of it. */
export function thinned(pixels: Pixel[]): Pixel[] {
  if (pixels.length < shownOfPath / 3) return along(pixels);
  const every = Math.ceil(pixels.length / shownOfPath);
  return pixels.filter((_, i) => i % every === 0);
}

/** The numbers of the joints at the tips of the columns of the Jacobian, each in the colour of its joint; none at those
 * that are too short. `from`: the pixel of the tool. */
export function columnLabels(
  columns: number[][] | null,
  tool: number[],
  pixel: (point: number[]) => Pixel,
  from: Pixel,
): Label[] {
  return (columns ?? []).flatMap((column, k): Label[] => {
    const at = pixel(tool.map((value, i) => value + shortening * (column[i] ?? 0)));
    const [dx, dy] = [at[0] - from[0], from[1] - at[1]];
    if (Math.hypot(dx, dy) < shortest) return [];
    const text = `J${subscript(k + 1)}`;
    return [{ key: text, text, at, away: 6, angle: Math.atan2(dy, dx), kind: "column", colour: jointColour(k) }];
  });
}
