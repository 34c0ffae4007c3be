import { test } from "vitest";
import { json, loadCommands, loadCore, random, run } from "../tests/native.js";

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

/** The same of the native command on one thread: batch over many rows. */
function native(verb: string, name: string, rows: string[]): number {
  const input = verb === "ik" ? "poses.csv" : "q.csv";
  const args = ["batch", verb, name, "--in", input, "--out", "out.csv", "--threads", "1"];
  const { rows_per_second } = json<{ rows_per_second: number }>(args, { [input]: rows.join("\n") + "\n" });
  return 1e6 / rows_per_second;
}

test("times of the core beside native", async () => {
  const core = await loadCore();
  const next = random(1);
  const table: Record<string, Record<string, string>> = {};
  for (const name of ["rrr", "puma560", "ur5", "panda"]) {
    const arm = core.arm(name);
    const q = Array.from({ length: arm.dof }, () => 0.2 + next());
    const rows = Array.from({ length: 20_000 }, () => q.map((value) => value + 0.1 * next()).join(","));
    const pose = arm.forward(q).at(-1) ?? [];
    table[name] = {
      "forward, web": microseconds(() => arm.forward(q), 20_000).toFixed(2),
      "forward, native batch": native("fk", name, rows).toFixed(2),
      "Jacobian, web": microseconds(() => arm.jacobian(q), 20_000).toFixed(2),
      "Jacobian, native batch": native("jacobian", name, rows).toFixed(2),
      "inverse, web": microseconds(() => arm.inverse(pose, q), 500).toFixed(2),
    };
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
