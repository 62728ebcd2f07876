#!/usr/bin/env python3
"""Writes the single files for other people's engines: dist/steradian.glsl, .es.glsl, .hlsl, .wgsl.

    make_dist.py                 writes them beside itself
    make_dist.py --check         exit 1 when what is checked in is not what would be written
    make_dist.py --with-usage F  prints the file for language F with its usage example as code, not as a comment

Tokens are replaced and nothing else: comments, line breaks and the order of every operation stay. What only double
needs is left out, and what the dialect's prelude defines is named steradian_...
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from kernel_text import in_order, kernel_files  # noqa: E402

VERSION = re.search(r"project\(steradian VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
LICENCE = (ROOT / "LICENSE").read_text()

# The paste-ready example, in the dialect: printed in the file's language, and compiled with it in the tests.
USAGE = """\
// Radiance that a quad light sends to the eye from a Lambert surface.
//   p, n         surface point and its unit normal
//   v0 ... v3    the light's corners, counter-clockwise as seen from its lit side
//   radiance     of the light; the result is for albedo 1
real lit_by_quad(vec3 p, vec3 n, vec3 v0, vec3 v1, vec3 v2, vec3 v3, real radiance) {
    mat3 frame = frame_from_normal(n);
    vec3 a = polygon_direction(transform_transposed(frame, v3 - p));  // walk order: the corners backwards
    vec3 b = polygon_direction(transform_transposed(frame, v2 - p));
    vec3 c = polygon_direction(transform_transposed(frame, v1 - p));
    vec3 d = polygon_direction(transform_transposed(frame, v0 - p));
    PolygonWalk walk = polygon_begin();
    walk = polygon_add_edge(walk, a, b);
    walk = polygon_add_edge(walk, b, c);
    walk = polygon_add_edge(walk, c, d);
    walk = polygon_add_edge(walk, d, a);
    mask lit = dot(cross(v1 - v0, v2 - v0), p - v0) > 0.0;
    real irradiance = select(lit, polygon_irradiance(walk, !lit), 0.0);
    return lambert_radiance(irradiance) * radiance;
}
"""

PIECE = re.compile(r"(?P<comment>//[^\n]*)|(?P<number>\d[\w.]*(?:(?<=[eE])[+-]\d+)?)|(?P<name>[A-Za-z_]\w*)|(?P<space>\s+)"
                   r"|(?P<op>[<>=!+\-*/]=|&&|\|\||\+\+|--|.)", re.DOTALL)


class Piece:
    """One token, or the white space between two."""

    def __init__(self, kind, text):
        self.kind, self.text = kind, text


def pieces_of(text):
    return [Piece(m.lastgroup, m.group()) for m in PIECE.finditer(text)]


def text_of(pieces):
    return "".join(p.text for p in pieces)


def solid(pieces, i, step=1):
    """Index of the next piece from i on that is neither space nor comment."""
    while 0 <= i < len(pieces) and pieces[i].kind in ("space", "comment"):
        i += step
    return i


def closing(pieces, i):
    pairs = {"(": ")", "{": "}", "[": "]"}
    depth, opening = 0, pieces[i].text
    for j in range(i, len(pieces)):
        if pieces[j].kind == "op":
            depth += (pieces[j].text == opening) - (pieces[j].text == pairs[opening])
        if depth == 0:
            return j
    raise ValueError(f"'{opening}' is not closed")


# ---- what every language shares ----------------------------------------------------------------------------------

def without_double(text):
    """Without the branches and functions that only 53 bits need."""
    while True:
        match = re.search(r"\n[ \t]*if \(real_digits\(\) > 24\) ", text)
        if not match:
            break
        end = closing_brace(text, match.end())
        if text[end:].lstrip(" ").startswith("else"):
            raise ValueError("an else after real_digits(): write what float does after the branch")
        text = text[:match.start()] + text[end:]
    for match in reversed(list(re.finditer(r"(?:^//[^\n]*\n)*^\w+ \w+_53_bits\([^)]*\) ", text, re.MULTILINE))):
        text = text[:match.start()] + text[closing_brace(text, match.end()):].lstrip("\n")
    return text


def closing_brace(text, begin):
    depth = 0
    for i in range(begin, len(text)):
        depth += (text[i] == "{") - (text[i] == "}")
        if depth == 0:
            return i + 1
    raise ValueError("'{' is not closed")


def without_head(text):
    """Without the lines that are for scripts, and the licence that the whole file carries."""
    text = re.sub(r"^// (Needs|Topics|SPDX-License-Identifier):[^\n]*\n", "", text, flags=re.MULTILINE)
    return re.sub(r"(\n//)+\n\n", "\n\n", text)


def without_lanes(pieces):
    """any_lane(m) is m where there is one lane."""
    i = 0
    while i < len(pieces):
        if pieces[i].text in ("any_lane", "all_lanes"):
            opening = solid(pieces, i + 1)
            end = closing(pieces, opening)
            inside = pieces[opening + 1:end]
            alone = pieces[i - 1].text == "(" and pieces[end + 1].text == ")"
            simple = alone or all(p.kind in ("name", "space") or p.text == "." for p in inside)
            pieces[i:end + 1] = inside if simple else pieces[opening:end + 1]
        else:
            i += 1
    return pieces


RENAMED = {name: "steradian_" + name for name in ("select", "transform", "transform_transposed", "xy", "pi")}


def rename(pieces, table):
    for i, p in enumerate(pieces):
        after = solid(pieces, i + 1)
        is_variable = p.text in RENAMED and (after >= len(pieces) or pieces[after].text != "(")
        if p.kind == "name" and not is_variable:
            p.text = table.get(p.text, p.text)
    return pieces


# ---- GLSL and HLSL: other names for the same text ------------------------------------------------------------------

GLSL_NAMES = {"real": "float", "mask": "bool"}
HLSL_NAMES = {**GLSL_NAMES, "vec2": "float2", "vec3": "float3", "vec4": "float4", "mat3": "float3x3",
              "inversesqrt": "rsqrt"}


def c_like(names):
    table = {**RENAMED, **names}
    return lambda text: text_of(rename(without_lanes(pieces_of(text)), table))


# ---- WGSL: declarations turned around ------------------------------------------------------------------------------

WGSL_TYPES = {"real": "f32", "mask": "bool", "int": "i32", "vec2": "vec2f", "vec3": "vec3f", "vec4": "vec4f",
              "mat3": "mat3x3f"}


class Wgsl:
    def __init__(self):
        self.structs = set()

    def __call__(self, text):
        pieces = without_lanes(pieces_of(text))
        self.structs |= {pieces[solid(pieces, i + 1)].text for i, p in enumerate(pieces) if p.text == "struct"}
        self.turn_selects(pieces)
        out, i = [], 0
        while i < len(pieces):
            p = pieces[i]
            if p.text == "struct":
                end = closing(pieces, self.find(pieces, i, "{"))
                out.append(self.struct(pieces[i:end + 1]))
                i = solid(pieces, end + 1) + 1  # without the semicolon
            elif p.kind == "name":
                end = closing(pieces, self.find(pieces, i, "{"))
                out.append(self.function(pieces[i:end + 1]))
                i = end + 1
            else:
                out.append(p.text)
                i += 1
        return "".join(out)

    @staticmethod
    def find(pieces, i, text):
        while pieces[i].text != text or pieces[i].kind != "op":
            i += 1
        return i

    def type(self, name):
        return WGSL_TYPES.get(name, name)

    def is_type(self, name):
        return name in WGSL_TYPES or name in self.structs

    @staticmethod
    def turn_selects(pieces):
        """select(m, a, b) is select(b, a, m); the innermost first."""
        for i in reversed(range(len(pieces))):
            if pieces[i].text != "select" or pieces[i].kind != "name":
                continue
            opening = solid(pieces, i + 1)
            end = closing(pieces, opening)
            parts, depth = [[]], 0
            for p in pieces[opening + 1:end]:
                depth += (p.text in ("(", "[")) - (p.text in (")", "]"))
                if p.text == "," and depth == 0:
                    parts.append([])
                else:
                    parts[-1].append(p)
            m, a, b = parts
            space = Piece("space", " ")
            strip = lambda part: pieces_of(text_of(part).strip())
            pieces[opening + 1:end] = (strip(b) + [Piece("op", ","), space] + strip(a) + [Piece("op", ","), space] + strip(m))

    def struct(self, pieces):
        text = text_of(rename(pieces, {}))
        def member(match):
            space, kind, name, size, comment = match.groups()
            kind = self.type(kind)
            return f"{space}{name}: {f'array<{kind}, {size}>' if size else kind},{comment}"
        return re.sub(r"^(\s+)(\w+) (\w+)(?:\[(\d+)\])?;([^\n]*)$", member, text, flags=re.MULTILINE)

    def function(self, pieces):
        opening = self.find(pieces, 0, "(")
        end = closing(pieces, opening)
        kind, name = pieces[0].text, pieces[solid(pieces, 1)].text
        parameters = ", ".join(f"{word}: {self.type(t)}" for t, word in
                               re.findall(r"(\w+)\s+(\w+)", text_of(pieces[opening + 1:end])))
        body = self.body(pieces[end + 1:])
        name = RENAMED.get(name, name)
        return f"fn {name}({parameters}) -> {self.type(kind)}{body}"

    def body(self, pieces):
        changed = self.assigned(pieces)
        i = 0
        while i < len(pieces):
            after = solid(pieces, i + 1)
            is_declaration = (pieces[i].kind == "name" and self.is_type(pieces[i].text) and after < len(pieces)
                              and pieces[after].kind == "name")
            if is_declaration:
                kind, name = self.type(pieces[i].text), pieces[after].text
                without_value = pieces[solid(pieces, after + 1)].text == ";"
                word = "var" if name in changed or without_value else "let"
                pieces[i] = Piece("raw", word)
                pieces[after] = Piece("raw", f"{name}: {kind}" if without_value or kind == "i32" else name)
            i += 1
        names = {**WGSL_TYPES, **RENAMED, "select": "select", "inversesqrt": "inverseSqrt"}
        return text_of(rename(pieces, names))

    @staticmethod
    def assigned(pieces):
        """Names that something is assigned to after their declaration."""
        names = set()
        for i, p in enumerate(pieces):
            if p.kind != "op" or p.text not in ("=", "+=", "-=", "*=", "/=", "++", "--"):
                continue
            j = solid(pieces, i - 1, -1)
            while pieces[j].text == "]" or pieces[solid(pieces, j - 1, -1)].text == ".":  # back to the variable itself
                j = solid(pieces, j - 1, -1)
                while pieces[j].text in ("[", "."):
                    j = solid(pieces, j - 1, -1)
            before = solid(pieces, j - 1, -1)
            if not (pieces[before].kind == "name" and pieces[before].text != "return"):  # a type: the declaration
                names.add(pieces[j].text)
        return names


# ---- files ---------------------------------------------------------------------------------------------------------

GLSL_HELPERS = """\
float steradian_select(bool m, float a, float b) { return m ? a : b; }
vec2 steradian_select(bool m, vec2 a, vec2 b) { return m ? a : b; }
vec3 steradian_select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 steradian_select(bool m, vec4 a, vec4 b) { return m ? a : b; }

vec2 steradian_xy(vec3 v) { return v.xy; }

// Matrix of three columns times vector, and its transpose times vector.
vec3 steradian_transform(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
vec3 steradian_transform_transposed(mat3 m, vec3 v) { return vec3(dot(m[0], v), dot(m[1], v), dot(m[2], v)); }
"""

HLSL_HELPERS = GLSL_HELPERS.replace(
    "// Matrix of three columns times vector, and its transpose times vector.",
    "// Matrix of three columns times vector, and its transpose times vector. float3x3(c0, c1, c2) holds the columns in what\n"
    "// HLSL calls rows; use these two and not mul().")
for _old, _new in HLSL_NAMES.items():
    HLSL_HELPERS = re.sub(rf"\b{_old}\b", _new, HLSL_HELPERS)

WGSL_HELPERS = """\
fn steradian_xy(v: vec3f) -> vec2f { return v.xy; }

// Matrix of three columns times vector, and its transpose times vector.
fn steradian_transform(m: mat3x3f, v: vec3f) -> vec3f { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
fn steradian_transform_transposed(m: mat3x3f, v: vec3f) -> vec3f {
    return vec3f(dot(m[0], v), dot(m[1], v), dot(m[2], v));
}
"""

LANGUAGES = {  # file: (language's name, what must stand before it, helpers, printer)
    "steradian.glsl": ("GLSL 4.50", "Paste after #version and your own declarations.", GLSL_HELPERS,
                       lambda: c_like(GLSL_NAMES)),
    "steradian.es.glsl": ("GLSL ES 3.00 (WebGL2)", "Paste after #version 300 es and `precision highp float;`.",
                          GLSL_HELPERS, lambda: c_like(GLSL_NAMES)),
    "steradian.hlsl": ("HLSL", "#include or paste it; it has no macros, globals or resources.", HLSL_HELPERS,
                       lambda: c_like(HLSL_NAMES)),
    "steradian.wgsl": ("WGSL", "Put it before your module's text; it has no bindings or globals.", WGSL_HELPERS, Wgsl),
}


def as_comment(text):
    return "".join(f"// {line}".rstrip() + "\n" for line in text.splitlines())


def file_text(name, usage_as_code=False):
    language, place, helpers, make_printer = LANGUAGES[name]
    printer = make_printer()
    kernels = "".join(f"// ==== {p.stem} ====\n\n{printer(without_head(without_double(p.read_text()))).strip()}\n\n"
                      for p in in_order(kernel_files()))
    usage = printer(USAGE)
    indented = "".join(f"    {line}\n" if line else "\n" for line in usage.splitlines())
    text = (as_comment(f"Steradian {VERSION}: area light integrals in closed form, for {language}.\n\n{place} Made by\n"
                       f"dist/make_dist.py from kernels/: change those. For example:\n\n")
            + as_comment(indented)
            + as_comment("\nA light of any outline is walked edge by edge; each function's comment gives frame, units, preconditions,\n"
                         "degenerate case and source.\n\n" + LICENCE)
            + "\n" + helpers + "\n" + kernels)
    return text.rstrip("\n") + "\n" + ("\n" + usage if usage_as_code else "")


def main():
    if sys.argv[1:2] == ["--with-usage"]:
        print(file_text(sys.argv[2], usage_as_code=True))
        return
    stale = 0
    for name in LANGUAGES:
        path, text = ROOT / "dist" / name, file_text(name)
        if sys.argv[1:] == ["--check"]:
            if not path.exists() or path.read_text() != text:
                stale += 1
                print(f"{path} is not what dist/make_dist.py writes: run it")
        else:
            path.write_text(text)
    print(f"{len(LANGUAGES)} files, {stale} stale")
    sys.exit(stale > 0)


if __name__ == "__main__":
    main()
