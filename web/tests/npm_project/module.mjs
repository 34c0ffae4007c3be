import { load } from "beeline-arms";
import { compute } from "./compute.js";

console.log(JSON.stringify(await compute(load)));
