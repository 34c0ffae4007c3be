const maxSteps = 200;

/** States that one can go back to and forth again. States whose `work` is the same are one state. */
export class History<T extends object> {
  private past: T[] = [];
  private future: T[] = [];

  constructor(
    private now: T,
    private readonly work: readonly (keyof T)[],
  ) {}

  /** Begins anew with a state. */
  begin(state: T): void {
    [this.now, this.past, this.future] = [state, [], []];
  }

  /** Notes a state as the present one. Where the work differs, it is another one, and what was undone cannot be redone any
   * more. */
  record(state: T): void {
    if (this.differs(state)) {
      this.past.push(this.now);
      if (this.past.length > maxSteps) this.past.shift();
      this.future = [];
    }
    this.now = state;
  }

  /** Whether work has been done since the state that was noted last. */
  differs(state: T): boolean {
    return !this.work.every((key) => state[key] === this.now[key] || equalLists(state[key], this.now[key]));
  }

  /** The state before; null where there is none. */
  undo(): T | null {
    return this.step(this.past, this.future);
  }

  redo(): T | null {
    return this.step(this.future, this.past);
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  private step(from: T[], to: T[]): T | null {
    const state = from.pop();
    if (!state) return null;
    to.push(this.now);
    return (this.now = state);
  }
}

function equalLists(a: unknown, b: unknown): boolean {
  return Array.isArray(a) && Array.isArray(b) && JSON.stringify(a) === JSON.stringify(b);
}
