struct Scene {
    eye: vec4f,
    corners: array<vec4f, 4>,  // of the light
    radiance: vec4f,           // of the light
    albedo: vec4f,
    f0: vec4f,                 // w: roughness
}
@group(0) @binding(0) var<uniform> scene: Scene;

@fragment
fn main(@location(0) position: vec3f, @location(1) normal: vec3f) -> @location(0) vec4f {
    let n = normalize(normal);
    let v = normalize(scene.eye.xyz - position);
    let a = scene.corners[0].xyz;
    let b = scene.corners[1].xyz;
    let c = scene.corners[2].xyz;
    let d = scene.corners[3].xyz;
    let specular = steradian_ggx_quad(position, n, v, a, b, c, d, scene.f0.w, scene.f0.xyz);
    let diffuse = steradian_lambert_quad(position, n, a, b, c, d);
    return vec4f(scene.radiance.rgb * (scene.albedo.rgb * diffuse + specular), 1.0);
}
