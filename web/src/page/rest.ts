const calm = 120; // milliseconds

/** Runs the last of several tasks, once no other has come for a moment. */
export class Rest {
  private timer = 0;

  constructor(private readonly delay = calm) {}

  then(task: () => void): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(task, this.delay);
  }

  cancel(): void {
    clearTimeout(this.timer);
  }
}
