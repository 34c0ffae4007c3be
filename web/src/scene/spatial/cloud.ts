import {
  BufferGeometry,
  Float32BufferAttribute,
  Points,
  PointsMaterial,
  type Color,
  type Intersection,
  type Raycaster,
} from "three";
import type { PointCloud } from "../../core/scene.js";

const leastPixels = "1.5"; // a small sphere far away is seen

/** The spheres of a point cloud in its own frame: discs that are shaded as spheres, so that a million of them is drawn. */
export class Cloud extends Points<BufferGeometry, PointsMaterial> {
  private readonly radius: number;

  constructor({ points = [], radius }: PointCloud) {
    const places = new Float32BufferAttribute(points.flat(), 3);
    super(new BufferGeometry().setAttribute("position", places), spheres(radius));
    this.radius = radius;
  }

  set tone(colour: Color) {
    this.material.color = colour;
  }

  /** A ray hits what it passes at the radius of the spheres. */
  override raycast(ray: Raycaster, hits: Intersection[]): void {
    const { threshold } = ray.params.Points;
    ray.params.Points.threshold = this.radius;
    super.raycast(ray, hits);
    ray.params.Points.threshold = threshold;
  }

  override dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}

/** Points of this radius, m, in pixels by the camera's perspective: three.js takes the tangent of half its angle as 1. */
function spheres(radius: number): PointsMaterial {
  const material = new PointsMaterial({ size: 2 * radius });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("gl_PointSize = size;", "gl_PointSize = size * projectionMatrix[1][1];")
      .replace("#include <logdepthbuf_vertex>", `gl_PointSize = max(gl_PointSize, ${leastPixels});`);
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <color_fragment>",
      `vec2 at = 2.0 * gl_PointCoord - 1.0;
      if (dot(at, at) > 1.0) discard;
      diffuseColor.rgb *= 0.55 + 0.45 * sqrt(1.0 - dot(at, at));`,
    );
  };
  return material;
}
