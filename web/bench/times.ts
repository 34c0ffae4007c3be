import { execFileSync } from "node:child_process";
import { test } from "vitest";
import { loadCommands, loadCore, random, run } from "../tests/native.js";

/** The shortest of a few repetitions, in microseconds a call. */
function microseconds(work: () => void, calls: number): number {
  let best = Infinity;
  for (let repetition = 0; repetition < 5; ++repetition) {
    const begin = performance.now();
    for (let i = 0; i < calls; ++i) work();
    best = Math.min(best, ((performance.now() - begin) * 1000) / calls);
  }
  return best;
}

interface Times {
  forward: number;
  jacobian: number;
  inverse: number;
}

/** The same of native code: web/bench/native.cpp. */
function native(name: string, q: number[]): Times {
  const program = process.env["BENCH_NATIVE"] ?? "../build/bench/bench_web";
  return JSON.parse(execFileSync(program, [name, ...q.map(String)], { encoding: "utf8" })) as Times;
}

test("times of the core beside native", async () => {
  const core = await loadCore();
  const next = random(1);
  const table: Record<string, Record<string, string>> = {};
  for (const name of ["rrr", "puma560", "ur5", "panda"]) {
    const arm = core.arm(name);
    const q = Array.from({ length: arm.dof }, () => 0.2 + next());
    const pose = arm.forward(q).at(-1) ?? [];
    const web: Times = {
      forward: microseconds(() => arm.forward(q), 20_000),
      jacobian: microseconds(() => arm.jacobian(q), 20_000),
      inverse: microseconds(() => arm.inverse(pose, q), 5000),
    };
    const compiled = native(name, q);
    table[name] = Object.fromEntries(
      (["forward", "jacobian", "inverse"] as const).flatMap((what) => [
        [`${what}, web`, web[what].toFixed(2)],
        [`${what}, native`, compiled[what].toFixed(2)],
      ]),
    );
    arm.release();
  }
  console.table(table);

  const commands = await loadCommands();
  const files = { "poses.csv": "x,y,theta\n4.5,5.2,0\n5.6,2,-1.3\n" };
  const args = ["line", "rrr", "--from=1.95,-0.9,-1.05", "--through", "poses.csv", "--json"];
  const whole: Record<string, { web: string; native: string }> = {};
  for (const [label, command, given] of [
    ["fk, process or instance included", ["fk", "rrr", "--q=0,0,0"], {}],
    ["line of two segments", args, files],
  ] as [string, string[], Record<string, string>][]) {
    let web = Infinity;
    let begin = performance.now();
    for (let i = 0; i < 5; ++i) {
      begin = performance.now();
      await commands.run(command, given);
      web = Math.min(web, performance.now() - begin);
    }
    const process = microseconds(() => run(command, given), 1) / 1000;
    whole[label] = { web: `${web.toFixed(1)} ms`, native: `${process.toFixed(1)} ms` };
  }
  console.table(whole);
});
