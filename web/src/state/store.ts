type Listener<T> = (state: Readonly<T>, changed: ReadonlySet<keyof T>) => void;

/** A state that reports to its listeners which members have changed. */
export class Store<T extends object> {
  private state: T;
  private readonly listeners = new Set<Listener<T>>();

  constructor(initial: T) {
    this.state = { ...initial };
  }

  get(): Readonly<T> {
    return this.state;
  }

  set(change: Partial<T>): void {
    const changed = new Set<keyof T>();
    for (const key of Object.keys(change) as (keyof T)[]) {
      if (change[key] !== this.state[key]) changed.add(key);
    }
    if (changed.size === 0) return;
    this.state = { ...this.state, ...change };
    for (const listener of this.listeners) listener(this.state, changed);
  }

  /** Calls the listener after each change; returns what ends that. */
  subscribe(listener: Listener<T>): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}
