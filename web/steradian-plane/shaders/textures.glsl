// The buffers of shaders/plane/plane.glsl, as textures: word or number k is the pixel (k mod 2048, k div 2048). make_package.py writes
// lists[k] as lists_at(k).
uniform usampler2D list_words, pair_words, mask_words;
uniform sampler2D vertex_numbers;
ivec2 place_of(uint at) { return ivec2(int(at & 2047u), int(at >> 11)); }
uint lists_at(uint at) { return texelFetch(list_words, place_of(at), 0).x; }
uint pairs_at(uint at) { return texelFetch(pair_words, place_of(at), 0).x; }
uint masks_at(uint at) { return texelFetch(mask_words, place_of(at), 0).x; }
vec4 vertices_at(uint at) { return texelFetch(vertex_numbers, place_of(at), 0); }
