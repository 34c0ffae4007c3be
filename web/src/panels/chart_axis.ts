import type uPlot from "uplot";
import { roundStep, ticks, tickText } from "../scene/ticks.js";

/** Round numbers along an axis, at least `fewest` of them. */
export function numbered(fewest: number): Pick<uPlot.Axis, "splits" | "values"> {
  const stepOf = (low: number, high: number): number => {
    let step = roundStep((high - low) / fewest);
    for (let i = 0; i < 3 && ticks(low, high, step).length < fewest; ++i) step = roundStep(0.3 * step);
    return step;
  };
  return {
    splits: (_, __, low, high) => ticks(low, high, stepOf(low, high)),
    values: (_, values) => values.map((value) => tickText(value, (values[1] ?? 1) - (values[0] ?? 0))),
  };
}
