import type { PageState } from "../state/page_state.js";

/** What a frame around the page reads to be as high as what it holds: { beeline: "height", height }, in pixels. */
function report(height: number): void {
  window.parent.postMessage({ beeline: "height", height }, "*"); // a number, which anybody may know
}

/** The page without its surroundings, where the address asks for it: a lesson, an exercise or a figure alone. In a frame it
 * reports its height. */
export class Alone {
  private readonly watcher: ResizeObserver | null;
  private last = 0;
  private isAlone = false;

  constructor(private readonly document: Document) {
    const main = document.querySelector("main");
    const isFramed = window.parent !== window;
    this.watcher = main && isFramed ? new ResizeObserver(() => this.measure(main)) : null;
  }

  update({ only, section }: Readonly<PageState>): void {
    const isAlone = only !== "" && section === "lessons";
    const { classList } = this.document.body;
    classList.toggle("shows-lesson", only === "lesson");
    if (isAlone === this.isAlone) return;
    this.isAlone = isAlone;
    classList.toggle("alone", isAlone);
    const main = this.document.querySelector("main");
    if (isAlone && main) this.watcher?.observe(main);
    else this.watcher?.disconnect();
  }

  private measure(main: HTMLElement): void {
    const height = Math.ceil(main.getBoundingClientRect().height);
    if (height === this.last) return;
    this.last = height;
    report(height);
  }
}
