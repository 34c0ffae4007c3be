/** A text without blanks and the signs `before` at its begin, and without blanks and the signs `behind` at its end. It takes
 * time in proportion to the length, which a regular expression for the end does not. */
export function trimmed(text: string, before: string, behind: string): string {
  const isOf = (signs: string, at: number): boolean => /\s/.test(text[at] ?? "") || signs.includes(text[at] ?? " ");
  let [from, to] = [0, text.length];
  while (from < to && isOf(before, from)) ++from;
  while (to > from && isOf(behind, to - 1)) --to;
  return text.slice(from, to);
}
