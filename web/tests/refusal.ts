import { expect } from "vitest";

/** A promise's or a function's error as code and message. */
export async function refusal(work: () => unknown): Promise<string> {
  try {
    await work();
  } catch (error) {
    expect(error).toBeInstanceOf(Error);
    const { code, message } = error as Error & { code: string };
    return `${code}: ${message}`;
  }
  return "no error";
}
