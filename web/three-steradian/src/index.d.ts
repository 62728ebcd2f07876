import { Color, ColorRepresentation, DataTexture, MeshStandardMaterial, Object3D, Vector2, Vector3 } from 'three';

/** What the lights of this package have in common. They shine along their local -z, as RectAreaLight does. */
export class AreaLight extends Object3D {
	constructor( color?: ColorRepresentation, intensity?: number );
	color: Color;
	/** Radiance: nits or W/(m2 sr). */
	intensity: number;
	/** true: a flat light takes the largest of its world's three scales alone, as those of EXT_lights_area do. */
	evenScale: boolean;
}

/** A flat light of any simple outline. */
export class PolygonAreaLight extends AreaLight {
	/** outline, holes: points of the local plane z = 0, in either order. */
	constructor( color: ColorRepresentation, intensity: number, outline: Vector2[], holes?: Vector2[][] );
	readonly isPolygonAreaLight: true;
	/** Read when an AreaLightSet is made into a program. */
	twoSided: boolean;
	outline: Vector2[];
	holes: Vector2[][];
	/** Both in walk order, as one outline with cuts. */
	readonly corners: Vector2[];
}

/** A disk, or an ellipse. */
export class DiskAreaLight extends AreaLight {
	constructor( color?: ColorRepresentation, intensity?: number, radiusX?: number, radiusY?: number );
	readonly isDiskAreaLight: true;
	twoSided: boolean;
	radiusX: number;
	radiusY: number;
}

/** A ball that shines to all sides. */
export class SphereAreaLight extends AreaLight {
	constructor( color?: ColorRepresentation, intensity?: number, radius?: number );
	readonly isSphereAreaLight: true;
	radius: number;
}

/** A tube with round ends along its local x. */
export class TubeAreaLight extends AreaLight {
	/** length: from one end's centre to the other's. */
	constructor( color?: ColorRepresentation, intensity?: number, length?: number, radius?: number );
	readonly isTubeAreaLight: true;
	length: number;
	radius: number;
}

/** EXT_lights_area for GLTFLoader; gltf.userData.areaLights lists what it made. */
export class GLTFAreaLights {
	constructor( parser: unknown );
	readonly name: 'EXT_lights_area';
	createNodeAttachment( nodeIndex: number ): Promise<AreaLight | null>;
	afterRoot( result: { userData: Record<string, unknown> } ): Promise<void>;
}

/** Light maps of `steradian bake` for GLTFLoader: loader.register( ( parser ) => new GLTFLightMaps( parser ) ). */
export class GLTFLightMaps {
	constructor( parser: unknown );
	readonly name: 'STERADIAN_light_maps';
	afterRoot( result: { scenes: Object3D[]; userData: Record<string, unknown> } ): Promise<void>;
}

/** gltf.userData.lightMaps: the maps of groups of lights, and the texture that shows their sum. */
export class LightMaps {
	readonly groups: { name: string; intensity: number }[];
	readonly texture: DataTexture;
	/** Factors by the names of groups; others stay. */
	setIntensities( factors: Record<string, number> ): void;
}

/** The lights that patched materials see, besides three's RectAreaLights. Its members may move; which they are is fixed. */
export class AreaLightSet {
	constructor( lights?: AreaLight[] );
	readonly lights: AreaLight[];
	readonly vectors: { value: Vector3[] };
	readonly radiances: { value: Vector3[] };
	update(): void;
	key(): string;
	shader(): string;
}

export interface SteradianOptions {
	/** 'compact': a table of 4 KB in the shader (default). 'closed-form': exact up to 0.2 %, several times the work. */
	method?: 'compact' | 'closed-form';
	/** Lights other than RectAreaLight. */
	lights?: AreaLightSet;
	/** false: three's own way for its RectAreaLights. */
	rects?: boolean;
}

/** Makes a material see area lights by this library. Returns it. */
export function useSteradian<M extends MeshStandardMaterial>( material: M, options?: SteradianOptions ): M;

/** Drop-in for RectAreaLightUniformsLib. */
export class SteradianRectAreaLightUniformsLib {
	static init(): void;
}
