import { element, shown } from "../elements/element.js";
import { dotsOf, pathOf, svg } from "../elements/svg.js";
import { jointColour } from "../scene/colours.js";

/** What `beeline arms --json` says of a built-in arm, and its picture in 96 x 72 pixels. */
export interface ListedArm {
  name: string;
  maker: string;
  model: string;
  /** The kinds of the joints, such as RRRP. */
  joints: string;
  dof: number;
  planar: boolean;
  /** m; null: without bounds. */
  reach: number | null;
  picture: { line: [number, number][]; joints: [number, number][] };
}

/** The picture of an arm in the look of the figures. */
export function thumbnail({ picture: { line, joints } }: ListedArm): SVGSVGElement {
  const path = pathOf(line);
  const [x, y] = line[0] ?? [0, 0];
  return svg(
    "svg",
    { class: "thumbnail", viewBox: "0 0 96 72", "aria-hidden": "true" },
    svg("path", { class: "ground", d: `M${x - 9} ${y + 4}h18` }),
    svg("path", { class: "rim", d: path, "stroke-width": 6 }),
    svg("path", { class: "core", d: path, "stroke-width": 4.2 }),
    ...joints.map((at, k) =>
      svg(
        "g",
        {},
        svg("path", { class: "rim", d: dotsOf([at]), "stroke-width": 7.4 }),
        svg("path", { class: "joint", d: dotsOf([at]), "stroke-width": 5.6 }),
        svg("path", { d: dotsOf([at]), "stroke-width": 3, style: `stroke: ${jointColour(k)}` }),
      ),
    ),
  );
}

/** Letters and digits of what is searched, in small letters. */
function words(text: string): string[] {
  return text
    .toLowerCase()
    .split(/[\s,;]+/)
    .filter((word) => word !== "");
}

function textOf({ name, maker, model, joints, dof, planar }: ListedArm): string {
  return [name, maker, model, joints, `${dof} joints`, planar ? "planar" : "spatial"].join(" ").toLowerCase();
}

/** All arms as cards with pictures, maker, joints and reach; those that fit a search. */
export class Gallery {
  readonly root = element("ul", { class: "gallery", "aria-label": "Built-in arms" });
  readonly count = element("p", { class: "quiet", role: "status" });
  private cards: { arm: ListedArm; item: HTMLElement }[] = [];

  constructor(
    private readonly arms: ListedArm[],
    private readonly chosen: (name: string) => void,
  ) {}

  /** Shows the arms that have each of the words in name, maker, model or joints; the one of the name stands first. */
  search(text: string): void {
    const found = this.found(text);
    if (this.cards.length === 0) this.build(); // when the gallery is first seen
    for (const { arm, item } of this.cards) item.hidden = !found.includes(arm);
    this.count.textContent = `${found.length} of ${this.arms.length} arms`;
  }

  private build(): void {
    this.cards = this.arms.map((arm) => ({ arm, item: element("li", {}, card(arm, this.chosen)) }));
    this.root.append(...this.cards.map(({ item }) => item));
  }

  found(text: string): ListedArm[] {
    const [counted = "", dof] = /\b(\d+)[\s-]*(?:joints?|axes|axis|dof)\b/i.exec(text) ?? [];
    const wanted = words(text.replace(counted, ""));
    const fitting = this.arms.filter(
      (arm) => (dof === undefined || arm.dof === Number(dof)) && wanted.every((word) => textOf(arm).includes(word)),
    );
    return fitting.sort((a, b) => Number(b.name === text) - Number(a.name === text));
  }
}

function card(arm: ListedArm, chosen: (name: string) => void): HTMLElement {
  const { name, maker, model, dof, joints, reach } = arm;
  const far = reach === null ? "reach without bounds" : `reach ${shown(reach, reach >= 2 ? 1 : 2)} m`;
  return element(
    "button",
    { type: "button", class: "card", onclick: () => chosen(name) },
    thumbnail(arm),
    element("strong", {}, name),
    element("span", {}, `${maker} ${model}`),
    element("span", { class: "quiet" }, `${dof} joints, ${joints}; ${far}`),
  );
}
