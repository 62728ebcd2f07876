// Renders the case in the address (?case=JSON) by WebGPURenderer, in WebGL where case.webgl, and posts the floats to case.post, the lowest row first.
import * as THREE from 'three/webgpu';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { DiskAreaLight, GLTFAreaLights, PolygonAreaLight, SphereAreaLight, SteradianLightNode, TubeAreaLight, registerAreaLights } from 'three-steradian/webgpu';

const c = JSON.parse( new URLSearchParams( location.search ).get( 'case' ) );
const send = ( words ) => fetch( c.post, { method: 'POST', mode: 'no-cors', body: words } );

const points = ( list ) => list.map( ( p ) => new THREE.Vector2( ...p ) );

function lightOf( l ) {

	const color = new THREE.Color().setRGB( ...l.radiance );
	let light;
	if ( l.type === 'rect' ) light = new THREE.RectAreaLight( color, 1, l.width, l.height );
	if ( l.type === 'polygon' ) light = new PolygonAreaLight( color, 1, points( l.outline ), ( l.holes || [] ).map( points ) );
	if ( l.type === 'disk' ) light = new DiskAreaLight( color, 1, l.radius, l.radius );
	if ( l.type === 'sphere' ) light = new SphereAreaLight( color, 1, l.radius );
	if ( l.type === 'tube' ) light = new TubeAreaLight( color, 1, l.length, l.radius );
	light.twoSided = l.two_sided || false;
	light.matrixAutoUpdate = false;
	light.matrix.fromArray( l.matrix );
	return light;

}

async function pixelsBy( method ) {

	const renderer = new THREE.WebGPURenderer( { forceWebGL: c.webgl } );
	await renderer.init();
	if ( ! c.webgl && ! renderer.backend.isWebGPUBackend ) return 'none';
	if ( c.byLibrary ) { // the older form of the plug-in interface, by hand

		SteradianLightNode.method = method;
		for ( const Light of [ PolygonAreaLight, DiskAreaLight, SphereAreaLight, TubeAreaLight, THREE.RectAreaLight ] ) renderer.library.addLight( SteradianLightNode, Light );

	} else registerAreaLights( renderer, { method } );
	const scene = new THREE.Scene();
	const material = new THREE.MeshPhysicalNodeMaterial( { roughness: c.roughness, metalness: c.metalness, sheen: c.sheen ? 1 : 0, sheenRoughness: c.sheenRoughness || 1,
		anisotropy: c.anisotropy || 0, side: THREE.DoubleSide } );
	material.color.setRGB( ...c.color );
	if ( c.sheen ) material.sheenColor.setRGB( ...c.sheen );
	for ( const l of c.lights ) scene.add( lightOf( l ) );
	if ( c.gltf ) scene.add( ( await new GLTFLoader().register( ( parser ) => new GLTFAreaLights( parser ) ).parseAsync( JSON.stringify( c.gltf ), '' ) ).scene );
	const floor = new THREE.Mesh( new THREE.PlaneGeometry( 40, 40, 80, 80 ), material );
	floor.rotation.x = - Math.PI / 2;
	scene.add( floor );
	const camera = new THREE.PerspectiveCamera( c.fov, c.width / c.height, 0.1, 1000 );
	camera.position.set( ...c.eye );
	camera.lookAt( 0, 0, 0 );
	const target = new THREE.RenderTarget( c.width, c.height, { type: THREE.FloatType } );
	renderer.setRenderTarget( target );
	await renderer.renderAsync( scene, camera );
	const read = new Float32Array( ( await renderer.readRenderTargetPixelsAsync( target, 0, 0, c.width, c.height ) ).buffer );
	// WebGPU pads rows to 256 bytes and has the highest first.
	const gpu = renderer.backend.isWebGPUBackend, row = gpu ? Math.ceil( 16 * c.width / 256 ) * 64 : 4 * c.width, pixels = new Float32Array( 4 * c.width * c.height );
	for ( let j = 0; j < c.height; ++ j ) {

		const from = ( gpu ? c.height - 1 - j : j ) * row;
		pixels.set( read.subarray( from, from + 4 * c.width ), 4 * c.width * j );

	}

	let text = '';
	const bytes = new Uint8Array( pixels.buffer );
	for ( let i = 0; i < bytes.length; i += 8192 ) text += String.fromCharCode( ...bytes.subarray( i, i + 8192 ) );
	return btoa( text );

}

const problems = [], error = console.error;
console.error = ( ...words ) => {

	problems.push( words.join( ' ' ) );
	error( ...words );

};
try {

	const found = [];
	for ( const method of c.methods ) found.push( await pixelsBy( method ) );
	await send( problems.length ? `failed: ${problems.join( '\n' ).slice( 0, 3000 )}` : found.join( ' ' ) );

} catch ( e ) {

	await send( `failed: ${e.stack} ${problems.join( '\n' ).slice( 0, 3000 )}` );

}
