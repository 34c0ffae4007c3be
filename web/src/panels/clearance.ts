import { shown } from "../elements/element.js";
import { distance } from "../elements/units.js";

type NamedPair = [string, string];

/** What the page shows of the proof of a clearance. */
export interface ClearanceAnswer {
  least_distance: number | null;
  /** The pair that is nearest to its clearance, and when; null if none was found. */
  pair: NamedPair | null;
  lower: number | null;
  time: number | null;
  links_without_shapes: string[];
  nothing_checked: boolean;
  /** How many pairs of bodies count. */
  pairs: number;
  /** Pairs that may touch: of the scene, of its matrix, of the SRDF file, and of links at one joint. */
  allowed_pairs: NamedPair[];
  exempted_pairs: NamedPair[];
  srdf_pairs: NamedPair[];
  neighbour_pairs: NamedPair[];
}

/** What is proved of the clearance, as a clause; empty where nothing is. */
export function guarantee({ nothing_checked: isNothing, pairs, least_distance: least }: ClearanceAnswer): string {
  if (isNothing) return "";
  if (pairs === 0) return "no pair of bodies meets within the joint limits";
  if (least === null) return "";
  const who = pairs === 1 ? "the pair of bodies that counts" : `each of the ${pairs} pairs of bodies that count`;
  return `${who} keeps at least ${distance(least)}`;
}

/** Where the arm is nearest to the distance that is required; or that no pair was checked. */
export function closestInWords({ pair, lower, time, nothing_checked: isNothing }: ClearanceAnswer): string {
  if (isNothing) return "Nothing was checked against obstacles: no pair of bodies counts.";
  if (!pair || lower === null || time === null) return "";
  return `Closest: ${pair.join(" and ")}, ${distance(lower)} at ${shown(time, 2)} s.`;
}

/** Which links are not checked against the obstacles; empty where all are. */
export function uncheckedInWords({ links_without_shapes: names }: ClearanceAnswer): string {
  return names.length === 0 ? "" : `Not checked, as they have no shapes: ${names.join(", ")}.`;
}

/** The pairs that may touch, a line for each kind. */
export function pairsThatMayTouch(answer: ClearanceAnswer): string[] {
  const kinds: [string, NamedPair[]][] = [
    ["By the scene", answer.allowed_pairs],
    ["By the scene’s matrix", answer.exempted_pairs],
    ["By the SRDF file", answer.srdf_pairs],
    ["At a joint", answer.neighbour_pairs],
  ];
  return kinds
    .filter(([, pairs]) => pairs.length > 0)
    .map(([kind, pairs]) => `${kind}: ${pairs.map((pair) => pair.join(" and ")).join(", ")}.`);
}
