/** Why an answer is no: `code` and `fields` as docs/statuses.md lists them, `reason` the sentence that is made from them. */
export interface Reasoned {
  reason: string;
  code: string | null;
  fields: Record<string, unknown>;
}

/** What `beeline ik --json` prints. */
export interface IkAnswer extends Reasoned {
  /** solved, unreachable, outside_limits, ...: docs/statuses.md. */
  status: string;
  /** Joint values, nearest to the seed first. */
  solutions: number[][];
  /** Of the first solution, m or rad. */
  residual: number | null;
  /** Whether every solution is in the list. */
  complete: boolean;
  /** How they were found. */
  method: string;
  [more: string]: unknown;
}

/** What `beeline line --json` prints. */
export interface LineAnswer extends Reasoned {
  /** reached if the whole path is. */
  status: string;
  /** Proved bound of the tool's distance from the path, m, between the samples too. */
  deviation_bound: number | null;
  samples: number;
  /** s; null if the path is not reached. */
  duration: number | null;
  [more: string]: unknown;
}
