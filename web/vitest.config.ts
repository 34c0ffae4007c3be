import { fileURLToPath } from "node:url";
import { defineConfig } from "vitest/config";

// Vitest would leave one of two cores idle.
const maxWorkers = 2;

/** How long a page may take to show what a test waits for, in milliseconds: other programs may run. */
export const patience = 120_000;

export default defineConfig({
  resolve: { alias: { "beeline-documents": fileURLToPath(new URL("../docs", import.meta.url)) } },
  test: {
    testTimeout: 0,
    hookTimeout: 0,
    include: ["tests/**/*.test.ts"],
    maxWorkers,
    isolate: false, // what tests import is loaded once; no test changes it
    // A browser on loaded cores: one repetition, named in the report, where nobody watches.
    retry: process.env.CI ? 1 : 0,
    expect: { poll: { timeout: patience } },
  },
});
