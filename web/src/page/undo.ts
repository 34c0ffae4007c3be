import { iconButton } from "../elements/button.js";
import { History } from "../state/history.js";
import { work, type PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { Holding } from "./holding.js";
import { Rest } from "./rest.js";

const settled = 400; // milliseconds until a state is one to go back to

/** Undo and redo of the work: buttons and keys. */
export class Undo {
  readonly buttons: HTMLButtonElement[];
  private readonly undo = iconButton("undo", "Undo", "Undo (Ctrl Z)", () => this.go("undo"));
  private readonly redo = iconButton("redo", "Redo", "Redo (Ctrl Shift Z)", () => this.go("redo"));
  private readonly history: History<PageState>;
  private readonly rest = new Rest(settled);

  constructor(
    private readonly store: Store<PageState>,
    private readonly holding: Holding,
  ) {
    this.buttons = [this.undo, this.redo];
    this.history = new History(store.get(), work);
    this.show();
  }

  /** There is nothing to undo before the present state. */
  begin(): void {
    this.history.begin(this.store.get());
    this.show();
  }

  /** Notes a state to go back to, once the hand rests. What has changed can be undone at once. */
  note(): void {
    this.show();
    this.rest.then(() => {
      if (this.holding.holds) this.note();
      else this.record();
    });
  }

  record(): void {
    if (this.holding.holds) return;
    this.history.record(this.store.get());
    this.show();
  }

  key(event: KeyboardEvent): void {
    const typing = (event.target as Element).matches?.("input:not([type=range]), textarea, select");
    if (typing || !(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    event.preventDefault();
    this.go(event.shiftKey ? "redo" : "undo");
  }

  private go(step: "undo" | "redo"): void {
    this.record(); // what was done a moment ago
    const state = this.history[step]();
    if (!state) return;
    this.holding.forget();
    const { section, lesson } = state; // where the work was done
    this.store.set({ ...Object.fromEntries(work.map((key) => [key, state[key]])), section, lesson });
    this.show();
  }

  private show(): void {
    this.undo.disabled = !this.history.canUndo && !this.history.differs(this.store.get());
    this.redo.disabled = !this.history.canRedo;
  }
}
