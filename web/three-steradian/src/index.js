// Area lights for three.js (WebGLRenderer) in closed form. README.md is the manual.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { DataTexture, DataUtils, ClampToEdgeWrapping, FloatType, HalfFloatType, LinearFilter, NearestFilter, RGBAFormat, UniformsLib,
	UVMapping, Vector3 } from 'three';
import { LIBRARY } from './library.js';
import { placeLight, vectorsOf } from './lights.js';
import { SHADER } from './shader.js';
import { ltcTables } from './tables.js';

export { AreaLight, DiskAreaLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight } from './lights.js';
export { GLTFAreaLights } from './gltf.js';
export { GLTFLightMaps, LightMaps } from './lightmaps.js';

/** The lights that patched materials see, besides three's RectAreaLights. Its members may move; which they are is fixed. */
export class AreaLightSet {

	constructor( lights = [] ) {

		this.lights = [ ...lights ];
		const vectors = this.lights.reduce( ( sum, light ) => sum + vectorsOf( light ), 0 );
		this.vectors = { value: Array.from( { length: Math.max( vectors, 1 ) }, () => new Vector3() ) };
		this.radiances = { value: Array.from( { length: Math.max( this.lights.length, 1 ) }, () => new Vector3() ) };

	}

	/** Takes over where the lights stand. Patched materials do it before they are drawn. */
	update() {

		let at = 0;
		this.lights.forEach( ( light, i ) => {

			light.updateWorldMatrix( true, false );
			placeLight( light, this.vectors.value, at );
			at += vectorsOf( light );
			this.radiances.value[ i ].set( light.color.r, light.color.g, light.color.b ).multiplyScalar( light.intensity );

		} );

	}

	/** What a program is made for: kinds, corners, sides. */
	key() {

		const kind = ( light ) => light.isPolygonAreaLight ? `p${light.corners.length}` : light.isDiskAreaLight ? 'd' : light.isTubeAreaLight ? 't' : 's';
		return this.lights.map( ( light ) => kind( light ) + ( light.twoSided ? '2' : '' ) ).join( ',' );

	}

	/** GLSL for lights_fragment_begin: every light in a block of its own. */
	shader() {

		let at = 0;
		return this.lights.map( ( light, i ) => {

			const seen = 'geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight';
			const first = at;
			at += vectorsOf( light );
			const point = ( k ) => `( viewMatrix * vec4( steradianVectors[ ${first + k} ], 1.0 ) ).xyz - geometryPosition`;
			const vector = ( k ) => `( viewMatrix * vec4( steradianVectors[ ${first + k} ], 0.0 ) ).xyz`;
			if ( light.isPolygonAreaLight ) {

				const n = light.corners.length;
				return `{
	SteradianOutline light;
	light.count = ${n};
	${Array.from( { length: n }, ( _, k ) => `light.corner[ ${k} ] = ${point( k )};` ).join( '\n\t' )}
	vec3 area = vec3( 0.0 );
	for ( int k = 1; k + 1 < ${n}; k ++ ) area += cross( light.corner[ k ] - light.corner[ 0 ], light.corner[ k + 1 ] - light.corner[ 0 ] );
	float side = dot( area, light.corner[ 0 ] ); // walked the other way round, area points away from the lit side
	light.reversed = side < 0.0;
	if ( side > 0.0${light.twoSided ? ' || side < 0.0' : ''} ) steradian_three_add( light, steradian_three_diffuse( light,
		steradian_frame_from_normal( geometryNormal ) ), steradianRadiances[ ${i} ], ${seen} );
}`;

			}

			if ( light.isDiskAreaLight ) return `{
	vec3 center = ${point( 0 )}, x = ${vector( 1 )}, y = ${vector( 2 )};
	${light.twoSided ? 'if ( dot( cross( x, y ), center ) < 0.0 ) y = - y;' : ''}
	if ( dot( cross( x, y ), center ) > 0.0 ) steradian_three_add_ellipse( center, x, y, steradianRadiances[ ${i} ], ${seen} );
}`;
			if ( light.isTubeAreaLight ) return `{
	steradian_three_add_tube( ${point( 0 )}, ${point( 1 )}, length( steradianVectors[ ${first + 2} ] ), steradianRadiances[ ${i} ], ${seen} );
}`;
			return `{
	vec3 center = ${point( 0 )};
	float radius = length( steradianVectors[ ${first + 1} ] );
	SteradianEllipsoidOutline o = steradian_ellipsoid_outline( center, mat3( radius ), mat3( 1.0 / max( radius, 1.0e-18 ) ) );
	if ( o.outside ) steradian_three_add_ellipse( o.center, o.axis_a, o.axis_b, steradianRadiances[ ${i} ], ${seen} );
}`;

		} ).join( '\n' );

	}

}

/**
 * Makes a MeshStandardMaterial or MeshPhysicalMaterial see area lights by this library.
 *
 * options.method  'compact' (a table of 4 KB in the shader; default) or 'closed-form' (exact up to 0.2 %, several times the work)
 * options.lights  an AreaLightSet, for lights other than RectAreaLight
 * options.rects   false: three's own way for its RectAreaLights
 *
 * Returns the material. Textures, samplers and RectAreaLightUniformsLib.init() are not needed.
 */
export function useSteradian( material, options = {} ) {

	const { method = 'compact', lights = new AreaLightSet(), rects = true } = options;
	if ( method !== 'compact' && method !== 'closed-form' ) throw new Error( `useSteradian: no method ${method}; compact or closed-form` );
	if ( ! material.isMeshStandardMaterial ) throw new Error( 'useSteradian: wants a MeshStandardMaterial or a MeshPhysicalMaterial' );
	const corners = Math.max( 12, ...lights.lights.map( ( light ) => light.isPolygonAreaLight ? light.corners.length : 0 ) );
	const before = { compile: material.onBeforeCompile, render: material.onBeforeRender, key: material.customProgramCacheKey };

	material.onBeforeCompile = function ( shader, renderer ) {

		before.compile.call( this, shader, renderer );
		lights.update();
		shader.uniforms.steradianVectors = lights.vectors;
		shader.uniforms.steradianRadiances = lights.radiances;
		const head = `
#define STERADIAN_CORNERS ${corners}
${method === 'closed-form' ? '#define STERADIAN_CLOSED_FORM' : ''}
${rects ? '#define STERADIAN_RECTS' : ''}
uniform vec3 steradianVectors[ ${lights.vectors.value.length} ];
uniform vec3 steradianRadiances[ ${lights.radiances.value.length} ];
`;
		const pars = '#include <lights_physical_pars_fragment>', begin = '#include <lights_fragment_begin>';
		for ( const chunk of [ pars, begin ] ) {

			if ( ! shader.fragmentShader.includes( chunk ) ) throw new Error( `useSteradian: this version of three has no ${chunk}` );

		}

		shader.fragmentShader = shader.fragmentShader
			.replace( pars, () => `${pars}\n${head}\n${LIBRARY}\n${SHADER}` )
			.replace( begin, () => `${begin}\n${lights.shader()}` );

	};

	material.onBeforeRender = function ( ...args ) {

		before.render.apply( this, args );
		lights.update();

	};

	material.customProgramCacheKey = function () {

		return `${before.key.call( this )}|steradian ${method} ${rects} ${lights.key()}`;

	};

	material.needsUpdate = true;
	return material;

}

/** Drop-in for RectAreaLightUniformsLib: three's own shader, with tables that are fitted to its whole formula. */
export class SteradianRectAreaLightUniformsLib {

	static init() {

		const { matrix, magnitude, size } = ltcTables();
		const texture = ( data, type ) => {

			const t = new DataTexture( data, size, size, RGBAFormat, type, UVMapping, ClampToEdgeWrapping, ClampToEdgeWrapping,
				LinearFilter, NearestFilter, 1 );
			t.needsUpdate = true;
			return t;

		};

		const half = ( data ) => Uint16Array.from( data, ( x ) => DataUtils.toHalfFloat( x ) );
		UniformsLib.LTC_FLOAT_1 = texture( matrix, FloatType );
		UniformsLib.LTC_FLOAT_2 = texture( magnitude, FloatType );
		UniformsLib.LTC_HALF_1 = texture( half( matrix ), HalfFloatType );
		UniformsLib.LTC_HALF_2 = texture( half( magnitude ), HalfFloatType );

	}

}
