import { exercises, type ExerciseContext } from "../lessons/exercises.js";
import { lessons, type Lesson } from "../lessons/lessons.js";
import { element } from "../panels/element.js";
import type { JointsPanel } from "../panels/joints.js";
import { partOf, stateOf } from "../address/address.js";
import type { PageState } from "../state/page_state.js";
import { lessonFigures, type LessonFigure } from "./lesson_figures.js";
import type { SectionPanel, Services, Shown } from "./section.js";

/** The chapter as lessons: text, equations, links that set the arm, exercises that are checked. */
export class LessonsSection implements SectionPanel {
  readonly root = element("div", { class: "panel lessons" });
  private readonly text = element("article", { "aria-live": "polite" });
  private readonly list = element("nav", { "aria-label": "Lessons" });
  private shown: Shown | null = null;
  private opened = "";
  private figure: LessonFigure | null = null;

  constructor(
    private readonly services: Services,
    private readonly joints: JointsPanel,
    private readonly arm: ExerciseContext["arm"],
  ) {
    this.text.addEventListener("click", (event) => void this.follow(event));
    this.root.append(this.list, this.text);
  }

  take(shown: Shown): void {
    this.figure?.leave();
    this.shown = shown;
  }

  update(q: number[], changed: ReadonlySet<keyof PageState>): void {
    const { lesson, degrees, showFrames } = this.services.store.get();
    if (!this.shown) return;
    if (changed.has("degrees")) this.joints.describe(this.shown.description.joints, degrees);
    if (this.joints.root.parentElement !== this.root) this.root.append(this.joints.root);
    this.joints.show(q);
    this.shown.view.show(q, this.shown.arm.forward(q), showFrames);
    this.figure?.update(this.shown, q);
    const wanted = lessons.find(({ id }) => id === lesson) ?? (lessons[0] as Lesson);
    if (wanted.id !== this.opened) void this.open(wanted);
  }

  leave(): void {
    this.figure?.leave();
    this.shown?.view.stage.changed();
  }

  private async open(lesson: Lesson): Promise<void> {
    this.opened = lesson.id;
    const failed = { default: "<p>This lesson cannot be loaded.</p>" };
    const { default: html } = await lesson.load().catch(() => failed);
    if (this.opened !== lesson.id) return;
    this.figure?.leave();
    this.figure = null;
    this.text.innerHTML = html; // ours, made when the page was built
    for (const place of this.text.querySelectorAll<HTMLElement>("[data-check]")) this.fill(place);
    this.showFigure();
    this.list.replaceChildren(
      ...lessons.map(({ id, title }) => {
        const current: Record<string, string> = id === lesson.id ? { "aria-current": "page" } : {};
        const link = element("a", { href: `#section=lessons&lesson=${id}`, ...current }, title);
        link.addEventListener("click", (event) => {
          event.preventDefault();
          void this.turnTo(id);
        });
        return link;
      }),
    );
  }

  private showFigure(): void {
    const place = this.text.querySelector<HTMLElement>("[data-figure]");
    const make = lessonFigures[place?.dataset["figure"] ?? ""];
    const { q, section } = this.services.store.get();
    if (!place || !make || !this.shown) return;
    this.figure = make(this.services);
    place.replaceChildren(this.figure.root);
    if (q && section === "lessons") this.figure.update(this.shown, q);
  }

  /** Opens a lesson with its figure; an arm from a file stays, as no name brings it back. */
  private async turnTo(id: string): Promise<void> {
    const { store } = this.services;
    const { arm, q, goal, showFrames } = await stateOf(lessons.find((lesson) => lesson.id === id)?.scene ?? "");
    const before = store.get().arm;
    if ("json" in before) return store.set({ lesson: id });
    const same = "text" in arm && arm.text === before.text;
    store.set({ arm: same ? before : arm, q, goal, showFrames, lesson: id });
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
    if (make) place.replaceChildren(make(context));
  }

  /** A link in a lesson sets what its address holds, and leaves the lesson open unless it names a section. */
  private async follow(event: MouseEvent): Promise<void> {
    const link = (event.target as HTMLElement).closest("a");
    const address = link?.getAttribute("href") ?? "";
    if (!address.startsWith("#")) return;
    event.preventDefault();
    const part = await partOf(address);
    const another = part.arm ? { q: null, goal: null } : {}; // of the arm before
    this.services.store.set({ ...another, ...part, section: part.section ?? "lessons" });
  }
}
