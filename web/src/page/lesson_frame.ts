import { element } from "../elements/element.js";
import { allPages, lessons, placeOf, type Lesson } from "../lessons/lessons.js";
import { doneLessons, setDone } from "../lessons/progress.js";

type Open = (id: string) => void;

function link(id: string, text: string, open: Open): HTMLAnchorElement {
  const made = element("a", { href: `#section=lessons&lesson=${id}` }, text);
  made.addEventListener("click", (event) => {
    event.preventDefault();
    open(id);
  });
  return made;
}

/** What a lesson covers and asks for, below its link. */
function coveredBy(lesson: Lesson | undefined): HTMLElement[] {
  if (!lesson || !lessons.includes(lesson)) return [];
  const words = [placeOf(lesson), ...lesson.exercises].join(" · ");
  return [element("span", { class: "covered quiet" }, words)];
}

/** The list of lessons with their ticks, which opens and closes. */
export class Contents {
  readonly root: HTMLDetailsElement;
  private readonly summary = element("summary", {}, "Contents");
  private readonly links: HTMLAnchorElement[];

  constructor(open: Open) {
    this.links = allPages.map(({ id, title }) => link(id, title, open));
    const items = this.links.map((one, i) => element("li", {}, one, ...coveredBy(allPages[i])));
    const lists = [items.slice(0, lessons.length), items.slice(lessons.length)].map((some) =>
      element("ul", {}, ...some),
    );
    this.root = element(
      "details",
      { class: "contents" },
      this.summary,
      element("nav", { "aria-label": "Lessons" }, ...lists),
    );
  }

  /** Marks the lesson that is open, and the ticks. */
  show(opened: string): void {
    const done = doneLessons();
    this.links.forEach((one, i) => {
      const { id = "", title = "" } = allPages[i] ?? {};
      if (id === opened) one.setAttribute("aria-current", "page");
      else one.removeAttribute("aria-current");
      one.classList.toggle("done", done.has(id));
      const tick = element("span", { class: "unseen" }, ", done"); // the sign ✓ is drawn
      one.replaceChildren(title, ...(done.has(id) ? [tick] : []));
    });
    const position = lessons.findIndex(({ id }) => id === opened) + 1;
    const place = position > 0 ? `lesson ${position} of ${lessons.length} · ` : "";
    this.summary.textContent = `Contents · ${place}${done.size} done`;
  }
}

/** What a lesson takes and builds on, below its title. */
export function headOf(lesson: Lesson, open: Open): HTMLElement {
  const { minutes, needs } = lesson;
  const root = element("p", { class: "quiet lesson-head" }, `${placeOf(lesson)} · ${minutes} minutes`);
  const before = needs.flatMap((id) => lessons.filter((one) => one.id === id));
  before.forEach(({ id, title }, i) => root.append(i === 0 ? " · after " : " and ", link(id, title, open)));
  return root;
}

/** The end of a lesson: its tick, and the lessons before and after it. */
export function footOf({ id }: Lesson, open: Open, ticked: () => void): { root: HTMLElement; tick(): void } {
  const at = lessons.findIndex((one) => one.id === id);
  const box = element("input", { type: "checkbox" });
  box.checked = doneLessons().has(id);
  const set = (done: boolean): void => {
    box.checked = done;
    setDone(id, done);
    ticked();
  };
  box.addEventListener("change", () => set(box.checked));
  const neighbours = [lessons[at - 1], lessons[at + 1]].map((other, i) => {
    if (!other) return element("span");
    const made = link(other.id, "", open);
    made.className = i === 0 ? "previous" : "next";
    made.append(element("span", { class: "quiet" }, i === 0 ? "Previous" : "Next"), element("span", {}, other.title));
    return made;
  });
  const root = element(
    "footer",
    { class: "lesson-foot" },
    element("label", { class: "tick" }, box, " Done: a tick in the contents, kept in this browser"),
    element("nav", { "aria-label": "Previous and next lesson" }, ...neighbours),
  );
  return { root, tick: () => set(true) };
}
