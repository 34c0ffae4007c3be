import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { arms } from "./arms_plugin.js";
import { lessons } from "./lesson_plugin.js";
import { opening } from "./opening_plugin.js";
import { preload } from "./preload_plugin.js";
import { savedPage } from "./saved_page_plugin.js";

const at = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/** BEELINE_MODULE: the folder of core.wasm, beeline.wasm and their scripts; default: where `make web` makes them. */
const module = process.env["BEELINE_MODULE"] ?? at("../build-web-core/web");

/** Where the errata stand. */
const documents = at("../docs");

const parts = { "core-module": "core", "command-module": "beeline", worker: "command_worker" };

const checks = { bundlerTimings: false }; // on a busy machine: how long plugins take tells a user nothing

/** `vite build` builds the page; `vite build --mode saved`, after it, the document that a saved page is made of. */
export default defineConfig(({ mode }) => ({
  base: "./",
  plugins: [lessons(), arms(module), opening(module), mode === "saved" ? savedPage(parts) : preload("core", ".wasm")],
  resolve: { alias: { "beeline-module": module, "beeline-documents": documents } },
  build: {
    outDir: at("../build/web"),
    emptyOutDir: mode !== "saved",
    target: "es2022",
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: mode === "saved" ? 4000 : 800,
    rolldownOptions: { checks, ...(mode === "saved" ? { output: { codeSplitting: false } } : {}) },
  },
  worker: { format: "es", rolldownOptions: { checks } },
  server: { fs: { allow: [at("."), module, documents] } },
}));
