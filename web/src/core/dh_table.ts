/** A joint of a Denavit-Hartenberg table as it was typed. */
export interface DhRow {
  type: "revolute" | "prismatic";
  a: string;
  alpha: string;
  d: string;
  theta: string;
  lower: string;
  upper: string;
}

export interface DhTable {
  name: string;
  /** There is no default: the numbers do not say which it is. */
  convention: "standard" | "modified" | "";
  /** Of all angles in the table. Lengths are metres. */
  degrees: boolean;
  rows: DhRow[];
}

export type DhColumn = Exclude<keyof DhRow, "type">;

/** A fault of a table: in one cell, or `row` -1 and a part of the form. */
export class DhFault extends Error {
  override name = "DhFault";
  constructor(
    readonly row: number,
    readonly column: DhColumn | "name" | "convention",
    fault: string,
  ) {
    super(row < 0 ? fault : `Row ${row + 1}, ${column}: ${fault}.`);
  }
}

const ratioOfPi = /^([+-]?)(\d*\.?\d*)\s*\*?\s*(?:pi|π)(?:\s*\/\s*(\d+\.?\d*))?$/i;

/** A typed number, also such as -pi/2 or 3*pi/4; NaN for anything else. */
function numberOf(text: string): number {
  const pi = ratioOfPi.exec(text);
  if (pi) return (pi[1] === "-" ? -1 : 1) * ((Number(pi[2] || 1) * Math.PI) / Number(pi[3] ?? 1));
  return text === "" ? NaN : Number(text.replace("−", "-"));
}

function cell(table: DhTable, row: number, column: DhColumn, angle: boolean): number {
  const text = (table.rows[row] as DhRow)[column].trim();
  if (text === "") throw new DhFault(row, column, "a number is missing");
  const value = numberOf(text);
  if (!Number.isFinite(value)) throw new DhFault(row, column, `"${text}" is not a number`);
  const isRatio = ratioOfPi.test(text);
  if (isRatio && !angle) throw new DhFault(row, column, `"${text}" is an angle; metres are expected`);
  return angle && table.degrees && !isRatio ? (value * Math.PI) / 180 : value;
}

function limits(table: DhTable, row: number, angle: boolean): { lower?: number; upper?: number } {
  const found: { lower?: number; upper?: number } = {};
  for (const side of ["lower", "upper"] as const) {
    if (table.rows[row]?.[side].trim() !== "") found[side] = cell(table, row, side, angle);
  }
  if (found.lower !== undefined && found.upper !== undefined && found.lower > found.upper)
    throw new DhFault(row, "upper", "it is below the lower limit");
  return found;
}

/** The arm of a table as the JSON that the command line reads, radians and metres. Throws DhFault. */
export function armOfDhTable(table: DhTable): string {
  const name = table.name.trim();
  if (name === "") throw new DhFault(-1, "name", "The arm needs a name.");
  if (table.convention === "")
    throw new DhFault(-1, "convention", "Say which convention the table has: standard or modified.");
  const rows = table.rows.map(({ type }, i) => {
    const ends = limits(table, i, type === "revolute");
    return {
      type,
      a: cell(table, i, "a", false),
      alpha: cell(table, i, "alpha", true),
      d: cell(table, i, "d", false),
      theta: cell(table, i, "theta", true),
      ...(Object.keys(ends).length > 0 ? { limits: ends } : {}),
    };
  });
  return `${JSON.stringify({ name, dh: { convention: table.convention, rows } }, null, 2)}\n`;
}
