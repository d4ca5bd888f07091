#!/bin/sh
# check_without_avx.sh QEMU PACKTRACE_TESTS PACKTRACE SCENE TESTS [OPTION…]
#
# Runs the program and the tests named by TESTS on an emulated processor that has SSE4.2 and no
# AVX: an illegal instruction anywhere fails, in the host's code too.
set -u
qemu=$1
tests_program=$2
packtrace=$3
scene=$4
tests=$5
shift 5

case $qemu in
'' | *NOTFOUND)
    echo "qemu-x86_64 is missing; type: sudo apt-get install qemu-user"
    exit 1
    ;;
esac
unset PACKTRACE_ISA
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
emulated() {
    "$qemu" -cpu Nehalem "$@"
}
fail() {
    echo "$1:"
    cat "$folder/output"
    exit 1
}

# The emulation is worth something only if AVX is an illegal instruction on it: signal 4.
emulated "$tests_program" '[unchecked_avx]' >"$folder/output" 2>&1
status=$?
[ "$status" = 132 ] || fail "AVX kernels end with status $status there, not 132"

# A picture from there is the one that sse42 gives here.
emulated "$packtrace" render "$scene" --size 100x75 -o "$folder/there.pfm" \
    >"$folder/output" 2>&1 || fail "can't render without AVX"
"$packtrace" render "$scene" --size 100x75 --isa sse42 -o "$folder/here.pfm" \
    >"$folder/output" 2>&1 || fail "can't render with --isa sse42"
cmp "$folder/there.pfm" "$folder/here.pfm" || exit 1

# What such a processor can't run is refused in words.
emulated "$packtrace" render "$scene" --isa avx2 -o "$folder/no.pfm" >"$folder/output" 2>&1
status=$?
[ "$status" = 2 ] || fail "--isa avx2 ends with status $status, not 2"
grep -q "this machine cannot run 'avx2'; it can run: sse42" "$folder/output" ||
    fail "--isa avx2 is refused with other words"

emulated "$tests_program" "$tests" "$@"
