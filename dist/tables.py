"""The compact tables as text in each language: words of half floats, and the functions that look them up."""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

TABLES = {  # name: (the header that `steradian fit` wrote, what it says)
    "ggx": ("ggx_compact.h", "GGX; the shape is what steradian_ltc_from_compact takes"),
    "charlie": ("charlie_compact.h", "Charlie's sheen; the shape is M^-1 about the normal: xx, yy, xz, zx, and zz is 1"),
}


def table_words(name):
    """The words of a compact table: 16 x 16 shapes of four half floats, 22 x 22 magnitudes of two."""
    text = next(ROOT.glob(f"**/{TABLES[name][0]}")).read_text()
    arrays = [re.findall(r"0x[0-9a-f]{8}", body) for body in re.findall(r"unsigned int \w+\[\d+\] = {(.*?)}", text, re.S)]
    assert [len(a) for a in arrays] == [512, 484], TABLES[name][0]
    return arrays


LOOK_UPS = [f"ltc_{name}_{kind}" for name in TABLES for kind in ("shape", "magnitude")]  # their functions

LOOK_UP = {
    "c": """\
// The table NAME at a place that steradian_ltc_coordinates gives: WHAT.
VEC4 steradian_ltc_NAME_shape_at(int k) {
    return VEC4(HALVES(steradian_ltc_NAME_shape_words[2 * k]), HALVES(steradian_ltc_NAME_shape_words[2 * k + 1]));
}
VEC4 steradian_ltc_NAME_shape(VEC2 place) {
    VEC2 x = clamp(place, 0.0, 1.0) * 15.0;
    VEC2 node = min(floor(x), VEC2(14.0, 14.0));
    VEC2 f = x - node;
    int k = int(node.y) * 16 + int(node.x);
    VEC4 low = MIX(steradian_ltc_NAME_shape_at(k), steradian_ltc_NAME_shape_at(k + 1), f.x);
    VEC4 high = MIX(steradian_ltc_NAME_shape_at(k + 16), steradian_ltc_NAME_shape_at(k + 17), f.x);
    return MIX(low, high, f.y);
}

// The magnitudes of the table NAME at such a place: what steradian_ltc_specular_scale takes.
VEC2 steradian_ltc_NAME_magnitude_at(int k) { return HALVES(steradian_ltc_NAME_magnitude_words[k]); }
VEC2 steradian_ltc_NAME_magnitude(VEC2 place) {
    VEC2 x = clamp(place, 0.0, 1.0) * 21.0;
    VEC2 node = min(floor(x), VEC2(20.0, 20.0));
    VEC2 f = x - node;
    int k = int(node.y) * 22 + int(node.x);
    VEC2 low = MIX(steradian_ltc_NAME_magnitude_at(k), steradian_ltc_NAME_magnitude_at(k + 1), f.x);
    VEC2 high = MIX(steradian_ltc_NAME_magnitude_at(k + 22), steradian_ltc_NAME_magnitude_at(k + 23), f.x);
    return MIX(low, high, f.y);
}
""",
    "wgsl": """\
// The table NAME at a place that steradian_ltc_coordinates gives: WHAT.
fn steradian_ltc_NAME_shape_at(k: i32) -> vec4f {
    return vec4f(unpack2x16float(steradian_ltc_NAME_shape_words[2 * k]), unpack2x16float(steradian_ltc_NAME_shape_words[2 * k + 1]));
}
fn steradian_ltc_NAME_shape(place: vec2f) -> vec4f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 15.0;
    let node = min(floor(x), vec2f(14.0, 14.0));
    let f = x - node;
    let k = i32(node.y) * 16 + i32(node.x);
    let low = mix(steradian_ltc_NAME_shape_at(k), steradian_ltc_NAME_shape_at(k + 1), f.x);
    let high = mix(steradian_ltc_NAME_shape_at(k + 16), steradian_ltc_NAME_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}

// The magnitudes of the table NAME at such a place: what steradian_ltc_specular_scale takes.
fn steradian_ltc_NAME_magnitude_at(k: i32) -> vec2f { return unpack2x16float(steradian_ltc_NAME_magnitude_words[k]); }
fn steradian_ltc_NAME_magnitude(place: vec2f) -> vec2f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 21.0;
    let node = min(floor(x), vec2f(20.0, 20.0));
    let f = x - node;
    let k = i32(node.y) * 22 + i32(node.x);
    let low = mix(steradian_ltc_NAME_magnitude_at(k), steradian_ltc_NAME_magnitude_at(k + 1), f.x);
    let high = mix(steradian_ltc_NAME_magnitude_at(k + 22), steradian_ltc_NAME_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}
""",
}

ARRAY = {  # language: (before and after the words, an element's ending)
    "glsl": ("const uint {name}[{count}] = uint[{count}](", ");", "u"),
    "es": ("const highp uint {name}[{count}] = uint[{count}](", ");", "u"),
    "hlsl": ("static const uint {name}[{count}] = {{", "}};", "u"),
    "wgsl": ("var<private> {name}: array<u32, {count}> = array<u32, {count}>(", ");", "u"),
}
SPELLING = {"glsl": {"VEC4": "vec4", "VEC2": "vec2", "MIX": "mix", "HALVES": "unpackHalf2x16"},
            "hlsl": {"VEC4": "float4", "VEC2": "float2", "MIX": "lerp", "HALVES": "steradian_halves"}, "wgsl": {}}
SPELLING["es"] = SPELLING["glsl"]
HALVES_HLSL = """\
// Two half floats in a word, the first in the low bits.
float2 steradian_halves(uint word) { return float2(f16tof32(word), f16tof32(word >> 16)); }

"""


def tables_text(language):
    out = HALVES_HLSL if language == "hlsl" else ""
    before, after, ending = ARRAY[language]
    for name, (_, what) in TABLES.items():
        for kind, words in zip(("shape", "magnitude"), table_words(name)):
            rows = [", ".join(w + ending for w in words[i:i + 8]) for i in range(0, len(words), 8)]
            array = f"steradian_ltc_{name}_{kind}_words"
            out += (before.format(name=array, count=len(words)) + "\n    " + ",\n    ".join(rows) + after.format() + "\n\n")
        look_up = LOOK_UP["wgsl" if language == "wgsl" else "c"].replace("NAME", name).replace("WHAT", what)
        for word, spelt in SPELLING[language].items():
            look_up = look_up.replace(word, spelt)
        out += look_up + "\n"
    return out.rstrip() + "\n"
