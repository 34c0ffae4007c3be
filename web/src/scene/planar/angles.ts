import { headingOf } from "../../core/pose.js";
import type { Skeleton } from "../../core/types.js";
import { shown } from "../../elements/element.js";
import { children, pathOf, set, svg } from "../../elements/svg.js";
import { subscript } from "../../elements/units.js";
import { jointColour } from "../colours.js";
import type { Label, Pixel } from "../labels.js";
import { sizeFor } from "./planar_arm.js";
import type { PlaneView } from "./plane_view.js";

const radius = 34; // points
const maxJoints = 12;
const narrow = 1.1; // rad: the label of a smaller angle stands beside it

/** The angle of each revolute joint: an arc from the direction of the link before, dashed, to the link; the length of
 * each prismatic one. */
export class Angles {
  readonly root = svg("g", { class: "angles", "aria-hidden": "true" });

  /** Draws the arcs; returns the labels with the values. */
  place(skeleton: Skeleton, q: number[], poses: ArrayLike<number>[], view: PlaneView, degrees: boolean): Label[] {
    const { joints } = skeleton;
    const groups = children(this.root, joints.length > maxJoints ? 0 : joints.length, (k) =>
      svg(
        "g",
        { style: `--joint: ${jointColour(k)}` },
        svg("path", { class: "reference" }),
        svg("path", { class: "arc" }),
        svg("path", { class: "head" }),
      ),
    );
    return groups.map((group, k) => {
      const joint = joints[k] as Skeleton["joints"][number];
      const at = view.pixel(joint.centre);
      const value = q[k] ?? 0;
      if (joint.kind === "prismatic") {
        for (const part of group.children) set(part as SVGElement, { d: "" });
        const along = Math.atan2(joint.direction[1] ?? 0, joint.direction[0] ?? 1);
        return label(k, `d${subscript(k + 1)} = ${shown(value, 2)} m`, at, 10, along - Math.PI / 2);
      }
      const next = joints[k + 1]?.centre ?? skeleton.tool;
      const link = view.pixel(next);
      const long = Math.hypot(link[0] - at[0], link[1] - at[1]);
      const size = radius * view.unit * sizeFor(joints.length);
      const r = Math.min(size, Math.max(0.6 * size, 0.5 * long));
      const sense = (joint.direction[2] ?? 1) < 0 ? -1 : 1;
      const end = headingOf(poses[k + 1] ?? []);
      const begin = end - sense * value;
      const turn = sense * Math.max(-2 * Math.PI, Math.min(2 * Math.PI, value));
      draw(group, at, begin, turn, r, view.unit);
      const text = degrees ? `${shown((value * 180) / Math.PI, 1)}°` : shown(value, 3);
      const beside = Math.abs(turn) < narrow ? begin - 0.45 * (Math.sign(turn) || 1) : begin + turn / 2;
      return label(k, `θ${subscript(k + 1)} = ${text}`, at, r + 4, beside);
    });
  }
}

function draw(group: SVGElement, centre: Pixel, begin: number, turn: number, r: number, unit: number): void {
  const [reference, arc, head] = [...group.children] as SVGElement[];
  const at = (angle: number, far: number): Pixel => [
    centre[0] + far * Math.cos(angle),
    centre[1] - far * Math.sin(angle),
  ];
  set(reference as SVGElement, { d: pathOf([at(begin, 9 * unit), at(begin, r + 18)]) });
  const pieces = Math.max(2, Math.ceil(Math.abs(turn) / 0.1));
  const points = Array.from({ length: pieces + 1 }, (_, i) => at(begin + (turn * i) / pieces, r));
  const long = Math.abs(turn) * r > 14;
  set(arc as SVGElement, { d: Math.abs(turn) * r > 3 ? pathOf(points) : "" });
  set(head as SVGElement, { d: long ? arrowHead(at(begin + turn, r), begin + turn, Math.sign(turn)) : "" });
}

/** In the colour of its joint, which it may be far from, darkened or lightened to be read. */
function label(k: number, text: string, at: Pixel, away: number, angle: number): Label {
  const colour = `color-mix(in srgb, ${jointColour(k)} 60%, var(--text))`;
  return { key: `angle ${k}`, text, at, away, angle, kind: "angle", colour };
}

/** An arrowhead at the end of an arc, across its radius. */
function arrowHead([x, y]: Pixel, angle: number, sense: number): string {
  const [tx, ty] = [-sense * Math.sin(angle), -sense * Math.cos(angle)];
  const back = (along: number, beside: number): Pixel => [x - along * tx + beside * ty, y - along * ty - beside * tx];
  return `${pathOf([[x, y], back(9, 3.4), back(7, 0), back(9, -3.4)])}Z`;
}
