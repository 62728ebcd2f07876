#include "bench_options.h"

namespace steradian::app {

void add_bench_options(Verb& verb, BenchArguments& arguments) {
  verb.add("--filter", arguments.filter, "prefix of names, e.g. kernel/lambert; NAME$: that one").group("Choice").default_text("");
  verb.add("--simd", arguments.simd, "instruction set of benches that name none")
      .group("Choice")
      .words({"sse2", "avx2", "avx512"})
      .default_text("widest");
  verb.add_word("--backend", arguments.backend, "vulkan: frames on a device").group("Choice");
  verb.add("--device", arguments.device, "of vulkan: number or part of the name in `steradian info`").group("Choice").default_text("");
  verb.add_flag("--list", arguments.list, "print the names of the chosen benches").group("Choice");
  verb.add_flag("--pipelines", arguments.pipelines, "those of vulkan/kernel on --device, whose hardware may be absent").group("Choice");
  verb.add("--min-time", arguments.min_time, "seconds of runs per bench").group("Measurement").range(0.0, 3600.0);
  verb.add_flag("--json", arguments.json, "print JSON").group("Measurement");
  verb.add("--compare", arguments.base, "print ratios to this file of --json; above 1 is slower").group("Measurement").existing_file();
  verb.add("--fail-above", arguments.slower, "of --compare: exit 1 above this ratio; 0: never").group("Measurement").range(0.0, 1e9);
  verb.add_flag("--table2", arguments.table2, "errors and times of the Phong methods (docs/theory/moments.md)").group("Studies");
  verb.add("--figures", arguments.figures, "of --table2: folder for the page's figures")
      .group("Studies")
      .existing_folder()
      .writes(Writes::folder);
  verb.add_flag("--textured", arguments.textured, "errors of textured lights (docs/theory/ltc.md)").group("Studies");
  verb.add_flag("--plane", arguments.plane, "times and errors of the plane's methods (docs/measured/plane.md)").group("Studies");
  verb.add_flag("--cie171", arguments.cie171, "cases of CIE 171 against exact values (docs/measured/cie171.md)").group("Studies");
}

}  // namespace steradian::app
