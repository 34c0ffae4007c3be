/** What `beeline view` was started with. */
export interface Session {
  /** The arm as JSON. */
  arm: string;
  /** A trajectory as CSV. */
  trajectory: string | null;
  /** The section that the page begins with. */
  section?: string | null;
  /** The obstacles around the arm, as JSON. */
  scene?: string | null;
  /** The clearance that the arm must keep, m; null: the page's. */
  clearance?: number | null;
}

/** The session of the server that the page comes from; null where that is no `beeline view`, which marks the page. */
export async function sessionOf(document: Document): Promise<Session | null> {
  const { session } = document.body.dataset;
  if (session === undefined) return null;
  const answer = await fetch(session);
  if (!answer.ok) throw new Error(`The arm cannot be loaded: ${answer.status} for ${answer.url}`);
  return (await answer.json()) as Session;
}

const shortestDelay = 1; // s, doubled after each refusal
const longestDelay = 16;

/** Why the browser gave up on the stream of joint values. EventSource does not say it, so this asks once more. */
async function refusal(): Promise<string> {
  const abort = new AbortController();
  try {
    const { ok, status } = await fetch("api/events", { signal: abort.signal });
    return ok ? "the stream ended" : `the server answers ${status}`;
  } catch {
    return "the server does not answer";
  } finally {
    abort.abort(); // the answer may be a stream without end
  }
}

const silence = 3000; // milliseconds without joint values: the program has stopped

/** Calls `moved` with the joint values that a program posts, and `says` with "live" while it posts them, with what is
 * wrong with the connection, or with nothing. After a lost connection the browser connects again by itself; after an
 * answer other than 200, such as a proxy gives during a restart, it gives up for ever, and this tries again after a
 * delay. */
export function follow(moved: (q: number[]) => void, says: (text: string) => void): () => void {
  let events: EventSource;
  let timer = 0;
  let delay = shortestDelay;
  let ended = false;
  let quiet = 0;
  const retry = async (): Promise<void> => {
    const seconds = delay;
    delay = Math.min(2 * delay, longestDelay);
    timer = window.setTimeout(connect, 1000 * seconds);
    const reason = await refusal();
    if (!ended && events.readyState === EventSource.CLOSED) says(`${reason}, next try in ${seconds} s`);
  };
  const connect = (): void => {
    events = new EventSource("api/events");
    events.addEventListener("joints", (event: MessageEvent<string>) => {
      const { q } = JSON.parse(event.data) as { q: number[] };
      moved(q);
      says("live");
      clearTimeout(quiet);
      quiet = window.setTimeout(() => says(""), silence);
    });
    events.addEventListener("open", () => {
      delay = shortestDelay;
      says("");
    });
    events.addEventListener("error", () => {
      clearTimeout(quiet);
      if (events.readyState === EventSource.CLOSED) void retry();
      else says("connecting again");
    });
  };
  connect();
  return () => {
    ended = true;
    clearTimeout(timer);
    clearTimeout(quiet);
    events.close();
  };
}
