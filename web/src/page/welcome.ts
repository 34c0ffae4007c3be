import { element } from "../elements/element.js";
import { icon, type IconName } from "../elements/icons.js";
import { lessons } from "../lessons/lessons.js";
import type { Section } from "../state/page_state.js";

const inChapter = lessons.filter(({ section }) => section !== null).length;
const learn = `${lessons.length} lessons: ${inChapter} on the chapter, ${lessons.length - inChapter} beyond it`;

const ways: { section: Section; icon: IconName; title: string; text: string }[] = [
  { section: "lessons", icon: "lessons", title: "Learn", text: learn },
  { section: "control", icon: "control", title: "Play", text: "Two controllers and their gains" },
  { section: "line", icon: "line", title: "Plan a line", text: "Straight, in minimum time, proved" },
];

/** Three ways on from the opening, as links into the sections. */
export function welcome(go: (section: Section) => void): HTMLElement {
  const links = ways.map(({ section, icon: name, title, text }) => {
    const link = element(
      "a",
      { href: `#section=${section}`, class: "way" },
      icon(name),
      element("strong", {}, title),
      element("span", { class: "quiet" }, text),
    );
    link.addEventListener("click", (event) => {
      event.preventDefault();
      go(section);
    });
    return link;
  });
  return element(
    "nav",
    { class: "welcome", "aria-label": "Ways on" },
    element("p", {}, "Hold a robot arm, see every solution and a proof: computed in this page."),
    element("div", { class: "ways" }, ...links),
  );
}
