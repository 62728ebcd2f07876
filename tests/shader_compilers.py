#!/usr/bin/env python3
"""Compiles every kernel file with one shader compiler: shader_compilers.py glsl|es|hlsl

Each file alone, after its language's prelude and what its `// Needs:` line names.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tools"))
from kernel_text import KERNELS, kernel_files, with_needs  # noqa: E402

LANGUAGES = {
    "glsl": ("prelude.glsl", "#version 450\n", "layout(local_size_x = 1) in;\nvoid main() {}\n", ".comp",
             ["glslc", "-Werror", "-fshader-stage=compute", "-o", "/dev/null"]),
    "es": ("prelude.glsl", "#version 300 es\n", "out vec4 colour;\nvoid main() { colour = vec4(0.0); }\n", ".frag",
           ["glslangValidator", "-S", "frag"]),
    "hlsl": ("prelude.hlsl", "", "[numthreads(1, 1, 1)] void main() {}\n", ".hlsl",
             ["glslangValidator", "-D", "-V", "-o", "/dev/null", "-S", "comp", "-e", "main"]),
}


def compile_kernel(language, path):
    """(compiled, the compiler's words)"""
    prelude, head, tail, suffix, command = LANGUAGES[language]
    parts = [KERNELS / "prelude" / prelude] + with_needs(path)
    text = head
    for number, part in enumerate(parts):  # messages then name the string and the line in the file
        text += f"#line 1 {number}\n" if language != "hlsl" else f'#line 1 "{part.name}"\n'
        text += part.read_text()
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / (path.stem + suffix)
        source.write_text(text + tail)
        done = subprocess.run(command + [str(source)], capture_output=True, text=True)
    files = ", ".join(f"{n} = {p.name}" for n, p in enumerate(parts))
    return done.returncode == 0, f"(strings: {files})\n{done.stdout}{done.stderr}"


def main():
    language, = sys.argv[1:]
    failed = 0
    files = kernel_files()
    for path in files:
        good, words = compile_kernel(language, path)
        if not good:
            failed += 1
            print(f"{path}: {language} refuses it {words}")
    print(f"{language}: {len(files) - failed} of {len(files)} kernel files compile")
    sys.exit(failed > 0 or not files)


if __name__ == "__main__":
    main()
