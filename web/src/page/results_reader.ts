import { element, table } from "../elements/element.js";
import { codesIn, type HandedIn } from "../lessons/handed_in.js";
import { judges, type Bench } from "../lessons/judges.js";
import { resultsOf, type Result } from "../lessons/results.js";
import { allTasks } from "./worksheet.js";

const names = ["Exercise", "Answer", "Solved at (UTC)", "Checked here"];

/** A result as a row: the answer is judged again, as anybody can write a code. `places`: the lessons of the exercises. */
function row({ name, answer, time }: Result, bench: Bench, places: Map<string, string>): string[] {
  const judge = Object.hasOwn(judges, name) ? judges[name] : undefined;
  const again = judge ? (judge(answer, bench).solved ? "right" : "not right") : "unknown exercise";
  const place = places.get(name);
  return [
    place === undefined ? name : `${name}, lesson ${parseInt(place)}`,
    answer,
    new Date(time).toISOString().slice(0, 16).replace("T", " "),
    again,
  ];
}

/** The results of a code as a table, or why it has none. */
async function shownCode({ whose, code }: HandedIn, bench: Bench, places: Map<string, string>): Promise<HTMLElement> {
  const refusal = (says: string): HTMLElement => element("p", { class: "refusal" }, `${whose}: ${says}.`);
  if (code === "") return refusal("there is no code in this line");
  try {
    const rows = (await resultsOf(code)).map((result) => row(result, bench, places));
    const labels = rows.map(([first = ""]) => first);
    const cells = rows.map((all) => all.slice(1));
    return table(`${whose}: ${rows.length} solved`, names.slice(1), labels, cells);
  } catch (error) {
    return refusal((error as Error).message);
  }
}

/** Reads codes that students hand in, one a line; words beside a code name whose it is. */
export function resultsReader(bench: Bench): HTMLElement {
  const input = element("textarea", { id: "handed-in", rows: 5, spellcheck: "false" });
  const out = element("div", { role: "status", class: "handed-in" });
  const read = async (): Promise<void> => {
    const places = new Map((await allTasks()).map(({ name, lesson }) => [name, lesson]));
    out.replaceChildren(...(await Promise.all(codesIn(input.value).map((one) => shownCode(one, bench, places)))));
  };
  const button = element("button", { type: "button", onclick: () => void read() }, "Read the codes");
  return element(
    "div",
    { class: "tool" },
    element("label", { for: "handed-in" }, "Codes, one a line; words beside a code name it"),
    input,
    element("p", { class: "pair" }, button),
    out,
  );
}
