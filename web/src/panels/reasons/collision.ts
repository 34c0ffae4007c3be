import { shown } from "../../elements/element.js";
import { distance } from "../../elements/units.js";
import type { Fields } from "./fields.js";
import { inMotion } from "./motion.js";

/** Which bodies come too close, and where; null for another reason. */
export function ofBodies(fields: Fields): string | null {
  const bodies = `the bodies ${fields.text("body")} and ${fields.text("other_body")}`;
  const far = distance(fields.number("distance"));
  const least = distance(fields.number("clearance"));
  switch (fields.of.code) {
    case "bodies_collide":
      return `${fields.when}${bodies} overlap at ${fields.point("position")}, ${distance(-fields.number("depth"))}`;
    case "bodies_too_close":
      return `${fields.when}${bodies} are ${far} apart at ${fields.point("position")}; ${least} are required`;
    case "clearance_not_decided":
      return `${bodies} are about ${far} apart, too near to the clearance of ${least} to decide`;
    case "all_solutions_blocked":
      return `every solution is blocked${first(fields)}`;
    case "solutions_blocked":
      return `every solution that was found is blocked${first(fields)}`;
    case "start_not_free":
      return `where the arm stands ${blocking(fields)}`;
    case "goal_not_free":
      return `at the goal ${blocking(fields)}`;
    case "no_free_path":
      return `no way around was found, with ${shown(fields.number("count"), 0)} straight joint motions; there may be one`;
    default:
      return null;
  }
}

/** Why the arm cannot stand where a motion begins or ends. */
function blocking(fields: Fields): string {
  const [detail] = fields.details();
  return detail ? (ofBodies(detail) ?? inMotion(detail) ?? detail.of.reason) : "a clearance or a limit is not kept";
}

/** What blocks the first of the solutions. */
function first(fields: Fields): string {
  const [detail] = fields.details();
  return detail ? `; in the first one ${ofBodies(detail) ?? detail.of.reason}` : "";
}
