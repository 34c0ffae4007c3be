import { element, table } from "../elements/element.js";
import { codesIn, longestText, type HandedIn } from "../lessons/handed_in.js";
import { judges, type Bench } from "../lessons/judges.js";
import { resultsOf, type Result } from "../lessons/results.js";
import { allTasks } from "../lessons/tasks.js";

const names = ["Exercise", "Answer", "Solved at (UTC)", "Checked here"];

/** A result as a row: the answer is judged again, as anybody can write a code. `numbers`: of the exercises' lessons. */
function row({ name, answer, time }: Result, bench: Bench, numbers: Map<string, number>): string[] {
  const judge = Object.hasOwn(judges, name) ? judges[name] : undefined;
  const again = judge ? (judge(answer, bench).solved ? "right" : "not right") : "unknown exercise";
  const number = numbers.get(name);
  return [
    number === undefined ? name : `${name}, lesson ${number}`,
    answer,
    new Date(time).toISOString().slice(0, 16).replace("T", " "),
    again,
  ];
}

/** The results of a code as a table, or why it has none. */
async function shownCode({ whose, code }: HandedIn, bench: Bench, numbers: Map<string, number>): Promise<HTMLElement> {
  const refusal = (says: string): HTMLElement => element("p", { class: "refusal" }, `${whose}: ${says}.`);
  if (code === "") return refusal("there is no code in this line");
  try {
    const rows = (await resultsOf(code)).map((result) => row(result, bench, numbers));
    const labels = rows.map(([first = ""]) => first);
    const cells = rows.map((all) => all.slice(1));
    return table(`${whose}: ${rows.length} solved`, names.slice(1), labels, cells);
  } catch (error) {
    return refusal((error as Error).message);
  }
}

/** Reads codes that students hand in, one a line; words beside a code or above it name whose it is. */
export function resultsReader(bench: Bench): HTMLElement {
  const input = element("textarea", { id: "handed-in", rows: 5, spellcheck: "false" });
  const out = element("div", { role: "status", class: "handed-in" });
  const read = async (): Promise<void> => {
    try {
      if (input.value.length > longestText) {
        out.textContent = `Paste at most ${longestText} characters at once: read the codes in several parts.`;
        return;
      }
      const numbers = new Map((await allTasks()).map(({ name, number }) => [name, number]));
      out.replaceChildren(...(await Promise.all(codesIn(input.value).map((one) => shownCode(one, bench, numbers)))));
    } catch {
      out.textContent = "The lessons cannot be loaded: read the codes again, or reload the page.";
    }
  };
  const button = element("button", { type: "button", onclick: () => void read() }, "Read the codes");
  return element(
    "div",
    { class: "tool" },
    element("label", { for: "handed-in" }, "Codes, one a line; words beside a code or above it name it"),
    input,
    element("p", { class: "pair" }, button),
    out,
  );
}
