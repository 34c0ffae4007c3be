import { shown } from "../elements/element.js";
import type { Verdict } from "./checks.js";

/** A part of a planar arm as it is drawn: a joint, or the tool at the end. Metres. */
export interface Part {
  kind: "R" | "P" | "tool";
  x: number;
  y: number;
}

/** A pose in the plane: x, y, m, and the angle, rad. */
type Pose = [x: number, y: number, angle: number];

/** Where the parts of a drawn arm are once its joints have moved by `change`, a number for each joint: R turns about its
 * place, P slides towards the next part. Both act on all parts behind the joint, from the last joint to the first, as in
 * the product of exponentials. */
export function movedParts(parts: Part[], change: number[]): Pose[] {
  const poses = parts.map(({ x, y }): Pose => [x, y, 0]);
  let joint = parts.filter(({ kind }) => kind !== "tool").length;
  for (let i = parts.length - 1; i >= 0; --i) {
    const part = parts[i] as Part;
    if (part.kind === "tool") continue;
    const value = change[--joint] ?? 0;
    const next = parts[i + 1] ?? part;
    const length = Math.hypot(next.x - part.x, next.y - part.y) || 1;
    const [ux, uy] = [(next.x - part.x) / length, (next.y - part.y) / length];
    const [c, s] = [Math.cos(value), Math.sin(value)];
    for (let k = i + 1; k < poses.length; ++k) {
      const [x, y, angle] = poses[k] as Pose;
      const [dx, dy] = [x - part.x, y - part.y];
      poses[k] =
        part.kind === "P"
          ? [x + value * ux, y + value * uy, angle]
          : [part.x + c * dx - s * dy, part.y + s * dx + c * dy, angle + value];
    }
  }
  return poses;
}

/** The arm RP is drawn at θ1 = 0 and d2 = 1 m: its tool is at x = 2. */
export const drawnAt = { turn: 0, slide: 1 };
/** The configurations at which a drawing is checked: θ1, rad, and d2, m. */
export const drawingChecks: [turn: number, slide: number][] = [
  [0, 1.5],
  [Math.PI / 2, 1],
  [Math.PI / 4, 0.5],
];

/** The change of the joints of a drawing from where it is drawn to a configuration. */
export function changeTo(parts: Part[], [turn, slide]: [number, number]): number[] {
  const joints = parts.filter(({ kind }) => kind !== "tool");
  return joints.map(({ kind }) => (kind === "R" ? turn - drawnAt.turn : slide - drawnAt.slide));
}

/** Whether a drawing is the arm RP with a link of length 1. `at`: the configuration at which it differs. */
export function checkDrawing(parts: Part[]): Verdict {
  const no = (says: string, at?: number[]): Verdict => ({ solved: false, says, ...(at ? { at } : {}) });
  const joints = parts.filter(({ kind }) => kind !== "tool").map(({ kind }) => kind);
  if (joints.length !== 2)
    return no(`The arm RP has two joints; there ${jointsCounted(joints.length)} in the drawing.`);
  if (joints.join("") === "RR") return no("Both joints of the drawing turn: the second one of RP slides.");
  if (joints.join("") === "PP") return no("Both joints of the drawing slide: the first one of RP turns.");
  if (parts.at(-1)?.kind !== "tool") return no("Place the tool, beyond the last joint.");
  for (const [turn, slide] of drawingChecks) {
    const wanted: Pose = [(1 + slide) * Math.cos(turn), (1 + slide) * Math.sin(turn), turn];
    const found = movedParts(parts, changeTo(parts, [turn, slide])).at(-1) as Pose;
    if (wanted.every((value, i) => Math.abs(value - found[i as 0 | 1 | 2]) < 1e-9)) continue;
    const place = `θ1 = ${degrees(turn)}, d2 = ${shown(slide, 1)} m`;
    return no(`Not yet: at ${place} your tool is at ${words(found)}, and the tool of RP at ${words(wanted)}.`, [
      turn,
      slide,
    ]);
  }
  return { solved: true, says: "Right: the tool is where it is to be at three configurations." };
}

function jointsCounted(joints: number): string {
  return joints === 0 ? "is none" : joints === 1 ? "is one" : `are ${joints}`;
}

function degrees(value: number): string {
  return `${shown((value * 180) / Math.PI, 0)}°`;
}

function words([x, y, angle]: Pose): string {
  return `(${shown(x, 2)}, ${shown(y, 2)}, ${degrees(angle)})`;
}
