import "uplot/dist/uPlot.min.css";
import { Page } from "./page/page.js";

const first = document.getElementById("first") as HTMLElement;

Page.open(document).then(
  () => first.remove(),
  (error: unknown) => {
    first.setAttribute("role", "alert");
    first.textContent = error instanceof Error ? error.message : String(error);
  },
);
