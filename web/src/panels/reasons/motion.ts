import { shown } from "../../elements/element.js";
import type { Fields } from "./fields.js";
import { segmentOf } from "./path.js";

/** What is wrong with a motion in time; null for another reason. */
export function inMotion(fields: Fields): string | null {
  return ofJoint(fields) ?? ofTool(fields) ?? ofTimes(fields);
}

function ofJoint(fields: Fields): string | null {
  const joint = fields.text("joint");
  const when = fields.when;
  switch (fields.of.code) {
    case "outside_limits":
    case "joint_outside_limits":
    case "recording_outside_limits":
      return `${when}${joint} is at ${fields.value("value")}, ${fields.range()}`;
    case "moves_outside_limits":
    case "recording_outside_limits_between":
      return `${after(fields)}${joint} moves to ${fields.value("value")} before the next sample, ${fields.range()}`;
    case "spline_outside_limits":
      return `between two samples ${joint} moves to ${fields.value("value")}, ${fields.range()}`;
    case "rotates_too_far":
      return `${after(fields)}${joint} turns by ${fields.value("change")} to the next sample, more than half a turn`;
    case "derivative_needed":
    case "derivative_reached":
      return `${when}the ${fields.text("quantity")} of ${joint} is ${fields.value("value", fields.per)}; ${limit(fields)}`;
    case "starts_moving":
      return `${joint} starts at ${fields.value("value", "/s")}, not at rest`;
    case "ends_moving":
      return `${joint} ends at ${fields.value("value", "/s")}, not at rest`;
    case "recording_too_fast":
      return `${when}${joint} moves at ${times(fields)} its velocity limit`;
    case "limit_exceeded":
      return exceeded(fields);
    case "moves_after_lead_in":
      return `${exceeded(fields)}: the recording does not start at rest`;
    default:
      return null;
  }
}

function after(fields: Fields): string {
  return fields.has("time") ? `after ${shown(fields.number("time"), 2)} s ` : "";
}

function limit(fields: Fields): string {
  return `its ${fields.is("assumed") ? "assumed " : ""}limit is ${fields.value("limit", fields.per)}`;
}

/** "1.20 times", with the digits that tell it from once. */
function times(fields: Fields): string {
  const use = fields.number("use");
  return `${shown(use, Math.abs(use - 1) < 0.005 ? 6 : 2)} times`;
}

function exceeded(fields: Fields): string {
  const [joint, quantity] = [fields.text("joint"), fields.text("quantity")];
  if (quantity === "position") return `${fields.when}${joint} is ${fields.value("excess")} beyond its position limit`;
  const whose = fields.is("recorded") ? "the recording's own " : fields.is("assumed") ? "its assumed " : "its ";
  return `${fields.when}${joint} uses ${times(fields)} ${whose}${quantity}${fields.is("recorded") ? "" : " limit"}`;
}

function ofTool(fields: Fields): string | null {
  const when = fields.when;
  switch (fields.of.code) {
    case "off_path":
      return `${when}the tool is off the line by ${fields.deviation()}`;
    case "leaves_path":
      return `${after(fields)}the tool leaves the line by ${fields.deviation()}${jump(fields)}`;
    case "deviation_unproved":
      return `${after(fields)}the tool is only proved to stay within ${fields.deviation()} of the line${jump(fields)}`;
    case "moves_backwards":
      return `${when}the tool moves backwards on the line, by ${fields.deviation()}`;
    case "may_move_backwards":
      return `${after(fields)}the tool may move backwards on the line, by up to ${fields.deviation()}`;
    case "leaves_last_waypoint":
      return `${when}the motion goes on after the last waypoint${fields.has("distance") ? `, by ${fields.deviation()}` : ""}`;
    case "waypoint_not_reached":
      return `the motion ends before the last waypoint: the tool is ${fields.deviation()} away`;
    default:
      return null;
  }
}

function jump(fields: Fields): string {
  return fields.has("change") ? "; a joint jumps there, as from one elbow to the other" : "";
}

function ofTimes(fields: Fields): string | null {
  const at = segmentOf(fields);
  const rate = `${fields.number("rate")} samples per second`;
  switch (fields.of.code) {
    case "end_speed_too_high":
      return `${at}the motion is too fast to stop at the end`;
    case "end_speed_unreachable":
      return `${at}the line is too short for the speed at its end`;
    case "begin_speed_too_high":
    case "begin_speed_too_low":
      return `${at}the speed at the beginning is too ${fields.of.code.endsWith("high") ? "high" : "low"} for the rest`;
    case "path_not_traversable":
      return `${at}no times keep the limits of the joints`;
    case "too_many_samples_at_rate":
      return `${rate} make more than ${fields.number("max_samples")} in ${shown(fields.number("duration"), 2)} s`;
    case "no_motion_at_rate":
      return `no motion within the limits was found with ${rate}`;
    case "too_many_samples_given":
      return `the motion has ${fields.number("count")} samples; at most ${fields.number("max_samples")} are read`;
    case "duration_too_short":
      return `${shown(fields.number("duration"), 2)} s are too short: the limits need ${shown(fields.number("shortest_duration"), 2)} s`;
    default:
      return null;
  }
}
