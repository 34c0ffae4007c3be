import { partOf, stateOf } from "../address/address.js";
import { element } from "../elements/element.js";
import { fading } from "../elements/fading.js";
import type { Exercise, ExerciseContext } from "../lessons/exercise.js";
import { exercises } from "../lessons/exercises.js";
import { lessonOf, lessons, type Lesson } from "../lessons/lessons.js";
import { keepResult } from "../lessons/results.js";
import { sameArm, type ArmSource, type PageState } from "../state/page_state.js";
import { documentOf } from "./documents.js";
import { handIn } from "./hand_in.js";
import { lessonFigure, type LessonFigure } from "./lesson_figures.js";
import { Contents, footOf, headOf } from "./lesson_frame.js";
import { helpWord, keepPart, openElsewhere, partsOf, type LessonPart } from "./lesson_part.js";
import { LessonPlayer } from "./lesson_player.js";
import { resultsReader } from "./results_reader.js";
import type { PageSection, Services, Shown } from "./section.js";
import { sheetBar } from "./sheet.js";
import { worksheet } from "./worksheet.js";

/** The arm of a state, where and how fast it goes, and how it is shown. */
function armOf({ arm, q, goal, gain, showFrames, showColumns, showSolutions, showEllipsoid }: Readonly<PageState>) {
  return { arm, q, goal, gain, showFrames, showColumns, showSolutions, showEllipsoid };
}

/** A lesson that is open, and which part of it. */
type Opened = Pick<PageState, "lesson" | "only" | "help">;
const isSame = (a: Opened, b: Opened): boolean => a.lesson === b.lesson && a.only === b.only && a.help === b.help;

/** Whether an exercise or a figure is shown alone. */
const isPart = ({ only }: Opened): boolean => only !== "" && only !== "lesson";

/** The chapter as lessons: text, equations, figures, links that set the arm, exercises that are checked. */
export class LessonsSection implements PageSection {
  readonly root = element("div", { class: "panel lessons" });
  /** The upper edge of the text on a phone. */
  readonly bar = sheetBar();
  /** What plays the figure's motion, under the picture. */
  readonly player: LessonPlayer;
  private readonly text = element("article");
  private readonly foot = element("div");
  private readonly handIn = handIn();
  /** From a part that is shown alone to the whole page. */
  private readonly whole = element("a", { class: "whole", target: "_blank" });
  /** Opens a lesson with its arm. */
  readonly open = (id: string): void => void this.turnTo(id, true);
  private readonly contents = new Contents(this.open);
  /** Said where another arm is in the picture than the lesson's. */
  private readonly other = element("p", { class: "other-arm", hidden: true });
  /** Said where the lesson's arm has replaced the one that was shown before. */
  private readonly replacing = element("p", { class: "other-arm", hidden: true });
  /** Said where the address asks for a part that the lesson does not have. */
  private readonly missing = element("p", { class: "refusal", role: "status" });
  private shown: Shown | null = null;
  private opened: Opened | null = null;
  /** The opened lesson could not be loaded: choosing it again tries again. */
  private hasFailed = false;
  private figures: LessonFigure[] = [];
  private exercises: Exercise[] = [];
  private tick: () => void = () => undefined;
  /** The arms that the lesson has set, and the heading that takes the focus once it is there. */
  private arms: ArmSource[] = [];
  private takesFocus = false;
  /** What the section before had, and the arm that a lesson has put in its place. */
  private replaced: { state: ReturnType<typeof armOf>; by: ArmSource } | null = null;

  constructor(
    private readonly services: Services,
    private readonly arm: ExerciseContext["arm"],
  ) {
    this.player = new LessonPlayer((q) => services.store.set({ q }));
    this.text.addEventListener("click", (event) => void this.follow(event));
    this.text.addEventListener("solved", ({ target }) => this.solve(target as HTMLElement));
    const back = element("button", { type: "button" }, "Show the lesson’s arm");
    back.addEventListener("click", () => this.open(this.opened?.lesson ?? ""));
    this.other.append("Another arm is in the picture. ", back);
    const restore = element("button", { type: "button" }, "Show the arm before");
    restore.addEventListener("click", () => this.replaced && services.store.set(this.replaced.state));
    this.replacing.append("The lesson’s arm has replaced the one before. ", restore);
    this.root.append(
      this.contents.root,
      this.missing,
      this.replacing,
      this.other,
      this.text,
      this.foot,
      this.handIn.root,
      this.whole,
    );
  }

  take(shown: Shown): void {
    this.shown = shown;
  }

  /** The exercises and figures of the lesson that is open. */
  parts(): LessonPart[] {
    return partsOf(this.text);
  }

  update(q: number[]): void {
    const { lesson, arm, only, help } = this.services.store.get();
    if (!this.shown) return;
    const wanted = { lesson: lessonOf(lesson).id, only, help };
    if (!this.opened || !isSame(wanted, this.opened)) void this.load(wanted);
    for (const figure of this.figures) figure.update(this.shown, q);
    for (const exercise of this.exercises) exercise.update?.();
    this.other.hidden = this.arms.length === 0 || this.arms.some((one) => sameArm(one, arm));
    this.replacing.hidden = !this.replaced || !this.other.hidden || sameArm(this.replaced.state.arm, arm);
  }

  leave(): void {
    this.player.pause();
    this.leaveFigures();
  }

  /** A hand moves the arm. */
  interrupt(): void {
    this.player.pause();
  }

  /** The section was chosen: its lesson brings the arm that it speaks of. */
  async enter(): Promise<void> {
    const { lesson, arm } = this.services.store.get();
    const { id, scene } = lessonOf(lesson);
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

  private async load(wanted: Opened): Promise<void> {
    const lesson = lessonOf(wanted.lesson);
    let opened = wanted;
    this.opened = opened;
    this.hasFailed = false;
    this.leaveFigures(); // before the lesson is there: a motion that is played would leave its start
    this.figures = [];
    this.exercises = [];
    this.player.take([]);
    this.missing.textContent = "";
    const failed = { default: "<p>This lesson cannot be loaded: choose it again, or reload the page.</p>" };
    const [loaded, scene] = await Promise.all([lesson.load().catch(() => failed), stateOf(lesson.scene)]);
    if (this.opened !== opened) return;
    this.hasFailed = loaded === failed;
    const html = loaded.default;
    this.services.draw({ waypoints: [], extent: [] });
    this.text.innerHTML = html; // ours, made when the page was built
    if (!opened.help) for (const hint of this.text.querySelectorAll("[data-check] details")) hint.remove();
    if (isPart(opened) && !keepPart(this.text, opened.only) && !this.hasFailed) {
      this.missing.textContent = `This lesson has no part ${opened.only.slice(0, 40)}: it is shown as a whole.`;
      opened = this.opened = { ...opened, only: "lesson" };
      this.services.store.set({ only: "lesson" });
    }
    if (opened.only !== "") openElsewhere(this.text, opened.help);
    this.whole.textContent = `Lesson ${lesson.title}, in the whole page`;
    this.whole.href = `#section=lessons&lesson=${lesson.id}${helpWord(opened.help)}`;
    this.arms = [scene.arm];
    this.showFoot(lesson);
    if (lessons.includes(lesson)) this.text.querySelector("h1")?.after(headOf(lesson, this.open));
    for (const place of this.text.querySelectorAll<HTMLElement>("[data-check]")) this.fill(place);
    this.handIn.root.hidden = this.exercises.length === 0;
    this.showFigures();
    this.showTools();
    void this.bringArm(opened);
    for (const math of this.text.querySelectorAll<MathMLElement>('math[display="block"]')) {
      fading(math);
      if (math.scrollWidth > math.clientWidth) math.setAttribute("tabindex", "0"); // keys scroll it
    }
    this.contents.show(lesson.id);
    this.showTop();
    const { q, section } = this.services.store.get();
    if (q && section === "lessons") this.update(q);
  }

  /** A lesson begins at its top; the one that a link has opened takes the focus. */
  private showTop(): void {
    this.root.parentElement?.scrollTo({ top: 0 });
    const heading = this.text.querySelector("h1");
    heading?.setAttribute("tabindex", "-1");
    if (!this.takesFocus) return;
    this.takesFocus = false;
    this.contents.root.open = false;
    heading?.focus({ preventScroll: true });
  }

  /** A lesson ends with its tick, the errata with where their computations are. */
  private showFoot(lesson: Lesson): void {
    const foot = footOf(lesson, this.open, () => this.contents.show(lesson.id));
    this.tick = () => foot.tick();
    const computations = documentOf("errata of the chapter", "errata");
    if (lessons.includes(lesson)) this.foot.replaceChildren(foot.root);
    else if (lesson.id !== "errata") this.foot.replaceChildren();
    else this.foot.replaceChildren(element("p", {}, "Computations for most entries: ", computations, "."));
  }

  private showFigures(): void {
    for (const place of this.text.querySelectorAll<HTMLElement>("[data-figure]")) {
      const figure = lessonFigure(place.dataset["figure"] ?? "", this.services, this.player);
      if (!figure) continue;
      this.figures.push(figure);
      place.replaceChildren(figure.root);
    }
  }

  /** An exercise or a figure that is shown alone brings its arm, where that is not the lesson's. */
  private async bringArm(opened: Opened): Promise<void> {
    if (!isPart(opened)) return;
    const links = [...this.text.querySelectorAll<HTMLAnchorElement>("a.scene")];
    const [first, ...others] = await Promise.all(links.map((link) => partOf(link.getAttribute("href") ?? "")));
    if (this.opened !== opened) return;
    const isShown = [first, ...others].some((one) => one?.arm && sameArm(one.arm, this.services.store.get().arm));
    if (first?.arm && !isShown) {
      this.arms.push(first.arm);
      return this.services.store.set({ q: null, goal: null, ...first });
    }
    const { arm, start } = this.exercises.find((one) => one.arm !== undefined) ?? {};
    if (arm === undefined || sameArm(this.services.store.get().arm, { text: arm })) return;
    this.services.store.set({ arm: { text: arm }, q: start ?? null, goal: null });
  }

  private showTools(): void {
    const tools: Record<string, () => HTMLElement> = {
      worksheet: () => worksheet(this.services),
      documents: () =>
        element("p", {}, "More in the documentation: ", documentOf("lessons in a course", "howto/course"), "."),
      results: () => resultsReader({ arm: this.arm, random: Math.random }),
    };
    for (const place of this.text.querySelectorAll<HTMLElement>("[data-tool]")) {
      const tool = tools[place.dataset["tool"] ?? ""]?.();
      if (tool) place.replaceChildren(tool);
    }
  }

  private leaveFigures(): void {
    for (const figure of this.figures) figure.leave();
  }

  /** Opens a lesson with its figure. The arm before comes back with the next section, the browser's Back, or Undo. */
  private async turnTo(id: string, takesFocus = false): Promise<void> {
    const { store } = this.services;
    const scene = await stateOf(lessonOf(id).scene);
    const before = store.get();
    const now = sameArm(scene.arm, before.arm) ? before.arm : scene.arm;
    if (before.section !== "lessons") this.replaced = { state: armOf(before), by: now };
    else if (this.replaced) {
      const isBack = sameArm(this.replaced.state.arm, before.arm); // brought back, and perhaps moved
      this.replaced = { state: isBack ? armOf(before) : this.replaced.state, by: now };
    }
    const again = this.hasFailed;
    if (again) this.opened = null;
    this.takesFocus = takesFocus && id !== this.opened?.lesson;
    this.player.pause();
    store.set({ ...armOf(scene), arm: now, lesson: id, section: "lessons" });
    if (again && this.opened === null) void this.load({ lesson: id, only: before.only, help: before.help }); // nothing else
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
    const number = this.exercises.length;
    if (number > 1) exercise.root.setAttribute("aria-label", `Exercise ${number}`);
    const heading = exercise.root.querySelector("h2");
    if (number > 1 && heading) heading.textContent = `Exercise ${number}`;
    for (const arm of [exercise.arm, exercise.solvedArm]) if (arm !== undefined) this.arms.push({ text: arm });
    exercise.root.querySelector("h2")?.after(...place.querySelectorAll(".task, .paper"));
    exercise.root.append(...place.childNodes); // hints and the solution
    place.replaceChildren(exercise.root);
    place.addEventListener("solved", () => {
      keepResult({ name: place.dataset["check"] ?? "", answer: exercise.answer(), time: Date.now() });
      this.handIn.refresh();
    });
  }

  /** An exercise is solved: with the last one of a lesson, the lesson is done. */
  private solve(exercise: HTMLElement): void {
    exercise.closest("[data-check]")?.classList.add("is-solved");
    const isAlone = this.opened !== null && isPart(this.opened);
    if (!isAlone && !this.text.querySelector("[data-check]:not(.is-solved)")) this.tick();
  }

  /** A link in a lesson sets what its address holds, and leaves the lesson open unless it names a section. */
  private async follow(event: MouseEvent): Promise<void> {
    const link = (event.target as HTMLElement).closest("a");
    const address = link?.getAttribute("href") ?? "";
    if (event.defaultPrevented || !address.startsWith("#")) return;
    if (link?.target === "_blank") return;
    event.preventDefault();
    this.player.pause();
    const part = await partOf(address);
    if (part.section === "lessons" && part.lesson !== undefined && !part.arm) return this.turnTo(part.lesson, true);
    const { arm } = this.services.store.get();
    if (part.arm && sameArm(part.arm, arm)) part.arm = arm;
    if (part.arm) this.arms.push(part.arm);
    const another = part.arm ? { q: null, goal: null } : {}; // of the arm before
    this.services.store.set({ ...another, ...part, section: part.section ?? "lessons" });
  }
}
