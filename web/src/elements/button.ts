import { element } from "./element.js";
import { icon, type IconName } from "./icons.js";

/** A button with an icon and a word; `title` says more when it is pointed at. */
export function iconButton(name: IconName, word: string, title: string, onclick: () => void): HTMLButtonElement {
  return element(
    "button",
    { type: "button", class: "icon-button", title, onclick },
    icon(name),
    element("span", {}, word),
  );
}
