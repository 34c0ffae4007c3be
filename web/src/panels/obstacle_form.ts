import { poseNumbers } from "../core/pose.js";
import { poseOfBody, type SceneBody, type ScenePose, type SceneShape } from "../core/scene.js";
import { element, typed } from "../elements/element.js";

/** A number of an obstacle: its name in the form, whether it is an angle, and the obstacle with another value. */
interface Entry {
  name: string;
  angle: boolean;
  value: number;
  changed(value: number): Changed;
}
/** What a form changes: where the obstacle stands, or its shape. */
export type Changed = { pose: ScenePose } | { shape: SceneShape };

/** Pose and size of one obstacle in numbers that can be changed, and its name. */
export class ObstacleForm {
  readonly root = element("fieldset", { class: "obstacle", hidden: true });
  private readonly name = element("input", { id: "obstacle-name", type: "text", maxlength: 1000 });
  private readonly grid = element("div", { class: "coordinates" });
  private readonly note = element("p", { class: "quiet" });
  private fields: HTMLInputElement[] = [];
  private entries: Entry[] = [];
  private built = "";
  private degrees = true;

  constructor(
    private readonly renamed: (name: string) => void,
    private readonly changed: (change: Changed) => void,
  ) {
    this.name.addEventListener("change", () => this.renamed(this.name.value.trim()));
    this.root.append(
      element("legend", {}, "Selected obstacle"),
      element("p", { class: "pair" }, element("label", { for: "obstacle-name" }, "Name"), this.name),
      this.grid,
      this.note,
    );
  }

  show(body: SceneBody | null, degrees: boolean): void {
    this.root.hidden = body === null;
    if (!body) return;
    this.degrees = degrees;
    this.entries = [...placeOf(body), ...sizesOf(body)];
    const names = this.entries.map(({ name }) => name).join();
    if (names !== this.built) this.build();
    this.built = names;
    this.entries.forEach((entry, i) => this.write(this.fields[i] as HTMLInputElement, entry));
    if (document.activeElement !== this.name) this.name.value = body.name;
    this.note.textContent = remarks(body);
  }

  private build(): void {
    this.fields = this.entries.map(({ name }, i) => {
      const field = element("input", { type: "number", id: `obstacle-${i}`, "aria-label": name });
      field.addEventListener("change", () => {
        const entry = this.entries[i];
        if (field.value !== "" && entry) this.changed(entry.changed(Number(field.value) / this.factor(entry)));
      });
      field.addEventListener("blur", () => {
        const entry = this.entries[i];
        if (entry) this.write(field, entry);
      });
      return field;
    });
    this.grid.replaceChildren(
      ...this.entries.map((entry, i) =>
        element(
          "div",
          { class: "coordinate" },
          element("label", { for: `obstacle-${i}` }, entry.name),
          this.fields[i] as HTMLElement,
          element("span", { class: "unit", "aria-hidden": "true" }),
        ),
      ),
    );
  }

  private factor({ angle }: Entry): number {
    return angle && this.degrees ? 180 / Math.PI : 1;
  }

  private write(field: HTMLInputElement, entry: Entry): void {
    const unit = field.nextElementSibling as HTMLElement;
    unit.textContent = entry.angle ? (this.degrees ? "°" : "rad") : "m";
    field.step = entry.angle && this.degrees ? "1" : "0.01";
    if (document.activeElement !== field || !field.matches(":focus-visible"))
      field.value = typed(entry.value * this.factor(entry), entry.angle && this.degrees ? 2 : 4);
  }
}

function placeOf(body: SceneBody): Entry[] {
  const { position, rpy } = poseNumbers(poseOfBody(body));
  return ["x", "y", "z", "roll", "pitch", "yaw"].map((name, i) => ({
    name,
    angle: i >= 3,
    value: [...position, ...rpy][i] ?? 0,
    changed: (value) => ({
      pose: i < 3 ? { xyz: position.with(i, value), rpy } : { xyz: position, rpy: rpy.with(i - 3, value) },
    }),
  }));
}

/** The sizes of an obstacle of one shape. */
function sizesOf({ shapes }: SceneBody): Entry[] {
  const [shape] = shapes;
  if (!shape || shapes.length > 1) return [];
  const entry = (name: string, value: number, made: (value: number) => Partial<SceneShape>): Entry => ({
    name,
    angle: false,
    value,
    changed: (to) => ({ shape: { ...shape, ...made(to) } }),
  });
  const { box, sphere, cylinder, capsule } = shape;
  if (box)
    return ["size x", "size y", "size z"].map((name, i) =>
      entry(name, box.size[i] ?? 0, (to) => ({ box: { size: box.size.with(i, to) } })),
    );
  if (sphere) return [entry("radius", sphere.radius, (radius) => ({ sphere: { radius } }))];
  const kind = cylinder ? "cylinder" : "capsule";
  const long = cylinder ?? capsule;
  if (!long) return [];
  return [
    entry("radius", long.radius, (radius) => ({ [kind]: { ...long, radius } })),
    entry("length", long.length, (length) => ({ [kind]: { ...long, length } })),
  ];
}

function remarks({ shapes, clearance, point_cloud: cloud }: SceneBody): string {
  const several = shapes.length > 1 ? `${shapes.length} shapes, which move together; the pose is the first one's.` : "";
  const own = clearance === undefined ? "" : `It has a clearance of its own, ${clearance} m.`;
  const frame = shapes.length === 0 ? "; the pose is the one of their frame" : "";
  const points = cloud
    ? `It has ${cloud.points?.length ?? 0} points, spheres of radius ${cloud.radius} m${frame}.`
    : "";
  return [several, own, points].filter((remark) => remark !== "").join(" ");
}
