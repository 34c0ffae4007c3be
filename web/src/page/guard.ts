import type { GuardedStep } from "../core/scene.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { Overlays } from "./overlays.js";
import type { SceneModel } from "./scene_model.js";

/** What holds the arm back in front of the joint values that the hand wants. */
export interface HeldBack {
  to: number[];
  /** The bodies: the first belongs to the arm. */
  names: [string, string];
  /** Whether they are below their clearance already, and may only come apart. */
  areClose: boolean;
  /** Whether the arm could stand at `to`. */
  isGoalFree: boolean;
}

type Answered = (held: HeldBack | null) => void;

const maxRounds = 60; // of one wish

/** Leads the arm that is dragged among obstacles as far as the clearance allows. The worker computes one step at a time,
 * towards the newest joint values that are wanted; a ghost shows them where the arm is held back. */
export class Guard {
  /** Called when the arm is not held back any more, as it moves otherwise. */
  freed: () => void = () => undefined;
  private wanted: { to: number[]; slides: boolean; answered: Answered } | null = null;
  private running: Promise<void> | null = null;
  private held: HeldBack | null = null;
  private isLeading = false;
  /** Counts what ends the wishes before it. */
  private turn = 0;

  constructor(
    private readonly store: Store<PageState>,
    private readonly model: SceneModel,
    private readonly overlays: Overlays,
  ) {
    const others = ["arm", "section", "scene", "clearance", "passes"] as const;
    store.subscribe((_, changed) => {
      if ((changed.has("q") && !this.isLeading) || others.some((key) => changed.has(key))) this.stop();
    });
  }

  get isOn(): boolean {
    return !this.store.get().passes && this.model.isGuarded;
  }

  /** Moves the arm towards joint values. `slides`: the tool slides along bodies; else the arm stops. `answered` is called
   * once it has come as far as it can, unless other joint values are wanted before. */
  lead(to: number[], slides: boolean, answered: Answered): void {
    this.wanted = { to, slides, answered };
    this.running ??= this.run().finally(() => (this.running = null));
  }

  /** The arm is not led any more, and the ghost vanishes. */
  stop(): void {
    ++this.turn;
    this.wanted = null;
    if (this.held) this.freed();
    this.hold(null);
  }

  /** The hand has let go. Returns what holds the arm back, once it has come as far as it can. */
  async released(): Promise<HeldBack | null> {
    const { turn } = this;
    await this.running;
    if (turn !== this.turn) return null; // what is held now belongs to another hand
    const { held } = this;
    this.hold(null);
    return held;
  }

  private async run(): Promise<void> {
    for (let round = 1; this.wanted; ++round) {
      const { wanted, turn } = this;
      const from = this.store.get().q ?? wanted.to;
      // What cannot be answered moves nothing: the section Obstacles says why.
      const step = await this.model.guarded(from, wanted.to, wanted.slides).catch(() => undefined);
      if (turn !== this.turn) continue; // the arm has moved otherwise
      this.isLeading = true;
      if (step !== undefined) this.store.set({ q: step?.q ?? wanted.to });
      this.isLeading = false;
      if (this.wanted !== wanted) {
        round = 0;
        continue;
      }
      if (step?.isOnItsWay && round < maxRounds) continue;
      this.wanted = null;
      this.hold(step ? this.heldBy(step, wanted.to) : null);
      wanted.answered(this.held);
    }
  }

  private heldBy({ heldBy, isGoalFree }: GuardedStep, to: number[]): HeldBack | null {
    if (!heldBy) return null;
    const names = this.model.namesOf(heldBy);
    const isSame = (pair: string[]): boolean => names.every((name) => pair.includes(name));
    const areClose = this.model.nearest.some((pair) => pair.lower < pair.clearance && isSame(pair.names));
    return { to, names, areClose, isGoalFree };
  }

  private hold(held: HeldBack | null): void {
    if (held === this.held) return;
    this.held = held;
    this.overlays.want(held?.to ?? null);
  }
}
