import { dialog } from "../elements/dialog.js";
import { element } from "../elements/element.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import { documentOf } from "./documents.js";

const themeKey = "beeline-theme";
const themes = [
  ["", "as the system"],
  ["light", "light"],
  ["dark", "dark"],
] as const;

function storedTheme(): string {
  try {
    return localStorage.getItem(themeKey) ?? "";
  } catch {
    return ""; // pages from a disk may have no storage
  }
}

function useTheme(theme: string): void {
  if (theme === "") delete document.documentElement.dataset["theme"];
  else document.documentElement.dataset["theme"] = theme;
  try {
    localStorage.setItem(themeKey, theme);
  } catch {
    // It holds until the page is closed.
  }
}

/** A group of radio buttons; `chosen` gets the value. */
function choice(
  legend: string,
  name: string,
  options: readonly (readonly [string, string])[],
  chosen: (value: string) => void,
): { root: HTMLElement; show(value: string): void } {
  const radios = options.map(([value]) => element("input", { type: "radio", name, value }));
  for (const radio of radios) radio.addEventListener("change", () => chosen(radio.value));
  const labels = options.map(([, text], i) => element("label", {}, radios[i] as HTMLElement, ` ${text}`));
  return {
    root: element("fieldset", { class: "choices" }, element("legend", {}, legend), ...labels),
    show(value) {
      for (const radio of radios) radio.checked = radio.value === value;
    },
  };
}

/** Units and appearance. */
export function settingsDialog(store: Store<PageState>): HTMLDialogElement {
  useTheme(storedTheme());
  const units = choice(
    "Angles",
    "unit",
    [
      ["deg", "degrees"],
      ["rad", "radians"],
    ],
    (value) => store.set({ degrees: value === "deg" }),
  );
  const appearance = choice("Appearance", "theme", themes, useTheme);
  const show = ({ degrees }: Readonly<PageState>): void => units.show(degrees ? "deg" : "rad");
  store.subscribe(show);
  show(store.get());
  appearance.show(storedTheme());
  return dialog(
    "Settings",
    "small",
    units.root,
    appearance.root,
    element("p", { class: "quiet" }, "The page is in English only. Lengths are in metres."),
  );
}

const keys = [
  ["Drag the tool", "the arm reaches by inverse kinematics"],
  ["Drag a link", "turns or slides its joint"],
  ["Drag an obstacle", "moves it, in the section Obstacles"],
  ["Drag beside the arm", "moves or turns the view; the wheel or two fingers magnify"],
  ["Arrow keys in the picture", "move the tool, with Shift in small steps"],
  ["Q, E in the picture", "turn the tool of a planar arm"],
  ["Page Up, Page Down", "raise and lower the tool of a spatial arm"],
  ["0 in the picture", "shows the whole arm"],
  ["Ctrl Z, Ctrl Shift Z", "undo and redo"],
] as const;

const documents = [
  ["the chapter with code", "chapter"],
  ["this page", "howto/page"],
  ["lessons in a course", "howto/course"],
  ["errata of the chapter", "errata"],
  ["what Beeline cannot do", "limitations"],
] as const;

function documentation(): HTMLElement {
  const parts = documents.flatMap(([title, path], i) => [i === 0 ? "" : ", ", documentOf(title, path)]);
  return element("p", { class: "quiet" }, "In the documentation: ", ...parts, ".");
}

/** What can be done by hand and by keys. */
export function helpDialog(): HTMLDialogElement {
  const rows = keys.flatMap(([what, does]) => [element("dt", {}, what), element("dd", {}, does)]);
  return dialog(
    "How it works",
    "small",
    element("dl", { class: "keys" }, ...rows),
    element(
      "p",
      { class: "quiet" },
      "All is computed in this page, by the C++ core of Beeline; nothing is sent anywhere. The lessons follow Dellaert, " +
        "“Serial Link Manipulators”. The page is in English only.",
    ),
    documentation(),
  );
}
