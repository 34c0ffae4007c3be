import { addressOf, longestAddress } from "../address/address.js";
import { element } from "../elements/element.js";
import type { PageState } from "../state/page_state.js";

const calm = 250; // milliseconds: browsers limit how often the address may change

/** The address of the page follows its state. Another section, arm or lesson is a step of the browser's Back. */
export class AddressBar {
  readonly note = element("p", { role: "status", class: "refusal" });
  private written: PageState | null = null;
  private turn = 0;
  private fault = "";

  /** The address has changed by itself: what is about to be written belongs to the one before. */
  forget(): void {
    ++this.turn;
  }

  /** The state has come from the address. `fault`: why a part of it cannot be read. */
  read(state: PageState, fault = ""): void {
    this.forget();
    this.written = state;
    this.fault = this.note.textContent = fault;
  }

  async write(state: PageState): Promise<void> {
    const turn = ++this.turn;
    const before = this.written;
    const isFramed = state.only !== ""; // the browser's Back belongs to the page around it
    const step =
      !isFramed && before !== null && (["section", "arm", "lesson"] as const).some((key) => before[key] !== state[key]);
    if (!step) await new Promise((resolve) => setTimeout(resolve, calm));
    if (turn !== this.turn) return;
    const hash = `#${await addressOf(state)}`;
    if (turn !== this.turn) return;
    const fits = hash.length <= longestAddress;
    if (before?.scene !== state.scene) this.fault = "";
    this.note.textContent = fits
      ? this.fault
      : "This is too long for a link: the address stays as it was. Share it as one file.";
    if (!fits) return;
    this.written = state;
    // In full, as the frame of a notebook (about:srcdoc) takes other addresses for addresses of the notebook.
    const address = location.href.replace(/#.*|$/, () => hash);
    if (address === location.href) return; // after the browser's Back: another write could end the next one
    if (step) history.pushState(null, "", address);
    else history.replaceState(null, "", address);
  }
}
