#!/usr/bin/env bash
# Regenerates the figures of this folder with the programs of a build:
# results/regenerate.sh build/release
set -euo pipefail
program=$(readlink -f "$1/packtrace")
features=$(readlink -f "$1/bench/features/packtrace_features")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
python3 -B results/provenance.py

scenes=()
for name in four_spheres quadrics transparent_shadows whitted shader sketch; do
    scenes+=("scenes/$name.scene")
done

echo "+ packtrace report"
# The page holds all pictures, and is too large to keep here with them.
report() {
    local folder=$1
    shift
    rm -rf "$folder"
    "$program" report "$@" --repetitions 5 -o "$folder"
    find "$folder" \( -name report.html -o -name '*.png' ! -name arithmetic_truth.png \) -delete
}
report results/report "${scenes[@]}" --size 256x256
# Adaptive sampling saves most where few pixels lie on edges.
report results/report_large scenes/four_spheres.scene --size 1024x1024

echo "+ packtrace profile"
mkdir -p results/profile
for scene in "${scenes[@]}"; do
    name=$(basename "$scene" .scene)
    "$program" profile "$scene" --size 256x256 --heatmap "results/profile/${name}_cost.png" \
        >"results/profile/$name.txt.part"
    mv "results/profile/$name.txt.part" "results/profile/$name.txt"
done

echo "+ packtrace_features"
"$features" bench/features/scenes/*.scene scenes/*.scene --json results/features.json

echo "+ packtrace bench"
"$program" bench "${scenes[@]}" -o results/baseline.json
