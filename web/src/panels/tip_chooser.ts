import { element } from "../elements/element.js";

/** A link of a URDF at which a chain can end. */
export interface ChainEnd {
  link: string;
  /** It carries several joints: the chain ends before them. */
  branches: boolean;
}

/** The links of a URDF text at which a chain can end: those that carry no joint, then those that carry several. */
export function endsOf(urdf: string): ChainEnd[] {
  const document = new DOMParser().parseFromString(urdf, "text/xml");
  const carried = new Map<string, number>();
  for (const parent of document.querySelectorAll("joint > parent")) {
    const link = parent.getAttribute("link") ?? "";
    carried.set(link, (carried.get(link) ?? 0) + 1);
  }
  const links = [...document.querySelectorAll("robot > link")].map((link) => link.getAttribute("name") ?? "");
  const tips = links.filter((link) => !carried.has(link));
  const forks = links.filter((link) => (carried.get(link) ?? 0) > 1);
  return [...tips.map((link) => ({ link, branches: false })), ...forks.map((link) => ({ link, branches: true }))];
}

/** Asks where the chain of a URDF with several ends shall end. */
export class TipChooser {
  readonly root = element("p", { class: "pair tips", hidden: true });
  private readonly choice = element("select", { id: "tip" });

  constructor(chosen: (tip: string) => void) {
    const go = element("button", { type: "button", onclick: () => chosen(this.choice.value) }, "End there");
    this.root.append(element("label", { for: "tip" }, "Where does the arm end?"), this.choice, go);
  }

  /** Asks for one of these ends; nothing where there is none. */
  ask(ends: ChainEnd[]): void {
    const text = ({ link, branches }: ChainEnd): string => (branches ? `${link}, before it branches` : link);
    this.choice.replaceChildren(...ends.map((end) => element("option", { value: end.link }, text(end))));
    this.root.hidden = ends.length === 0;
  }

  focus(): void {
    this.choice.focus();
  }
}
