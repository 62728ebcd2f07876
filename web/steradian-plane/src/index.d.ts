/** One number for all channels, or linear red, green, blue. */
export type Color = number | [number, number, number];
export type Point = [number, number];

export interface Shape {
  /** The name by which lights.get and occluders.get find it. */
  id?: string;
  polygon?: Point[];
  /** Several outlines; holes by the fill rule. */
  polygons?: Point[][];
  evenOdd?: boolean;
  /** A line of no thickness, seen from both sides. */
  line?: Point[];
  lines?: Point[][];
  circle?: { center: Point; radius: number };
  /** x and y are two conjugate half axes. */
  ellipse?: { center: Point; x: Point; y: Point };
  /** All points nearer than radius to the segment. */
  capsule?: { from: Point; to: Point; radius: number };
  /** The colour that light maps with `occluders: "fill"` show. */
  color?: Color;
  /** The share of light that its outline sends on, with `bounce`. None: the colour, of lights nothing. */
  albedo?: Color | null;
}

export interface Light extends Shape {
  radiance?: Color;
  /** Times (1 - (r / range)^2)^2, r the distance to the light; dark beyond. */
  range?: number;
  /** "lambert": times the cosine at the surface; "inverse": divided by the distance. */
  profile?: "uniform" | "lambert" | "inverse";
  /** Light leaves only within halfAngle [radians] of the axis. */
  spot?: { axis: Point; halfAngle: number };
  gradient?: { from: Point; to: Point; stops: [number, Color][] };
}

export interface Scene {
  width?: number;
  height?: number;
  origin?: Point;
  lights?: Light[];
  occluders?: Shape[];
}

/** What is wrong: where, what, and what to do about it. */
export class PlaneError extends Error {
  readonly place: string;
  readonly problem: string;
  readonly hint: string;
}

export interface Body {
  readonly id: string;
  readonly isLight: boolean;
  readonly shape: "polygon" | "polyline" | "ellipse" | "capsule";
  readonly center: Point;
  readonly contours: Point[][];
  readonly axes: [Point, Point];
  readonly radius: number;
  readonly color: [number, number, number];
  albedo: Color | null;
  /** Its middle goes to x, y. */
  move(x: number, y: number): void;
  moveBy(dx: number, dy: number): void;
  /** About its middle. */
  scaleBy(factor: number): void;
  replace(spec: Shape | Light): void;
  remove(): void;
}

export interface LightBody extends Body {
  radiance: Color;
  range: number;
  readonly profile: "uniform" | "lambert" | "inverse";
}

export interface Bodies<Spec, One extends Body> extends Iterable<One> {
  get(id: string): One | undefined;
  add(spec: Spec): One;
  readonly size: number;
}

export interface LightMap {
  width: number;
  height: number;
  /** RGB, row 0 on top, linear and unclamped. */
  radiance: Float32Array;
  /** Averages of radiance times direction, with `moments`. */
  momentX?: Float32Array;
  momentY?: Float32Array;
  /** One number a pixel, with `occluders: "clear"`. */
  alpha?: Float32Array;
}

export class Plane {
  /** From the text of an SVG file, or a description. Throws PlaneError with the file's line. */
  static load(scene: string | Scene, name?: string): Promise<Plane>;
  readonly lights: Bodies<Light, LightBody>;
  readonly occluders: Bodies<Shape, Body>;
  readonly bodies: readonly Body[];
  /** What the SVG file uses and is not supported. */
  readonly warnings: readonly string[];
  readonly view: { x: number; y: number; width: number; height: number };
  /** Where a place of a picture of that size is in the plane: pixels from its left top, 0.5 the middle of the first. */
  placeOf(x: number, y: number, width: number, height: number): Point;
  /** How far the last picture may be off, in shares of a light of radiance 1; of bounces, of the walls' mean radiance. */
  readonly error: number;
  readonly stats: { method: "wasm" | "webgl2"; lightMs: number; showMs: number; tiles: number; drawn: number };
  query(x: number, y: number, options?: { bounce?: number; rays?: number }): {
    radiance: [number, number, number];
    moment: { x: [number, number, number]; y: [number, number, number] };
  };
  render(
    canvas: HTMLCanvasElement | OffscreenCanvas,
    options?: { method?: "auto" | "wasm" | "webgl2"; bounce?: number; exposure?: number; tone?: "neutral" | "linear"; split?: { at?: number; rays?: number } | null },
  ): void;
  light(width: number, height: number, options?: { bounce?: number; moments?: boolean; occluders?: "black" | "fill" | "clear"; aa?: number }): LightMap;
  toSVG(): string;
  dispose(): void;
}
