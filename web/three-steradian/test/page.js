// Renders the case in the address (?case=JSON) into floats, and leaves them in the page as base64: three_test.py reads them there.
import * as THREE from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { AreaLightSet, DiskAreaLight, GLTFAreaLights, PolygonAreaLight, SphereAreaLight, TubeAreaLight, SteradianRectAreaLightUniformsLib, useSteradian } from 'three-steradian';

const answer = document.getElementById( 'answer' );

const points = ( list ) => list.map( ( p ) => new THREE.Vector2( ...p ) );

function lightOf( l ) {

	const color = new THREE.Color().setRGB( ...l.radiance );
	let light;
	if ( l.type === 'rect' ) light = new THREE.RectAreaLight( color, 1, l.width, l.height );
	if ( l.type === 'polygon' ) light = new PolygonAreaLight( color, 1, points( l.outline ), ( l.holes || [] ).map( points ) );
	if ( l.type === 'tube' ) light = new TubeAreaLight( color, 1, l.length, l.radius );
	if ( l.type === 'disk' ) light = new DiskAreaLight( color, 1, l.radius, l.radius );
	if ( l.type === 'sphere' ) light = new SphereAreaLight( color, 1, l.radius );
	light.twoSided = l.two_sided || false;
	light.matrixAutoUpdate = false;
	light.matrix.fromArray( l.matrix );
	return light;

}

async function pixelsBy( method, c ) {

	const renderer = new THREE.WebGLRenderer();
	renderer.debug.onShaderError = ( gl, program, vertex, fragment ) => {

		throw new Error( gl.getShaderInfoLog( fragment ) || gl.getProgramInfoLog( program ) );

	};
	if ( method === 'three' ) RectAreaLightUniformsLib.init();
	if ( method === 'tables' ) SteradianRectAreaLightUniformsLib.init();

	const scene = new THREE.Scene();
	const material = new THREE.MeshPhysicalMaterial( { roughness: c.roughness, metalness: c.metalness, clearcoat: c.clearcoat || 0,
		clearcoatRoughness: 0.2, sheen: c.sheen ? 1 : 0, sheenRoughness: c.sheenRoughness || 1, anisotropy: c.anisotropy || 0, side: THREE.DoubleSide } );
	material.color.setRGB( ...c.color );
	if ( c.sheen ) material.sheenColor.setRGB( ...c.sheen );
	const lights = c.lights.map( lightOf );
	for ( const light of lights ) scene.add( light );
	if ( c.gltf ) {

		const gltf = await new GLTFLoader().register( ( parser ) => new GLTFAreaLights( parser ) ).parseAsync( JSON.stringify( c.gltf ), '' );
		scene.add( gltf.scene );
		lights.push( ...gltf.userData.areaLights );

	}

	if ( method === 'compact' || method === 'closed-form' )
		useSteradian( material, { method, lights: new AreaLightSet( lights.filter( ( l ) => ! l.isRectAreaLight ) ) } );
	// Made of small triangles: SwiftShader places the fragments of large ones up to a pixel off.
	const floor = new THREE.Mesh( new THREE.PlaneGeometry( 40, 40, 80, 80 ), material );
	floor.rotation.x = - Math.PI / 2;
	scene.add( floor );

	const camera = new THREE.PerspectiveCamera( c.fov, c.width / c.height, 0.1, 1000 );
	camera.position.set( ...c.eye );
	camera.lookAt( 0, 0, 0 );
	const target = new THREE.WebGLRenderTarget( c.width, c.height, { type: THREE.FloatType } );
	renderer.setRenderTarget( target );
	renderer.render( scene, camera );
	const pixels = new Float32Array( 4 * c.width * c.height );
	renderer.readRenderTargetPixels( target, 0, 0, c.width, c.height, pixels );
	const bytes = new Uint8Array( pixels.buffer );
	let text = '';
	for ( let i = 0; i < bytes.length; i += 8192 ) text += String.fromCharCode( ...bytes.subarray( i, i + 8192 ) );
	renderer.dispose();
	return btoa( text );

}

async function main() {

	const c = JSON.parse( new URLSearchParams( location.search ).get( 'case' ) );
	const pixels = [];
	for ( const method of c.methods ) pixels.push( await pixelsBy( method, c ) );
	answer.textContent = `pixels:${pixels.join( ' ' )}:`;

}

try {

	await main();

} catch ( e ) {

	answer.textContent = `failed:${e.message}:`;

}
