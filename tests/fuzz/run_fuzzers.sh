#!/bin/bash
# run_fuzzers.sh [--only NAME] FOLDER SECONDS [OPTION…]: runs each fuzzer in FOLDER, or only one,
# for this time, and prints the number of inputs it tried. A fuzzer starts with its corpus and the
# findings of earlier runs. Options go to libFuzzer. New and failing inputs are kept in
# build/fuzzed/.
set -euo pipefail
only='*'
if [ "$1" = --only ]; then
    only=$2
    shift 2
fi
folder=$1
seconds=$2
shift 2
here=$(dirname "$(readlink -f "$0")")
kept=$(dirname "$(dirname "$here")")/build/fuzzed
failed=0
for source in "$here"/fuzz_$only.cpp; do
    name=$(basename "$source" .cpp)
    corpus=${name#fuzz_}
    mkdir -p "$kept/$corpus" "$kept/failed"
    log=$kept/$corpus.log
    if "$folder/$name" -max_total_time="$seconds" -max_len=8192 -timeout=60 -rss_limit_mb=2048 \
        -malloc_limit_mb=1024 -print_final_stats=1 -artifact_prefix="$kept/failed/$corpus-" "$@" \
        "$kept/$corpus" "$here/corpus/$corpus" >"$log" 2>&1; then
        echo "$corpus: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1) inputs, no finding"
    else
        failed=1
        grep -E '^broken|ERROR|SUMMARY|Test unit' "$log" >&2 || tail -5 "$log" >&2
        echo "$corpus: FAILED; see $log" >&2
    fi
done
exit $failed
