"""Kernel files as texts: tokens, header lines, order of dependency. Used by the lint, the shader tests and dist/.

The comment at the head of a kernel file may hold two lines that scripts read:
    // Needs: inverse_trig.glsl        files whose functions this one calls (comma between several)
    // Topics: phong, blinn_phong      prefixes of its functions; without the line: the file's name
"""
import re
from collections import namedtuple
from pathlib import Path

KERNELS = Path(__file__).resolve().parent.parent / "kernels"

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


def needs(text):
    names = header_list(text, "Needs") or []
    return [n if n.endswith(".glsl") else n + ".glsl" for n in names]


def topics(path, text):
    return header_list(text, "Topics") or [Path(path).stem]


def with_needs(path, _open=()):
    """The files that `path` depends on, each before its user, and itself last."""
    path = Path(path)
    if path in _open:
        raise ValueError(f"{path}: Needs run in a circle: {' -> '.join(p.name for p in _open)}")
    order = []
    for name in needs(path.read_text()):
        needed = path.parent / name
        if not needed.exists():
            needed = KERNELS / name
        if not needed.exists():
            raise ValueError(f"{path}: needs {name}, which does not exist")
        for p in with_needs(needed, _open + (path,)):
            if p not in order:
                order.append(p)
    return order + [path]


def kernel_files(folder):
    return sorted(Path(folder).glob("*.glsl"))


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


def in_order(folder):
    """Every kernel file of a folder, each after what it needs."""
    order = []
    for path in kernel_files(folder):
        for p in with_needs(path):
            if p not in order:
                order.append(p)
    return order
