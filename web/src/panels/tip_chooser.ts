import { element } from "./element.js";

/** The links of a URDF text at which a chain can end: those that carry no joint. */
export function tipsOf(urdf: string): string[] {
  const document = new DOMParser().parseFromString(urdf, "text/xml");
  const parents = new Set(
    [...document.querySelectorAll("joint > parent")].map((parent) => parent.getAttribute("link")),
  );
  const links = [...document.querySelectorAll("robot > link")].map((link) => link.getAttribute("name") ?? "");
  return links.filter((link) => !parents.has(link));
}

/** Asks where the chain of a URDF with several ends shall end. */
export class TipChooser {
  readonly root = element("p", { class: "pair", hidden: true });
  private readonly choice = element("select", { id: "tip" });

  constructor(chosen: (tip: string) => void) {
    const go = element("button", { type: "button", onclick: () => chosen(this.choice.value) }, "End there");
    this.root.append(element("label", { for: "tip" }, "Tip"), this.choice, go);
  }

  ask(tips: string[]): void {
    this.choice.replaceChildren(...tips.map((tip) => element("option", {}, tip)));
    this.root.hidden = tips.length < 2;
  }
}
