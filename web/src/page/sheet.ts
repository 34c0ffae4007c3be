import { element } from "../elements/element.js";

const far = 24; // pixels of a pull; what moves less is a click

/** The handle of the text on a phone, where it is a sheet below the picture: a click or a pull makes it taller or lower. */
export function sheetHandle(): HTMLElement {
  const handle = element("button", {
    type: "button",
    class: "sheet-handle",
    "aria-label": "Taller text",
    "aria-expanded": "false",
  });
  let from = 0;
  let pulled = 0;
  handle.addEventListener("pointerdown", (event) => {
    from = event.clientY;
    pulled = 0;
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener("pointermove", (event) => (pulled = event.clientY - from));
  handle.addEventListener("click", ({ detail }) => {
    const isPull = detail > 0 && Math.abs(pulled) > far; // a key has no detail
    const tall = isPull ? pulled < 0 : !document.body.classList.contains("tall-sheet");
    document.body.classList.toggle("tall-sheet", tall);
    handle.setAttribute("aria-expanded", String(tall));
  });
  return handle;
}
