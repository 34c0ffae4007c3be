import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { lessons } from "./lesson_plugin.js";

const at = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/** BEELINE_MODULE: the folder of core.wasm, beeline.wasm and their scripts; default: where `make web` makes them. */
const module = process.env["BEELINE_MODULE"] ?? at("../build-web-core/web");

export default defineConfig({
  base: "./",
  plugins: [lessons()],
  resolve: { alias: { "beeline-module": module } },
  build: {
    outDir: at("../build/web"),
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 800,
  },
  worker: { format: "es" },
  server: { fs: { allow: [at("."), module] } },
});
