import type { JointDescription } from "../core/description.js";
import { saveFile } from "../share/save_file.js";
import { element, shown, table } from "../elements/element.js";
import { angles, lengths, small, unitOf } from "../elements/units.js";
import type { Branch } from "./branch_map.js";
import { closestInWords, guarantee, pairsThatMayTouch, uncheckedInWords, type ClearanceAnswer } from "./clearance.js";
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
  /** The proof that the arm keeps its clearance from obstacles; of a motion in a scene. */
  clearance?: ClearanceAnswer | null;
  /** The branches that do not keep the clearance, with what they hit. */
  blocked?: (Reason & { start: number[]; status: string })[];
}

const rounding = 1e-9;

/** Whether a motion exceeds a limit of a joint: a recording may, and is played all the same. */
export function exceedsLimits({ limits = {} }: LineAnswer): boolean {
  return Object.values(limits).some((use) => use !== null && use.fraction > 1 + rounding);
}

/** Status, reason, deviation measured and proved, use of the limits. What exceeds a limit is red, and not reached.
 * `unchecked`: why obstacles are not checked; empty: they are, or there are none. */
export function planReport(
  answer: LineAnswer,
  joints: JointDescription[],
  wording: Wording,
  unchecked = "",
): HTMLElement {
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
  const about = good ? aboutClearance(answer, unchecked) : [];
  parts.push(...about.map((text) => element("p", { class: "quiet" }, text)));
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
  const title = answer.deviation_bound == null ? "Limits" : "Deviation and limits";
  const folded = element("details", { open: exceeds }, element("summary", {}, title), ...tables);
  const touching = good && answer.clearance ? touchingPairs(answer.clearance) : [];
  return element("div", { class: "numbers" }, ...parts, ...(tables.length > 0 ? [folded] : []), ...touching);
}

/** What is to be said beside the proof of a clearance, or in its place. */
function aboutClearance({ clearance }: LineAnswer, unchecked: string): string[] {
  const texts = clearance
    ? [`${closestInWords(clearance)} ${uncheckedInWords(clearance)}`.trim()]
    : [unchecked === "" ? "" : `Not checked against the obstacles: ${unchecked}`];
  return texts.filter((text) => text !== "");
}

/** The pairs of bodies that are left out of the proof, folded. */
function touchingPairs(clearance: ClearanceAnswer): HTMLElement[] {
  const lines = pairsThatMayTouch(clearance);
  if (lines.length === 0) return [];
  const summary = element("summary", {}, "Pairs that may touch");
  return [element("details", { class: "touching" }, summary, ...lines.map((line) => element("p", {}, line)))];
}

/** What is proved, in one sentence; none where nothing is. */
function proofInWords({ deviation_bound: bound, clearance }: LineAnswer): string {
  const kept = clearance ? guarantee(clearance) : "";
  const parts = [
    ...(bound == null ? [] : [`the tool is within ${small(bound, lengths, "up")} of the line`]),
    ...(kept === "" ? [] : [kept]),
  ];
  return parts.length === 0 ? "" : `Proved: at every time ${parts.join(", and ")}.`;
}

/** The branches, with those that are blocked as such. */
export function branchesOf({ branches = [], blocked = [] }: LineAnswer): Branch[] {
  const isSame = (a: number[], b: number[]): boolean => a.every((value, k) => value === b[k]);
  return branches.map((branch) => {
    const found = branch.status === "reached" && blocked.find(({ start }) => isSame(start, branch.start));
    return found
      ? { ...branch, status: found.status, reason: found.reason, code: found.code, fields: found.fields }
      : branch;
  });
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
