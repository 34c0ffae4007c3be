import factory from "beeline-module/core.js";
import listedArms from "virtual:arms";
import { longestAddress } from "../address/address.js";
import type { Arm } from "../core/arm.js";
import { CoreWorker } from "../core/client.js";
import { Core } from "../core/core.js";
import { describe, type ArmDescription } from "../core/description.js";
import { compile, type Factory } from "../core/load.js";
import type { CoreModule } from "../core/module.js";
import { clamped } from "../core/nearest.js";
import { iconButton } from "../elements/button.js";
import { element } from "../elements/element.js";
import { fading } from "../elements/fading.js";
import { icon } from "../elements/icons.js";
import { selectNumbers } from "../elements/select_numbers.js";
import { follow, sessionOf } from "../live/live.js";
import { ArmChooser } from "../panels/arm_chooser.js";
import { MeshList } from "../panels/mesh_list.js";
import type { PathFile } from "../scene/mesh_files.js";
import type { Picture, PictureParts } from "../scene/picture.js";
import { PlanarPicture } from "../scene/planar/planar_picture.js";
import { spatialPicture } from "../scene/spatial_later.js";
import { bytesOf, startWorker } from "../share/parts.js";
import { savedAddress, savedTrajectory } from "../share/save_page.js";
import { initialState, sameArm, sections, type ArmSource, type PageState, type Section } from "../state/page_state.js";
import { Store } from "../state/store.js";
import { AddressBar } from "./address_bar.js";
import { Alone } from "./alone.js";
import { ArmFiles } from "./arm_files.js";
import { ArmPanel } from "./arm_panel.js";
import { Control } from "./control.js";
import { Guard } from "./guard.js";
import { Holding } from "./holding.js";
import { LessonsSection } from "./lessons.js";
import { LineSection } from "./line.js";
import { Obstacles } from "./obstacles.js";
import { faultOf, stateAt } from "./opened_state.js";
import { Opening } from "./opening.js";
import { Overlays } from "./overlays.js";
import { sceneAmong } from "./scene_files.js";
import { SceneModel } from "./scene_model.js";
import type { PageSection, Services, Shown } from "./section.js";
import { stateOfSession } from "./session.js";
import { helpDialog, settingsDialog } from "./settings.js";
import { ShareDialog } from "./share_dialog.js";
import { Toolbar } from "./toolbar.js";
import { Undo } from "./undo.js";
import { welcome } from "./welcome.js";
import { Workspace } from "./workspace.js";

/** The arm's file in the folder of a command. */
const armFile = "arm.json";
const titles: Record<Section, string> = {
  pose: "Pose",
  control: "Control",
  line: "Line",
  obstacles: "Obstacles",
  workspace: "Workspace",
  lessons: "Lessons",
};
const idle = 1000; // milliseconds until the worker is loaded, which plans and proves

/** The page: its state, the arm that it shows, and a panel for each section. */
export class Page {
  private readonly sections: Map<Section, PageSection>;
  private readonly links: Map<Section, HTMLElement>;
  private readonly services: Services;
  private readonly overlays = new Overlays();
  private readonly holding: Holding;
  private readonly armPanel: ArmPanel;
  private readonly toolbar: Toolbar;
  private readonly line: LineSection;
  private readonly scene: SceneModel;
  private readonly obstacles: Obstacles;
  private readonly lessons: LessonsSection;
  private readonly files: ArmFiles;
  private readonly chooser: ArmChooser;
  private readonly address = new AddressBar();
  private readonly alone: Alone;
  private readonly undo: Undo;
  private readonly welcome: HTMLElement;
  private readonly live = element("span", { role: "status", class: "live", hidden: true });
  private shown: Shown | null = null;
  /** The part of the state that belongs to the arm that is shown. */
  private valid: Pick<PageState, "arm" | "q" | "goal" | "waypoints"> | null = null;
  private showing: Section | null = null;
  /** When commands may load the worker: after the opening. */
  private free: Promise<void> = Promise.resolve();
  private taking = 0;
  private reading = 0;
  private opening = 0;

  private constructor(
    private readonly document: Document,
    private readonly core: Core,
    worker: CoreWorker,
    scenes: CoreWorker,
    private readonly store: Store<PageState>,
  ) {
    this.services = {
      store,
      command: async (args, files = {}, progress = undefined) => {
        await this.free;
        return worker.command(args, { [armFile]: this.shown?.arm.json ?? "", ...files }, progress);
      },
      inScene: async (args, files = {}, progress = undefined) => {
        const asked = await this.scene.inScene(args, files);
        return this.services.command(asked.args, asked.files, progress);
      },
      surroundings: () => this.scene.key,
      unchecked: () => this.scene.unchecked,
      reach: (task, progress) => worker.reach(task, progress),
      cancel: () => worker.cancel(),
      draw: (marks) => this.overlays.draw(marks),
    };
    const meshes = new MeshList();
    this.chooser = new ArmChooser(
      listedArms,
      {
        text: (text) => store.set({ arm: { text }, q: null, goal: null, waypoints: [] }),
        files: (files) => void this.opened(files),
        table: (json) => this.files.openText("dh_table.json", json),
      },
      this.address.note,
      meshes.line,
      meshes.root,
    );
    this.files = new ArmFiles(core, store, this.chooser, meshes, () => this.reread());
    this.scene = new SceneModel(scenes, store, () => this.files.withShapes());
    this.obstacles = new Obstacles(this.services, this.scene);
    const guard = new Guard(store, this.scene, this.overlays);
    this.holding = new Holding(this.services, guard, () => this.sections.get(store.get().section));
    this.undo = new Undo(store, this.holding);
    this.armPanel = new ArmPanel(this.services, this.holding, this.overlays, (id) => this.lessons.open(id));
    this.toolbar = new Toolbar(store);
    this.line = new LineSection(this.services);
    this.lessons = new LessonsSection(this.services, (text) => core.arm(text));
    this.welcome = welcome((section) => this.turnTo(section));
    this.sections = new Map<Section, PageSection>([
      ["control", new Control(this.services)],
      ["line", this.line],
      ["obstacles", this.obstacles],
      ["workspace", new Workspace(this.services)],
      ["lessons", this.lessons],
    ]);
    this.links = new Map(sections.map((name) => [name, this.link(name)]));
    this.alone = new Alone(document);
    this.build();
    store.subscribe((_, changed) => this.changed(changed));
    document.defaultView?.addEventListener("popstate", () => this.address.forget());
    document.defaultView?.addEventListener("hashchange", ({ newURL }) => void this.readAddress(new URL(newURL).hash));
    document.addEventListener("keydown", (event) => this.undo.key(event));
  }

  /** Loads the core, reads the address and shows it. */
  static async open(document: Document): Promise<Page> {
    const isSaved = location.hash === "";
    const hash = isSaved ? savedAddress() : location.hash;
    const [bytes, state, session] = await Promise.all([
      bytesOf("core-module"),
      stateAt(hash, isSaved ? Infinity : longestAddress),
      sessionOf(document),
    ]);
    const core = await Core.load(factory as unknown as Factory<CoreModule>, bytes as BufferSource);
    let module: Promise<WebAssembly.Module> | null = null; // one for both workers
    const compiled = (): Promise<WebAssembly.Module> =>
      (module ??= bytesOf("command-module")
        .then((code) => compile(code as BufferSource))
        .catch((error: unknown) => {
          module = null; // the next command tries again
          throw error;
        }));
    const [worker, scenes] = [0, 1].map(() => new CoreWorker(startWorker, compiled)) as [CoreWorker, CoreWorker];
    if (session && location.hash === "") Object.assign(state, stateOfSession(core, session));
    const fresh = location.hash === "" && !session && savedAddress() === "";
    const page = new Page(document, core, worker, scenes, new Store(state));
    page.chooser.acceptDrops(document.body);
    page.welcome.hidden = !fresh;
    const fault = faultOf(hash, state);
    page.address.read(page.store.get(), fault);
    await page.takeArm(page.store.get().arm);
    if (fault !== "") void page.address.write(page.store.get());
    if (session) page.goLive();
    const trajectory = session ? session.trajectory : await savedTrajectory();
    if (trajectory !== null) page.line.recording.open("motion.csv", trajectory);
    page.undo.begin();
    if (fresh && page.shown) page.begin(page.shown);
    else if (state.only === "") setTimeout(() => worker.prepare(), idle); // a page of frames does not need it in each
    return page;
  }

  private begin(shown: Shown): void {
    this.free = new Promise((resolve) => {
      new Opening(this.services, shown, () => {
        this.undo.begin();
        resolve();
      });
    });
  }

  private build(): void {
    const place = (id: string): HTMLElement => this.document.getElementById(id) as HTMLElement;
    const settings = settingsDialog(this.store);
    const help = helpDialog();
    const share = new ShareDialog(
      this.services,
      () => this.shown,
      () => this.lessons.parts(),
    );
    const roots = [...this.sections.values()].map(({ root }) => root);
    place("side").replaceChildren(this.lessons.bar, this.chooser.notes, this.welcome, ...roots, this.armPanel.root);
    fading(place("tools")).replaceChildren(...this.toolbar.buttons, this.line.recording.light, this.live);
    place("sections").replaceChildren(...this.links.values());
    place("under").replaceChildren(this.lessons.player.root);
    place("stage").addEventListener("pointerdown", () => this.undo.record(), { capture: true }); // another gesture begins
    place("bar").replaceChildren(
      this.chooser.button,
      ...this.undo.buttons,
      iconButton("share", "Share", "Link, picture, drawing, one file, frame", () => void share.open()),
      iconButton("settings", "Settings", "Units and appearance", () => settings.showModal()),
      iconButton("help", "Help", "What hands and keys do", () => help.showModal()),
    );
    this.document.querySelector(".skip")?.addEventListener("click", (event) => {
      event.preventDefault(); // the address is the state's
      this.document.getElementById("joint-0")?.focus();
    });
    this.document.body.append(this.chooser.dialog, share.root, settings, help);
    selectNumbers(this.document);
    this.showSections();
    this.alone.update(this.store.get());
  }

  /** Follows the joint values that a program posts to `beeline view`. */
  private goLive(): void {
    follow(
      (q) => {
        if (q.length === this.shown?.arm.dof) this.store.set({ q });
      },
      (text) => {
        this.live.textContent = text;
        this.live.hidden = text === "";
      },
    );
  }

  private changed(changed: ReadonlySet<keyof PageState>): void {
    if (changed.has("section")) this.showSections();
    this.alone.update(this.store.get());
    const { arm } = this.store.get();
    // A panel that was hidden has missed the changes since.
    const missed = changed.has("section") ? (Object.keys(initialState) as (keyof PageState)[]) : [];
    if (arm === this.valid?.arm) this.update(new Set([...changed, ...missed]));
    else if (changed.has("arm")) void this.takeArm(arm);
    this.undo.note();
    void this.address.write(this.store.get());
  }

  /** Reads an arm and shows it; the one before stays where it is refused. */
  private async takeArm(source: ArmSource): Promise<void> {
    try {
      const text = "text" in source ? source.text : armFile;
      const files = "text" in source ? {} : { [armFile]: source.json };
      await this.show(this.core.arm(text, files), source);
    } catch (error) {
      if (this.valid) this.store.set(this.valid);
      else if (!sameArm(source, initialState.arm)) {
        this.store.set({ arm: initialState.arm, q: null, goal: null });
        if (this.valid === null) await this.takeArm(initialState.arm);
      }
      this.chooser.refuse((error as Error).message);
    }
  }

  private async show(arm: Arm, source: ArmSource): Promise<void> {
    const taking = ++this.taking;
    const make = arm.planar ? null : await spatialPicture();
    if (taking !== this.taking) return arm.release();
    this.services.cancel(); // what is computed for the arm before
    const isRead = this.store.get().section === "lessons"; // a lesson stays where it is read
    if (this.shown && !isRead) this.document.getElementById("side")?.scrollTo({ top: 0 });
    this.shown?.picture.dispose();
    this.shown?.arm.release();
    const description = describe(arm);
    const holder = this.document.getElementById("stage") as HTMLElement;
    const parts: PictureParts = { holder, arm, description, size: sizeOf(arm, description), hand: this.holding };
    const picture: Picture = make ? new make(parts) : new PlanarPicture(parts);
    this.shown = { arm, description, picture };
    this.chooser.show(description.name);
    for (const taker of [
      this.overlays,
      this.holding,
      this.scene,
      this.toolbar,
      this.armPanel,
      ...this.sections.values(),
      this.files,
    ])
      taker.take(this.shown);
    this.document.title = `${description.name} – Beeline`;
    this.store.set(this.withinLimits(this.store.get()));
    const { q, goal, waypoints } = this.store.get();
    this.valid = { arm: source, q, goal, waypoints };
    if (q === null || q.length !== arm.dof) this.store.set({ q: arm.displayConfiguration() });
    this.update(new Set(Object.keys(initialState) as (keyof PageState)[]));
  }

  private update(changed: ReadonlySet<keyof PageState>): void {
    const state = this.store.get();
    const { arm, q, goal, waypoints, section } = state;
    if (!q || q.length !== this.shown?.arm.dof) return;
    this.valid = { arm, q, goal, waypoints };
    this.overlays.update(q, state);
    this.scene.update(q, changed);
    this.armPanel.update(q, changed);
    this.sections.get(section)?.update(q, changed);
  }

  private showSections(): void {
    const { section } = this.store.get();
    if (section === this.showing) return;
    if (this.showing) {
      this.sections.get(this.showing)?.leave();
      this.welcome.hidden = true;
      this.document.getElementById("side")?.scrollTo({ top: 0 });
    }
    this.overlays.clear();
    this.showing = section;
    for (const [name, { root }] of this.sections) root.hidden = name !== section;
    for (const [name, link] of this.links) {
      if (name === section) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
    this.armPanel.arrange(section);
  }

  /** The goal of a state within the limits of the arm that is shown, as its fields keep it. */
  private withinLimits({ goal }: Readonly<PageState>): Partial<PageState> {
    const joints = this.shown?.description.joints ?? [];
    return goal?.length === joints.length ? { goal: clamped(goal, joints) } : {};
  }

  /** Takes files that were dropped or chosen: a scene, or an arm with its meshes. */
  private async opened(files: PathFile[]): Promise<void> {
    const turn = ++this.opening; // of several files the last ones are shown
    const scene = await sceneAmong(files);
    if (turn !== this.opening) return;
    if (!scene) return this.files.open(files);
    this.chooser.dialog.close();
    await this.obstacles.readFile(scene);
  }

  /** The arm that is shown has other meshes, and so other shapes of its links. */
  private reread(): void {
    if (!this.shown) return;
    this.scene.take(this.shown);
    this.update(new Set(["scene"]));
  }

  /** Another section, by a link. Lessons bring their arm; the one before comes back after them. */
  private turnTo(section: Section): void {
    if (section === "lessons") void this.lessons.enter();
    else this.store.set({ ...this.lessons.before(), section });
  }

  private link(name: Section): HTMLElement {
    const link = element("a", { href: `#section=${name}` }, icon(name), element("span", {}, titles[name]));
    link.addEventListener("click", (event) => {
      event.preventDefault();
      this.turnTo(name);
    });
    return link;
  }

  private async readAddress(hash: string): Promise<void> {
    const turn = ++this.reading;
    const state = await stateAt(hash);
    if (turn !== this.reading) return;
    const { arm } = this.store.get();
    if (sameArm(state.arm, arm)) Object.assign(state, { arm, ...this.withinLimits(state) });
    this.address.read(state, faultOf(hash, state));
    this.holding.forget();
    this.sections.get(this.store.get().section)?.interrupt?.(); // it would move the arm that the address has placed
    this.store.set(state);
    void this.address.write(this.store.get()); // where the state differs from the address
  }
}

/** How much of the world the picture shows, metres: the reach, or where it has no bound the arm as it is shown first. */
function sizeOf(arm: Arm, { reach }: ArmDescription): number {
  const far = arm.forward(arm.displayConfiguration()).map((pose) => Math.hypot(...pose.subarray(12, 15)));
  return reach?.radius || 1.3 * Math.max(...far) || 1;
}
