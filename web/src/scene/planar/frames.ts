import { headingOf } from "../../core/pose.js";
import { arrowOf, children, set, svg } from "../../elements/svg.js";
import type { Label, Pixel } from "../labels.js";
import { sizeFor } from "./planar_arm.js";
import type { PlaneView } from "./plane_view.js";

const length = 30; // points, as in the figures
const maxLabels = 40;

/** The ends of the axes of a frame, pixels. */
export function tips(pose: ArrayLike<number>, view: PlaneView, pixels: number): [Pixel, Pixel] {
  const [x, y] = view.pixel([pose[12] ?? 0, pose[13] ?? 0]);
  const heading = headingOf(pose);
  const at = (angle: number): Pixel => [x + pixels * Math.cos(angle), y - pixels * Math.sin(angle)];
  return [at(heading), at(heading + Math.PI / 2)];
}

/** The x and y axes of a frame, thin, as two arrows. */
export function triad(pose: ArrayLike<number>, view: PlaneView, pixels: number, group: SVGElement): void {
  const origin = view.pixel([pose[12] ?? 0, pose[13] ?? 0]);
  const parts = children(group, 2, (k) =>
    svg("g", { class: k === 0 ? "axis-x" : "axis-y" }, svg("path", { class: "line" }), svg("path", { class: "head" })),
  );
  tips(pose, view, pixels).forEach((tip, k) => {
    const arrow = arrowOf(origin, tip, 9);
    set(parts[k]?.children[0] as SVGElement, { d: arrow.line });
    set(parts[k]?.children[1] as SVGElement, { d: arrow.head });
  });
}

/** Frames {0} to {n} with their labels; frames at one place share a label, and the later are shorter. */
export class Frames {
  readonly root = svg("g", { class: "frames", "aria-hidden": "true" });

  /** Draws the frames; returns their labels, and what labels should not cover. */
  place(poses: ArrayLike<number>[], view: PlaneView, size: number): { labels: Label[]; obstacles: Pixel[] } {
    const pixels = length * view.unit * sizeFor(poses.length);
    const places: number[][] = [];
    poses.forEach((pose, i) => {
      const same = places.find(([first = 0]) => distance(poses[first] ?? [], pose) <= 1e-6 * size);
      if (same) same.push(i);
      else places.push([i]);
    });
    const groups = children(this.root, poses.length, () => svg("g"));
    for (const place of places)
      place.forEach((i, rank) => {
        const shorter = place.length === 1 ? 1 : 0.35 + 0.95 * (1 - rank / place.length);
        triad(poses[i] ?? [], view, pixels * shorter, groups[i] as SVGElement);
      });
    if (poses.length > maxLabels) return { labels: [], obstacles: [] };
    const labels = places.map(([first = 0, ...others]): Label => {
      const pose = poses[first] ?? [];
      const text = [first, ...others].map((i) => `{${i}}`).join(" ");
      const angle = headingOf(pose) - (3 * Math.PI) / 4; // away from both axes
      return { key: text, text, at: view.pixel([pose[12] ?? 0, pose[13] ?? 0]), away: 12, angle, kind: "frame" };
    });
    return { labels, obstacles: poses.flatMap((pose) => tips(pose, view, 0.7 * pixels)) };
  }
}

function distance(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.hypot((a[12] ?? 0) - (b[12] ?? 0), (a[13] ?? 0) - (b[13] ?? 0));
}
