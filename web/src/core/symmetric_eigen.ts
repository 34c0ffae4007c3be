/** Eigenvalues and orthonormal eigenvectors of a symmetric matrix, by Jacobi's rotations; vectors[k] belongs to
 * values[k]. */
export function eigen(symmetric: number[][]): { values: number[]; vectors: number[][] } {
  const n = symmetric.length;
  const a = symmetric.map((row) => [...row]);
  const v = a.map((_, i) => a.map((_, k) => (i === k ? 1 : 0)));
  const at = (m: number[][], i: number, k: number): number => m[i]?.[k] ?? 0;
  const rounds = 12; // convergence is quadratic
  for (let round = 0; round < rounds; ++round) {
    for (let p = 0; p < n; ++p) {
      for (let q = p + 1; q < n; ++q) {
        if (at(a, p, q) === 0) continue;
        const angle = 0.5 * Math.atan2(2 * at(a, p, q), at(a, q, q) - at(a, p, p));
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        for (const m of [a, v]) {
          for (const row of m)
            [row[p], row[q]] = [c * (row[p] ?? 0) - s * (row[q] ?? 0), s * (row[p] ?? 0) + c * (row[q] ?? 0)];
        }
        const [above, below] = [a[p] as number[], a[q] as number[]];
        for (let k = 0; k < n; ++k) {
          [above[k], below[k]] = [c * (above[k] ?? 0) - s * (below[k] ?? 0), s * (above[k] ?? 0) + c * (below[k] ?? 0)];
        }
      }
    }
  }
  return { values: a.map((_, i) => at(a, i, i)), vectors: a.map((_, k) => v.map((row) => row[k] ?? 0)) };
}
