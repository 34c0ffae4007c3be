import { tooLarge } from "../core/limits.js";
import {
  freeName,
  movedBody,
  poseOfBody,
  renamed,
  roundedPose,
  textOf,
  withoutBody,
  type SceneBody,
  type SceneDocument,
  type SceneShape,
} from "../core/scene.js";
import { element } from "../elements/element.js";
import { distance } from "../elements/units.js";
import { ObstacleForm, type Changed } from "../panels/obstacle_form.js";
import { ObstacleList } from "../panels/obstacle_list.js";
import { saveFile } from "../share/save_file.js";
import type { PageState } from "../state/page_state.js";
import { AroundMove } from "./around.js";
import { sceneFile, type NamedPair, type SceneModel } from "./scene_model.js";
import type { PageSection, Services, Shown } from "./section.js";

/** New obstacles; sizes as fractions of the reach. */
const kinds: { kind: string; shape(unit: number): SceneShape }[] = [
  { kind: "box", shape: (unit) => ({ box: { size: [unit, unit, unit] } }) },
  { kind: "sphere", shape: (unit) => ({ sphere: { radius: unit / 2 } }) },
  { kind: "cylinder", shape: (unit) => ({ cylinder: { radius: unit / 3, length: 2 * unit } }) },
];
const newSize = 0.2; // of the reach
const newMargin = 0.05; // of the reach, between the arm and a new obstacle
const places = 12; // around the arm that are tried

/** Obstacles around a spatial arm: read from a file, added, dragged, and the pair that is nearest to its clearance. */
export class Obstacles implements PageSection {
  readonly root = element("div", { class: "panel" });
  private readonly message = element("p", { role: "alert", class: "refusal" });
  private readonly pairs = element("div", { role: "group", class: "nearest", "aria-label": "Nearest bodies" });
  private readonly about = element("p", { class: "quiet" });
  /** Which pairs of the scene are left out. */
  private readonly left = element("p", { class: "quiet" });
  private readonly body = element("div");
  private readonly list: ObstacleList;
  private readonly form: ObstacleForm;
  private readonly clearance = element("input", { type: "number", id: "clearance", step: 0.001, min: 0 });
  private readonly shapes = element("input", { type: "checkbox", id: "link-shapes" });
  private readonly passes = element("input", { type: "checkbox", id: "passes" });
  private readonly around: AroundMove;
  private readonly save: HTMLButtonElement;
  private readonly clear: HTMLButtonElement;
  private shown: Shown | null = null;
  private open = false;
  private selected: string | null = null;
  private reading = 0;
  private adding = false;
  private fault = "";

  constructor(
    private readonly services: Services,
    private readonly model: SceneModel,
  ) {
    const { store } = services;
    this.list = new ObstacleList({
      select: (index) => this.select(this.obstacles[index]?.name ?? null),
      hide: (name) => this.hide(name),
      remove: (name) => this.remove(name),
    });
    this.form = new ObstacleForm(
      (name) => this.rename(name),
      (change) => this.change(change),
    );
    this.clearance.addEventListener("change", () => this.setClearance());
    this.around = new AroundMove(services);
    this.passes.addEventListener("change", () => store.set({ passes: this.passes.checked }));
    this.shapes.addEventListener("change", () => store.set({ showShapes: this.shapes.checked }));
    this.save = element("button", { type: "button", onclick: () => this.saveScene() }, `Save ${sceneFile}`);
    this.clear = element("button", { type: "button", onclick: () => this.removeAll() }, "Remove all");
    model.subscribe(() => {
      if (this.open) this.write();
    });
    this.build();
  }

  private build(): void {
    const adders = kinds.map(({ kind, shape }) =>
      element("button", { type: "button", onclick: () => void this.add(kind, shape) }, `Add ${kind}`),
    );
    const load = element("input", {
      type: "file",
      id: "scene-file",
      accept: ".json,.scene,.yaml,.yml,.urdf",
    });
    load.addEventListener("change", () => {
      const file = load.files?.[0];
      if (file) void this.readFile(file);
      load.value = "";
    });
    this.body.append(
      element("p", { class: "pair" }, ...adders),
      this.pairs,
      element("p", {}, element("label", { class: "check" }, this.passes, " Let the arm pass through obstacles")),
      this.around.root,
      this.list.root,
      this.form.root,
      this.left,
      element(
        "p",
        { class: "pair settings" },
        element("label", { for: "clearance" }, "Clearance"),
        this.clearance,
        element("span", { class: "unit" }, "m"),
        element("label", { class: "check" }, this.shapes, " Link shapes"),
      ),
      element("p", {}, element("label", { for: "scene-file" }, "A scene: JSON, or of MoveIt (.scene, .yaml)"), load),
      element("p", { class: "pair" }, this.save, this.clear),
    );
    this.root.append(element("h2", {}, "Obstacles"), this.about, this.message, this.body);
  }

  take(shown: Shown): void {
    this.shown = shown;
    this.open = false;
    this.message.textContent = "";
    this.around.take(shown);
  }

  update(_: number[], changed: ReadonlySet<keyof PageState>): void {
    this.open = true;
    this.around.update(changed);
    if (changed.size === 1 && changed.has("q")) return; // the model writes what follows
    this.write();
    this.draw();
  }

  leave(): void {
    this.open = false;
    this.around.leave();
  }

  interrupt(): void {
    this.around.pause();
  }

  waypoint(_: number, pose: number[], released: boolean): void {
    this.around.goalAt(pose, released);
  }

  dropped(q: number[]): void {
    this.around.goTo(q);
  }

  obstacle(index: number, pose: number[] | null): void {
    const body = this.obstacles[index];
    if (!body) return;
    this.select(body.name);
    if (pose) this.replace(index, movedBody(body, roundedPose(pose)));
  }

  /** Reads a file that was chosen or dropped, as --scene does. */
  async readFile(file: File): Promise<void> {
    const reading = ++this.reading;
    this.services.store.set({ section: "obstacles" });
    if (this.shown?.arm.planar !== false) return; // the section says why
    const refusal = tooLarge(file);
    try {
      if (refusal !== null) throw new Error(refusal);
      const text = await this.model.read(file.name, await file.text());
      if (reading !== this.reading) return;
      this.selected = null;
      this.model.hidden.clear();
      this.message.textContent = "";
      this.services.store.set({ scene: text });
    } catch (error) {
      if (reading === this.reading) this.message.textContent = (error as Error).message;
    }
  }

  private get obstacles(): SceneBody[] {
    return this.model.scene.obstacles;
  }

  private get index(): number | null {
    const index = this.obstacles.findIndex(({ name }) => name === this.selected);
    return index < 0 ? null : index;
  }

  private put(scene: SceneDocument): void {
    this.message.textContent = "";
    this.services.store.set({ scene: textOf(scene) });
  }

  private replace(index: number, body: SceneBody): void {
    this.put({ ...this.model.scene, obstacles: this.obstacles.with(index, body) });
  }

  private select(name: string | null): void {
    if (name === this.selected) return;
    this.selected = name;
    this.write();
    this.draw();
  }

  private hide(name: string): void {
    const { hidden } = this.model;
    if (!hidden.delete(name)) hidden.add(name);
    this.model.draw();
    this.write();
  }

  private remove(name: string): void {
    this.model.hidden.delete(name);
    this.put(withoutBody(this.model.scene, name));
  }

  private removeAll(): void {
    this.model.hidden.clear();
    this.put({ obstacles: [] });
  }

  private rename(name: string): void {
    const { selected } = this;
    if (selected === null || name === selected) return;
    const taken = [...(this.model.arm?.bodies ?? []), ...this.obstacles].some((body) => body.name === name);
    if (taken || name === "") {
      this.message.textContent = name === "" ? "An obstacle needs a name." : `Another body has the name ${name}.`;
      return this.write();
    }
    this.selected = name;
    if (this.model.hidden.delete(selected)) this.model.hidden.add(name);
    this.put(renamed(this.model.scene, selected, name));
  }

  private change(change: Changed): void {
    const { index } = this;
    const body = index === null ? undefined : this.obstacles[index];
    if (index === null || !body) return;
    if ("pose" in change) this.replace(index, movedBody(body, change.pose));
    else this.replace(index, { ...body, shapes: [change.shape] });
  }

  /** Adds an obstacle where it keeps away from the arm; one after another. */
  private async add(kind: string, shape: (unit: number) => SceneShape): Promise<void> {
    const { shown, model } = this;
    if (!shown || this.adding) return;
    this.adding = true;
    try {
      await model.ready();
      const of = shape(Number((newSize * shown.picture.size).toPrecision(1)));
      const xyz = await this.freePlace(kind, of);
      if (shown !== this.shown) return;
      if (xyz === null) {
        this.message.textContent = `No place around the arm is free for another ${kind}. Move the arm or an obstacle.`;
        return;
      }
      const name = this.freeName(kind);
      this.selected = name;
      this.put({
        ...model.scene,
        obstacles: [...this.obstacles, { name, shapes: [{ ...of, pose: { xyz } }] }],
      });
    } catch (error) {
      this.message.textContent = (error as Error).message;
    } finally {
      this.adding = false;
    }
  }

  private freeName(kind: string): string {
    return freeName(
      kind,
      [...(this.model.arm?.bodies ?? []), ...this.obstacles].map((body) => body.name),
    );
  }

  /** The first place around the arm where a shape keeps away from it, and from the other obstacles; null: none does. */
  private async freePlace(kind: string, shape: SceneShape): Promise<number[] | null> {
    const { model } = this;
    const { size } = (this.shown as Shown).picture;
    const name = this.freeName(kind);
    for (let i = 0; i < places; ++i) {
      const xyz = this.placeAt(i);
      const others = this.obstacles.map((one) => poseOfBody(one).slice(12, 15));
      const isTaken = others.some((at) => Math.hypot(...at.map((v, k) => v - (xyz[k] ?? 0))) < 0.15 * size);
      if (isTaken) continue;
      const alone = textOf({ obstacles: [{ name, shapes: [{ ...shape, pose: { xyz } }] }] });
      if (!model.hasShapes || (await model.isFree(alone, name, newMargin * size))) return xyz;
    }
    return null;
  }

  /** Places around the base at two thirds of the reach, in front of the arm first, a third of the reach above it. */
  private placeAt(i: number): number[] {
    const { arm, picture } = this.shown as Shown;
    const base = arm.forward(this.services.store.get().q ?? [])[0];
    const angle = ((i % 2 === 0 ? i : -i - 1) * Math.PI) / places;
    const far = 0.65 * picture.size;
    const place = [far * Math.cos(angle), far * Math.sin(angle), 0.3 * picture.size];
    return place.map((value, k) => Number(((base?.[12 + k] ?? 0) + value).toFixed(2)));
  }

  private setClearance(): void {
    const value = Number(this.clearance.value);
    const isDefault = this.clearance.value === "";
    const isValid = isDefault || value > 0;
    this.message.textContent = isValid ? this.fault : "A clearance is above 0 m.";
    if (isValid) this.services.store.set({ clearance: isDefault ? 0 : value });
    this.write();
  }

  private saveScene(): void {
    const text = `${textOf(this.model.scene, 2)}\n`;
    saveFile(sceneFile, new Blob([text], { type: "application/json" }));
  }

  private draw(): void {
    if (this.open) this.services.draw({ obstaclesHeld: true, selected: this.index });
  }

  private write(): void {
    const { shown, model } = this;
    if (!shown) return;
    const { planar } = shown.arm;
    this.body.hidden = planar;
    this.about.textContent = planar ? planarArm : this.introduction();
    if (planar) return;
    const { clearance, degrees, passes, showShapes } = this.services.store.get();
    const close = model.nearest.flatMap(({ lower, clearance, names }) => (lower < clearance ? names : []));
    this.list.show(
      this.obstacles.map(({ name }) => name),
      this.index,
      model.hidden,
      close,
    );
    this.form.show(this.index === null ? null : (this.obstacles[this.index] ?? null), degrees);
    if (document.activeElement !== this.clearance)
      this.clearance.value = String(clearance === 0 ? (model.arm?.clearance ?? "") : clearance);
    this.shapes.checked = showShapes;
    this.passes.checked = passes;
    this.around.root.hidden = !model.hasShapes || this.obstacles.length === 0;
    this.save.disabled = this.clear.disabled = textOf(model.scene) === "";
    const left = model.checked.left.map((pair) => pair.join(" and ")).join(", ");
    this.left.textContent = left === "" ? "" : `Pairs that may touch, left out as a body is not there: ${left}.`;
    this.writeFault(model.fault);
    this.writePairs();
  }

  /** Says why arm or obstacles are refused, until they are not. */
  private writeFault(fault: string): void {
    if (fault !== "" || this.message.textContent === this.fault) this.message.textContent = fault;
    this.fault = fault;
  }

  private introduction(): string {
    const { model, shown } = this;
    if (model.arm === null || model.hasShapes)
      return "Bodies that the arm must not hit. Drag them in the picture. Lines are proved to keep the clearance from them.";
    return (
      `${shown?.description.name ?? ""} has no shapes of its links: nothing is checked against obstacles. Shapes come ` +
      "from the collision elements of a URDF file, dropped with its meshes, or from the list “shapes” of an arm file. " +
      "Among the built-in arms panda, ur5e, iiwa7 and others have them."
    );
  }

  private writePairs(): void {
    const texts = this.model.nearest.map(inWords);
    while (this.pairs.childElementCount > texts.length) this.pairs.lastElementChild?.remove();
    texts.forEach(({ text, close }, i) => {
      const item = this.pairs.children[i] ?? this.pairs.appendChild(element("p"));
      item.className = close ? "over" : "";
      if (item.textContent !== text) item.textContent = text;
    });
  }
}

/** "link and box: 12.0 mm", with what is required where they are closer. */
function inWords({ lower, clearance, names }: NamedPair): { text: string; close: boolean } {
  const close = lower < clearance;
  const required = close && lower >= 0 ? `; ${distance(clearance)} are required` : "";
  return { text: `${names.join(" and ")}: ${distance(lower)}${required}`, close };
}

const planarArm =
  "This arm moves in a plane. The page has obstacles for arms that move in space only; the commands take --scene for " +
  "this arm too.";
