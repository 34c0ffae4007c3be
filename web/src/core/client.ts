import type { Request, WorkerReply, WorkerStart } from "./protocol.js";
import type { ReachAnswers, ReachTask } from "./reach.js";
import type { SceneAnswers, SceneTask } from "./scene.js";
import { Cancelled, CoreError, type CommandResult, type InputFiles } from "./types.js";

type Progress = (fraction: number) => void;

interface Waiting {
  resolve(result: unknown): void;
  reject(error: Error): void;
  progress: Progress;
}

/** Runs commands and computes maps in a worker. cancel() ends the worker with all that it computes; the next command starts another. */
export class CoreWorker {
  private worker: Promise<Worker> | null = null;
  private module: Promise<WebAssembly.Module> | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private next = 0;

  /** `start` makes a worker that calls serve(), `compile` the module of the command; once, when it is first needed. */
  constructor(
    private readonly start: () => Promise<Worker>,
    private readonly compile: () => Promise<WebAssembly.Module>,
  ) {}

  command(args: string[], files: InputFiles = {}, progress?: Progress): Promise<CommandResult> {
    return this.ask({ id: this.next++, args, files }, progress);
  }

  /** Starts the worker, so that the first command does not wait for it. */
  prepare(): void {
    this.worker ??= this.started();
    this.worker.catch(() => undefined); // the first command says why
  }

  /** Answers a question about a map of what an arm can do. */
  reach<T extends ReachTask>(task: T, progress?: Progress): Promise<ReachAnswers[T["ask"]]> {
    return this.ask({ id: this.next++, reach: task }, progress);
  }

  /** Answers a question about an arm among obstacles. */
  scene<T extends SceneTask>(task: T): Promise<SceneAnswers[T["ask"]]> {
    return this.ask({ id: this.next++, scene: task }, undefined);
  }

  /** Without a command under way the worker lives on. */
  cancel(reason: CoreError = new Cancelled("cancelled")): void {
    if (this.waiting.size === 0) return;
    void this.worker?.then(
      (worker) => worker.terminate(),
      () => undefined,
    );
    this.worker = null;
    for (const { reject } of this.waiting.values()) reject(reason);
    this.waiting.clear();
  }

  private ask<T>(request: Request, progress: Progress = () => undefined): Promise<T> {
    this.worker ??= this.started();
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(request.id, { resolve: resolve as (result: unknown) => void, reject, progress });
      this.worker?.then(
        (worker) => worker.postMessage(request),
        (error: Error) => this.cancel(new CoreError(error.message)),
      );
    });
  }

  private async started(): Promise<Worker> {
    this.module ??= this.compile();
    const module = await this.module.catch((error: unknown) => {
      this.module = null; // the next command tries again
      throw error;
    });
    const worker = await this.start();
    const begin: WorkerStart = { module };
    worker.postMessage(begin);
    worker.onmessage = (event: MessageEvent<WorkerReply>) => this.receive(event.data);
    worker.onerror = (event) =>
      this.cancel(new CoreError(`the core ended: ${event.message || "its worker cannot be loaded"}`));
    return worker;
  }

  private receive(reply: WorkerReply): void {
    const waiting = this.waiting.get(reply.id);
    if (waiting === undefined) return;
    if ("progress" in reply) return waiting.progress(reply.progress);
    this.waiting.delete(reply.id);
    if ("error" in reply) waiting.reject(new CoreError(reply.error));
    else waiting.resolve(reply.result);
  }
}
