// The computation of a light node, as a function of GLSL or of WGSL: one text, whose declarations alone differ.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

const GLSL = {
	let: ( type, name ) => `${type} ${name}`,
	array: ( name, count ) => `vec3 ${name}[ ${count} ]`,
	loop: ( name, count ) => `for ( int ${name} = 0; ${name} < ${count}; ${name} ++ )`,
	vec2: 'vec2', vec3: 'vec3', vec4: 'vec4', mat3: 'mat3',
	declare: ( name, params ) => `vec4 ${name}( ${params.map( ( [ type, n ] ) => `${type} ${n}` ).join( ', ' )} )`
};
const WGSL_TYPES = { vec3: 'vec3<f32>', float: 'f32' };
const WGSL = {
	let: ( type, name ) => `var ${name}`,
	array: ( name, count ) => `var ${name} : array<vec3<f32>, ${count}>`,
	loop: ( name, count ) => `for ( var ${name} : i32 = 0; ${name} < ${count}; ${name} ++ )`,
	vec2: 'vec2<f32>', vec3: 'vec3<f32>', vec4: 'vec4<f32>', mat3: 'mat3x3<f32>',
	declare: ( name, params ) => `fn ${name}( ${params.map( ( [ type, n ] ) => `${n} : ${WGSL_TYPES[ type ]}` ).join( ', ' )} ) -> vec4<f32>`
};

const ROUND_CORNERS = 12; // of a polygon that stands for a round light about a lobe (docs/theory/ggx.md)

// Corners d[ 0 ], d[ 1 ], ... in the shading frame, and `diffuse`: of the light, radiance 1 from a white surface.
function outline( L, kind, count ) {

	const to = ( v ) => `steradian_transform_transposed( frame, ${v} )`, width = '2.0 * alpha';
	if ( kind === 'polygon' ) {

		const area = Array.from( { length: count - 2 }, ( _, i ) => `cross( c${i + 1} - c0, c${i + 2} - c0 )` ).join( ' + ' );
		return `if ( dot( ${area}, c0 ) * side <= 0.0 ) { return ${L.vec4}( 0.0, 0.0, 0.0, 0.0 ); }
${L.array( 'd', count )};
${Array.from( { length: count }, ( _, i ) => `d[ ${i} ] = steradian_polygon_direction( ${to( `c${i}` )} );` ).join( '\n' )}
${L.let( 'SteradianPolygonWalk', 'walk' )} = steradian_polygon_begin();
${L.loop( 'i', count )} { walk = steradian_polygon_add_edge( walk, d[ i ], d[ ( i + 1 ) % ${count} ] ); }
${L.let( 'float', 'diffuse' )} = steradian_lambert_radiance( steradian_polygon_irradiance( walk, side < 0.0 ) );`;

	}

	const mirror = `${L.vec3}( - v.x, - v.y, v.z )`;
	const fan = ( shape, first ) => `${first}
${L.let( shape === 'ellipse' ? 'SteradianEllipseFan' : 'SteradianCapsuleFan', 'fan' )} = ${shape === 'ellipse' ? `steradian_ellipse_fan_concentrated( light, ${mirror}, ${width} )` :
	`steradian_capsule_fan( light, ${mirror}, ${width}, ${ROUND_CORNERS} )`};
${L.array( 'd', ROUND_CORNERS )};
${L.loop( 'i', ROUND_CORNERS )} { d[ i ] = steradian_polygon_direction( steradian_${shape}_fan_corner( fan, i${shape === 'ellipse' ? `, ${ROUND_CORNERS}` : ''} ) ); }
${L.let( 'float', 'diffuse' )} = steradian_lambert_radiance( steradian_${shape}_irradiance_vector( light ).z );`;
	const none = `{ return ${L.vec4}( 0.0, 0.0, 0.0, 0.0 ); }`;
	if ( kind === 'disk' ) return fan( 'ellipse', `if ( dot( cross( c1, c2 ), c0 ) * side <= 0.0 ) ${none}
${L.let( 'SteradianEllipse', 'light' )} = steradian_ellipse_prepare( ${to( 'c0' )}, ${to( 'c1' )}, ${to( 'c2 * side' )} );` );
	if ( kind === 'sphere' ) return fan( 'ellipse', `${L.let( 'float', 'r' )} = length( c1 );
${L.let( 'float', 'q' )} = 1.0 / max( r, 1.0e-18 );
${L.let( 'SteradianEllipsoidOutline', 'seen' )} = steradian_ellipsoid_outline( ${to( 'c0' )}, ${L.mat3}( r, 0.0, 0.0, 0.0, r, 0.0, 0.0, 0.0, r ), ${L.mat3}( q, 0.0, 0.0, 0.0, q, 0.0, 0.0, 0.0, q ) );
if ( ! seen.outside ) ${none}
${L.let( 'SteradianEllipse', 'light' )} = steradian_ellipse_prepare( seen.center, seen.axis_a, seen.axis_b );` );
	return fan( 'capsule', `${L.let( 'SteradianCapsule', 'light' )} = steradian_capsule_prepare( ${to( 'c0' )}, ${to( 'c1' )}, length( c2 ) );
if ( ! light.outside ) ${none}` );

}

function compact( L, count, reversed ) {

	return `${L.let( 'vec2', 'place' )} = steradian_ltc_coordinates( roughness, v.z );
${L.let( 'SteradianLtcMatrix', 'm' )} = steradian_ltc_from_compact( steradian_ltc_ggx_shape( place ), alpha, v );
${L.let( 'SteradianLtcWalk', 'ltc' )} = steradian_ltc_begin();
${L.loop( 'k', count )} {
	ltc = steradian_ltc_add_edge( ltc, m, d[ k ], d[ ( k + 1 ) % ${count} ], steradian_ltc_direction( m, d[ k ] ), steradian_ltc_direction( m, d[ ( k + 1 ) % ${count} ] ) );
}
${L.let( 'vec2', 'part' )} = steradian_ltc_ggx_magnitude( place ) * steradian_ltc_integral( ltc, ${reversed} );`;

}

// The edges above the horizon and the arcs of the horizon that close them: `edges` pairs of edge_a and edge_b.
function clipped( L, count, reversed ) {

	const most = 2 * count + 4;
	const put = ( a, b ) => `if ( edges < ${most} ) { edge_a[ edges ] = ${a}; edge_b[ edges ] = ${b}; edges = edges + 1; }`;
	return `${L.let( 'float', 'facing' )} = 1.0;
if ( ${reversed} ) { facing = - 1.0; }
${L.array( 'edge_a', most )};
${L.array( 'edge_b', most )};
${L.let( 'int', 'edges' )} = 0;
${L.let( 'vec3', 'middle' )} = ${L.vec3}( 0.0, 0.0, 1.0 );
${L.let( 'SteradianHorizonClip', 'clip' )} = steradian_horizon_clip_begin();
${L.loop( 'k', count + 1 )} {
	if ( k < ${count} ) {
		clip = steradian_horizon_clip_edge( clip, d[ k % ${count} ], d[ ( k + 1 ) % ${count} ] );
		${put( 'clip.start', 'clip.end' )}
	} else {
		clip = steradian_horizon_clip_finish( clip );
	}
	if ( clip.closes ) {
		middle = clip.arc_start;
		if ( steradian_horizon_arc_wide( clip.arc_start, clip.arc_end ) ) {
			middle = steradian_horizon_arc_middle( clip.arc_start, clip.arc_end, facing );
			${put( 'clip.arc_start', 'middle' )}
		}
		${put( 'middle', 'clip.arc_end' )}
	}
}`;

}

// Two walks over those edges. wide: along the frame's x.
function closedForm( L, count, reversed, wide ) {

	const edge = 'steradian_ggx_edge( ggx, edge_a[ k ], edge_b[ k ] )';
	return `${clipped( L, count, reversed )}
${L.let( 'SteradianGgxView', 'ggx' )} = steradian_ggx_view( v, ${wide}, alpha );
${L.let( 'vec3', 'sum' )} = ${L.vec3}( 0.0, 0.0, 0.0 );
${L.loop( 'k', 'edges' )} { sum += steradian_conic_vector( ${edge} ); }
${L.let( 'SteradianGgxCubature', 'c' )} = steradian_ggx_cubature_begin( ggx, sum, 1.0, facing );
${L.loop( 'k', 'edges' )} { c = steradian_ggx_cubature_edge( c, ${edge}, 0 ); }
${L.let( 'vec2', 'part' )} = steradian_ggx_cubature_finish( c );`;

}

// Fibres: part.x what those of colour 1 send, part.y what they reflect of an even sky.
function sheen( L, count, reversed ) {

	return `${clipped( L, count, reversed )}
${L.let( 'SteradianCharlieLobe', 'lobe' )} = steradian_charlie_prepare( v, alpha );
${L.let( 'vec3', 'sum' )} = ${L.vec3}( 0.0, 0.0, 0.0 );
${L.loop( 'k', 'edges' )} { sum += steradian_polygon_edge( edge_a[ k ], edge_b[ k ] ); }
${L.let( 'SteradianCharlieCubature', 'c' )} = steradian_charlie_cubature_begin( lobe, sum, facing );
${L.loop( 'k', 'edges' )} { c = steradian_charlie_cubature_edge( c, edge_a[ k ], edge_b[ k ] ); }
${L.let( 'vec2', 'place' )} = steradian_ltc_coordinates( roughness, v.z );
${L.let( 'SteradianLtcMatrix', 'm' )} = steradian_ltc_from_compact( steradian_ltc_charlie_shape( place ), alpha, v );
${L.let( 'vec2', 'part' )} = ${L.vec2}( steradian_charlie_cubature_finish( c ), steradian_ltc_charlie_magnitude( place ).x * steradian_ltc_energy_above_horizon( m ) );`;

}

const LOBES = {
	'compact': compact,
	'closed-form': ( L, count, reversed ) => closedForm( L, count, reversed, 'alpha' ),
	'anisotropic': ( L, count, reversed ) => closedForm( L, count, reversed, 'max( wide, alpha )' ), // by both methods: its lobes have no compact table
	'sheen': sheen
};

/**
 * The function's text. It takes, in view space and from the surface's point, the light's vectors c0, c1, ... (as lights.js places them), the normal, the
 * direction to the eye, the perceptual roughness, and side: -1.0 to see the back of a flat light; of 'anisotropic' also a tangent and alpha along it. It
 * returns, for radiance 1: x what a white diffuse surface sends, y and z what a GGX lobe sends with F = 1 and with F = (1 - v.h)^5; of 'sheen', what
 * fibres send and their albedo.
 */
export function walkOf( language, name, kind, count, lobe ) {

	const L = language === 'wgsl' ? WGSL : GLSL, turned = lobe === 'anisotropic';
	const corners = kind === 'polygon' ? count : ROUND_CORNERS, reversed = kind === 'polygon' ? 'side < 0.0' : 'false';
	const params = [ [ 'vec3', 'normal' ], [ 'vec3', 'view' ], [ 'float', 'roughness' ], [ 'float', 'side' ], ...( turned ? [ [ 'vec3', 'tangent' ], [ 'float', 'wide' ] ] : [] ),
		...Array.from( { length: count }, ( _, i ) => [ 'vec3', `c${i}` ] ) ];
	return `${L.declare( name, params )} {
${L.let( 'mat3', 'frame' )} = steradian_frame_from_normal_and_view( normal, ${turned ? 'tangent' : 'view'} );
${L.let( 'vec3', 'v' )} = steradian_transform_transposed( frame, view );
${L.let( 'float', 'alpha' )} = max( roughness * roughness, 1.0e-4 );
${outline( L, kind, count )}
if ( v.z <= 0.0 ) { return ${L.vec4}( diffuse, 0.0, 0.0, 0.0 ); }
${LOBES[ lobe ]( L, corners, reversed )}
return ${L.vec4}( diffuse, part.x, part.y, 0.0 );
}`;

}
