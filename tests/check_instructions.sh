#!/bin/sh
# check_instructions.sh OBJDUMP OBJCOPY NAME FILE...
#
# GCC 12 may turn a*b-c, a*b+c into fmaddsub in spite of -ffp-contract, and fmaddsub rounds
# differently from the source: no file may contain one. The objects named sse42 and host (everything
# but the kernels) must run without AVX. The objects named one_lane, a baseline for comparisons,
# trace one ray at a time.
set -u
objdump=$1
objcopy=$2
name=$3
shift 3

[ $# -gt 0 ] || { echo "no files for $name"; exit 1; }
# Strips symbols: objdump searches all symbols of a file for each of its sections, which takes ten
# times as long as the rest.
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
number=0
for file in "$@"; do
    number=$((number + 1))
    "$objcopy" --strip-all "$file" "$folder/$number.o" || exit 1
done

# Treats the text as bytes: sixty megabytes then take a third of the time.
LC_ALL=C
export LC_ALL
# One pass counts everything. A failure of objdump itself becomes a line of its output.
counts=$({
    "$objdump" -d --no-show-raw-insn "$folder"/*.o || echo "objdump fails"
} | awk -F '\t' '
    /^objdump fails/ { failed = 1 }
    $1 !~ /^ +[0-9a-f]+:$/ { next }
    { ++instructions }
    $2 ~ /^v/ {
        ++avx
        if ($2 ~ /^vfn?m(add|sub)/) ++fused
        if ($2 ~ /^v(add|sub|mul|div|sqrt|fn?m(add|sub)[0-9]*)ps /) ++packed
    }
    $2 ~ /fmaddsub|fmsubadd/ { ++mixed }
    END { print failed + 0, instructions + 0, fused + 0, mixed + 0, avx + 0, packed + 0 }')
# shellcheck disable=SC2086
set -- $counts
[ $# = 6 ] && [ "$1" = 0 ] || { echo "objdump can't read the files of $name"; exit 1; }
instructions=$2 fused=$3 mixed=$4 avx=$5 packed=$6
echo "$name: $instructions instructions, $fused fused, $mixed fmaddsub or fmsubadd, $avx AVX, $packed packed float"

failed=0
if [ "$instructions" -lt 1000 ]; then
    echo "$name: objdump finds hardly any instructions"
    failed=1
fi
if [ "$mixed" != 0 ]; then
    echo "$name: compile with -fno-tree-vectorize"
    failed=1
fi
case $name in
sse42 | host)
    if [ "$avx" != 0 ]; then
        echo "$name: AVX instructions in code for machines without"
        failed=1
    fi
    ;;
one_lane | sse_fma | avx2 | avx512)
    if [ "$fused" = 0 ]; then
        echo "$name: no fused operation found; is objdump's output understood?"
        failed=1
    fi
    ;;
esac
if [ "$name" = one_lane ] && [ "$packed" != 0 ]; then
    echo "$name: arithmetic on several floats at once; compile with -fno-tree-slp-vectorize"
    failed=1
fi
exit "$failed"
