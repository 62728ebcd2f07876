// The GLSL that asks the library (library.js) for what a fragment sees: three's names on one side, ours on the other.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// STERADIAN_CORNERS is the most corners of any light; STERADIAN_CLOSED_FORM chooses the method of glossy lobes.
export const SHADER = /* glsl */ `
// A flat light from the shading point.
//   corner    vectors [m] in walk order (clockwise as seen from the lit side)
//   reversed  seen from behind
struct SteradianOutline {
	vec3 corner[STERADIAN_CORNERS];
	int count;
	bool reversed;
};

// Irradiance of radiance 1 over pi: what a white Lambert surface sends out.
float steradian_three_diffuse( const in SteradianOutline light, const in mat3 frame ) {
	SteradianPolygonWalk walk = steradian_polygon_begin();
	vec3 previous = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ light.count - 1 ] ) );
	for ( int i = 0; i < STERADIAN_CORNERS; i ++ ) {
		if ( i >= light.count ) break;
		vec3 next = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ i ] ) );
		walk = steradian_polygon_add_edge( walk, previous, next );
		previous = next;
	}
	return steradian_lambert_radiance( steradian_polygon_irradiance( walk, light.reversed ) );
}

#ifdef STERADIAN_CLOSED_FORM

// One pass over the edges above the horizon and the arcs of the horizon that close them: the sum of the edges' vectors, or, of
// the second pass, the nodes of the cubature.
struct SteradianPass {
	SteradianGgxView view;
	vec3 sum;
	SteradianGgxCubature cubature;
};

void steradian_three_edge( inout SteradianPass pass, const in bool second, const in vec3 a, const in vec3 b ) {
	SteradianConicArc arc = steradian_ggx_edge( pass.view, a, b );
	if ( second ) pass.cubature = steradian_ggx_cubature_edge( pass.cubature, arc, 0 );
	else pass.sum += steradian_conic_vector( arc );
}

void steradian_three_close( inout SteradianPass pass, const in bool second, const in SteradianHorizonClip clip, const in bool reversed ) {
	if ( ! clip.closes ) return;
	vec3 start = clip.arc_start;
	if ( dot( start, clip.arc_end ) < - 0.9999 ) {
		vec3 middle = steradian_horizon_arc_middle( start, clip.arc_end, reversed ? - 1.0 : 1.0 );
		steradian_three_edge( pass, second, start, middle );
		start = middle;
	}
	steradian_three_edge( pass, second, start, clip.arc_end );
}

void steradian_three_pass( inout SteradianPass pass, const in bool second, const in SteradianOutline light, const in mat3 frame ) {
	SteradianHorizonClip clip = steradian_horizon_clip_begin();
	vec3 previous = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ light.count - 1 ] ) );
	for ( int i = 0; i < STERADIAN_CORNERS; i ++ ) {
		if ( i >= light.count ) break;
		vec3 next = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ i ] ) );
		clip = steradian_horizon_clip_edge( clip, previous, next );
		steradian_three_edge( pass, second, clip.start, clip.end );
		steradian_three_close( pass, second, clip, light.reversed );
		previous = next;
	}
	clip = steradian_horizon_clip_finish( clip );
	steradian_three_close( pass, second, clip, light.reversed );
}

// GGX with F = 1, and with F = (1 - v.h)^5.
vec2 steradian_three_specular( const in SteradianOutline light, const in mat3 frame, const in vec3 view, const in vec2 alpha ) {
	SteradianPass pass;
	pass.view = steradian_ggx_view( view, max( alpha.x, 1.0e-4 ), max( alpha.y, 1.0e-4 ) );
	pass.sum = vec3( 0.0 );
	pass.cubature = steradian_ggx_cubature_begin( pass.view, pass.sum, 1.0, 1.0 );
	steradian_three_pass( pass, false, light, frame );
	pass.cubature = steradian_ggx_cubature_begin( pass.view, pass.sum, 1.0, light.reversed ? - 1.0 : 1.0 );
	steradian_three_pass( pass, true, light, frame );
	return steradian_ggx_cubature_finish( pass.cubature );
}

#else

// The same by the compact table, whose lobes are isotropic.
vec2 steradian_three_specular( const in SteradianOutline light, const in mat3 frame, const in vec3 view, const in vec2 alpha ) {
	float width = max( sqrt( alpha.x * alpha.y ), 1.0e-4 );
	vec2 place = steradian_ltc_coordinates( sqrt( width ), view.z );
	SteradianLtcMatrix m = steradian_ltc_from_compact( steradian_ltc_ggx_shape( place ), width, view );
	SteradianLtcWalk walk = steradian_ltc_begin();
	vec3 previous = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ light.count - 1 ] ) );
	vec3 transformed = steradian_ltc_direction( m, previous );
	for ( int i = 0; i < STERADIAN_CORNERS; i ++ ) {
		if ( i >= light.count ) break;
		vec3 next = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ i ] ) );
		vec3 next_transformed = steradian_ltc_direction( m, next );
		walk = steradian_ltc_add_edge( walk, m, previous, next, transformed, next_transformed );
		previous = next;
		transformed = next_transformed;
	}
	return steradian_ltc_ggx_magnitude( place ) * steradian_ltc_integral( walk, light.reversed );
}

#endif

vec3 steradian_three_fresnel( const in vec2 part, const in vec3 f0, const in float f90 ) {
	return f0 * ( part.x - part.y ) + f90 * part.y;
}

// Adds what a light of this radiance sends from the surface to the eye. diffuse: of the light, as steradian_three_diffuse.
void steradian_three_add( const in SteradianOutline light, const in float diffuse, const in vec3 radiance, const in vec3 normal, const in vec3 view,
	const in vec3 coatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.directDiffuse += radiance * material.diffuseContribution * diffuse;
	if ( dot( normal, view ) > 0.0 ) {
		float alpha = material.roughness * material.roughness;
		vec2 widths = vec2( alpha );
		#if defined( USE_ANISOTROPY ) && defined( STERADIAN_CLOSED_FORM )
			mat3 frame = steradian_frame_from_normal_and_view( normal, material.anisotropyT );
			widths.x = max( material.alphaT, alpha );
		#else
			mat3 frame = steradian_frame_from_normal_and_view( normal, view );
		#endif
		vec2 part = steradian_three_specular( light, frame, steradian_transform_transposed( frame, view ), widths );
		reflectedLight.directSpecular += radiance * steradian_three_fresnel( part, material.specularColorBlended, material.specularF90 );
	}
	#ifdef USE_CLEARCOAT
		if ( dot( coatNormal, view ) > 0.0 ) {
			mat3 coat = steradian_frame_from_normal_and_view( coatNormal, view );
			vec2 widths = vec2( material.clearcoatRoughness * material.clearcoatRoughness );
			vec2 part = steradian_three_specular( light, coat, steradian_transform_transposed( coat, view ), widths );
			clearcoatSpecularDirect += radiance * steradian_three_fresnel( part, material.clearcoatF0, material.clearcoatF90 );
		}
	#endif
}

// An ellipse seen from the shading point: its diffuse part exactly, the others by a polygon of 12 corners about the lobe.
void steradian_three_add_ellipse( const in vec3 center, const in vec3 axisA, const in vec3 axisB, const in vec3 radiance, const in vec3 normal,
	const in vec3 view, const in vec3 coatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	mat3 frame = steradian_frame_from_normal( normal );
	SteradianEllipse ellipse = steradian_ellipse_prepare( steradian_transform_transposed( frame, center ),
		steradian_transform_transposed( frame, axisA ), steradian_transform_transposed( frame, axisB ) );
	float diffuse = steradian_lambert_radiance( steradian_ellipse_irradiance_vector( ellipse ).z );
	vec3 mirror = steradian_phong_mirror( steradian_transform_transposed( frame, view ) );
	float alpha = material.roughness * material.roughness;
	SteradianEllipseFan fan = steradian_ellipse_fan_concentrated( ellipse, mirror, 2.0 * alpha );
	SteradianOutline light;
	light.count = 12;
	light.reversed = false;
	for ( int i = 0; i < 12; i ++ ) light.corner[ i ] = steradian_transform( frame, steradian_ellipse_fan_corner( fan, i, 12 ) );
	steradian_three_add( light, diffuse, radiance, normal, view, coatNormal, material, reflectedLight );
}

#if NUM_RECT_AREA_LIGHTS > 0 && defined( STERADIAN_RECTS )

// In the place of three's.
void RE_Direct_RectArea_Steradian( const in RectAreaLight rect, const in vec3 position, const in vec3 normal, const in vec3 view,
	const in vec3 coatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 center = rect.position - position;
	if ( dot( cross( rect.halfHeight, rect.halfWidth ), center ) >= 0.0 ) return; // behind it, or in its plane
	SteradianOutline light;
	light.count = 4;
	light.reversed = false;
	light.corner[ 0 ] = center + rect.halfWidth + rect.halfHeight;
	light.corner[ 1 ] = center - rect.halfWidth + rect.halfHeight;
	light.corner[ 2 ] = center - rect.halfWidth - rect.halfHeight;
	light.corner[ 3 ] = center + rect.halfWidth - rect.halfHeight;
	float diffuse = steradian_three_diffuse( light, steradian_frame_from_normal( normal ) );
	steradian_three_add( light, diffuse, rect.color, normal, view, coatNormal, material, reflectedLight );
}

#undef RE_Direct_RectArea
#define RE_Direct_RectArea RE_Direct_RectArea_Steradian

#endif
`;
