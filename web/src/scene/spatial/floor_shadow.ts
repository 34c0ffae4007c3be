import {
  AddEquation,
  Color,
  CustomBlending,
  Layers,
  Mesh,
  MeshBasicMaterial,
  OneFactor,
  OneMinusSrcAlphaFactor,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  SrcAlphaFactor,
  WebGLRenderTarget,
  type Object3D,
  type WebGLRenderer,
} from "three";
import { resolved } from "../colours.js";

/** Parts on this layer cast a shadow. */
const layer = 1;
const pixels = 384;
/** Of the shadow, where it is darkest. */
const opacity = 0.85;
/** Weights of a Gaussian at 0, 1, … pixels. */
const weights = [0.2, 0.17, 0.12, 0.07, 0.035, 0.015];

/** Makes a part cast a shadow. */
export function castShadow(part: Object3D): void {
  part.layers.enable(layer);
}

const vertexShader = `
  varying vec2 at;
  void main() {
    at = uv;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

/** Blurs the coverage of a picture along one direction, in pixels. */
const blurShader = `
  uniform sampler2D picture;
  uniform vec2 stride;
  varying vec2 at;
  void main() {
    float sum = ${weights[0]} * texture2D(picture, at).a;
    ${weights
      .slice(1)
      .map((weight, i) => `sum += ${weight} * (${["+", "-"].map((s) => side(s, i + 1)).join(" + ")});`)
      .join("\n    ")}
    gl_FragColor = vec4(0.0, 0.0, 0.0, sum);
  }`;

function side(sign: string, far: number): string {
  return `texture2D(picture, at ${sign} ${far}.0 * stride).a`;
}

const shadeShader = `
  uniform sampler2D picture;
  uniform vec3 colour;
  varying vec2 at;
  void main() {
    gl_FragColor = vec4(colour, ${opacity} * texture2D(picture, at).a);
    #include <colorspace_fragment>
  }`;

/** The soft shadow of the arm on the ground, from light straight above: its outline seen from above, blurred. */
export class FloorShadow extends Mesh<PlaneGeometry, ShaderMaterial> {
  private readonly targets = [0, 1].map(() => new WebGLRenderTarget(pixels, pixels, { depthBuffer: false }));
  private readonly above: OrthographicCamera;
  private readonly black = new MeshBasicMaterial({ color: 0 });
  private readonly blur = new ShaderMaterial({
    uniforms: { picture: { value: null }, stride: { value: [0, 0] } },
    vertexShader,
    fragmentShader: blurShader,
    depthTest: false,
    depthWrite: false,
  });
  private readonly square = new Mesh(new PlaneGeometry(2, 2), this.blur);
  private readonly flat = new Scene().add(this.square);
  private readonly front = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
  private isOld = true;

  /** `reach`: half the edge of the square on the ground, m. */
  constructor(private readonly reach: number) {
    super(
      new PlaneGeometry(2 * reach, 2 * reach),
      new ShaderMaterial({
        uniforms: { picture: { value: null }, colour: { value: new Color() } },
        vertexShader,
        fragmentShader: shadeShader,
        blending: CustomBlending, // drawn with what is opaque, in the order of `renderOrder`
        blendEquation: AddEquation,
        blendSrc: SrcAlphaFactor,
        blendDst: OneMinusSrcAlphaFactor,
        blendSrcAlpha: OneFactor, // the picture stays opaque
        depthWrite: false,
      }),
    );
    this.above = new OrthographicCamera(-reach, reach, reach, -reach, 0, 4 * reach);
    const only = new Layers();
    only.set(layer);
    this.above.layers.mask = only.mask;
    this.material.uniforms["picture"] = { value: this.targets[0]?.texture };
    this.paint();
  }

  /** Takes the colours of the page, light or dark. */
  paint(): void {
    this.material.uniforms["colour"] = { value: new Color(resolved("--shadow")) };
  }

  /** What casts the shadow has changed. */
  changed(): void {
    this.isOld = true;
  }

  /** Puts the shadow on the ground below a point, m. */
  put(x: number, y: number, floor: number): void {
    this.position.set(x, y, floor);
    this.above.position.set(x, y, floor + 2 * this.reach);
  }

  /** Computes the shadow of a scene anew where that is needed. */
  update(renderer: WebGLRenderer, scene: Scene): void {
    const [first, second] = this.targets;
    if (!this.isOld || !first || !second) return;
    this.isOld = false;
    const { background, overrideMaterial } = scene;
    const [colour, alpha] = [renderer.getClearColor(new Color()), renderer.getClearAlpha()];
    scene.background = null;
    scene.overrideMaterial = this.black;
    renderer.setClearColor(0, 0);
    renderer.setRenderTarget(first);
    renderer.clear();
    renderer.render(scene, this.above);
    scene.background = background;
    scene.overrideMaterial = overrideMaterial;
    const pass = (from: WebGLRenderTarget, to: WebGLRenderTarget, stride: number[]): void => {
      this.blur.uniforms["picture"] = { value: from.texture };
      this.blur.uniforms["stride"] = { value: stride };
      renderer.setRenderTarget(to);
      renderer.render(this.flat, this.front);
    };
    pass(first, second, [1 / pixels, 0]);
    pass(second, first, [0, 1 / pixels]);
    renderer.setRenderTarget(null);
    renderer.setClearColor(colour, alpha);
  }

  override dispose(): this {
    for (const target of this.targets) target.dispose();
    for (const part of [this.geometry, this.material, this.black, this.blur, this.square.geometry]) part.dispose();
    return this.removeFromParent();
  }
}
