"""Kernel files as texts: tokens, header lines, order of dependency. Used by the lint, the shader tests and dist/.

Kernels lie in the folders of FOLDERS, x.glsl with its parity cases x_cases.glsl beside it. A file may need files of its own
folder and of the folders before it; names are unique over all of them. The comment at the head of a file may hold two lines
that scripts read:
    // Needs: inverse_trig.glsl        files whose functions this one calls (comma between several)
    // Topics: phong, blinn_phong      prefixes of its functions; without the line: the file's name
A file of cases needs the kernels beside it and tests/parity/case.glsl without saying so, and its topic is `case`.
"""
import re
from collections import namedtuple
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KERNELS = ROOT / "kernels"
FOLDERS = ("math", "surface", "outline", "lobe", "integral", "comparison", "plane", "indirect", "shadow")
CASE = ROOT / "tests" / "parity" / "case.glsl"  # what every file of cases needs

Token = namedtuple("Token", "kind text line")  # kind: name, number, op, comment, directive, error

_TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<directive>^[ \t]*\#[^\n]*)
      | (?P<number>(?:\d|\.\d)(?:[eE][+-]\d|[\w.])*)
      | (?P<name>[A-Za-z_]\w*)
      | (?P<op>\+\+|--|[-+*/%]=|[<>=!]=|&&|\|\||<<|>>|[-+*/%<>=!?:;,.(){}\[\]&|^~])
      | (?P<newline>\n) | (?P<space>[ \t\r]+) | (?P<error>.)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE)


def tokenize(text):
    tokens, line = [], 1
    for match in _TOKEN.finditer(text):
        if match.lastgroup not in ("newline", "space"):
            tokens.append(Token(match.lastgroup, match.group(), line))
        line += match.group().count("\n")
    return tokens


def header_list(text, key):
    """The comma-separated words after `// key:` in the comment at the head of a file, or None."""
    for line in text.splitlines():
        if not line.startswith("//"):
            break
        if line.startswith(f"// {key}:"):
            return [w for w in re.split(r"[,\s]+", line.split(":", 1)[1].strip().rstrip(".")) if w]
    return None


def is_cases(path):
    return path.stem.endswith("_cases")


def needs(path, text):
    """The paths of the files that `path` needs."""
    path = Path(path)
    found = [CASE, path.with_name(path.name.replace("_cases.", "."))] if is_cases(path) else []
    for name in header_list(text, "Needs") or []:
        name = name if name.endswith(".glsl") else name + ".glsl"
        places = [p for p in [path.with_name(name), *(KERNELS / folder / name for folder in FOLDERS)] if p.exists()]
        if not places:
            raise ValueError(f"{path}: needs {name}, which does not exist")
        found.append(places[0])
    return found


def topics(path, text):
    return header_list(text, "Topics") or (["case"] if is_cases(Path(path)) else [Path(path).stem])


def with_needs(path, _open=()):
    """The files that `path` depends on, each before its user, and itself last."""
    path = Path(path)
    if path in _open:
        raise ValueError(f"{path}: Needs run in a circle: {' -> '.join(p.name for p in _open)}")
    order = []
    for needed in needs(path, path.read_text()):
        for p in with_needs(needed, _open + (path,)):
            if p not in order:
                order.append(p)
    return order + [path]


def kernel_files():
    """Every kernel, folder by folder; not their cases."""
    return [p for folder in FOLDERS for p in sorted((KERNELS / folder).glob("*.glsl")) if not is_cases(p)]


def case_files():
    """Every file of cases, folder by folder."""
    return [p for folder in FOLDERS for p in sorted((KERNELS / folder).glob("*_cases.glsl"))]


def functions(text):
    """[(name, its tokens)] of a file's functions, in order."""
    tokens = [t for t in tokenize(text) if t.kind not in ("comment", "directive")]
    found, i = [], 0
    while i < len(tokens):
        is_function = tokens[i].text != "struct" and i + 2 < len(tokens) and tokens[i + 2].text == "("
        begin, depth = i, 0
        while i < len(tokens):
            depth += (tokens[i].text == "{") - (tokens[i].text == "}")
            i += 1
            if depth == 0 and tokens[i - 1].text in ("}", ";"):
                break
        if is_function:
            found.append((tokens[begin + 1].text, tokens[begin:i]))
    return found


def calls(body):
    """The names that a function's tokens call."""
    return {t.text for t, after in zip(body[3:], body[4:]) if t.kind == "name" and after.text == "("}


def in_order(files):
    """The files and all they need, each after what it needs."""
    order = []
    for path in files:
        for p in with_needs(path):
            if p not in order:
                order.append(p)
    return order
