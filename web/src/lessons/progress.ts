const key = "beeline-lessons";

/** The lessons that are ticked, kept in this browser; none where it keeps nothing. */
export function doneLessons(): Set<string> {
  try {
    const list: unknown = JSON.parse(localStorage.getItem(key) ?? "[]");
    return new Set(Array.isArray(list) ? list.filter((id): id is string => typeof id === "string") : []);
  } catch {
    return new Set();
  }
}

/** Ticks a lesson, or takes its tick away. */
export function setDone(id: string, done: boolean): void {
  const all = doneLessons();
  if (done) all.add(id);
  else all.delete(id);
  try {
    localStorage.setItem(key, JSON.stringify([...all]));
  } catch {
    // A page opened from a file, or a browser that keeps nothing: the tick lasts as long as the lesson is shown.
  }
}
