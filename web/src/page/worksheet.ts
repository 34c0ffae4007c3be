import { element } from "../elements/element.js";
import { emptyBoard } from "../lessons/drawing_board.js";
import { lessons } from "../lessons/lessons.js";
import { allTasks, type Task } from "../lessons/tasks.js";
import { drawingOf } from "./figure_drawing.js";
import type { Services } from "./section.js";

const linesToWrite = 4;

/** What `draw:` of an exercise names: a board, or what a command draws. */
const drawingNameOf = ({ block }: Task): string | undefined =>
  block.querySelector<HTMLElement>("[data-draw]")?.dataset["draw"];
/** Whether an exercise is answered by a drawing on its board. */
const isAnsweredByDrawing = (task: Task): boolean => drawingNameOf(task) === "board";

/** What the worksheet draws for an exercise: a board to draw on, or what a command draws. */
async function drawnFor(task: Task, services: Services): Promise<Element[]> {
  const wanted = drawingNameOf(task);
  if (wanted === undefined) return [];
  return [isAnsweredByDrawing(task) ? emptyBoard() : await drawingOf(services, wanted.split(" "), "")];
}

/** A copy of a part of the exercise's block; null: it has none. */
function part({ block }: Task, selector: string): HTMLElement | null {
  return block.querySelector<HTMLElement>(selector)?.cloneNode(true) as HTMLElement | null;
}

/** The first sentence of a task, to choose it by, without its links. */
function firstSentence(task: Task): Node[] {
  const words = part(task, ".task");
  for (const link of words?.querySelectorAll("a") ?? []) link.replaceWith(...link.childNodes);
  words?.normalize();
  const nodes = [...(words?.childNodes ?? [])];
  const last = nodes.findIndex((node) => node instanceof Text && /[.?]\s/.test(node.data));
  const text = nodes[last];
  if (!(text instanceof Text)) return nodes;
  text.data = text.data.slice(0, text.data.search(/[.?]\s/) + 1);
  return nodes.slice(0, last + 1);
}

async function question(task: Task, number: number, services: Services): Promise<HTMLElement> {
  const text = part(task, ".paper") ?? part(task, ".task") ?? element("p");
  const count = isAnsweredByDrawing(task) ? 0 : linesToWrite;
  const lines = Array.from({ length: count }, () => element("div", { class: "line" }));
  const title = element("h2", {}, `${number}. `, element("span", {}, `Lesson ${task.lesson}`));
  return element("section", {}, title, text, ...(await drawnFor(task, services)), ...lines);
}

function solution(task: Task, number: number): HTMLElement {
  const text = part(task, ".solution p") ?? element("p");
  return element("section", {}, element("h2", {}, `${number}. `, element("span", {}, `Lesson ${task.lesson}`)), text);
}

const source =
  "Exercises of the lessons of Beeline, which follow F. Dellaert, “Serial Link Manipulators”. Angles are counterclockwise " +
  "from the x axis; lengths are in metres.";

/** The sheets of these exercises: to write on, and the solutions on sheets of their own. */
export async function sheetsOf(tasks: Task[], withSolutions: boolean, services: Services): Promise<HTMLElement> {
  const questions: HTMLElement[] = [];
  for (const [i, task] of tasks.entries()) questions.push(await question(task, i + 1, services));
  const head = (title: string, ...more: HTMLElement[]): HTMLElement =>
    element("header", {}, element("h1", {}, title), ...more);
  const blanks = element("p", { class: "blanks" }, "Name ", element("span"), " Date ", element("span"));
  const root = element(
    "div",
    { class: "worksheet" },
    element(
      "article",
      {},
      head("Serial-link manipulators: exercises", blanks),
      ...questions,
      element("footer", {}, source),
    ),
  );
  if (withSolutions) {
    const answers = tasks.map((task, i) => solution(task, i + 1));
    root.append(element("article", {}, head("Serial-link manipulators: solutions"), ...answers));
  }
  return root;
}

/** Choice of exercises, and a button that prints them. */
export function worksheet(services: Services): HTMLElement {
  const list = element("div", { class: "choices-of-exercises" });
  const solutions = element("input", { type: "checkbox" });
  const says = element("p", { role: "status", class: "quiet" });
  let tasks: { task: Task; box: HTMLInputElement }[] = [];
  const show = async (): Promise<void> => {
    tasks = (await allTasks()).map((task) => ({ task, box: element("input", { type: "checkbox", checked: true }) }));
    const groups = lessons.flatMap(({ title }) => {
      const some = tasks.filter(({ task }) => task.lesson === title);
      const labels = some.map(({ task, box }) =>
        element("label", {}, box, element("span", {}, ...firstSentence(task))),
      );
      return some.length > 0 ? [element("fieldset", {}, element("legend", {}, title), ...labels)] : [];
    });
    list.replaceChildren(...groups);
  };
  const choose = (checked: boolean): void => tasks.forEach(({ box }) => (box.checked = checked));
  const print = async (): Promise<void> => {
    const chosen = tasks.filter(({ box }) => box.checked).map(({ task }) => task);
    if (chosen.length === 0) {
      says.textContent = "Choose an exercise.";
      return;
    }
    says.textContent = "The sheets are being made …";
    try {
      const sheets = await sheetsOf(chosen, solutions.checked, services);
      document.querySelector(".worksheet")?.remove();
      document.body.append(sheets);
      says.textContent = "";
      addEventListener("afterprint", () => sheets.remove(), { once: true });
      window.print();
    } catch (error) {
      says.textContent = `The sheets cannot be made: ${(error as Error).message}`;
    }
  };
  show().catch(() => (says.textContent = "The exercises cannot be loaded: reload the page."));
  return element(
    "div",
    { class: "tool" },
    list,
    element(
      "p",
      { class: "pair" },
      element("button", { type: "button", onclick: () => choose(true) }, "All"),
      element("button", { type: "button", onclick: () => choose(false) }, "None"),
    ),
    element("p", {}, element("label", {}, solutions, " Solutions, on sheets of their own")),
    element(
      "p",
      { class: "pair" },
      element("button", { type: "button", onclick: () => void print() }, "Print the worksheet"),
    ),
    says,
  );
}
