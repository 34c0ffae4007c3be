import { element } from "../elements/element.js";
import { isInside, overlap, pointsIn, type Box, type Obstacle, type Pixel } from "./labels.js";

const gap = 20; // pixels between the tool and the sentence
const edge = 8; // pixels between the sentence and the border of the picture
const farther = 0.02; // of a covered point, for a pixel away from the tool
const kept = 3; // covered points: the sentence does not jump for less

/** A sentence beside the tool, where the eye is, and where it covers little of the arm. */
export class Callout {
  readonly root = element("div", { class: "callout", role: "status", hidden: true });
  private tool: Pixel = [0, 0];
  private obstacles: Obstacle[] = [];
  private taken: Box[] = [];
  private last: number | null = null;

  constructor(private readonly holder: HTMLElement) {}

  say(text: string, tone: "hint" | "refusal" = "refusal"): void {
    if (this.root.hidden) this.last = null;
    if (this.root.textContent !== text) this.root.textContent = text;
    this.root.hidden = text === "";
    this.root.dataset["tone"] = tone;
    this.place(this.tool, this.obstacles, this.taken);
  }

  /** Puts the sentence inside the picture: beside the tool, at a pixel, or into a corner, where it covers the fewest
   * obstacles, points of the arm, and no text that is `taken`. */
  place(tool: Pixel, obstacles: Obstacle[], taken: Box[]): void {
    [this.tool, this.obstacles, this.taken] = [tool, obstacles, taken];
    if (this.root.hidden) return;
    const places = this.places();
    const costs = places.map((box) => this.costOf(box));
    let best = costs.indexOf(Math.min(...costs));
    if (this.last !== null && (costs[this.last] ?? Infinity) <= (costs[best] ?? 0) + kept) best = this.last;
    this.last = best;
    const { x = 0, y = 0 } = places[best] ?? {};
    this.root.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }

  /** Around the tool, near and a little farther, and in the corners of the picture. */
  private places(): Box[] {
    const { clientWidth, clientHeight } = this.holder;
    const { offsetWidth: width, offsetHeight: height } = this.root;
    const [right, bottom] = [clientWidth - width - edge, clientHeight - height - edge];
    const [x, y] = this.tool;
    const around = [gap, 3 * gap, 5 * gap].flatMap((away) => {
      const columns = [x + away, x - away - width, x - width / 2];
      const rows = [y + away, y - away - height, y - height / 2];
      return columns.flatMap((left, i) => rows.flatMap((top, k) => (i === 2 && k === 2 ? [] : [[left, top] as const])));
    });
    const corners = [edge, right].flatMap((left) => [edge, bottom].map((top) => [left, top] as const));
    return [...around, ...corners].map(([left, top]) => ({
      x: Math.max(edge, Math.min(left, right)),
      y: Math.max(edge, Math.min(top, bottom)),
      width,
      height,
    }));
  }

  private costOf(box: Box): number {
    const [x, y] = this.tool;
    const away = Math.hypot(
      Math.max(box.x - x, 0, x - box.x - box.width),
      Math.max(box.y - y, 0, y - box.y - box.height),
    );
    const texts = this.taken.filter((other) => overlap(box, other)).length;
    const onTool = isInside([x, y], box) ? 40 : 0;
    return pointsIn(box, this.obstacles) + 6 * texts + onTool + farther * away;
  }
}
