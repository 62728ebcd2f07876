// Light maps of `steradian bake` for GLTFLoader. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { ClampToEdgeWrapping, DataTexture, DataUtils, HalfFloatType, LinearFilter, NoColorSpace, RGBAFormat } from 'three';

/**
 * The plug-in: loader.register( ( parser ) => new GLTFLightMaps( parser ) ). Each mesh that a map is for gets a material with it, as three's lightMap.
 * Materials that show no map stay shared. The map holds the light of lamps, too, unless it was baked with --direct off. gltf.userData.lightMaps lists the
 * groups of lights; setIntensities( { name: factor } ) dims them.
 */
export class GLTFLightMaps {

	constructor( parser ) {

		this.parser = parser;
		this.name = 'STERADIAN_light_maps';
		this.materials = new Map(); // by the file's material and set of coordinates

	}

	async afterRoot( result ) {

		const asked = this.parser.json.extras?.steradian?.lightMap;
		if ( ! asked ) return;
		if ( ! ( asked.encoding in DECODERS ) ) throw new Error( `extras.steradian.lightMap.encoding is '${asked.encoding}': there are ${Object.keys( DECODERS ).join( ', ' )}` );
		const maps = new LightMaps();
		for ( const map of asked.maps ?? [] ) maps.groups.push( await this.groupOf( map, DECODERS[ asked.encoding ] ) );
		if ( maps.groups.length === 0 ) throw new Error( 'extras.steradian.lightMap has no maps: bake the scene again' );
		maps.blend();
		result.userData.lightMaps = maps;
		const meshes = [];
		for ( const scene of result.scenes ) scene.traverse( ( o ) => o.isMesh && o.geometry.userData.steradian?.lightMap && meshes.push( o ) );
		for ( const mesh of meshes ) {

			const set = mesh.geometry.userData.steradian.lightMap.texCoord;
			if ( ! [ 0, 1, 2, 3 ].includes( set ) ) throw new Error( `extras.steradian.lightMap.texCoord is ${set}: three has the sets 0 to 3` );
			maps.texture.channel = set;
			mesh.material = Array.isArray( mesh.material ) ? mesh.material.map( ( m ) => this.materialWith( m, maps.texture ) ) : this.materialWith( mesh.material, maps.texture );

		}

	}

	materialWith( material, map ) {

		if ( ! this.materials.has( material ) ) {

			const own = material.clone();
			own.lightMap = map;
			own.lightMapIntensity = 1;
			this.materials.set( material, own );

		}

		return this.materials.get( material );

	}

	async groupOf( { group, texture, range, intensity = 1 }, decoder ) {

		const json = this.parser.json, image = json.images?.[ json.textures?.[ texture ]?.source ];
		if ( image?.bufferView === undefined ) throw new Error( `extras.steradian.lightMap: textures[ ${texture} ] has no picture in the file` );
		if ( ! ( range > 0 ) ) throw new Error( `extras.steradian.lightMap.range is ${range}: give a number above 0` );
		return { name: group, range, intensity, decoder, ...await pixelsOf( await this.parser.getDependency( 'bufferView', image.bufferView ), decoder ) };

	}

}

// Encodings: the bits and the colour type of the PNG, the bytes of a pixel, and a channel as a fraction of the range.
const DECODERS = {
	RGBM: { bits: 8, type: 6, pixel: 4, words: '8-bit RGBA', fraction: ( bytes, i, c ) => bytes[ 4 * i + c ] * bytes[ 4 * i + 3 ] / ( 255 * 255 ) },
	RGB16: { bits: 16, type: 2, pixel: 6, words: '16-bit RGB', fraction: ( bytes, i, c ) => ( 256 * bytes[ 6 * i + 2 * c ] + bytes[ 6 * i + 2 * c + 1 ] ) / 65535 },
};

/** The maps of a file's groups of lights, and the texture that shows their sum. */
export class LightMaps {

	constructor() {

		this.groups = [];
		this.texture = null;

	}

	/** Factors by the names of groups; others stay. */
	setIntensities( factors ) {

		for ( const name of Object.keys( factors ) ) {

			const group = this.groups.find( ( g ) => g.name === name );
			if ( ! group ) throw new Error( `there is no group '${name}': there are ${this.groups.map( ( g ) => g.name ).join( ', ' )}` );
			group.intensity = factors[ name ];

		}

		this.blend();

	}

	// Texels are decoded before they are blended: blends of RGBM have other colours.
	blend() {

		const { width, height } = this.groups[ 0 ];
		this.texture ??= textureOf( width, height );
		const half = this.texture.image.data;
		for ( let i = 0; i < half.length; i += 4 )
			for ( let c = 0; c < 3; ++ c ) {

				let sum = 0;
				for ( const { bytes, range, intensity, decoder } of this.groups ) sum += decoder.fraction( bytes, i / 4, c ) * range * intensity;
				half[ i + c ] = DataUtils.toHalfFloat( Math.min( sum, 65504 ) );

			}

		this.texture.needsUpdate = true;

	}

}

function textureOf( width, height ) {

	const map = new DataTexture( new Uint16Array( 4 * width * height ).fill( DataUtils.toHalfFloat( 1 ) ), width, height, RGBAFormat, HalfFloatType );
	map.colorSpace = NoColorSpace;
	map.minFilter = map.magFilter = LinearFilter; // a smaller picture would mix charts
	map.wrapS = map.wrapT = ClampToEdgeWrapping;
	return map;

}

// The bytes of a PNG. A canvas would multiply them by their alpha, which is no alpha here, and knows 8 bits alone.
async function pixelsOf( file, { bits, type, pixel, words } ) {

	const view = new DataView( file ), parts = [];
	let width = 0, height = 0;
	for ( let at = 8; at + 12 <= view.byteLength; at += 12 + view.getUint32( at ) ) {

		const size = view.getUint32( at ), kind = view.getUint32( at + 4 );
		if ( kind === 0x49484452 ) { // IHDR

			width = view.getUint32( at + 8 );
			height = view.getUint32( at + 12 );
			if ( view.getUint8( at + 16 ) !== bits || view.getUint8( at + 17 ) !== type || view.getUint8( at + 20 ) !== 0 )
				throw new Error( `the light map is no PNG of ${words}: bake the scene again` );

		}

		if ( kind === 0x49444154 ) parts.push( new Uint8Array( file, at + 8, size ) ); // IDAT

	}

	const stream = new Blob( parts ).stream().pipeThrough( new DecompressionStream( 'deflate' ) );
	const raw = new Uint8Array( await new Response( stream ).arrayBuffer() ), row = pixel * width, bytes = new Uint8Array( row * height );
	if ( raw.length !== ( row + 1 ) * height ) throw new Error( 'the light map is cut off: bake the scene again' );
	for ( let y = 0; y < height; ++ y ) {

		const filter = raw[ y * ( row + 1 ) ];
		for ( let i = 0; i < row; ++ i ) {

			const at = y * row + i, left = i < pixel ? 0 : bytes[ at - pixel ], up = y === 0 ? 0 : bytes[ at - row ];
			let guess = 0;
			if ( filter === 1 ) guess = left;
			if ( filter === 2 ) guess = up;
			if ( filter === 3 ) guess = ( left + up ) >> 1;
			if ( filter === 4 ) guess = paeth( left, up, i < pixel || y === 0 ? 0 : bytes[ at - row - pixel ] );
			bytes[ at ] = raw[ y * ( row + 1 ) + 1 + i ] + guess;

		}

	}

	return { width, height, bytes };

}

// PNG's predictor: that of the three neighbours which is nearest to left + up - corner.
function paeth( left, up, corner ) {

	const to_left = Math.abs( up - corner ), to_up = Math.abs( left - corner ), to_corner = Math.abs( left + up - 2 * corner );
	return to_left <= to_up && to_left <= to_corner ? left : to_up <= to_corner ? up : corner;

}
