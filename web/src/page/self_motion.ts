/** A unit vector of joint velocities that keep the tool at rest, or null where there is none: the null space of the
 * Jacobian (6 x n, column-major), by elimination with full pivoting. */
export function selfMotion(jacobian: ArrayLike<number>, n: number): number[] | null {
  const rows = Array.from({ length: 6 }, (_, i) => Array.from({ length: n }, (_, k) => jacobian[6 * k + i] ?? 0));
  const order = Array.from({ length: n }, (_, k) => k);
  const largest = Math.max(...rows.flat().map(Math.abs), 1e-300);
  let rank = 0;
  for (; rank < 6; ++rank) {
    let best = 0;
    let at: [number, number] = [rank, rank];
    for (let i = rank; i < 6; ++i) {
      for (let k = rank; k < n; ++k) {
        const size = Math.abs(entry(rows, i, order[k]));
        if (size > best) [best, at] = [size, [i, k]];
      }
    }
    if (best < 1e-9 * largest) break;
    [rows[rank], rows[at[0]]] = [rows[at[0]] as number[], rows[rank] as number[]];
    [order[rank], order[at[1]]] = [order[at[1]] as number, order[rank] as number];
    for (let i = rank + 1; i < 6; ++i) {
      const factor = entry(rows, i, order[rank]) / entry(rows, rank, order[rank]);
      const row = rows[i] as number[];
      for (let k = 0; k < n; ++k) row[k] = (row[k] ?? 0) - factor * entry(rows, rank, k);
    }
  }
  if (rank >= n) return null;
  const result = new Array<number>(n).fill(0);
  result[order[rank] as number] = 1;
  for (let i = rank - 1; i >= 0; --i) {
    let sum = 0;
    for (let k = i + 1; k < n; ++k) sum += entry(rows, i, order[k]) * (result[order[k] as number] ?? 0);
    result[order[i] as number] = -sum / entry(rows, i, order[i]);
  }
  const length = Math.hypot(...result);
  return result.map((value) => value / length);
}

function entry(rows: number[][], i: number, k: number | undefined): number {
  return rows[i]?.[k ?? 0] ?? 0;
}
