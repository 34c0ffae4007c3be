import { element } from "../panels/element.js";
import { saveFile } from "../share/save_file.js";
import type { Services } from "./section.js";

/** A button that saves what `beeline draw` draws of the arm as it stands: for planar arms. */
export function svgButton(services: Services, refuse: (reason: string) => void): HTMLButtonElement {
  const save = async (): Promise<void> => {
    const { q, showFrames } = services.store.get();
    if (!q) return;
    const options = showFrames ? ["--frames"] : [];
    const { code, stderr, files } = await services.command([
      "draw",
      "arm.json",
      `--q=${q.join(",")}`,
      "--out=arm.svg",
      ...options,
    ]);
    const drawing = files["arm.svg"];
    if (code !== 0 || drawing === undefined) throw new Error(stderr.trim());
    saveFile("arm.svg", new Blob([drawing], { type: "image/svg+xml" }));
  };
  const clicked = (): void => void save().catch((error: unknown) => refuse((error as Error).message));
  return element("button", { type: "button", hidden: true, onclick: clicked }, "Save SVG");
}
