#!/bin/sh
# check_examples.sh EXAMPLE PROGRAM [ARGUMENT…]
#
# Runs EXAMPLE of examples/ as PROGRAM with these arguments, in a folder of its own, and checks the
# files and the output that it promises.
set -eu
example=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
    printf '%s\n' "$*"
    exit 1
}

"$@" >printed 2>&1 || fail "$example fails: $(cat printed)"

# picture FILE: checks that the file is a PNG of more than a few bytes.
picture() {
    [ "$(head -c 4 "$1" | tail -c 3)" = PNG ] && [ "$(wc -c <"$1")" -gt 2000 ] ||
        fail "$example leaves no picture $1: $(ls -l)"
}

case $example in
picture) picture picture.png ;;
first_hit)
    grep -q '^object 0 at t = 4\.0[0-9]*, proven to lie in \[4\.0[0-9]*, 4\.0[0-9]*\]$' printed ||
        fail "$example prints: $(cat printed)"
    ;;
million_rays)
    # t counts in lengths of the direction (…, …, 4): the front of the lattice's first layer, whose
    # spheres of radius 0.03 are at z = 0.05, is 2.02 ahead of the origin.
    grep -q '^[0-9]* of 1000000 rays hit$' printed && grep -q 'at t = 0\.50[0-9]*, between' printed ||
        fail "$example prints: $(cat printed)"
    ;;
animation)
    for frame in 00 01 02; do
        picture animation_$frame.png
    done
    [ "$(ls | wc -l)" = 4 ] || fail "$example leaves $(ls)"
    ! cmp -s animation_00.png animation_01.png || fail "nothing moves"
    ;;
scalar_against_simd) grep -q 'max abs error' printed || fail "$example prints: $(cat printed)" ;;
*) fail "no example '$example'" ;;
esac
