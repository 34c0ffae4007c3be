import type { Core } from "../core/core.js";
import type { ArmChooser } from "../panels/arm_chooser.js";
import { tooLarge } from "../panels/arm_chooser.js";
import type { MeshList } from "../panels/mesh_list.js";
import { TipChooser, tipsOf } from "../panels/tip_chooser.js";
import { baseName, isMeshFile, visualMeshes, type PathFile } from "../scene/mesh_files.js";
import type { PageState } from "../state/page_state.js";
import type { Store } from "../state/store.js";
import type { Shown } from "./section.js";

/** A URDF that was opened, with the meshes that came with it and after it. */
interface OpenedUrdf {
  json: string;
  text: string;
  files: PathFile[];
}

/** Arms from files that were dropped or chosen, and the meshes of a URDF. */
export class ArmFiles {
  private urdf: OpenedUrdf | null = null;
  private shown: Shown | null = null;
  private reading = 0;
  private readonly tips = new TipChooser((tip) => this.again(tip));
  private again: (tip: string) => void = () => undefined;

  constructor(
    private readonly core: Core,
    private readonly store: Store<PageState>,
    private readonly chooser: ArmChooser,
    private readonly list: MeshList,
  ) {
    chooser.root.append(this.tips.root);
  }

  /** Takes an arm's file, with the meshes of a URDF; or more meshes of the URDF that is shown. Says why a file cannot be
   * read. */
  open(files: PathFile[]): void {
    this.openAll(files).catch((error: unknown) =>
      this.chooser.refuse(`A file cannot be read: ${(error as Error).message}`),
    );
  }

  private async openAll(files: PathFile[]): Promise<void> {
    const meshes = files.filter(({ path }) => isMeshFile(path));
    const usable = meshes.filter(({ file }) => tooLarge(file) === null);
    const arms = armFiles(files, meshes.length > 0);
    const [arm, ...others] = arms;
    if (arm) await this.openArm(arm, usable);
    else await this.addMeshes(usable);
    const large = meshes.find(({ file }) => tooLarge(file) !== null);
    if (arm && others.length > 0)
      this.chooser.refuse(`${baseName(arm.path)} is shown, of several: ${names(others)} too`);
    else if (large) this.chooser.refuse(tooLarge(large.file) ?? "");
  }

  /** The page shows another arm: with its meshes, if it is the arm of the URDF. */
  take(shown: Shown): void {
    this.shown = shown;
    ++this.reading;
    this.list.clear();
    if (this.urdf?.json === shown.arm.json) void this.showMeshes();
    else this.tips.ask([]);
  }

  /** Shows the arm of a text: JSON, or a URDF with its meshes whose chain ends at `tip`. Where the chain cannot end
   * without a choice, it is asked for. */
  openText(name: string, text: string, meshes: PathFile[] = [], tip = ""): void {
    const isUrdf = /\.urdf$/i.test(name);
    if (tip === "") this.tips.ask([]);
    try {
      const arm = this.core.arm(name, { [name]: text }, { tip });
      const { json } = arm;
      arm.release();
      this.urdf = isUrdf ? { json, text, files: meshes } : null;
      this.store.set({ arm: { json }, q: null, goal: null });
    } catch (error) {
      this.chooser.refuse((error as Error).message);
      if (!isUrdf || tip !== "") return;
      this.tips.ask(tipsOf(text));
      this.again = (chosen) => this.openText(name, text, meshes, chosen);
    }
  }

  private async openArm({ path, file }: PathFile, meshes: PathFile[]): Promise<void> {
    const refusal = tooLarge(file);
    if (refusal !== null) return this.chooser.refuse(refusal);
    const reading = ++this.reading; // of two files the later is shown
    const text = await file.text();
    if (reading === this.reading) this.openText(baseName(path), text, meshes);
  }

  private async addMeshes(meshes: PathFile[]): Promise<void> {
    if (!this.urdf || this.urdf.json !== this.shown?.arm.json)
      return this.chooser.refuse("Meshes belong to a URDF file: drop it with them, or before them.");
    this.urdf.files.push(...meshes);
    await this.showMeshes();
  }

  private async showMeshes(): Promise<void> {
    const { urdf, shown } = this;
    const reading = ++this.reading; // of several answers the last one's is shown
    if (!urdf || !shown) return;
    const wanted = visualMeshes(urdf.text);
    if (wanted.length === 0) return;
    if (urdf.files.length === 0)
      return this.list.say(
        `Drawn without meshes. ${missing(wanted.map(baseName))} Drop them too, all at once or a folder.`,
      );
    try {
      const { RobotMeshes } = await import("../scene/robot_meshes.js");
      const { joints } = JSON.parse(shown.arm.json) as { joints: { link?: string }[] };
      const meshes = await RobotMeshes.read(urdf.text, ["", ...joints.map(({ link = "" }) => link)], urdf.files);
      if (reading !== this.reading) return void meshes.dispose();
      shown.view.showMeshes(meshes, () => this.list.moved());
      const count = meshes.meshes.length;
      this.list.say(
        [`${count} ${count === 1 ? "mesh" : "meshes"}.`, missing(meshes.missing), ...meshes.faults].join(" ").trim(),
      );
      this.list.show(meshes.meshes);
    } catch (error) {
      if (reading === this.reading) this.list.say(`The meshes cannot be shown: ${(error as Error).message}`);
    }
  }
}

/** The files that are arms: URDF before JSON; beside meshes no others, else the first whatever it is. */
function armFiles(files: PathFile[], besideMeshes: boolean): PathFile[] {
  for (const ending of [/\.urdf$/i, /\.json$/i]) {
    const found = files.filter(({ path }) => ending.test(path));
    if (found.length > 0) return found;
  }
  return besideMeshes ? [] : files.slice(0, 1);
}

function names(files: PathFile[]): string {
  return files.map(({ path }) => baseName(path)).join(", ");
}

/** Which meshes are missing, a few by name. */
function missing(files: string[]): string {
  if (files.length === 0) return "";
  const few = 5;
  const more = files.length > few ? ` and ${files.length - few} more` : "";
  return `Missing: ${files.slice(0, few).join(", ")}${more}.`;
}
