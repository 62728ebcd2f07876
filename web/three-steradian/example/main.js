// One light over several materials, by this package and by three's own shader. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import * as THREE from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { useSteradian } from 'three-steradian';

const $ = ( id ) => document.getElementById( id );
RectAreaLightUniformsLib.init();
const renderer = new THREE.WebGLRenderer( { canvas: $( 'canvas' ), antialias: true } );
renderer.setScissorTest( true );
renderer.toneMapping = THREE.NeutralToneMapping;
const camera = new THREE.PerspectiveCamera( 40, 1, 0.1, 100 );
camera.position.set( 0, 1.7, 4.2 );
camera.lookAt( 0, 0.45, 0 );

const MATERIALS = [ // colour, metalness, share of the slider's roughness, clear coat
	[ 0xffc457, 1, 1, 0 ], [ 0xc8ccd0, 1, 0.6, 0 ], [ 0x9c2a22, 0, 1, 0 ], [ 0x2a4f86, 0, 1.6, 1 ],
];

// The scene, its materials as they come or handed to this package.
function sceneBy( method ) {

	const scene = new THREE.Scene(), materials = [];
	const material = ( color, metalness, share, clearcoat ) => {

		const m = new THREE.MeshPhysicalMaterial( { color, metalness, clearcoat, clearcoatRoughness: 0.15 } );
		m.userData.share = share;
		materials.push( m );
		return method ? useSteradian( m, { method } ) : m;

	};

	const floor = new THREE.Mesh( new THREE.PlaneGeometry( 12, 12, 40, 40 ), material( 0x8a8780, 0, 1, 0 ) );
	floor.rotation.x = - Math.PI / 2;
	scene.add( floor );
	MATERIALS.forEach( ( m, i ) => {

		const ball = new THREE.Mesh( new THREE.SphereGeometry( 0.34, 96, 64 ), material( ...m ) );
		ball.position.set( ( i - 1.5 ) * 0.85, 0.34, 0.3 );
		scene.add( ball );

	} );
	const light = new THREE.RectAreaLight( 0xfff2e0, 6, 1.2, 0.6 );
	const panel = new THREE.Mesh( new THREE.PlaneGeometry( 1.2, 0.6 ), new THREE.MeshBasicMaterial( { color: 0xffffff, side: THREE.BackSide } ) );
	light.add( panel );
	scene.add( light );
	return { scene, materials, light };

}

const scenes = { 'closed-form': sceneBy( 'closed-form' ), compact: sceneBy( 'compact' ), three: sceneBy( null ) };
const place = new THREE.Vector3( - 1.3, 0.9, 1.1 );

function settle() {

	for ( const { light, materials } of Object.values( scenes ) ) {

		light.position.copy( place );
		light.lookAt( place.x * 0.1, 0.25, 0.2 ); // three's lights shine along their -z, and lookAt turns lights so
		for ( const m of materials ) m.roughness = Math.min( 1, m.userData.share * Number( $( 'roughness' ).value ) );

	}

}

// Relative root mean square from the closed form, over a small picture in floats.
const target = new THREE.WebGLRenderTarget( 192, 108, { type: THREE.FloatType } );
function pixelsOf( scene ) {

	const pixels = new Float32Array( 4 * 192 * 108 );
	renderer.setRenderTarget( target );
	renderer.setScissorTest( false );
	camera.aspect = 192 / 108;
	camera.updateProjectionMatrix();
	renderer.render( scene, camera );
	renderer.readRenderTargetPixels( target, 0, 0, 192, 108, pixels );
	renderer.setRenderTarget( null );
	renderer.setScissorTest( true );
	return pixels;

}

function off( a, best ) {

	let square = 0, sum = 0;
	for ( let i = 0; i < a.length; ++ i ) {

		if ( i % 4 === 3 ) continue;
		square += ( a[ i ] - best[ i ] ) ** 2;
		sum += best[ i ] ** 2;

	}

	return `${( 100 * Math.sqrt( square / sum ) ).toFixed( 1 )} % rms`;

}

function draw() {

	settle();
	const { clientWidth, clientHeight } = $( 'canvas' ), half = clientWidth / 2;
	renderer.setPixelRatio( Math.min( devicePixelRatio, 2 ) );
	renderer.setSize( clientWidth, clientHeight, false );
	camera.aspect = half / clientHeight;
	camera.updateProjectionMatrix();
	[ $( 'method' ).value, 'three' ].forEach( ( name, i ) => {

		renderer.setViewport( i * half, 0, half, clientHeight );
		renderer.setScissor( i * half, 0, half, clientHeight );
		renderer.render( scenes[ name ].scene, camera );

	} );

}

let settled = 0;
function redraw() {

	requestAnimationFrame( draw );
	clearTimeout( settled );
	settled = setTimeout( () => {

		const best = pixelsOf( scenes[ 'closed-form' ].scene );
		$( 'ours' ).textContent = $( 'method' ).value === 'compact' ? off( pixelsOf( scenes.compact.scene ), best ) : 'it is the closed form';
		$( 'theirs' ).textContent = off( pixelsOf( scenes.three.scene ), best );
		draw();

	}, 200 );

}

function move( dx, dz ) {

	place.x = Math.max( - 3, Math.min( 3, place.x + dx ) );
	place.z = Math.max( - 3, Math.min( 2, place.z + dz ) );
	redraw();

}

const canvas = $( 'canvas' );
canvas.addEventListener( 'pointerdown', ( e ) => canvas.setPointerCapture( e.pointerId ) );
canvas.addEventListener( 'pointermove', ( e ) => e.buttons && move( e.movementX * 0.006, e.movementY * 0.006 ) );
canvas.addEventListener( 'keydown', ( e ) => {

	const step = { ArrowLeft: [ - 0.1, 0 ], ArrowRight: [ 0.1, 0 ], ArrowUp: [ 0, - 0.1 ], ArrowDown: [ 0, 0.1 ] }[ e.key ];
	if ( ! step ) return;
	e.preventDefault();
	move( ...step );

} );
$( 'height' ).oninput = () => {

	place.y = Number( $( 'height' ).value );
	redraw();

};
$( 'method' ).oninput = $( 'roughness' ).oninput = redraw;
addEventListener( 'resize', redraw );
renderer.debug.onShaderError = ( gl, program, vertex, fragment ) => $( 'problem' ).textContent = gl.getShaderInfoLog( fragment );
redraw();
