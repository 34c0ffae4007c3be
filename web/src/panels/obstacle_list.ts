import { element } from "../elements/element.js";

/** What the list calls. */
interface Chosen {
  select(index: number): void;
  hide(name: string): void;
  remove(name: string): void;
}

/** The obstacles by name: one is selected, each can be hidden and removed. */
export class ObstacleList {
  readonly root = element("ol", { class: "obstacles", "aria-label": "Obstacles of the scene" });

  constructor(private readonly chosen: Chosen) {}

  show(names: string[], selected: number | null, hidden: ReadonlySet<string>, close: readonly string[]): void {
    const focus = [...this.root.querySelectorAll("button")].indexOf(document.activeElement as HTMLButtonElement);
    const rows = names.map((name, i) => this.row(name, i, i === selected, hidden.has(name), close.includes(name)));
    this.root.replaceChildren(...rows);
    this.root.hidden = names.length === 0;
    const buttons = this.root.querySelectorAll("button");
    if (focus >= 0) buttons[Math.min(focus, buttons.length - 1)]?.focus();
  }

  private row(name: string, index: number, isSelected: boolean, isHidden: boolean, isClose: boolean): HTMLElement {
    const select = element(
      "button",
      {
        type: "button",
        class: isClose ? "name over" : "name",
        "aria-pressed": String(isSelected),
        onclick: () => this.chosen.select(index),
      },
      name,
    );
    const hide = element(
      "button",
      {
        type: "button",
        "aria-pressed": String(isHidden),
        "aria-label": `Hide ${name}`,
        title: "Not drawn; it counts all the same",
        onclick: () => this.chosen.hide(name),
      },
      "Hide",
    );
    const label = `Remove ${name}`;
    const remove = element(
      "button",
      {
        type: "button",
        class: "remove",
        "aria-label": label,
        title: label,
        onclick: () => this.chosen.remove(name),
      },
      "×",
    );
    return element("li", {}, select, hide, remove);
  }
}
