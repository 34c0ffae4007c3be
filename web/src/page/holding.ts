import { answer } from "../core/command.js";
import { clamped, hasFullTask, nearestTo } from "../core/nearest.js";
import { poseError, sevenOf, toolPose } from "../core/pose.js";
import { shown as text } from "../elements/element.js";
import { unitOf } from "../elements/units.js";
import { reasonInWords, type Wording } from "../panels/reasons/reasons.js";
import type { InverseAnswer } from "../panels/solutions.js";
import type { Hand } from "../scene/picture.js";
import type { Guard, HeldBack } from "./guard.js";
import { Rest } from "./rest.js";
import type { PageSection, Services, Shown } from "./section.js";

/** What the hand does in the picture: the tool is dragged, and slides along the border where it cannot go; links turn
 * their joints within the limits. Among obstacles the guard leads the arm. Beside the tool stands the reason. */
export class Holding implements Hand {
  private shown: Shown | null = null;
  private isPressed = false;
  private asked = 0;
  private readonly rest = new Rest();

  constructor(
    private readonly services: Services,
    private readonly guard: Guard,
    private readonly section: () => PageSection | undefined,
  ) {
    guard.freed = () => this.say("");
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.forget();
  }

  tool(pose: number[]): void {
    const { q } = this.services.store.get();
    if (!this.shown || !q) return;
    const { arm, description, picture } = this.shown;
    if (!this.isPressed) this.section()?.interrupt?.(); // by keys
    const [found] = arm.inverse(pose, q);
    if (found) return this.lead(Array.from(found), true, () => this.say(""));
    const near = nearestTo(arm, description.joints, pose, q, picture.size);
    const off = Math.hypot(...poseError(toolPose(arm, near), pose).slice(0, 3));
    const isThere = off < 1e-3 * picture.size;
    this.lead(near, true, () => {
      if (!hasFullTask(arm) && isThere) this.say("");
      else void this.explain(pose, q, off);
    });
  }

  joint(k: number, value: number): void {
    const { q, degrees } = this.services.store.get();
    const joint = this.shown?.description.joints[k];
    if (!joint || !q) return;
    const moved = clamped(q.with(k, value), this.shown?.description.joints ?? []);
    const at = moved[k] ?? 0;
    const unit = unitOf(joint.type, degrees);
    const limit = `${text(at * unit.factor, unit.name === "°" ? 1 : 3)}${unit.name === "°" ? "" : "\u00a0"}${unit.name}`;
    this.lead(q.with(k, at), false, () => {
      this.say(at === value ? "" : `${joint.name} is at its limit, ${limit}.`);
    });
  }

  /** A slider was dragged to joint values. */
  slid(q: number[]): void {
    this.lead(q, false, () => this.say(""));
  }

  /** The tool is asked to go to a pose that was typed. Where it is not reached, the arm stays; `refused` gets the
   * reason. */
  typed(pose: number[], refused: (reason: string) => void): void {
    const { q } = this.services.store.get();
    if (!this.shown || !q) return;
    this.section()?.interrupt?.();
    let found: Float64Array | undefined;
    try {
      [found] = this.shown.arm.inverse(pose, q);
    } catch (error) {
      return refused((error as Error).message); // for numbers beyond the range of any arm
    }
    if (!found) return void this.explain(pose, q, null, refused);
    this.forget();
    this.services.store.set({ q: Array.from(found) });
  }

  waypoint(index: number, pose: number[], released: boolean): void {
    this.section()?.waypoint?.(index, pose, released);
  }

  tile(point: number[]): void {
    this.section()?.tile?.(point);
  }

  obstacle(index: number, pose: number[] | null): void {
    this.section()?.obstacle?.(index, pose);
  }

  pressed(): void {
    this.isPressed = true;
    this.guard.stop(); // what a slider was held back from is no goal of this hand
    this.section()?.interrupt?.();
  }

  released(): void {
    this.isPressed = false;
    this.say("");
    void this.guard.released().then((held) => {
      if (held?.isGoalFree) this.section()?.dropped?.(held.to);
    });
  }

  get holds(): boolean {
    return this.isPressed;
  }

  /** The arm has moved on: an old reason does not stand beside it. */
  forget(): void {
    this.guard.stop();
    this.say("");
  }

  /** Says something else beside the tool, or nothing. */
  private say(sentence: string): void {
    ++this.asked;
    this.rest.cancel();
    this.shown?.picture.say(sentence);
  }

  /** Moves the arm to joint values, or among obstacles as far as the clearance allows; `there` says what is to be said
   * where nothing holds it back. */
  private lead(to: number[], slides: boolean, there: () => void): void {
    if (!this.guard.isOn) {
      this.services.store.set({ q: to });
      return there();
    }
    const isByHand = this.isPressed;
    this.guard.lead(to, slides, (held) => {
      if (isByHand && !this.isPressed) return; // it has let go
      if (!held) return there();
      this.say(this.whyHeld(held));
    });
  }

  private whyHeld({ names: [first, second], areClose, isGoalFree }: HeldBack): string {
    const why = areClose
      ? `${first} is too close to ${second}: it can only move away.`
      : `${first} stops in front of ${second}.`;
    return isGoalFree && this.isPressed && this.section()?.dropped ? `${why} Let go to plan a way around.` : why;
  }

  /** Asks the command why a pose is not reached, once the hand rests. `away`: how far from it the tool stands, m, while a
   * hand drags it; null: the pose was typed, and the arm has stayed where it was. */
  private async explain(
    pose: number[],
    q: number[],
    away: number | null,
    refused: (reason: string) => void = () => undefined,
  ): Promise<void> {
    const asked = ++this.asked;
    const { shown } = this;
    shown?.picture.say("The tool cannot go there.");
    await new Promise<void>((resolve) => this.rest.then(resolve));
    if (asked !== this.asked) return;
    const found = await this.reasonFor(pose, q).catch((error: unknown) => error as Error);
    if (asked !== this.asked || shown !== this.shown || !shown) return;
    if (found instanceof Error) return refused(found.message);
    if (found.reason === "") return;
    refused(reasonInWords(found, this.wording));
    if (away === null || this.isPressed) shown.picture.say(this.inWords(found, away));
  }

  private get wording(): Wording {
    return { degrees: this.services.store.get().degrees, planar: this.shown?.arm.planar === true };
  }

  /** A short sentence beside the tool, where the panel has the whole one. */
  private inWords(found: InverseAnswer, away: number | null): string {
    const { code, fields } = found;
    const digits = (value: number): string => text(value, 3);
    const isFar = code === "position_unreachable";
    if (away !== null) {
      const why = isFar ? "Out of reach." : reasonInWords(found, this.wording);
      return away < 1e-3 * (this.shown?.picture.size ?? 1) ? why : `${why} The tool stays ${digits(away)} m away.`;
    }
    const point = ((fields["nearest"] ?? []) as number[]).slice(0, this.wording.planar ? 2 : 3).map(digits);
    if (!isFar || point.length === 0) return reasonInWords(found, this.wording);
    return `Out of reach by ${digits(Number(fields["distance"]))} m: the nearest point is (${point.join(", ")}) m.`;
  }

  private async reasonFor(pose: number[], q: number[]): Promise<InverseAnswer> {
    const args = ["ik", "arm.json", `--pose=${sevenOf(pose).join(",")}`, `--seed=${q.join(",")}`, "--json"];
    return answer<InverseAnswer>(await this.services.command(args));
  }
}
