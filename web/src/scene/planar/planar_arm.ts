import type { Skeleton } from "../../core/types.js";
import { children, pathOf, set, svg } from "../../elements/svg.js";
import { jointColour } from "../colours.js";
import type { Pixel } from "../labels.js";
import type { PlaneView } from "./plane_view.js";

export const linkWidth = 8; // points, as in the figures
const rim = 1.1;
const jointRadius = 6.5;
const foot = 14;

/** A factor on the sizes of symbols, which decreases with the number of joints. */
export function sizeFor(joints: number): number {
  return Math.min(1, Math.max(0.15, Math.sqrt(10 / joints)));
}

/** The centre line of each link, 0 the base, and the thinner rod of each prismatic joint. */
export function linkLines({ base, joints, tool }: Skeleton): { links: number[][][]; rods: number[][][] } {
  const links: number[][][] = [];
  const rods: number[][][] = [];
  let points = [base];
  for (const { kind, enter, leave, centre } of joints) {
    points.push(enter);
    if (kind !== "prismatic") points.push(centre);
    links.push(points);
    points = kind === "prismatic" ? [leave] : [centre, leave];
    if (kind === "prismatic") rods.push([enter, leave]);
  }
  links.push([...points, tool]);
  return { links, rods };
}

/** A planar arm as `beeline draw` draws it: a hatched support, outlined links, white joints with a dot in the joint's
 * colour. Link k is taken hold of as joint k. */
export class PlanarArm {
  readonly root = svg("g");
  private readonly support = svg("g", { class: "support" });
  private readonly rods = svg("g");
  private readonly links = svg("g");
  private readonly joints = svg("g");
  private readonly grips = svg("g");

  /** `tone`: of a ghost; the arm itself has none, and `names` of its joints. */
  constructor(
    private readonly tone = "",
    private readonly names: string[] = [],
  ) {
    this.root.setAttribute("class", tone === "" ? "arm" : `arm ghost ${tone}`);
    if (tone === "") {
      this.support.append(svg("path", { class: "link" }), svg("path", { class: "hatch" }));
      this.root.append(this.support);
    }
    this.root.append(this.rods, this.links, this.joints, this.grips);
  }

  place(skeleton: Skeleton, view: PlaneView): void {
    const unit = view.unit * sizeFor(skeleton.joints.length);
    const { links, rods } = linkLines(skeleton);
    const paths = (lines: number[][][]): string[] => lines.map((line) => pathOf(line.map((p) => view.pixel(p))));
    this.bars(this.rods, paths(rods), (unit * linkWidth) / 2, unit);
    const bars = links
      .map((line) => (hasLength(line) ? line : []))
      .map((line) => pathOf(line.map((p) => view.pixel(p))));
    this.bars(this.links, bars, unit * linkWidth, unit);
    const symbols = children(this.joints, skeleton.joints.length, (k) =>
      jointSymbol(k, skeleton.joints[k]?.kind ?? ""),
    );
    skeleton.joints.forEach(({ centre, direction }, k) => {
      const [x, y] = view.pixel(centre);
      const turn = (-Math.atan2(direction[1] ?? 0, direction[0] ?? 1) * 180) / Math.PI;
      const rotation = skeleton.joints[k]?.kind === "prismatic" ? ` rotate(${turn.toFixed(2)})` : "";
      set(symbols[k] as SVGElement, {
        transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})${rotation} scale(${unit.toFixed(3)})`,
      });
    });
    if (this.tone !== "") return;
    this.placeSupport(view.pixel(skeleton.base), unit);
    const wide = Math.max(24, 2.4 * unit * linkWidth);
    const grips = children(this.grips, links.length - 1, (k) =>
      svg(
        "path",
        { class: "grip", "data-grab": `joint ${k}`, style: `--joint: ${jointColour(k)}` },
        svg("title", {}, this.names[k] ?? ""),
      ),
    );
    grips.forEach((grip, k) => {
      const { enter, leave, kind } = skeleton.joints[k] as Skeleton["joints"][number];
      const rod = kind === "prismatic" ? pathOf([view.pixel(enter), view.pixel(leave)]) : "";
      set(grip, { d: rod + (bars[k + 1] ?? ""), "stroke-width": wide });
    });
  }

  private bars(group: SVGElement, paths: string[], width: number, unit: number): void {
    const pairs = children(group, paths.length, () =>
      svg("g", {}, svg("path", { class: "rim" }), svg("path", { class: "core" })),
    );
    pairs.forEach((pair, i) => {
      set(pair.children[0] as SVGElement, { d: paths[i] ?? "", "stroke-width": (width + 2 * rim * unit).toFixed(2) });
      set(pair.children[1] as SVGElement, { d: paths[i] ?? "", "stroke-width": width.toFixed(2) });
    });
  }

  private placeSupport([x, y]: Pixel, unit: number): void {
    const [stand, hatch] = [...this.support.children] as SVGElement[];
    const hatches = Array.from({ length: 7 }, (_, i) => `M${-11.9 + 4.4 * i} ${foot}l-4.9 4.9`).join("");
    set(stand as SVGElement, { d: `M-4.5 0L4.5 0L10.5 ${foot}L-10.5 ${foot}Z` });
    set(hatch as SVGElement, { d: `M-15 ${foot}L15 ${foot}${hatches}` });
    set(this.support, { transform: `translate(${x.toFixed(2)} ${y.toFixed(2)}) scale(${unit.toFixed(3)})` });
  }
}

function hasLength(line: number[][]): boolean {
  return line.some((p) => Math.hypot(...p.map((value, i) => value - (line[0]?.[i] ?? 0))) > 1e-9);
}

function jointSymbol(k: number, kind: string): SVGElement {
  const colour = `fill: ${jointColour(k)}`;
  if (kind === "prismatic")
    return svg(
      "g",
      {},
      svg("rect", { class: "joint-shape", x: -9.5, y: -6, width: 19, height: 12 }),
      svg("rect", { x: -5.5, y: -1.6, width: 11, height: 3.2, rx: 1.6, style: colour }),
    );
  return svg(
    "g",
    {},
    svg("circle", { class: "joint-shape", r: jointRadius }),
    svg("circle", { r: 2.9, style: colour }),
  );
}
