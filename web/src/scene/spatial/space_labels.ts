import type { Skeleton } from "../../core/types.js";
import { shown } from "../../elements/element.js";
import { along, columnLabels, thinned, wide, type Label, type Obstacle, type Pixel } from "../labels.js";
import { centreLine, type Gap, type Marks } from "../picture.js";

export const frameLength = { tool: 0.11, waypoint: 0.08 }; // of the reach
const manyLinks = 40; // have no room for names of frames
const ringRadius = 13; // pixels, of the tool's handle

/** What is drawn of a spatial arm, as far as texts depend on it. */
export interface SpatialDrawing {
  marks: Marks;
  /** Of all links, the tool's last. */
  poses: Float64Array[];
  bones: Skeleton;
  /** The reach of the arm, m. */
  size: number;
  /** The centre lines of start and goal, m. */
  ghosts: number[][][];
  /** Points of the tool's handle. */
  grips: Pixel[];
  /** Of a joint's symbol, pixels. */
  thick: number;
  pixel: (point: ArrayLike<number>) => Pixel;
}

/** What texts should not cover: the arm, its handle, and what is drawn beside it. */
export function obstaclesOf({ marks, poses, bones, size, ghosts, grips, thick, pixel }: SpatialDrawing): Obstacle[] {
  const line = (points: number[][]): Pixel[] => along(points.map((point) => pixel(point)));
  const [x, y] = pixel(bones.tool);
  const ring = [0, 1, 2, 3, 4, 5].map((k): Pixel => [x + ringRadius * Math.cos(k), y + ringRadius * Math.sin(k)]);
  const axes = (pose: ArrayLike<number>, length: number): Pixel[] =>
    [0, 4, 8].flatMap((k) =>
      line([
        [12, 13, 14].map((i) => pose[i] ?? 0),
        [0, 1, 2].map((i) => (pose[12 + i] ?? 0) + length * (pose[k + i] ?? 0)),
      ]),
    );
  return [
    ...wide(line(centreLine(bones)), thick),
    ...ghosts.flatMap(line),
    ...ring,
    ...grips,
    ...axes(poses.at(-1) ?? [], frameLength.tool * size),
    ...marks.waypoints.flatMap(({ pose }) => axes(pose, frameLength.waypoint * size)),
    ...marks.gaps.flatMap(({ points }) => line(points)),
    ...marks.trails.flatMap(({ points }) => thinned(points.map((point) => pixel(point)))),
  ];
}

/** The distance of two bodies, beside the middle of their line. */
function gapLabel(gap: Gap, index: number, pixel: SpatialDrawing["pixel"]): Label {
  const [a, b] = gap.points;
  const at = pixel(a.map((value, i) => (value + (b[i] ?? 0)) / 2));
  const colour = gap.close ? "var(--alarm)" : "var(--text)";
  return { key: `gap ${index}`, text: gap.text, at, away: 12, angle: 0.6, kind: "distance", colour };
}

/** The pose of the tool, waypoints, columns of the Jacobian, and the names of frames: one for those in one place. */
export function labelsOf({ marks, poses, size, pixel }: SpatialDrawing): Label[] {
  const digits = size >= 10 ? 2 : 3;
  const tool = Array.from(poses.at(-1)?.subarray(12, 15) ?? []);
  const position = tool.map((value) => shown(value, digits)).join(", ");
  const at = pixel(tool);
  const labels: Label[] = [
    { key: "pose", text: `(${position}) m`, at, away: 20, angle: 0.5, kind: "pose" },
    ...marks.waypoints.map(({ pose, label }): Label => ({
      key: label,
      text: label,
      at: pixel(pose.slice(12, 15)),
      away: 12,
      angle: 0.8,
      kind: "waypoint",
    })),
    ...columnLabels(marks.columns, tool, pixel, at),
    ...marks.gaps.map((gap, i) => gapLabel(gap, i, pixel)),
  ];
  if (!marks.frames || poses.length > manyLinks) return labels;
  const places = new Map<string, number[]>();
  poses.slice(0, -1).forEach((pose, i) => {
    const key = Array.from(pose.subarray(12, 15), (value) => (value / size).toFixed(5)).join();
    places.set(key, [...(places.get(key) ?? []), i]);
  });
  for (const place of places.values()) {
    const text = place.map((i) => `{${i}}`).join(" ");
    const origin = pixel(poses[place[0] ?? 0]?.subarray(12, 15) ?? []);
    labels.push({ key: text, text, at: origin, away: 18, angle: Math.PI, kind: "frame" });
  }
  return labels;
}
