import { element } from "../elements/element.js";
import { codeOf, forgetResults, results } from "../lessons/results.js";

/** What a student hands in: the results as a code, made when it is opened. */
export function handIn(): { root: HTMLElement; refresh(): void } {
  const code = element("textarea", {
    id: "results-code",
    rows: 3,
    readonly: true,
    "aria-label": "Code of your results",
  });
  const says = element("p", { role: "status", class: "quiet" });
  const summary = element("summary");
  const root = element("details", { class: "hand-in" }, summary);
  const write = async (): Promise<void> => {
    const all = results();
    summary.textContent = `Your results as a code · ${all.length} solved`;
    code.value = all.length > 0 ? await codeOf(all) : "";
  };
  const copy = async (): Promise<void> => {
    code.select();
    try {
      await navigator.clipboard.writeText(code.value);
      says.textContent = "Copied.";
    } catch {
      says.textContent = "The code is selected: copy it with Ctrl C.";
    }
  };
  const forget = (): void => {
    forgetResults();
    says.textContent = "All results are removed.";
    void write();
  };
  root.append(
    element(
      "p",
      { class: "quiet" },
      "Give it to your teacher. It holds the exercises that you solved, your answers and when, and nothing about you: " +
        "write your name beside it if you are asked to. It can be forged, so it proves nothing.",
    ),
    code,
    element(
      "p",
      { class: "pair" },
      element("button", { type: "button", onclick: () => void copy() }, "Copy code"),
      element("button", { type: "button", onclick: forget }, "Remove results"),
    ),
    says,
  );
  root.addEventListener("toggle", () => {
    says.textContent = "";
    if (root.open) void write();
  });
  void write();
  return { root, refresh: () => void write() };
}
