#!/bin/sh
# check_without_avx.sh QEMU PACKTRACE_TESTS PACKTRACE SCENES TESTS [OPTION…]
#
# Runs the program and the tests named by TESTS on an emulated processor with SSE4.2 and without
# AVX: an illegal instruction anywhere fails the test, also in code outside the kernels. SCENES is a
# scene to render, or a folder: then every scene in it is rendered, and every command that traces
# rays runs.
set -u
qemu=$1
tests_program=$2
packtrace=$3
scenes=$4
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
mkdir "$folder/there" "$folder/here"
emulated() {
    "$qemu" -cpu Nehalem "$@"
}
fail() {
    echo "$1:"
    cat "$folder/output"
    exit 1
}
# Runs a command of the program in the emulator.
runs() {
    (cd "$folder/there" && emulated "$packtrace" "$@") >"$folder/output" 2>&1 ||
        fail "packtrace $* ends with status $? without AVX"
}
# Runs a command in the emulator, and here with sse42: output and files must be equal.
same() {
    (cd "$folder/there" && emulated "$packtrace" "$@" >printed 2>"$folder/output") ||
        fail "packtrace $* ends with status $? without AVX"
    (cd "$folder/here" && PACKTRACE_ISA=sse42 "$packtrace" "$@" >printed 2>"$folder/output") ||
        fail "packtrace $* ends with status $? with sse42"
    diff -r "$folder/there" "$folder/here" >"$folder/output" 2>&1 ||
        fail "packtrace $* gives something else without AVX"
}

# The emulation is meaningful only if AVX is an illegal instruction on it: signal 4.
emulated "$tests_program" '[unchecked_avx]' >"$folder/output" 2>&1
status=$?
[ "$status" = 132 ] || fail "AVX kernels end with status $status there, not 132"

# An error message refuses what such a processor can't run.
for first in "$scenes" "$scenes"/*.scene; do
    [ ! -f "$first" ] || break
done
emulated "$packtrace" render "$first" --isa avx2 -o "$folder/no.pfm" >"$folder/output" 2>&1
status=$?
[ "$status" = 2 ] || fail "--isa avx2 ends with status $status, not 2"
grep -q "this machine cannot run 'avx2'; it can run: sse42" "$folder/output" ||
    fail "--isa avx2 is refused with other words"

if [ -f "$scenes" ]; then
    same render "$scenes" --size 100x75 -o a.pfm
else
    # All bounces run the same code, and in glass each has twice the rays of the one before.
    for scene in "$scenes"/*.scene; do
        same render "$scene" --size 32x24 --depth 4 -o a.pfm
        same render "$scene" --size 32x24 --depth 4 --precision double -o a.pfm
    done
    # Rays through a bvh, several samples, and the other kinds of picture.
    "$packtrace" generate random --count 1000 --radius 0.05 -o "$folder/many.scene" || exit 1
    spheres=$scenes/four_spheres.scene
    same render "$folder/many.scene" --size 32x24 -o a.pfm
    same render "$spheres" --size 32x24 --spp 4 -o a.png
    same render "$spheres" --size 32x24 --adaptive 0.05 -o a.hdr
    # A caller's rays, for each kind of query.
    {
        echo ox,oy,oz,dx,dy,dz
        for x in 0 1 2 3 4 5 6 7 8 9; do echo "0,0,0,0.0$x,-0.0$x,1"; done
    } >"$folder/rays.csv"
    for kind in '' --any --all; do
        same intersect "$scenes/quadrics.scene" "$folder/rays.csv" $kind
    done
    echo 'T:NAM T:NNM' >"$folder/systems"
    same onedim "$folder/systems"
    runs info "$scenes/quadrics.scene"
    runs explain "$spheres" --size 32x24 --pixel 16,16
    runs bench "$spheres" --size 16x12 --repetitions 3
    runs profile "$spheres" --size 16x12 --repetitions 1
    runs report "$spheres" --size 16x12 --quick -o report
fi

emulated "$tests_program" "$tests" "$@"
