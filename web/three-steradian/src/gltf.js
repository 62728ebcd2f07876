// EXT_lights_area for GLTFLoader. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { Color, LinearSRGBColorSpace, Vector2 } from 'three';
import { DiskAreaLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight } from './lights.js';

/**
 * The plug-in: loader.register( ( parser ) => new GLTFAreaLights( parser ) ). Lights hang on their nodes, and gltf.userData.areaLights lists them,
 * for an AreaLightSet. Rects and disks as the extension's draft has them; sphere and capsule are additions of this project.
 */
export class GLTFAreaLights {

	constructor( parser ) {

		this.parser = parser;
		this.name = 'EXT_lights_area';
		this.made = [];

	}

	async createNodeAttachment( nodeIndex ) {

		const json = this.parser.json, asked = json.nodes[ nodeIndex ].extensions?.[ this.name ];
		if ( asked?.light === undefined ) return null;
		const place = `${this.name}.lights[ ${asked.light} ]`, definition = json.extensions?.[ this.name ]?.lights?.[ asked.light ];
		if ( ! definition ) throw new Error( `nodes[ ${nodeIndex} ]: there is no ${place}` );
		const light = lightOf( definition, place );
		light.name = this.parser.createUniqueName( definition.name || `area_light_${asked.light}` );
		light.twoSided = definition.extras?.steradian?.two_sided === true;
		this.made.push( light );
		return light;

	}

	async afterRoot( result ) {

		result.userData.areaLights = this.made;

	}

}

function positive( value, otherwise, what ) {

	const x = value ?? otherwise;
	if ( typeof x !== 'number' || ! ( x > 0 ) ) throw new Error( `${what} is ${x}: give a number above 0` );
	return x;

}

function lightOf( definition, place ) {

	const color = new Color();
	if ( definition.color ) color.setRGB( ...definition.color, LinearSRGBColorSpace );
	const intensity = definition.intensity ?? 1000; // nits; the default is the draft's
	const size = positive( definition.size, 1, `${place}.size` );
	switch ( definition.type ) {

		case 'rect': {

			const x = size * positive( definition.rect?.aspect, 1, `${place}.rect.aspect` ) / 2, y = size / 2;
			return new PolygonAreaLight( color, intensity, [ [ - x, - y ], [ x, - y ], [ x, y ], [ - x, y ] ].map( ( p ) => new Vector2( ...p ) ) );

		}

		case 'disk': return new DiskAreaLight( color, intensity, size / 2 );
		case 'sphere': return new SphereAreaLight( color, intensity, size / 2 );
		case 'capsule': return new TubeAreaLight( color, intensity, positive( definition.capsule?.length, 1, `${place}.capsule.length` ), size / 2 );
		default: throw new Error( `${place}.type is '${definition.type}': there are rect, disk, sphere and capsule` );

	}

}
