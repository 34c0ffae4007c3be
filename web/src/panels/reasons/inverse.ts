import type { Fields } from "./fields.js";

/** Why inverse kinematics has no solution, or infinitely many; null for another reason. */
export function ofInverse(fields: Fields): string | null {
  switch (fields.of.code) {
    case "all_solutions_outside_limits":
      return `every solution is outside the joint limits; in the nearest one ${beyondLimit(fields)}`;
    case "solutions_outside_limits":
      return `no solution within the joint limits was found; in the nearest one ${beyondLimit(fields)}`;
    case "no_solution_found":
      return `no solution was found; the nearest joint values miss the pose by ${fields.deviation()}${fewJoints(fields)}`;
    case "no_closed_form_solution":
      return `no solution was found by the closed form; it misses the pose by ${fields.deviation()}`;
    case "self_motion":
      return "the arm is singular here: its joints can move while the tool rests";
    default:
      return outOfReach(fields);
  }
}

/** The same at a pose of a path, where it is said of the pose. */
export function atPose(fields: Fields): string {
  const { code } = fields.of;
  const isOutside = code === "all_solutions_outside_limits" || code === "solutions_outside_limits";
  return (isOutside ? beyondLimit(fields) : ofInverse(fields)) ?? fields.of.reason;
}

function beyondLimit(fields: Fields): string {
  const which = fields.is("is_upper") ? "above its upper" : "below its lower";
  return `${fields.text("joint")} would be at ${fields.value("value")}, ${which} limit, ${fields.value("limit")}`;
}

/** Why an arm of five joints reaches almost no pose that is typed. */
function fewJoints(fields: Fields): string {
  if (!fields.has("conditions")) return "";
  return `; a pose has ${fields.text("conditions")} conditions, and this arm ${fields.text("joints")} joints`;
}

function outOfReach(fields: Fields): string | null {
  switch (fields.of.code) {
    case "position_unreachable":
      return `the position is out of reach by ${fields.length("distance")}: the nearest point is ${fields.point("nearest")}`;
    case "orientation_unreachable":
      return (
        (fields.is("has_position")
          ? `the tool comes to the position, but its orientation stays ${fields.angle("angle")} off`
          : `the tool cannot take this orientation: the nearest is ${fields.angle("angle")} off`) + fewJoints(fields)
      );
    case "tilted_off_axes":
      return (
        `the orientation is tilted by ${fields.angle("angle")}: all axes of the joints are parallel, and they alone ` +
        "turn the tool"
      );
    case "off_plane":
      return `the position is ${fields.length("distance")} off the plane in which the tool moves`;
    case "fixed_orientation":
      return `the orientation is ${fields.angle("angle")} off: no joint turns the tool`;
    case "off_slides":
      return `the position is ${fields.length("distance")} from the nearest one to which the joints slide`;
    default:
      return null;
  }
}
