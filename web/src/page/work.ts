import { Cancelled } from "../core/types.js";
import { element } from "../elements/element.js";
import type { Services } from "./section.js";

const patience = 400; // milliseconds without a bar

/** A computation in the worker with its progress and a button that cancels it. A new one takes the place of the one
 * before. */
export class Work {
  readonly root: HTMLElement;
  private readonly bar = element("progress", { max: 1, value: 0, "aria-label": "Progress" });
  private timer = 0;
  private turn = 0;
  private running = false;

  constructor(
    private readonly services: Services,
    private readonly refused: (reason: string) => void,
  ) {
    const stop = element("button", { type: "button", onclick: () => services.cancel() }, "Cancel");
    this.root = element("p", { class: "pair", hidden: true }, this.bar, stop);
  }

  /** Runs `work`, which asks current() whether it is still wanted after each wait. */
  async run(work: (progress: (fraction: number) => void, current: () => boolean) => Promise<void>): Promise<void> {
    this.stop();
    const turn = this.turn;
    const current = (): boolean => turn === this.turn;
    this.running = true;
    this.bar.value = 0;
    this.timer = window.setTimeout(() => (this.root.hidden = false), patience);
    try {
      await work((fraction) => {
        if (current()) this.bar.value = fraction;
      }, current);
    } catch (error) {
      if (current() && !(error instanceof Cancelled)) this.refused((error as Error).message);
    } finally {
      if (current()) this.end();
    }
  }

  /** What is computed is not wanted any more. */
  stop(): void {
    ++this.turn;
    if (this.running) this.services.cancel();
    this.end();
  }

  private end(): void {
    clearTimeout(this.timer);
    this.running = false;
    this.root.hidden = true;
  }
}
