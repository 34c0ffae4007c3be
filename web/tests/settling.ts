import { run } from "./native.js";

const band = 0.02;

/** The steps of proportional control after which less than 2 % of the first error is left: (1 - Kp)^n < 0.02. */
export const stepsOfProportional = (kp: number): number => Math.ceil(Math.log(band) / Math.log(1 - kp));

/** The steps of the command's motion after which less than 2 % of each joint's first error is left. */
export function stepsOfCommand(arm: string, from: number[], to: number[], gains: Record<string, number>): number {
  const given = Object.entries(gains).map(([name, value]) => `--${name}=${value}`);
  const args = ["move", arm, `--from=${from.join(",")}`, `--to=${to.join(",")}`, ...given, "--out=run.csv"];
  const lines = (run(args).files["run.csv"] ?? "").trim().split("\n").slice(1);
  const rows = lines.map((line) => line.split(",").slice(1).map(Number));
  const isFar = (row: number[]): boolean =>
    to.some((goal, k) => Math.abs(goal - (row[k] ?? NaN)) >= band * Math.abs(goal - (from[k] ?? NaN)));
  return rows.findLastIndex(isFar) + 1;
}
