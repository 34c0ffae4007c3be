import { element } from "../elements/element.js";

const far = 24; // pixels of a pull; what moves less is a click

/** The handle of the text on a phone, where it is a sheet below the picture: a click or a pull makes it taller or lower. */
function sheetHandle(): HTMLElement {
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

/** The upper edge of the sheet: its handle, and a button that leads from the text to the sliders below it and back. */
export function sheetBar(): HTMLElement {
  const button = element("button", { type: "button", class: "sheet-jump" }, "Sliders");
  const bar = element("div", { class: "sheet-bar" }, sheetHandle(), button);
  let text = 0; // where the text was read
  const arms = (): Element | null => document.querySelector(".arm-panel");
  const isAtSliders = (sheet: Element): boolean => {
    const { top, height } = sheet.getBoundingClientRect();
    return (arms()?.getBoundingClientRect().top ?? Infinity) < top + height / 2;
  };
  const name = (): void => {
    const sheet = bar.closest("#side");
    if (sheet) button.textContent = isAtSliders(sheet) ? "Text" : "Sliders";
  };
  button.addEventListener("click", () => {
    const sheet = bar.closest("#side");
    if (!sheet) return;
    if (isAtSliders(sheet)) return sheet.scrollTo({ top: text });
    text = sheet.scrollTop;
    const down = (arms()?.getBoundingClientRect().top ?? 0) - sheet.getBoundingClientRect().top - bar.offsetHeight;
    sheet.scrollBy({ top: down });
  });
  document.getElementById("side")?.addEventListener("scroll", name, { passive: true });
  return bar;
}
