#include "steradian.hlsl"

cbuffer Scene : register(b0) {
    float4 eye;
    float4 corners[4];  // of the light
    float4 radiance;    // of the light
    float4 albedo;
    float4 f0;          // w: roughness
};

float4 main(float3 position : POSITION, float3 normal : NORMAL) : SV_Target {
    float3 n = normalize(normal);
    float3 v = normalize(eye.xyz - position);
    float3 a = corners[0].xyz, b = corners[1].xyz, c = corners[2].xyz, d = corners[3].xyz;
    float3 specular = steradian_ggx_quad(position, n, v, a, b, c, d, f0.w, f0.xyz);
    float diffuse = steradian_lambert_quad(position, n, a, b, c, d);
    return float4(radiance.rgb * (albedo.rgb * diffuse + specular), 1.0);
}
