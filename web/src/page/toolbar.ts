import { addressOf } from "../address/address.js";
import { element } from "../panels/element.js";
import { saveFile } from "../share/save_file.js";
import { pageAsDocument } from "../share/save_page.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { ArmView } from "./arm_view.js";

type Switch = "degrees" | "showFrames" | "showSolutions" | "showEllipsoid";

/** The buttons of the picture; `saveSvg` is one more of them. `refuse` gets the reason where something is not saved. */
export function toolbar(
  store: Store<PageState>,
  view: () => ArmView | null,
  saveSvg: HTMLElement,
  refuse: (reason: string) => void,
): HTMLElement[] {
  const report = (error: unknown): void => refuse(`The page is not saved: ${(error as Error).message}`);
  const pressed = (on: boolean): Record<string, string> => ({ "aria-pressed": String(on) });
  const toggle = (text: string, key: Switch): HTMLElement => {
    const button = element("button", { type: "button", ...pressed(store.get()[key]) }, text);
    button.addEventListener("click", () => store.set({ [key]: !store.get()[key] }));
    store.subscribe((state) => button.setAttribute("aria-pressed", String(state[key])));
    return button;
  };
  const turn = element("button", { type: "button", ...pressed(false) }, "Turn the tool");
  turn.addEventListener("click", () => {
    const turning = turn.getAttribute("aria-pressed") !== "true";
    turn.setAttribute("aria-pressed", String(turning));
    const shown = view();
    if (shown) shown.handleMode = turning ? "rotate" : "translate";
  });
  store.subscribe((_, changed) => {
    if (changed.has("arm")) turn.setAttribute("aria-pressed", "false"); // another arm begins with arrows
  });
  const home = element("button", { type: "button", onclick: () => view()?.stage.home() }, "Whole arm");
  const save = element("button", { type: "button", onclick: () => void savePicture(view()) }, "Save picture");
  return [
    toggle("Degrees", "degrees"),
    toggle("Frames", "showFrames"),
    toggle("All solutions", "showSolutions"),
    toggle("Velocity ellipsoid", "showEllipsoid"),
    turn,
    home,
    save,
    saveSvg,
    element("button", { type: "button", onclick: () => void savePage(store).catch(report) }, "Save page"),
  ];
}

async function savePicture(view: ArmView | null): Promise<void> {
  const blob = await view?.stage.picture();
  if (blob) saveFile("arm.png", blob);
}

/** One file that holds the page, the core and the arm. */
async function savePage(store: Store<PageState>): Promise<void> {
  const text = await pageAsDocument(await addressOf(store.get()));
  saveFile("beeline.html", new Blob([text], { type: "text/html" }));
}
