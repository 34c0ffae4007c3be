import { load } from "beeline-arms";
import { compute } from "./compute.js";

compute(load).then(
  (found) => (document.body.textContent = JSON.stringify(found)),
  (error) => (document.body.textContent = JSON.stringify({ error: String(error) })),
);
