// EXT_lights_area for GLTFLoader. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { Color, LinearSRGBColorSpace, Vector2 } from 'three';
import { DiskAreaLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight } from './lights.js';

/**
 * The plug-in: loader.register( ( parser ) => new GLTFAreaLights( parser ) ). Lights hang on their nodes, and gltf.userData.areaLights lists them,
 * for an AreaLightSet. Rects and disks as the extension's draft has them: 1000 nits where nothing is said, and of a node's scale the largest of the
 * three. "extras": {"steradian": {...}} of a light says what is ours: two_sided, scale, aspect, and type sphere or capsule (docs/lights.md).
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
		this.made.push( light );
		return light;

	}

	async afterRoot( result ) {

		result.userData.areaLights = this.made;

	}

}

function numberOf( value, otherwise, what, least = 0 ) {

	const x = value ?? otherwise;
	if ( ! ( Number.isFinite( x ) && x >= least ) ) throw new Error( `${what} is ${x}: give a number ${least > 0 ? 'above 0' : 'that is not negative'}` );
	return x;

}

const positive = ( value, otherwise, what ) => numberOf( value, otherwise, what, Number.MIN_VALUE );

function lightOf( definition, place ) {

	const color = new Color(), ours = definition.extras?.steradian ?? {}, extra = `${place}.extras.steradian`;
	if ( definition.color ) color.setRGB( ...definition.color, LinearSRGBColorSpace );
	const intensity = numberOf( definition.intensity, 1000, `${place}.intensity` ); // nits
	const size = positive( definition.size, 1, `${place}.size` );
	if ( ours.profile ) console.warn( `${extra}.profile: measured profiles are not served here; the light shines evenly` );
	const flat = ( light ) => {

		if ( ! [ undefined, 'largest', 'axes' ].includes( ours.scale ) ) throw new Error( `${extra}.scale is '${ours.scale}': there are axes and largest` );
		light.evenScale = ours.scale !== 'axes';
		light.twoSided = ours.two_sided === true;
		return light;

	};

	switch ( ours.type ?? definition.type ) {

		case 'rect': {

			const x = size * positive( definition.rect?.aspect, 1, `${place}.rect.aspect` ) / 2, y = size / 2;
			return flat( new PolygonAreaLight( color, intensity, [ [ - x, - y ], [ x, - y ], [ x, y ], [ - x, y ] ].map( ( p ) => new Vector2( ...p ) ) ) );

		}

		case 'disk': return flat( new DiskAreaLight( color, intensity, size * positive( ours.aspect, 1, `${extra}.aspect` ) / 2, size / 2 ) );
		case 'sphere': return new SphereAreaLight( color, intensity, size / 2 );
		case 'capsule': return new TubeAreaLight( color, intensity, numberOf( ( definition.capsule ?? ours.capsule )?.length, 1, `${place}.capsule.length` ), size / 2 );
		default: throw new Error( `${place}.type is '${definition.type}': there are rect, disk, sphere and capsule` );

	}

}
