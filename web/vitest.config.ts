import { defineConfig } from "vitest/config";

// Vitest would leave one of two cores idle.
const maxWorkers = 2;

/** How long a page may take to show what a test waits for, in milliseconds: other programs may run. */
export const patience = 120_000;

export default defineConfig({
  test: {
    testTimeout: 0,
    hookTimeout: 0,
    include: ["tests/**/*.test.ts"],
    maxWorkers,
    expect: { poll: { timeout: patience } },
  },
});
