// Lights besides three's RectAreaLight, and what of them goes into uniforms.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { Color, Matrix4, Object3D, Vector3 } from 'three';

/** What the lights of this package have in common. They shine along their local -z, as RectAreaLight does. */
export class AreaLight extends Object3D {

	/** As Light's own, which renderer.library.addLight calls from three 0.187 on. */
	static registerNode( lightNodeClass ) {

		this.prototype._lightNode = lightNodeClass;

	}

	constructor( color = 0xffffff, intensity = 1 ) {

		super();
		this.isLight = true; // WebGPURenderer asks a light's node for what it adds; WebGLRenderer knows none of these
		this.color = new Color( color );
		this.intensity = intensity; // radiance: nits or W/(m2 sr)
		this.evenScale = false; // true: of the world's three scales a flat light takes the largest alone, as the draft of EXT_lights_area has it

	}

}

// Twice the area within an outline; negative where it runs clockwise.
function areaOf( outline ) {

	return outline.reduce( ( sum, p, i ) => {

		const q = outline[ ( i + 1 ) % outline.length ];
		return sum + p.x * q.y - q.x * p.y;

	}, 0 );

}

/** A flat light of any simple outline: points of the local plane z = 0, in either order; so are those of its holes. */
export class PolygonAreaLight extends AreaLight {

	constructor( color, intensity, outline, holes = [] ) {

		super( color, intensity );
		if ( [ outline, ...holes ].some( ( o ) => ! o || o.length < 3 ) ) throw new Error( 'PolygonAreaLight: an outline has at least three points' );
		this.isPolygonAreaLight = true;
		this.twoSided = false;
		this.outline = [ ...outline ];
		this.holes = holes.map( ( hole ) => [ ...hole ] );

	}

	/** Points in walk order: clockwise as seen from the lit side, which is -z. A hole is walked the other way round, there and back along a cut, whose two
	 * ways are the same edge in both directions and leave no trace in any sum over edges. */
	get corners() {

		const turned = ( points, sign ) => areaOf( points ) * sign > 0 ? points : [ ...points ].reverse();
		const corners = [ ...turned( this.outline, 1 ) ], first = corners[ 0 ];
		for ( const hole of this.holes ) {

			const h = turned( hole, - 1 );
			corners.push( first, ...h, h[ 0 ] );

		}

		return corners;

	}

}

/** A disk, or an ellipse. */
export class DiskAreaLight extends AreaLight {

	constructor( color, intensity, radiusX = 1, radiusY = radiusX ) {

		super( color, intensity );
		this.isDiskAreaLight = true;
		this.twoSided = false;
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

/** A tube with round ends, its axis along the local x; length is from one end's centre to the other's. It stays round, with the
 * geometric mean of the scales across it. */
export class TubeAreaLight extends AreaLight {

	constructor( color, intensity, length = 1, radius = 0.05 ) {

		super( color, intensity );
		this.isTubeAreaLight = true;
		this.length = length;
		this.radius = radius;

	}

}

/** Vectors of the world that a light takes in the uniforms. */
export function vectorsOf( light ) {

	if ( light.isPolygonAreaLight ) return light.corners.length;
	return light.isSphereAreaLight ? 2 : 3;

}

/** Place, rotation and one scale, the largest of the three. Where a parent's uneven scale shears, z and then x keep their directions. */
function evenlyScaled( m ) {

	const x = new Vector3(), y = new Vector3(), z = new Vector3();
	m.extractBasis( x, y, z );
	const scale = Math.max( x.length(), y.length(), z.length() );
	z.normalize();
	x.addScaledVector( z, - x.dot( z ) ).setLength( scale );
	y.crossVectors( z, x );
	return new Matrix4().makeBasis( x, y, z.multiplyScalar( scale ) ).copyPosition( m );

}

/** Puts them there, from `at` on: corners; or centre and half axes; or both ends and a radius. A flat light under a mirror still shines along its -z. */
export function placeLight( light, place, at ) {

	const m = light.evenScale ? evenlyScaled( light.matrixWorld ) : light.matrixWorld, origin = new Vector3().setFromMatrixPosition( m );
	const axis = ( into, x, y ) => into.set( x, y, 0 ).applyMatrix4( m ).sub( origin ), mirrored = m.determinant() < 0;
	if ( light.isPolygonAreaLight ) {

		const { corners } = light;
		corners.forEach( ( p, i ) => place[ at + ( mirrored ? corners.length - 1 - i : i ) ].set( p.x, p.y, 0 ).applyMatrix4( m ) );

	} else if ( light.isTubeAreaLight ) {

		place[ at ].set( - light.length / 2, 0, 0 ).applyMatrix4( m );
		place[ at + 1 ].set( light.length / 2, 0, 0 ).applyMatrix4( m );
		const [ , y, z ] = [ 0, 4, 8 ].map( ( i ) => Math.hypot( ...m.elements.slice( i, i + 3 ) ) );
		place[ at + 2 ].set( 0, light.radius * Math.sqrt( y * z ), 0 ); // its length counts

	} else {

		place[ at ].copy( origin );
		axis( place[ at + 1 ], ( mirrored ? - 1 : 1 ) * ( light.isDiskAreaLight ? light.radiusX : light.radius ), 0 );
		if ( light.isDiskAreaLight ) axis( place[ at + 2 ], 0, light.radiusY );

	}

}
