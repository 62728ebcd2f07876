#!/usr/bin/env python3
"""Writes the kernels and the compact tables for other people's engines.

    dist/steradian.glsl, .es.glsl, .hlsl, .wgsl   everything, a file a language
    dist/glsl/, es/, hlsl/, wgsl/                 the same by topic: paste the topics you need, in the order that their heads give

    make_dist.py                 writes them beside itself
    make_dist.py --check         exit 1 when what is checked in is not what would be written

dist/source/ holds the functions that look up a table themselves, in the kernels' dialect, and the example at the top of each whole file.

Tokens are replaced and nothing else: comments, line breaks and the order of every operation stay. What only double
needs is left out. Every name at file scope begins with steradian_, a struct's with Steradian.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
sys.path.insert(0, str(ROOT / "dist"))
from kernel_text import functions, in_order, kernel_files, with_needs  # noqa: E402
from tables import LOOK_UPS, tables_text  # noqa: E402

VERSION = re.search(r"project\(steradian VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
LICENCE = (ROOT / "LICENSE").read_text()

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


SOURCE = ROOT / "dist" / "source"
HELPERS = ("select", "transform", "transform_transposed", "xy", *LOOK_UPS)
PROGRAMS_OWN = ("texture_cell", "shadow")  # kernels that say nothing without our programs' lists
TEXTS = {path: path.read_text() for path in [*kernel_files(), SOURCE / "lit.glsl"] if path.stem not in PROGRAMS_OWN}
FUNCTIONS = {name: "steradian_" + name
             for name in (*HELPERS, *(name for text in TEXTS.values() for name, _ in functions(text)))}
STRUCTS = {name: "Steradian" + name
           for text in TEXTS.values() for name in re.findall(r"^struct (\w+)", text, re.MULTILINE)}


def rename(pieces, table):
    """Names of functions only where something is called: a variable may be called like one."""
    for i, p in enumerate(pieces):
        if p.kind == "comment":
            p.text = re.sub(r"\w+", lambda m: in_comment(m.group()), p.text)
        if p.kind != "name":
            continue
        after = solid(pieces, i + 1)
        is_call = after < len(pieces) and pieces[after].text == "("
        if is_call or p.text not in FUNCTIONS:
            p.text = table.get(p.text, p.text)
    return pieces


def in_comment(word):
    """What a comment calls a function or a struct; Ellipse alone is a word of English."""
    if "_" in word:
        return FUNCTIONS.get(word, word)
    return STRUCTS.get(word, word) if re.search(r"[a-z][A-Z]", word) else word


# ---- GLSL and HLSL: other names for the same text ------------------------------------------------------------------

GLSL_NAMES = {"real": "float", "mask": "bool"}
HLSL_NAMES = {**GLSL_NAMES, "vec2": "float2", "vec3": "float3", "vec4": "float4", "mat3": "float3x3",
              "inversesqrt": "rsqrt"}


def c_like(names):
    table = {**FUNCTIONS, **STRUCTS, **names}
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
                out.append(text_of(rename([p], {})))
                i += 1
        return "".join(out)

    @staticmethod
    def find(pieces, i, text):
        while pieces[i].text != text or pieces[i].kind != "op":
            i += 1
        return i

    def type(self, name):
        return WGSL_TYPES.get(name, STRUCTS.get(name, name))

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
        text = text_of(rename(pieces, STRUCTS))
        def member(match):
            space, kind, name, size, comment = match.groups()
            kind = WGSL_TYPES.get(kind, kind)
            return f"{space}{name}: {f'array<{kind}, {size}>' if size else kind},{comment}"
        return re.sub(r"^(\s+)(\w+) (\w+)(?:\[(\d+)\])?;([^\n]*)$", member, text, flags=re.MULTILINE)

    def function(self, pieces):
        opening = self.find(pieces, 0, "(")
        end = closing(pieces, opening)
        kind, name = pieces[0].text, pieces[solid(pieces, 1)].text
        parameters = ", ".join(f"{word}: {self.type(t)}" for t, word in
                               re.findall(r"(\w+)\s+(\w+)", text_of(pieces[opening + 1:end])))
        body = self.body(pieces[end + 1:])
        name = FUNCTIONS.get(name, name)
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
        names = {**FUNCTIONS, **STRUCTS, **WGSL_TYPES, "select": "select", "inversesqrt": "inverseSqrt"}
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

# ---- topics --------------------------------------------------------------------------------------------------------

TOPICS = {  # name: (what it is, the beginnings of its kernels' names; a kernel belongs to the longest that fits
    "math": ("arithmetic that all topics share", ["math/"]),
    "surface": ("surfaces of glTF: frames, lobes and texture look-up from factors and texels", ["surface/"]),
    "polygon": ("polygons: irradiance, solid angle, clipping to the horizon; Lambert's lobe",
                ["outline/polygon", "outline/horizon_clip", "lobe/lambert"]),
    "lobe": ("lobes of surfaces", ["lobe/"]),
    "round": ("disks, ellipses, spheres, ellipsoids, tubes and lines, point and spot lights", ["outline/"]),
    "phong": ("Phong's lobe over polygons, exactly and by a series", ["integral/moment"]),
    "ltc": ("linearly transformed cosines over polygons, textured ones too", ["integral/ltc"]),
    "ltc_tables": ("the tables of linearly transformed cosines, 4 KB each, and how they are read", []),
    "lit": ("surfaces lit by a quad or a polygon in one call: GGX and Lambert", ["source/lit"]),
    "ggx": ("GGX in closed form, and half vector methods for Blinn-Phong and Beckmann", ["integral/"]),
    "comparison": ("methods of the literature that ours are compared with", ["comparison/"]),
    "plane": ("light in the plane", ["plane/"]),
    "indirect": ("one bounce from virtual lights", ["indirect/"]),
}

TABLES_OF = {"lit": ["ltc_tables"]}  # topics whose functions look up tables


def topic_of(path):
    name = f"{path.parent.name}/{path.stem}"
    return max((len(start), topic) for topic, (_, starts) in TOPICS.items() for start in starts if name.startswith(start))[1]


def needs_of_topic(topic, _open=()):
    """The topics that come before one, each after what it needs itself."""
    if topic in _open:
        raise ValueError(f"topics need each other in a circle: {_open}")
    files = [p for path in TEXTS if topic_of(path) == topic for p in with_needs(path)]
    order = []
    direct = {"math", *TABLES_OF.get(topic, ())} | {topic_of(p) for p in files}
    for needed in [t for t in TOPICS if t != topic and t in direct] if topic != "math" else []:
        order += [t for t in needs_of_topic(needed, _open + (topic,)) + [needed] if t not in order]
    return order


def all_topics():
    order = []
    for topic in TOPICS:
        order += [t for t in needs_of_topic(topic) + [topic] if t not in order]
    return order


# ---- files ---------------------------------------------------------------------------------------------------------

EXAMPLE_PLACE = {  # what is before the example in the heads of the whole files
    "glsl": "A surface lit by a quad light, as a fragment shader beside this file:",
    "es": "A surface lit by a quad light: a fragment shader is #version 300 es, precision highp float;, this file and then",
    "hlsl": "A surface lit by a quad light, as a pixel shader beside this file:",
    "wgsl": "A surface lit by a quad light: a module is this file and then",
}
MANUAL = """\
The light shines to the side from which its corners run counter-clockwise, or clockwise in a left-handed frame. See the topic `lit`.
Lights of other outlines and shapes, and other lobes, are walked edge by edge. Each function's comment gives frame, units,
preconditions, degenerate case and source."""

LANGUAGES = {  # key: (ending, name, what must stand before it, helpers, printer)
    "glsl": (".glsl", "GLSL 4.50", "Paste after #version and your own declarations.", GLSL_HELPERS, lambda: c_like(GLSL_NAMES)),
    "es": (".es.glsl", "GLSL ES 3.00 (WebGL2)", "Paste after #version 300 es and `precision highp float;`.", GLSL_HELPERS,
           lambda: c_like(GLSL_NAMES)),
    "hlsl": (".hlsl", "HLSL", "#include or paste it; it has no macros and no resources.", HLSL_HELPERS, lambda: c_like(HLSL_NAMES)),
    "wgsl": (".wgsl", "WGSL", "Put it before your module's text; it has no bindings.", WGSL_HELPERS, Wgsl),
}


def as_comment(text):
    return "".join(f"// {line}".rstrip() + "\n" for line in text.splitlines())


def topic_text(topic, language, printer):
    if topic == "ltc_tables":
        return tables_text(language)
    kernels = "".join(f"// ==== {p.stem} ====\n\n{printer(without_head(without_double(TEXTS[p]))).strip()}\n\n"
                      for p in in_order(TEXTS) if topic_of(p) == topic)
    return (LANGUAGES[language][3] + "\n" if topic == "math" else "") + kernels.rstrip("\n") + "\n"


def printed(language):
    """{topic: its text}. One printer for all: WGSL's learns the structs as they come."""
    printer = LANGUAGES[language][4]()
    return {topic: topic_text(topic, language, printer) for topic in all_topics()}


def files(language):
    """{path under dist/: text} of one language."""
    ending, title, place, _, _ = LANGUAGES[language]
    texts = printed(language)
    made = "Made by dist/make_dist.py from kernels/ and dist/source/: change those."
    example = (SOURCE / f"example{ending}").read_text()
    indented = "".join(f"    {line}\n" if line else "\n" for line in example.splitlines())
    whole = (as_comment(f"Steradian {VERSION}: area light integrals in closed form, for {title}.\n\n{EXAMPLE_PLACE[language]}\n\n")
             + as_comment(indented) + as_comment(f"\n{place}\n{MANUAL}\n{made}\n\n{LICENCE}"))
    found = {f"steradian{ending}": whole + "\n" + "\n".join(f"// ======== {t}: {TOPICS[t][0]} ========\n\n{text}" for t, text in texts.items())}
    for topic, text in texts.items():
        before = ", ".join(t + ending for t in needs_of_topic(topic))
        head = f"Steradian {VERSION}, {topic}: {TOPICS[topic][0]}, for {title}.\n\n{place}\n" + (
            f"It needs these files before it, in this order: {before}." if before else "It needs no other file.")
        found[f"{language}/{topic}{ending}"] = as_comment(f"{head}\n{made}\n\n" + LICENCE) + "\n" + text
    return found


def main():
    job = (sys.argv[1:] or ["--write"])[0]
    stale, written = 0, {name: text for language in LANGUAGES for name, text in files(language).items()}
    for name, text in written.items():
        path = ROOT / "dist" / name
        if job == "--check":
            if not path.exists() or path.read_text() != text:
                stale += 1
                print(f"{path} is not what dist/make_dist.py writes: run it")
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
    print(f"{len(written)} files, {stale} stale")
    if job != "--check":  # web/three-steradian carries a part of dist/es; its own test checks it
        subprocess.run([sys.executable, ROOT / "web" / "three-steradian" / "make_package.py"], check=True)
    sys.exit(stale > 0)


if __name__ == "__main__":
    main()
