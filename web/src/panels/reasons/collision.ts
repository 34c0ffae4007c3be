import { distance } from "../../elements/units.js";
import type { Fields } from "./fields.js";

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
    default:
      return null;
  }
}

/** What blocks the first of the solutions. */
function first(fields: Fields): string {
  const [detail] = fields.details();
  return detail ? `; in the first one ${ofBodies(detail) ?? detail.of.reason}` : "";
}
