/** The solution x of A x = b for a small regular matrix, by elimination with row pivots. */
export function solve(matrix: number[][], right: number[]): number[] {
  const n = right.length;
  const rows = matrix.map((row, i) => [...row, right[i] ?? 0]);
  const entry = (i: number, k: number): number => rows[i]?.[k] ?? 0;
  for (let k = 0; k < n; ++k) {
    let pivot = k;
    for (let i = k + 1; i < n; ++i) if (Math.abs(entry(i, k)) > Math.abs(entry(pivot, k))) pivot = i;
    [rows[k], rows[pivot]] = [rows[pivot] as number[], rows[k] as number[]];
    for (let i = k + 1; i < n; ++i) {
      const factor = entry(i, k) / entry(k, k);
      const row = rows[i] as number[];
      for (let j = k; j <= n; ++j) row[j] = (row[j] ?? 0) - factor * entry(k, j);
    }
  }
  const x = new Array<number>(n).fill(0);
  for (let i = n - 1; i >= 0; --i) {
    let sum = entry(i, n);
    for (let k = i + 1; k < n; ++k) sum -= entry(i, k) * (x[k] ?? 0);
    x[i] = sum / entry(i, i);
  }
  return x;
}
