import { element } from "../elements/element.js";
import { planReport, type LineAnswer } from "../panels/motion_report.js";
import type { Services, Shown } from "./section.js";
import { Work } from "./work.js";

/** The report of a motion that the worker computes, or why there is none. */
export class ReportedMotion {
  readonly root = element("div", { role: "status" });
  readonly work: Work;
  private shown: Shown | null = null;
  private found: LineAnswer | null = null;

  constructor(private readonly services: Services) {
    this.work = new Work(services, (reason) => this.refuse(reason));
  }

  take(shown: Shown): void {
    this.shown = shown;
  }

  /** Shows the report of an answer, or none. */
  show(found: LineAnswer | null): void {
    this.found = found;
    this.root.replaceChildren(...(found ? [this.reportOf(found)] : []));
  }

  refuse(reason: string): void {
    this.found = null;
    this.root.replaceChildren(element("p", { class: "refusal" }, reason));
  }

  unitsChanged(): void {
    if (this.found) this.show(this.found);
  }

  private reportOf(found: LineAnswer): HTMLElement {
    const { services, shown } = this;
    const wording = { degrees: services.store.get().degrees, planar: shown?.arm.planar === true };
    return planReport(found, shown?.description.joints ?? [], wording, services.unchecked());
  }
}
