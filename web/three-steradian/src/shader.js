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

// Anisotropic lobes have no compact table: they are done in closed form by both methods.
#if defined( STERADIAN_CLOSED_FORM ) || defined( USE_ANISOTROPY )
#define STERADIAN_BASE_CLOSED_FORM
#endif

#if defined( STERADIAN_BASE_CLOSED_FORM ) || defined( USE_SHEEN )

// Edges above the horizon, the arcs of the horizon that close them among them.
#define STERADIAN_EDGES ( 2 * STERADIAN_CORNERS + 4 )
vec3 steradianEdgeBegin[ STERADIAN_EDGES ];
vec3 steradianEdgeEnd[ STERADIAN_EDGES ];
int steradianEdgeCount;

void steradian_three_edge( const in vec3 a, const in vec3 b ) {
	vec3 chord = b - a;
	if ( dot( chord, chord ) < 1.0e-14 || steradianEdgeCount >= STERADIAN_EDGES ) return;
	steradianEdgeBegin[ steradianEdgeCount ] = a;
	steradianEdgeEnd[ steradianEdgeCount ] = b;
	steradianEdgeCount ++;
}

void steradian_three_close( const in SteradianHorizonClip clip, const in float facing ) {
	if ( ! clip.closes ) return;
	vec3 start = clip.arc_start;
	if ( steradian_horizon_arc_wide( start, clip.arc_end ) ) {
		vec3 middle = steradian_horizon_arc_middle( start, clip.arc_end, facing );
		steradian_three_edge( start, middle );
		start = middle;
	}
	steradian_three_edge( start, clip.arc_end );
}

void steradian_three_edges( const in SteradianOutline light, const in mat3 frame ) {
	steradianEdgeCount = 0;
	float facing = light.reversed ? - 1.0 : 1.0;
	SteradianHorizonClip clip = steradian_horizon_clip_begin();
	vec3 previous = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ light.count - 1 ] ) );
	for ( int i = 0; i < STERADIAN_CORNERS; i ++ ) {
		if ( i >= light.count ) break;
		vec3 next = steradian_polygon_direction( steradian_transform_transposed( frame, light.corner[ i ] ) );
		clip = steradian_horizon_clip_edge( clip, previous, next );
		steradian_three_edge( clip.start, clip.end );
		steradian_three_close( clip, facing );
		previous = next;
	}
	clip = steradian_horizon_clip_finish( clip );
	steradian_three_close( clip, facing );
}

#endif

#ifdef STERADIAN_BASE_CLOSED_FORM

// GGX with F = 1, and with F = (1 - v.h)^5.
vec2 steradian_three_closed_form( const in SteradianOutline light, const in mat3 frame, const in vec3 view, const in vec2 alpha ) {
	float facing = light.reversed ? - 1.0 : 1.0;
	steradian_three_edges( light, frame );
	SteradianGgxView ggx = steradian_ggx_view( view, max( alpha.x, 1.0e-4 ), max( alpha.y, 1.0e-4 ) );
	vec3 sum = vec3( 0.0 );
	for ( int i = 0; i < steradianEdgeCount; i ++ ) sum += steradian_conic_vector( steradian_ggx_edge( ggx, steradianEdgeBegin[ i ], steradianEdgeEnd[ i ] ) );
	SteradianGgxCubature c = steradian_ggx_cubature_begin( ggx, sum, 1.0, facing );
	for ( int i = 0; i < steradianEdgeCount; i ++ ) c = steradian_ggx_cubature_edge( c, steradian_ggx_edge( ggx, steradianEdgeBegin[ i ], steradianEdgeEnd[ i ] ), 0 );
	return steradian_ggx_cubature_finish( c );
}

#endif

#ifdef USE_SHEEN

// The radiance that fibres of colour 1 send to the view: Charlie's lobe by its cubature. The outline may be one about a mirror's lobe.
float steradian_three_sheen( const in SteradianOutline light, const in mat3 frame, const in vec3 view, const in float roughness ) {
	float facing = light.reversed ? - 1.0 : 1.0;
	steradian_three_edges( light, frame );
	SteradianCharlieLobe lobe = steradian_charlie_prepare( view, max( roughness * roughness, 1.0e-4 ) );
	vec3 sum = vec3( 0.0 );
	for ( int i = 0; i < steradianEdgeCount; i ++ ) sum += steradian_polygon_edge( steradianEdgeBegin[ i ], steradianEdgeEnd[ i ] );
	SteradianCharlieCubature c = steradian_charlie_cubature_begin( lobe, sum, facing );
	for ( int i = 0; i < steradianEdgeCount; i ++ ) c = steradian_charlie_cubature_edge( c, steradianEdgeBegin[ i ], steradianEdgeEnd[ i ] );
	return steradian_charlie_cubature_finish( c );
}

// The fraction that reaches the surface below the fibres.
float steradian_three_below_sheen( const in PhysicalMaterial material, const in vec3 view ) {
	vec3 turned = vec3( sqrt( max( 1.0 - view.z * view.z, 0.0 ) ), 0.0, view.z );
	vec2 place = steradian_ltc_coordinates( material.sheenRoughness, view.z );
	SteradianLtcMatrix m = steradian_ltc_from_compact( steradian_ltc_charlie_shape( place ), material.sheenRoughness * material.sheenRoughness, turned );
	float albedo = steradian_ltc_charlie_magnitude( place ).x * steradian_ltc_energy_above_horizon( m );
	return steradian_ltc_sheen( 1.0, 0.0, max( material.sheenColor.x, max( material.sheenColor.y, material.sheenColor.z ) ), albedo );
}

#endif

#ifdef STERADIAN_CLOSED_FORM

vec2 steradian_three_specular( const in SteradianOutline light, const in mat3 frame, const in vec3 view, const in vec2 alpha ) {
	return steradian_three_closed_form( light, frame, view, alpha );
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
	vec3 below = radiance;
	#ifdef USE_SHEEN
		mat3 cloth = steradian_frame_from_normal( normal );
		vec3 clothView = steradian_transform_transposed( cloth, view );
		if ( clothView.z > 0.0 ) {
			sheenSpecularDirect += radiance * material.sheenColor * steradian_three_sheen( light, cloth, clothView, material.sheenRoughness );
			below *= steradian_three_below_sheen( material, clothView );
		}
	#endif
	reflectedLight.directDiffuse += below * material.diffuseContribution * diffuse;
	if ( dot( normal, view ) > 0.0 ) {
		float alpha = material.roughness * material.roughness;
		#ifdef USE_ANISOTROPY
			mat3 frame = steradian_frame_from_normal_and_view( normal, material.anisotropyT );
			vec2 part = steradian_three_closed_form( light, frame, steradian_transform_transposed( frame, view ), vec2( max( material.alphaT, alpha ), alpha ) );
		#else
			mat3 frame = steradian_frame_from_normal_and_view( normal, view );
			vec2 part = steradian_three_specular( light, frame, steradian_transform_transposed( frame, view ), vec2( alpha ) );
		#endif
		reflectedLight.directSpecular += below * steradian_three_fresnel( part, material.specularColorBlended, material.specularF90 );
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

// A tube from end to end: as an ellipse.
void steradian_three_add_tube( const in vec3 endA, const in vec3 endB, const in float radius, const in vec3 radiance, const in vec3 normal,
	const in vec3 view, const in vec3 coatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	mat3 frame = steradian_frame_from_normal( normal );
	SteradianCapsule tube = steradian_capsule_prepare( steradian_transform_transposed( frame, endA ), steradian_transform_transposed( frame, endB ), radius );
	if ( ! tube.outside ) return;
	float diffuse = steradian_lambert_radiance( steradian_capsule_irradiance_vector( tube ).z );
	vec3 mirror = steradian_phong_mirror( steradian_transform_transposed( frame, view ) );
	float alpha = material.roughness * material.roughness;
	SteradianCapsuleFan fan = steradian_capsule_fan( tube, mirror, 2.0 * alpha, 12 );
	SteradianOutline light;
	light.count = 12;
	light.reversed = false;
	for ( int i = 0; i < 12; i ++ ) light.corner[ i ] = steradian_transform( frame, steradian_capsule_fan_corner( fan, i ) );
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
