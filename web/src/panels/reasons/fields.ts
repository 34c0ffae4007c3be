import { shown } from "../../elements/element.js";
import { angles, lengths, small, unitOf } from "../../elements/units.js";

type Field = number | string | boolean | number[] | Reason[];

/** Why there is no answer, or not the whole one, as commands give it: a code, its fields in metres, radians and seconds, and
 * the sentence of the command line. */
export interface Reason {
  reason: string;
  code: string | null;
  fields: Partial<Record<string, Field>>;
}

/** How numbers are written: the unit of angles, and whether the arm moves in a plane. `first`: the waypoint at which the
 * first segment begins; 0: where the arm stands. `error`: what all errors of a controller are; missing: some are angles,
 * some lengths. */
export interface Wording {
  degrees: boolean;
  planar: boolean;
  first?: number;
  error?: "angle" | "length";
}

const rates: Partial<Record<string, string>> = { velocity: "/s", acceleration: "/s²", jerk: "/s³" };

/** A reason with its fields by type; those that are missing are 0, empty or false. */
export class Fields {
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

  /** An angle, with two digits where it is below a tenth. */
  angle(name: string): string {
    const { degrees } = this.wording;
    const value = this.number(name);
    if (!degrees) return Math.abs(value) < 1e-3 ? small(value, angles) : `${shown(value, 3)} rad`;
    const inDegrees = (value * 180) / Math.PI;
    const digits = Math.abs(inDegrees) < 0.095 && inDegrees !== 0 ? Math.ceil(-Math.log10(Math.abs(inDegrees))) + 1 : 1;
    return `${shown(inDegrees, digits)}°`;
  }

  /** A distance and an angle: the deviation of the tool from the line. */
  deviation(): string {
    return [
      ...(this.has("distance") ? [small(this.number("distance"), lengths)] : []),
      ...(this.has("angle") ? [this.angle("angle")] : []),
    ].join(" and ");
  }

  /** A joint's value or rate; `per`: "", "/s" or the like. */
  value(name: string, per = ""): string {
    const unit = unitOf(this.text("unit") === "m" ? "prismatic" : "revolute", this.wording.degrees);
    const number = shown(this.number(name) * unit.factor, unit.name === "°" ? 1 : 3);
    return `${number}${unit.name === "°" ? "" : " "}${unit.name}${per}`;
  }

  /** "outside its limits, −90.0° to 90.0°", with the excess where the digits do not show it. */
  range(): string {
    const [value, lower, upper] = [this.number("value"), this.number("lower"), this.number("upper")];
    const passed = value > upper ? "upper" : "lower";
    const by = Math.abs(value - (passed === "upper" ? upper : lower));
    const excess = new Fields({ ...this.of, fields: { ...this.of.fields, by } }, this.wording);
    const alike = this.value("value") === this.value(passed);
    const beyond = this.text("unit") === "m" ? small(by, lengths) : excess.angle("by");
    return `outside its limits, ${this.value("lower")} to ${this.value("upper")}${alike ? `, by ${beyond}` : ""}`;
  }

  /** The unit of the quantity per time: "/s" of a velocity. */
  get per(): string {
    return rates[this.text("quantity")] ?? "";
  }

  /** "at 1.20 s "; empty where there is no time. */
  get when(): string {
    return this.has("time") ? `at ${shown(this.number("time"), 2)} s ` : "";
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
