import { partOf, stateOf } from "../address/address.js";
import { element } from "../elements/element.js";
import type { Exercise, ExerciseContext } from "../lessons/exercise.js";
import { exercises } from "../lessons/exercises.js";
import { lessons, type Lesson } from "../lessons/lessons.js";
import { sameArm, type ArmSource, type PageState } from "../state/page_state.js";
import { lessonFigures, type LessonFigure } from "./lesson_figures.js";
import type { PageSection, Services, Shown } from "./section.js";

/** The arm of a state, and how it is shown. */
function armOf({ arm, q, goal, showFrames, showColumns, showSolutions, showEllipsoid }: Readonly<PageState>) {
  return { arm, q, goal, showFrames, showColumns, showSolutions, showEllipsoid };
}

/** The chapter as lessons: text, equations, links that set the arm, exercises that are checked. */
export class LessonsSection implements PageSection {
  readonly root = element("div", { class: "panel lessons" });
  private readonly text = element("article");
  private readonly links = lessons.map(({ id, title }) => {
    const link = element("a", { href: `#section=lessons&lesson=${id}` }, title);
    link.addEventListener("click", (event) => {
      event.preventDefault();
      void this.turnTo(id);
    });
    return link;
  });
  private shown: Shown | null = null;
  private opened = "";
  private figure: LessonFigure | null = null;
  private exercises: Exercise[] = [];
  /** What the section before had, and the arm that a lesson has put in its place. */
  private replaced: { state: ReturnType<typeof armOf>; by: ArmSource } | null = null;

  constructor(
    private readonly services: Services,
    private readonly arm: ExerciseContext["arm"],
  ) {
    this.text.addEventListener("click", (event) => void this.follow(event));
    this.root.append(element("nav", { "aria-label": "Lessons" }, ...this.links), this.text);
  }

  take(shown: Shown): void {
    this.shown = shown;
  }

  update(q: number[]): void {
    const { lesson } = this.services.store.get();
    if (!this.shown) return;
    this.figure?.update(this.shown, q);
    for (const exercise of this.exercises) exercise.update?.();
    const wanted = lessons.find(({ id }) => id === lesson) ?? (lessons[0] as Lesson);
    if (wanted.id !== this.opened) void this.open(wanted);
  }

  leave(): void {
    this.figure?.leave();
  }

  /** The section was chosen: its lesson brings the arm that it speaks of. */
  async enter(): Promise<void> {
    const { lesson, arm } = this.services.store.get();
    const { id, scene } = lessons.find((one) => one.id === lesson) ?? (lessons[0] as Lesson);
    this.replaced = null;
    if (sameArm((await stateOf(scene)).arm, arm)) this.services.store.set({ section: "lessons" });
    else await this.turnTo(id);
  }

  /** What the section before had, if a lesson has replaced its arm and this is still there. */
  before(): Partial<PageState> {
    const { replaced } = this;
    const { section, arm } = this.services.store.get();
    if (section === "lessons") this.replaced = null;
    return section === "lessons" && replaced && sameArm(replaced.by, arm) ? replaced.state : {};
  }

  private async open(lesson: Lesson): Promise<void> {
    this.opened = lesson.id;
    const failed = { default: "<p>This lesson cannot be loaded.</p>" };
    const { default: html } = await lesson.load().catch(() => failed);
    if (this.opened !== lesson.id) return;
    this.figure?.leave();
    this.figure = null;
    this.services.draw({ waypoints: [] });
    this.text.innerHTML = html; // ours, made when the page was built
    this.exercises = [];
    for (const place of this.text.querySelectorAll<HTMLElement>("[data-check]")) this.fill(place);
    this.showFigure();
    this.links.forEach((link, i) => {
      if (lessons[i]?.id === lesson.id) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    });
    this.root.parentElement?.scrollTo({ top: 0 });
    const { q, section } = this.services.store.get();
    if (q && section === "lessons") this.update(q);
  }

  private showFigure(): void {
    const place = this.text.querySelector<HTMLElement>("[data-figure]");
    const make = lessonFigures[place?.dataset["figure"] ?? ""];
    if (!place || !make) return;
    this.figure = make(this.services);
    place.replaceChildren(this.figure.root);
  }

  /** Opens a lesson with its figure. The arm before comes back with the next section, the browser's Back, or Undo. */
  private async turnTo(id: string): Promise<void> {
    const { store } = this.services;
    const scene = await stateOf(lessons.find((lesson) => lesson.id === id)?.scene ?? "");
    const before = store.get();
    const now = sameArm(scene.arm, before.arm) ? before.arm : scene.arm;
    if (before.section !== "lessons") this.replaced = { state: armOf(before), by: now };
    else if (this.replaced) this.replaced.by = now;
    store.set({ ...armOf(scene), arm: now, lesson: id, section: "lessons" });
  }

  private fill(place: HTMLElement): void {
    const make = exercises[place.dataset["check"] ?? ""];
    const section = this;
    const context: ExerciseContext = {
      services: this.services,
      arm: this.arm,
      get shown() {
        return section.shown as Shown;
      },
    };
    if (!make) return;
    const exercise = make(context);
    this.exercises.push(exercise);
    place.replaceChildren(exercise.root);
  }

  /** A link in a lesson sets what its address holds, and leaves the lesson open unless it names a section. */
  private async follow(event: MouseEvent): Promise<void> {
    const link = (event.target as HTMLElement).closest("a");
    const address = link?.getAttribute("href") ?? "";
    if (!address.startsWith("#")) return;
    event.preventDefault();
    const part = await partOf(address);
    const { arm } = this.services.store.get();
    if (part.arm && sameArm(part.arm, arm)) part.arm = arm;
    const another = part.arm ? { q: null, goal: null } : {}; // of the arm before
    this.services.store.set({ ...another, ...part, section: part.section ?? "lessons" });
  }
}
