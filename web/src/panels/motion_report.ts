import { saveFile } from "../share/save_file.js";
import type { Branch } from "./branch_map.js";
import { element, shown, table } from "./element.js";

/** What the page shows of the answer of `beeline line` and `beeline check`. */
export interface LineAnswer {
  status: string;
  reason: string;
  duration?: number | null;
  samples?: number;
  waypoints: number;
  deviation_bound?: number | null;
  deviation_measured?: number | null;
  orientation_bound?: number | null;
  orientation_measured?: number | null;
  limits?: Record<string, { fraction: number; joint: string; assumed?: boolean } | null>;
  limit_margin?: number | null;
  inverse_condition?: number | null;
  branches?: Branch[];
}

function small(value: number | null | undefined, unit: string): string {
  if (value === null || value === undefined) return "—";
  return `${value.toExponential(1).replace("-", "−").replace("+", "")} ${unit}`;
}

/** Status, reason, deviation measured and proved, use of the limits. */
export function planReport(answer: LineAnswer): HTMLElement {
  const time = answer.duration == null ? "" : `, ${shown(answer.duration, 2)} s`;
  const parts: HTMLElement[] = [element("p", {}, element("strong", {}, answer.status), `${time}. ${answer.reason}`)];
  if (answer.deviation_bound !== undefined && answer.deviation_bound !== null) {
    parts.push(
      table(
        "Deviation from the line",
        ["measured", "proved"],
        ["position", "orientation"],
        [
          [small(answer.deviation_measured, "m"), small(answer.deviation_bound, "m")],
          [small(answer.orientation_measured, "rad"), small(answer.orientation_bound, "rad")],
        ],
      ),
    );
  }
  const used = Object.entries(answer.limits ?? {}).flatMap(([name, use]) => (use ? [{ name, ...use }] : []));
  if (used.length > 0) {
    const rows = used.map(({ fraction, joint, assumed }) => [
      `${shown(100 * fraction, 1)} %`,
      joint,
      assumed === true ? "assumed" : "",
    ]);
    parts.push(
      table(
        "Largest use of the limits",
        ["", "at joint", ""],
        used.map(({ name }) => name),
        rows,
      ),
    );
  }
  return element("div", { class: "numbers" }, ...parts);
}

/** A button that saves a text, made when it is pressed, as a file. */
export function fileSaver(name: string, text: () => string, type: string): HTMLElement {
  const save = (): void => saveFile(name, new Blob([text()], { type }));
  return element("button", { type: "button", onclick: save }, `Save ${name}`);
}
