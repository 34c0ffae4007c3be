import { element, table } from "../elements/element.js";
import { judges, type Bench } from "../lessons/judges.js";
import { resultsOf, type Result } from "../lessons/results.js";

const names = ["Exercise", "Answer", "Solved at (UTC)", "Checked here"];

/** A result as a row: the answer is judged again, as anybody can write a code. */
function row({ name, answer, time }: Result, bench: Bench): string[] {
  const judge = judges[name];
  const again = judge ? (judge(answer, bench).solved ? "right" : "not right") : "unknown exercise";
  return [name, answer, new Date(time).toISOString().slice(0, 16).replace("T", " "), again];
}

/** Reads codes that students hand in, one a line; words before a code name whose it is. */
export function resultsReader(bench: Bench): HTMLElement {
  const input = element("textarea", { id: "handed-in", rows: 5, spellcheck: "false" });
  const out = element("div", { role: "status", class: "handed-in" });
  const read = async (): Promise<void> => {
    const lines = input.value.split("\n").filter((line) => line.trim() !== "");
    const parts = await Promise.all(
      lines.map(async (line, i) => {
        const at = Math.max(0, line.search(/beeline1-/));
        const whose = line.slice(0, at).replace(/[\s:,;]+$/, "") || `Code ${i + 1}`;
        try {
          const rows = (await resultsOf(line.slice(at))).map((result) => row(result, bench));
          const labels = rows.map(([first = ""]) => first);
          return table(
            `${whose}: ${rows.length} solved`,
            names.slice(1),
            labels,
            rows.map((cells) => cells.slice(1)),
          );
        } catch (error) {
          return element("p", { class: "refusal" }, `${whose}: ${(error as Error).message}.`);
        }
      }),
    );
    out.replaceChildren(...parts);
  };
  const button = element("button", { type: "button", onclick: () => void read() }, "Read the codes");
  return element(
    "div",
    { class: "tool" },
    element("label", { for: "handed-in" }, "Codes, one a line; what stands before a code names it"),
    input,
    element("p", { class: "pair" }, button),
    out,
  );
}
