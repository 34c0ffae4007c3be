import { element } from "../elements/element.js";
import type { Services } from "./section.js";

/** A drawing that a command makes, as an image; `args` without --out. Throws where the command refuses. */
export async function drawingOf(services: Services, args: string[], alt: string): Promise<HTMLImageElement> {
  const { files, refusal } = await services.command([...args, "--out=drawing.svg"]);
  const drawing = files["drawing.svg"];
  if (drawing === undefined) throw new Error(refusal);
  const source = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(drawing)}`;
  const image = element("img", { src: source, alt });
  await image.decode();
  return image;
}

/** A figure of the chapter as `beeline figure` draws it, once it is opened. */
export function printedFigure(services: Services, name: string): HTMLElement {
  const holder = element("div", { role: "status" });
  const root = element(
    "details",
    { class: "printed" },
    element("summary", {}, "As a drawing, like the chapter’s"),
    holder,
  );
  const draw = async (): Promise<void> => {
    try {
      holder.replaceChildren(await drawingOf(services, ["figure", name], `Figure ${name}`));
    } catch (error) {
      holder.textContent = (error as Error).message;
    }
  };
  root.addEventListener("toggle", () => root.open && holder.childElementCount === 0 && void draw());
  return root;
}
