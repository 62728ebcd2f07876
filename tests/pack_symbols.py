#!/usr/bin/env python3
"""No symbol that the linker could merge across instruction sets: pack_symbols.py NM ISA OBJECT...

The linker keeps one copy of a weak symbol, whichever unit it comes from. If that copy was compiled for AVX-512, the
program dies on an older processor in code that never asked for AVX-512. So everything that a pack unit defines for
others to see must name its instruction set: the namespace isa_sse2, isa_avx2, isa_avx512 (include/steradian/config.h),
or the architecture in xsimd's types. And no two units may define the same strong symbol: from an archive, the linker takes
whichever it needs first and is silent about the other.
"""
import re
import subprocess
import sys

# xsimd's architecture tags that belong to a unit. (fma3<avx2> contains avx2.)
ARCHITECTURE = {"sse2": r"xsimd::sse2\b", "avx2": r"xsimd::avx2\b", "avx512": r"xsimd::avx512\w+"}

ALLOWED = {
    "DW.ref.__gxx_personality_v0": "a pointer to the C++ runtime's handler: data, the same in every unit",
}


STRONG = "TDBRG"  # nm's letters


def leaks(nm, isa, path, owners):
    listing = subprocess.run([nm, "-C", "--defined-only", "--extern-only", path], capture_output=True, text=True,
                             check=True).stdout
    found, checked = [], 0
    for line in listing.splitlines():
        match = re.match(r"[0-9a-f]*\s+(\w)\s+(.*)", line)
        if not match:
            continue
        checked += 1
        kind, name = match.groups()
        if name in ALLOWED:
            continue
        if kind in STRONG and owners.setdefault(name, path) != path:
            found.append(f"{path}: {kind} {name} is defined in {owners[name]} too")
            continue
        own = re.search(rf"\bisa_{isa}(_strict)?::", name) or re.search(ARCHITECTURE[isa], name)
        others = [o for o in ARCHITECTURE if o != isa and re.search(rf"\bisa_{o}(_strict)?::", name)]
        if not own or others:
            found.append(f"{path}: {kind} {name}")
    return found, checked


def main():
    nm, isa, *objects = sys.argv[1:]
    found, checked, owners = [], 0, {}
    for path in objects:
        more, count = leaks(nm, isa, path, owners)
        found += more
        checked += count
    for leak in found:
        print(leak if leak.endswith(" too") else
              f"{leak}\n    does not name {isa}: put it in STERADIAN_BEGIN_ISA, an unnamed namespace, or inline it away")
    print(f"{isa}: {checked} symbols in {len(objects)} objects, {len(found)} leaks")
    sys.exit(bool(found) or checked == 0)


if __name__ == "__main__":
    main()
