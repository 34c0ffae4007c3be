import { defineConfig } from "vitest/config";

// Vitest would leave one of two cores idle.
const maxWorkers = 2;

export default defineConfig({
  test: { testTimeout: 0, hookTimeout: 0, include: ["tests/**/*.test.ts"], maxWorkers },
});
