"""The tables of README.md and docs/ that come from measurements. One function per block turns the
contents of a file in results/ into Markdown; write_figures.py inserts it into the page."""
import statistics

# The default accuracy.
DEFAULT_MODE = "exact"


def table(head, rows, left=1):
    """A Markdown table whose first `left` columns are aligned left, the others right."""
    rule = ["---"] * left + ["---:"] * (len(head) - left)
    return "\n".join("| " + " | ".join(line) + " |" for line in [head, rule, *rows])


def digits(value, count=3):
    """`count` significant digits, without an exponent."""
    if value == 0:
        return "0"
    rounded = float(f"{value:.{count - 1}e}")
    whole = len(str(int(abs(rounded))))
    return f"{rounded:.{max(count - whole, 0)}f}" if abs(rounded) >= 1 else f"{rounded:.{count}g}"


def spread(values):
    """Median, minimum and maximum."""
    return f"{statistics.median(values):.2f} ({min(values):.2f} … {max(values):.2f})"


def source(context):
    return f"Commit {context['commit']}, {context['processor']}, {context['compiler']}."


# Races against Embree: peers.json

def fastest(tracers, start, end=""):
    """The tracer with the highest median rate whose name has this start and end; None if there is none."""
    found = [t for t in tracers if t["tracer"].startswith(start) and t["tracer"].endswith(end)]
    return max(found, key=lambda t: t["mrays_median"], default=None)


def over(tracer, peer):
    """The speed relative to a peer, over pairs of passes."""
    if tracer is None:
        return "–"
    return spread([theirs / ours for ours, theirs in zip(tracer["seconds"], peer["seconds"])])


def rates_of(report):
    return f"{source(report['context'])} The default mode is `{DEFAULT_MODE}`."


def peers_rows(report, isa):
    for race in report["races"]:
        tracers = race["tracers"]
        user = fastest(tracers, "embree user")
        ours = fastest(tracers, f"packtrace {isa} {DEFAULT_MODE} stream")
        yield ([race["scene"], race["kind"], digits(user["mrays_median"]),
                digits(ours["mrays_median"]), over(ours, user),
                over(fastest(tracers, f"packtrace {isa} fast stream"), user)],
               [over(fastest(tracers, f"packtrace {isa} {DEFAULT_MODE} tiles"), user),
                over(fastest(tracers, f"packtrace {isa} fast tiles"), user),
                over(ours, fastest(tracers, "embree sphere"))])


def peers_summary(report):
    head = ["scene", "rays", "Embree", "packtrace, default mode", "ratio", "ratio of `fast`"]
    rows = [short for short, _ in peers_rows(report, "avx512")]
    return f"{rates_of(report)}\n\n" + table(head, rows, 2)


def peers_rates(report):
    head = ["scene", "rays", "Embree `user`", f"`{DEFAULT_MODE}` stream", "× user", "`fast` stream × user",
            f"`{DEFAULT_MODE}` tiles × user", "`fast` tiles × user", f"`{DEFAULT_MODE}` stream × sphere"]
    parts = [rates_of(report)]
    raced = {t["tracer"].split()[1] for t in report["races"][0]["tracers"]}
    for isa in (isa for isa in ("avx512", "avx2") if isa in raced):
        parts += [f"With `{isa}`:", table(head, [a + b for a, b in peers_rows(report, isa)], 2)]
    return "\n\n".join(parts)


def peers_builds(report):
    rows = [[b["side"], str(b["threads"]), digits(b["seconds"]),
             f"{min(b['seconds_of_all']):.3g} … {max(b['seconds_of_all']):.3g}",
             digits(b["bytes_an_object"])] for b in report["builds"]]
    return table(["side", "threads", "seconds", "lowest … highest", "bytes an object"], rows)


def peers_frames(report):
    head = ["scene", "objects", "Tachyon, s", "POV-Ray, s", "packtrace, s", "× Tachyon", "× POV-Ray",
            "packtrace again, s"]
    rows = []
    for scene in report["scenes"]:
        tracers = scene["tracers"]
        ours = tracers["packtrace"]["trace_seconds"]
        theirs = [tracers[name]["trace_seconds"] for name in ("tachyon", "povray")]
        ratios = [spread([a / b for a, b in zip(peer["all"], ours["all"])]) for peer in theirs]
        rows.append([scene["scene"], str(scene["objects"]),
                     *(digits(peer["median"]) for peer in theirs), digits(ours["median"]), *ratios,
                     digits(tracers["packtrace"]["trace_again_seconds"]["median"])])
    return f"{source(report['context'])}\n\n" + table(head, rows)


# The cost of `exact`: exact_cost.json

def exact_ratio(row, mode):
    ratio = row.get(f"exact_over_{mode}")
    if ratio is None:
        return "–"
    return f"{ratio['median']:.2f} ({ratio['lowest']:.2f} … {ratio['highest']:.2f})"


def exact_table(rows, what, modes):
    head = ["scene", "ISA", what, "`exact`", *(f"over {name}" for name in modes.values())]
    return table(head, [[row["scene"], row["isa"], row["rays"], f"{row['exact']:.1f}",
                         *(exact_ratio(row, mode) for mode in modes)] for row in rows], 3)


def exact_cost(report):
    rays = [row for row in report["rows"] if row["unit"] != "milliseconds"]
    frames = [row for row in report["rows"] if row["unit"] == "milliseconds"]
    modes = {"fast": "`fast`", "double": "double", "before": "before"}
    return "\n\n".join([
        f"Commit {report['commit']}, {report['machine']}, {report['repetitions']} repetitions. "
        f"Before is {report['before']}.",
        exact_table(rays, "rays, million a second", modes),
        exact_table(frames, "frame, ms", {**modes, "note": "`note`"})])


def lone_rays(report):
    return (f"Commit {report['commit']}, {report['machine']}, {report['repetitions']} repetitions. "
            f"Before is {report['before']}.\n\n" +
            exact_table(report["rows"], "rays, million a second", {"double": "double", "before": "before"}))


def exact_range(rows, mode):
    medians = [row[f"exact_over_{mode}"]["median"] for row in rows if f"exact_over_{mode}" in row]
    return f"{min(medians):.2f} to {max(medians):.2f}"


def exact_cost_ranges(report):
    lines = []
    for name, unit in (("A caller's rays", "million rays a second"), ("Frames", "milliseconds")):
        rows = [row for row in report["rows"] if row["unit"] == unit]
        lines.append(f"- {name} in `exact` run at {exact_range(rows, 'fast')} times the speed of `fast`,\n"
                     f"  {exact_range(rows, 'double')} times that of double precision, and "
                     f"{exact_range(rows, 'before')} times that of the version before\n"
                     f"  ({report['before']}).")
    return f"Commit {report['commit']}:\n\n" + "\n".join(lines)


# Scaling with objects and pixels: scaling.json

def at(points, study, **wanted):
    return next((p for p in points if p["study"] == study and
                 all(p[key] == value for key, value in wanted.items())), None)


def faster_by_two(points, one, key):
    two = at(points, one["study"], threads=2, **{key: one[key]})
    return f"{one['frame_seconds'] / two['frame_seconds']:.2f}×" if two else "–"


def scaling_objects(report):
    points = report["points"]
    ones = sorted((p for p in points if p["study"] == "objects" and p["threads"] == 1),
                  key=lambda p: p["objects"])
    rows, before = [], None
    for p in ones:
        growth = f"{p['nanoseconds_a_ray'] / before:.2f}" if before else ""
        before = p["nanoseconds_a_ray"]
        rows.append([f"{p['objects']:,}".replace(",", " "), f"{p['build_seconds']:.4g}",
                     f"{p['scene_bytes_an_object']:.0f}", f"{p['frame_seconds'] * 1e3:.1f}",
                     faster_by_two(points, p, "objects"), f"{before:.1f}", growth])
    return f"{source(report['context'])}\n\n" + table(
        ["objects", "build, s", "bytes an object", "frame, ms", "two threads", "ns a ray",
         "over ten times fewer"], rows, 0)


def scaling_pixels(report):
    points = report["points"]
    ones = sorted((p for p in points if p["study"] == "size" and p["threads"] == 1),
                  key=lambda p: p["size"])
    rows = [[str(p["size"]), f"{p['frame_seconds'] * 1e3:.2f}", faster_by_two(points, p, "size"),
             f"{p['mrays_a_second']:.1f}", f"{p['peak_bytes'] / 2**20:.0f}"] for p in ones]
    return table(["edge", "frame, ms", "two threads", "million rays a second", "peak memory, MiB"],
                 rows, 0)


# Gains by lanes and by the algorithm: lanes.json

def lanes(report):
    context = report["context"]
    times = {}
    for run in report["benchmarks"]:
        if run["run_type"] == "iteration" and "/threads:1/" in run["run_name"]:
            family, kernel, precision = run["run_name"].split("/")[:3]
            if family == "frame":
                times.setdefault((precision, kernel), []).append(run["real_time"])
    order = ("scalar", "one_lane", "sse42", "sse_fma", "avx2", "avx512")
    rows = []
    for precision in ("float", "double"):
        one = statistics.median(times[precision, "one_lane"])
        reference = statistics.median(times[precision, "scalar"])
        for kernel in order:
            if (precision, kernel) not in times:
                continue
            here = statistics.median(times[precision, kernel])
            rows.append([precision, "reference" if kernel == "scalar" else f"`{kernel}`", digits(here),
                         f"{reference / here:.2f}",
                         "–" if kernel == "scalar" else spread([one / t for t in times[precision, kernel]])])
    return f"Commit {context['commit']}, {context['processor']}.\n\n" + table(
        ["precision", "kernels", "frame, ms", "× reference", "× one lane"], rows, 2)


# Many ranks: cluster.json

SHOWN_RANKS = (2, 8, 32, 128, 512, 1024, 4096)


def cluster_models(report):
    rows = []
    for study in report["studies"]:
        speedups = {run["ranks"]: run["speedup"] for run in study["runs"]}
        rows.append([study["name"], digits(1e3 * study["piece_seconds"]), digits(1e3 * study["write_seconds"]),
                     *(digits(speedups[ranks]) for ranks in SHOWN_RANKS), str(study.get("scales_to", "all")),
                     study.get("why", "–")])
    head = ["job", "a piece, ms", "to write it, ms", *(str(ranks) for ranks in SHOWN_RANKS), "scales to",
            "why not further"]
    costs = report["costs"]
    return (f"Commit {report['commit']}, {report['machine']}. Latency {digits(1e6 * costs['latency'])} µs, "
            f"{digits(1e-9 * costs['bytes_per_second'])} GB/s, a number of the counter "
            f"{digits(1e6 * costs['counter_seconds'])} µs on rank 0 and {digits(1e6 * costs['ask_seconds'])} µs besides.\n\n"
            + table(head, rows))


def cluster_efficiency(report):
    race = report["efficiency"]
    ratio = race["ranks_over_process"]
    seconds = race["seconds"]
    return (f"Commit {report['commit']}, {report['machine']}: `{race['scene']}` at {race['size']} x {race['size']}, "
            f"{race['repetitions']} runs by turns.\n\n"
            + table(["", "seconds"],
                    [["one process, two threads", digits(statistics.median(seconds["process"]))],
                     ["two ranks, one thread each", digits(statistics.median(seconds["ranks"]))],
                     ["the second over the first", f"{ratio['median']:.3f} ({ratio['lowest']:.3f} … {ratio['highest']:.3f})"],
                     ["what the model says of the ranks", digits(report["model_of_race_seconds"])]])
            + f"\n\nRank 1 sent {race['bytes_a_sent_pixel']:.2f} bytes for each of its pixels.")


# features.json, stress_exact.json, stress.json

def features(report):
    rows = [[s["scene"], s["kernel"], f"{s['special_ms']:.2f}", f"{s['general_ms']:.2f}",
             f"{s['general_over_special']:.2f}"] for s in report["scenes"]]
    return f"Commit {report['commit']}, {report['machine']}, {report['compiler']}.\n\n" + table(
        ["scene", "kernel", "special, ms", "general, ms", "general / special"], rows, 2)


def few_digits(value):
    if value >= 1e5:
        return f"{value:.0e}".replace("e+0", "e")
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def stress_exact(report):
    rows = [[r["family"], str(r["hits"] - r["undecided"]), str(r["t_at_doubles_limit"]),
             f"{r['ulp']['p99']:.2f}", few_digits(r["ulp"]["max"])]
            for r in report["rows"] if r["t_at_doubles_limit"] > 0]
    return (f"Commit {report['commit']}, `{report['command']}`:\n\n> {report['verdict']}\n\n" +
            table(["family", "decided hits", "t beyond 1 ulp", "t 99%", "t most"], rows))


def stress_textbook(report):
    rows = [[r["family"], str(r["rays"]), str(r["wrong"]), few_digits(r["ulp"]["p99"])] for r in report["rows"]
            if r["kernel"] == "textbook" and r["ulp"]["p99"] >= 1000]
    return f"Commit {report['commit']}.\n\n" + table(["family", "rays", "wrong", "t 99%"], rows)


def stress_modes(report):
    def row(name, chosen):
        def total(key):
            return str(sum(r[key] for r in chosen))

        return [name, total("rays"), total("wrong"), total("second_rays"), total("self_hits"), total("second_lost")]

    packets = [r for r in report["rows"] if r["kernel"] == "packet"]
    return f"Commit {report['commit']}.\n\n" + table(
        ["mode", "rays", "wrong", "second rays", "self-hits", "lost"],
        [row(f"`{mode}`", [r for r in packets if r["mode"] == mode]) for mode in ("fast", "exact")])


def by(key, parts):
    """Groups the parts by their value of `key`."""
    groups = {}
    for part in parts:
        groups.setdefault(part[key], []).append(part)
    return groups


def total(key, parts):
    return sum(part[key] for part in parts)


def found(key, findings):
    """A table of findings with a row for each cause; empty without findings."""
    if not findings:
        return ""
    causes = dict.fromkeys((f["cause"], f["mended"]) for f in findings)
    rows = [[", ".join(str(f[key]) for f in findings if (f["cause"], f["mended"]) == one), *one]
            for one in causes]
    return "\n\n" + table([f"{key}s", "what it was", "how it was mended"], rows, 3)


def soak(report):
    parts, findings = report["parts"], report["findings"]
    head = (f"Seed {report['seed']}, {report['machine']}: {total('scenes', parts)} scenes in "
            f"{total('seconds', parts) / 60:.0f} minutes, {total('refused', parts)} of them refused by "
            f"the scene language, {len(findings)} findings.\n\n")
    runs = table(["commit", "first scene", "scenes", "minutes"],
                 [[name, str(of[0]["first"]), str(total("scenes", of)), f"{total('seconds', of) / 60:.0f}"]
                  for name, of in by("commit", parts).items()])
    return head + runs + found("scene", findings)


def fuzz(report):
    parts, findings = report["parts"], report["findings"]
    head = (f"{report['machine']}, commit {', '.join(by('commit', parts))}: "
            f"{total('inputs', parts) / 1e6:.1f} million inputs in {total('seconds', parts) / 3600:.1f} "
            f"hours of all fuzzers together, findings: {len(findings)}.\n\n")
    runs = table(["fuzzer", "inputs", "minutes"],
                 [[f"`{name}`", str(total("inputs", of)), f"{total('seconds', of) / 60:.0f}"]
                  for name, of in sorted(by("fuzzer", parts).items())])
    return head + runs + found("fuzzer", findings)


# Instructions and cycles of kernels: instructions.json, roofline.json

# For vectors of 8 floats, the most that Zen 3 can start in a cycle, from AMD's "Software Optimization
# Guide for AMD EPYC 7003": instructions of all kinds, and products, fused or not.
DISPATCHED = 6
PRODUCTS = 2
ARITHMETIC = ("single", "double", "conversion", "division, root")


def instruction_table(report):
    head = ["scene", "function", "instructions now", "before"]
    rows = []
    for row in report["rows"]:
        now, before = row["now"]["functions"], row["before"]["functions"]
        rows.append([row["scene"], "all", f"{row['now']['instructions']:.0f}",
                     f"{row['before']['instructions']:.0f}"])
        names = sorted({*now, *before}, key=lambda name: -max(
            counts.get(name, {"instructions": 0})["instructions"] for counts in (now, before)))
        rows += [["", f"`{name}`", *(f"{counts[name]['instructions']:.0f}" if name in counts else "–"
                                     for counts in (now, before))]
                 for name in names[:8]]
    return (f"Commit {report['commit']}; before is {report['before']}. `{report['isa']}`, for "
            f"{report['pixels']} pixels.\n\n" + table(head, rows, 2))


def share_of(kinds, names):
    return sum(kinds.get(name, 0) for name in names) / sum(kinds.values())


def roofline_row(scene, name, cycles, instructions, kinds):
    arithmetic = sum(kinds.get(kind, 0) for kind in ARITHMETIC)
    return [scene, name, f"{instructions:.0f}", f"{cycles:.0f}", f"{instructions / cycles:.1f}",
            *(f"{100 * share_of(kinds, names):.0f} %" for names in (
                ARITHMETIC, ("compare, select", "shuffle"), ("move, spilled", "move"),
                ("scalar", "branch"))),
            f"{instructions / DISPATCHED:.0f}", f"{arithmetic / PRODUCTS:.0f}"]


def roofline(report):
    head = ["scene", "function", "instructions", "cycles", "a cycle", "arithmetic",
            "masks, shuffles", "moves", "scalar, branches", "cycles if only begun",
            "cycles of arithmetic"]
    rows = []
    for row in report["rows"]:
        functions = row["functions"]
        kinds = {}
        for function in functions.values():
            for kind, count in function["kinds"].items():
                kinds[kind] = kinds.get(kind, 0) + count
        rows.append(roofline_row(row["scene"], "all", row["cycles"],
                                 sum(f["instructions"] for f in functions.values()), kinds))
        rows += [roofline_row("", f"`{name}`", f["cycles"], f["instructions"], f["kinds"])
                 for name, f in functions.items() if f["cycles"] > 0.03 * row["cycles"]]
    waits = table(["scene", "branches mispredicted", "lines missed in the first-level cache"],
                  [[row["scene"], f"{row['mispredicted']:.1f}", f"{row['missed_lines']:.0f}"]
                   for row in report["rows"]])
    return (f"Commit {report['commit']}, {report['machine']}, {report['gigahertz']:.2f} GHz. "
            f"`{report['isa']}`, for {report['pixels']} pixels.\n\n{table(head, rows, 2)}\n\n{waits}")


# By the name of a block in markers, after its file: results/peers.json: summary.
TABLES = {
    "results/peers.json: summary": peers_summary,
    "results/peers.json: rates": peers_rates,
    "results/peers.json: builds": peers_builds,
    "results/peers_frames.json: frames": peers_frames,
    "results/instructions.json: functions": instruction_table,
    "results/roofline.json: functions": roofline,
    "results/exact_cost.json: tables": exact_cost,
    "results/exact_cost.json: ranges": exact_cost_ranges,
    "results/lone_rays.json: table": lone_rays,
    "results/scaling.json: objects": scaling_objects,
    "results/scaling.json: pixels": scaling_pixels,
    "results/lanes.json: frames": lanes,
    "results/cluster.json: models": cluster_models,
    "results/cluster.json: efficiency": cluster_efficiency,
    "results/features.json: scenes": features,
    "results/fuzz.json: counts": fuzz,
    "results/soak.json: counts": soak,
    "results/stress_exact.json: verdict": stress_exact,
    "results/stress.json: textbook": stress_textbook,
    "results/stress.json: modes": stress_modes,
}
