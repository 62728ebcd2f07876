// Area lights for three's WebGPURenderer (WebGPU, and WebGL where it falls back to it). README.md is the manual.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { AnalyticLightNode, Matrix4, NodeUpdateType, RectAreaLight, Vector3 } from 'three/webgpu';
import { alphaT, anisotropyT, cameraViewMatrix, clearcoatNormalView, clearcoatRoughness, code, diffuseContribution, float, glslFn, normalView, positionView,
	positionViewDirection, renderGroup, roughness, sheen, sheenRoughness, specularColorBlended, specularF90, uniform, vec3, vec4, wgslFn } from 'three/tsl';
import { LIBRARY } from './library.js';
import { LIBRARY_WGSL } from './library_wgsl.js';
import { AreaLight, DiskAreaLight, placeLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight, vectorsOf } from './lights.js';
import { walkOf } from './walks.js';

export { AreaLight, DiskAreaLight, PolygonAreaLight, SphereAreaLight, TubeAreaLight };
export { GLTFAreaLights } from './gltf.js';

const LIBRARIES = { glsl: code( LIBRARY, [], 'glsl' ), wgsl: code( LIBRARY_WGSL, [], 'wgsl' ) };
const walks = new Map();

function walkFor( language, kind, count, lobe ) {

	const name = `steradian_node_${kind}_${count}_${lobe.replace( '-', '_' )}`, key = `${language} ${name}`;
	if ( ! walks.has( key ) ) walks.set( key, ( language === 'wgsl' ? wgslFn : glslFn )( walkOf( language, name, kind, count, lobe ), [ LIBRARIES[ language ] ] ) );
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
export class SteradianLightNode extends AnalyticLightNode {

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
		const method = SteradianLightNode.method;
		// Corners are places, of round lights all but the centre (of tubes, but the ends) are directions.
		const isPlace = ( i ) => kind === 'polygon' || i === 0 || ( kind === 'tube' && i === 1 );
		const seen = {};
		this.places.forEach( ( place, i ) => {

			const inView = cameraViewMatrix.mul( vec4( place, isPlace( i ) ? 1 : 0 ) ).xyz;
			seen[ `c${i}` ] = isPlace( i ) ? inView.sub( positionView ) : inView;

		} );
		for ( const side of this.light.twoSided ? [ 1, - 1 ] : [ 1 ] ) {

			const lit = ( lobe, normal, rough, more = {} ) =>
				walkFor( language, kind, this.places.length, lobe )( { normal, view: positionViewDirection, roughness: rough, side: float( side ), ...more, ...seen } ).toVar();
			const fresnel = ( part, f0, f90 ) => f0.mul( part.y.sub( part.z ) ).add( f90.mul( part.z ) );
			const base = lightingModel?.anisotropy === true ? lit( 'anisotropic', normalView, roughness, { tangent: anisotropyT, wide: alphaT } ) : lit( method, normalView, roughness );
			let below = this.colorNode;
			if ( lightingModel?.sheen === true ) {

				const fibres = lit( 'sheen', normalView, sheenRoughness );
				lightingModel.sheenSpecularDirect.addAssign( this.colorNode.mul( sheen ).mul( fibres.y ) );
				below = below.mul( sheen.r.max( sheen.g ).max( sheen.b ).mul( fibres.z ).oneMinus() );

			}

			reflectedLight.directDiffuse.addAssign( below.mul( diffuseContribution ).mul( base.x ) );
			reflectedLight.directSpecular.addAssign( below.mul( fresnel( base, specularColorBlended, specularF90 ) ) );
			if ( lightingModel?.clearcoat === true ) {

				const coat = lit( method, clearcoatNormalView, clearcoatRoughness );
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

		if ( RectAreaLight.registerNode ) Light.registerNode( SteradianLightNode ); // the class itself knows its node: three from 0.187 on
		else { // the renderer's library does, and keeps what it has been told first

			renderer.library.lightNodes.delete( Light );
			renderer.library.addLight( SteradianLightNode, Light );

		}

	}

}
