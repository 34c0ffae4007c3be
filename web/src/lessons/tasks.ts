import { element } from "../elements/element.js";
import { lessons } from "./lessons.js";

/** An exercise of a lesson, as the lesson's text has it. */
export interface Task {
  /** The lesson's title. */
  lesson: string;
  /** The lesson's number. */
  number: number;
  name: string;
  block: HTMLElement;
}

/** All exercises in the order of the lessons, from the texts of the lessons. */
export async function allTasks(): Promise<Task[]> {
  const texts = await Promise.all(lessons.map((lesson) => lesson.load()));
  return lessons.flatMap(({ title }, i) => {
    const holder = element("template");
    holder.innerHTML = texts[i]?.default ?? ""; // ours, made when the page was built
    const blocks = [...holder.content.querySelectorAll<HTMLElement>("[data-check]")];
    return blocks.map((block) => ({ lesson: title, number: i + 1, name: block.dataset["check"] ?? "", block }));
  });
}
