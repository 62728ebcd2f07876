"""Words that a kernel must not use as a name, because some language that reads kernels keeps them for itself."""

_WORDS = {
    "C++": """alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t char8_t class
        co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue decltype
        default delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline
        int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public register
        reinterpret_cast requires return short signed sizeof static static_assert static_cast struct switch template
        this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t
        while xor xor_eq""",
    "GLSL": """active asm atomic_uint attribute buffer bvec2 bvec3 bvec4 cast centroid class coherent common const
        discard dmat2 dmat3 dmat4 double dvec2 dvec3 dvec4 enum extern external filter fixed flat fvec2 fvec3 fvec4
        goto half highp hvec2 hvec3 hvec4 image1D image2D image3D imageBuffer imageCube inline inout in input interface
        invariant isampler2D iimage2D isubroutine ivec2 ivec3 ivec4 layout long lowp mat2 mat4 mediump namespace
        noinline noperspective out output partition patch precise precision public readonly resource restrict sample
        sampler1D sampler2D sampler2DShadow sampler3D samplerCube shared short sizeof smooth static subroutine superp
        template this typedef uimage2D uint uniform union unsigned usampler2D using uvec2 uvec3 uvec4 varying volatile
        writeonly gl_Position texture main""",
    "HLSL": """AppendStructuredBuffer BlendState Buffer ByteAddressBuffer cbuffer class column_major compile
        ConsumeStructuredBuffer ComputeShader DepthStencilState DomainShader dword export extern float2 float3 float4
        float3x3 fxgroup GeometryShader groupshared half HullShader InputPatch interface line lineadj linear
        LineStream matrix min10float min12int min16float min16int min16uint nointerpolation NULL OutputPatch
        packoffset pass pixelfragment PixelShader point PointStream RasterizerState register row_major RWBuffer
        sampler SamplerState snorm stateblock string StructuredBuffer tbuffer technique Texture2D triangle triangleadj
        TriangleStream typename unorm vector vertexfragment VertexShader""",
    "WGSL": """Self abstract alias array as async atomic await become binding_array bitcast const_assert crate debugger
        demote demote_to_helper diagnostic do enable f16 f32 finally fn from get i32 impl implements import instanceof
        let loop macro macro_rules match meta mod module move mut native nil non_coherent noncoherent null of override
        package pixelfragment premerge priv proc ptr pub ref regardless require self set std super target trait type
        typeof u32 unless unsafe unsized use var wgsl where with writeonly yield vec2f vec3f vec4f""",
    "Metal": """access bfloat constant depth2d device fragment imageblock intersection kernel metal packed_float3
        ray_data sampler thread threadgroup threadgroup_imageblock tile vertex visible""",
}

RESERVED = {}
for _language, _text in _WORDS.items():
    for _word in _text.split():
        RESERVED.setdefault(_word, _language)
