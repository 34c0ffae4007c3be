import { iconButton } from "../elements/button.js";
import type { IconName } from "../elements/icons.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { Shown } from "./section.js";

type Switch = "showFrames" | "showAngles" | "showSolutions" | "showColumns" | "showEllipsoid";

const switches: { key: Switch; icon: IconName; word: string; title: string; planar?: true }[] = [
  { key: "showAngles", icon: "angles", word: "Angles", title: "The values of the joints", planar: true },
  { key: "showFrames", icon: "frames", word: "Frames", title: "The frame of each link" },
  {
    key: "showSolutions",
    icon: "solutions",
    word: "Solutions",
    title: "All configurations with this pose of the tool",
  },
  { key: "showColumns", icon: "columns", word: "Jacobian", title: "Its columns: the tool's velocity for each joint" },
  {
    key: "showEllipsoid",
    icon: "ellipsoid",
    word: "Ellipsoid",
    title: "The tool's velocities for joint velocities of norm 1",
  },
];

/** The buttons of the picture: those that act on the arm that is shown. */
export class Toolbar {
  readonly buttons: HTMLElement[];
  private readonly planarOnly: HTMLElement[];
  private readonly turn: HTMLButtonElement;
  private shown: Shown | null = null;

  constructor(private readonly store: Store<PageState>) {
    const toggles = switches.map(({ key, icon, word, title }) => this.toggle(key, icon, word, title));
    this.planarOnly = toggles.filter((_, i) => switches[i]?.planar);
    this.turn = iconButton("turn", "Turn", "The handle at the tool turns it instead of moving it", () =>
      this.setTurning(),
    );
    this.turn.setAttribute("aria-pressed", "false");
    const home = iconButton("whole", "Whole arm", "Show the whole arm", () => this.shown?.picture.home());
    this.buttons = [...toggles, this.turn, home];
  }

  take(shown: Shown): void {
    this.shown = shown;
    for (const button of this.planarOnly) button.hidden = !shown.arm.planar;
    this.turn.hidden = shown.arm.planar;
    this.turn.setAttribute("aria-pressed", "false"); // another arm begins with arrows
  }

  private setTurning(): void {
    const turning = this.turn.getAttribute("aria-pressed") !== "true";
    this.turn.setAttribute("aria-pressed", String(turning));
    this.shown?.picture.mark({ turning });
  }

  private toggle(key: Switch, icon: IconName, word: string, title: string): HTMLElement {
    const { store } = this;
    const button = iconButton(icon, word, title, () => store.set({ [key]: !store.get()[key] }));
    const show = (state: Readonly<PageState>): void => button.setAttribute("aria-pressed", String(state[key]));
    store.subscribe(show);
    show(store.get());
    return button;
  }
}
