#!/bin/sh
# scalar_against_simd.sh SCENE…
#
# For CI: renders each scene by the scalar reference and by the SIMD packets of each instruction set
# that this machine runs, in double precision, and fails where a pixel differs by more than 1e-6.
# PACKTRACE names the program.
set -eu
packtrace=${PACKTRACE:-packtrace}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for scene in "$@"; do
    "$packtrace" render "$scene" --quiet --size 160x120 --precision double --kernel scalar \
        -o "$folder/scalar.pfm"
    for isa in $("$packtrace" info --json |
        awk -F'"' '/"name"/ { name = $4 } /"supported": true/ { print name }'); do
        "$packtrace" render "$scene" --quiet --size 160x120 --precision double --isa "$isa" \
            -o "$folder/$isa.pfm"
        echo "$(basename "$scene"), $isa:"
        "$packtrace" compare "$folder/scalar.pfm" "$folder/$isa.pfm" --max-error 1e-6
    done
done
