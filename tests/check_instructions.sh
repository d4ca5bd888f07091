#!/bin/sh
# check_instructions.sh OBJDUMP NAME FILE...
#
# GCC 12 turns a*b-c, a*b+c into fmaddsub whatever -ffp-contract says, which rounds otherwise
# than the source: no file may hold one. And the objects named sse42 and host, which is all but
# the kernels, must run without AVX. Those named one_lane, which others are compared with, trace one
# ray at a time.
set -u
objdump=$1
name=$2
shift 2

[ $# -gt 0 ] || { echo "no files for $name"; exit 1; }
code=$("$objdump" -d --no-show-raw-insn "$@") || { echo "objdump can't read $*"; exit 1; }
count() {
    printf '%s\n' "$code" | grep -Ec "$1"
}
instructions=$(count '^ +[0-9a-f]+:')
mixed=$(count 'fmaddsub|fmsubadd')
fused=$(count 'vfn?m(add|sub)')
avx=$(count '^ +[0-9a-f]+:	v')
packed=$(count '	v(add|sub|mul|div|sqrt|fn?m(add|sub)[0-9]*)ps ')
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
one_lane | sse_fma | avx2 | avx512 | library)
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
