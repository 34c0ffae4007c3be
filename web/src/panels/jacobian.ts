import type { LostDirection, Singularity } from "../core/singularity.js";
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
    measures: Manipulability & { singularity: Singularity },
    { planar, degrees }: { planar: boolean; degrees: boolean },
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
    const smallest = measures.singularValues.at(-1) ?? 0;
    this.measure.textContent =
      `Manipulability ${shown(measures.manipulability)}; smallest singular value ${shown(smallest)}.` +
      singularInWords(measures.singularity, planar, degrees);
  }
}

/** Says that a configuration is singular, or near one, and which motion of the tool is lost. */
export function singularInWords({ is, rank, full, lost }: Singularity, planar: boolean, degrees: boolean): string {
  if (is === "far") return "";
  const [move, turn] = lost ? motions(lost, planar, degrees) : [];
  const both = [move, turn].filter((one) => one !== undefined);
  if (is === "near") {
    const what = both.length === 0 ? "some tool velocities need" : "the tool needs";
    const to = both.length === 0 ? "" : ` to ${both.join(", and to ")}`;
    return ` Near a singularity: ${what} very fast joints${to}.`;
  }
  if (both.length > 0) return ` At a singularity: the tool cannot ${both.join(", and cannot ")}.`;
  const dimensions = rank === 1 ? "1 dimension" : `${rank} dimensions`;
  return ` At a singularity: the velocities of the tool have ${dimensions}, and ${full} away from singularities.`;
}

/** The linear and the angular part of a lost direction. The one is lost while the other rests. */
function motions({ linear, angular }: LostDirection, planar: boolean, degrees: boolean): (string | undefined)[] {
  const vector = (axis: number[]): string => `(${axis.map((value) => shown(value, 3)).join(", ")})`;
  const direction = (axis: number[]): string => {
    if (!planar) return `${vector(axis)} (linear velocity, base axes)`;
    const angle = Math.atan2(axis[1] ?? 0, axis[0] ?? 0);
    return degrees ? `${shown((angle * 180) / Math.PI, 1)}°` : `${shown(angle, 3)} rad`;
  };
  const move = linear && `move along ${direction(linear)}${angular ? " without turning" : ""}`;
  const axis = angular && (planar ? "" : ` about ${vector(angular)} (angular velocity, base axes)`);
  const turn = angular && `turn${axis ?? ""}${linear ? " in place" : ""}`;
  return [move ?? undefined, turn ?? undefined];
}
