import { figureOf } from "../lessons/exercises.js";

/** A part of a lesson that can stand alone: its name in the address, and what it is called. */
export interface LessonPart {
  name: string;
  title: string;
}

const blocks = (text: HTMLElement): HTMLElement[] => [
  ...text.querySelectorAll<HTMLElement>("[data-check], [data-figure]"),
];
const nameOf = ({ dataset }: HTMLElement): string => dataset["check"] ?? dataset["figure"] ?? "";

/** The first words of a task, as many as a title has room for. */
const beginning = (words: string): string => /^.{0,48}(?=\s)/s.exec(`${words} `)?.[0] ?? "";

/** The exercises and figures of a lesson that is shown. */
export function partsOf(text: HTMLElement): LessonPart[] {
  return blocks(text).map((block) => {
    const words = block.querySelector("figcaption, legend, .task")?.textContent ?? "";
    const title = block.dataset["check"] === undefined ? words : `Exercise: ${beginning(words)} …`;
    return { name: nameOf(block), title };
  });
}

/** Leaves the title and one exercise or figure in a lesson's text, with the figure that the exercise is answered with. Where
 * there is no such part the text stays, and it is false. */
export function keepPart(text: HTMLElement, name: string): boolean {
  const wanted = [figureOf[name], name];
  const kept = blocks(text).filter((block) => wanted.includes(nameOf(block)));
  const heading = [...text.querySelectorAll("h1")];
  const isThere = kept.some((block) => nameOf(block) === name);
  if (isThere) text.replaceChildren(...heading, ...kept);
  return isThere;
}

/** Links in what is shown alone: those that lead to another section or lesson open the whole page, without help where the
 * part has none. */
export function openElsewhere(text: HTMLElement, help: boolean): void {
  for (const link of text.querySelectorAll<HTMLAnchorElement>('a[href*="section="]')) {
    link.target = "_blank";
    link.href = `${link.getAttribute("href") ?? ""}${helpWord(help)}`;
  }
}

/** The end of an address that shows exercises with or without hints and solutions. */
export function helpWord(help: boolean): string {
  return help ? "" : "&help=0";
}
