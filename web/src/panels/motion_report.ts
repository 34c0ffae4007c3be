import type { JointDescription } from "../core/description.js";
import { saveFile } from "../share/save_file.js";
import { element, shown, table } from "../elements/element.js";
import { angles, lengths, small, unitOf } from "../elements/units.js";
import type { Branch } from "./branch_map.js";
import { reasonInWords, type Reason, type Wording } from "./reasons/reasons.js";

/** What the page shows of the answer of `beeline line` and `beeline check`. */
export interface LineAnswer extends Reason {
  status: string;
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

const rounding = 1e-9;

/** Whether a motion exceeds a limit of a joint: a recording may, and is played all the same. */
export function exceedsLimits({ limits = {} }: LineAnswer): boolean {
  return Object.values(limits).some((use) => use !== null && use.fraction > 1 + rounding);
}

/** Status, reason, deviation measured and proved, use of the limits. What exceeds a limit is red, and not reached. */
export function planReport(answer: LineAnswer, joints: JointDescription[], wording: Wording): HTMLElement {
  const time = answer.duration == null ? "" : `, ${shown(answer.duration, 2)} s`;
  const exceeds = exceedsLimits(answer);
  const good = !exceeds && ["reached", "passed"].includes(answer.status);
  const status = exceeds && answer.status === "reached" ? "exceeds the limits" : answer.status.replaceAll("_", " ");
  const parts: HTMLElement[] = [
    element(
      "p",
      {},
      element("strong", { class: good ? "good" : "over" }, status),
      `${time}. ${reasonInWords(answer, wording)}`,
    ),
  ];
  const proof = proofInWords(answer);
  if (good && proof !== "") parts.unshift(element("p", { class: "proof" }, proof));
  const tables: HTMLElement[] = [];
  if (answer.deviation_bound !== undefined && answer.deviation_bound !== null) {
    tables.push(
      table(
        "Deviation from the line",
        ["measured", "proved"],
        ["position", "orientation"],
        [
          [small(answer.deviation_measured, lengths), small(answer.deviation_bound, lengths, "up")],
          [small(answer.orientation_measured, angles), small(answer.orientation_bound, angles, "up")],
        ],
      ),
    );
  }
  const used = Object.entries(answer.limits ?? {}).flatMap(([name, use]) => (use ? [{ name, ...use }] : []));
  if (used.length > 0) {
    const rows = used.map(({ fraction, joint, assumed }) => [
      fraction > 3 ? `${shown(fraction, fraction < 10 ? 1 : 0)} times` : `${shown(100 * fraction, 1)} %`,
      joint,
      assumed === true ? "assumed" : "",
    ]);
    const made = table(
      "Largest use of the limits",
      ["", "at joint", ""],
      used.map(({ name }) => name),
      rows,
    );
    used.forEach(({ fraction }, i) => made.tBodies[0]?.rows[i]?.classList.toggle("over", fraction > 1 + rounding));
    tables.push(element("div", { class: "wide" }, made));
    const assumedHere = assumptions(used, joints, wording.degrees);
    if (assumedHere !== "") parts.push(element("p", { class: "quiet" }, assumedHere));
  }
  const folded = element("details", { open: exceeds }, element("summary", {}, "Deviation and limits"), ...tables);
  return element("div", { class: "numbers" }, ...parts, ...(tables.length > 0 ? [folded] : []));
}

/** What is proved, in one sentence; none where nothing is. */
function proofInWords({ deviation_bound: bound }: LineAnswer): string {
  if (bound === undefined || bound === null) return "";
  return `Proved: at every time the tool is within ${small(bound, lengths, "up")} of the line.`;
}

/** Which limits are not published for the arm, and what is assumed instead. */
function assumptions(
  used: { name: string; joint: string; assumed?: boolean }[],
  joints: JointDescription[],
  degrees: boolean,
): string {
  const assumed = used.filter((use) => use.assumed === true);
  if (assumed.length === 0) return "";
  const values = assumed.flatMap(({ name, joint }) => {
    const { assumed: here, type } = joints.find((one) => one.name === joint) ?? {};
    const value = name === "velocity" || name === "acceleration" ? here?.[name] : undefined;
    const unit = unitOf(type ?? "revolute", degrees);
    const per = name === "acceleration" ? "/s²" : "/s";
    const space = unit.name === "°" ? "" : " ";
    return value === undefined ? [] : `${shown(value * unit.factor, 1).replace(/\.0$/, "")}${space}${unit.name}${per}`;
  });
  const names = new Intl.ListFormat("en").format(assumed.map(({ name }) => name));
  return `No limits of ${names} are published for this arm; ${values.join(" and ")} ${values.length > 1 ? "are" : "is"} assumed.`;
}

/** A button that saves a text, made when it is pressed, as a file. */
export function fileSaver(name: string, text: () => string, type: string): HTMLElement {
  const save = (): void => saveFile(name, new Blob([text()], { type }));
  return element("button", { type: "button", onclick: save }, `Save ${name}`);
}
