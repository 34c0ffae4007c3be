import { element } from "../elements/element.js";
import { lessonOf } from "../lessons/lessons.js";
import type { Shown } from "./section.js";

/** What the lessons do with planar arms, by the letters of their joints. */
const lessonsOfArms: Record<string, { lesson: string; words: string }> = {
  R: { lesson: "definitions", words: "What this joint is called" },
  P: { lesson: "definitions", words: "What this joint is called" },
  RR: { lesson: "forward", words: "Find this arm’s formula by its matrices" },
  RP: { lesson: "forward", words: "Draw an arm RP and find its formula" },
  RRR: { lesson: "worked", words: "Find this arm’s formula" },
};

/** A link to the lesson about the arm that is shown. */
export class ArmLesson {
  readonly root = element("p", { class: "quiet", hidden: true });

  constructor(private readonly open: (lesson: string) => void) {}

  take({ arm, description: { joints } }: Shown): void {
    const letters = joints.map(({ type }) => (type === "prismatic" ? "P" : "R")).join("");
    const found = arm.planar ? lessonsOfArms[letters] : undefined;
    this.root.hidden = found === undefined;
    if (!found) return;
    const link = element("a", { href: `#section=lessons&lesson=${found.lesson}`, class: "to-lesson" }, found.words);
    link.addEventListener("click", (event) => {
      event.preventDefault();
      this.open(found.lesson);
    });
    this.root.replaceChildren(link, `: lesson ${lessonOf(found.lesson).title}`);
  }
}
