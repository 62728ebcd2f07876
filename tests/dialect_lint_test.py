#!/usr/bin/env python3
"""Feeds the lint good and bad snippets: every bad one must be caught, by the rule meant for it."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from dialect_lint import lint_text  # noqa: E402


def in_function(body, kind="real", parameters="real x, vec3 v, mask m, int n"):
    return f"// A function.\n{kind} topic_f({parameters}) {{\n{body}\n}}\n"


GOOD = [
    in_function("    return x * 0.5 + v.x;"),
    in_function("    real y = x;\n    y += 1.0e-35;\n    return select(y < 0.0, -y, y);"),
    in_function("    real y = x;\n    if (any_lane(m || y < 0.0)) {\n        y = select(m, 0.0, y);\n    }\n    return y;"),
    in_function("    if (real_digits() > 24) {\n        return x;\n    }\n    return -x;"),
    in_function("    if (n == 1) {\n        return x;\n    } else {\n        return -x;\n    }"),
    in_function("    real y = 0.0;\n    for (int i = 0; i < n; i++) {\n        y += x * real(i);\n    }\n    return y;"),
    in_function("    int k = 2 * n + 1;\n    return x * real(k);"),
    in_function("    vec3 a = vec3(x, 0.0, 1.0);\n    return dot(a, v);"),
    in_function("    mat3 a = mat3(v, v, v);\n    vec3 b = transform(a, v);\n    return b.x;"),
    "// S.\nstruct TopicState {\n    real a[4];\n    vec3 b;\n};\n"
    + in_function("    TopicState s;\n    s.a[0] = x;\n    s.a[n + 1] = 2.0;\n    return s.a[n] + s.b.z;"),
    "// A constant.\nreal topic_e() { return 2.71828182845904524; }\n",
    "// G.\nreal topic_g(real x, int n) { return x * real(n); }\n" + in_function("    return topic_g(x, 3);"),
]

BAD = [
    (in_function("    return m ? x : 0.0;"), "'?' is not in the dialect"),
    (in_function("    return x;", parameters="real x, out real y"), "no out, inout"),
    (in_function("    return x;", parameters="inout real x"), "no out, inout"),
    (in_function("    return x;", parameters="const real x"), "no out, inout"),
    (in_function("    if (any_lane(m)) {\n        return 0.0;\n    }\n    return x;"), "no early return"),
    (in_function("    if (any_lane(m)) {\n        if (n == 1) {\n            return 0.0;\n        }\n    }\n    return x;"),
     "no early return"),
    (in_function("    return x;\n    return x;"), "no early return"),
    (in_function("    real y = x;\n    if (x < 0.0) {\n        y = 0.0;\n    }\n    return y;"), "decides a branch"),
    (in_function("    real y = x;\n    if (m) {\n        y = 0.0;\n    }\n    return y;"), "decides a branch"),
    (in_function("    real y = x;\n    while (n < 3) { y = 0.0; }\n    return y;"), "reserved word"),
    (in_function("    real y = x;\n    for (real t = 0.0; t < 1.0; t += 0.1) {\n        y = t;\n    }\n    return y;"),
     "a loop counts"),
    (in_function("    real y = x;\n    if (n == 1) y = 0.0;\n    return y;"), "have braces"),
    (in_function("    return v.xyz;", kind="vec3"), "no swizzles"),
    (in_function("    return v.xx;", kind="vec2"), "no swizzles"),
    (in_function("    return v.r;"), "no swizzles"),
    (in_function("    return v[0];"), "have an index"),
    (in_function("    return vec3(0.5);", kind="vec3"), "no splat"),
    (in_function("    return vec4(v, 1.0);", kind="vec4"), "no packing"),
    (in_function("    return mat3(1.0);", kind="mat3"), "no splat"),
    (in_function("    mat3 a = mat3(v, v, v);\n    return a * v;", kind="vec3"), "matrix products differ"),
    ("// S.\nstruct TopicS {\n    real a;\n};\n" + in_function("    return TopicS(x);", kind="TopicS"), "field by field"),
    (in_function("    return x * 0.5f;"), "no suffix"),
    (in_function("    return x * .5;"), "both sides"),
    (in_function("    return x * 5.;"), "both sides"),
    (in_function("    return x * 1e-3;"), "both sides"),
    (in_function("    return x * 2;"), "in real arithmetic"),
    (in_function("    real y = 1;\n    return x + y;"), "in real arithmetic"),
    (in_function("    return max(x, 0);"), "in real arithmetic"),
    (in_function("    return vec3(1, x, x);", kind="vec3"), "in real arithmetic"),
    (in_function("    real sample = x;\n    return sample;"), "reserved word of GLSL"),
    (in_function("    real point = x;\n    return point;"), "reserved word of HLSL"),
    (in_function("    real of = x;\n    return of;"), "reserved word of WGSL"),
    (in_function("    real kernel = x;\n    return kernel;"), "reserved word of Metal"),
    (in_function("    real auto = x;\n    return auto;"), "reserved word of C++"),
    ("// F.\nreal other_f(real x) { return x; }\n", "does not begin with a topic"),
    ("// S.\nstruct Other {\n    real a;\n};\n", "does not begin with a topic"),
    (in_function("    return topic_later(x);") + "// G.\nreal topic_later(real x) { return x; }\n", "not defined above"),
    (in_function("    return sin(x);"), "not defined above"),
    ("// F.\nreal topic_f(real x);\n", "no declaration without a body"),
    ("// F.\nreal topic_f(real x) { return x; }\n// F.\nreal topic_f(vec3 v) { return v.x; }\n", "no overloading"),
    ("// A constant.\nreal topic_tau = 6.28;\n", "no globals"),
    ("// A constant.\nconst real topic_tau = 6.28;\n", "no globals"),
    ("real topic_f(real x) { return x; }\n", "no comment above"),
    ("// F.\n\nreal topic_f(real x) { return x; }\n", "no comment above"),
    ("struct TopicS {\n    real a;\n};\n", "no comment above"),
    ("#define TOPIC 1\n", "no preprocessor"),
    (in_function("    x = 0.0;\n    return x;"), "is assigned to"),
    (in_function("    v.x = 0.0;\n    return v.x;"), "is assigned to"),
    (in_function("    real a[3];\n    return x;"), "arrays only inside structs"),
    (in_function("    real a = x, b = x;\n    return a;"), "one declaration"),
    (in_function("    float a = x;\n    return a;"), "reserved word"),
    (in_function("    bool a = m;\n    return x;"), "reserved word"),
    (in_function("    return select(m && m || m, x, x);"), "needs parentheses"),
    (in_function("    real x = 1.0;\n    return x;"), "hides another"),
    (in_function("    return real_(x) & 3;"), "not in the dialect"),
    (in_function("    return x / max(x * x, 1.0e-36);"), "has a name: smallest_square()"),
]


def main():
    failed = 0
    for text in GOOD:
        findings, _ = lint_text("topic.glsl", text)
        if findings:
            failed += 1
            print(f"a good snippet is refused: {findings}\n{text}")
    for text, rule in BAD:
        findings, _ = lint_text("topic.glsl", text)
        if not any(rule in said for _, said in findings):
            failed += 1
            print(f"not caught: '{rule}'; found: {findings}\n{text}")
    print(f"{len(GOOD)} good and {len(BAD)} bad snippets, {failed} judged wrongly")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
