import { shown } from "../../elements/element.js";
import type { Fields } from "./fields.js";
import { atPose } from "./inverse.js";

/** "from waypoint 1 to waypoint 2 "; empty where there is no segment. */
export function segmentOf(fields: Fields): string {
  if (!fields.has("segment")) return "";
  const k = fields.number("segment") - 1 + (fields.wording.first ?? 1);
  return `${k > 0 ? `from waypoint ${k} ` : ""}to waypoint ${k + 1} `;
}

/** "from waypoint 1 to waypoint 2 the tool comes 42 % of the way, to (…) m: "; empty where there is no place. */
function placeOf(fields: Fields): string {
  if (!fields.has("fraction") || !fields.has("segment")) return "";
  const percent = shown(100 * fields.number("fraction"), 0);
  return `${segmentOf(fields)}the tool comes ${percent} % of the way, to ${fields.point("position")}: `;
}

/** Why the tool cannot follow the line; null for another reason. */
export function onPath(fields: Fields): string | null {
  const place = placeOf(fields);
  switch (fields.of.code) {
    case "would_pass_limits":
      return place + [fields, ...fields.details()].map(passed).join(", and ");
    case "singular_at_start":
      return `${place}the arm is singular at this start${startOf(fields)}, and could leave it only with a jump of its joints`;
    case "singular_on_path":
      return `${place}the arm is singular there, and could go on only with a jump of its joints`;
    case "path_leaves_workspace":
      return `${place}the line leaves the workspace${poses(fields)}`;
    case "path_loses_orientation":
      return `${place}the arm cannot keep the orientation of the line${poses(fields)}`;
    case "no_configuration_found":
      return `${place}no joint values were found to go on with${poses(fields)}`;
    case "pose_outside_limits":
      return place + poses(fields).slice(2);
    case "step_not_proved":
      return `${place}no step is proved to stay on the line${near(fields)}`;
    case "too_many_samples":
      return `${segmentOf(fields)}the motion needs more than ${fields.number("max_samples")} samples${near(fields)}`;
    case "path_not_proved":
      return `the tool is only proved to stay within ${fields.deviation()} of the line${near(fields)}`;
    default:
      return null;
  }
}

function passed(fields: Fields): string {
  const which = fields.is("is_upper") ? "upper" : "lower";
  return `${fields.text("joint")} would pass its ${which} limit, ${fields.value("limit")}`;
}

function startOf(fields: Fields): string {
  return fields.has("joint") ? `, with ${fields.text("joint")} at ${fields.value("value")}` : "";
}

function near(fields: Fields): string {
  return fields.is("near_singular") ? "; the arm passes near a singularity: begin elsewhere, or move the line" : "";
}

/** The reasons of inverse kinematics at poses of the line, each after "; ". */
function poses(fields: Fields): string {
  return fields
    .details()
    .map((detail) => `; ${detail.number("fraction") === 1 ? "at the next waypoint" : "there"} ${atPose(detail)}`)
    .join("");
}
