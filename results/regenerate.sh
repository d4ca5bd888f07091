#!/usr/bin/env bash
# Regenerates the figures of this folder with a program: results/regenerate.sh build/release/packtrace
set -euo pipefail
program=$(readlink -f "$1")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

scenes=()
for name in four_spheres quadrics transparent_shadows whitted shader sketch; do
    scenes+=("scenes/$name.scene")
done

echo "+ packtrace report"
rm -rf results/report
"$program" report "${scenes[@]}" --size 256x256 --truth-spp 64 --repetitions 5 -o results/report
# The page holds all pictures, and is too large to keep here with them.
find results/report \( -name report.html -o -name '*.png' ! -name arithmetic_truth.png \) -delete

echo "+ packtrace profile"
mkdir -p results/profile
for scene in "${scenes[@]}"; do
    name=$(basename "$scene" .scene)
    "$program" profile "$scene" --size 256x256 --heatmap "results/profile/${name}_cost.png" \
        >"results/profile/$name.txt.part"
    mv "results/profile/$name.txt.part" "results/profile/$name.txt"
done

echo "+ packtrace bench"
"$program" bench "${scenes[@]}" --repetitions 5 -o results/baseline.json
