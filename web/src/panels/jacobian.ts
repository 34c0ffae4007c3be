import type { Manipulability } from "../core/types.js";
import type { PageState } from "../state/page_state.js";
import { jointColour } from "../scene/colours.js";
import { element, shown, table } from "../elements/element.js";
import { fading } from "../elements/fading.js";

const rows = ["vx", "vy", "vz", "ωx", "ωy", "ωz"];
const frames: Record<PageState["frame"], string> = {
  base: "base: the tool point's velocity, base axes",
  tool: "tool: the tool point's velocity, tool axes",
  space: "space: the twist at the base's origin",
};

/** The Jacobian as a table in a frame that can be chosen, and how near a singularity is. */
export class JacobianPanel {
  readonly root = element("section", { class: "numbers", "aria-label": "Jacobian" });
  private readonly choice: HTMLSelectElement;
  private readonly numbers = fading(
    element("div", { class: "wide", tabindex: 0, role: "region", "aria-label": "Table of the Jacobian" }),
  );
  private readonly caption = element(
    "p",
    { class: "caption", id: "jacobian-caption" },
    "Jacobian: m/s and rad/s of the tool, per rad/s or m/s of each joint",
  );
  private readonly measure = element("p", { role: "status" });

  constructor(chosen: (frame: PageState["frame"]) => void) {
    const options = Object.entries(frames).map(([value, text]) => element("option", { value }, text));
    this.choice = element("select", { onchange: () => chosen(this.choice.value as PageState["frame"]) }, ...options);
    this.root.append(
      element("label", {}, "Frame of the Jacobian ", this.choice),
      this.caption,
      this.numbers,
      this.measure,
    );
  }

  /** `jacobian`: 6 x n, column-major. */
  show(
    jacobian: Float64Array,
    names: string[],
    frame: PageState["frame"],
    near: Manipulability,
    planar: boolean,
  ): void {
    this.choice.value = frame;
    const shownRows = planar ? [0, 1, 5] : [0, 1, 2, 3, 4, 5];
    const cells = shownRows.map((i) => names.map((_, k) => shown(jacobian[6 * k + i] ?? NaN, 2)));
    const titles = shownRows.map((i) => rows[i] ?? "");
    const made = table("", names, titles, cells);
    made.setAttribute("aria-labelledby", this.caption.id);
    made.querySelectorAll<HTMLElement>("thead th").forEach((title, k) => {
      title.className = "joint-title";
      title.style.setProperty("--joint", jointColour(k));
    });
    this.numbers.replaceChildren(made);
    const smallest = near.singularValues.at(-1) ?? 0;
    const inverseCondition = near.condition > 0 && Number.isFinite(near.condition) ? 1 / near.condition : 0;
    this.measure.textContent =
      `Manipulability ${shown(near.manipulability)}; smallest singular value ${shown(smallest)}` +
      (inverseCondition < 0.02 ? ". Near a singularity: some tool velocities need very fast joints." : ".");
  }
}
