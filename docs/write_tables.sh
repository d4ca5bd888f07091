#!/usr/bin/env bash
# Writes the tables of docs/scene.md anew from the rows of the scene language: each stands below a
# line <!-- keys: NAME -->. Argument: the program, by default that of ./run build.
set -euo pipefail
docs=$(dirname "${BASH_SOURCE[0]}")
program=$(readlink -f "${1:-$docs/../build/release/packtrace}")
cd "$docs"

page=$(mktemp)
trap 'rm -f "$page"' EXIT
in_table=false
while IFS= read -r line; do
    if [[ $line == '<!-- keys: '*' -->' ]]; then
        echo "$line"
        name=${line#<!-- keys: }
        "$program" info --keys "${name% -->}"
        in_table=true
    elif ! $in_table || [[ $line != '|'* ]]; then
        echo "$line"
        in_table=false
    fi
done <scene.md >"$page"
cat "$page" >scene.md
