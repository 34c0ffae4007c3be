import { element, shown } from "../elements/element.js";
import { reasonInWords, type Reason, type Wording } from "./reasons/reasons.js";

/** One way to follow the path, from one solution of inverse kinematics at its first pose. */
export interface Branch extends Reason {
  start: number[];
  status: string;
  /** How far it follows the path: whole lines, with a fraction of the next. */
  path_parameter: number;
  limit_margin: number;
  inverse_condition: number;
}

const singular = 1e-4; // inverse condition: a smaller one has no meaning as a number

/** The branches as a map: a row each, as long as it follows the path, the waypoints as marks; where it ends and why, or
 * how far it stays from joint limits and singularities. A click plans the path along a branch that follows all of it.
 * `current`: the joint values at which the motion that is shown begins. */
export function branchMap(
  branches: Branch[],
  lines: number,
  current: number[] | null,
  wording: Wording,
  chosen: (start: number[]) => void,
): HTMLElement {
  const rows = branches.map((branch, i) => row(branch, i, lines, isAt(branch.start, current), wording, chosen));
  return element(
    "section",
    { "aria-label": "Branches", class: "branches" },
    element("h2", {}, "Branches"),
    element(
      "p",
      { class: "quiet" },
      "From the first waypoint, left, to the last; those that follow all of it come first.",
    ),
    element("ol", {}, ...rows),
  );
}

function isAt(start: number[], current: number[] | null): boolean {
  return current !== null && start.every((value, k) => Math.abs(value - (current[k] ?? NaN)) < 1e-6);
}

function row(
  branch: Branch,
  index: number,
  lines: number,
  pressed: boolean,
  wording: Wording,
  chosen: (start: number[]) => void,
): HTMLElement {
  const whole = branch.status === "reached";
  const percent = (100 * branch.path_parameter) / lines;
  const margins =
    `margin to joint limits ${shown(100 * branch.limit_margin, 0)} %, ` +
    (branch.inverse_condition < singular ? "singular" : `condition ${shown(1 / branch.inverse_condition, 1)}`);
  const marks = Array.from({ length: lines - 1 }, (_, i) =>
    element("i", { class: "mark", style: `left: ${(100 * (i + 1)) / lines}%` }),
  );
  const bar = element(
    "span",
    { class: whole ? "bar whole" : "bar", "aria-hidden": "true" },
    element("b", { style: `width: ${percent}%` }),
    ...marks,
  );
  const button = element(
    "button",
    { type: "button", disabled: !whole, "aria-pressed": String(pressed), onclick: () => chosen(branch.start) },
    `Branch ${index + 1}`,
  );
  const reason = reasonInWords(branch, wording);
  const isBlocked = branch.status === "collides" || branch.status === "blocked" || branch.status === "not_decided";
  const text = whole ? margins : isBlocked ? reason : `ends after ${shown(percent, 0)} % of the path. ${reason}`;
  return element("li", {}, button, bar, element("span", { class: "quiet" }, text));
}
