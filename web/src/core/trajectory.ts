/** Joint values at increasing times; the velocities and accelerations where the file has them. */
export interface Motion {
  times: number[];
  rows: number[][];
  velocities: number[][] | null;
  accelerations: number[][] | null;
}

/** A trajectory as the core writes it: CSV, the time in front of the `dof` coordinates, behind them none or all of the
 * velocities, then of the accelerations. Throws an Error for other files. */
export function readTrajectory(text: string, dof: number): Motion {
  const [header = "", ...lines] = text.split(/\r?\n/).filter((line) => line !== "" && !line.startsWith("#"));
  const columns = header.split(",").length;
  const parts = [1, 2, 3].find((count) => columns === 1 + count * dof);
  if (parts === undefined) throw new Error(`the file has ${columns} columns; the time and ${dof} joints are expected`);
  const number = (text: string): number => (text.trim() === "" ? NaN : Number(text));
  const numbers = lines.map((line) => line.split(",").map(number));
  const bad = numbers.findIndex((row) => row.length !== columns || !row.every(Number.isFinite));
  if (bad >= 0) throw new Error(`row ${bad + 1} of the file is not a row of ${columns} numbers`);
  if (numbers.length === 0) throw new Error("the file has no rows");
  const late = numbers.findIndex(([time = 0], i) => i > 0 && time <= (numbers[i - 1]?.[0] ?? 0));
  if (late > 0) throw new Error(`the time in row ${late + 1} of the file is not after that in the row before`);
  const part = (k: number): number[][] => numbers.map((row) => row.slice(1 + k * dof, 1 + (k + 1) * dof));
  return {
    times: numbers.map((row) => row[0] as number),
    rows: part(0),
    velocities: parts > 1 ? part(1) : null,
    accelerations: parts > 2 ? part(2) : null,
  };
}

/** The joint values at a time, linear between the rows: for pictures. */
export function at({ times, rows }: Pick<Motion, "times" | "rows">, time: number): number[] {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((times[middle] as number) <= time) low = middle;
    else high = middle;
  }
  const [begin, end] = [times[low] as number, times[high] as number];
  const share = end > begin ? Math.min(1, Math.max(0, (time - begin) / (end - begin))) : 1;
  const after = rows[high] as number[];
  return (rows[low] as number[]).map((value, k) => value + share * ((after[k] as number) - value));
}
