/** The round number, 1, 2 or 5 times a power of ten, at or above a length. */
export function roundStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  const factor = [1, 2, 5, 10].find((choice) => choice * power >= length * (1 - 1e-9)) ?? 10;
  return factor * power;
}

/** The multiples of a step between two numbers. */
export function ticks(low: number, high: number, step: number): number[] {
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  if (!(last - first < 400)) return [];
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/** A tick's number with the decimals of the step. */
export function tickText(value: number, step: number): string {
  if (Math.abs(value) > 0 && (step < 1e-4 || step >= 1e5))
    return value.toExponential(1).replace(/-/g, "−").replace("e+", "e");
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const rounded = Math.abs(value) < step / 2 ? 0 : value;
  return rounded.toFixed(decimals).replace("-", "−");
}
