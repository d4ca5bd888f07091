#!/usr/bin/env bash
# What packtrace_frames writes for other tracers, and what it refuses.
set -euo pipefail
frames=$1
scenes=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
    echo "$*" >&2
    exit 1
}

expect() {
    grep -qF -- "$2" "$folder/$1" || fail "$1 lacks: $2"
}

"$frames" export "$scenes/four_spheres.scene" -o "$folder/a.pov"
expect a.pov "max_trace_level 4 adc_bailout 0"
expect a.pov "location <0,0,0> right <1,0,0> up <0,1,0> direction <0,0,1>"
# The first sphere's own light: 0.6 of red at (2, 1, 0).
expect a.pov "light_source { <2,1,0> color rgb <0.6,0,0> }"
expect a.pov "sphere { <0,-5001,0>, 5000"
expect a.pov "diffuse 0.5 phong 0.5 phong_size 1000 reflection { 0.5 }"
[ "$(grep -c light_group "$folder/a.pov")" = 4 ] || fail "not a light group for each sphere"

"$frames" export "$scenes/four_spheres.scene" -o "$folder/a.dat"
expect a.dat "ZOOM 1"
expect a.dat "RAYDEPTH 4"
expect a.dat "LIGHT CENTER 2 1 0 RAD 0 COLOR 0.6 0.6 0.6"
expect a.dat "SPHERE CENTER 2 1 3 RAD 1"
expect a.dat "AMBIENT 0.1 DIFFUSE 0.5 SPECULAR 0.5 OPACITY 1 PHONG METAL 0.5 PHONG_SIZE 1000"

for wrong in "quadrics.scene b.pov" "whitted.scene b.dat" "four_spheres.scene b.txt"; do
    set -- $wrong
    if "$frames" export "$scenes/$1" -o "$folder/$2" 2>"$folder/err"; then
        fail "$1 was written as $2"
    fi
    [ "$(wc -l <"$folder/err")" = 1 ] || fail "not one line of error for $1"
    [ ! -e "$folder/$2" ] || fail "$2 was left behind"
done
