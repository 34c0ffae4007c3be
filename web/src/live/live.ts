/** What `beeline view` was started with. */
export interface Session {
  /** The arm as JSON. */
  arm: string;
  /** A trajectory as CSV. */
  trajectory: string | null;
}

/** The session of the server that the page comes from; null where that is no `beeline view`, which marks the page. */
export async function sessionOf(document: Document): Promise<Session | null> {
  const { session } = document.body.dataset;
  if (session === undefined) return null;
  const answer = await fetch(session);
  return answer.ok ? ((await answer.json()) as Session) : null;
}

/** Calls `moved` with the joint values that a program posts, and `connected` when the server comes and goes. The
 * browser connects again by itself. */
export function follow(moved: (q: number[]) => void, connected: (now: boolean) => void): () => void {
  const events = new EventSource("api/events");
  events.addEventListener("joints", (event: MessageEvent<string>) => {
    const { q } = JSON.parse(event.data) as { q: number[] };
    moved(q);
  });
  events.addEventListener("open", () => connected(true));
  events.addEventListener("error", () => connected(false));
  return () => events.close();
}
