#!/usr/bin/env bash
# Renders the pictures of docs/numerics_results.md. Usage: docs/numerics/render.sh PACKTRACE
set -euo pipefail
packtrace=$(readlink -f "${1:?usage: docs/numerics/render.sh PACKTRACE}")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"

render() {
    local scene=$1 name=$2
    shift 2
    "$packtrace" render "$scene.scene" -o "../pictures/numerics_$name.png" "$@"
}

render horizon horizon_textbook --kernel scalar --precision single --self-hits note
render horizon horizon_exact --accuracy exact --self-hits exact
for scene in miniature colossus pancake; do
    render "$scene" "${scene}_note" --accuracy exact --self-hits note
    render "$scene" "${scene}_exact" --accuracy exact --self-hits exact
done
render needle needle_fast --accuracy fast
render needle needle_exact --accuracy exact
