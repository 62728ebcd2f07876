// Area lights for three.js (WebGLRenderer) in closed form. README.md is the manual.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { Color, DataTexture, DataUtils, ClampToEdgeWrapping, FloatType, HalfFloatType, LinearFilter, NearestFilter, Object3D, RGBAFormat,
	UniformsLib, UVMapping, Vector3 } from 'three';
import { LIBRARY } from './library.js';
import { SHADER } from './shader.js';
import { ltcTables } from './tables.js';

const X = new Vector3( 1, 0, 0 ), Y = new Vector3( 0, 1, 0 );

/** What the lights of this package have in common. They shine along their local -z, as RectAreaLight does. */
export class AreaLight extends Object3D {

	constructor( color = 0xffffff, intensity = 1 ) {

		super();
		this.color = new Color( color );
		this.intensity = intensity; // radiance: nits or W/(m2 sr)

	}

}

/** A flat light of any simple outline: points of the local plane z = 0, in either order. */
export class PolygonAreaLight extends AreaLight {

	constructor( color, intensity, outline ) {

		super( color, intensity );
		if ( ! outline || outline.length < 3 ) throw new Error( 'PolygonAreaLight: an outline has at least three points' );
		this.isPolygonAreaLight = true;
		this.twoSided = false;
		let area = 0;
		outline.forEach( ( p, i ) => {

			const q = outline[ ( i + 1 ) % outline.length ];
			area += p.x * q.y - q.x * p.y;

		} );
		// Walk order: clockwise as seen from the lit side, which is -z.
		this.outline = area > 0 ? [ ...outline ] : [ ...outline ].reverse();

	}

}

/** A disk, or an ellipse. */
export class DiskAreaLight extends AreaLight {

	constructor( color, intensity, radiusX = 1, radiusY = radiusX ) {

		super( color, intensity );
		this.isDiskAreaLight = true;
		this.radiusX = radiusX;
		this.radiusY = radiusY;

	}

}

/** A ball that shines to all sides; scaled unevenly, it stays round, with the x scale. */
export class SphereAreaLight extends AreaLight {

	constructor( color, intensity, radius = 1 ) {

		super( color, intensity );
		this.isSphereAreaLight = true;
		this.radius = radius;

	}

}

// What a light's place in the uniforms needs: vectors of the world.
function vectorsOf( light ) {

	if ( light.isPolygonAreaLight ) return light.outline.length;
	return light.isDiskAreaLight ? 3 : 2;

}

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
			const place = this.vectors.value;
			if ( light.isPolygonAreaLight ) {

				for ( const p of light.outline ) place[ at ++ ].set( p.x, p.y, 0 ).applyMatrix4( light.matrixWorld );

			} else {

				const center = place[ at ++ ].setFromMatrixPosition( light.matrixWorld );
				if ( light.isDiskAreaLight ) {

					place[ at ++ ].copy( X ).multiplyScalar( light.radiusX ).applyMatrix4( light.matrixWorld ).sub( center );
					place[ at ++ ].copy( Y ).multiplyScalar( light.radiusY ).applyMatrix4( light.matrixWorld ).sub( center );

				} else {

					place[ at ++ ].copy( X ).multiplyScalar( light.radius ).applyMatrix4( light.matrixWorld ).sub( center );

				}

			}

			this.radiances.value[ i ].set( light.color.r, light.color.g, light.color.b ).multiplyScalar( light.intensity );

		} );

	}

	/** What a program is made for: kinds, corners, sides. */
	key() {

		return this.lights.map( ( light ) => light.isPolygonAreaLight ? `p${light.outline.length}${light.twoSided ? 't' : ''}` :
			light.isDiskAreaLight ? 'd' : 's' ).join( ',' );

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

				const n = light.outline.length;
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
	if ( dot( cross( x, y ), center ) > 0.0 ) steradian_three_add_ellipse( center, x, y, steradianRadiances[ ${i} ], ${seen} );
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
	const corners = Math.max( 12, ...lights.lights.map( ( light ) => light.isPolygonAreaLight ? light.outline.length : 0 ) );
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

/** Drop-in for RectAreaLightUniformsLib: three's own shader, with tables of GGX that follow its shadowing and Fresnel closer. */
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
