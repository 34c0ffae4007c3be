import { ofBodies } from "./collision.js";
import { inControl } from "./control.js";
import { Fields, type Reason, type Wording } from "./fields.js";
import { ofInverse } from "./inverse.js";
import { inMotion } from "./motion.js";
import { onPath } from "./path.js";

export type { Reason, Wording } from "./fields.js";

/** A reason in the words and units of the page, as a sentence; what the page has no words for is said as the command says
 * it. Empty without a reason. */
export function reasonInWords(reason: Reason, wording: Wording): string {
  const text = clauseOf(reason, wording);
  return text === "" ? "" : `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;
}

/** The same as a part of a sentence. */
export function clauseOf(reason: Reason, wording: Wording): string {
  const text = inPageWords(reason, wording);
  return text === null ? reason.reason : text + hints(new Fields(reason, wording));
}

/** In the words of the page; null where it has none for the code. */
export function inPageWords(reason: Reason, wording: Wording): string | null {
  const fields = new Fields(reason, wording);
  return ofInverse(fields) ?? onPath(fields) ?? inMotion(fields) ?? ofBodies(fields) ?? inControl(fields);
}

/** What the numbers probably are, and what the controller shows. */
function hints(fields: Fields): string {
  const said = [
    fields.is("in_millimetres") && "positions are in metres, and these numbers are probably in millimetres",
    fields.is("in_degrees") && "angles are in radians, and this one is probably in degrees",
    fields.is("overshoots") && "the controller overshoots: the gains are too large",
    fields.is("at_singularity") && "the arm is singular there, and no joint moves the tool towards the goal",
  ];
  return said.map((text) => (text === false ? "" : `; ${text}`)).join("");
}
