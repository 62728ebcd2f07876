in vec3 position;      // of the surface
in vec3 normal;
out vec4 color;        // linear
uniform vec3 eye;
uniform vec3 corners[4];  // of the light
uniform vec3 radiance;    // of the light
uniform vec3 albedo;
uniform vec3 f0;
uniform float roughness;

void main() {
    vec3 n = normalize(normal);
    vec3 v = normalize(eye - position);
    vec3 a = corners[0], b = corners[1], c = corners[2], d = corners[3];
    vec3 specular = steradian_ggx_quad(position, n, v, a, b, c, d, roughness, f0);
    float diffuse = steradian_lambert_quad(position, n, a, b, c, d);
    color = vec4(radiance * (albedo * diffuse + specular), 1.0);
}
