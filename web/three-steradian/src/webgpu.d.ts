import { AnalyticLightNode, Light, WebGPURenderer } from 'three/webgpu';

export { AreaLight, DiskAreaLight, GLTFAreaLights, PolygonAreaLight, SphereAreaLight, TubeAreaLight } from './index.js';

export interface AreaLightOptions {
	/** 'compact': a table of 4 KB in the shader (default). 'closed-form': exact up to 0.2 %, several times the work. */
	method?: 'compact' | 'closed-form';
	/** false: three's own way for its RectAreaLights. */
	rects?: boolean;
}

/** Makes node materials see area lights by this library: before a scene is first drawn. */
export function registerAreaLights( renderer: WebGPURenderer, options?: AreaLightOptions ): void;

/** The node of every area light, for renderer.library.addLight. */
export class SteradianLightNode extends AnalyticLightNode<Light> {
	/** Of the lights that are set up next. */
	static method: 'compact' | 'closed-form';
}
