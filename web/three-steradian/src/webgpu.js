// Area lights for three's WebGPURenderer (WebGPU, and WebGL where it falls back to it). README.md is the manual.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { AnalyticLightNode, Matrix4, NodeUpdateType, RectAreaLight, REVISION, Vector3 } from 'three/webgpu';
import { cameraViewMatrix, clearcoatRoughness, code, diffuseContribution, float, glslFn, normalView, positionView, positionViewDirection, renderGroup, roughness,
	specularColorBlended, specularF90, clearcoatNormalView, uniform, vec3, vec4, wgslFn } from 'three/tsl';
import { LIBRARY } from './library.js';
import { LIBRARY_WGSL } from './library_wgsl.js';
import { AreaLight, DiskAreaLight, placeLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight, vectorsOf } from './lights.js';
import { walkOf } from './walks.js';

export { AreaLight, DiskAreaLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight };
export { GLTFAreaLights } from './gltf.js';

const LIBRARIES = { glsl: code( LIBRARY, [], 'glsl' ), wgsl: code( LIBRARY_WGSL, [], 'wgsl' ) };
const walks = new Map();

function walkFor( language, kind, count, method ) {

	const name = `steradian_node_${kind}_${count}_${method.replace( '-', '_' )}`, key = `${language} ${name}`;
	if ( ! walks.has( key ) ) walks.set( key, ( language === 'wgsl' ? wgslFn : glslFn )( walkOf( language, name, kind, count, method ), [ LIBRARIES[ language ] ] ) );
	return walks.get( key );

}

function kindOf( light ) {

	return light.isDiskAreaLight ? 'disk' : light.isSphereAreaLight ? 'sphere' : light.isTubeAreaLight ? 'tube' : 'polygon';

}

const rotation = new Matrix4();

// Corners of three's own light in walk order, its scale left out, as three does.
function placeRect( light, place ) {

	rotation.extractRotation( light.matrixWorld );
	[ [ - 1, - 1 ], [ 1, - 1 ], [ 1, 1 ], [ - 1, 1 ] ].forEach( ( [ x, y ], i ) =>
		place[ i ].set( x * light.width / 2, y * light.height / 2, 0 ).applyMatrix4( rotation ).add( rectCenter.setFromMatrixPosition( light.matrixWorld ) ) );

}

const rectCenter = new Vector3();

/** The node of every area light. Its method is that of registerAreaLights. */
class SteradianLightNode extends AnalyticLightNode {

	static get type() {

		return 'SteradianLightNode';

	}

	constructor( light = null ) {

		super( light );
		this.updateType = NodeUpdateType.RENDER;
		const count = light.isRectAreaLight ? 4 : vectorsOf( light );
		this.places = Array.from( { length: count }, () => uniform( new Vector3() ).setGroup( renderGroup ) );

	}

	update( frame ) {

		super.update( frame );
		const place = this.places.map( ( u ) => u.value );
		if ( this.light.isRectAreaLight ) placeRect( this.light, place );
		else placeLight( this.light, place, 0 );

	}

	setup( builder ) {

		const { reflectedLight, lightingModel } = builder.context;
		const language = builder.renderer.backend.isWebGPUBackend ? 'wgsl' : 'glsl', kind = kindOf( this.light );
		const walk = walkFor( language, kind, this.places.length, SteradianLightNode.method );
		// Corners are places, of round lights all but the centre (of tubes, but the ends) are directions.
		const isPlace = ( i ) => kind === 'polygon' || i === 0 || ( kind === 'tube' && i === 1 );
		const seen = {};
		this.places.forEach( ( place, i ) => {

			const inView = cameraViewMatrix.mul( vec4( place, isPlace( i ) ? 1 : 0 ) ).xyz;
			seen[ `c${i}` ] = isPlace( i ) ? inView.sub( positionView ) : inView;

		} );
		for ( const side of this.light.twoSided ? [ 1, - 1 ] : [ 1 ] ) {

			const lit = ( normal, rough ) => walk( { normal, view: positionViewDirection, roughness: rough, side: float( side ), ...seen } ).toVar();
			const base = lit( normalView, roughness );
			const fresnel = ( part, f0, f90 ) => f0.mul( part.y.sub( part.z ) ).add( f90.mul( part.z ) );
			reflectedLight.directDiffuse.addAssign( this.colorNode.mul( diffuseContribution ).mul( base.x ) );
			reflectedLight.directSpecular.addAssign( this.colorNode.mul( fresnel( base, specularColorBlended, specularF90 ) ) );
			if ( lightingModel?.clearcoat === true ) {

				const coat = lit( clearcoatNormalView, clearcoatRoughness );
				lightingModel.clearcoatSpecularDirect.addAssign( this.colorNode.mul( fresnel( coat, vec3( 0.04 ), float( 1 ) ) ) );

			}

		}

	}

}

SteradianLightNode.method = 'compact';

/**
 * Makes node materials see area lights by this library, three's own RectAreaLight among them: before a scene is first drawn.
 *
 * options.method  'compact' (default) or 'closed-form'
 * options.rects   false: three's own way for its RectAreaLights
 */
export function registerAreaLights( renderer, options = {} ) {

	const { method = 'compact', rects = true } = options;
	if ( method !== 'compact' && method !== 'closed-form' ) throw new Error( `registerAreaLights: no method ${method}; compact or closed-form` );
	SteradianLightNode.method = method;
	for ( const Light of [ PolygonAreaLight, DiskAreaLight, SphereAreaLight, TubeAreaLight, ...( rects ? [ RectAreaLight ] : [] ) ] ) {

		Light.prototype._lightNode = SteradianLightNode; // from 0.187 on; before, the renderer's library was asked
		if ( parseInt( REVISION ) < 187 ) renderer.library.addLight( SteradianLightNode, Light );

	}

}
