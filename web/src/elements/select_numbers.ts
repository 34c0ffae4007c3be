/** Digits replace a number that is reached by key or by click: a click places its cursor after the focus has come. */
export function selectNumbers(document: Document): void {
  const isNumber = (target: EventTarget | null): target is HTMLInputElement =>
    target instanceof HTMLInputElement && target.type === "number";
  let reached: EventTarget | null = null;
  document.addEventListener("focusin", ({ target }) => {
    reached = target;
    if (isNumber(target)) target.select();
  });
  document.addEventListener("click", ({ target }) => {
    if (target === reached && isNumber(target)) target.select();
    reached = null;
  });
}
