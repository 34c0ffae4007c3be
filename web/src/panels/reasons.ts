import { shown } from "../elements/element.js";
import { unitOf } from "../elements/units.js";

type Field = number | string | boolean | number[] | Reason[];

/** Why a motion is not possible, as commands give it: a code, its fields in metres, radians and seconds, and the sentence of
 * the command line. */
export interface Reason {
  reason: string;
  code: string | null;
  fields: Partial<Record<string, Field>>;
}

/** How numbers are written: the unit of angles, and whether the arm moves in a plane. `first`: the waypoint at which the
 * first segment begins; 0: where the arm stands. */
export interface Wording {
  degrees: boolean;
  planar: boolean;
  first?: number;
}

/** A reason with its fields by type; those that are missing are 0, empty or false. */
class Fields {
  constructor(
    readonly of: Reason,
    readonly wording: Wording,
  ) {}

  number(name: string): number {
    return Number(this.of.fields[name] ?? 0);
  }

  text(name: string): string {
    return String(this.of.fields[name] ?? "");
  }

  is(name: string): boolean {
    return this.of.fields[name] === true;
  }

  has(name: string): boolean {
    return name in this.of.fields;
  }

  length(name: string): string {
    return `${shown(this.number(name), 3)} m`;
  }

  /** A joint's value or rate; `per`: "", "/s" or the like. */
  value(name: string, per = ""): string {
    const unit = unitOf(this.text("unit") === "m" ? "prismatic" : "revolute", this.wording.degrees);
    const number = shown(this.number(name) * unit.factor, unit.name === "°" ? 1 : 3);
    return `${number}${unit.name === "°" ? "" : " "}${unit.name}${per}`;
  }

  point(name: string): string {
    const values = (this.of.fields[name] ?? []) as number[];
    return `(${values
      .slice(0, this.wording.planar ? 2 : 3)
      .map((one) => shown(one, 3))
      .join(", ")}) m`;
  }

  details(): Fields[] {
    return ((this.of.fields["details"] ?? []) as Reason[]).map((detail) => new Fields(detail, this.wording));
  }
}

/** The reason of a motion in the words and units of the page, with a full stop; what the page has no words for is said as the
 * command says it. */
export function reasonInWords(reason: Reason, wording: Wording): string {
  if (reason.reason === "") return "";
  const fields = new Fields(reason, wording);
  const text = onPath(fields) ?? inMotion(fields) ?? reason.reason;
  return `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;
}

/** "from waypoint 1 to waypoint 2 the tool comes 42 % of the way, to (…) m: "; empty where there is no place. */
function placeOf(fields: Fields): string {
  if (!fields.has("fraction") || !fields.has("segment")) return "";
  const k = fields.number("segment") - 1 + (fields.wording.first ?? 1);
  const percent = shown(100 * fields.number("fraction"), 0);
  const from = k > 0 ? `from waypoint ${k} ` : "";
  return `${from}to waypoint ${k + 1} the tool comes ${percent} % of the way, to ${fields.point("position")}: `;
}

function onPath(fields: Fields): string | null {
  const place = placeOf(fields);
  switch (fields.of.code) {
    case "would_pass_limits":
      return place + [fields, ...fields.details()].map(passed).join(", and ");
    case "singular_at_start":
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
    default:
      return null;
  }
}

function passed(fields: Fields): string {
  const which = fields.is("is_upper") ? "upper" : "lower";
  return `${fields.text("joint")} would pass its ${which} limit, ${fields.value("limit")}`;
}

/** The reasons of inverse kinematics at poses of the line, each after "; ". */
function poses(fields: Fields): string {
  return fields
    .details()
    .map((detail) => {
      const fraction = detail.number("fraction");
      return `; ${fraction === 1 ? "at the next waypoint" : "there"} ${atPose(detail)}`;
    })
    .join("");
}

function atPose(fields: Fields): string {
  switch (fields.of.code) {
    case "position_unreachable":
      return `the position is out of reach by ${fields.length("distance")}: the nearest point is ${fields.point("nearest")}`;
    case "orientation_unreachable":
      return `the tool comes to the position, but its orientation stays ${fields.value("angle")} off`;
    case "all_solutions_outside_limits":
    case "solutions_outside_limits": {
      const which = fields.is("is_upper") ? "above its upper" : "below its lower";
      return `${fields.text("joint")} would be at ${fields.value("value")}, ${which} limit, ${fields.value("limit")}`;
    }
    default:
      return fields.of.reason;
  }
}

const rates: Partial<Record<string, string>> = { velocity: "/s", acceleration: "/s²", jerk: "/s³" };

function inMotion(fields: Fields): string | null {
  const joint = fields.text("joint");
  const when = fields.has("time") ? `at ${shown(fields.number("time"), 2)} s ` : "";
  switch (fields.of.code) {
    case "outside_limits":
    case "joint_outside_limits":
    case "recording_outside_limits":
      return `${when}${joint} is at ${fields.value("value")}, outside its limits, ${fields.value("lower")} to ${fields.value("upper")}`;
    case "derivative_needed":
    case "derivative_reached": {
      const quantity = fields.text("quantity");
      const per = rates[quantity] ?? "";
      const limit = `its ${fields.is("assumed") ? "assumed " : ""}limit is ${fields.value("limit", per)}`;
      return `${when}the ${quantity} of ${joint} is ${fields.value("value", per)}; ${limit}`;
    }
    case "off_path":
    case "leaves_path":
      return `${when}the tool is off the line by ${fields.length("distance")} and ${fields.value("angle")}`;
    case "leaves_last_waypoint":
      return `${when}the motion goes on after the last waypoint`;
    default:
      return null;
  }
}
