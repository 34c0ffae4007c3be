const longest = 60; // characters of a text in a message

/** A value in a message: a text in quotation marks, cut where it is long; of an object that it is one. */
export function inWords(value: unknown): string {
  if (typeof value === "string") return JSON.stringify(value.length > longest ? `${value.slice(0, longest)}…` : value);
  if (Array.isArray(value)) return "a list";
  return typeof value === "function" || (typeof value === "object" && value !== null) ? "an object" : String(value);
}
