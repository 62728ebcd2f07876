// Renders the case in the address (?case=JSON) into floats, and leaves them in the page as base64: three_test.py reads them there.
import * as THREE from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { AreaLightSet, DiskAreaLight, PolygonAreaLight, SphereAreaLight, SteradianRectAreaLightUniformsLib, useSteradian } from 'three-steradian';

const answer = document.getElementById( 'answer' );

function lightOf( l ) {

	const color = new THREE.Color().setRGB( ...l.radiance );
	let light;
	if ( l.type === 'rect' ) light = new THREE.RectAreaLight( color, 1, l.width, l.height );
	if ( l.type === 'polygon' ) light = new PolygonAreaLight( color, 1, l.outline.map( ( p ) => new THREE.Vector2( ...p ) ) );
	if ( l.type === 'disk' ) light = new DiskAreaLight( color, 1, l.radius, l.radius );
	if ( l.type === 'sphere' ) light = new SphereAreaLight( color, 1, l.radius );
	light.matrixAutoUpdate = false;
	light.matrix.fromArray( l.matrix );
	return light;

}

function pixelsBy( method, c ) {

	const renderer = new THREE.WebGLRenderer();
	renderer.debug.onShaderError = ( gl, program, vertex, fragment ) => {

		throw new Error( gl.getShaderInfoLog( fragment ) || gl.getProgramInfoLog( program ) );

	};
	if ( method === 'three' ) RectAreaLightUniformsLib.init();
	if ( method === 'tables' ) SteradianRectAreaLightUniformsLib.init();

	const scene = new THREE.Scene();
	const material = new THREE.MeshPhysicalMaterial( { roughness: c.roughness, metalness: c.metalness, clearcoat: c.clearcoat || 0,
		clearcoatRoughness: 0.2, side: THREE.DoubleSide } );
	material.color.setRGB( ...c.color );
	const lights = c.lights.map( lightOf );
	for ( const light of lights ) scene.add( light );
	if ( method === 'compact' || method === 'closed-form' )
		useSteradian( material, { method, lights: new AreaLightSet( lights.filter( ( l ) => ! l.isRectAreaLight ) ) } );
	// Of small triangles: SwiftShader places the fragments of large ones up to a pixel off.
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

function main() {

	const c = JSON.parse( new URLSearchParams( location.search ).get( 'case' ) );
	answer.textContent = 'pixels:' + c.methods.map( ( method ) => pixelsBy( method, c ) ).join( ' ' ) + ':';

}

try {

	main();

} catch ( e ) {

	answer.textContent = `failed:${e.message}:`;

}
