#!/usr/bin/env bash
# Renders every scene of this folder into docs/pictures, small, for docs/gallery.md.
# Usage: scenes/render_gallery.sh PACKTRACE
set -euo pipefail
packtrace=$(readlink -f "${1:?usage: scenes/render_gallery.sh PACKTRACE}")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
mkdir -p docs/pictures

# In the shape of the scene itself.
size_of() {
    case $1 in
        four_spheres | quadrics) echo 360x360 ;;
        flight) echo 360x240 ;;
        *) echo 400x300 ;;
    esac
}

for scene in scenes/*.scene; do
    name=$(basename "$scene" .scene)
    "$packtrace" render "$scene" --size "$(size_of "$name")" -o "docs/pictures/$name.png"
done
for frame in 40 75 119; do
    "$packtrace" render scenes/flight.scene --frame "$frame" --size 360x240 \
        -o "docs/pictures/flight_$frame.png"
done
