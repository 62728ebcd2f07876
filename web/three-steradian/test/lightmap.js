// Draws a baked scene by its light map alone, and leaves the linear pixels in the page as base64: lightmap_test.py reads them there.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { GLTFLightMaps } from 'three-steradian';

const answer = document.getElementById( 'answer' );

async function main() {

	const width = 320, height = 240;
	const gltf = await new GLTFLoader().register( ( parser ) => new GLTFLightMaps( parser ) ).loadAsync( '/scratch/baked.glb' );
	const scene = new THREE.Scene(), camera = gltf.cameras[ 0 ];
	scene.add( gltf.scene );
	scene.updateMatrixWorld( true );
	camera.aspect = width / height;
	camera.updateProjectionMatrix();
	let maps = 0;
	scene.traverse( ( o ) => { if ( o.isMesh && o.material.lightMap ) ++ maps; } );
	if ( maps === 0 ) throw new Error( 'no mesh has a light map' );
	const renderer = new THREE.WebGLRenderer();
	renderer.debug.onShaderError = ( gl, program, vertex, fragment ) => { throw new Error( gl.getShaderInfoLog( fragment ) ); };
	const target = new THREE.WebGLRenderTarget( width, height, { type: THREE.FloatType } );
	renderer.setRenderTarget( target );
	renderer.render( scene, camera );
	const pixels = new Float32Array( 4 * width * height );
	renderer.readRenderTargetPixels( target, 0, 0, width, height, pixels );
	const bytes = new Uint8Array( pixels.buffer );
	let text = '';
	for ( let i = 0; i < bytes.length; i += 8192 ) text += String.fromCharCode( ...bytes.subarray( i, i + 8192 ) );
	answer.textContent = `pixels:${btoa( text )}:`;

}

try {

	await main();

} catch ( e ) {

	answer.textContent = `failed:${e.message}:`;

}
