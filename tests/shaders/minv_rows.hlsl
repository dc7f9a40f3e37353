// Row-major HLSL with its own constant buffer and entry point. COMPONENTS is a trap of the language: operator * multiplies
// matrices component by component.
cbuffer Frame : register(b0) {
    row_major float4x4 View : packoffset(c0);
    float Scale : packoffset(c4);
};
Texture2D<float4> Table : register(t0);
SamplerState Clamp : register(s0);

float3 Edge(float3 a, float3 b)
{
    float cosine = dot(a, b);
    float angle = atan2(length(cross(a, b)), cosine);
    float3 normal = cross(a, b);
    float size = length(normal);
    return size > 0.0 ? normal * (angle / size) : float3(0.0, 0.0, 0.0);
}

// Vector irradiance of a triangle of a quad over a floor, before any horizon, times Scale.
float Quad(float3x3 Minv, float3 p0, float3 p1, float3 p2, float3 p3)
{
    float3x3 corners = float3x3(p0, p1, p2);
#ifdef COMPONENTS
    float3x3 turned = Minv * transpose(corners);
#else
    float3x3 turned = mul(Minv, transpose(corners));
#endif
    float3 a = normalize(float3(turned[0].x, turned[1].x, turned[2].x));
    float3 b = normalize(float3(turned[0].y, turned[1].y, turned[2].y));
    float3 c = normalize(float3(turned[0].z, turned[1].z, turned[2].z));
    float3 d = normalize(mul(Minv, p3));
    float3 sum = Edge(a, b) + Edge(b, c) + Edge(c, d) + Edge(d, a);
    return abs(sum.z) / 6.283185307 * Scale;
}

float4 Pixel(float2 uv : TEXCOORD0) : SV_Target
{
    return Table.Sample(Clamp, uv) * ddx(uv.x);
}

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
}
