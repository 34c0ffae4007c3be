import { element } from "./element.js";
import { icon } from "./icons.js";

/** A dialog with a title, which Escape, its cross, or a click beside it closes. */
export function dialog(title: string, className: string, ...content: HTMLElement[]): HTMLDialogElement {
  const close = element(
    "button",
    { type: "button", class: "icon-button plain", "aria-label": "Close", title: "Close" },
    icon("close"),
  );
  const heading = element("h2", {}, title);
  const made = element(
    "dialog",
    { class: className, "aria-label": title },
    element("div", { class: "dialog-head" }, heading, close),
    element("div", { class: "dialog-body" }, ...content),
  );
  close.addEventListener("click", () => made.close());
  made.addEventListener("click", (event) => {
    if (event.target === made) made.close(); // the backdrop
  });
  return made;
}
