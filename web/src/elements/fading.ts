const widest = 24; // pixels

/** Fades the edges of an element behind which its content goes on; a class `fading` draws that. */
export function fading<E extends HTMLElement | MathMLElement>(box: E): E {
  const show = (): void => {
    const wide = (hidden: number): string => `${Math.min(widest, Math.max(0, hidden))}px`;
    box.style.setProperty("--left", wide(box.scrollLeft));
    box.style.setProperty("--right", wide(box.scrollWidth - box.clientWidth - box.scrollLeft));
  };
  box.classList.add("fading");
  box.addEventListener("scroll", show);
  new ResizeObserver(show).observe(box);
  // With the next picture: measured at once, what is being built would be laid out twice.
  new MutationObserver(() => requestAnimationFrame(show)).observe(box, { childList: true });
  return box;
}
