#!/usr/bin/env python3
"""doxygen_filter.py HEADER: the header with its comments as Doxygen reads them; ./dev docs calls it through Doxyfile.

Our headers are written to be read as they are: plain // comments whose columns mean something. A block of comment lines becomes a
verbatim block for what follows it, the first block one for the file, and a comment behind a declaration one for that declaration.
"""
import re
import sys

COMMENT = re.compile(r"^(\s*)//(?: ?)(.*)$")


def escaped(text):
    return re.sub(r"([\\@<>#%&$])", r"\\\1", text)


def block(lines, first):
    opening = "/*! \\file\n" if first else "/*!\n"
    return opening + "\\verbatim\n" + "\n".join(line.replace("*/", "* /") for line in lines) + "\n\\endverbatim */"


def filtered(text):
    out, lines, first = [], [], True
    for line in text.splitlines() + [""]:
        if line.startswith("#include") and ".glsl" in line:
            line = ""  # kernels are their own manual
        comment = COMMENT.match(line)
        if comment:
            lines.append(comment.group(2))
            continue
        if lines:
            belongs = first or line.strip()  # a block with an empty line after it is about what follows at large
            out.append(block(lines, first) if belongs else "\n" * (len(lines) - 1))
            lines, first = [], False
        code, slashes, rest = line.partition("  // ")
        out.append(f"{code}  ///< {escaped(rest)}" if slashes and code.rstrip().endswith((";", ",", "}")) else line)
    return "\n".join(out)


if __name__ == "__main__":
    print(filtered(open(sys.argv[1], encoding="utf-8").read()))
