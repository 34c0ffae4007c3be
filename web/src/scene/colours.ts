/** The colour of a joint as everywhere it is shown, 1 red, 2 green, 3 blue, then five others that people with colour
 * blindness tell apart: a CSS colour. `k` counts from 0. */
export function jointColour(k: number): string {
  return `var(--joint-${(k % 8) + 1})`;
}

/** The value of a CSS variable of the page, or of var(--name), for canvases: rgb(r, g, b). */
export function resolved(name: string): string {
  const variable = /--[\w-]+/.exec(name)?.[0];
  if (variable === undefined) return name;
  const probe = document.createElement("i");
  probe.style.color = `var(${variable})`;
  probe.hidden = true;
  document.body.append(probe);
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}

/** Calls `changed` whenever light turns into dark, by the system or by the page's setting; returns what ends that. */
export function onTheme(changed: () => void): () => void {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const observer = new MutationObserver(changed);
  system.addEventListener("change", changed);
  observer.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  return () => {
    system.removeEventListener("change", changed);
    observer.disconnect();
  };
}
