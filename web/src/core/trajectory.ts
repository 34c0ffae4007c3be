import { checked, readText, withTexts, type CoreModule } from "./module.js";
import { CoreError } from "./types.js";
import { inWords } from "./words.js";

export type Quantity = "position" | "velocity" | "acceleration";
export const quantities: Quantity[] = ["position", "velocity", "acceleration"];

function checkIndex(what: string, index: number, count: number): void {
  if (Number.isInteger(index) && index >= 0 && index < count) return;
  throw new CoreError(`the ${what} is ${inWords(index)}; it must be a whole number from 0 to ${count - 1}`);
}

/** A trajectory in the core's memory, of one arm. Release it when it is not needed any more. */
export class Trajectory {
  readonly size: number;
  /** Seconds, increasing. */
  readonly times: Float64Array;
  /** Position, and what the file has besides. */
  readonly quantities: Quantity[];
  private readonly handle: number;
  private released = false;
  private readonly values: Float64Array;
  private readonly stride: number;

  /** From the text of a file, .csv or .json by its name. Throws CoreError with the core's message. */
  constructor(
    private readonly module: CoreModule,
    arm: number,
    private readonly dof: number,
    name: string,
    text: string,
  ) {
    const handle = withTexts(module, [name, text], (first = 0, second = 0) =>
      module._beeline_trajectory(arm, first, second),
    );
    this.handle = checked(module, handle, "invalid_trajectory");
    try {
      this.size = checked(module, module._beeline_trajectory_size(this.handle));
      this.quantities = quantities.slice(0, checked(module, module._beeline_trajectory_columns(this.handle)));
      this.stride = 1 + dof * this.quantities.length;
      this.values = this.numbers(this.size * this.stride, (buffer) =>
        module._beeline_trajectory_values(this.handle, buffer),
      );
    } catch (error) {
      module._beeline_trajectory_release(this.handle);
      throw error;
    }
    this.times = Float64Array.from({ length: this.size }, (_, i) => this.values[i * this.stride] as number);
  }

  /** The joint values of a sample. */
  row(index: number): number[] {
    checkIndex("sample", index, this.size);
    const begin = index * this.stride + 1;
    return Array.from(this.values.subarray(begin, begin + this.dof));
  }

  /** The joint values of all samples. */
  rows(): number[][] {
    return Array.from({ length: this.size }, (_, i) => this.row(i));
  }

  /** A quantity of a joint at all samples. */
  column(quantity: Quantity, joint: number): Float64Array {
    const place = this.quantities.indexOf(quantity);
    if (place < 0) {
      throw new CoreError(`the quantity is ${inWords(quantity)}; the trajectory has ${this.quantities.join(", ")}`);
    }
    checkIndex("joint", joint, this.dof);
    const offset = 1 + this.dof * place + joint;
    return Float64Array.from({ length: this.size }, (_, i) => this.values[i * this.stride + offset] as number);
  }

  /** The joint values at a time of the motion that the columns mean: polynomials between the samples. */
  at(time: number): number[] {
    this.check();
    return Array.from(
      this.numbers(this.dof, (buffer) => this.module._beeline_trajectory_sample(this.handle, time, buffer)),
    );
  }

  /** The content of a file with this name, .csv or .json. */
  text(name: string): string {
    this.check();
    const content = withTexts(this.module, [name], (pointer = 0) =>
      this.module._beeline_trajectory_text(this.handle, pointer),
    );
    checked(this.module, content === 0 ? -1 : 0);
    return readText(this.module, content);
  }

  /** Afterwards it has its samples only. A second time does nothing. */
  release(): void {
    if (this.released) return;
    this.released = true;
    checked(this.module, this.module._beeline_trajectory_release(this.handle));
  }

  private check(): void {
    if (this.released) throw new CoreError("the trajectory was released", "released");
  }

  private numbers(count: number, write: (buffer: number) => number): Float64Array {
    const buffer = this.module._beeline_allocate(count);
    if (buffer === 0) throw new CoreError(`the core has no memory for ${count} numbers`, "no_memory");
    try {
      checked(this.module, write(buffer));
      return this.module.HEAPF64.slice(buffer / 8, buffer / 8 + count);
    } finally {
      this.module._beeline_release(buffer);
    }
  }
}
